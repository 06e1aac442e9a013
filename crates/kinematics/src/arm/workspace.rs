//! The positions of the tool within the joint limits: by seeded samples, with the extremes refined.

use std::{array::from_fn, collections::BTreeSet};

use congruent_description::ArmQ;
use nalgebra::Vector3;

use super::{model::Arm, pattern_search::maximize, sensitivity::Sampling};
use crate::uniform::Uniform;

/// Below this extent the tool does not leave a plane. Kind: rounding of a dozen products within 10 m.
const FLAT_M: f64 = 1e-12;
/// Cells along the largest reach for the estimate of a volume and of an area: with some 10^5 samples
/// a cell inside holds a dozen.
const CELLS: [f64; 4] = [1.0, 400.0, 100.0, 20.0];

/// Parts of the samples, the best of each of which starts a search: an extreme has side peaks, and the
/// best sample of all may lie on one.
const STARTS: usize = 16;

/// The positions that the tool centre point can take.
#[derive(Debug, Clone, PartialEq)]
pub struct Workspace {
    /// Smallest and largest distance from the base's origin, m.
    pub reach_m: [f64; 2],
    /// Configurations at which these are attained.
    pub reach_at: [ArmQ; 2],
    /// Smallest coordinates in the base, m.
    pub lower_in_base: Vector3<f64>,
    /// Largest coordinates in the base, m.
    pub upper_in_base: Vector3<f64>,
    /// Directions of the base in which the tool moves: 3 for a volume, 2 for an area.
    pub dimensions: usize,
    /// Volume in m^3 or area in m^2: cells that were reached, those at the boundary counted half.
    pub extent: f64,
    /// Edge of a cell, m: the error of `extent` is some share of the surface times it.
    pub cell_m: f64,
    /// The samples, in the base.
    pub points_in_base: Vec<Vector3<f64>>,
}

impl Arm {
    /// The workspace of the arm, from random configurations and local search for its extremes.
    ///
    /// # Panics
    /// Never: the arm's own configurations fit it.
    pub fn workspace(&mut self, sampling: Sampling) -> Workspace {
        let mut random = Uniform::seeded(sampling.seed);
        let mut q = self.middle();
        let mut points_in_base = Vec::with_capacity(sampling.samples);
        // Nearest, farthest, and both ends along each axis, each with the best configuration.
        let values: [fn(&Vector3<f64>) -> f64; 8] =
            [|p| -p.norm(), |p| p.norm(), |p| -p.x, |p| -p.y, |p| -p.z, |p| p.x, |p| p.y, |p| p.z];
        let none = || (f64::NEG_INFINITY, q.clone());
        let mut starts: [[(f64, ArmQ); STARTS]; 8] = from_fn(|_| from_fn(|_| none()));
        for sample in 0..sampling.samples {
            self.draw(&mut random, &mut q);
            let point = self.tcp_in_base(&q);
            for (starts, value) in starts.iter_mut().zip(values) {
                let (value, best) = (value(&point), &mut starts[sample % STARTS]);
                if value > best.0 {
                    best.0 = value;
                    best.1.copy_from_slice(&q);
                }
            }
            points_in_base.push(point);
        }
        let joints = self.joints().to_vec();
        let mut value = values.into_iter();
        let [nearest, farthest, ends @ ..] = starts.map(|starts| {
            let value = value.next().expect("a value for each of the extremes");
            starts.into_iter().fold((f64::NEG_INFINITY, self.middle()), |best, (_, mut q)| {
                let top = maximize(&joints, &mut q, |q| value(&self.tcp_in_base(q)));
                if top > best.0 { (top, q) } else { best }
            })
        });
        let end = |at: usize, sign: f64| sign * ends[at].0;
        let lower_in_base = Vector3::new(end(0, -1.0), end(1, -1.0), end(2, -1.0));
        let upper_in_base = Vector3::new(end(3, 1.0), end(4, 1.0), end(5, 1.0));
        let moves = (upper_in_base - lower_in_base).map(|extent| extent > FLAT_M);
        let dimensions = moves.iter().filter(|&&moves| moves).count();
        let cell_m = (farthest.0 / CELLS[dimensions]).max(f64::MIN_POSITIVE);
        Workspace {
            reach_m: [-nearest.0, farthest.0],
            reach_at: [nearest.1, farthest.1],
            lower_in_base,
            upper_in_base,
            dimensions,
            extent: extent(&points_in_base, moves, cell_m),
            cell_m,
            points_in_base,
        }
    }

    /// At one of its own configurations.
    fn tcp_in_base(&mut self, q: &ArmQ) -> Vector3<f64> {
        self.base_from_tcp(q).expect("q is a configuration of this arm").translation
    }
}

/// Size of the cells that hold a point; a cell with an empty neighbour counts half.
fn extent(points: &[Vector3<f64>], moves: Vector3<bool>, cell_m: f64) -> f64 {
    let axes: Vec<usize> = (0..3).filter(|&axis| moves[axis]).collect();
    #[expect(clippy::cast_possible_truncation, reason = "at most some hundred cells along an axis")]
    let cell = |point: &Vector3<f64>| -> [i32; 3] {
        [0, 1, 2].map(|axis| if moves[axis] { (point[axis] / cell_m).floor() as i32 } else { 0 })
    };
    let cells: BTreeSet<[i32; 3]> = points.iter().map(cell).collect();
    let neighbour = |cell: &[i32; 3], axis: usize, step: i32| {
        let mut cell = *cell;
        cell[axis] += step;
        cell
    };
    let inside = |cell: &[i32; 3]| {
        axes.iter().all(|&axis| [-1, 1].iter().all(|&step| cells.contains(&neighbour(cell, axis, step))))
    };
    let count: f64 = cells.iter().map(|cell| if inside(cell) { 1.0 } else { 0.5 }).sum();
    axes.iter().fold(count, |extent, _| extent * cell_m)
}
