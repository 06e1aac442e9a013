//! Robots that no file describes: what an engine has loaded, and what the poses of a function show.

mod model;
mod poses;
mod rounding;

pub(crate) use model::loaded_robot;
pub(crate) use poses::{identified_screws, robot_of_screws};
