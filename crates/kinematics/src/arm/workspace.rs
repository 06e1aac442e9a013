//! The positions of the tool within the joint limits: by seeded samples, with the extremes refined.

use std::array::from_fn;

use congruent_description::ArmQ;
use nalgebra::Vector3;

use super::{
    model::Arm,
    pattern_search::maximize,
    sensitivity::Sampling,
    workspace_size::{KnownWorkspace, WorkspaceSize, size},
};
use crate::uniform::Uniform;

/// Smaller extents along an axis, m, count as no motion. Kind: rounding of a dozen products within 10 m.
const FLAT_M: f64 = 1e-12;
/// The samples are divided into this many parts, and the best sample of each part starts a search: an extreme has side peaks,
/// and the best sample of all may lie on one.
const STARTS: usize = 16;
/// Samples that are kept as starts for the test of single points: dense enough for a few steps to a point.
const KEPT: usize = 2048;

/// The positions that the tool centre point can take.
#[derive(Debug, Clone, PartialEq)]
pub struct Workspace {
    /// Smallest and largest distance from the base's origin, m.
    pub reach_m: [f64; 2],
    /// Configurations at which these are attained.
    pub reach_at: [ArmQ; 2],
    /// Smallest x, y and z of the tool centre point in the base, m.
    pub lower_in_base: Vector3<f64>,
    /// Largest x, y and z of the tool centre point in the base, m.
    pub upper_in_base: Vector3<f64>,
    /// Directions of the base in which the tool moves: 3 for a volume, 2 for an area.
    pub dimensions: usize,
    /// Volume or area with an interval; none if the tool moves in one direction only.
    pub size: Option<WorkspaceSize>,
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
        let mut kept = Vec::with_capacity(sampling.samples.min(KEPT));
        // Eight functions whose maxima are the extremes: nearest and farthest point, and both ends along each axis.
        let values: [fn(&Vector3<f64>) -> f64; 8] =
            [|p| -p.norm(), |p| p.norm(), |p| -p.x, |p| -p.y, |p| -p.z, |p| p.x, |p| p.y, |p| p.z];
        let none = || (f64::NEG_INFINITY, q.clone());
        let mut starts: [[(f64, ArmQ); STARTS]; 8] = from_fn(|_| from_fn(|_| none()));
        for sample in 0..sampling.samples {
            self.draw(&mut random, &mut q);
            let point = self.tcp_in_base(&q);
            // Dealing samples out in turn makes the parts independent draws of equal size.
            for (starts, value) in starts.iter_mut().zip(values) {
                let (value, best) = (value(&point), &mut starts[sample % STARTS]);
                if value > best.0 {
                    best.0 = value;
                    best.1.copy_from_slice(&q);
                }
            }
            // The first samples are as random as any others, and keeping only them bounds the memory.
            if kept.len() < KEPT {
                kept.push((point, q.clone()));
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
        let reach_m = [-nearest.0, farthest.0];
        let corners_in_base = [lower_in_base, upper_in_base];
        let known = KnownWorkspace { corners_in_base, moves, reach_m, starts: &kept };
        let size = match dimensions {
            0 | 1 => None,
            // Fewer directions of motion than axes: a surface has no volume, a curve no area.
            _ if self.attainable_ranks()[0] < dimensions => Some(WorkspaceSize::none()),
            _ => Some(size(self, &known, sampling)),
        };
        Workspace {
            reach_m,
            reach_at: [nearest.1, farthest.1],
            lower_in_base,
            upper_in_base,
            dimensions,
            size,
            points_in_base,
        }
    }

    /// Position of the tool centre point in the base at one of the arm's own configurations.
    fn tcp_in_base(&mut self, q: &ArmQ) -> Vector3<f64> {
        self.base_from_tcp(q).expect("q is a configuration of this arm").translation
    }
}
