//! Why torque cannot tell one explanation from another.

use super::{hypothesis::Place, rank::Exact};
use crate::{
    side::Side,
    thresholds::SEEN,
    torque::{compressed::Compressed, least_squares::basis},
};

/// Why two explanations leave the same torques.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EquivalenceReason {
    /// Fixed joints hold the links together: torque shows only their sum.
    OneBody,
    /// Torque shows few numbers of the body.
    FewNumbersSeen,
    /// Mass on a joint's axis may belong to either side of the joint.
    AcrossJoint,
    /// The numbers that differ have the same effect.
    SameEffect,
}

impl EquivalenceReason {
    /// As the end of a sentence about two explanations.
    pub fn text(self) -> &'static str {
        match self {
            Self::OneBody => "fixed joints hold the links together, and torque shows only their sum",
            Self::FewNumbersSeen => "joint torques show few numbers of this body",
            Self::AcrossJoint => "what lies on a joint's axis may belong to either side of the joint",
            Self::SameEffect => "both have the same effect on all joint torques",
        }
    }

    pub(super) fn between(side: &Side, torque: &Compressed, a: &Exact, b: &Exact) -> Self {
        let bodies = |exact: &Exact| {
            let links = exact.parts.iter().flat_map(|part| match &part.hypothesis.place {
                Place::Links(links) => links.clone(),
                _ => Vec::new(),
            });
            let mut bodies: Vec<usize> = links.filter_map(|link| side.frames.links[link].body).collect();
            bodies.sort_unstable();
            bodies.dedup();
            bodies
        };
        let links = |exact: &Exact| -> Vec<usize> {
            let mut links: Vec<usize> = exact.corrected.links.iter().map(|(link, _)| *link).collect();
            links.sort_unstable();
            links
        };
        let (first, second) = (bodies(a), bodies(b));
        let is_adjacent = |&a: &usize, &b: &usize| {
            side.frames.joints[a].parent == Some(b) || side.frames.joints[b].parent == Some(a)
        };
        let shows_all = |&body: &usize| {
            let columns = torque.body(body);
            basis(columns, SEEN * torque.scale).ncols() == columns.ncols()
        };
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
