//! An obstacle that moves, as data.

use congruent_description::LinkIndex;
use nalgebra::Isometry3;

/// An obstacle that moves.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingBody {
    /// Its number among the obstacles.
    pub obstacle: usize,
    /// Motion of the body: along a path, or carried by links.
    pub track: BodyTrack,
}

/// How an obstacle moves.
#[derive(Debug, Clone, PartialEq)]
pub enum BodyTrack {
    /// Along a path: at least one pose, each later than the one before. It is at the first before its time, and at
    /// the last after it; between two it goes straight and turns evenly.
    Path(Vec<PathPose>),
    /// With links that carry it for a time, one after another; between these it is at rest where it was put down.
    Grasps(Vec<Grasp>),
}

/// A pose on the path of an obstacle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPose {
    /// When it is there.
    pub at_s: f64,
    /// Its pose in the root link's frame.
    pub world_from_obstacle: Isometry3<f64>,
}

/// The time in which a link carries a body. It keeps the pose that it has in the link at the beginning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grasp {
    /// Index of the link that carries the body.
    pub link: LinkIndex,
    /// The link carries it from this time on.
    pub from_s: f64,
    /// The link releases it at this time; infinity for never.
    pub until_s: f64,
}

/// The pose on a path at a time.
pub(super) fn on_path(path: &[PathPose], time_s: f64) -> Isometry3<f64> {
    // Before the first pose `next` is 0, after the last one there is no next: both ends hold.
    let next = path.partition_point(|pose| pose.at_s <= time_s);
    let before = path[next.saturating_sub(1)];
    let Some(after) = path.get(next).filter(|_| next > 0) else { return before.world_from_obstacle };
    let share = (time_s - before.at_s) / (after.at_s - before.at_s);
    let (from, to) = (before.world_from_obstacle, after.world_from_obstacle);
    let position = from.translation.vector.lerp(&to.translation.vector, share);
    // The shortest turn at constant speed; a blend of the quaternions would turn faster in the middle.
    let turn = from.rotation.rotation_to(&to.rotation).powf(share);
    Isometry3::from_parts(position.into(), turn * from.rotation)
}

#[cfg(test)]
mod tests {
    use nalgebra::{UnitQuaternion, Vector3};

    use super::*;

    #[test]
    fn it_is_at_rest_before_and_after_and_goes_evenly_between() {
        let pose = |at_s, x, turn_rad| PathPose {
            at_s,
            world_from_obstacle: Isometry3::new(Vector3::new(x, 0.0, 0.0), Vector3::z() * turn_rad),
        };
        let path = [pose(1.0, 0.0, 0.0), pose(2.0, 1.0, 1.0), pose(4.0, 1.0, -1.0)];
        for (time_s, x, turn_rad) in [
            (0.0, 0.0, 0.0),
            (1.0, 0.0, 0.0),
            (1.25, 0.25, 0.25),
            (2.0, 1.0, 1.0),
            (3.0, 1.0, 0.0),
            (9.0, 1.0, -1.0),
        ] {
            let found = on_path(&path, time_s);
            let turn = UnitQuaternion::from_scaled_axis(Vector3::z() * turn_rad);
            assert!(
                (found.translation.vector.x - x).abs() < 1e-15 && found.rotation.angle_to(&turn) < 1e-7,
                "{time_s}"
            );
        }
    }
}
