//! Searches the hypotheses whose residual is within tolerance: single ones, and pairs.

use nalgebra::{DMatrix, DVector};

use super::{
    cause::{self, common_mistake::CommonMistake},
    fit::{FittedHypothesis, Target},
    hypothesis::{DynamicsHypothesis, DynamicsPlace, FaultySide},
};
use crate::{
    model::{DynamicsModel, JointTerm},
    torque::{
        least_squares::{basis, outside},
        reduced_difference::ReducedTorqueDifference,
    },
};

/// A part of the robot that may be wrong independently of the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RobotPart {
    /// The links of a body.
    Body(usize),
    /// Damping, friction and armature of a joint.
    Joint(usize),
    Gravity,
}

/// All hypotheses of a robot, built once.
pub(super) struct Catalogue<'a> {
    model: &'a DynamicsModel,
    /// Hypotheses about the links of each body.
    of_bodies: Vec<Vec<DynamicsHypothesis>>,
    of_joints: Vec<Vec<DynamicsHypothesis>>,
    of_gravity: Vec<DynamicsHypothesis>,
    /// Hypotheses about several bodies or all joints.
    overall: Vec<DynamicsHypothesis>,
}

impl<'a> Catalogue<'a> {
    pub(super) fn new(
        model: &'a DynamicsModel,
        reference: Option<&DynamicsModel>,
        faulty: FaultySide,
    ) -> Self {
        let mistakes: Vec<CommonMistake<'_>> = cause::mistakes(&model.frames, faulty);
        let n = model.frames.dof();
        let of_body = |body| {
            model
                .frames
                .links_of(body)
                .flat_map(|link| cause::link_hypotheses(model, reference, faulty, &mistakes, link))
                .collect()
        };
        let mut catalogue = Self {
            model,
            of_bodies: (0..n).map(of_body).collect(),
            of_joints: vec![Vec::new(); n],
            of_gravity: Vec::new(),
            overall: cause::all_links_hypotheses(model, &mistakes),
        };
        catalogue.overall.extend(cause::two_link_hypotheses(model, faulty));
        // Only the candidate's file can lack terms that the other description has.
        let reference = reference.filter(|_| faulty == FaultySide::Candidate);
        catalogue.overall.extend(reference.and_then(|reference| cause::all_left_out(model, reference)));
        for hypothesis in cause::joint_and_gravity_hypotheses(model, faulty) {
            match &hypothesis.place {
                // A single joint is a part of its own and can be paired; everything else is about several.
                DynamicsPlace::Joints(joints) if joints.len() == 1 => {
                    catalogue.of_joints[joints[0]].push(hypothesis);
                }
                DynamicsPlace::Gravity => catalogue.of_gravity.push(hypothesis),
                _ => catalogue.overall.push(hypothesis),
            }
        }
        catalogue
    }

    fn hypotheses_about(&self, part: RobotPart) -> &[DynamicsHypothesis] {
        match part {
            RobotPart::Body(body) => &self.of_bodies[body],
            RobotPart::Joint(joint) => &self.of_joints[joint],
            RobotPart::Gravity => &self.of_gravity,
        }
    }

    fn parts(&self) -> Vec<RobotPart> {
        let n = self.model.frames.dof();
        let bodies = (0..n).map(RobotPart::Body);
        bodies.chain((0..n).map(RobotPart::Joint)).chain([RobotPart::Gravity]).collect()
    }

    /// The hypotheses of one part whose residual is within tolerance.
    fn fits_of(&self, target: &Target<'_>, part: RobotPart) -> Vec<FittedHypothesis> {
        // A projection onto the span costs less than its hundred hypotheses, and excludes most parts at once.
        if !target.contains(part) {
            return Vec::new();
        }
        self.hypotheses_about(part).iter().filter_map(|hypothesis| target.fit(hypothesis)).collect()
    }

    /// All single hypotheses whose residual is within tolerance.
    pub(super) fn singles(&self, target: &Target<'_>) -> Vec<FittedHypothesis> {
        let mut fits: Vec<FittedHypothesis> =
            self.parts().into_iter().flat_map(|part| self.fits_of(target, part)).collect();
        fits.extend(self.overall.iter().filter_map(|hypothesis| target.fit(hypothesis)));
        fits
    }

    /// Pairs of hypotheses about different parts that together have a residual within tolerance.
    ///
    /// All torques are projected onto the complement of what the second part can change; a hypothesis about the first part must
    /// explain the projected difference.
    pub(super) fn pairs(&self, target: &Target<'_>) -> Vec<[FittedHypothesis; 2]> {
        let parts = self.parts();
        let mut pairs = Vec::new();
        for &second in &parts {
            // Projecting out the span of the second part removes whatever it could explain, with any values: the
            // first part is then fitted as if it were alone.
            let span = basis(&second.columns(target.torque), target.torque.scale);
            let reduced = target.torque.without(&span);
            let reduced = Target { torque: &reduced, ..*target };
            for &first in parts.iter().filter(|part| **part != second) {
                // A candidate for the first fault: it explains what the second part cannot. Its parameters need
                // no second fit.
                for fit in self.fits_of(&reduced, first) {
                    pairs.extend(self.completed(target, &fit, second));
                }
            }
        }
        // Parts differ in the loop above: two terms of one joint are one part.
        pairs.extend((0..self.model.frames.dof()).flat_map(|joint| self.pairs_at_joint(target, joint)));
        pairs
    }

    /// Two terms of one joint that together have a residual within tolerance, such as missing damping and friction.
    fn pairs_at_joint(&self, target: &Target<'_>, joint: usize) -> Vec<[FittedHypothesis; 2]> {
        let part = RobotPart::Joint(joint);
        if !target.contains(part) {
            return Vec::new();
        }
        let mut pairs = Vec::new();
        // One term of the pair is projected out and the other two are tried; with friction and armature all three
        // pairs are covered.
        for second in [JointTerm::Friction, JointTerm::Armature] {
            let column = DMatrix::from_columns(&[target.torque.term(second).column(joint)]);
            let reduced = target.torque.without(&basis(&column, target.torque.scale));
            let reduced = Target { torque: &reduced, ..*target };
            for fit in self.fits_of(&reduced, part) {
                pairs.extend(self.completed(target, &fit, part));
            }
        }
        pairs
    }

    /// A hypothesis combined with each hypothesis of another part that explains the residual.
    fn completed(
        &self,
        target: &Target<'_>,
        fit: &FittedHypothesis,
        second: RobotPart,
    ) -> Vec<[FittedHypothesis; 2]> {
        let Some(effect) = target.effect(&fit.corrected) else { return Vec::new() };
        // From the full difference, not from the projected one: the second cause must explain it with its own
        // values.
        let rest = target.torque.with_difference(&target.torque.difference - &effect);
        let rest = Target { torque: &rest, ..*target };
        let completed = self.fits_of(&rest, second).into_iter();
        completed.map(|second| [fit.clone(), second]).collect()
    }
}

impl RobotPart {
    /// The columns of all parameters of the part: their span is every torque that it can change.
    fn columns(self, torque: &ReducedTorqueDifference) -> DMatrix<f64> {
        match self {
            Self::Body(body) => torque.body(body).clone(),
            Self::Joint(joint) => {
                let columns: Vec<DVector<f64>> =
                    JointTerm::ALL.iter().map(|term| torque.term(*term).column(joint).into_owned()).collect();
                DMatrix::from_columns(&columns)
            }
            Self::Gravity => torque.gravity().clone(),
        }
    }
}

impl Target<'_> {
    /// Whether a part can explain the whole difference with any parameters.
    pub(super) fn contains(&self, part: RobotPart) -> bool {
        let span = basis(&part.columns(self.torque), self.torque.scale);
        libm::hypot(outside(&span, &self.torque.difference).norm(), self.torque.outside) <= self.exact
    }
}
