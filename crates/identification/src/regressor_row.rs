//! The columns of one instant: what each unknown adds to the effort of each driven joint.

use congruent_dynamics::{BodyTree, DynamicsBuffer, DynamicsError, JointMotionState, PARAMETERS};
use nalgebra::{DMatrix, DVector};

use crate::{
    equations::{JointEquations, RecordedEquations},
    smoothing::SmoothedInstant,
    unknowns::JointUnknown,
};

/// Makes the rows of instants, in memory that is allocated once.
#[derive(Debug)]
pub(crate) struct ColumnMaker<'a> {
    pub(crate) tree: &'a BodyTree,
    buffer: DynamicsBuffer,
    regressor: DMatrix<f64>,
    /// Regressor with the rows of followers added to those of their drivers.
    folded: DMatrix<f64>,
    gravity: Vec<f64>,
    folded_gravity: Vec<f64>,
    row: Vec<DVector<f64>>,
}

impl<'a> ColumnMaker<'a> {
    /// With the equations that its rows are added to, of all driven joints.
    pub(crate) fn new(tree: &'a BodyTree) -> (Self, RecordedEquations) {
        let n = tree.dof();
        let moved_by = |driver: usize| -> Vec<usize> {
            let is_moved = |body: &usize| {
                (0..n).any(|joint| tree.driver(joint).0 == driver && tree.carries(joint, *body))
            };
            (0..n).filter(is_moved).collect()
        };
        let driven = tree.driven_joints().iter().enumerate();
        let joints: Vec<JointEquations> =
            driven.map(|(driver, &joint)| JointEquations::new(joint, moved_by(driver))).collect();
        let maker = Self {
            tree,
            buffer: tree.buffer(),
            regressor: DMatrix::zeros(n, PARAMETERS * n),
            folded: DMatrix::zeros(joints.len(), PARAMETERS * n),
            gravity: vec![0.0; n],
            folded_gravity: vec![0.0; joints.len()],
            row: joints.iter().map(|joint| DVector::zeros(joint.columns())).collect(),
        };
        (maker, RecordedEquations::new(tree, joints))
    }

    /// The rows of an instant, one for each driven joint.
    pub(crate) fn rows(
        &mut self,
        instant: &SmoothedInstant,
        joints: &[JointEquations],
    ) -> Result<&[DVector<f64>], DynamicsError> {
        let SmoothedInstant { q, qd, qdd, .. } = instant;
        self.tree.regressor_into(&JointMotionState { q, qd, qdd }, &mut self.buffer, &mut self.regressor)?;
        self.tree.gravity_into(q, &mut self.buffer, &mut self.gravity)?;
        self.fold();
        for (at, (row, of)) in self.row.iter_mut().zip(joints).enumerate() {
            for (part, &body) in of.bodies.iter().enumerate() {
                for parameter in 0..PARAMETERS {
                    row[PARAMETERS * part + parameter] = self.folded[(at, PARAMETERS * body + parameter)];
                }
            }
            let qd = qd[of.joint];
            row[of.term_column(JointUnknown::Viscous)] = qd;
            row[of.term_column(JointUnknown::Coulomb)] = if qd == 0.0 { 0.0 } else { qd.signum() };
            row[of.term_column(JointUnknown::Armature)] = qdd[of.joint];
            row[of.term_column(JointUnknown::Offset)] = 1.0;
            // The torque at this time is recorded later: now it is the one of before.
            row[of.delay_column()] = -instant.effort_rate[of.joint];
            row[of.gravity_column()] = self.folded_gravity[at];
            row[of.effort_column()] = instant.effort[of.joint];
        }
        Ok(&self.row)
    }

    /// Adds what acts on followers to their drivers.
    fn fold(&mut self) {
        self.folded.fill(0.0);
        self.folded_gravity.fill(0.0);
        for joint in 0..self.tree.dof() {
            let (row, ratio) = self.tree.driver(joint);
            let mut sum = self.folded.row_mut(row);
            for (sum, of_joint) in sum.iter_mut().zip(self.regressor.row(joint).iter()) {
                *sum += ratio * of_joint;
            }
            self.folded_gravity[row] += ratio * self.gravity[joint];
        }
    }
}
