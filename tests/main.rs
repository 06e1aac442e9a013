//! Acceptance tests: the built command on real robots, against numbers from independent programs.
//! What needs the corpus says that it was skipped where there is none.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

mod calibrate;
mod check;
mod convert;
mod files;
mod goldens;
mod identify;
mod lint;
mod output;
mod run;
mod support;
