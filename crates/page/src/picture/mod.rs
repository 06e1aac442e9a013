//! A picture of the arm: links as lines between the frames of the joints, in SVG.

mod camera;
mod figure;
mod skeleton;
mod svg;

pub(crate) use figure::{DrawnArm, Figure, PictureBody, TwoArms};
pub(crate) use skeleton::{Skeleton, corners, shapes};
