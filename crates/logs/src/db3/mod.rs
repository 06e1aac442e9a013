//! Bags of rosbag2 in SQLite (`.db3`), read by the library of SQLite, which is C: the feature `db3` brings it. Without the feature
//! such a bag is refused with how to get it. No other file of the crate knows the feature.

use std::path::PathBuf;

use congruent_input::Diagnostic;

use crate::event::LogReader;

#[cfg(feature = "db3")]
mod address;
#[cfg(feature = "db3")]
mod database;
#[cfg(feature = "db3")]
mod reader;
#[cfg(feature = "db3")]
#[cfg(test)]
mod write;

/// Opens the files of a bag as one log, in this order. `refused` is why other files of it are not read.
///
/// # Errors
/// None of the files is a database of a bag.
#[cfg(feature = "db3")]
pub(crate) fn open(files: &[PathBuf], refused: Vec<Diagnostic>) -> Result<Box<dyn LogReader>, Diagnostic> {
    Ok(Box::new(reader::Db3Reader::open(files, refused)?))
}

/// Refuses the files of a bag: this program was built without the feature.
#[cfg(not(feature = "db3"))]
pub(crate) fn open(files: &[PathBuf], _refused: Vec<Diagnostic>) -> Result<Box<dyn LogReader>, Diagnostic> {
    use crate::{codes, options::CONVERT};

    let names = files.first().map(|path| path.display().to_string()).unwrap_or_default();
    let message = format!("{names} is a SQLite bag, which this program was built without");
    let help = format!(
        "install it with the feature: `cargo install --path crates/cli --features db3`; or {CONVERT}"
    );
    Err(Diagnostic::error(codes::log::FORMAT, message).with_help(help))
}

#[cfg(not(feature = "db3"))]
#[cfg(test)]
mod tests {
    use crate::{LogOptions, codes, is_log, open_log};

    #[test]
    fn without_the_feature_a_bag_is_refused_with_what_to_do() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bag_0.db3");
        std::fs::write(&path, b"SQLite format 3").unwrap();
        for path in [path.as_path(), folder.path()] {
            let refused = open_log(path, &LogOptions::default()).err().unwrap();
            assert!(is_log(path) && refused.code == codes::log::FORMAT, "{refused}");
            let help = refused.help.unwrap();
            assert!(help.contains("--features db3") && help.contains("storage_id: mcap"), "{help}");
        }
    }
}
