//! Results on disk: each file whole or not at all, in a folder that one run at a time writes to.

mod digests;
mod folder;
mod lock;
mod names;
mod whole_file;

pub use digests::{ComparedResults, compare_results, read_result};
pub use folder::{FolderError, OutputFolder};
pub use names::{CASES, DIGESTS, REPORT, result_files};
pub use whole_file::{OutputError, is_same_file, remove_unfinished_files, write_whole};
