//! Two descriptions of a robot in the same variables: which joint of one is which of the other, in which direction it moves, and
//! where it has its zero.
//!
//! A mapping is found by names or by the order along the chain, with the axes of the joints as proof ([`find`]). The
//! other description is then rewritten in the variables (`Robot::in_variables`) and the link frames ([`in_frames_of`]) of the
//! robot, and everything that compares two descriptions works on it.

mod axis;
mod bodies;
mod changed_values;
mod common_joints;
mod compared_robot;
mod corrections;
mod declared;
mod digits;
mod drivers;
mod find;
mod frames;
mod fused_links;
mod link_names;
mod matched;
mod names;
mod polish;
mod rounded_values;
mod shared_ends;
mod variables;

pub use changed_values::{ChangedValue, JointRange, changed_inertias, changed_values, is_same_value};
pub use common_joints::{common_tip, other_joint};
pub use corrections::{ComparedAt, ExplainedByJoints, JointCorrection, JointPart, explained_by_joints};
pub use declared::declared;
pub use digits::{free_frame, with_fitted, with_fitted_base};
pub use drivers::driven_as_in;
pub use find::{FoundMapping, MatchedBy, find, find_exchanged};
pub use frames::{CommonAxes, EndInOtherFrames, ends_in_other_frames, has_other_frames, in_frames_of};
pub use fused_links::{FusedLinks, with_masses_at_links_of};
pub use link_names::{link_names, same_link, with_other_still_links};
pub use matched::MatchedRobots;
pub use rounded_values::{
    DigitsOfFrames, inertia_within_digits, is_rounded_value, with_values_within_digits,
};
