//! What is recorded once, before the first sample: shapes, colours and names; and the camera that frames
//! them.

pub(crate) mod camera;
pub(crate) mod frames;
pub(crate) mod palette;
pub(crate) mod shapes;
pub(crate) mod styles;
pub(crate) mod visual;
