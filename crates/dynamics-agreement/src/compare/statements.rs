//! What a reference states: a file without a mass or a damping is no reference for it.

use congruent_dynamics::{JointResistance, SpatialInertia};

use super::named_diagnosis::NamedModel;
use crate::{
    model::{DynamicsModel, Inertial},
    torque::reduced_difference::ReducedTorqueDifference,
};

/// A reference with the candidate's values wherever it states none, so that they cannot differ.
pub(super) struct StatedReference {
    pub(super) model: DynamicsModel,
    /// What was taken from the candidate, in words.
    pub(super) not_stated: Vec<String>,
    /// Whether the reference states the mass of any moving link.
    pub(super) has_mass: bool,
    /// Bodies of the candidate whose masses the reference does not state.
    pub(super) unstated: Vec<usize>,
}

impl StatedReference {
    /// `joints` has for each joint of the candidate the index of the reference's joint.
    pub(super) fn new(candidate: &NamedModel<'_>, reference: &NamedModel<'_>, joints: &[usize]) -> Self {
        let mut stated = Self {
            model: reference.model.clone(),
            not_stated: Vec::new(),
            has_mass: reference.model.bodies().iter().any(is_stated),
            unstated: Vec::new(),
        };
        if reference.model.is_complete {
            // Masses that are 0 there are a difference from those that the candidate has.
            stated.has_mass |= candidate.model.bodies().iter().any(is_stated);
            return stated;
        }
        stated.take_masses(candidate.model, reference.model, joints);
        stated.take_joint_terms(candidate, reference, joints);
        stated
    }

    /// By bodies: a link without a mass that is fixed to one with a mass is a frame, which is a statement.
    fn take_masses(&mut self, candidate: &DynamicsModel, reference: &DynamicsModel, joints: &[usize]) {
        let [own, there] = [candidate, reference].map(DynamicsModel::bodies);
        let mut lacking: Vec<String> = Vec::new();
        for (body, &other) in joints.iter().enumerate() {
            if is_stated(&own[body]) && !is_stated(&there[other]) {
                self.model.replace_body(other, candidate, body);
                self.unstated.push(body);
                let mut links = reference.frames.links_of(other);
                let is_zero = links.any(|link| reference.inertials[link].is_some());
                let zero = if is_zero { " (0 there, which is no mass)" } else { "" };
                let name = candidate.frames.link_name(candidate.frames.joints[body].link);
                lacking.push(format!("{name}{zero}"));
            }
        }
        if !lacking.is_empty() {
            let links = if self.has_mass { lacking.join(", ") } else { "all links".to_owned() };
            self.not_stated.push(format!("masses of {links}"));
        }
    }

    /// A joint without any entry for damping and dry friction says nothing about them, unless the candidate omits those of
    /// most joints itself: then no entry means none in both files.
    fn take_joint_terms(&mut self, candidate: &NamedModel<'_>, reference: &NamedModel<'_>, joints: &[usize]) {
        let Some(places) = reference.places else { return };
        let has_terms =
            |model: &DynamicsModel, joint: usize| model.resistances[joint] != JointResistance::default();
        let own = candidate.model;
        let is_written = |joint: &usize| match candidate.places {
            Some(places) => places.writes_joint_terms(own.frames.joint_name(*joint)),
            None => has_terms(own, *joint),
        };
        if 2 * (0..joints.len()).filter(is_written).count() <= joints.len() {
            return;
        }
        let is_silent = |other: usize| {
            let name = reference.model.frames.joint_name(other);
            !has_terms(reference.model, other) && !places.states_joint_terms(name)
        };
        let mut lacking: Vec<&str> = Vec::new();
        for (joint, &other) in joints.iter().enumerate() {
            if has_terms(own, joint) && is_silent(other) {
                self.model.resistances[other] = own.resistances[joint];
                lacking.push(own.frames.joint_name(joint));
            }
        }
        if !lacking.is_empty() {
            let is_all = joints.iter().all(|&other| is_silent(other));
            let names = if is_all { "all joints".to_owned() } else { lacking.join(", ") };
            self.not_stated.push(format!("damping and dry friction of {names}"));
        }
    }
}

fn is_stated(body: &SpatialInertia) -> bool {
    *body != SpatialInertia::zero()
}

/// The reference in the candidate's geometry with the masses of these bodies, which it does not state, as they leave the
/// smallest difference of torques.
pub(super) fn with_fitted_bodies(
    reference_in_candidate: &DynamicsModel,
    bodies: &[usize],
    torque: &ReducedTorqueDifference,
) -> DynamicsModel {
    let mut fitted = reference_in_candidate.clone();
    let before = fitted.bodies();
    for (&body, change) in bodies.iter().zip(torque.closing(bodies)) {
        let link = fitted.frames.joints[body].link;
        let link_from_body = fitted.frames.links[link].body_from_link.inverse();
        let in_body = before[body] + SpatialInertia::from_parameters(change);
        let axes = fitted.inertials[link].map_or_else(nalgebra::Matrix3::identity, |of| of.link_from_axes);
        fitted.inertials[link] = Some(Inertial::from_origin(&in_body.transformed_by(&link_from_body), axes));
    }
    fitted
}
