//! Studies of an arm as text for people.

mod clearance;
mod disabled_pairs;
mod dynamics;
mod forward;
mod inverse;
mod jacobian;
mod manipulability;
mod sensitivity;
mod tolerances;
mod workspace;

pub use clearance::clearance_text_parts;
pub use disabled_pairs::disabled_pairs_text;
pub use dynamics::joint_dynamics_text_parts;
pub use forward::forward_text_parts;
pub use inverse::inverse_text;
pub use jacobian::jacobian_text_parts;
pub use manipulability::manipulability_text_parts;
pub use sensitivity::sensitivity_text;
pub use tolerances::{tolerances_line, tolerances_text};
pub use workspace::workspace_text;
