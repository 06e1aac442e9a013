//! How far two bodies overlap: the shortest shift that separates them.
//!
//! Along any direction the overlap is at least the depth. Two boxes have it along one of 15 axes; other bodies are searched
//! from many directions, so that a depth is never too shallow.

use nalgebra::{Isometry3, Vector3};

use super::separation::{direction, nearest_to_origin};

/// An overlap of two bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Penetration {
    /// Shift of the second body along `along` that separates them.
    pub depth_m: f64,
    /// Unit vector, in the frame of the first body.
    pub along: Vector3<f64>,
}

/// Two edges this parallel have no axis of their own: the faces beside them are nearer than rounding.
const PARALLEL: f64 = 1e-9;

/// Stop of the descent. Kind: solver stop, well below the error of a distance (1e-7 m).
const STOP_M: f64 = 1e-10;

/// Each step turns the direction to that of the nearest point; hulls end after a few.
const MOST_STEPS: usize = 100;

/// The depth of two boxes by the theorem of separating axes: the faces of both, and each edge of one with each of the other.
pub(super) fn depth_of_boxes(halves: [&Vector3<f64>; 2], a_from_b: &Isometry3<f64>) -> Penetration {
    let turn = a_from_b.rotation.to_rotation_matrix();
    let shift = &a_from_b.translation.vector;
    let axes_of_a = [Vector3::x(), Vector3::y(), Vector3::z()];
    let axes_of_b = axes_of_a.map(|axis| turn * axis);
    let edges = axes_of_a.iter().flat_map(|a| axes_of_b.iter().map(|b| a.cross(b)));
    let across = edges.filter_map(|axis| axis.try_normalize(PARALLEL));
    let overlaps = axes_of_a.into_iter().chain(axes_of_b).chain(across).map(|axis| {
        // Away from the first box, towards the nearer side.
        let along = if shift.dot(&axis) < 0.0 { -axis } else { axis };
        let in_b = turn.inverse() * along;
        let reach_m = along.abs().dot(halves[0]) + in_b.abs().dot(halves[1]);
        Penetration { depth_m: reach_m - shift.dot(&along), along }
    });
    overlaps.min_by(|a, b| a.depth_m.total_cmp(&b.depth_m)).expect("a box has three faces")
}

/// The overlap along a direction of the difference `{b - a}` of two bodies, given by its lowest points.
pub(super) fn overlap_along(
    lowest: impl Fn(&Vector3<f64>) -> Vector3<f64>,
    along: Vector3<f64>,
) -> Penetration {
    Penetration { depth_m: -lowest(&along).dot(&along), along }
}

/// The least overlap that is found from any of the directions.
pub(super) fn least_overlap(
    lowest: impl Fn(&Vector3<f64>) -> Vector3<f64>,
    starts: impl IntoIterator<Item = Vector3<f64>>,
) -> Option<Penetration> {
    let descents = starts.into_iter().map(|start| descend(&lowest, overlap_along(&lowest, start)));
    descents.min_by(|a, b| a.depth_m.total_cmp(&b.depth_m))
}

/// Turns a direction until the overlap along it no longer decreases.
///
/// The second body is shifted along the direction until it is `overlap + margin` away. The vector between the nearest points
/// is then the next direction: along it the overlap is at most `(overlap + margin) cos(turn) - margin`.
fn descend(lowest: impl Fn(&Vector3<f64>) -> Vector3<f64>, start: Penetration) -> Penetration {
    let mut least = start;
    for _ in 0..MOST_STEPS {
        let shift = least.along * (2.0 * least.depth_m.max(STOP_M));
        let shifted = |along: &Vector3<f64>| lowest(along) + shift;
        let nearest = nearest_to_origin(shifted, shifted(&least.along)).nearest;
        let next = overlap_along(&lowest, direction(&nearest));
        if next.depth_m > least.depth_m - STOP_M {
            break;
        }
        least = next;
    }
    least
}
