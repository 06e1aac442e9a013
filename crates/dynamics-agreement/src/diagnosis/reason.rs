//! Why joint torques cannot distinguish one explanation from another.

use super::{hypothesis::DynamicsPlace, rank::ExactExplanation};
use crate::{
    model::DynamicsModel,
    thresholds::IDENTIFIABLE,
    torque::{least_squares::basis, reduced_difference::ReducedTorqueDifference},
};

/// Why two explanations give the same torques.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EquivalenceReason {
    /// Fixed joints connect the links: only the sum of their inertias is identifiable.
    OneBody,
    /// Few parameters of the body are identifiable from joint torques.
    FewNumbersSeen,
    /// Mass on a joint's axis can belong to the link before or after the joint.
    AcrossJoint,
    /// Both changes have the same effect on all joint torques.
    SameEffect,
}

impl EquivalenceReason {
    /// As the end of a sentence about two explanations.
    pub fn text(self) -> &'static str {
        match self {
            Self::OneBody => "fixed joints connect the links: only the sum of their inertias is identifiable",
            Self::FewNumbersSeen => "joint torques determine only few parameters of this body",
            Self::AcrossJoint => "mass on a joint's axis can belong to the link before or after the joint",
            Self::SameEffect => "both have the same effect on all joint torques",
        }
    }

    pub(super) fn between(
        model: &DynamicsModel,
        torque: &ReducedTorqueDifference,
        a: &ExactExplanation,
        b: &ExactExplanation,
    ) -> Self {
        let bodies = |exact: &ExactExplanation| {
            let links = exact.parts.iter().flat_map(|part| match &part.hypothesis.place {
                DynamicsPlace::Links(links) => links.clone(),
                _ => Vec::new(),
            });
            let mut bodies: Vec<usize> = links.filter_map(|link| model.frames.links[link].body).collect();
            bodies.sort_unstable();
            bodies.dedup();
            bodies
        };
        let links = |exact: &ExactExplanation| -> Vec<usize> {
            let mut links: Vec<usize> = exact.corrected.links.iter().map(|(link, _)| *link).collect();
            links.sort_unstable();
            links
        };
        let (first, second) = (bodies(a), bodies(b));
        let is_adjacent = |&a: &usize, &b: &usize| {
            model.frames.joints[a].parent == Some(b) || model.frames.joints[b].parent == Some(a)
        };
        let shows_all = |&body: &usize| {
            let columns = torque.body(body);
            basis(columns, IDENTIFIABLE * torque.scale).ncols() == columns.ncols()
        };
        // From the most specific reason to the most general one; the last is true of all.
        if first == second && !first.is_empty() && links(a) != links(b) {
            Self::OneBody
        } else if first.iter().chain(&second).any(|body| !shows_all(body)) {
            Self::FewNumbersSeen
        } else if first != second && first.iter().any(|a| second.iter().any(|b| is_adjacent(a, b))) {
            Self::AcrossJoint
        } else {
            Self::SameEffect
        }
    }
}
