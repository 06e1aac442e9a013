//! `congruent lint`, and its findings in the documents of the other commands.

mod broken_files;
mod explanations;
mod findings;
mod warnings;
