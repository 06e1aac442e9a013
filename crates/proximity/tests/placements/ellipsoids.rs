//! Ellipsoids beside every other shape.

use super::*;

/// Kind: solver stop of the oracle, which searches directions, and so may miss the least overlap, but not go below it; worst
/// seen 7.4e-7 m (of 2,500 pairs).
const SEARCHED_M: f64 = 2e-6;

/// Another shape for each number: ellipsoid, box, can, ball, and box as a mesh, which the oracle takes as a box.
fn other_shape(at: u32, draws: &mut Draws) -> (Solid, Hulls) {
    let solid = match at % 5 {
        0 => Solid::Ellipsoid(draws.semi_axes()),
        1 | 4 => Solid::Box(draws.half_sizes()),
        2 => Solid::Can { radius_m: draws.between(0.01, 0.2), half_m: draws.between(0.01, 0.3) },
        _ => Solid::Ball(draws.between(0.01, 0.2)),
    };
    let hulls = match &solid {
        Solid::Box(half) if at % 5 == 4 => mesh(corners_of(half)),
        solid => solid.hulls(),
    };
    (solid, hulls)
}

#[test]
fn a_distance_of_an_ellipsoid_is_exact_and_not_overstated() {
    let mut draws = Draws(6);
    let mut decided = 0;
    for at in 0..1_000 {
        let a = Solid::Ellipsoid(draws.semi_axes());
        let (b, of_b) = other_shape(at, &mut draws);
        let a_from_b = Isometry3::new(draws.vector(0.6), draws.vector(3.0));
        let [least_m, most_m] = bounds_m([&a, &b], &a_from_b);
        let of_a = a.hulls();
        for found_m in [of_a.distance_m(&of_b, &a_from_b), of_b.distance_m(&of_a, &a_from_b.inverse())] {
            assert!(found_m < most_m + DISTANCE_M, "{found_m} is overstated: {most_m}");
            assert!(found_m > least_m - DISTANCE_M, "{found_m} is understated: {least_m}");
        }
        decided += usize::from(least_m > 0.0 && most_m - least_m < DISTANCE_M);
    }
    assert!(decided > 900, "the oracle decides {decided} of 1000");
}

#[test]
fn nearest_points_of_an_ellipsoid_are_on_both_shapes() {
    let mut draws = Draws(8);
    let mut apart = 0;
    for at in 0..300 {
        let a = Solid::Ellipsoid(draws.semi_axes());
        let (b, of_b) = other_shape(at, &mut draws);
        let a_from_b = Isometry3::new(draws.vector(0.6), draws.vector(3.0));
        let of_a = a.hulls();
        let distance_m = of_a.distance_m(&of_b, &a_from_b);
        let back = of_b.nearest_points(&of_a, &a_from_b.inverse()).map(|[on_b, on_a]| [on_a, on_b]);
        let back = back.map(|points| points.map(|point| a_from_b * point));
        for [on_a, on_b] in [of_a.nearest_points(&of_b, &a_from_b), back].into_iter().flatten() {
            if distance_m > 0.0 {
                assert!(((on_b - on_a).norm() - distance_m).abs() < 2.0 * DISTANCE_M, "{on_a} {on_b}");
                let in_b = a_from_b.inverse() * on_b;
                let off_m = [(a.nearest(&on_a) - on_a).norm(), (b.nearest(&in_b) - in_b).norm()];
                assert!(off_m.iter().all(|off_m| *off_m < ON_SURFACE_M), "{off_m:?}");
                apart += 1;
            }
        }
    }
    assert!(apart > 500, "{apart}");
}

/// How far a point that is drawn is from its shape. Kind: solver stop; the vector between the points is exact to 1e-10 m in
/// length, to the root of that in direction, and a flat ellipsoid's farthest point moves by much for a small turn. Worst seen
/// 3.7e-5 m (axes of 5 mm to 0.27 m).
const ON_SURFACE_M: f64 = 1e-4;

/// The least overlap over all directions: from many of them, the best few improved by steps across until these are 1e-9 rad.
fn depth_by_directions(solids: [&Solid; 2], a_from_b: &Isometry3<f64>) -> f64 {
    let overlap_m = |along: &Vector3<f64>| {
        let in_b = a_from_b.rotation.inverse() * along;
        solids[0].reach_m(along) + solids[1].reach_m(&in_b) - a_from_b.translation.vector.dot(along)
    };
    let spread = (0..4000).map(|at| {
        let height = 1.0 - (2.0 * f64::from(at) + 1.0) / 4000.0;
        let (sin, cos) = (GOLDEN_ANGLE * f64::from(at)).sin_cos();
        let radius = (1.0 - height * height).sqrt();
        Vector3::new(radius * cos, radius * sin, height)
    });
    let mut starts: Vec<(f64, Vector3<f64>)> = spread.map(|along| (overlap_m(&along), along)).collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let improved = starts.into_iter().take(12).map(|(mut least_m, mut along)| {
        let (mut step, mut offset) = (0.05, 0.0);
        while step > 1e-9 {
            // Other directions each time: along an edge of a box the overlap is a narrow valley.
            offset += GOLDEN_ANGLE;
            let across = along.cross(&Vector3::ith(along.iamin(), 1.0)).normalize();
            let beside = along.cross(&across);
            let turned = (0..32).map(|at| {
                let (sin, cos) = (offset + f64::from(at) * std::f64::consts::TAU / 32.0).sin_cos();
                (along + (across * cos + beside * sin) * step).normalize()
            });
            let next = turned.map(|to| (overlap_m(&to), to)).min_by(|a, b| a.0.total_cmp(&b.0));
            match next.filter(|next| next.0 < least_m) {
                Some(next) => {
                    (least_m, along) = next;
                    step *= 1.5;
                }
                None => step *= 0.8,
            }
        }
        least_m
    });
    improved.fold(f64::INFINITY, f64::min)
}

/// Turned by it again and again, directions are spread evenly, rad.
const GOLDEN_ANGLE: f64 = 2.399_963;

#[test]
fn an_ellipsoid_is_as_deep_as_all_directions_say() {
    let mut draws = Draws(7);
    let mut overlaps = 0;
    while overlaps < 100 {
        let a = Solid::Ellipsoid(draws.semi_axes());
        let (b, of_b) = other_shape(overlaps, &mut draws);
        let a_from_b = Isometry3::new(draws.vector(0.2), draws.vector(3.0));
        let of_a = a.hulls();
        let found_m = of_a.signed_distance_m(&of_b, &a_from_b);
        if found_m >= 0.0 {
            continue;
        }
        overlaps += 1;
        let expected_m = depth_by_directions([&a, &b], &a_from_b);
        for depth_m in [-found_m, -of_b.signed_distance_m(&of_a, &a_from_b.inverse())] {
            assert!(depth_m < expected_m + DISTANCE_M, "{depth_m} is too deep: {expected_m}");
            assert!(depth_m > expected_m - SEARCHED_M, "{depth_m} is too shallow: {expected_m}");
        }
    }
}

/// A distance, or minus a depth, in both orders.
#[track_caller]
fn apart(a: &Hulls, b: &Hulls, a_from_b: &Isometry3<f64>, expected_m: f64) {
    for found_m in [a.signed_distance_m(b, a_from_b), b.signed_distance_m(a, &a_from_b.inverse())] {
        assert!((found_m - expected_m).abs() < DISTANCE_M, "{found_m} is not {expected_m}");
    }
}

#[test]
fn an_ellipsoid_of_equal_axes_is_a_ball() {
    let mut draws = Draws(9);
    for at in 0..500 {
        let radius_m = draws.between(0.01, 0.2);
        let (same, ball) = (ellipsoid(&Vector3::repeat(radius_m)), Solid::Ball(radius_m).hulls());
        let (_, other) = other_shape(at, &mut draws);
        let pose = Isometry3::new(draws.vector(0.5), draws.vector(3.0));
        apart(&same, &other, &pose, ball.signed_distance_m(&other, &pose));
    }
}

#[test]
fn along_an_axis_an_ellipsoid_reaches_as_far_as_this_axis() {
    let mut draws = Draws(10);
    for at in 0..300 {
        let axis = at % 3;
        let along = Vector3::ith(axis, 1.0);
        let (one, other) = (draws.semi_axes(), draws.semi_axes());
        // Apart in two of three, otherwise as deep as a part of the smaller one.
        let gap_m = draws.between(-0.1, 0.2) * one[axis].min(other[axis]);
        // A wall, before whose middle it is; turned about its normal.
        let wall = cuboid(&Vector3::from_fn(|row, _| if row == axis { 0.5 } else { 10.0 }));
        let to_wall = Isometry3::new(along * (one[axis] + gap_m + 0.5), along * draws.between(-3.0, 3.0));
        apart(&ellipsoid(&one), &wall, &to_wall, gap_m);
        // Another one beside it; an overlap may be less along another direction.
        if gap_m > 0.0 {
            let beside = Isometry3::from(Translation3::from(along * (one[axis] + other[axis] + gap_m)));
            apart(&ellipsoid(&one), &ellipsoid(&other), &beside, gap_m);
        }
        // Each around the same origin with the axes along each other: out along the two shortest together.
        let shortest_m = (one + other).min();
        apart(&ellipsoid(&one), &ellipsoid(&other), &Isometry3::identity(), -shortest_m);
    }
}
