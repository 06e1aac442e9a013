//! The largest difference of torque by acceleration, over all positions of the joints and all accelerations up to a
//! limit: attained, and certified from above.

use congruent_description::RobotQ;
use congruent_dynamics::{BodyTree, DynamicsBuffer, DynamicsError, SpatialInertia};
use nalgebra::DMatrix;

use super::{
    branch::{Stop, upper_bound},
    climb,
    gravity::{TorqueBracket, TorqueCertificate},
    trigonometric::{Measure, Trigonometric},
    ways::Ways,
};
use crate::{
    side::Side,
    thresholds::{
        CLOSED, LARGEST_ACCELERATION, MAX_BOXES, MAX_CONTROL_VALUES, MAX_SQUARED_VARIABLES, SAME_FIGURE,
    },
};

/// Brackets the difference of torque by acceleration, each joint's up to 10 rad/s^2 or m/s^2, between a candidate and a
/// reference in the candidate's geometry; armature is not in it.
pub(crate) fn certify(
    candidate: &Side,
    reference: &Side,
    seed: u64,
) -> Result<TorqueCertificate, DynamicsError> {
    let rows = Rows::new(candidate, reference);
    let brackets = (0..candidate.frames.dof()).map(|joint| rows.bracket(joint, seed));
    let by_joint = brackets.filter_map(Result::transpose).collect::<Result<_, _>>()?;
    Ok(TorqueCertificate::of(by_joint))
}

/// Two mass matrices and what computes them.
struct Memory {
    buffers: [DynamicsBuffer; 2],
    matrices: [DMatrix<f64>; 2],
}

/// The rows of the difference of two mass matrices.
struct Rows<'a> {
    candidate: &'a Side,
    ways: Ways<'a>,
    trees: [BodyTree; 2],
    /// A bound of what each body adds to any entry.
    largest_entries: Vec<f64>,
}

impl<'a> Rows<'a> {
    fn new(candidate: &'a Side, reference: &Side) -> Self {
        let reach_m = candidate.frames.reach_m.max(1.0);
        let size = |body: &SpatialInertia| {
            let moment = body.first_moment_kg_m.norm();
            body.tensor_kg_m2.norm() + 2.0 * moment * reach_m + body.mass_kg.abs() * reach_m * reach_m
        };
        let (found, expected) = (candidate.bodies(), reference.bodies());
        let entries: Vec<[f64; 2]> = found
            .iter()
            .zip(&expected)
            .map(|(a, b)| {
                let difference = SpatialInertia {
                    mass_kg: a.mass_kg - b.mass_kg,
                    first_moment_kg_m: a.first_moment_kg_m - b.first_moment_kg_m,
                    tensor_kg_m2: a.tensor_kg_m2 - b.tensor_kg_m2,
                };
                [size(&difference), size(a).max(size(b))]
            })
            .collect();
        let rounding = SAME_FIGURE * SAME_FIGURE.sqrt();
        Self {
            candidate,
            ways: Ways {
                frames: &candidate.frames,
                differs: entries.iter().map(|[difference, size]| *difference > rounding * size).collect(),
            },
            trees: [candidate.tree(), reference.tree()].map(BodyTree::without_resistances),
            largest_entries: entries.into_iter().map(|[difference, _]| difference).collect(),
        }
    }

    /// `None` if the joint has no difference.
    fn bracket(&self, joint: usize, seed: u64) -> Result<Option<TorqueBracket>, DynamicsError> {
        let frames = &self.candidate.frames;
        let carried: Vec<usize> = (0..frames.dof())
            .filter(|&body| self.ways.differs[body] && self.ways.carries(joint, body))
            .collect();
        if carried.is_empty() {
            return Ok(None);
        }
        let entries: f64 = carried.iter().map(|&body| self.largest_entries[body]).sum();
        let columns = f64::from(u32::try_from(frames.dof()).unwrap_or(u32::MAX));
        let crude = entries * columns * LARGEST_ACCELERATION;
        // No entry depends on how the whole robot is turned.
        let mut joints = self.ways.through(joint);
        joints.retain(|&joint| frames.joints[joint].parent.is_some());
        let zeros = RobotQ::zeros(frames.dof());
        if joints.len() > MAX_SQUARED_VARIABLES {
            let attained = self.row(&zeros, joint, &mut self.memory())?.iter().map(|value| value.abs()).sum();
            return Ok(Some(self.report(joint, [attained, crude], (zeros, 0))));
        }
        let row = self.function(joint, &joints)?;
        if row.coefficients.iter().all(|value| *value == 0.0) {
            return Ok(None);
        }
        let (attained, positions) = climb::largest_sampled(&row, seed);
        let mut q = zeros;
        for (q, place) in q.iter_mut().zip(&frames.joints) {
            *q = q.clamp(place.range.0, place.range.1);
        }
        for (variable, position) in row.variables.iter().zip(positions) {
            q[variable.joint] = position;
        }
        let stop = Stop {
            below: attained * (1.0 + CLOSED_SUM),
            boxes: MAX_BOXES,
            control_values: MAX_CONTROL_VALUES,
        };
        let bound = upper_bound(&row, stop);
        let certified = bound.value.min(crude).max(attained);
        Ok(Some(self.report(joint, [attained, certified], (q, bound.boxes))))
    }

    fn report(&self, joint: usize, [attained, certified]: [f64; 2], at: (RobotQ, usize)) -> TorqueBracket {
        TorqueBracket::new(self.candidate, joint, [attained, certified], at)
    }

    /// The entries of one row times the largest acceleration.
    fn row(&self, q: &RobotQ, joint: usize, memory: &mut Memory) -> Result<Vec<f64>, DynamicsError> {
        for ((tree, buffer), matrix) in self.trees.iter().zip(&mut memory.buffers).zip(&mut memory.matrices) {
            tree.mass_matrix_into(q, buffer, matrix)?;
        }
        let [found, expected] = &memory.matrices;
        let entry = |column: usize| found[(joint, column)] - expected[(joint, column)];
        Ok((0..found.ncols()).map(|column| entry(column) * LARGEST_ACCELERATION).collect())
    }

    fn memory(&self) -> Memory {
        let n = self.candidate.frames.dof();
        Memory {
            buffers: [self.trees[0].buffer(), self.trees[1].buffer()],
            matrices: [DMatrix::zeros(n, n), DMatrix::zeros(n, n)],
        }
    }

    fn function(&self, joint: usize, joints: &[usize]) -> Result<Trigonometric, DynamicsError> {
        let mut variables = self.ways.variables(joints);
        for variable in &mut variables {
            variable.degree = 2;
        }
        let n = self.candidate.frames.dof();
        let mut memory = self.memory();
        let mut error = Ok(());
        let mut q = RobotQ::zeros(n);
        let function = Trigonometric::sampled(variables, (n, Measure::Sum), |positions| {
            joints.iter().zip(positions).for_each(|(&joint, &position)| q[joint] = position);
            self.row(&q, joint, &mut memory).unwrap_or_else(|found| {
                error = Err(found);
                vec![0.0; n]
            })
        });
        error.map(|()| function)
    }
}

/// A bracket of a sum is closed within this share. No unit; kind: choice, ten times that of gravity alone.
const CLOSED_SUM: f64 = 10.0 * CLOSED;
