//! Where the camera stands so that this robot fills the picture.

use congruent_description::Geometry;
use congruent_simulation::Obstacle;
use nalgebra::{Point3, Vector3};

/// Around the link origins: the flesh of the links, which the origins do not show.
const MARGIN_M: f64 = 0.12;
/// Obstacles count as far as this beyond the robot's own bounds, as a part of their diagonal: a
/// floor of ten metres must not make the robot a dot.
const OBSTACLE_REACH: f64 = 0.05;
/// Half of the viewer's vertical field of view, 55 degrees.
const HALF_VIEW_RAD: f64 = 0.479_965_544;
/// Where around the work the camera may stand, measured from the direction of the work: the first
/// is best where nothing is in the way, from behind is last.
const AROUND_RAD: [f64; 8] = [-0.95, 0.95, -0.45, 0.45, -1.6, 1.6, -2.3, 2.3];
/// Above the work by this angle.
const ELEVATION_RAD: f64 = 0.42;
/// The bounding ball need not be in the picture whole: arms are slim.
const BALL_SHARE: f64 = 0.7;
/// Points that stand for the tool's way.
const MOST_POINTS: usize = 64;

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
    /// Frames what was seen, from a side from where the tool's way is hidden least.
    pub(super) fn framing(seen: Bounds, obstacles: &[Obstacle], way_in_world: &[Point3<f64>]) -> Self {
        if seen.low.x > seen.high.x {
            let eye_in_world = Point3::new(1.5, -1.5, 1.0);
            return Self { eye_in_world, target_in_world: Point3::origin() };
        }
        let bounds = seen.with_obstacles(obstacles);
        let target_in_world = nalgebra::center(&bounds.low, &bounds.high);
        let radius = (bounds.high - bounds.low).norm() / 2.0;
        let distance = BALL_SHARE * radius / HALF_VIEW_RAD.sin();
        let work = way_in_world.iter().fold(Vector3::zeros(), |sum: Vector3<f64>, point| sum + point.coords);
        let work_rad = if work.xy().norm() > 0.0 { work.y.atan2(work.x) } else { 0.0 };
        let (up, level) = ELEVATION_RAD.sin_cos();
        let from = |around_rad: f64| {
            let (sin, cos) = (work_rad + around_rad).sin_cos();
            target_in_world + Vector3::new(cos * level, sin * level, up) * distance
        };
        let hidden = |eye: &Point3<f64>| {
            let is_hidden =
                |point: &&Point3<f64>| obstacles.iter().any(|obstacle| hides(obstacle, eye, point));
            way_in_world.iter().filter(is_hidden).count()
        };
        let eyes = AROUND_RAD.map(from);
        let eye_in_world = eyes.into_iter().min_by_key(hidden).expect("there are places to stand");
        Self { eye_in_world, target_in_world }
    }
}

/// Whether the box around an obstacle stands between the eye and a point.
fn hides(obstacle: &Obstacle, eye_in_world: &Point3<f64>, point_in_world: &Point3<f64>) -> bool {
    let half = half_size(&obstacle.geometry);
    let eye = obstacle.world_from_obstacle.inverse_transform_point(eye_in_world);
    let way = obstacle.world_from_obstacle.inverse_transform_point(point_in_world) - eye;
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..3 {
        let [a, b] = [-half[axis], half[axis]].map(|side| (side - eye[axis]) / way[axis]);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    // The last bit does not count: a tool that touches a box is not behind it.
    enter < leave.min(0.99)
}

/// Points along a way of any length, evenly thinned.
#[derive(Debug, Default)]
pub(super) struct Thinned {
    points: Vec<Point3<f64>>,
    /// Of so many points, one is kept; 0 stands for 1.
    stride: usize,
    skipped: usize,
}

impl Thinned {
    /// Adds a point.
    pub(super) fn push(&mut self, point: Point3<f64>) {
        self.skipped += 1;
        if self.skipped < self.stride {
            return;
        }
        self.skipped = 0;
        if self.points.len() == MOST_POINTS {
            let mut is_kept = false;
            self.points.retain(|_| {
                is_kept = !is_kept;
                is_kept
            });
            self.stride = self.stride.max(1) * 2;
        }
        self.points.push(point);
    }

    /// What was kept.
    pub(super) fn points(&self) -> &[Point3<f64>] {
        &self.points
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
        let near = Camera::framing(arm(), &[floor], &[Point3::new(0.5, 0.0, 0.3)]);
        assert!((near.eye_in_world - near.target_in_world).norm() < 4.0, "{near:?}");
    }

    #[test]
    fn nothing_seen_still_gives_a_camera() {
        let mut bounds = Bounds::nothing();
        bounds.include(&Point3::new(f64::NAN, 0.0, 0.0));
        let camera = Camera::framing(bounds, &[], &[Point3::new(f64::NAN, 0.0, 0.0)]);
        assert!(camera.eye_in_world.coords.iter().all(|coordinate| coordinate.is_finite()));
    }

    #[test]
    fn the_camera_goes_where_the_work_is_seen() {
        let wall = |x: f64, y: f64| Obstacle {
            name: "wall".to_owned(),
            world_from_obstacle: Isometry3::translation(x, y, 0.5),
            geometry: Geometry::Box { size_m: Vector3::new(1.0, 0.02, 3.0) },
        };
        let way = [Point3::new(0.5, 0.0, 0.4)];
        let free = Camera::framing(arm(), &[], &way);
        assert!(free.eye_in_world.y < 0.0, "{free:?}");
        let walled = Camera::framing(arm(), &[wall(0.5, -0.4)], &way);
        assert!(walled.eye_in_world.y > 0.0, "{walled:?}");
    }

    #[test]
    fn a_long_way_keeps_few_points_of_all_of_it() {
        let mut way = Thinned::default();
        for step in 0..100_000 {
            way.push(Point3::new(f64::from(step), 0.0, 0.0));
        }
        let points = way.points();
        assert!(points.len() <= MOST_POINTS && points.len() > MOST_POINTS / 4, "{}", points.len());
        assert!(points[0].x < 10.0 && points[points.len() - 1].x > 90_000.0);
    }
}
