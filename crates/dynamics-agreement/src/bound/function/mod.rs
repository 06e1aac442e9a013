//! Functions of joint positions and speeds, and bounds of their largest values over a box: from below by coordinate search,
//! from above by branch and bound.

pub(super) mod branch;
pub(super) mod local_search;
pub(super) mod measure;
pub(super) mod one_by_one;
pub(super) mod speeds;
pub(super) mod trigonometric;
