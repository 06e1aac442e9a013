//! Functions of joint positions and speeds, and their largest values over a box: from below by climbing, from above by
//! dividing it.

pub(super) mod branch;
pub(super) mod climb;
pub(super) mod measure;
pub(super) mod speeds;
pub(super) mod trigonometric;
