//! Where the camera stands so that this robot fills the picture.

use congruent_description::Geometry;
use congruent_simulation::Obstacle;
use nalgebra::{Point3, Vector3};

/// Around the link origins: the flesh of the links, which the origins do not show.
const MARGIN_M: f64 = 0.12;
/// Obstacles count as far as this beyond the robot's own bounds, as a part of their diagonal: a
/// floor of ten metres must not make the robot a dot.
const OBSTACLE_REACH: f64 = 0.2;
/// Half of the viewer's vertical field of view, 55 degrees.
const HALF_VIEW_RAD: f64 = 0.479_965_544;
/// From the side of the work, seen a little from above.
const SIDEWAYS_RAD: f64 = -0.95;
const ELEVATION_RAD: f64 = 0.42;
/// The bounding ball need not be in the picture whole: arms are slim.
const BALL_SHARE: f64 = 0.86;

/// The box that everything seen so far fits into.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    low: Point3<f64>,
    high: Point3<f64>,
}

impl Bounds {
    /// Nothing seen.
    pub(super) fn nothing() -> Self {
        Self {
            low: Point3::from(Vector3::repeat(f64::INFINITY)),
            high: Point3::from(Vector3::repeat(f64::NEG_INFINITY)),
        }
    }

    /// Takes a point in; what is no number is left out.
    pub(super) fn include(&mut self, point: &Point3<f64>) {
        if point.coords.iter().all(|coordinate| coordinate.is_finite()) {
            self.low = self.low.inf(point);
            self.high = self.high.sup(point);
        }
    }

    /// The bounds of the robot with those parts of the obstacles that are near.
    fn with_obstacles(self, obstacles: &[Obstacle]) -> Self {
        let reach = MARGIN_M + OBSTACLE_REACH * (self.high - self.low).norm();
        let near = self.grown(reach);
        let mut all = self.grown(MARGIN_M);
        for obstacle in obstacles {
            let half = half_size(&obstacle.geometry);
            for corner in 0..8_u8 {
                let sign = |bit: u8| if corner & (1 << bit) == 0 { -1.0 } else { 1.0 };
                let corner = Point3::from(half.component_mul(&Vector3::new(sign(0), sign(1), sign(2))));
                let corner_in_world = obstacle.world_from_obstacle * corner;
                all.include(&corner_in_world.sup(&near.low).inf(&near.high));
            }
        }
        all
    }

    fn grown(self, margin_m: f64) -> Self {
        let margin = Vector3::repeat(margin_m);
        Self { low: self.low - margin, high: self.high + margin }
    }
}

/// Half the edges of a box about the shape's origin that contains it.
fn half_size(geometry: &Geometry) -> Vector3<f64> {
    match geometry {
        Geometry::Box { size_m } => size_m / 2.0,
        Geometry::Cylinder { radius_m, length_m } => Vector3::new(*radius_m, *radius_m, length_m / 2.0),
        Geometry::Sphere { radius_m } => Vector3::repeat(*radius_m),
        Geometry::Mesh(mesh) => {
            mesh.vertices_m.iter().fold(Vector3::zeros(), |half, vertex| half.sup(&vertex.coords.abs()))
        }
    }
}

/// A place to look from and a place to look at, in the root link's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Camera {
    /// Where the eye is.
    pub(super) eye_in_world: Point3<f64>,
    /// What is in the middle of the picture.
    pub(super) target_in_world: Point3<f64>,
}

impl Camera {
    /// Frames what was seen. `work_in_world` is the middle of the tool's way: the camera stands
    /// beside it, so that the arm does not hide what it does.
    pub(super) fn framing(seen: Bounds, obstacles: &[Obstacle], work_in_world: &Point3<f64>) -> Self {
        if seen.low.x > seen.high.x {
            let eye_in_world = Point3::new(1.5, -1.5, 1.0);
            return Self { eye_in_world, target_in_world: Point3::origin() };
        }
        let bounds = seen.with_obstacles(obstacles);
        let target_in_world = nalgebra::center(&bounds.low, &bounds.high);
        let radius = (bounds.high - bounds.low).norm() / 2.0;
        let distance = BALL_SHARE * radius / HALF_VIEW_RAD.sin();
        let is_ahead = work_in_world.coords.xy().norm() > MARGIN_M;
        let work_rad = if is_ahead { work_in_world.y.atan2(work_in_world.x) } else { 0.0 };
        let (sin, cos) = (work_rad + SIDEWAYS_RAD).sin_cos();
        let (up, level) = ELEVATION_RAD.sin_cos();
        let direction = Vector3::new(cos * level, sin * level, up);
        Self { eye_in_world: target_in_world + direction * distance, target_in_world }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::*;

    fn arm() -> Bounds {
        let mut bounds = Bounds::nothing();
        bounds.include(&Point3::origin());
        bounds.include(&Point3::new(0.6, 0.0, 0.8));
        bounds
    }

    #[test]
    fn a_wide_floor_does_not_push_the_camera_away() {
        let floor = Obstacle {
            name: "floor".to_owned(),
            world_from_obstacle: Isometry3::translation(0.0, 0.0, -0.01),
            geometry: Geometry::Box { size_m: Vector3::new(100.0, 100.0, 0.02) },
        };
        let near = Camera::framing(arm(), &[floor], &Point3::new(0.5, 0.0, 0.3));
        assert!((near.eye_in_world - near.target_in_world).norm() < 4.0, "{near:?}");
    }

    #[test]
    fn nothing_seen_still_gives_a_camera() {
        let mut bounds = Bounds::nothing();
        bounds.include(&Point3::new(f64::NAN, 0.0, 0.0));
        let camera = Camera::framing(bounds, &[], &Point3::new(f64::NAN, 0.0, 0.0));
        assert!(camera.eye_in_world.coords.iter().all(|coordinate| coordinate.is_finite()));
    }
}
