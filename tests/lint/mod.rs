//! `congruent lint`, and its findings in the documents of the other commands.

mod broken_files;
mod findings;
mod warnings;
