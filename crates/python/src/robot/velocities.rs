//! Jacobians: the velocity of a frame for a unit velocity of each joint.

use congruent::{
    analysis::jacobians::JacobianKind,
    description::ChainQ,
    kinematics::{Pose, Twist},
};
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::{
    columns::{FollowedColumn, JointColumns},
    frame::MovedFrame,
    poses::wrong_count,
};
use crate::array::{JointRows, filled_array};

/// Rows of a block. Kind: choice; a fraction of a millisecond.
const ROWS: usize = 256;

/// Rows of a Jacobian: angular, then linear.
const ENTRIES: usize = 6;

/// The Jacobian of the frame at each row, with a column for each driven joint.
pub(super) fn jacobians<'py>(
    py: Python<'py>,
    frame: &MovedFrame,
    columns: &JointColumns,
    kind: JacobianKind,
    q: &JointRows<'py>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let (batch, values, n) = (q.batch(), q.values(), columns.count());
    filled_array(py, batch, &[ENTRIES, n], ROWS, || {
        let (mut memory, mut positions) = (Vec::new(), ChainQ::zeros(frame.chain.joint_count()));
        let mut twists = vec![Twist::zero(); frame.chain.joint_count()];
        move |rows, out| {
            for (row, out) in rows.zip(out.chunks_mut(ENTRIES * n)) {
                let of_chain = frame.positions(&values[n * row..n * (row + 1)], n, &mut memory);
                positions.copy_from_slice(of_chain);
                let base_from_link = frame.chain.pose_and_jacobian_into(&positions, kind, &mut twists);
                let base_from_link = base_from_link.map_err(|error| wrong_count(&error))?;
                if let Some(link_from_frame) = &frame.link_from_frame {
                    let moved =
                        |twist: &mut Twist| *twist = at_frame(twist, kind, &base_from_link, link_from_frame);
                    twists.iter_mut().for_each(moved);
                }
                add_columns(&twists, frame.follows(), out);
            }
            Ok(())
        }
    })
}

/// Adds the columns of the joints of the chain to those of the driven joints. Joints that follow one driven joint add up in its
/// column, each times its multiplier (chain rule).
fn add_columns(twists: &[Twist], follows: &[FollowedColumn], out: &mut [f64]) {
    let n = out.len() / ENTRIES;
    for (twist, follows) in twists.iter().zip(follows) {
        for (entry, value) in twist.angular.iter().chain(&twist.linear).enumerate() {
            out[entry * n + follows.column] += follows.multiplier * value;
        }
    }
}

/// A column for a link as that for a frame on the link.
fn at_frame(twist: &Twist, kind: JacobianKind, base_from_link: &Pose, link_from_frame: &Pose) -> Twist {
    match kind {
        // Axes and reference point are those of the base, wherever on the body the frame is.
        JacobianKind::Space => *twist,
        JacobianKind::Body => twist.transformed_by(&link_from_frame.inverse()),
        JacobianKind::Geometric => {
            // v_frame = v_link + w x r, with r from the origin of the link to that of the frame.
            let to_frame_in_base = base_from_link.rotation * link_from_frame.translation;
            Twist { angular: twist.angular, linear: twist.linear + twist.angular.cross(&to_frame_in_base) }
        }
    }
}
