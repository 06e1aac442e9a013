//! Acceptance tests: the built command on real robots, against numbers from independent programs.
//! What needs the corpus says that it was skipped where there is none.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

mod acm;
mod arm_studies;
mod bad_input;
mod batch;
mod calibration;
mod calibration_input;
mod calibration_verdicts;
mod chains;
mod check_configurations;
mod check_dynamics;
mod check_tables;
mod ci_output;
mod clearance_goldens;
mod clearance_pairs;
mod command;
mod comparing;
mod conversions;
mod corpus;
mod default_checks;
mod describe;
mod diagnosis;
mod diagnosis_chains;
mod dynamics_causes;
mod dynamics_goldens;
mod escapes;
mod faults;
mod fence;
mod forward_goldens;
mod frames;
mod golden;
mod interruptions;
mod jacobian_goldens;
mod joint_losses;
mod joint_origins;
#[cfg(target_os = "linux")]
mod large_inputs;
mod lint;
mod lint_broken;
mod long_chains;
mod machine_faults;
mod mimics;
mod new_files;
mod pages;
mod pairing;
mod planted_dynamics;
#[cfg(feature = "recording")]
mod recordings;
mod resuming;
mod robots;
mod safety;
mod same_everywhere;
mod scenarios;
mod schemas;
mod servo;
mod snapshots;
mod special_inputs;
mod suggestions;
mod terminal;
mod trajectories;
mod uses;
mod warnings;
