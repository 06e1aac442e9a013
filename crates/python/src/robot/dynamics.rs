//! Torques, mass matrices and accelerations of each row, by the equations of motion.

use congruent::{
    analysis::dynamics::refused,
    description::RobotQ,
    dynamics::{BodyTree, DrivenState, JointMotions},
    nalgebra::DMatrix,
};
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{
    columns::JointColumns,
    motions::{MotionRows, RowMemory},
};
use crate::array::{BatchShape, JointRows, filled_array};

/// Rows of a block. Kind: choice; less than a millisecond.
const ROWS: usize = 256;

/// Torques of the motion of each row.
pub(super) fn inverse<'py>(
    py: Python<'py>,
    tree: &BodyTree,
    columns: &JointColumns,
    motions: MotionRows<'_>,
    batch: BatchShape,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let (n, moving) = (columns.count(), columns.moving());
    filled_array(py, batch, &[n], ROWS, || {
        let (mut memory, mut buffer, mut tau) = (RowMemory::default(), tree.batch_buffer(), Vec::new());
        move |rows, out| {
            let count = rows.len();
            let joints = motions.of_moving(rows, &mut memory);
            tau.resize(count * moving, 0.0);
            let of_moving = JointMotions { q: joints.q, qd: joints.qd, qdd: joints.third };
            tree.inverse_many_into(&of_moving, &mut buffer, &mut tau).map_err(|error| refused(&error))?;
            for (tau, out) in tau.chunks(moving).zip(out.chunks_mut(n)) {
                columns.fold_into(tau, out);
            }
            Ok(())
        }
    })
}

/// The mass matrix of each row: `G' M G` of the driven joints.
pub(super) fn mass_matrices<'py>(
    py: Python<'py>,
    tree: &BodyTree,
    columns: &JointColumns,
    q: &JointRows<'py>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let (values, n, moving) = (q.values(), columns.count(), columns.moving());
    filled_array(py, q.batch(), &[n, n], ROWS, || {
        let (mut memory, mut buffer) = (Vec::new(), tree.buffer());
        let (mut positions, mut matrix) = (RobotQ::zeros(moving), DMatrix::zeros(moving, moving));
        move |rows, out| {
            for (row, out) in rows.zip(out.chunks_mut(n * n)) {
                columns.positions_into(&values[n * row..n * (row + 1)], &mut memory);
                positions.copy_from_slice(&memory);
                let computed = tree.mass_matrix_into(&positions, &mut buffer, &mut matrix);
                computed.map_err(|error| refused(&error))?;
                add_folded(&matrix, columns, out);
            }
            Ok(())
        }
    })
}

/// Adds `G' M G` to a matrix of the driven joints, with the ratios of the followers in `G`.
fn add_folded(matrix: &DMatrix<f64>, columns: &JointColumns, out: &mut [f64]) {
    for (column, one) in matrix.column_iter().zip(columns.follows()) {
        for (entry, other) in column.iter().zip(columns.follows()) {
            out[columns.count() * other.column + one.column] += one.multiplier * other.multiplier * entry;
        }
    }
}

/// Accelerations of each row under its torques.
pub(super) fn forward<'py>(
    py: Python<'py>,
    tree: &BodyTree,
    columns: &JointColumns,
    motions: MotionRows<'_>,
    batch: BatchShape,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let (n, moving) = (columns.count(), columns.moving());
    filled_array(py, batch, &[n], ROWS, || {
        let (mut memory, mut buffer) = (RowMemory::default(), tree.buffer());
        let (mut positions, mut qdd) = (RobotQ::zeros(moving), vec![0.0; moving]);
        move |rows, out| {
            for (row, out) in rows.zip(out.chunks_mut(n)) {
                let joints = motions.of_moving(row..row + 1, &mut memory);
                positions.copy_from_slice(joints.q);
                let state = DrivenState { q: &positions, qd: joints.qd, tau: joints.third };
                tree.forward_into(&state, &mut buffer, &mut qdd).map_err(|error| refused(&error))?;
                for (out, &coordinate) in out.iter_mut().zip(columns.driven()) {
                    *out = qdd[coordinate];
                }
            }
            Ok(())
        }
    })
}
