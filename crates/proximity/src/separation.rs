//! The nearest point of a convex set to the origin, with a proof: no point of the set is nearer than `least_m`.
//!
//! The set is the difference of two bodies, `{b - a}`, so its distance from the origin is the distance of the bodies. It is
//! known by its lowest point along any direction only: the method of Gilbert, Johnson and Keerthi (1988).

use nalgebra::Vector3;

/// The distance of the set from the origin is between `least_m` and the length of `nearest`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Separation {
    /// A plane with the whole set behind it has this distance from the origin; 0 if no such plane was found.
    pub least_m: f64,
    /// A point of the set.
    pub nearest: Vector3<f64>,
}

/// Up to four points of the set, without an allocation: distances are measured in the loop of a run.
struct SimplexCorners {
    points: [Vector3<f64>; 4],
    count: usize,
}

impl SimplexCorners {
    fn new(points: &[Vector3<f64>]) -> Self {
        let mut corners = Self { points: [Vector3::zeros(); 4], count: 0 };
        for point in points {
            corners.push(*point);
        }
        corners
    }

    fn push(&mut self, point: Vector3<f64>) {
        self.points[self.count] = point;
        self.count += 1;
    }

    fn as_slice(&self) -> &[Vector3<f64>] {
        &self.points[..self.count]
    }
}

/// Stop at this width. Kind: solver stop, well below the error of a distance (1e-7 m).
const WIDTH_M: f64 = 1e-10;

/// Cylinders need about 20 steps, hulls fewer.
const MOST_STEPS: usize = 200;

/// The nearest point, from any point of the set; `lowest` gives the point of the set that is farthest against a direction.
pub(super) fn nearest_to_origin(
    lowest: impl Fn(&Vector3<f64>) -> Vector3<f64>,
    start: Vector3<f64>,
) -> Separation {
    let mut corners = SimplexCorners::new(&[start]);
    let mut found = Separation { least_m: 0.0, nearest: start };
    for _ in 0..MOST_STEPS {
        let length_m = found.nearest.norm();
        if length_m <= WIDTH_M {
            break;
        }
        let along = found.nearest / length_m;
        let corner = lowest(&along);
        found.least_m = found.least_m.max(corner.dot(&along));
        if length_m - found.least_m <= WIDTH_M {
            break;
        }
        corners.push(corner);
        // A plane between the set and the origin outweighs the signs of a flat tetrahedron.
        if found.least_m <= 0.0 && surround_the_origin(corners.as_slice()) {
            return Separation { least_m: 0.0, nearest: Vector3::zeros() };
        }
        let next;
        (next, corners) = nearest_of_corners(corners.as_slice());
        // Rounding: the corners do not come nearer. The bounds hold as they are.
        if next.norm() >= length_m {
            break;
        }
        found.nearest = next;
    }
    found
}

/// A unit vector along a vector, or along x if it has no direction.
pub(super) fn direction(vector: &Vector3<f64>) -> Vector3<f64> {
    vector.try_normalize(0.0).filter(|unit| unit.norm().is_finite()).unwrap_or_else(Vector3::x)
}

/// Whether four corners surround the origin: on each face it is on the side of the fourth corner.
fn surround_the_origin(corners: &[Vector3<f64>]) -> bool {
    let [a, b, c, d] = corners else { return false };
    [[a, b, c, d], [a, b, d, c], [a, c, d, b], [b, c, d, a]].iter().all(|[a, b, c, opposite]| {
        let normal = (*b - *a).cross(&(*c - *a));
        normal.dot(&-**a) * normal.dot(&(*opposite - *a)) > 0.0
    })
}

/// The point nearest to the origin in the hull of up to four corners that do not surround it, and the corners it is between.
fn nearest_of_corners(corners: &[Vector3<f64>]) -> (Vector3<f64>, SimplexCorners) {
    let mut nearest = (corners[0], SimplexCorners::new(&corners[..1]));
    let mut offer = |point: Vector3<f64>, between: &[Vector3<f64>]| {
        if point.norm_squared() < nearest.0.norm_squared() {
            nearest = (point, SimplexCorners::new(between));
        }
    };
    // All corners, edges and triangles: few, and none is missed where a shortcut by regions fails on thin triangles.
    for (index, a) in corners.iter().enumerate() {
        offer(*a, &[*a]);
        for (skipped, b) in corners[index + 1..].iter().enumerate() {
            if let Some(point) = foot_on_edge(a, b) {
                offer(point, &[*a, *b]);
            }
            for c in &corners[index + skipped + 2..] {
                if let Some(point) = foot_on_triangle(a, b, c) {
                    offer(point, &[*a, *b, *c]);
                }
            }
        }
    }
    nearest
}

/// The foot of the perpendicular from the origin, if it is within the edge.
fn foot_on_edge(a: &Vector3<f64>, b: &Vector3<f64>) -> Option<Vector3<f64>> {
    let along = b - a;
    let share = -a.dot(&along) / along.norm_squared();
    (share > 0.0 && share < 1.0).then(|| a + along * share)
}

/// The foot of the perpendicular from the origin, if it is within the triangle.
fn foot_on_triangle(a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>) -> Option<Vector3<f64>> {
    let (to_b, to_c) = (b - a, c - a);
    let normal = to_b.cross(&to_c);
    let size = normal.norm_squared();
    let (share_b, share_c) = (normal.dot(&to_c.cross(a)) / size, normal.dot(&a.cross(&to_b)) / size);
    let is_within = share_b > 0.0 && share_c > 0.0 && share_b + share_c < 1.0;
    is_within.then(|| a + to_b * share_b + to_c * share_c)
}
