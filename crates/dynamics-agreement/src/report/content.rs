//! The report of a comparison of dynamics, as JSON. Units are SI.

use congruent_input::ChangedLines;

use crate::{
    bound::{CoveredMotion, TorqueCertificate},
    diagnosis::{DynamicsCause, EquivalenceReason, FaultySide},
    differences::{Invariants, LimitDifference, ParameterDifference},
    torque::IdentifiableParameters,
};

/// What a comparison of dynamics found.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct DynamicsReport {
    /// Names of the two models, and which one is assumed to be wrong.
    pub sides: ComparedModels,
    /// The result of the comparison of torques and parameters.
    pub verdict: DynamicsVerdict,
    /// The torque difference at the states relative to the sum of both torques (norms); each joint is weighted by its own
    /// torques.
    pub difference_relative: f64,
    /// How well any chain of rigid bodies reproduces the reference's torques.
    pub premise: DynamicsPremise,
    /// Number of identifiable inertial parameters; `null` for more than 60 joints, where it is not computed.
    pub seen: Option<IdentifiableParameters>,
    /// Masses, gravity torques, mass matrix; `null` if the reference is a source of accelerations, not a description.
    pub invariants: Option<Invariants>,
    /// Links of bodies that can account for the whole difference by their inertial parameters alone.
    #[serde(rename = "where")]
    pub links: Vec<String>,
    /// Parameters of links that differ between two descriptions; tensors in the axes of the inertial frame if both have the
    /// same, else in those of the link.
    pub differences: Vec<ParameterDifference>,
    /// The part of `differences` without an effect on joint torques.
    pub hidden_differences: Vec<ParameterDifference>,
    /// The best explanation of the difference; empty if there is no difference, or no explanation. More than one if more than
    /// two links differ: then each explains one link, the joint terms or gravity.
    pub explanations: Vec<DynamicsExplanation>,
    /// Other explanations with other parameters and the same torques.
    pub indistinguishable: Vec<DynamicsExplanation>,
    /// What the reference does not state, in words: it is not compared.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub not_stated: Vec<String>,
    /// The file that alone states armatures, the inertias of motors: they are not compared.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub armature_stated_by: Option<String>,
    /// Joint limits that differ.
    pub limits: Vec<LimitDifference>,
    /// Certified bounds of the torque differences; `null` if they were not requested.
    pub certificates: Option<TorqueCertificates>,
}

/// The name of the physics among the sides of a report.
pub const PHYSICS: &str = "physics";

impl DynamicsReport {
    /// Whether the report is of a URDF and the physics that was built from it, which is no second description.
    pub fn is_of_physics(&self) -> bool {
        self.sides.reference == PHYSICS
    }

    /// Whether no joint torque differs by more than the precision of the comparison.
    pub fn has_same_torques(&self) -> bool {
        !matches!(self.verdict, DynamicsVerdict::Explained | DynamicsVerdict::Unexplained)
    }

    /// Whether no torque and no limit differs. Parameters without an effect on torques do not decide, and neither does a
    /// limit of speed or effort that only one of the two states.
    pub fn agrees(&self) -> bool {
        self.has_same_torques() && !self.has_other_limits()
    }

    /// Whether a joint limit differs that decides.
    pub fn has_other_limits(&self) -> bool {
        self.limits.iter().any(|limit| limit.decides)
    }
}

/// Certified bounds of the torque differences over the joints' positions, speeds and accelerations.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, schemars::JsonSchema)]
pub struct TorqueCertificates {
    /// Bounds of the gravity torques alone.
    pub gravity: TorqueCertificate,
    /// Bounds of the torques by accelerations alone, armature included.
    pub inertia: TorqueCertificate,
    /// Bounds of the centrifugal and Coriolis torques alone.
    pub velocity: TorqueCertificate,
    /// Bounds of the whole torque in any covered motion, with gravity, damping and dry friction.
    pub together: TorqueCertificate,
    /// Positions, speeds and accelerations that are covered, one for each moving joint.
    pub covered: Vec<CoveredMotion>,
}

/// Names of the two models that are compared.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
pub struct ComparedModels {
    /// Name of the candidate, whose parameters are known and corrected.
    pub candidate: String,
    /// Name of the reference model.
    pub reference: String,
    /// Which of the two is assumed to be wrong.
    pub faulty: FaultySide,
}

/// The result of a comparison of dynamics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DynamicsVerdict {
    /// Torques and parameters are the same.
    Same,
    /// Torques are the same; parameters without an effect on torques differ.
    SameTorques,
    /// Torques differ, and an explanation has a residual within tolerance.
    Explained,
    /// Torques differ for no known reason.
    Unexplained,
    /// The reference states no mass of a moving link: there are no torques to compare.
    NotCompared,
}

/// How well a chain of rigid bodies reproduces the reference's torques: the premise of every explanation.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct DynamicsPremise {
    /// Relative residual of the best fit by any inertial parameters, at the fitted states.
    pub fit_relative: f64,
    /// Relative residual of the same fit at the held-out states; `null` if the torques are computed from a description.
    pub held_out_relative: Option<f64>,
    /// Number of states at which torques are compared.
    pub states: usize,
}

/// One explanation of a torque difference: a cause with its place and the corrected parameters.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct DynamicsExplanation {
    /// The cause; `several` if the explanation has parts.
    pub cause: DynamicsCause,
    /// Which unit, axis, entry, frame.
    pub detail: String,
    /// Names of links or joints; `*` for all of them; `gravity`.
    pub place: Vec<String>,
    /// The corrected parameters, with their written and their corrected values.
    #[serde(rename = "figures")]
    pub parameters: Vec<ParameterDifference>,
    /// Complexity: identifiable free parameters, 0.5 for a parameter that the file does not have, 1 for each further part.
    pub numbers: f64,
    /// Residual torque difference after the correction, relative to the difference before.
    pub left_relative: f64,
    /// Whether the corrected parameters are physically possible for a rigid body.
    pub is_a_body: bool,
    /// The law that the corrected parameters break, with the link; `null` if they break none.
    pub body_law: Option<String>,
    /// Links whose written values are physically impossible, each with the law that they break.
    pub impossible_as_written: Vec<String>,
    /// Whether it changes a parameter that is equal in both descriptions.
    pub contradicted: bool,
    /// Other causes with the same corrected parameters.
    pub also_named: Vec<PlacedCause>,
    /// Why joint torques cannot distinguish it from the first explanation; `null` for the first.
    pub reason: Option<EquivalenceReason>,
    /// The single causes, if there are several faults at once; otherwise empty.
    pub parts: Vec<PlacedCause>,
    /// Path of the file to correct; `null` if it is not known, or right.
    pub file: Option<String>,
    /// Line of this file where the first value is to be written.
    pub line: Option<usize>,
    /// The values to write, in one sentence; `null` if the file is right or too many values change.
    pub suggestion: Option<String>,
    /// The lines of the file to change, with their new text; empty if the file is right or its format cannot express them.
    pub changes: Vec<ChangedLines>,
    /// The cause if the other of the two files is wrong, with its line; `null` if there is none.
    pub otherwise: Option<String>,
}

/// A cause with the links or joints that it is about.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
pub struct PlacedCause {
    /// The cause of this part alone.
    pub cause: DynamicsCause,
    /// Which unit, axis, entry, frame.
    pub detail: String,
    /// Names of links or joints; `*` for all of them; `gravity`.
    pub place: Vec<String>,
}
