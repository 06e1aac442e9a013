//! Files that are made from other files: `convert`, `new` and `clearance --write-srdf`.

mod conversions;
mod disabled_pairs;
mod new_files;
mod whole_robots;
