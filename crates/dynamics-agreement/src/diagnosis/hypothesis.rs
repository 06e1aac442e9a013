//! A hypothesis about a fault: what of the candidate's parameters would have to be other, for the torques of the
//! reference. The catalogue of hypotheses is `cause/`.

use congruent_dynamics::JointResistance;
use nalgebra::Vector3;

use super::{cause_names::DynamicsCause, free::Free};
use crate::side::{Inertial, JointTerm};

/// Which of the two sides is taken to be wrong.
///
/// Only the candidate's parameters are known, so either way they are what is changed: if the candidate is taken to be wrong, a slip
/// is undone on them; if the reference is, which was made from the candidate's file, the slip is done to them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FaultySide {
    /// The candidate's file is wrong.
    Candidate,
    /// What was built from the candidate's file is wrong.
    Reference,
}

/// The place of a fault.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Place {
    /// Links, by number.
    Links(Vec<usize>),
    /// Moving joints, by number.
    Joints(Vec<usize>),
    /// All links with an inertial.
    AllLinks,
    /// All moving joints.
    AllJoints,
    /// Gravity.
    Gravity,
}

impl Place {
    /// One link before two before all.
    pub(super) fn extent(&self) -> usize {
        match self {
            Self::Links(links) => links.len(),
            Self::Joints(joints) => joints.len(),
            Self::Gravity => 1,
            Self::AllLinks | Self::AllJoints => usize::MAX,
        }
    }
}

/// One possible fault.
#[derive(Debug, Clone)]
pub(crate) struct Hypothesis {
    pub(crate) cause: DynamicsCause,
    pub(crate) detail: String,
    pub(crate) place: Place,
    pub(super) change: Change,
    /// Whether the parameter is lacking in the file itself: it has a price of its own.
    pub(super) is_missing: bool,
}

/// What becomes of the candidate's parameters.
#[derive(Debug, Clone)]
pub(crate) enum Change {
    /// These links have other parameters.
    Links(Vec<(usize, Inertial)>),
    /// Numbers of one link are free.
    FreeLink { link: usize, free: Free },
    /// Numbers of one link are free, the others are these.
    FreeLinkFrom { link: usize, from: Inertial, free: Free },
    /// One factor of all links is free.
    FreeScale(Scale),
    /// All joints have these terms.
    Joints(Vec<JointResistance>),
    /// One term is free: each group of joints has one number, added to it.
    FreeJoints { term: JointTerm, groups: Vec<Vec<usize>> },
    /// Gravity is this.
    Gravity(Vector3<f64>),
    /// Gravity is free along these directions.
    FreeGravity(Vec<Vector3<f64>>),
}

/// What one factor of all links multiplies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scale {
    Masses,
    Tensors,
    /// As another density does.
    Both,
}

impl Scale {
    /// A link's parameters with the factor.
    pub(super) fn scaled(self, parameters: &Inertial, factor: f64) -> Inertial {
        let [mass, tensor] = match self {
            Self::Masses => [factor, 1.0],
            Self::Tensors => [1.0, factor],
            Self::Both => [factor, factor],
        };
        let (mass_kg, tensor_kg_m2) = (parameters.mass_kg * mass, parameters.tensor_kg_m2 * tensor);
        Inertial { mass_kg, tensor_kg_m2, ..*parameters }
    }
}

impl Hypothesis {
    pub(super) fn new(cause: DynamicsCause, detail: impl Into<String>, place: Place, change: Change) -> Self {
        Self { cause, detail: detail.into(), place, change, is_missing: false }
    }

    pub(super) fn missing(mut self) -> Self {
        self.is_missing = true;
        self
    }
}
