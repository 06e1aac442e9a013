//! Files that are made from other files: `derive`, `convert`, `new` and `acm suggest`.

mod acm;
mod conversions;
mod new_files;
