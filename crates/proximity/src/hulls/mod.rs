//! The one folder that names parry: convex hulls and exact distances between them.
//!
//! Meshes are replaced by their convex hulls, which contain them: a distance between hulls is never larger than the distance
//! between the meshes. A hull of very many points is simplified and then a little smaller than its mesh ([`HullPoints`]);
//! every distance is reduced by that error, so that it stays a lower bound.

mod form;

use congruent_description::{Geometry, HullPoints, Mesh, Shape};
use nalgebra::{Isometry3, Point3, Vector3};
use parry3d_f64::{
    math::{Pose, Rotation, Vector},
    query::{
        self, ClosestPoints,
        details::contact_support_map_support_map,
        gjk::{self, CsoPoint, GJKResult, VoronoiSimplex},
    },
    shape::{Ball, ConvexPolyhedron, Cuboid, Cylinder, Shape as ParryShape, SharedShape, SupportMap},
};

use self::form::{ConvexForm, EllipsoidForm, from_parry, isometry, pose, support_map, vector};
use super::{
    error::ProximityError,
    penetration::{Penetration, depth_of_boxes, least_overlap, overlap_along},
    separation::{Separation, direction, nearest_to_origin},
};

/// The collision shapes of one link or obstacle, ready for distance queries.
#[derive(Clone)]
pub struct Hulls {
    shapes: Vec<Hull>,
    radius_m: f64,
}

/// One convex shape at its place on the link.
#[derive(Clone)]
struct Hull {
    link_from_local: Pose,
    form: ConvexForm,
    /// Radius of a ball about its own origin that contains it.
    radius_m: f64,
    /// How far the shape may reach beyond the form.
    error_m: f64,
}

/// Why a query never fails: the message of a broken assumption.
const ANSWERS: &str = "parry answers for every pair of boxes, balls, cylinders and hulls";

/// Largest error of a distance. Kind: solver stop; see `DISTANCE_SLACK_M` in `clearance.rs`. Distances by parry that are
/// proven to this width are kept, others are improved.
const SOLVER_STOP_M: f64 = 1e-7;

impl std::fmt::Debug for Hulls {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Hulls").field("shapes", &self.shapes.len()).field("radius_m", &self.radius_m).finish()
    }
}

impl Hulls {
    /// Hulls of the shapes of one link; a mesh without triangles contributes nothing.
    ///
    /// # Errors
    /// [`ProximityError::NoHull`] if a mesh has no extent.
    pub fn new(subject: &str, shapes: &[Shape]) -> Result<Self, ProximityError> {
        let mut hulls = Self { shapes: Vec::with_capacity(shapes.len()), radius_m: 0.0 };
        for shape in shapes {
            let Some(mut hull) = convex(subject, &shape.geometry)? else {
                continue;
            };
            hull.link_from_local = pose(&shape.link_from_shape) * hull.link_from_local;
            // About the link's origin, not the shape's: bounds need no pose but the link's.
            hulls.radius_m = hulls.radius_m.max(hull.link_from_local.translation.length() + hull.radius_m);
            hulls.shapes.push(hull);
        }
        Ok(hulls)
    }

    /// Whether the link has no collision shape.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// Radius of a ball about the link's origin that contains every shape.
    pub fn radius_m(&self) -> f64 {
        self.radius_m
    }

    /// How far the meshes may reach beyond their simplified hulls, m; every distance is reduced by it. 0 for hulls of few
    /// points.
    pub fn hull_error_m(&self) -> f64 {
        self.shapes.iter().map(|shape| shape.error_m).fold(0.0, f64::max)
    }

    /// Distance to other hulls at pose `self_from_other`, m; 0 if they touch or overlap.
    pub fn distance_m(&self, other: &Self, self_from_other: &Isometry3<f64>) -> f64 {
        self.distance_below_m(other, self_from_other, f64::INFINITY)
    }

    /// The same if it is less than `most_m`, which is returned otherwise: shapes whose bounding balls are farther apart are
    /// not measured.
    pub fn distance_below_m(&self, other: &Self, self_from_other: &Isometry3<f64>, most_m: f64) -> f64 {
        // The error of a simplified hull may exceed a small distance: then the meshes may touch.
        self.smallest(other, self_from_other, most_m, distance_apart).max(0.0)
    }

    /// Like [`Hulls::distance_m`], but negative if they overlap: minus the depth.
    pub fn signed_distance_m(&self, other: &Self, self_from_other: &Isometry3<f64>) -> f64 {
        self.smallest(other, self_from_other, f64::INFINITY, |between, a, b| {
            let apart = distance_apart(between, a, b);
            // The depth is defined for an overlap only.
            if apart > 0.0 { apart } else { (-penetration(between, a, b).depth_m).min(0.0) }
        })
    }

    /// The nearest points of two hulls, in the frame of the first; if they overlap, the points of largest penetration. `None`
    /// if one has no shape, or they touch without depth.
    pub fn nearest_points(&self, other: &Self, self_from_other: &Isometry3<f64>) -> Option<[Point3<f64>; 2]> {
        let mut nearest: Option<NearestPoints> = None;
        for a in &self.shapes {
            for b in &other.shapes {
                let self_from_b = pose(self_from_other) * b.link_from_local;
                let found = nearest_points(a, &a.link_from_local.inv_mul(&self_from_b), b);
                nearest =
                    found.into_iter().chain(nearest).min_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
            }
        }
        nearest.map(|nearest| nearest.points)
    }

    fn smallest(
        &self,
        other: &Self,
        self_from_other: &Isometry3<f64>,
        most_m: f64,
        distance: impl Fn(&Pose, &ConvexForm, &ConvexForm) -> f64,
    ) -> f64 {
        let self_from_other = pose(self_from_other);
        let mut smallest = most_m;
        for a in &self.shapes {
            for b in &other.shapes {
                let a_from_b = a.link_from_local.inv_mul(&(self_from_other * b.link_from_local));
                // Bounding balls farther apart than the smallest distance so far rule the pair out. The margin: parry may
                // report less than the balls allow, by its error, and the result would then depend on what was skipped.
                if a_from_b.translation.length() - a.radius_m - b.radius_m > smallest + SOLVER_STOP_M {
                    continue;
                }
                let apart = distance(&a_from_b, &a.form, &b.form);
                // Each mesh may reach beyond its simplified hull, towards the other.
                smallest = smallest.min(apart - a.error_m - b.error_m);
            }
        }
        smallest
    }
}

/// The distance of two shapes; 0 if they touch or overlap.
///
/// Parry has closed forms for a ball with a ball, a box or a cylinder. Its method for two boxes is avoided: it measures between
/// points that are not always the nearest ones.
fn distance_apart(a_from_b: &Pose, a: &ConvexForm, b: &ConvexForm) -> f64 {
    let (ConvexForm::Parry(a), ConvexForm::Parry(b)) = (a, b) else {
        // A ball as its centre: one curved side fewer, which takes fewer steps and is more accurate.
        let [(a, of_a_m), (b, of_b_m)] = [a, b].map(ConvexForm::core);
        return (maps_apart(a_from_b, a, b) - of_a_m - of_b_m).max(0.0);
    };
    let (a, b) = (&**a, &**b);
    match (a.as_ball(), b.as_ball()) {
        (Some(ball), None) if b.as_convex_polyhedron().is_some() => ball_apart(&a_from_b.inverse(), b, *ball),
        (None, Some(ball)) if a.as_convex_polyhedron().is_some() => ball_apart(a_from_b, a, *ball),
        (None, None) => maps_apart(a_from_b, support_map(a), support_map(b)),
        _ => query::distance(&Pose::IDENTITY, a, a_from_b, b).expect(ANSWERS).distance,
    }
}

/// The distance of a hull and a ball: of the hull and a point.
fn ball_apart(hull_from_ball: &Pose, hull: &dyn ParryShape, ball: Ball) -> f64 {
    let nearest = hull.project_local_point(hull_from_ball.translation, true);
    let between = hull_from_ball.translation - nearest.point;
    if nearest.is_inside || between == Vector::ZERO {
        return 0.0;
    }
    let center = Ball::new(0.0);
    let lowest = lowest_point(hull_from_ball, support_map(hull), &center);
    (proven_m(lowest, from_parry(between)) - ball.radius).max(0.0)
}

/// The distance of two shapes by their support points.
fn maps_apart(a_from_b: &Pose, a: &dyn SupportMap, b: &dyn SupportMap) -> f64 {
    let lowest = lowest_point(a_from_b, a, b);
    match nearest_by_parry(a_from_b, a, b) {
        GJKResult::Intersection => 0.0,
        GJKResult::ClosestPoints(on_a, on_b, _) => proven_m(lowest, from_parry(on_b - on_a)),
        // After a hundred steps without an end parry has no points.
        GJKResult::Proximity(_) | GJKResult::NoIntersection(_) => {
            let start = lowest(&direction(&from_parry(a_from_b.translation)));
            nearest_to_origin(lowest, start).least_m
        }
    }
}

/// The nearest points of two shapes, as `distance_support_map_support_map` of parry has them; in the frame of the first.
fn nearest_by_parry(a_from_b: &Pose, a: &dyn SupportMap, b: &dyn SupportMap) -> GJKResult {
    let start = (-a_from_b.translation).try_normalize().unwrap_or(Vector::X);
    let mut simplex = VoronoiSimplex::new();
    simplex.reset(CsoPoint::from_shapes(a_from_b, a, b, start));
    gjk::closest_points(a_from_b, a, b, f64::MAX, true, &mut simplex)
}

/// The length of the vector between two points, if the plane across it proves that no points are nearer; otherwise a proven
/// distance. Parry stops where it makes no progress: distances of cylinders and thin hulls are then up to 14 um too large.
fn proven_m(lowest: impl Fn(&Vector3<f64>) -> Vector3<f64>, between: Vector3<f64>) -> f64 {
    let length_m = between.norm();
    let along = direction(&between);
    if length_m - lowest(&along).dot(&along) <= SOLVER_STOP_M {
        return length_m;
    }
    let found = nearest_to_origin(&lowest, between);
    if found.nearest.norm() - found.least_m <= SOLVER_STOP_M {
        return found.least_m;
    }
    // Beside a shape of many metres rounding may stop the search at once, from a direction of parry that is 1e-8 rad off.
    found.least_m.max(nearest_to_origin(&lowest, lowest(&along)).least_m)
}

/// Of all vectors from a point of `a` to a point of `b`, the one that is farthest against a direction.
fn lowest_point(
    a_from_b: &Pose,
    a: &dyn SupportMap,
    b: &dyn SupportMap,
) -> impl Fn(&Vector3<f64>) -> Vector3<f64> {
    move |along| {
        let along = vector(along);
        from_parry(b.support_point(a_from_b, -along) - a.local_support_point(along))
    }
}

/// The shortest shift that separates two shapes that overlap.
///
/// Parry stops early at parallel faces and edges, up to 9 mm too shallow for two boxes: its answer counts only if the
/// overlap along its direction is what it says.
fn penetration(a_from_b: &Pose, a: &ConvexForm, b: &ConvexForm) -> Penetration {
    let cuboid = |form: &ConvexForm| form.as_parry().and_then(|form| form.as_cuboid()).copied();
    if let (Some(a), Some(b)) = (cuboid(a), cuboid(b)) {
        let halves = [from_parry(a.half_extents), from_parry(b.half_extents)];
        return depth_of_boxes([&halves[0], &halves[1]], &isometry(a_from_b));
    }
    let lowest = lowest_point(a_from_b, a.support_map(), b.support_map());
    let contact = match (a, b) {
        (ConvexForm::Parry(a), ConvexForm::Parry(b)) => {
            query::contact(&Pose::IDENTITY, &**a, a_from_b, &**b, 0.0).expect(ANSWERS)
        }
        _ => contact_support_map_support_map(a_from_b, a.support_map(), b.support_map(), 0.0),
    };
    let by_parry = contact.map(|contact| (contact.dist, from_parry(contact.normal1)));
    if let Some((distance_m, along)) = by_parry {
        let overlap = overlap_along(&lowest, direction(&along));
        if (overlap.depth_m + distance_m).abs() <= SOLVER_STOP_M {
            return overlap;
        }
    }
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let turn = isometry(a_from_b).rotation;
    let both = axes.into_iter().chain(axes.map(|axis| turn * axis)).flat_map(|axis| [axis, -axis]);
    let starts = by_parry.map(|(_, along)| direction(&along)).into_iter().chain(both);
    least_overlap(lowest, starts).expect("there are twelve axes")
}

/// The nearest points of two shapes, in the first link's frame.
struct NearestPoints {
    /// Negative if they overlap.
    distance_m: f64,
    points: [Point3<f64>; 2],
}

/// The nearest points of two shapes; `None` if they touch without depth.
fn nearest_points(a: &Hull, a_from_b: &Pose, b: &Hull) -> Option<NearestPoints> {
    let in_link = |on_a: Vector, on_b: Vector| {
        [on_a, on_b].map(|point| {
            let point = a.link_from_local * point;
            Point3::new(point.x, point.y, point.z)
        })
    };
    if let Some([on_a, on_b]) = closest_points(a_from_b, &a.form, &b.form) {
        let distance_m = (on_b - on_a).length();
        return Some(NearestPoints { distance_m, points: in_link(on_a, on_b) });
    }
    let Penetration { depth_m, along } = penetration(a_from_b, &a.form, &b.form);
    if depth_m <= 0.0 {
        return None;
    }
    // Beyond the depth the shapes are apart, and their nearest points are those that came out last.
    let shift = vector(&along) * (2.0 * depth_m);
    let shifted = Pose::from_parts(a_from_b.translation + shift, a_from_b.rotation);
    let [on_a, on_b] = closest_points(&shifted, &a.form, &b.form)?;
    Some(NearestPoints { distance_m: -depth_m, points: in_link(on_a, on_b - shift) })
}

/// The nearest points of two shapes, in the frame of the first; `None` if they intersect.
fn closest_points(a_from_b: &Pose, a: &ConvexForm, b: &ConvexForm) -> Option<[Vector; 2]> {
    if let (ConvexForm::Parry(a), ConvexForm::Parry(b)) = (a, b) {
        // With an infinite margin anything that does not intersect is within it.
        let found = query::closest_points(&Pose::IDENTITY, &**a, a_from_b, &**b, f64::MAX).expect(ANSWERS);
        let ClosestPoints::WithinMargin(on_a, on_b) = found else { return None };
        return Some([on_a, on_b]);
    }
    let lowest = lowest_point(a_from_b, a.support_map(), b.support_map());
    let start = lowest(&direction(&from_parry(a_from_b.translation)));
    let Separation { least_m, nearest } = nearest_to_origin(lowest, start);
    if least_m <= 0.0 {
        return None;
    }
    let between = vector(&nearest);
    // An ellipsoid has one point that is farthest along the vector; a face of the other shape may have many.
    Some(match a {
        ConvexForm::Ellipsoid(a) => {
            let on_a = a.local_support_point(between);
            [on_a, on_a + between]
        }
        ConvexForm::Parry(_) => {
            let on_b = b.support_map().support_point(a_from_b, -between);
            [on_b - between, on_b]
        }
    })
}

/// The convex shape of a geometry, in the frame of that geometry; `None` for an empty mesh.
fn convex(subject: &str, geometry: &Geometry) -> Result<Option<Hull>, ProximityError> {
    let mut link_from_local = Pose::IDENTITY;
    let mut hull_error_m = 0.0;
    let (form, radius_m) = match geometry {
        Geometry::Box { size_m } => {
            let half = vector(&(size_m / 2.0));
            (ConvexForm::Parry(SharedShape::new(Cuboid::new(half))), half.length())
        }
        Geometry::Cylinder { radius_m, length_m } => {
            // The axis of parry's cylinder is y, that of URDF is z.
            link_from_local =
                Pose::from_parts(Vector::ZERO, Rotation::from_rotation_x(std::f64::consts::FRAC_PI_2));
            let upright = SharedShape::new(Cylinder::new(length_m / 2.0, *radius_m));
            (ConvexForm::Parry(upright), libm::hypot(*radius_m, length_m / 2.0))
        }
        Geometry::Sphere { radius_m } => {
            (ConvexForm::Parry(SharedShape::new(Ball::new(*radius_m))), *radius_m)
        }
        Geometry::Ellipsoid { semi_axes_m } => {
            (ConvexForm::Ellipsoid(EllipsoidForm { semi_axes_m: vector(semi_axes_m) }), semi_axes_m.max())
        }
        Geometry::Mesh(mesh) if mesh.triangles.is_empty() => return Ok(None),
        Geometry::Mesh(mesh) => {
            let (hull, error_m) =
                hull_of(mesh).ok_or_else(|| ProximityError::NoHull { subject: subject.to_owned() })?;
            // Of the reduced hull, so the mesh may reach beyond it by its error, which is added below.
            let radius_m = hull.points().iter().map(|point| point.length()).fold(0.0, f64::max);
            hull_error_m = error_m;
            (ConvexForm::Parry(SharedShape::new(hull)), radius_m + error_m)
        }
    };
    Ok(Some(Hull { link_from_local, form, radius_m, error_m: hull_error_m }))
}

/// The hull of a mesh, and how far the mesh may reach beyond it.
fn hull_of(mesh: &Mesh) -> Option<(ConvexPolyhedron, f64)> {
    let HullPoints { points_m, error_m } = HullPoints::from_vertices(&mesh.vertices_m);
    let points: Vec<Vector> = points_m.iter().map(|point| vector(&point.coords)).collect();
    Some((ConvexPolyhedron::from_convex_hull(&points)?, error_m))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    use congruent_description::Mesh;
    use nalgebra::{Translation3, UnitQuaternion, Vector3};

    use super::*;

    /// Kind: solver stop. Bound: what `clearance.rs` subtracts, 1e-7 m; worst seen here 1.5e-8 m.
    const DISTANCE_M: f64 = 1e-7;

    fn hulls(geometry: Geometry) -> Hulls {
        let shape = Shape { link_from_shape: Isometry3::identity(), geometry, color_rgba: None };
        Hulls::new("test", &[shape]).unwrap()
    }

    fn ball(radius_m: f64) -> Hulls {
        hulls(Geometry::Sphere { radius_m })
    }

    fn cuboid(x: f64, y: f64, z: f64) -> Hulls {
        hulls(Geometry::Box { size_m: Vector3::new(x, y, z) })
    }

    fn can(radius_m: f64, length_m: f64) -> Hulls {
        hulls(Geometry::Cylinder { radius_m, length_m })
    }

    /// The corners of a cuboid, as a mesh.
    fn cuboid_mesh(x: f64, y: f64, z: f64) -> Hulls {
        let corner = |index: u32| {
            let sign = |bit: u32| if index >> bit & 1 == 0 { -0.5 } else { 0.5 };
            Point3::new(x * sign(0), y * sign(1), z * sign(2))
        };
        let vertices_m = (0..8).map(corner).collect();
        let (path, scale) = ("corners".into(), Vector3::repeat(1.0));
        hulls(Geometry::Mesh(Mesh { path, scale, vertices_m, triangles: vec![[0, 1, 2]] }.into()))
    }

    fn at(x: f64, y: f64, z: f64) -> Isometry3<f64> {
        Isometry3::translation(x, y, z)
    }

    fn turned(axis: Vector3<f64>, place: Isometry3<f64>) -> Isometry3<f64> {
        place * UnitQuaternion::new(axis)
    }

    /// Both ways round: distances do not depend on who asks.
    #[track_caller]
    fn apart(a: &Hulls, b: &Hulls, a_from_b: Isometry3<f64>, expected_m: f64) {
        for found_m in [a.distance_m(b, &a_from_b), b.distance_m(a, &a_from_b.inverse())] {
            assert!((found_m - expected_m).abs() < DISTANCE_M, "{found_m} is not {expected_m}");
        }
        let signed_m = a.signed_distance_m(b, &a_from_b);
        assert!((signed_m - expected_m).abs() < DISTANCE_M, "{signed_m} is not {expected_m}");
    }

    #[track_caller]
    fn overlap(a: &Hulls, b: &Hulls, a_from_b: Isometry3<f64>, depth_m: f64) {
        assert_eq!((a.distance_m(b, &a_from_b), b.distance_m(a, &a_from_b.inverse())), (0.0, 0.0));
        let signed_m = a.signed_distance_m(b, &a_from_b);
        assert!((signed_m + depth_m).abs() < DISTANCE_M, "{signed_m} is not -{depth_m}");
    }

    #[test]
    fn shapes_apart() {
        apart(&ball(0.5), &ball(0.25), at(3.0, 4.0, 0.0), 4.25);
        apart(&ball(0.1), &cuboid(1.0, 1.0, 1.0), at(0.5 + 0.3 + 0.1, 0.2, 0.0), 0.3);
        // Corner to centre: half a diagonal of a unit cube away.
        apart(&ball(0.1), &cuboid(1.0, 1.0, 1.0), at(1.0, 1.0, 1.0), 0.75_f64.sqrt() - 0.1);
        apart(&cuboid(1.0, 2.0, 3.0), &cuboid(1.0, 1.0, 1.0), at(0.0, 0.0, 2.0 + 1e-3), 1e-3);
        // On its edge, the cube reaches half a diagonal of its face towards the other.
        let on_edge = turned(Vector3::z() * FRAC_PI_4, at(2.0, 0.0, 0.0));
        apart(&cuboid(1.0, 1.0, 1.0), &cuboid(1.0, 1.0, 1.0), on_edge, 1.5 - 0.5_f64.sqrt());
        // Two crossed cans: axis to axis less both radii.
        let crossed = turned(Vector3::x() * FRAC_PI_2, at(1.0, 0.0, 0.0));
        apart(&can(0.2, 2.0), &can(0.3, 2.0), crossed, 0.5);
        // End to end, and rim to rim across a corner.
        apart(&can(0.2, 1.0), &can(0.3, 1.0), at(0.0, 0.0, 1.25), 0.25);
        apart(&can(0.2, 1.0), &can(0.3, 1.0), at(0.8, 0.0, 1.4), 0.5);
        apart(&ball(0.1), &can(0.2, 1.0), at(0.0, 0.7, 0.4), 0.4);
    }

    /// The nearest points of two boxes by projections onto one and the other in turn, which is von Neumann's method for
    /// convex sets, and what the plane between them proves: the distance is between both numbers.
    fn bounds_of_boxes(half: [Vector3<f64>; 2], a_from_b: &Isometry3<f64>) -> [f64; 2] {
        let clamped = |point: Point3<f64>, half: &Vector3<f64>| {
            Point3::from(point.coords.zip_map(half, |coordinate, half| coordinate.clamp(-half, half)))
        };
        let (mut on_a, mut on_b) = (Point3::origin(), a_from_b * Point3::origin());
        for _ in 0..100_000 {
            on_a = clamped(on_b, &half[0]);
            on_b = a_from_b * clamped(a_from_b.inverse() * on_a, &half[1]);
        }
        let along = (on_b - on_a).normalize();
        let in_b = a_from_b.rotation.inverse() * along;
        let end_of_a = along.abs().dot(&half[0]);
        let start_of_b = a_from_b.translation.vector.dot(&along) - in_b.abs().dot(&half[1]);
        [start_of_b - end_of_a, (on_b - on_a).norm()]
    }

    #[test]
    fn boxes_are_as_far_apart_as_their_nearest_points() {
        let halves = [[0.02, 0.02, 0.025], [0.15, 0.15, 0.025], [0.4, 0.01, 0.1]].map(Vector3::from);
        let turns =
            [[0.0, -0.6, 0.0], [0.59, 0.0, 0.0], [0.3, -0.4, 1.1], [2.0, 0.1, 0.5]].map(Vector3::from);
        let shifts =
            [[0.0, 0.1, 0.3], [0.6, 0.0, 0.1], [0.2, -0.5, 0.3], [0.9, 0.1, -0.2]].map(Vector3::from);
        for (one, other) in [(0, 1), (1, 1), (1, 2), (2, 0)] {
            let (of_a, of_b) = (halves[one], halves[other]);
            let boxes = [of_a, of_b].map(|half| cuboid(2.0 * half.x, 2.0 * half.y, 2.0 * half.z));
            for (turn, shift) in turns.iter().flat_map(|turn| shifts.iter().map(move |shift| (turn, shift))) {
                let a_from_b = turned(*turn, at(shift.x, shift.y, shift.z));
                let [least_m, most_m] = bounds_of_boxes([of_a, of_b], &a_from_b);
                if least_m > 0.0 {
                    assert!(most_m - least_m < DISTANCE_M, "the oracle is not sure: {least_m} to {most_m}");
                    apart(&boxes[0], &boxes[1], a_from_b, most_m);
                }
            }
        }
    }

    #[test]
    fn a_mesh_is_its_hull() {
        let turn = turned(Vector3::new(0.3, -0.4, 1.1), at(1.3, 0.4, -0.9));
        let (solid, mesh) = (cuboid(0.4, 0.6, 0.8), cuboid_mesh(0.4, 0.6, 0.8));
        for other in [ball(0.2), cuboid(0.5, 0.3, 0.2), can(0.2, 0.7), cuboid_mesh(0.5, 0.3, 0.2)] {
            apart(&mesh, &other, turn, solid.distance_m(&other, &turn));
        }
        assert!((mesh.radius_m() - solid.radius_m()).abs() < 1e-15);
    }

    /// The points are as far apart as the shapes, and the depth if they overlap; both ways round.
    #[track_caller]
    fn nearest(a: &Hulls, b: &Hulls, a_from_b: Isometry3<f64>) {
        let [on_a, on_b] = a.nearest_points(b, &a_from_b).expect("there are such points");
        let size_m = a.signed_distance_m(b, &a_from_b).abs();
        assert!(((on_b - on_a).norm() - size_m).abs() < DISTANCE_M, "{on_a} {on_b}: {size_m}");
        let [on_b_in_b, _] = b.nearest_points(a, &a_from_b.inverse()).expect("there are such points");
        assert!((a_from_b * on_b_in_b - on_b).norm() < 1e-4, "{on_b} is not {}", a_from_b * on_b_in_b);
    }

    #[test]
    fn nearest_points_are_where_the_distance_is() {
        let turn = turned(Vector3::new(0.3, -0.4, 1.1), at(1.3, 0.4, -0.9));
        for other in [ball(0.2), can(0.2, 0.7), cuboid_mesh(0.5, 0.3, 0.2)] {
            nearest(&cuboid(0.4, 0.6, 0.8), &other, turn);
        }
        nearest(&ball(0.5), &ball(0.25), at(0.7, 0.0, 0.0));
        nearest(&cuboid(1.0, 1.0, 1.0), &ball(0.1), at(0.1, 0.0, 0.55));
        let [on_box, on_ball] = cuboid(1.0, 1.0, 1.0).nearest_points(&ball(0.1), &at(0.0, 0.2, 0.9)).unwrap();
        assert!((on_box - Point3::new(0.0, 0.2, 0.5)).norm() < DISTANCE_M, "{on_box}");
        assert!((on_ball - Point3::new(0.0, 0.2, 0.8)).norm() < DISTANCE_M, "{on_ball}");
        let nothing = Hulls::new("nothing", &[]).unwrap();
        assert_eq!(nothing.nearest_points(&ball(1.0), &at(3.0, 0.0, 0.0)), None);
    }

    #[test]
    fn what_a_hull_omits_is_taken_off() {
        let on_ball = |at: u32| {
            let height = 1.0 - (2.0 * f64::from(at) + 1.0) / 9000.0;
            let (sin, cos) = (2.4 * f64::from(at)).sin_cos();
            let radius = (1.0 - height * height).sqrt();
            Point3::new(0.3 * radius * cos, 0.3 * radius * sin, 0.3 * height)
        };
        let vertices_m = (0..9000).map(on_ball).collect();
        let mesh =
            Mesh { path: "ball".into(), scale: Vector3::repeat(1.0), vertices_m, triangles: vec![[0, 1, 2]] };
        let cut = hulls(Geometry::Mesh(mesh.into()));
        let hull_error_m = cut.hull_error_m();
        // A thousandth of the diameter; it is 0.30 mm.
        assert!(hull_error_m > 0.0 && hull_error_m < 6e-4, "{hull_error_m}");
        // The points are 9 mm from each other: between them the mesh is up to 0.1 mm inside of the ball.
        for place in [at(1.0, 0.0, 0.0), at(-0.5, 0.6, 0.3), at(0.1, 0.2, -0.9)] {
            let exact_m = place.translation.vector.norm() - 0.3 - 0.1;
            let off_m = exact_m - cut.distance_m(&ball(0.1), &place);
            assert!(off_m > -1e-4 && off_m <= hull_error_m + DISTANCE_M, "{off_m}");
        }
        let inside = at(0.3, 0.0, 0.0);
        assert_eq!((cut.distance_m(&ball(0.1), &inside), ball(0.1).distance_m(&cut, &inside)), (0.0, 0.0));
    }

    #[test]
    fn touching_and_overlapping() {
        apart(&ball(0.5), &ball(0.25), at(0.75, 0.0, 0.0), 0.0);
        apart(&cuboid(1.0, 1.0, 1.0), &cuboid(1.0, 1.0, 1.0), at(1.0, 0.25, 0.0), 0.0);
        overlap(&ball(0.5), &ball(0.25), at(0.7, 0.0, 0.0), 0.05);
        overlap(&cuboid(1.0, 1.0, 1.0), &cuboid(1.0, 1.0, 1.0), at(0.1, 0.2, 0.9), 0.1);
        overlap(&cuboid_mesh(1.0, 1.0, 1.0), &cuboid(1.0, 1.0, 1.0), at(0.1, 0.2, 0.9), 0.1);
        // A ball inside a box, 0.1 m off its middle: out through the nearest face.
        overlap(&cuboid(1.0, 1.0, 1.0), &ball(0.1), at(0.1, 0.0, 0.0), 0.4 + 0.1);
        // A small mesh inside a large one.
        overlap(&cuboid_mesh(2.0, 2.0, 2.0), &cuboid_mesh(0.2, 0.2, 0.2), at(0.5, 0.0, 0.0), 0.5 + 0.1);
    }

    #[test]
    fn every_shape_is_inside_the_ball_of_its_radius() {
        let place = turned(Vector3::x() * 0.7, at(0.1, 0.2, 0.3));
        let shape = |geometry| Shape { link_from_shape: place, geometry, color_rgba: None };
        let shapes = [
            shape(Geometry::Sphere { radius_m: 0.1 }),
            shape(Geometry::Cylinder { radius_m: 0.1, length_m: 0.9 }),
            shape(Geometry::Box { size_m: Vector3::new(0.3, 0.2, 0.5) }),
        ];
        for one in &shapes {
            let hulls = Hulls::new("test", std::slice::from_ref(one)).unwrap();
            // From far away, the nearest point is at least this near the far side of that ball.
            for axis in
                [Vector3::x(), Vector3::y(), Vector3::z(), -Vector3::x(), -Vector3::y(), -Vector3::z()]
            {
                let far = Isometry3::from(Translation3::from(axis * 100.0));
                let reach_m = 100.0 - 1.0 - hulls.distance_m(&ball(1.0), &far);
                assert!(reach_m <= hulls.radius_m() + DISTANCE_M, "{reach_m} {}", hulls.radius_m());
            }
        }
    }

    #[test]
    fn a_mesh_without_triangles_is_nothing() {
        let empty = Mesh {
            path: "empty".into(),
            scale: Vector3::repeat(1.0),
            vertices_m: Vec::new(),
            triangles: Vec::new(),
        };
        assert!(hulls(Geometry::Mesh(empty.into())).is_empty());
    }
}
