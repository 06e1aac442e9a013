//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    table {
        PARQUET = "CGR-TABLE-027", "table::parquet",
            "The file is named `.parquet`, but is not a Parquet table. The message has the reason. A file of a run that was killed has no end and cannot be read. Name a CSV table .csv, or write the Parquet file again.\n    wrong: play_csv = \"q.parquet\" for a CSV table\n    right: play_csv = \"q.csv\"";
    }
}
