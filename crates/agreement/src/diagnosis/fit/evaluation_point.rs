//! The difference of two chains at one generic configuration: space screws and tip. Two chains with their
//! joints in one order that are equal there are equal at every configuration.

use congruent_description::ChainQ;
use congruent_kinematics::{Pose, Twist};
use nalgebra::Vector3;

use crate::diagnosis::{
    candidate::{CandidateEffect, CandidateModel, ChainWalk},
    digits::Weights,
    reference_model::{ChainState, ReferenceModel},
};

/// The configuration at which chains are compared, and the length that makes metres comparable to radians.
#[derive(Debug, Clone)]
pub(in crate::diagnosis) struct EvaluationPoint {
    pub(in crate::diagnosis) q: ChainQ,
    pub(in crate::diagnosis) length_m: f64,
    /// What the digits of the files explain counts little; `None` if every difference counts.
    weights: Option<Weights>,
}

impl EvaluationPoint {
    /// A generic configuration of `reference`: at zero, a table with its rows in another order could have the
    /// same screws and still be another robot.
    pub(in crate::diagnosis) fn for_reference(reference: &ReferenceModel) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "arms have few joints")]
        // Unequal positions, and no special angles: at zero, quarter turns or equal positions different tables can
        // have the same screws by chance.
        let q: ChainQ = (0..reference.joint_count()).map(|joint| 0.3 + 0.1 * (joint as f64).sqrt()).collect();
        let state = reference.state(&q);
        // The linear part of the screw of a turn is the moment of its axis about the base: its length is the distance
        // of the axis.
        let reach = state.twists.iter().map(|twist| twist.linear.norm());
        let length_m = reach.fold(state.base_from_tip.translation.norm(), f64::max);
        Self { q, length_m: if length_m > 0.0 { length_m } else { 1.0 }, weights: None }
    }

    /// The same configuration, with differences weighted.
    pub(in crate::diagnosis) fn weighted(self, weights: Option<Weights>) -> Self {
        Self { weights, ..self }
    }

    /// Whether what the digits of the files explain counts little.
    pub(in crate::diagnosis) fn is_weighted(&self) -> bool {
        self.weights.is_some()
    }

    /// The candidate minus the target, without unit, weighted.
    pub(in crate::diagnosis) fn difference(
        &self,
        candidate: &CandidateModel,
        walk: &ChainWalk,
        target: &ChainState,
    ) -> Vec<f64> {
        self.apply_weights(self.unweighted(candidate, walk, target))
    }

    fn apply_weights(&self, numbers: Vec<f64>) -> Vec<f64> {
        match &self.weights {
            Some(weights) => weights.apply(numbers),
            None => numbers,
        }
    }

    /// The candidate minus the target, without unit: six values for each joint, then the tip.
    pub(in crate::diagnosis) fn unweighted(
        &self,
        candidate: &CandidateModel,
        walk: &ChainWalk,
        target: &ChainState,
    ) -> Vec<f64> {
        let mut numbers = Vec::with_capacity(6 * target.twists.len() + 12);
        // Ordered by joint, not by row: a table with its rows in another order differs here, as it should.
        let mut twists = vec![Twist::zero(); target.twists.len()];
        for (row, twist) in candidate.rows.iter().zip(&walk.row_twists) {
            twists[row.joint] = *twist;
        }
        for (found, expected) in twists.iter().zip(&target.twists) {
            numbers.extend_from_slice((found.angular - expected.angular).as_slice());
            numbers.extend_from_slice(((found.linear - expected.linear) / self.length_m).as_slice());
        }
        let (found, expected) = (&walk.base_from_tip, &target.base_from_tip);
        // All nine entries rather than three angles: no singular orientation, and linear in the rotation.
        numbers.extend_from_slice((found.rotation - expected.rotation).as_slice());
        numbers.extend_from_slice(((found.translation - expected.translation) / self.length_m).as_slice());
        numbers
    }

    /// Derivative of [`EvaluationPoint::difference`] with respect to a parameter.
    ///
    /// The chain behind the parameter moves rigidly: a screw by the bracket with the generator, the tip by
    /// the generator itself (Lynch & Park, *Modern Robotics* (2017), section 8.3.1).
    pub(in crate::diagnosis) fn derivative(
        &self,
        candidate: &CandidateModel,
        walk: &ChainWalk,
        effect: &CandidateEffect,
    ) -> Vec<f64> {
        let CandidateEffect { generator, from_row, scales_row } = effect;
        let mut numbers = vec![0.0; 6 * self.q.len()];
        let mut put = |joint: usize, twist: Twist| {
            let place = &mut numbers[6 * joint..6 * joint + 6];
            place[..3].copy_from_slice(twist.angular.as_slice());
            place[3..].copy_from_slice((twist.linear / self.length_m).as_slice());
        };
        for (row, twist) in candidate.rows.iter().zip(&walk.row_twists).skip(*from_row) {
            put(row.joint, generator.bracket(twist));
        }
        // The row's own screw is proportional to its rate.
        if let Some(row) = *scales_row {
            put(candidate.rows[row].joint, walk.row_twists[row] * (1.0 / candidate.rows[row].rate));
        }
        let Pose { rotation, translation } = &walk.base_from_tip;
        for axis in 0..3 {
            let column: Vector3<f64> = rotation.column(axis).into_owned();
            numbers.extend_from_slice(generator.angular.cross(&column).as_slice());
        }
        let shift = generator.angular.cross(translation) + generator.linear;
        numbers.extend_from_slice((shift / self.length_m).as_slice());
        self.apply_weights(numbers)
    }
}
