//! Distances and depths at many random placements, against oracles that know the shapes and not the methods.

mod ellipsoids;

use congruent_description::{Geometry, Mesh, Shape};
use congruent_proximity::Hulls;
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

/// Kind: solver stop of both sides. Bound: what `clearance.rs` subtracts, 1e-7 m.
const DISTANCE_M: f64 = 1e-7;

/// Depths of boxes are closed forms on both sides. Kind: rounding; worst seen 3e-16 m.
const ROUNDING_M: f64 = 1e-12;

/// Repeatable numbers (a 64 bit linear congruential generator, upper bits).
struct Draws(u64);

impl Draws {
    fn between(&mut self, least: f64, most: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
        let share = (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        least + (most - least) * share
    }

    fn vector(&mut self, size: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(-size, size))
    }

    /// Axes that differ by up to 55 times.
    fn semi_axes(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| 0.005 * self.between(0.0, 4.0).exp())
    }

    fn half_sizes(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(0.01, 0.2))
    }
}

fn hulls(geometry: Geometry) -> Hulls {
    let shape = Shape { link_from_shape: Isometry3::identity(), geometry, color_rgba: None };
    Hulls::new("test", &[shape]).expect("the shape has a hull")
}

fn cuboid(half: &Vector3<f64>) -> Hulls {
    hulls(Geometry::Box { size_m: half * 2.0 })
}

fn corners_of(half: &Vector3<f64>) -> Vec<Point3<f64>> {
    let sign = |index: u8, bit: u8| if index >> bit & 1 == 0 { -1.0 } else { 1.0 };
    (0..8)
        .map(|at| Point3::from(half.component_mul(&Vector3::from_fn(|row, _| sign(at, [0, 1, 2][row])))))
        .collect()
}

fn ellipsoid(semi_axes_m: &Vector3<f64>) -> Hulls {
    hulls(Geometry::Ellipsoid { semi_axes_m: *semi_axes_m })
}

/// A mesh of the same corners.
fn mesh(vertices_m: Vec<Point3<f64>>) -> Hulls {
    let (path, scale) = ("corners".into(), Vector3::repeat(1.0));
    hulls(Geometry::Mesh(Mesh { path, scale, vertices_m, triangles: vec![[0, 1, 2]] }.into()))
}

/// The depth of the origin in a polygon in the plane: its distance from the nearest side of the hull of the points; negative
/// if it is outside.
fn depth_in_polygon(mut points: Vec<[f64; 2]>) -> f64 {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut depth = f64::INFINITY;
    for turn in [1.0, -1.0] {
        let mut side: Vec<[f64; 2]> = Vec::new();
        for point in &points {
            let point = [turn * point[0], turn * point[1]];
            while let [.., a, b] = side[..] {
                let cross = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]);
                if cross > 0.0 {
                    break;
                }
                side.pop();
            }
            side.push(point);
        }
        for pair in side.windows(2) {
            let along = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            let length = along[0].hypot(along[1]);
            depth = depth.min((along[1] * pair[0][0] - along[0] * pair[0][1]) / length);
        }
        points.reverse();
    }
    depth
}

/// The depth of two boxes that turn about a common axis: in the plane across it, and along it.
fn depth_across_z(halves: &[Vector3<f64>; 2], angle: f64, shift: &Vector3<f64>) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let corners = |half: &Vector3<f64>| {
        [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|[x, y]| [x * half.x, y * half.y])
    };
    let of_b = corners(&halves[1]).map(|[x, y]| [cos * x - sin * y + shift.x, sin * x + cos * y + shift.y]);
    let differences =
        corners(&halves[0]).into_iter().flat_map(|[ax, ay]| of_b.map(|[x, y]| [x - ax, y - ay]));
    let along = halves[0].z + halves[1].z - shift.z.abs();
    depth_in_polygon(differences.collect()).min(along)
}

#[test]
fn boxes_with_parallel_edges_are_as_deep_as_in_the_plane() {
    let mut draws = Draws(1);
    let mut overlaps = 0;
    while overlaps < 10_000 {
        let halves = [draws.half_sizes(), draws.half_sizes()];
        // Every fourth: parallel faces, where many axes are one. Some are inside of each other.
        let angle = if overlaps % 4 == 0 { 0.0 } else { draws.between(-3.2, 3.2) };
        let shift = draws.vector(0.2);
        let depth_m = depth_across_z(&halves, angle, &shift);
        if depth_m <= 0.0 {
            continue;
        }
        overlaps += 1;
        let a_from_b = Isometry3::new(shift, Vector3::z() * angle);
        // The pair as a whole lies anywhere: edges are parallel up to rounding only.
        let world_from_a = Isometry3::new(draws.vector(1.0), draws.vector(3.0));
        let again = world_from_a.inv_mul(&(world_from_a * a_from_b));
        for a_from_b in [a_from_b, again] {
            let found_m = -cuboid(&halves[0]).signed_distance_m(&cuboid(&halves[1]), &a_from_b);
            assert!(
                (found_m - depth_m).abs() < ROUNDING_M,
                "{found_m} is not {depth_m}: {halves:?} {a_from_b:?}"
            );
        }
    }
}

/// The depth of the origin in the hull of the differences of all corners: its distance from the nearest plane through three of
/// them that has all others behind it.
fn depth_by_corners(corners: [&[Point3<f64>]; 2], a_from_b: &Isometry3<f64>) -> f64 {
    let of_b: Vec<_> = corners[1].iter().map(|corner| a_from_b * corner).collect();
    let points: Vec<Vector3<f64>> = corners[0].iter().flat_map(|a| of_b.iter().map(move |b| b - a)).collect();
    let mut depth_m = f64::INFINITY;
    for (first, a) in points.iter().enumerate() {
        for (second, b) in points.iter().enumerate().skip(first + 1) {
            for c in &points[second + 1..] {
                let Some(normal) = (b - a).cross(&(c - a)).try_normalize(1e-9) else { continue };
                let heights = || points.iter().map(|point| normal.dot(&(point - a)));
                if heights().all(|height| height < 1e-12) || heights().all(|height| height > -1e-12) {
                    depth_m = depth_m.min(normal.dot(a).abs());
                }
            }
        }
    }
    depth_m
}

#[test]
fn boxes_and_their_meshes_are_as_deep_as_their_corners_say() {
    let mut draws = Draws(2);
    let mut overlaps = 0;
    while overlaps < 10_000 {
        let halves = [draws.half_sizes(), draws.half_sizes()];
        let a_from_b = Isometry3::new(draws.vector(0.2), draws.vector(3.0));
        let depth_m = -cuboid(&halves[0]).signed_distance_m(&cuboid(&halves[1]), &a_from_b);
        if depth_m <= 0.0 {
            continue;
        }
        overlaps += 1;
        let other_m = -cuboid(&halves[1]).signed_distance_m(&cuboid(&halves[0]), &a_from_b.inverse());
        assert!((depth_m - other_m).abs() < ROUNDING_M, "{depth_m} {other_m}");
        let corners = halves.each_ref().map(corners_of);
        let by_meshes_m = -mesh(corners[0].clone()).signed_distance_m(&mesh(corners[1].clone()), &a_from_b);
        assert!(
            (depth_m - by_meshes_m).abs() < DISTANCE_M,
            "{depth_m}, meshes {by_meshes_m}: {halves:?} {a_from_b:?}"
        );
        // Every hundredth: the oracle tries 41,664 planes.
        if overlaps % 100 == 0 {
            let expected_m = depth_by_corners([&corners[0], &corners[1]], &a_from_b);
            assert!((depth_m - expected_m).abs() < ROUNDING_M, "{depth_m} is not {expected_m}");
        }
    }
}

/// A solid with a closed form for the nearest of its points.
enum Solid {
    Box(Vector3<f64>),
    Can { radius_m: f64, half_m: f64 },
    Ball(f64),
    Ellipsoid(Vector3<f64>),
}

impl Solid {
    fn hulls(&self) -> Hulls {
        match self {
            Self::Box(half) => cuboid(half),
            Self::Can { radius_m, half_m } => {
                hulls(Geometry::Cylinder { radius_m: *radius_m, length_m: 2.0 * half_m })
            }
            Self::Ball(radius_m) => hulls(Geometry::Sphere { radius_m: *radius_m }),
            Self::Ellipsoid(semi_axes_m) => ellipsoid(semi_axes_m),
        }
    }

    fn nearest(&self, point: &Point3<f64>) -> Point3<f64> {
        match self {
            Self::Box(half) => point.coords.zip_map(half, |at, half| at.clamp(-half, half)).into(),
            Self::Can { radius_m, half_m } => {
                let scale = (radius_m / point.x.hypot(point.y)).min(1.0);
                Point3::new(point.x * scale, point.y * scale, point.z.clamp(-half_m, *half_m))
            }
            Self::Ball(radius_m) => point * (radius_m / point.coords.norm()).min(1.0),
            Self::Ellipsoid(semi_axes_m) => nearest_on_ellipsoid(semi_axes_m, point),
        }
    }

    /// How far it reaches along a unit vector.
    fn reach_m(&self, along: &Vector3<f64>) -> f64 {
        match self {
            Self::Box(half) => along.abs().dot(half),
            Self::Can { radius_m, half_m } => radius_m * along.x.hypot(along.y) + half_m * along.z.abs(),
            Self::Ball(radius_m) => *radius_m,
            Self::Ellipsoid(semi_axes_m) => semi_axes_m.component_mul(along).norm(),
        }
    }
}

/// The point of an ellipsoid that is nearest to a point: `x_i = p_i s_i^2 / (s_i^2 + t)` with the `t >= 0` for which it is on the
/// surface. The equation for `t` is convex and falls, so that Newton's method from 0 goes up to its root.
fn nearest_on_ellipsoid(semi_axes_m: &Vector3<f64>, point: &Point3<f64>) -> Point3<f64> {
    let squares = semi_axes_m.component_mul(semi_axes_m);
    let mut t = 0.0;
    for _ in 0..200 {
        let terms = Vector3::from_fn(|row, _| {
            let below = squares[row] + t;
            squares[row] * point[row] * point[row] / (below * below)
        });
        let slope: f64 = (0..3).map(|row| -2.0 * terms[row] / (squares[row] + t)).sum();
        let next = t - (terms.sum() - 1.0) / slope;
        // Also where the point is inside, and the root below 0.
        if next.is_nan() || next <= t {
            break;
        }
        t = next;
    }
    squares.zip_map(&point.coords, |square, at| square * at / (square + t)).into()
}

/// The distance is between these: the plane across two points, which projections onto one solid and the other in turn bring
/// together (von Neumann), and the distance of the points.
fn bounds_m(solids: [&Solid; 2], a_from_b: &Isometry3<f64>) -> [f64; 2] {
    let mut on_b = a_from_b * Point3::origin();
    let mut bounds = [0.0, f64::INFINITY];
    for step in 0..200_000 {
        let on_a = solids[0].nearest(&on_b);
        on_b = a_from_b * solids[1].nearest(&(a_from_b.inverse() * on_a));
        if step % 100 == 0 {
            let most_m = (on_b - on_a).norm();
            let along = (on_b - on_a) / most_m;
            let in_b = a_from_b.rotation.inverse() * along;
            let apart_m = a_from_b.translation.vector.dot(&along)
                - solids[1].reach_m(&in_b)
                - solids[0].reach_m(&along);
            bounds = [apart_m.max(bounds[0]), most_m];
            if bounds[1] - bounds[0] < DISTANCE_M / 10.0 || most_m < DISTANCE_M {
                break;
            }
        }
    }
    bounds
}

#[test]
fn no_distance_of_cylinders_is_overstated() {
    let mut draws = Draws(3);
    let mut decided = 0;
    for at in 0..2_000 {
        let mut can = || Solid::Can { radius_m: draws.between(0.01, 0.2), half_m: draws.between(0.01, 0.3) };
        let (a, b) = (can(), can());
        let b = if at % 2 == 0 { b } else { Solid::Box(draws.half_sizes()) };
        // Every fourth pair is parallel.
        let turn = if at % 4 < 2 { Vector3::z() * draws.between(-3.0, 3.0) } else { draws.vector(3.0) };
        let a_from_b = Isometry3::new(draws.vector(0.6), turn);
        let [least_m, most_m] = bounds_m([&a, &b], &a_from_b);
        let found_m = a.hulls().distance_m(&b.hulls(), &a_from_b);
        assert!(found_m < most_m + DISTANCE_M, "{found_m} is overstated: {most_m}");
        assert!(found_m > least_m - DISTANCE_M, "{found_m} is understated: {least_m}");
        decided += usize::from(least_m > 0.0 && most_m - least_m < DISTANCE_M);
    }
    assert!(decided > 1_500, "the oracle decides {decided} of 2000");
}

#[test]
fn a_prism_of_many_sides_is_as_far_as_its_points() {
    let mut draws = Draws(4);
    for _ in 0..500 {
        let [sides, radius_m, half_m] =
            [draws.between(20.0, 200.0).floor(), draws.between(0.02, 0.2), draws.between(0.02, 0.3)];
        let turn = std::f64::consts::TAU / sides;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 200")]
        let rim = (0..sides as u32).flat_map(|at| {
            let (sin, cos) = (f64::from(at) * turn).sin_cos();
            [-half_m, half_m].map(|z| Point3::new(radius_m * cos, radius_m * sin, z))
        });
        let prism = mesh(rim.collect());
        // A ball beside the middle of a side, over an edge of the rim, and over the end.
        let apothem_m = radius_m * (turn / 2.0).cos();
        let (sin, cos) = (turn / 2.0).sin_cos();
        let ball = hulls(Geometry::Sphere { radius_m: 0.01 });
        let [out_m, up_m] = [draws.between(0.02, 0.3), draws.between(0.02, 0.3)];
        let beside = Translation3::new(
            (apothem_m + out_m) * cos,
            (apothem_m + out_m) * sin,
            half_m * draws.between(-0.9, 0.9),
        );
        let over = Translation3::new((apothem_m + out_m) * cos, (apothem_m + out_m) * sin, half_m + up_m);
        let above = Translation3::new(0.3 * apothem_m, 0.2 * apothem_m, half_m + up_m);
        for (place, expected_m) in [(beside, out_m), (over, out_m.hypot(up_m)), (above, up_m)] {
            let turned = Isometry3::from_parts(place, UnitQuaternion::new(draws.vector(3.0)));
            let found_m = prism.distance_m(&ball, &turned);
            assert!(
                (found_m - (expected_m - 0.01)).abs() < DISTANCE_M,
                "{found_m} is not {expected_m} - 0.01"
            );
            // A box of no size instead: by support points alone.
            let dot = cuboid(&Vector3::repeat(1e-9));
            let found_m = prism.distance_m(&dot, &turned);
            assert!((found_m - expected_m).abs() < DISTANCE_M, "{found_m} is not {expected_m}");
        }
    }
}

#[test]
fn cylinders_are_as_deep_as_closed_forms_say() {
    let mut draws = Draws(5);
    for _ in 0..300 {
        let [one_m, other_m] = [draws.between(0.02, 0.2), draws.between(0.02, 0.2)];
        let can = |radius_m: f64| hulls(Geometry::Cylinder { radius_m, length_m: 1.0 });
        // Side by side, the ends far away: the radii less the distance of the axes.
        let apart_m = (one_m + other_m) * draws.between(0.05, 0.95);
        let heading = draws.between(-3.0, 3.0);
        let shift = Vector3::new(apart_m * heading.cos(), apart_m * heading.sin(), 0.1);
        let beside = Isometry3::new(shift, Vector3::z() * heading);
        let found_m = -can(one_m).signed_distance_m(&can(other_m), &beside);
        let expected_m = one_m + other_m - apart_m;
        assert!(
            expected_m > 0.45 || (found_m - expected_m).abs() < DISTANCE_M,
            "{found_m} is not {expected_m}"
        );
        // End to end.
        let end = Isometry3::new(Vector3::new(0.3 * one_m, 0.0, 1.0 - 1e-3), Vector3::z() * heading);
        let found_m = -can(one_m).signed_distance_m(&can(other_m), &end);
        assert!((found_m - 1e-3).abs() < DISTANCE_M, "{found_m} is not 1 mm");
    }
}
