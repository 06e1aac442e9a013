//! Where the two bodies of a pair are nearest, and how deep they overlap.

use nalgebra::Point3;

use crate::{Clearance, Pair};

impl Clearance {
    /// The nearest points of one pair, in the root link's frame: on the first subject and on the second.
    pub fn nearest_points(&self, pair: usize) -> Option<[Point3<f64>; 2]> {
        let Pair { a, b } = self.watches[pair].pair;
        let root_from_a = &self.root_from_subjects[a];
        let a_from_b = root_from_a.inv_mul(&self.root_from_subjects[b]);
        let points = self.hulls[a].nearest_points(&self.hulls[b], &a_from_b)?;
        Some(points.map(|point| root_from_a * point))
    }

    /// The signed distance of one pair, m: minus the penetration depth if the two overlap.
    pub fn measure_signed(&self, pair: usize) -> f64 {
        let Pair { a, b } = self.watches[pair].pair;
        let a_from_b = self.root_from_subjects[a].inv_mul(&self.root_from_subjects[b]);
        self.hulls[a].signed_distance_m(&self.hulls[b], &a_from_b)
    }
}
