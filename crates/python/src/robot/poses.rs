//! Forward kinematics: poses as homogeneous matrices.

use congruent::{
    input::Diagnostic,
    kinematics::{KinematicsError, Pose},
};
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{columns::JointColumns, frame::MovedFrame};
use crate::array::{JointRows, filled_array};

/// Rows of a block: their poses fit into the second cache of a core. Kind: choice.
const ROWS: usize = 1024;

/// Numbers of a homogeneous matrix.
const ENTRIES: usize = 16;

/// The pose `base_from_frame` of each row.
pub(super) fn poses<'py>(
    py: Python<'py>,
    frame: &MovedFrame,
    columns: &JointColumns,
    q: &JointRows<'py>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let (batch, values, n) = (q.batch(), q.values(), columns.count());
    filled_array(py, batch, &[4, 4], ROWS, || {
        let (mut memory, mut base_from_tips) = (Vec::new(), vec![Pose::identity(); ROWS.min(batch.rows())]);
        move |rows, out| {
            let base_from_tips = &mut base_from_tips[..rows.len()];
            let of_chain = frame.positions(&values[n * rows.start..n * rows.end], n, &mut memory);
            frame.chain.base_from_tips_into(of_chain, base_from_tips).map_err(|error| wrong_count(&error))?;
            let (matrices, _) = out.as_chunks_mut::<ENTRIES>();
            for (base_from_tip, matrix) in base_from_tips.iter().zip(matrices) {
                match &frame.link_from_frame {
                    None => *matrix = homogeneous(base_from_tip),
                    Some(link_from_frame) => *matrix = homogeneous(&(*base_from_tip * *link_from_frame)),
                }
            }
            Ok(())
        }
    })
}

/// A pose as a matrix, row after row, as numpy has it.
fn homogeneous(pose: &Pose) -> [f64; ENTRIES] {
    let (r, p) = (&pose.rotation, &pose.translation);
    [
        r.m11, r.m12, r.m13, p.x, //
        r.m21, r.m22, r.m23, p.y, //
        r.m31, r.m32, r.m33, p.z, //
        0.0, 0.0, 0.0, 1.0,
    ]
}

/// The lengths were checked when the arguments were read, so this is a fault of this crate, which is reported all the same.
pub(super) fn wrong_count(error: &KinematicsError) -> Diagnostic {
    Diagnostic::error(congruent::codes::python::ARRAY, error.to_string())
}
