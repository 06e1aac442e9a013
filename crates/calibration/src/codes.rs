//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    measurements {
        JSON = "CGR-TABLE-011", "measurements::json",
            "The file is not a JSON array of measurements. An entry has the joints and what was measured.\n    [{\"q\": {\"elbow_joint\": 0.1}, \"translation_m\": [0.5, 0, 0.3]}]";
        NONE = "CGR-TABLE-012", "measurements::none",
            "The file has no measurement, so there is nothing to fit.";
        NOTHING_MEASURED = "CGR-TABLE-013", "measurements::nothing_measured",
            "No column gives a measured position or orientation. Then there is nothing to compare with the model. Add the measured position, and the orientation if it was measured.";
        UNKNOWN_COLUMN = "CGR-TABLE-014", "measurements::unknown_column",
            "A column is neither a joint nor a measured quantity. Often the columns are separated by semicolons or tabs. Separate them with commas, and write decimals with a point.";
        REPEATED_COLUMN = "CGR-TABLE-015", "measurements::repeated_column",
            "Two columns give the same quantity. The two may contradict each other. Remove one.";
        REPEATED = "CGR-TABLE-016", "measurements::repeated",
            "A measurement gives the same quantity by two keys. The two may contradict each other. Keep one of the keys.";
        MISSING_JOINT = "CGR-TABLE-017", "measurements::missing_joint",
            "A joint of the chain has no column, so its position is unknown. Each joint of the chain needs its position in each measurement. Add the column.";
        UNIT = "CGR-TABLE-018", "measurements::unit",
            "The name of a column lacks a unit, or has a unit that does not fit its joint.\n    elbow_joint_deg";
        CELLS = "CGR-TABLE-019", "measurements::cells",
            "A line has another number of cells than the header, so a value is missing or added, and the values after it would be read as other quantities.";
        EMPTY_CELL = "CGR-TABLE-020", "measurements::empty_cell",
            "A cell of a joint is empty. A missing position is not taken as 0. Write the position, or remove the line.";
        NUMBER = "CGR-TABLE-021", "measurements::number",
            "A cell is not a finite number. Write decimals with a point. NaN and words for missing values are not numbers.";
        TRANSLATION = "CGR-TABLE-022", "measurements::translation",
            "A measured position does not have two or three coordinates, or a coordinate is not a distance. Give x, y and z, or x and y for a planar measurement.";
        ORIENTATION = "CGR-TABLE-023", "measurements::orientation",
            "A measured orientation is incomplete, is given twice, or is not a rotation. Give a quaternion of norm 1, or roll, pitch and yaw, not both.";
    }
    calibrate {
        ROBOT = "CGR-COMMAND-020", "calibrate::robot",
            "No joint moves the tip relative to the base, so there is nothing to calibrate. Choose base and tip so that a joint between them moves.";
        NO_TABLE = "CGR-COMMAND-021", "calibrate::no_table",
            "Corrections of table entries were requested, but the robot has no Denavit-Hartenberg table. Free zero-offsets, axes, base or tool instead.";
        NOTHING_FREE = "CGR-COMMAND-022", "calibrate::nothing_free",
            "No correction is free, so there is nothing to fit. Free a group or a single correction with --free; the help lists the groups.";
        UNKNOWN_CORRECTION = "CGR-COMMAND-023", "calibrate::unknown_correction",
            "--free names neither a group of corrections nor a single correction. The help has the most similar name and the known ones.";
        NEXT = "CGR-COMMAND-024", "calibrate::next",
            "More configurations were requested than there are candidates to choose from. Ask for fewer; the help names the number of candidates.";
    }
}
