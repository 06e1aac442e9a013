//! Names of columns in the table that a run writes, for those who write it and those who read it.

/// The column of time.
pub const TIME: &str = "time_s";
/// The column of the number of physics steps.
pub const STEP: &str = "step";
/// Columns of the worst value of a sample, each with the column of the link or pair that has it.
pub const WORST: [[&str; 2]; 3] = [
    ["position_error_m", "position_error_link"],
    ["orientation_error_rad", "orientation_error_link"],
    ["clearance_m", "clearance_pair"],
];
/// A joint's position, in columns `JOINT.q_rad` and `JOINT.q_m`.
pub const POSITION: &str = "q";

/// Whether a column is one that runs write in addition to positions: `joint.qd_rad_s`, `clearance_m`.
pub fn is_other_quantity(name: &str) -> bool {
    let is_dotted = name.split_once('.').is_some_and(|(_, quantity)| !quantity.starts_with("q_"));
    is_dotted || name == STEP || WORST.as_flattened().contains(&name)
}
