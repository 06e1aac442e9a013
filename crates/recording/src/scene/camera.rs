//! The camera of the three-dimensional view, so that this robot fills the picture.

use congruent_description::{Extent, Geometry, Obstacle};
use nalgebra::{Isometry3, Point3, Vector3};

/// Margin around the shapes of the links.
const MARGIN_M: f64 = 0.02;
/// Obstacles count up to this distance outside the robot's box, as a fraction of its diagonal: a floor of ten
/// metres must not shrink the robot in the picture.
const OBSTACLE_REACH: f64 = 0.05;
/// Tangents of half of the viewer's field of view: of 55 degrees vertically, and of the same with the aspect that the
/// layout gives the view.
const HALF_VIEW: [f64; 2] = [0.676_7, 0.520_6];
/// Candidate azimuths of the camera, relative to the azimuth of the tool's path: the best first if nothing
/// hides the path, views from behind last.
const AZIMUTHS_RAD: [f64; 8] = [-0.95, 0.95, -0.45, 0.45, -1.6, 1.6, -2.3, 2.3];
/// Elevation of the camera.
const ELEVATION_RAD: f64 = 0.42;
/// The fraction of the box that must be in the picture: arms are slim, and leave its corners free.
const BOX_FRACTION: f64 = 0.78;
/// The most points kept of the tool's path.
const MAX_POINTS: usize = 64;

/// The corners of a box, by the signs of its half edges.
const CORNERS: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];

/// Axis-aligned box around the points so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BoundingBox {
    low: Point3<f64>,
    high: Point3<f64>,
}

impl BoundingBox {
    /// A box without points.
    pub(crate) fn empty() -> Self {
        Self {
            low: Point3::from(Vector3::repeat(f64::INFINITY)),
            high: Point3::from(Vector3::repeat(f64::NEG_INFINITY)),
        }
    }

    /// The box around a shape that is centred at its origin.
    pub(crate) fn around(geometry: &Geometry) -> Self {
        let half = half_size(geometry);
        Self { low: (-half).into(), high: half.into() }
    }

    /// Extends the box to a point; a point that is not finite is ignored.
    pub(crate) fn include(&mut self, point: &Point3<f64>) {
        if point.coords.iter().all(|coordinate| coordinate.is_finite()) {
            self.low = self.low.inf(point);
            self.high = self.high.sup(point);
        }
    }

    /// Extends the box to the corners of another box at a pose.
    pub(crate) fn include_box(&mut self, other: &Self, world_from_other: &Isometry3<f64>) {
        // An empty box has infinite corners, whose middle is NaN.
        if other.low.x > other.high.x {
            return;
        }
        let (middle, half) = (nalgebra::center(&other.low, &other.high), (other.high - other.low) / 2.0);
        for signs in CORNERS {
            self.include(&(world_from_other * (middle + half.component_mul(&Vector3::from(signs)))));
        }
    }

    /// The point on top of a shape, in the middle of the part of it that is inside this box.
    pub(crate) fn top_of(&self, shape: &Obstacle) -> Point3<f64> {
        let mut own = Self::empty();
        own.include_box(&Self::around(&shape.geometry), &shape.world_from_obstacle);
        // Clamped to both boxes: of a floor of ten metres only the part below the robot is in the picture.
        let inside = |bound: Point3<f64>| bound.sup(&self.low).inf(&self.high).sup(&own.low).inf(&own.high);
        let [low, high] = [inside(own.low), inside(own.high)];
        Point3::new(f64::midpoint(low.x, high.x), f64::midpoint(low.y, high.y), high.z)
    }

    /// The robot's box, extended to the nearby parts of the obstacles.
    pub(crate) fn with_obstacles(self, obstacles: &[Obstacle]) -> Self {
        let reach = MARGIN_M + OBSTACLE_REACH * (self.high - self.low).norm();
        let near = self.grown(reach);
        let mut all = self.grown(MARGIN_M);
        for obstacle in obstacles {
            let half = half_size(&obstacle.geometry);
            for signs in CORNERS {
                let corner = Point3::from(half.component_mul(&Vector3::from(signs)));
                let corner_in_world = obstacle.world_from_obstacle * corner;
                // Corners far away are moved to the edge of the near region, so that a large obstacle extends the
                // picture and does not fill it.
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

/// Half edges of a box that is centred at the shape's origin and contains the shape.
fn half_size(geometry: &Geometry) -> Vector3<f64> {
    let corners = Extent::of_geometry(geometry).map(|extent| extent.corners());
    corners.iter().flatten().fold(Vector3::zeros(), |half, corner| half.sup(&corner.abs()))
}

/// The viewer's camera, in the root link's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Camera {
    /// Position of the eye.
    pub(crate) eye_in_world: Point3<f64>,
    /// The point in the middle of the picture.
    pub(crate) target_in_world: Point3<f64>,
}

impl Camera {
    /// A camera that shows the robot's box, from the candidate azimuth from which obstacles hide the fewest
    /// points of the tool's path.
    pub(crate) fn framing(robot: BoundingBox, obstacles: &[Obstacle], path_in_world: &[Point3<f64>]) -> Self {
        // A robot without shapes has no box to frame: an eye at arm's length shows the frames of its links.
        if robot.low.x > robot.high.x {
            let eye_in_world = Point3::new(1.5, -1.5, 1.0);
            return Self { eye_in_world, target_in_world: Point3::origin() };
        }
        let all = robot.with_obstacles(obstacles);
        let target_in_world = nalgebra::center(&all.low, &all.high);
        // The sum has the direction of the mean. The robot's front is where its tool works.
        let sum = path_in_world.iter().fold(Vector3::zeros(), |sum: Vector3<f64>, point| sum + point.coords);
        let path_rad = if sum.xy().norm() > 0.0 { libm::atan2(sum.y, sum.x) } else { 0.0 };
        let (up, level) = libm::sincos(ELEVATION_RAD);
        let from = |azimuth_rad: f64| {
            let (sin, cos) = libm::sincos(path_rad + azimuth_rad);
            let to_eye = Vector3::new(cos * level, sin * level, up);
            target_in_world + to_eye * distance_m(&all, &to_eye)
        };
        let hidden = |eye: &Point3<f64>| {
            let is_hidden =
                |point: &&Point3<f64>| obstacles.iter().any(|obstacle| hides(obstacle, eye, point));
            path_in_world.iter().filter(is_hidden).count()
        };
        let eyes = AZIMUTHS_RAD.map(from);
        // `min_by_key` keeps the first of equals, and the azimuths are sorted from best to worst.
        let eye_in_world = eyes.into_iter().min_by_key(hidden).expect("there are candidate azimuths");
        Self { eye_in_world, target_in_world }
    }
}

/// Distance from the middle of a box at which an eye in this direction has it in its picture.
fn distance_m(framed: &BoundingBox, to_eye: &Vector3<f64>) -> f64 {
    let right = Vector3::z().cross(to_eye).normalize();
    let up = to_eye.cross(&right);
    let half = (framed.high - framed.low) / 2.0;
    let from_corner = |signs: [f64; 3]| {
        let corner = half.component_mul(&Vector3::from(signs)) * BOX_FRACTION;
        // A corner c is in the picture if its depth d - c.e is at least |c.right| / tan(half width) and |c.up| /
        // tan(half height).
        let [across, along] = [corner.dot(&right), corner.dot(&up)].map(f64::abs);
        corner.dot(to_eye) + (across / HALF_VIEW[0]).max(along / HALF_VIEW[1])
    };
    CORNERS.into_iter().map(from_corner).fold(0.0, f64::max)
}

/// Whether the box around an obstacle is between the eye and a point.
fn hides(obstacle: &Obstacle, eye_in_world: &Point3<f64>, point_in_world: &Point3<f64>) -> bool {
    let half = half_size(&obstacle.geometry);
    let eye = obstacle.world_from_obstacle.inverse_transform_point(eye_in_world);
    let ray = obstacle.world_from_obstacle.inverse_transform_point(point_in_world) - eye;
    // Slabs: the part of the ray from eye (0) to point (1) that is between all three pairs of faces. A ray parallel
    // to a face divides by 0 to an infinity, which the comparisons take.
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..3 {
        let [a, b] = [-half[axis], half[axis]].map(|side| (side - eye[axis]) / ray[axis]);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    // The last hundredth of the ray does not count: a tool that touches a box is not behind it.
    enter < leave.min(0.99)
}

/// Evenly spaced samples of a path of any length.
#[derive(Debug)]
pub(crate) struct ThinnedPath {
    points: Vec<Point3<f64>>,
    /// Every `stride`-th point is kept.
    stride: usize,
    skipped: usize,
}

impl ThinnedPath {
    /// A path without points, which keeps every point at first.
    pub(crate) fn new() -> Self {
        Self { points: Vec::with_capacity(MAX_POINTS), stride: 1, skipped: 0 }
    }

    /// Adds the next point of the path, in the root link's frame. Unit: m.
    pub(crate) fn push(&mut self, point: Point3<f64>) {
        self.skipped += 1;
        if self.skipped < self.stride {
            return;
        }
        self.skipped = 0;
        // Every second one goes, and from now on half as many come: the points remain evenly spaced however long the
        // run.
        if self.points.len() == MAX_POINTS {
            let mut is_kept = false;
            self.points.retain(|_| {
                is_kept = !is_kept;
                is_kept
            });
            self.stride *= 2;
        }
        self.points.push(point);
    }

    /// The kept points in order, evenly spaced in samples.
    pub(crate) fn points(&self) -> &[Point3<f64>] {
        &self.points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arm() -> BoundingBox {
        let mut all = BoundingBox::empty();
        all.include(&Point3::origin());
        all.include(&Point3::new(0.6, 0.0, 0.8));
        all
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
    fn no_points_still_give_a_camera() {
        let mut all = BoundingBox::empty();
        all.include(&Point3::new(f64::NAN, 0.0, 0.0));
        let camera = Camera::framing(all, &[], &[Point3::new(f64::NAN, 0.0, 0.0)]);
        assert!(camera.eye_in_world.coords.iter().all(|coordinate| coordinate.is_finite()));
    }

    #[test]
    fn the_camera_sees_the_path_past_obstacles() {
        let wall = |x: f64, y: f64| Obstacle {
            name: "wall".to_owned(),
            world_from_obstacle: Isometry3::translation(x, y, 0.5),
            geometry: Geometry::Box { size_m: Vector3::new(1.0, 0.02, 3.0) },
        };
        let path = [Point3::new(0.5, 0.0, 0.4)];
        let free = Camera::framing(arm(), &[], &path);
        assert!(free.eye_in_world.y < 0.0, "{free:?}");
        let walled = Camera::framing(arm(), &[wall(0.5, -0.4)], &path);
        assert!(walled.eye_in_world.y > 0.0, "{walled:?}");
    }

    #[test]
    fn a_long_path_keeps_few_points_along_its_length() {
        let mut path = ThinnedPath::new();
        for step in 0..100_000 {
            path.push(Point3::new(f64::from(step), 0.0, 0.0));
        }
        let points = path.points();
        assert!(points.len() <= MAX_POINTS && points.len() > MAX_POINTS / 4, "{}", points.len());
        assert!(points[0].x < 10.0 && points[points.len() - 1].x > 90_000.0);
    }
}
