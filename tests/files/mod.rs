//! What is read and written: wrong and large files, files outside of the project, faults of disk and memory.

mod bad_input;
mod chains;
mod describe;
mod fence;
mod first_mistakes;
#[cfg(target_os = "linux")]
mod large_inputs;
mod live_lines;
mod long_chains;
mod machine_faults;
mod uses;
