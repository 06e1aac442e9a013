//! The distance of a point from a triangle.

use nalgebra::{Point3, Vector3};

/// The distance of a point from the triangle `[a, b, c]`, m.
///
/// Source: Ericson, *Real-Time Collision Detection* (2005), sec. 5.1.5.
pub(super) fn distance_from_triangle(point: &Point3<f64>, [a, b, c]: [&Point3<f64>; 3]) -> f64 {
    let (to_b, to_c) = (b - a, c - a);
    let along = |from: &Point3<f64>| {
        let there = point - from;
        (to_b.dot(&there), to_c.dot(&there))
    };
    let (a_b, a_c) = along(a);
    let (b_b, b_c) = along(b);
    let (c_b, c_c) = along(c);
    // Barycentric coordinates of the foot of the perpendicular, times four times the squared area (Ericson, sec. 5.1.5), from
    // the six dot products alone.
    let (of_a, of_b, of_c) = (b_b * c_c - c_b * b_c, c_b * a_c - a_b * c_c, a_b * b_c - b_b * a_c);
    // If the foot lies inside, the distance is the height. A degenerate triangle has a sum of 0 and is left to its edges.
    let all = of_a + of_b + of_c;
    let inside = of_a > 0.0 && of_b > 0.0 && of_c > 0.0 && all > 0.0;
    let on_edges = [(a, b), (b, c), (c, a)].map(|(from, to)| distance_from_segment(point, from, to));
    let nearest_edge = on_edges.into_iter().fold(f64::INFINITY, f64::min);
    // The minimum with the edges bounds the error if rounding puts a foot near an edge on the wrong side.
    if inside {
        let foot: Vector3<f64> = to_b * (of_b / all) + to_c * (of_c / all);
        nearest_edge.min((point - (a + foot)).norm())
    } else {
        nearest_edge
    }
}

fn distance_from_segment(point: &Point3<f64>, from: &Point3<f64>, to: &Point3<f64>) -> f64 {
    let (along, there) = (to - from, point - from);
    let square = along.norm_squared();
    let share = if square > 0.0 { (along.dot(&there) / square).clamp(0.0, 1.0) } else { 0.0 };
    (there - along * share).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(point: [f64; 3], expected: f64) {
        let [a, b, c] =
            [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]].map(|of: [f64; 3]| Point3::from(of));
        for corners in [[&a, &b, &c], [&c, &b, &a], [&b, &c, &a]] {
            let found = distance_from_triangle(&Point3::from(point), corners);
            assert!((found - expected).abs() < 1e-15, "{found}");
        }
    }

    #[test]
    fn height_edge_or_corner() {
        check([1.0, 1.0, -2.0], 2.0);
        check([2.0, -3.0, 4.0], 5.0);
        check([-3.0, -4.0, 0.0], 5.0);
        check([2.0 + 3.0, 1.5 + 4.0, 0.0], 5.0);
        check([1.0, 1.0, 0.0], 0.0);
    }
}
