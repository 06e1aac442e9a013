//! A convex polytope that grows point by point, and the points that are still outside of it.
//!
//! Whether a point is above a facet is decided exactly, so the facets are a closed surface whatever the points are; how far
//! it is from a facet is rounded, and only decides which point is next.

use std::{cmp::Ordering, collections::BinaryHeap};

use nalgebra::Point3;
use robust::{Coord3D, orient3d};

use super::triangle::distance_from_triangle;

/// A triangle of the surface, counterclockwise as seen from outside.
struct Facet {
    corners: [usize; 3],
    /// The facet behind the edge from each corner to the next.
    neighbors: [usize; 3],
    /// Points above it that are above no facet that took them before.
    outside: Vec<usize>,
    /// Where that one stands in `outside` which is farthest from the triangle, and how far.
    farthest: (usize, f64),
    is_removed: bool,
}

/// An edge of the hole that a new point makes.
#[derive(Clone, Copy)]
struct Rim {
    from: usize,
    to: usize,
    /// The facet that stays there.
    beyond: usize,
}

/// A facet by the point that is farthest from it.
#[derive(PartialEq)]
struct Next {
    distance_m: f64,
    facet: usize,
}

impl Eq for Next {}

/// Farthest first; of equal ones the oldest facet, so that the order is fixed.
impl Ord for Next {
    fn cmp(&self, other: &Self) -> Ordering {
        self.distance_m.total_cmp(&other.distance_m).then(other.facet.cmp(&self.facet))
    }
}

impl PartialOrd for Next {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The polytope.
pub(super) struct Polytope {
    /// Those that it is of, and for points in a plane one more beside it.
    points: Vec<Point3<f64>>,
    /// How many points were given.
    given: usize,
    facets: Vec<Facet>,
    next: BinaryHeap<Next>,
    added: usize,
    /// The largest distance of a point that could not be added.
    left_out_m: f64,
}

impl Polytope {
    /// A tetrahedron of four points; `None` if all are on one line. Points in a plane get a fifth beside it, which is no
    /// corner.
    pub(super) fn new(points: &[Point3<f64>], size_m: f64) -> Option<Self> {
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
        let height = |point: &Point3<f64>| orientation([&points[a], &points[b], &points[c]], point).abs();
        let d = largest(&points, height).unwrap_or_else(|| {
            points.push(points[a] + normal.normalize() * size_m);
            given
        });
        let mut polytope =
            Self { points, given, facets: Vec::new(), next: BinaryHeap::new(), added: 4, left_out_m: 0.0 };
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

    /// The largest distance of a point outside from a facet, which bounds that from the polytope: each triangle is a part
    /// of it.
    pub(super) fn farthest_m(&mut self) -> f64 {
        while let Some(next) = self.next.peek() {
            if !self.facets[next.facet].is_removed {
                return next.distance_m;
            }
            self.next.pop();
        }
        0.0
    }

    /// Adds the point that is farthest outside.
    pub(super) fn add_farthest(&mut self) {
        let Some(Next { facet, distance_m }) = self.next.pop() else { return };
        let at = self.facets[facet].farthest.0;
        let point = self.facets[facet].outside[at];
        let (seen, rim) = self.hole(facet, point);
        let rim = in_order(rim);
        let mut outside = Vec::new();
        for &facet in &seen {
            outside.append(&mut self.facets[facet].outside);
        }
        outside.retain(|&other| other != point);
        let Some(rim) = rim else {
            // Volumes that are too small for a number have no sign.
            self.left_out_m = self.left_out_m.max(distance_m);
            return self.share(outside, 0);
        };
        let first = self.facets.len();
        for facet in seen {
            self.facets[facet].is_removed = true;
        }
        for (number, edge) in rim.iter().enumerate() {
            let (after, before) = ((number + 1) % rim.len(), (number + rim.len() - 1) % rim.len());
            self.add_facet([edge.from, edge.to, point], [edge.beyond, first + after, first + before]);
            let beyond = &mut self.facets[edge.beyond];
            for side in 0..3 {
                if beyond.corners[side] == edge.to && beyond.corners[(side + 1) % 3] == edge.from {
                    beyond.neighbors[side] = first + number;
                }
            }
        }
        self.added += 1;
        self.share(outside, first);
    }

    /// The largest distance of a point that could not be added.
    pub(super) fn left_out_m(&self) -> f64 {
        self.left_out_m
    }

    /// How many points were added; corners that later ones have covered count, too.
    pub(super) fn corner_count(&self) -> usize {
        self.added
    }

    /// The corners, in their order.
    pub(super) fn corners(&self) -> Vec<usize> {
        let facets = self.facets.iter().filter(|facet| !facet.is_removed);
        let mut corners: Vec<usize> = facets.flat_map(|facet| facet.corners).collect();
        corners.sort_unstable();
        corners.dedup();
        corners.retain(|&corner| corner < self.given);
        corners
    }

    /// The facets that a point above one of them is above, and the edges around them.
    fn hole(&self, first: usize, point: usize) -> (Vec<usize>, Vec<Rim>) {
        let (mut seen, mut rim, mut open) = (vec![first], Vec::new(), vec![first]);
        while let Some(facet) = open.pop() {
            let Facet { corners, neighbors, .. } = &self.facets[facet];
            for side in 0..3 {
                let beyond = neighbors[side];
                if seen.contains(&beyond) {
                    continue;
                }
                if self.is_above(self.facets[beyond].corners, point) {
                    seen.push(beyond);
                    open.push(beyond);
                } else {
                    rim.push(Rim { from: corners[side], to: corners[(side + 1) % 3], beyond });
                }
            }
        }
        (seen, rim)
    }

    fn add_facet(&mut self, corners: [usize; 3], neighbors: [usize; 3]) {
        let (outside, farthest) = (Vec::new(), (0, 0.0));
        self.facets.push(Facet { corners, neighbors, outside, farthest, is_removed: false });
    }

    /// Gives each point to the facet, from `first` on, that it is highest above; those above none are inside.
    fn share(&mut self, points: Vec<usize>, first: usize) {
        let areas: Vec<f64> = self.facets[first..].iter().map(|facet| self.area(facet.corners)).collect();
        for point in points {
            let height = |(number, facet): (usize, &Facet)| {
                let above = -orientation(self.of(facet.corners), &self.points[point]);
                (above > 0.0).then_some((above / areas[number], first + number))
            };
            let heights =
                self.facets[first..].iter().enumerate().filter(|(_, of)| !of.is_removed).filter_map(height);
            let Some((_, facet)) = heights.max_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
            let distance_m = distance_from_triangle(&self.points[point], self.of(self.facets[facet].corners));
            let facet = &mut self.facets[facet];
            if distance_m > facet.farthest.1 || facet.outside.is_empty() {
                facet.farthest = (facet.outside.len(), distance_m);
            }
            facet.outside.push(point);
        }
        let outside = |(_, of): &(usize, &Facet)| !of.is_removed && !of.outside.is_empty();
        for (facet, of) in self.facets.iter().enumerate().skip(first).filter(outside) {
            self.next.push(Next { distance_m: of.farthest.1, facet });
        }
    }

    fn of(&self, corners: [usize; 3]) -> [&Point3<f64>; 3] {
        corners.map(|corner| &self.points[corner])
    }

    fn is_above(&self, corners: [usize; 3], point: usize) -> bool {
        orientation(self.of(corners), &self.points[point]) < 0.0
    }

    /// Twice the area, by which a volume is a height.
    fn area(&self, corners: [usize; 3]) -> f64 {
        let [a, b, c] = self.of(corners);
        (b - a).cross(&(c - a)).norm().max(f64::MIN_POSITIVE)
    }
}

/// Edges as one loop; `None` if they are none.
fn in_order(mut rim: Vec<Rim>) -> Option<Vec<Rim>> {
    for at in 1..rim.len() {
        let end = rim[at - 1].to;
        let next = (at..rim.len()).find(|&other| rim[other].from == end)?;
        rim.swap(at, next);
    }
    let is_closed = rim.len() > 2 && rim.last().map(|edge| edge.to) == rim.first().map(|edge| edge.from);
    is_closed.then_some(rim)
}

/// Negative if the point is above the triangle, on the side from which it is counterclockwise; exactly 0 in its plane.
fn orientation(triangle: [&Point3<f64>; 3], point: &Point3<f64>) -> f64 {
    let coordinate = |point: &Point3<f64>| Coord3D { x: point.x, y: point.y, z: point.z };
    let [a, b, c] = triangle.map(coordinate);
    orient3d(a, b, c, coordinate(point))
}

/// The index with the largest value above 0.
fn largest(points: &[Point3<f64>], value: impl Fn(&Point3<f64>) -> f64) -> Option<usize> {
    let values = points.iter().map(value).enumerate().filter(|(_, value)| *value > 0.0);
    values.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
}

/// Of the points that are farthest along the axes the two that are farthest apart.
fn farthest_pair(points: &[Point3<f64>]) -> Option<[usize; 2]> {
    let by = |axis: usize| move |a: &usize, b: &usize| points[*a][axis].total_cmp(&points[*b][axis]);
    let pairs = (0..3)
        .filter_map(|axis| Some([(0..points.len()).min_by(by(axis))?, (0..points.len()).max_by(by(axis))?]));
    let apart = |[a, b]: &[usize; 2]| (points[*b] - points[*a]).norm();
    pairs.max_by(|a, b| apart(a).total_cmp(&apart(b))).filter(|pair| apart(pair) > 0.0)
}
