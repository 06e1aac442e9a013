//! All hypotheses that leave nothing of the difference: single ones, and if there is none, pairs.

use congruent_description::Elementary as _;
use nalgebra::{DMatrix, DVector};

use super::{
    cause,
    cause::slip::Slip,
    fit::{Fit, Target},
    hypothesis::{FaultySide, Hypothesis, Place},
};
use crate::{
    side::{JointTerm, Side},
    torque::{
        compressed::Compressed,
        least_squares::{basis, outside},
    },
};

/// A part of the robot that may be wrong by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// The links of a body.
    Body(usize),
    /// Damping, friction and armature of a joint.
    Joint(usize),
    Gravity,
}

/// Everything there is to try, made once.
pub(super) struct Catalogue<'a> {
    side: &'a Side,
    /// Of each body.
    of_bodies: Vec<Vec<Hypothesis>>,
    of_joints: Vec<Vec<Hypothesis>>,
    of_gravity: Vec<Hypothesis>,
    /// Over several bodies or all joints.
    overall: Vec<Hypothesis>,
}

impl<'a> Catalogue<'a> {
    pub(super) fn new(side: &'a Side, reference: Option<&Side>, faulty: FaultySide) -> Self {
        let slips: Vec<Slip<'_>> = cause::slips(&side.frames, faulty);
        let n = side.frames.dof();
        let of_body = |body| {
            side.frames
                .links_of(body)
                .flat_map(|link| cause::of_link(side, reference, faulty, &slips, link))
                .collect()
        };
        let mut catalogue = Self {
            side,
            of_bodies: (0..n).map(of_body).collect(),
            of_joints: vec![Vec::new(); n],
            of_gravity: Vec::new(),
            overall: cause::of_all_links(side, &slips),
        };
        catalogue.overall.extend(cause::of_two_links(side, faulty));
        let reference = reference.filter(|_| faulty == FaultySide::Candidate);
        catalogue.overall.extend(reference.and_then(|reference| cause::all_left_out(side, reference)));
        for hypothesis in cause::of_joints_and_gravity(side, faulty) {
            match &hypothesis.place {
                Place::Joints(joints) if joints.len() == 1 => {
                    catalogue.of_joints[joints[0]].push(hypothesis);
                }
                Place::Gravity => catalogue.of_gravity.push(hypothesis),
                _ => catalogue.overall.push(hypothesis),
            }
        }
        catalogue
    }

    fn of(&self, part: Part) -> &[Hypothesis] {
        match part {
            Part::Body(body) => &self.of_bodies[body],
            Part::Joint(joint) => &self.of_joints[joint],
            Part::Gravity => &self.of_gravity,
        }
    }

    fn parts(&self) -> Vec<Part> {
        let n = self.side.frames.dof();
        let bodies = (0..n).map(Part::Body);
        bodies.chain((0..n).map(Part::Joint)).chain([Part::Gravity]).collect()
    }

    /// The hypotheses of one part that leave nothing.
    fn fits_of(&self, target: &Target<'_>, part: Part) -> Vec<Fit> {
        if !target.contains(part) {
            return Vec::new();
        }
        self.of(part).iter().filter_map(|hypothesis| target.fit(hypothesis)).collect()
    }

    /// All single hypotheses that leave nothing.
    pub(super) fn singles(&self, target: &Target<'_>) -> Vec<Fit> {
        let mut fits: Vec<Fit> =
            self.parts().into_iter().flat_map(|part| self.fits_of(target, part)).collect();
        fits.extend(self.overall.iter().filter_map(|hypothesis| target.fit(hypothesis)));
        fits
    }

    /// Pairs on different parts that leave nothing together.
    ///
    /// What one part can do is taken out of everything; then the other part's hypothesis must explain what remains.
    pub(super) fn pairs(&self, target: &Target<'_>) -> Vec<[Fit; 2]> {
        let parts = self.parts();
        let mut pairs = Vec::new();
        for &second in &parts {
            let span = basis(&second.columns(target.torque), target.torque.scale);
            let reduced = target.torque.without(&span);
            let reduced = Target { torque: &reduced, ..*target };
            for &first in parts.iter().filter(|part| **part != second) {
                for fit in self.fits_of(&reduced, first) {
                    pairs.extend(self.completed(target, &fit, second));
                }
            }
        }
        pairs.extend((0..self.side.frames.dof()).flat_map(|joint| self.pairs_at_joint(target, joint)));
        pairs
    }

    /// Two terms of one joint that leave nothing together, such as damping and friction that were left out.
    fn pairs_at_joint(&self, target: &Target<'_>, joint: usize) -> Vec<[Fit; 2]> {
        let part = Part::Joint(joint);
        if !target.contains(part) {
            return Vec::new();
        }
        let mut pairs = Vec::new();
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

    /// A hypothesis with each of another part that explains the rest.
    fn completed(&self, target: &Target<'_>, fit: &Fit, second: Part) -> Vec<[Fit; 2]> {
        let Some(effect) = target.effect(&fit.corrected) else { return Vec::new() };
        let rest = target.torque.with_difference(&target.torque.difference - &effect);
        let rest = Target { torque: &rest, ..*target };
        let completed = self.fits_of(&rest, second).into_iter();
        completed.map(|second| [fit.clone(), second]).collect()
    }
}

impl Part {
    /// What the part can do to the torques.
    fn columns(self, torque: &Compressed) -> DMatrix<f64> {
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
    /// Whether a part can explain the whole difference, with whatever numbers.
    pub(super) fn contains(&self, part: Part) -> bool {
        let span = basis(&part.columns(self.torque), self.torque.scale);
        outside(&span, &self.torque.difference).norm().hypotenuse_with(self.torque.outside) <= self.exact
    }
}
