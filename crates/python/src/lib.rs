//! The Python package `congruent`: the library for numpy arrays, and the command.
//!
//! This crate converts between Python and the library, and computes nothing: arrays are in `array/`, robots in `robot/`, reports in
//! `report/`. The Python part is in `python/congruent`; its `_native.pyi` has the types and the documentation of what is here.

mod array;
mod command;
mod error;
mod interrupt;
mod options;
mod report;
mod robot;

use pyo3::prelude::*;

/// What `python/congruent/__init__.py` exports.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::{
        command::run_command,
        report::{PythonReport, check, run},
        robot::PythonRobot,
    };
}
