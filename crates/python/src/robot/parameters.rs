//! The inertial parameters in which torques are linear: the regressor, their names and values, and those that are identifiable.

use congruent::{
    analysis::{base_parameters::BaseParameterReport, dynamics::refused},
    description::{Robot, RobotQ},
    dynamics::{BodyTree, JointMotionState, PARAMETER_NAMES, PARAMETERS},
    nalgebra::DMatrix,
};
use numpy::PyArrayDyn;
use pyo3::{
    prelude::*,
    types::{PyDict, PyList},
};

use super::{
    columns::JointColumns,
    motions::{MotionRows, RowMemory},
};
use crate::array::{BatchShape, filled_array};

/// Rows of a block. Kind: choice; a millisecond.
const ROWS: usize = 64;

/// The Python module of the classes of results.
const MODULE: &str = "congruent._results";

/// Names of the parameters, as the regressor has them: `joint.ixx`.
pub(super) fn parameter_names(robot: &Robot) -> Vec<String> {
    let joints = robot.movable_joints().iter().map(|&joint| &robot.joint(joint).name);
    joints.flat_map(|joint| PARAMETER_NAMES.map(|parameter| format!("{joint}.{parameter}"))).collect()
}

/// The regressor of each row: torques of the driven joints for a unit of each parameter of all bodies.
pub(super) fn regressors<'py>(
    py: Python<'py>,
    tree: &BodyTree,
    columns: &JointColumns,
    motions: MotionRows<'_>,
    batch: BatchShape,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let (n, moving) = (columns.count(), columns.moving());
    let parameters = PARAMETERS * moving;
    filled_array(py, batch, &[n, parameters], ROWS, || {
        let (mut memory, mut buffer) = (RowMemory::default(), tree.buffer());
        let (mut positions, mut matrix) = (RobotQ::zeros(moving), DMatrix::zeros(moving, parameters));
        move |rows, out| {
            for (row, out) in rows.zip(out.chunks_mut(n * parameters)) {
                let joints = motions.of_moving(row..row + 1, &mut memory);
                positions.copy_from_slice(joints.q);
                let motion = JointMotionState { q: &positions, qd: joints.qd, qdd: joints.third };
                let computed = tree.regressor_into(&motion, &mut buffer, &mut matrix);
                computed.map_err(|error| refused(&error))?;
                add_folded(&matrix, columns, out);
            }
            Ok(())
        }
    })
}

/// Adds the rows of all moving joints to those of the driven ones: the torque of a follower acts on its master, times the ratio.
fn add_folded(matrix: &DMatrix<f64>, columns: &JointColumns, out: &mut [f64]) {
    let parameters = matrix.ncols();
    for (of_joint, follows) in matrix.row_iter().zip(columns.follows()) {
        let out = &mut out[parameters * follows.column..][..parameters];
        for (out, entry) in out.iter_mut().zip(&of_joint) {
            *out += follows.multiplier * entry;
        }
    }
}

/// The identifiable sums as instances of `congruent.BaseParameter`.
pub(super) fn base_parameters<'py>(
    py: Python<'py>,
    report: &BaseParameterReport,
) -> PyResult<Bound<'py, PyList>> {
    let class = py.import(MODULE)?.getattr("BaseParameter")?;
    let list = PyList::empty(py);
    for sum in &report.base_parameters {
        let name = |of: &congruent::analysis::base_parameters::NamedParameter| {
            format!("{}.{}", of.joint, of.parameter)
        };
        let grouped = PyDict::new(py);
        for added in &sum.grouped {
            grouped.set_item(name(&added.of), added.coefficient)?;
        }
        list.append(class.call1((name(&sum.of), sum.value, sum.unit, grouped))?)?;
    }
    Ok(list)
}
