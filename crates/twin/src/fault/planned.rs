//! A fault that was checked against its robot: names are coordinates, values are in SI units, times are steps.

use std::ops::Range;

use congruent_description::{CarriedBody, Robot};
use congruent_monitors::RunClock;
use congruent_scenario::{FaultKind, FaultQuantity, RunFault};
use nalgebra::Isometry3;

/// A fault of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedFault {
    /// Effect of the fault on the twin.
    pub action: FaultAction,
    /// Number of the first sample with the fault.
    pub from_step: u64,
    /// Number of the first sample after the fault.
    pub until_step: u64,
    /// Line of its section in the scenario file, from 1.
    pub line: Option<usize>,
    /// The same for reports.
    pub(crate) described: RunFault,
}

/// What a fault does; joints are coordinates, values are in rad, m, N and s.
#[derive(Debug, Clone, PartialEq)]
pub enum FaultAction {
    /// The encoder reads too much.
    EncoderOffset {
        /// Coordinate of the joint.
        joint: usize,
        /// Reading minus position, rad or m.
        offset: f64,
    },
    /// What the encoder reads too much grows.
    EncoderDrift {
        /// Coordinate of the joint.
        joint: usize,
        /// Change of the offset, rad/s or m/s.
        rate: f64,
    },
    /// Encoder and drive count the other way round.
    FlippedAxis {
        /// Coordinate of the joint.
        joint: usize,
    },
    /// Encoders and drives are exchanged.
    SwappedJoints {
        /// Coordinates of the two joints.
        joints: [usize; 2],
    },
    /// The joint does not move.
    StuckJoint {
        /// Coordinate of the joint.
        joint: usize,
    },
    /// The actuator exerts a share of what it is asked for, which may be 0.
    ScaledTorque {
        /// Coordinate of the joint.
        joint: usize,
        /// Exerted effort divided by commanded effort.
        share: f64,
    },
    /// Friction in addition to that of the description.
    AddedFriction {
        /// Coordinate of the joint.
        joint: usize,
        /// Dry friction, N m or N.
        dry: f64,
        /// Viscous friction, N m s/rad or N s/m.
        viscous: f64,
    },
    /// A load on the tool that is not declared.
    WrongPayload {
        /// The load on its link.
        load: CarriedBody,
    },
    /// The tool is at another pose.
    ShiftedTool {
        /// Index of the link `tip`.
        tip: usize,
        /// Its pose in the frame in which it would stand.
        tip_from_shifted: Isometry3<f64>,
        /// The links that move with it, itself included.
        links: Vec<usize>,
    },
    /// The measured state arrives late.
    Latency {
        /// By how many steps.
        steps: usize,
    },
    /// Measured states get lost.
    DroppedSamples {
        /// Probability that a reading is lost.
        share: f64,
    },
}

/// What two faults cannot both have at the same time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Slot {
    Offset(usize),
    Drift(usize),
    Wires(usize),
    Torque(usize),
    Resistance(usize),
    RunPayload,
    Tool,
    Latency,
    Dropped,
}

impl FaultAction {
    pub(super) fn slots(&self) -> Vec<Slot> {
        match *self {
            Self::EncoderOffset { joint, .. } => vec![Slot::Offset(joint)],
            Self::EncoderDrift { joint, .. } => vec![Slot::Drift(joint)],
            Self::FlippedAxis { joint } => vec![Slot::Wires(joint)],
            // As for a reversed axis: a joint has one wire, which cannot be exchanged twice.
            Self::SwappedJoints { joints } => joints.map(Slot::Wires).to_vec(),
            // Both replace the joint's resistance and put it back, so they cannot be interleaved.
            Self::StuckJoint { joint } | Self::AddedFriction { joint, .. } => vec![Slot::Resistance(joint)],
            Self::ScaledTorque { joint, .. } => vec![Slot::Torque(joint)],
            Self::WrongPayload { .. } => vec![Slot::RunPayload],
            Self::ShiftedTool { .. } => vec![Slot::Tool],
            Self::Latency { .. } => vec![Slot::Latency],
            Self::DroppedSamples { .. } => vec![Slot::Dropped],
        }
    }
}

impl PlannedFault {
    /// Whether it is there at a sample.
    pub fn is_active_at(&self, step: u64) -> bool {
        (self.from_step..self.until_step).contains(&step)
    }

    /// Whether both are there at some time.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        self.from_step < other.until_step && other.from_step < self.until_step
    }

    /// Its description for reports.
    pub fn described(&self) -> &RunFault {
        &self.described
    }
}

/// The description of an action for reports, with the true values.
pub(super) fn describe(
    kind: FaultKind,
    action: &FaultAction,
    robot: &Robot,
    clock: &RunClock,
    steps: Range<u64>,
) -> RunFault {
    let joint = |coordinate: usize| robot.joint(robot.movable_joints()[coordinate]);
    let unit = |coordinate: usize| joint(coordinate).kind.si_unit();
    let (mut joints, mut link) = (Vec::new(), None);
    let values = match action {
        FaultAction::EncoderOffset { joint, offset } => {
            joints.push(*joint);
            vec![FaultQuantity::offset(*offset, unit(*joint))]
        }
        FaultAction::EncoderDrift { joint, rate } => {
            joints.push(*joint);
            vec![FaultQuantity::rate(*rate, unit(*joint))]
        }
        FaultAction::FlippedAxis { joint } | FaultAction::StuckJoint { joint } => {
            joints.push(*joint);
            Vec::new()
        }
        FaultAction::SwappedJoints { joints: both } => {
            joints.extend(both);
            Vec::new()
        }
        FaultAction::ScaledTorque { joint, share } => {
            joints.push(*joint);
            // The share of a lost torque is 0 by definition.
            if kind == FaultKind::LostTorque { Vec::new() } else { vec![FaultQuantity::share(*share)] }
        }
        FaultAction::AddedFriction { joint, dry, viscous } => {
            joints.push(*joint);
            FaultQuantity::friction([*dry, *viscous], unit(*joint))
        }
        FaultAction::WrongPayload { load } => {
            link = Some(load.link.get());
            FaultQuantity::payload(
                load.inertia.mass_kg,
                load.inertia.link_from_inertial.translation.vector,
                [true; 3],
            )
        }
        FaultAction::ShiftedTool { tip, tip_from_shifted, .. } => {
            link = Some(*tip);
            FaultQuantity::shift(tip_from_shifted)
        }
        #[expect(clippy::cast_precision_loss, reason = "steps of a run are far below 2^52")]
        FaultAction::Latency { steps } => vec![FaultQuantity::latency(*steps as f64 * clock.step_s)],
        FaultAction::DroppedSamples { share } => vec![FaultQuantity::share(*share)],
    };
    RunFault {
        kind,
        joints: joints.into_iter().map(|coordinate| joint(coordinate).name.clone()).collect(),
        link: link.map(|link| robot.links()[link].name.clone()),
        values,
        from_s: clock.time_s(steps.start),
        // A fault without an end has `u64::MAX`.
        until_s: clock.steps.is_some_and(|last| steps.end <= last).then(|| clock.time_s(steps.end)),
    }
}
