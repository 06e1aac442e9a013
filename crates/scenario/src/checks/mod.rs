//! `[[check]]`: the checks of a run and their limits.

mod forces;
mod joints;
mod on_violation;
mod pose;
mod recorded;
mod space;
mod unit_keys;

use congruent_input::serde_name;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use forces::{DynamicsCheck, EffortCheck, PowerCheck};
pub use joints::{CycleTimeCheck, LimitsCheck, TrackingCheck};
pub use on_violation::OnViolation;
pub use pose::{AgreementCheck, GoalCheck, InvariantsCheck, TwistCheck};
pub use recorded::{PoseCheck, RecordingCheck, SamePointCheck, StepCheck, VelocityCheck};
pub use space::{ClearanceCheck, ContactCheck, ZoneCheck};
pub use unit_keys::UnitKeys;
pub(crate) use unit_keys::in_two_units;

/// One check of a run with its limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Check {
    /// Model against twin: position and orientation of every link, at every sample.
    Agreement(AgreementCheck),
    /// Distance between links and to obstacles.
    Clearance(ClearanceCheck),
    /// Contact between links and with obstacles.
    Contact(ContactCheck),
    /// Motions that are finished in time.
    CycleTime(CycleTimeCheck),
    /// Acceleration of the twin against forward dynamics by analysis.
    Dynamics(DynamicsCheck),
    /// Effort that the actuators deliver against the commanded one.
    Effort(EffortCheck),
    /// Pose or position of the TCP at the end.
    Goal(GoalCheck),
    /// Rotations are orthonormal, joint constraints hold, and joint states are finite numbers.
    Invariants(InvariantsCheck),
    /// Position, velocity and effort of each joint within their limits.
    Limits(LimitsCheck),
    /// Recorded poses against those of the model.
    Pose(PoseCheck),
    /// Work of the actuators against the change of energy.
    Power(PowerCheck),
    /// How much of a log could be used.
    Recording(RecordingCheck),
    /// A point of the tool that is at one place whenever the arm is at rest.
    SamePoint(SamePointCheck),
    /// A jump of one joint's zero, as recorded poses show it.
    Step(StepCheck),
    /// The twin against its setpoint.
    Tracking(TrackingCheck),
    /// Velocity of the TCP by the Jacobian against the change of its pose.
    Twist(TwistCheck),
    /// Reported velocities against the change of the reported positions.
    Velocity(VelocityCheck),
    /// Links stay out of the zones that are forbidden to them.
    Zone(ZoneCheck),
}

/// The kind of a check, as files name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CheckKind {
    /// See [`Check::Agreement`].
    Agreement,
    /// See [`Check::Clearance`].
    Clearance,
    /// See [`Check::Contact`].
    Contact,
    /// See [`Check::CycleTime`].
    CycleTime,
    /// See [`Check::Dynamics`].
    Dynamics,
    /// See [`Check::Effort`].
    Effort,
    /// See [`Check::Goal`].
    Goal,
    /// See [`Check::Invariants`].
    Invariants,
    /// See [`Check::Limits`].
    Limits,
    /// See [`Check::Pose`].
    Pose,
    /// See [`Check::Power`].
    Power,
    /// See [`Check::Recording`].
    Recording,
    /// See [`Check::SamePoint`].
    SamePoint,
    /// See [`Check::Step`].
    Step,
    /// See [`Check::Tracking`].
    Tracking,
    /// See [`Check::Twist`].
    Twist,
    /// See [`Check::Velocity`].
    Velocity,
    /// See [`Check::Zone`].
    Zone,
}

impl CheckKind {
    /// Every kind, in alphabetical order.
    pub const ALL: [Self; 18] = [
        Self::Agreement,
        Self::Clearance,
        Self::Contact,
        Self::CycleTime,
        Self::Dynamics,
        Self::Effort,
        Self::Goal,
        Self::Invariants,
        Self::Limits,
        Self::Pose,
        Self::Power,
        Self::Recording,
        Self::SamePoint,
        Self::Step,
        Self::Tracking,
        Self::Twist,
        Self::Velocity,
        Self::Zone,
    ];

    /// The word of files and reports.
    pub fn word(self) -> &'static str {
        serde_name(&self)
    }
}

impl std::fmt::Display for CheckKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.word())
    }
}

/// One expression for the settings of a check, whatever its kind.
macro_rules! in_each_kind {
    ($check:ident, $settings:ident => $of:expr) => {
        match $check {
            Self::Agreement($settings) => $of,
            Self::Clearance($settings) => $of,
            Self::Contact($settings) => $of,
            Self::CycleTime($settings) => $of,
            Self::Dynamics($settings) => $of,
            Self::Effort($settings) => $of,
            Self::Goal($settings) => $of,
            Self::Invariants($settings) => $of,
            Self::Limits($settings) => $of,
            Self::Pose($settings) => $of,
            Self::Power($settings) => $of,
            Self::Recording($settings) => $of,
            Self::SamePoint($settings) => $of,
            Self::Step($settings) => $of,
            Self::Tracking($settings) => $of,
            Self::Twist($settings) => $of,
            Self::Velocity($settings) => $of,
            Self::Zone($settings) => $of,
        }
    };
}

impl Check {
    /// The kind of the check, without its limits.
    pub fn kind(&self) -> CheckKind {
        match self {
            Self::Agreement(_) => CheckKind::Agreement,
            Self::Clearance(_) => CheckKind::Clearance,
            Self::Contact(_) => CheckKind::Contact,
            Self::CycleTime(_) => CheckKind::CycleTime,
            Self::Dynamics(_) => CheckKind::Dynamics,
            Self::Effort(_) => CheckKind::Effort,
            Self::Goal(_) => CheckKind::Goal,
            Self::Invariants(_) => CheckKind::Invariants,
            Self::Limits(_) => CheckKind::Limits,
            Self::Pose(_) => CheckKind::Pose,
            Self::Power(_) => CheckKind::Power,
            Self::Recording(_) => CheckKind::Recording,
            Self::SamePoint(_) => CheckKind::SamePoint,
            Self::Step(_) => CheckKind::Step,
            Self::Tracking(_) => CheckKind::Tracking,
            Self::Twist(_) => CheckKind::Twist,
            Self::Velocity(_) => CheckKind::Velocity,
            Self::Zone(_) => CheckKind::Zone,
        }
    }

    /// What the run does at the first violation of the check.
    pub fn on_violation(&self) -> OnViolation {
        in_each_kind!(self, check => check.on_violation)
    }

    /// The same, to change it.
    pub fn on_violation_mut(&mut self) -> &mut OnViolation {
        in_each_kind!(self, check => &mut check.on_violation)
    }

    /// Share of all possible cases of `[uncertainty]` in which the check must hold; `None` for each case that runs.
    pub fn passing(&self) -> Option<f64> {
        match self {
            Self::Agreement(check) => check.passing,
            Self::Clearance(check) => check.passing,
            Self::Contact(check) => check.passing,
            Self::CycleTime(check) => check.passing,
            Self::Dynamics(check) => check.passing,
            Self::Effort(check) => check.passing,
            Self::Goal(check) => check.passing,
            Self::Invariants(check) => check.passing,
            Self::Limits(check) => check.passing,
            Self::Power(check) => check.passing,
            Self::Tracking(check) => check.passing,
            Self::Twist(check) => check.passing,
            Self::Zone(check) => check.passing,
            // Of logs alone, which have no cases.
            Self::Pose(_) | Self::Recording(_) | Self::SamePoint(_) | Self::Step(_) | Self::Velocity(_) => {
                None
            }
        }
    }

    /// The values that a file may give in one of two units.
    pub fn unit_keys(&self) -> Vec<UnitKeys> {
        match self {
            Self::Agreement(check) => check.unit_keys().into(),
            Self::Clearance(check) => vec![check.unit_keys()],
            Self::Contact(check) => vec![check.unit_keys()],
            Self::Goal(check) => check.unit_keys().into(),
            Self::CycleTime(check) => check.unit_keys().into(),
            Self::Limits(check) => check.unit_keys().into(),
            Self::Tracking(check) => check.unit_keys().into(),
            Self::Twist(check) => check.unit_keys().into(),
            Self::Pose(check) => check.unit_keys().into(),
            Self::SamePoint(check) => check.unit_keys().into(),
            Self::Step(check) => check.unit_keys().into(),
            Self::Dynamics(_)
            | Self::Effort(_)
            | Self::Invariants(_)
            | Self::Power(_)
            | Self::Recording(_)
            | Self::Velocity(_)
            | Self::Zone(_) => Vec::new(),
        }
    }
}
