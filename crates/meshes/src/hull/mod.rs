//! Reduces a mesh to the points that its convex hull needs. Distances and contacts are computed for hulls, and their cost
//! grows with the square of the number of points. The result is exact if the hull has few points; otherwise it has as many
//! points as their accuracy justifies, with a bound of the error.

mod polytope;
mod triangle;

use nalgebra::Point3;

use self::polytope::Polytope;

/// Most points of a hull; a mesh with fewer vertices is used as it is. Kind: speed; a distance costs 10 ns for each point, and a
/// ball with so many is 0.05 % of its diameter too small.
const MOST_POINTS: usize = 4000;
/// Most comparisons of a point with a facet, after which no point is added. Kind: speed; some 10 s. A part as it is built needs a
/// hundredth of them for a million vertices, most of which are soon inside; of a million on a ball all stay outside.
const MOST_TESTS: usize = 100_000_000;
/// Points are added until no vertex is farther than this outside the hull, as a share of the size. No unit; kind: choice, below the digits of a mesh
/// file and below what a distance of shapes of 10 m is off, 1e-7 m.
const NEGLIGIBLE: f64 = 1e-8;
/// Rounding of a distance from a triangle, as a share of the size. No unit; kind: rounding of some dozen operations.
const ROUNDING: f64 = 1e-14;

/// Points of a mesh whose convex hull is that of the mesh, or a little smaller.
#[derive(Debug, Clone, PartialEq)]
pub struct HullPoints {
    /// Some of the mesh's vertices, in their order.
    pub points_m: Vec<Point3<f64>>,
    /// No vertex is farther than this from the hull of the points; 0 if none is left out.
    pub error_m: f64,
}

impl HullPoints {
    /// The points for the hull of some vertices: all of them if they are few.
    ///
    /// Source: Barber, Dobkin, Huhdanpaa, *The quickhull algorithm for convex hulls* (1996), with the farthest point of
    /// all facets first, so that it can end early.
    ///
    /// # Examples
    /// What is inside of a cube is not needed:
    /// ```
    /// use congruent_meshes::HullPoints;
    /// use nalgebra::Point3;
    /// let grid = |n: u32| Point3::from([n % 20, n / 20 % 20, n / 400].map(f64::from));
    /// let vertices: Vec<_> = (0..8000).map(grid).collect();
    /// let hull = HullPoints::from_vertices(&vertices);
    /// assert_eq!((hull.points_m.len(), hull.error_m), (8, 0.0));
    /// ```
    pub fn from_vertices(vertices_m: &[Point3<f64>]) -> Self {
        if vertices_m.len() <= MOST_POINTS {
            return Self { points_m: vertices_m.to_vec(), error_m: 0.0 };
        }
        Self::at_most(vertices_m, MOST_POINTS)
    }

    /// The same with at most `most` points; the four points of the first tetrahedron are always included.
    fn at_most(vertices_m: &[Point3<f64>], most: usize) -> Self {
        Self::limited(vertices_m, most, MOST_TESTS)
    }

    /// The same with the work that is given: it ends with fewer points and a larger error.
    fn limited(vertices_m: &[Point3<f64>], most: usize, most_tests: usize) -> Self {
        let size_m = size(vertices_m);
        let Some(mut polytope) = Polytope::new(vertices_m, size_m) else {
            // All on one line: there is no hull, and the caller that builds one refuses these points with its own message.
            return Self { points_m: vertices_m[..vertices_m.len().min(most)].to_vec(), error_m: 0.0 };
        };
        // Farthest point first: each added point removes the largest error, so the loop may end at any time with the smallest
        // error for this number of points.
        let mut outside_m = polytope.farthest_m();
        while outside_m > NEGLIGIBLE * size_m
            && polytope.corner_count() < most
            && polytope.tests() < most_tests
        {
            polytope.add_farthest();
            outside_m = polytope.farthest_m();
        }
        let points_m = polytope.corners().into_iter().map(|corner| vertices_m[corner]).collect();
        // Points that could not be added count, too. The rounding of the distances is added to the bound, except for an exact
        // hull, whose error of 0 follows from the exact orientation test alone.
        let outside_m = outside_m.max(polytope.skipped_distance_m());
        let error_m = if outside_m > 0.0 { outside_m + ROUNDING * size_m } else { 0.0 };
        Self { points_m, error_m }
    }
}

/// The triangles of the convex hull of some points, as indices, counter-clockwise in a view from outside; none if the points have no
/// plane. Of points in one plane they are one side.
///
/// # Examples
/// ```
/// use congruent_meshes::hull_triangles;
/// use nalgebra::Point3;
/// let corner = |n: u8| Point3::from([n & 1, n >> 1 & 1, n >> 2].map(f64::from));
/// let cube: Vec<_> = (0..8).map(corner).collect();
/// assert_eq!(hull_triangles(&cube).len(), 12);
/// ```
pub fn hull_triangles(vertices_m: &[Point3<f64>]) -> Vec<[usize; 3]> {
    let size_m = size(vertices_m);
    let Some(mut polytope) = Polytope::new(vertices_m, size_m) else { return Vec::new() };
    while polytope.farthest_m() > NEGLIGIBLE * size_m && polytope.tests() < MOST_TESTS {
        polytope.add_farthest();
    }
    polytope.triangles()
}

/// The diagonal of the box around points.
fn size(points: &[Point3<f64>]) -> f64 {
    let Some(first) = points.first() else { return 0.0 };
    let (least, most) =
        points.iter().fold((*first, *first), |(least, most), point| (least.inf(point), most.sup(point)));
    (most - least).norm()
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    /// Points that fill directions evenly: a spiral.
    fn directions(count: u32) -> impl Iterator<Item = Vector3<f64>> {
        (0..count).map(move |at| {
            let height = 1.0 - (2.0 * f64::from(at) + 1.0) / f64::from(count);
            let (sin, cos) = (2.399_963_229_728_653 * f64::from(at)).sin_cos();
            let radius = (1.0 - height * height).sqrt();
            Vector3::new(radius * cos, radius * sin, height)
        })
    }

    /// How far vertices are outside of a hull: the largest difference of the supports in many directions.
    fn outside(vertices: &[Point3<f64>], hull: &[Point3<f64>]) -> f64 {
        let support = |points: &[Point3<f64>], along: &Vector3<f64>| {
            points.iter().map(|point| point.coords.dot(along)).fold(f64::NEG_INFINITY, f64::max)
        };
        directions(2000).map(|along| support(vertices, &along) - support(hull, &along)).fold(0.0, f64::max)
    }

    /// The hull omits no more than it says, and that is no more than `share` of the size.
    #[track_caller]
    fn check(vertices: &[Point3<f64>], most: usize, share: f64) -> HullPoints {
        let hull = HullPoints::at_most(vertices, most);
        let outside = outside(vertices, &hull.points_m);
        let rounding = 1e-12 * size(vertices);
        assert!(outside <= hull.error_m + rounding, "{outside} {}", hull.error_m);
        assert!(hull.error_m <= share * size(vertices), "{} of {}", hull.error_m, size(vertices));
        assert!(hull.points_m.len() <= most.max(4), "{}", hull.points_m.len());
        hull
    }

    fn ball(count: u32, noise: f64) -> Vec<Point3<f64>> {
        let radius = |at: u32| 0.3 + noise * (f64::from(at) * 12.9898).sin();
        (0..count).zip(directions(count)).map(|(at, along)| Point3::from(along * radius(at))).collect()
    }

    #[test]
    fn a_ball_of_which_no_point_is_inside_is_cut_within_a_stated_error() {
        let hull = check(&ball(20_000, 0.0), 1000, 1.5e-3);
        assert!(hull.error_m > 0.0);
        check(&ball(20_000, 0.0), MOST_POINTS, 4e-4);
        check(&ball(20_000, 0.05), MOST_POINTS, NEGLIGIBLE);
    }

    #[test]
    fn a_hull_that_takes_too_long_has_fewer_points_and_a_larger_stated_error() {
        let vertices = ball(20_000, 0.0);
        let [short, long] = [200_000, MOST_TESTS].map(|tests| HullPoints::limited(&vertices, 1000, tests));
        assert!(short.points_m.len() < long.points_m.len() && short.error_m > long.error_m);
        assert!(outside(&vertices, &short.points_m) <= short.error_m + 1e-12, "{}", short.error_m);
    }

    #[test]
    fn degenerate_shapes_have_exact_hulls() {
        let grid = |n: u32| [n % 30, n / 30].map(|it| f64::from(it) * 0.01);
        let plate: Vec<_> = (0..900).map(|n| Point3::new(grid(n)[0], grid(n)[1], 0.5)).collect();
        assert_eq!(check(&plate, 100, 0.0).points_m.len(), 4);
        let tilted: Vec<_> =
            (0..900).map(|n| Point3::new(grid(n)[0], grid(n)[1], 0.3 * grid(n)[0])).collect();
        check(&tilted, 100, NEGLIGIBLE);
        let tube = |n: u32| {
            let (sin, cos) = (f64::from(n % 24) * std::f64::consts::TAU / 24.0).sin_cos();
            Point3::new(0.1 * cos, 0.1 * sin, f64::from(n / 24) * 0.01)
        };
        let tube: Vec<_> = (0..960).map(tube).collect();
        assert!(check(&tube, 400, NEGLIGIBLE).points_m.len() >= 48);
        let twice: Vec<_> = plate.iter().chain(&plate).chain(&tube).copied().collect();
        check(&twice, 400, NEGLIGIBLE);
        let line: Vec<_> = (0..500).map(|n| Point3::new(f64::from(n), 2.0 * f64::from(n), 0.0)).collect();
        assert_eq!(HullPoints::at_most(&line, 100).points_m.len(), 100);
        let point = vec![Point3::new(1.0, 2.0, 3.0); 500];
        assert_eq!(HullPoints::at_most(&point, 100).points_m.len(), 100);
    }

    #[test]
    fn sizes_and_places_far_from_one_make_no_difference() {
        for (scale, shift) in [(1e-9, 0.0), (1e6, 0.0), (1e-3, 1e5)] {
            let moved: Vec<_> = ball(5000, 0.02)
                .iter()
                .map(|point| Point3::from(point.coords * scale) + Vector3::repeat(shift))
                .collect();
            check(&moved, 2000, 1e-3);
        }
    }

    #[test]
    fn few_points_stay_as_they_are() {
        let vertices = ball(100, 0.1);
        assert_eq!(HullPoints::from_vertices(&vertices), HullPoints { points_m: vertices, error_m: 0.0 });
    }
}
