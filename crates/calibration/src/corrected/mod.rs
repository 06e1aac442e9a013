//! The calibrated robot: the nominal one with its corrections in the table, in the joints of the tree, and in base and tool.
//!
//! With `E_k` the product of the corrections of slot k, the corrected chain is again one of screws, exactly:
//! `S_k' = Ad(E_0 ... E_{k-1}) S_k` and `M' = E_0 ... E_n M`. Nothing is approximated here.

mod corrected_robot;
mod joint_on_screw;
mod table;
mod tree;

pub(crate) use corrected_robot::robot_with;
pub use corrected_robot::{CorrectedRobot, corrected_robot};
