//! Motions of the joints: a move, a path of many points, the playback of a file.

pub(super) mod joint_move;
pub(super) mod joint_path;
pub(super) mod playback;
mod table;

pub use table::JointTable;
