//! The report of a comparison of dynamics, as JSON. Units are SI.

use congruent_description::ChangedLines;

use crate::{
    bound::{CoveredMotion, TorqueCertificate},
    compare::{Invariants, LimitDifference, ParameterDifference},
    diagnosis::{DynamicsCause, EquivalenceReason, FaultySide},
    torque::SeenNumbers,
};

/// What a comparison of dynamics found.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct DynamicsReport {
    /// Names of the two.
    pub sides: Sides,
    /// The result.
    pub verdict: DynamicsVerdict,
    /// The difference of torque at the states, as a share of both torques; every joint counts alike.
    pub difference_relative: f64,
    /// How well the reference's torques are those of a rigid body chain at all.
    pub premise: DynamicsPremise,
    /// How many inertial numbers torques tell; `null` of more than 60 joints, where it is not known.
    pub seen: Option<SeenNumbers>,
    /// Masses, gravity torques, mass matrix; `null` if the reference is no description.
    pub invariants: Option<Invariants>,
    /// Links whose numbers alone can contain the difference.
    #[serde(rename = "where")]
    pub links: Vec<String>,
    /// Parameters of links that differ between two descriptions; tensors in the axes of the inertial frame if both have the
    /// same, else in those of the link.
    pub differences: Vec<ParameterDifference>,
    /// Those of them that no joint torque shows.
    pub hidden_differences: Vec<ParameterDifference>,
    /// What explains the difference best; empty if there is none, or if nothing explains it. More than one if the
    /// difference is that of more than two links: then each explains its own link, joints or gravity.
    pub explanations: Vec<DynamicsExplanation>,
    /// What leaves the same torques with other parameters.
    pub indistinguishable: Vec<DynamicsExplanation>,
    /// Limits of joints that differ.
    pub limits: Vec<LimitDifference>,
    /// How large the differences of torque can get; `null` if nobody has asked.
    pub certificates: Option<TorqueCertificates>,
}

impl DynamicsReport {
    /// Whether all joint torques are the same.
    pub fn has_same_torques(&self) -> bool {
        matches!(self.verdict, DynamicsVerdict::Same | DynamicsVerdict::SameTorques)
    }

    /// Whether torques and limits are the same: a difference that no torque shows is none that decides, and neither is a
    /// limit of speed or effort that one of the two does not state.
    pub fn agrees(&self) -> bool {
        self.has_same_torques() && !self.limits.iter().any(|limit| limit.decides)
    }
}

/// How large the differences of torque can get over the range of the joints' motion.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, schemars::JsonSchema)]
pub struct TorqueCertificates {
    /// Of gravity alone.
    pub gravity: TorqueCertificate,
    /// Of accelerations alone, armature included.
    pub inertia: TorqueCertificate,
    /// Of velocity products alone: centrifugal and Coriolis torques.
    pub velocity: TorqueCertificate,
    /// Of any motion, with gravity, damping and dry friction.
    pub together: TorqueCertificate,
    /// Positions, speeds and accelerations that are covered, one for each moving joint.
    pub covered: Vec<CoveredMotion>,
}

/// Names of the two sides.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
pub struct Sides {
    /// Whose parameters are known and corrected.
    pub candidate: String,
    /// What it is held against.
    pub reference: String,
    /// Which of the two is taken to be wrong.
    pub faulty: FaultySide,
}

/// The result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DynamicsVerdict {
    /// Torques and parameters are the same.
    Same,
    /// Torques are the same, but parameters differ that no torque shows.
    SameTorques,
    /// Torques differ, and an explanation leaves nothing of the difference.
    Explained,
    /// Torques differ for no known reason.
    Unexplained,
}

/// How well the reference's torques are those of a rigid body chain.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct DynamicsPremise {
    /// Part of the reference's torque that no numbers of such a chain explain, at the states that are fitted.
    pub fit_relative: f64,
    /// The same at the states that are held out; `null` if the torques are computed from a description.
    pub held_out_relative: Option<f64>,
    /// How many states.
    pub states: usize,
}

/// One explanation.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct DynamicsExplanation {
    /// `several` if it has parts.
    pub cause: DynamicsCause,
    /// Which unit, axis, entry, frame.
    pub detail: String,
    /// Links or joints; `*` for all of them, `gravity`.
    pub place: Vec<String>,
    /// The parameters that it corrects, as they are written and as they should be.
    #[serde(rename = "figures")]
    pub parameters: Vec<ParameterDifference>,
    /// What it costs: free numbers that torque shows, 0.5 for a parameter that the file does not have, 1 for each further part.
    pub numbers: f64,
    /// What is left of the difference.
    pub left_relative: f64,
    /// Whether the corrected parameters are those of a body.
    pub is_a_body: bool,
    /// The law that they break.
    pub body_law: Option<String>,
    /// Why no body has the values as they are written, each link with its law; empty if bodies have them.
    pub impossible_as_written: Vec<String>,
    /// Whether it changes a parameter that is the same in both descriptions.
    pub contradicted: bool,
    /// Other names of the same correction.
    pub also_named: Vec<PlacedCause>,
    /// Why torque cannot tell it from the first explanation.
    pub reason: Option<EquivalenceReason>,
    /// The parts of several faults at once.
    pub parts: Vec<PlacedCause>,
    /// The file that is to be corrected.
    pub file: Option<String>,
    /// The line of the first parameter.
    pub line: Option<usize>,
    /// What to write instead.
    pub suggestion: Option<String>,
    /// The lines of the file that change, with what they become; empty if the file is right or cannot say it.
    pub changes: Vec<ChangedLines>,
    /// What is wrong if it is the other of two files, with its line; `null` if that explains less.
    pub otherwise: Option<String>,
}

/// A cause with its place.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
pub struct PlacedCause {
    /// The cause.
    pub cause: DynamicsCause,
    /// Which unit, axis, entry, frame.
    pub detail: String,
    /// Links or joints; `*` for all of them, `gravity`.
    pub place: Vec<String>,
}
