//! What a reference states: a file without a mass or a damping is no reference for it.

use congruent_dynamics::{JointResistance, SpatialInertia};

use super::named_diagnosis::NamedModel;
use crate::{model::DynamicsModel, report::places::ParameterPlaces};

/// A reference with the candidate's values wherever it states none, so that they cannot differ.
pub(super) struct StatedReference {
    pub(super) model: DynamicsModel,
    /// What was taken from the candidate, in words.
    pub(super) not_stated: Vec<String>,
    /// Whether the reference states the mass of any moving link.
    pub(super) has_mass: bool,
}

impl StatedReference {
    /// `joints` has for each joint of the candidate the index of the reference's joint.
    pub(super) fn new(candidate: &DynamicsModel, reference: &NamedModel<'_>, joints: &[usize]) -> Self {
        let mut model = reference.model.clone();
        let [own, there] = [candidate, reference.model].map(DynamicsModel::bodies);
        let is_stated = |of: &SpatialInertia| *of != SpatialInertia::zero();
        // By bodies: a link without a mass that is fixed to one with a mass is a frame, which is a statement.
        let mut lacking: Vec<&str> = Vec::new();
        for (body, &other) in joints.iter().enumerate() {
            if is_stated(&own[body]) && !is_stated(&there[other]) {
                model.replace_body(other, candidate, body);
                lacking.push(candidate.frames.link_name(candidate.frames.joints[body].link));
            }
        }
        let has_mass = there.iter().any(is_stated);
        let mut not_stated = Vec::new();
        if !lacking.is_empty() {
            let links = if has_mass { lacking.join(", ") } else { "all links".to_owned() };
            not_stated.push(format!("masses of {links}"));
        }
        let is_zero = |of: &DynamicsModel| of.resistances.iter().all(|of| *of == JointResistance::default());
        // A URDF with masses and without `<dynamics>` says by its default that there is no damping; one that is of the
        // geometry alone says nothing.
        let states_terms = has_mass || reference.places.is_none_or(ParameterPlaces::states_joint_terms);
        if !states_terms && is_zero(reference.model) && !is_zero(candidate) {
            for (joint, &other) in joints.iter().enumerate() {
                model.resistances[other] = candidate.resistances[joint];
            }
            not_stated.push("damping and dry friction of all joints".to_owned());
        }
        Self { model, not_stated, has_mass }
    }
}
