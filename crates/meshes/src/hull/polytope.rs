//! A convex polytope that grows point by point, and the points that are still outside it (quickhull).
//!
//! Whether a point is above a facet is decided exactly, so the facets are a closed surface for any points; the distance from
//! a facet is rounded, and only decides which point is added next.

use std::{cmp::Ordering, collections::BinaryHeap};

use nalgebra::Point3;
use robust::{Coord3D, orient3d};

use super::triangle::distance_from_triangle;

/// A triangle of the surface, counterclockwise in a view from outside.
struct Facet {
    corners: [usize; 3],
    /// The facet behind the edge from each corner to the next.
    neighbors: [usize; 3],
    /// Points above this facet; a point that is above several facets belongs to one of them only.
    outside: Vec<usize>,
    /// Index in `outside` of the point that is farthest from the triangle, and its distance, m.
    farthest: (usize, f64),
    is_removed: bool,
}

/// An edge around the hole that is left when the facets below a new point are removed.
#[derive(Clone, Copy)]
struct HorizonEdge {
    from: usize,
    to: usize,
    /// The facet on the other side of the edge, which is kept.
    beyond: usize,
}

/// A facet in the queue, ordered by the distance of its farthest point.
#[derive(PartialEq)]
struct QueuedFacet {
    distance_m: f64,
    facet: usize,
}

impl Eq for QueuedFacet {}

/// Farthest first; of equal distances the oldest facet, so that the result does not depend on the heap.
impl Ord for QueuedFacet {
    fn cmp(&self, other: &Self) -> Ordering {
        // The lower number first among equals, so that the hull is the same in every run.
        self.distance_m.total_cmp(&other.distance_m).then(other.facet.cmp(&self.facet))
    }
}

impl PartialOrd for QueuedFacet {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The polytope: its facets, and the queue of facets with points outside.
pub(super) struct Polytope {
    /// The given points; if these lie in one plane, one more point beside the plane.
    points: Vec<Point3<f64>>,
    /// Number of given points, without the extra one.
    given: usize,
    facets: Vec<Facet>,
    next: BinaryHeap<QueuedFacet>,
    added: usize,
    /// Number of times that a point was compared with a facet.
    tests: usize,
    /// The largest distance of a point that could not be added.
    skipped_distance_m: f64,
}

impl Polytope {
    /// Starts with a tetrahedron of four points; `None` if all points are on one line. Points in one plane get an extra point
    /// beside the plane, which does not count as a corner.
    pub(super) fn new(points: &[Point3<f64>], size_m: f64) -> Option<Self> {
        // Each further point is the farthest from the span of those before: a large first tetrahedron contains most points, so
        // few remain outside, and its volume is far from rounding.
        let [a, b] = farthest_pair(points)?;
        let along = points[b] - points[a];
        let beside = |point: &Point3<f64>| along.cross(&(point - points[a])).norm();
        let c = largest(points, beside)?;
        let normal = along.cross(&(points[c] - points[a]));
        if normal.norm() <= 0.0 {
            return None;
        }
        let mut points = points.to_vec();
        let given = points.len();
        // The exact predicate, not the normal: rounding would make a volume of a flat mesh.
        let height = |point: &Point3<f64>| orientation([&points[a], &points[b], &points[c]], point).abs();
        // All heights are exactly 0 only for points in one plane. A flat mesh still needs a volume, or no facet would have an
        // inside; the extra point lies one mesh size beside the plane, far from rounding.
        let d = largest(&points, height).unwrap_or_else(|| {
            points.push(points[a] + normal.normalize() * size_m);
            given
        });
        let mut polytope = Self {
            points,
            given,
            facets: Vec::new(),
            next: BinaryHeap::new(),
            added: 4,
            tests: 0,
            skipped_distance_m: 0.0,
        };
        // Counterclockwise in a view from outside: the fourth point must be below the first facet.
        let [b, c] = if polytope.is_above([a, b, c], d) { [c, b] } else { [b, c] };
        // Each corner's opposite facet is the one with the other three.
        for (corners, neighbors) in
            [([a, b, c], [1, 2, 3]), ([b, a, d], [0, 3, 2]), ([c, b, d], [0, 1, 3]), ([a, c, d], [0, 2, 1])]
        {
            polytope.add_facet(corners, neighbors);
        }
        let all = (0..given).collect();
        polytope.share(all, 0);
        Some(polytope)
    }

    /// The largest distance of an outside point from its facet, m. It bounds the distance from the polytope, since each triangle
    /// is a part of the polytope.
    pub(super) fn farthest_m(&mut self) -> f64 {
        // Removed facets stay in the queue until they reach its top: a heap cannot delete inside.
        while let Some(next) = self.next.peek() {
            if !self.facets[next.facet].is_removed {
                return next.distance_m;
            }
            self.next.pop();
        }
        0.0
    }

    /// Adds the point that is farthest outside: removes all facets that the point is above, and connects the point with the
    /// rim of the hole.
    pub(super) fn add_farthest(&mut self) {
        let Some(QueuedFacet { facet, distance_m }) = self.next.pop() else { return };
        let at = self.facets[facet].farthest.0;
        let point = self.facets[facet].outside[at];
        let (visible, horizon) = self.hole(facet, point);
        let horizon = in_order(horizon);
        let mut outside = Vec::new();
        for &facet in &visible {
            outside.append(&mut self.facets[facet].outside);
        }
        outside.retain(|&other| other != point);
        let Some(horizon) = horizon else {
            // The rim is not one closed loop: volumes that underflow have no sign, so the visible facets are not consistent.
            // The polytope stays as it is, the point is given up, and its distance goes into the bound of the error.
            self.skipped_distance_m = self.skipped_distance_m.max(distance_m);
            return self.share(outside, 0);
        };
        let first = self.facets.len();
        for facet in visible {
            self.facets[facet].is_removed = true;
        }
        // The rim is in order, so the facet of edge i meets those of edges i - 1 and i + 1; the facet beyond the edge gets the
        // new one as its neighbor in place of the removed one.
        for (number, edge) in horizon.iter().enumerate() {
            let (after, before) =
                ((number + 1) % horizon.len(), (number + horizon.len() - 1) % horizon.len());
            self.add_facet([edge.from, edge.to, point], [edge.beyond, first + after, first + before]);
            let beyond = &mut self.facets[edge.beyond];
            for side in 0..3 {
                if beyond.corners[side] == edge.to && beyond.corners[(side + 1) % 3] == edge.from {
                    beyond.neighbors[side] = first + number;
                }
            }
        }
        self.added += 1;
        // Only the new facets are searched, as in quickhull: a point of a removed facet that is still outside is above at least
        // one of them.
        self.share(outside, first);
    }

    /// The largest distance of a point that could not be added.
    pub(super) fn skipped_distance_m(&self) -> f64 {
        self.skipped_distance_m
    }

    /// Number of points that were added; corners that later points have covered are included.
    pub(super) fn corner_count(&self) -> usize {
        self.added
    }

    /// The work so far: how many times a point was compared with a facet.
    pub(super) fn tests(&self) -> usize {
        self.tests
    }

    /// Indices of the given points that are corners, in ascending order.
    pub(super) fn corners(&self) -> Vec<usize> {
        let facets = self.facets.iter().filter(|facet| !facet.is_removed);
        let mut corners: Vec<usize> = facets.flat_map(|facet| facet.corners).collect();
        corners.sort_unstable();
        corners.dedup();
        corners.retain(|&corner| corner < self.given);
        corners
    }

    /// The facets of given points, by the indices of their corners.
    pub(super) fn triangles(&self) -> Vec<[usize; 3]> {
        let facets = self.facets.iter().filter(|facet| !facet.is_removed).map(|facet| facet.corners);
        facets.filter(|corners| corners.iter().all(|corner| *corner < self.given)).collect()
    }

    /// All facets that `point` is above, starting from one of them (`first`), and the edges around them.
    fn hole(&self, first: usize, point: usize) -> (Vec<usize>, Vec<HorizonEdge>) {
        // The facets visible from a point of a convex body are connected, so a search over neighbors finds them all. `visible`
        // is a list: it is short, and its order fixes that of the new facets.
        let (mut visible, mut horizon, mut open) = (vec![first], Vec::new(), vec![first]);
        while let Some(facet) = open.pop() {
            let Facet { corners, neighbors, .. } = &self.facets[facet];
            for side in 0..3 {
                let beyond = neighbors[side];
                if visible.contains(&beyond) {
                    continue;
                }
                if self.is_above(self.facets[beyond].corners, point) {
                    visible.push(beyond);
                    open.push(beyond);
                } else {
                    horizon.push(HorizonEdge { from: corners[side], to: corners[(side + 1) % 3], beyond });
                }
            }
        }
        (visible, horizon)
    }

    fn add_facet(&mut self, corners: [usize; 3], neighbors: [usize; 3]) {
        let (outside, farthest) = (Vec::new(), (0, 0.0));
        self.facets.push(Facet { corners, neighbors, outside, farthest, is_removed: false });
    }

    /// Assigns each point to the facet, from index `first` on, that it is highest above. Points above no facet are inside and
    /// are dropped.
    fn share(&mut self, points: Vec<usize>, first: usize) {
        self.tests += points.len() * (self.facets.len() - first);
        let areas: Vec<f64> = self.facets[first..].iter().map(|facet| self.area(facet.corners)).collect();
        for point in points {
            let height = |(number, facet): (usize, &Facet)| {
                // `orient3d` is positive below the plane of a counterclockwise triangle.
                let above = -orientation(self.corner_points(facet.corners), &self.points[point]);
                (above > 0.0).then_some((above / areas[number], first + number))
            };
            let heights =
                self.facets[first..].iter().enumerate().filter(|(_, of)| !of.is_removed).filter_map(height);
            let Some((_, facet)) = heights.max_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
            let distance_m =
                distance_from_triangle(&self.points[point], self.corner_points(self.facets[facet].corners));
            let facet = &mut self.facets[facet];
            // The first point also if its distance rounds to 0, or the facet would never be taken up.
            if distance_m > facet.farthest.1 || facet.outside.is_empty() {
                facet.farthest = (facet.outside.len(), distance_m);
            }
            facet.outside.push(point);
        }
        let outside = |(_, of): &(usize, &Facet)| !of.is_removed && !of.outside.is_empty();
        for (facet, of) in self.facets.iter().enumerate().skip(first).filter(outside) {
            self.next.push(QueuedFacet { distance_m: of.farthest.1, facet });
        }
    }

    fn corner_points(&self, corners: [usize; 3]) -> [&Point3<f64>; 3] {
        corners.map(|corner| &self.points[corner])
    }

    fn is_above(&self, corners: [usize; 3], point: usize) -> bool {
        orientation(self.corner_points(corners), &self.points[point]) < 0.0
    }

    /// Twice the area of a facet. `orientation` is six times the volume of a tetrahedron, which is this value times the height, so
    /// the quotient is the height.
    fn area(&self, corners: [usize; 3]) -> f64 {
        let [a, b, c] = self.corner_points(corners);
        (b - a).cross(&(c - a)).norm().max(f64::MIN_POSITIVE)
    }
}

/// Sorts edges into one closed loop; `None` if they do not form one.
fn in_order(mut horizon: Vec<HorizonEdge>) -> Option<Vec<HorizonEdge>> {
    for at in 1..horizon.len() {
        let end = horizon[at - 1].to;
        // Quadratic, but a rim has some ten edges.
        let next = (at..horizon.len()).find(|&other| horizon[other].from == end)?;
        horizon.swap(at, next);
    }
    let is_closed =
        horizon.len() > 2 && horizon.last().map(|edge| edge.to) == horizon.first().map(|edge| edge.from);
    is_closed.then_some(horizon)
}

/// Negative if the point is above the triangle, on the side from which it is counterclockwise; exactly 0 in its plane.
fn orientation(triangle: [&Point3<f64>; 3], point: &Point3<f64>) -> f64 {
    let coordinate = |point: &Point3<f64>| Coord3D { x: point.x, y: point.y, z: point.z };
    let [a, b, c] = triangle.map(coordinate);
    orient3d(a, b, c, coordinate(point))
}

/// The index of the point with the largest value; `None` if no value is above 0.
fn largest(points: &[Point3<f64>], value: impl Fn(&Point3<f64>) -> f64) -> Option<usize> {
    let values = points.iter().map(value).enumerate().filter(|(_, value)| *value > 0.0);
    values.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
}

/// The pair with the largest distance among the three pairs of extreme points along the axes: a good start at linear cost.
fn farthest_pair(points: &[Point3<f64>]) -> Option<[usize; 2]> {
    let by = |axis: usize| move |a: &usize, b: &usize| points[*a][axis].total_cmp(&points[*b][axis]);
    let pairs = (0..3)
        // Extremes along the axes: the farthest pair of all would take the square of the number of points.
        .filter_map(|axis| Some([(0..points.len()).min_by(by(axis))?, (0..points.len()).max_by(by(axis))?]));
    let apart = |[a, b]: &[usize; 2]| (points[*b] - points[*a]).norm();
    pairs.max_by(|a, b| apart(a).total_cmp(&apart(b))).filter(|pair| apart(pair) > 0.0)
}
