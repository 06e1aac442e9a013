//! The Python package `congruent`: the library for numpy arrays, and the command.
//!
//! This crate converts between Python and the library, and computes nothing: arrays are in `array/`, robots in `robot/`, what an engine has loaded in
//! `loaded/`, transforms in
//! `spatial.rs`, reports in `report/`. The Python part is in `python/congruent`; its `_native.pyi` has the types and the documentation of what is here.

mod array;
mod command;
mod error;
mod interrupt;
mod loaded;
mod options;
mod report;
mod robot;
mod spatial;

use pyo3::prelude::*;

/// What `python/congruent/__init__.py` exports.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::{
        command::run_command,
        loaded::{identified_screws, loaded_robot, robot_of_screws},
        report::{PythonReport, check, run},
        robot::PythonRobot,
        spatial::{
            adjoint, dh_row, dh_transform, elementary, euler_angles, euler_rotation, exp_of_rotation,
            log_of_rotation, tool_pose, twist_exp, twist_log, twist_matrix,
        },
    };
}
