//! Reports as text for people: what the command `congruent` prints, and a program or a test framework may print the same. The
//! functions only make text; nothing is written.
//!
//! Each takes the report. [`TextOptions`] says how wide the terminal is and whether it has colours, and
//! [`TextOptions::for_terminal`] is the last step before one. The text of a check is with the check, in crate `congruent`.

mod arm;
mod base_parameters;
mod calibrated_robot;
mod calibration;
mod conversion;
mod description;
mod fault_table;
mod findings;
mod identification;
pub mod layout;
mod lint;
mod log;
mod new_files;
mod options;
#[cfg(feature = "recording")]
mod recording;
mod run;
mod same_point;
mod sweep;
mod watch;

pub use arm::{
    clearance_text_parts, disabled_pairs_text, forward_text_parts, inverse_text, jacobian_text_parts,
    joint_dynamics_text_parts, manipulability_text_parts, sensitivity_text, tolerances_line, tolerances_text,
    workspace_text,
};
pub use base_parameters::base_parameters_text;
pub use calibrated_robot::{calibrated_robot_comments, camera_text, same_point_robot_comments};
pub use calibration::calibration_text;
pub use conversion::{conversion_comments, conversion_remarks, conversion_text};
pub use description::{description_text, joint_orders_text};
pub use fault_table::fault_table_text;
pub use findings::{MOST_FINDINGS, finding_line, finding_text, listed_findings};
pub use identification::{identification_text, term_name};
pub use lint::lint_text;
pub use log::log_text;
pub use new_files::{new_robot_text, new_scenario_text};
pub use options::TextOptions;
#[cfg(feature = "recording")]
pub use recording::{disagreement_sentence, rechecked_text, recording_text};
pub use run::run_text;
pub use same_point::same_point_text;
pub use sweep::{sweep_progress_text, sweep_text};
pub use watch::watch_text;
