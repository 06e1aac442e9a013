//! A hypothesis about a fault: which parameters of the candidate have to change to give the torques of the reference. The
//! catalogue of hypotheses is `cause/`.

use congruent_dynamics::JointResistance;
use nalgebra::Vector3;

use super::{cause_names::DynamicsCause, free::FreeParameters};
use crate::model::{Inertial, JointTerm};

/// Which of the two models is assumed to be wrong.
///
/// Only the candidate's parameters are known, so hypotheses always change these. If the candidate is assumed to be wrong, a
/// mistake is undone on them; if the reference is, which was built from the candidate's file, the mistake is made on them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FaultySide {
    /// The file of the candidate is wrong.
    Candidate,
    /// The reference, which was built from the candidate's file, is wrong.
    Reference,
}

/// The links, joints or gravity that a fault is at.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum DynamicsPlace {
    /// Links by their index in the description.
    Links(Vec<usize>),
    /// Moving joints by their index among the moving joints.
    Joints(Vec<usize>),
    /// All links with an inertial.
    AllLinks,
    /// Every moving joint of the robot.
    AllJoints,
    /// The gravity vector of the whole robot.
    Gravity,
}

impl DynamicsPlace {
    /// Size of the place, for the order of explanations: one link before two before all.
    pub(super) fn extent(&self) -> usize {
        match self {
            Self::Links(links) => links.len(),
            Self::Joints(joints) => joints.len(),
            Self::Gravity => 1,
            Self::AllLinks | Self::AllJoints => usize::MAX,
        }
    }
}

/// One possible fault: cause, place, and the change that it makes.
#[derive(Debug, Clone)]
pub(crate) struct DynamicsHypothesis {
    pub(crate) cause: DynamicsCause,
    pub(crate) detail: String,
    pub(crate) place: DynamicsPlace,
    pub(super) change: Change,
    /// Whether the file itself lacks the parameter, which has a complexity of its own.
    pub(super) is_missing: bool,
}

/// The change of the candidate's parameters by a hypothesis.
#[derive(Debug, Clone)]
pub(crate) enum Change {
    /// Links with given new parameters.
    Links(Vec<(usize, Inertial)>),
    /// Some parameters of one link are free.
    FreeLink { link: usize, free: FreeParameters },
    /// Some parameters of one link are free, the others have the values of `from`.
    FreeLinkFrom { link: usize, from: Inertial, free: FreeParameters },
    /// One factor for all links is free.
    FreeScale(Scale),
    /// Given new terms of all joints.
    Joints(Vec<JointResistance>),
    /// One term is free: one value for each group of joints is added to it.
    FreeJoints { term: JointTerm, groups: Vec<Vec<usize>> },
    /// A given new gravity vector, m/s^2.
    Gravity(Vector3<f64>),
    /// Gravity is free along these directions.
    FreeGravity(Vec<Vector3<f64>>),
}

impl Change {
    /// Whether it determines each parameter that it changes. Of several free parameters of which torques show few
    /// combinations, a fit may change any.
    pub(super) fn determines_each_parameter(&self) -> bool {
        match self {
            Self::FreeLink { free, .. } | Self::FreeLinkFrom { free, .. } => free.count() == 1,
            _ => true,
        }
    }
}

/// The parameters that one factor for all links multiplies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scale {
    Masses,
    Tensors,
    /// Masses and tensors, as another density does.
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

impl DynamicsHypothesis {
    pub(super) fn new(
        cause: DynamicsCause,
        detail: impl Into<String>,
        place: DynamicsPlace,
        change: Change,
    ) -> Self {
        Self { cause, detail: detail.into(), place, change, is_missing: false }
    }

    pub(super) fn missing(mut self) -> Self {
        self.is_missing = true;
        self
    }
}
