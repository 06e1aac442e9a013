//! A robot for Python: one file for each question, `class.rs` has the class.

mod class;
mod columns;
mod dynamics;
mod frame;
mod inverse;
mod load;
mod motions;
mod parameters;
mod poses;
mod velocities;

pub(crate) use class::PythonRobot;
pub(crate) use load::{access, from_path};
