//! The faults of a scenario against its robot: names, units, ranges and times, each error at its place.

use congruent_description::{CarriedBody, Inertia, JointKind, LinkIndex, Robot, RobotDescription};
use congruent_input::{
    Diagnostic, Findings,
    display::{number, quantity, quantity_in_full},
    units::{Unit, WrittenUnit},
};
use congruent_monitors::RunClock;
use congruent_motion::moving_joint;
use congruent_scenario::{
    AddedFrictionFault, ControllerKind, FaultKind, FaultSettings, FaultTime, FilePlace, PoseSettings,
    ShiftedToolFault, WrongPayloadFault,
};
use nalgebra::{Isometry3, Matrix3, Translation3};

use super::planned::{FaultAction, PlannedFault, describe};
use crate::{codes, setup::LARGEST_M};

/// Smaller values have no effect, in SI units: checks of agreement allow 1 nm and 1 nrad.
const LEAST: f64 = 1e-9;
/// Largest friction, N m or N, and per rad/s or m/s. Kind: numerics; it holds any arm.
const MOST_FRICTION: f64 = 1e9;
/// Largest share of the effort that an actuator may exert.
const LARGEST_SHARE: f64 = 10.0;
/// Largest undeclared payload, times the mass of the robot. Kind: physics; with a heavier payload the drives hold a small part
/// of it, and the arm falls within some steps.
const HEAVIEST_PART: f64 = 100.0;
/// Largest deviation of a latency from a whole number of steps, in steps. Kind: digits of files.
const WHOLE_STEPS: f64 = 1e-6;
/// Longest latency, in steps: the readings of all steps of a latency are in memory.
const MOST_DELAYED: f64 = 1e5;

/// All faults of a scenario, or every finding.
pub(crate) fn resolve(
    settings: &[FaultSettings],
    place: FilePlace<'_>,
    description: &RobotDescription,
    clock: &RunClock,
    controller: ControllerKind,
) -> Result<Vec<PlannedFault>, Findings> {
    let (mut planned, mut errors) = (Vec::<PlannedFault>::new(), Vec::new());
    for (index, fault) in settings.iter().enumerate() {
        let place = place.item(index);
        let resolver = Resolver { description, clock, place };
        match resolver.planned(fault, controller) {
            // Against the faults before it alone: each conflict is reported once, at the later section.
            Ok(fault) => match excluded(&fault, &planned) {
                Some(error) => errors.push(place.mark(error)),
                None => planned.push(fault),
            },
            Err(error) => errors.push(error),
        }
    }
    if errors.is_empty() { Ok(planned) } else { Err(errors.into()) }
}

/// Two faults that set the same thing at the same time.
fn excluded(fault: &PlannedFault, before: &[PlannedFault]) -> Option<Diagnostic> {
    let slots = fault.action.slots();
    let other = before.iter().find(|other| {
        other.overlaps(fault) && other.action.slots().iter().any(|slot| slots.contains(slot))
    })?;
    let line = other.line.map_or(String::new(), |line| format!(" of line {line}"));
    let (kind, known) = (fault.described.kind, other.described.kind);
    let message = format!("{kind} and {known}{line} cannot act at the same time");
    let help = "let one end (`until_s`) before the other begins (`at_s`), or remove one of them";
    Some(Diagnostic::error(codes::scenario::FAULTS_EXCLUDE, message).with_help(help))
}

struct Resolver<'a> {
    description: &'a RobotDescription,
    clock: &'a RunClock,
    place: FilePlace<'a>,
}

impl Resolver<'_> {
    fn planned(&self, fault: &FaultSettings, controller: ControllerKind) -> Result<PlannedFault, Diagnostic> {
        let kind = fault.kind();
        let (from_step, until_step) = self.steps(fault.time())?;
        let action = self.action(fault)?;
        // Last: a wrong name or value is the more useful message.
        self.has_effect(kind, controller)?;
        let robot = &self.description.robot;
        let described = describe(kind, &action, robot, self.clock, from_step..until_step);
        Ok(PlannedFault { action, from_step, until_step, line: self.place.line(), described })
    }

    /// Times as samples: a fault is there from the nearest one on.
    fn steps(&self, time: FaultTime) -> Result<(u64, u64), Diagnostic> {
        let FaultTime { at_s, until_s } = time;
        let duration_s = self.clock.duration_s();
        let refused = |key: &str, message: String| {
            let help = format!("a fault must begin before the end of the run at {duration_s} s");
            let error = Diagnostic::error(codes::scenario::FAULT_TIME, message).with_help(help);
            Err(self.place.key(key).mark(error))
        };
        if !(at_s.is_finite() && at_s >= 0.0 && at_s < duration_s) {
            return refused("at_s", format!("at_s = {at_s} is outside [0, {duration_s})"));
        }
        // The conditions are positive, so that NaN is refused as well.
        if let Some(until_s) = until_s.filter(|until_s| !(*until_s > at_s && *until_s <= duration_s)) {
            return refused("until_s", format!("until_s = {until_s} is outside ({at_s}, {duration_s}]"));
        }
        let step = |time_s: f64| nearest_step(time_s, self.clock.step_s);
        let (from, until) = (step(at_s), until_s.map_or(u64::MAX, step));
        if self.clock.steps.is_some_and(|steps| from >= steps) {
            return refused("at_s", format!("at_s = {at_s} s is rounded to the end of the run"));
        }
        // Both times may be rounded to the same sample.
        if from >= until {
            return refused("until_s", "the fault is shorter than a step".to_owned());
        }
        Ok((from, until))
    }

    fn action(&self, fault: &FaultSettings) -> Result<FaultAction, Diagnostic> {
        Ok(match fault {
            FaultSettings::EncoderOffset(fault) => {
                let joint = self.joint(&fault.joint)?;
                let written = [fault.value_rad, fault.value_deg, fault.value_m, fault.value_mm];
                let offset = self.value(joint, ["value_rad", "value_deg", "value_m", "value_mm"], written)?;
                FaultAction::EncoderOffset { joint, offset }
            }
            FaultSettings::EncoderDrift(fault) => {
                let joint = self.joint(&fault.joint)?;
                let keys = ["rate_rad_per_s", "rate_deg_per_s", "rate_m_per_s", "rate_mm_per_s"];
                let written =
                    [fault.rate_rad_per_s, fault.rate_deg_per_s, fault.rate_m_per_s, fault.rate_mm_per_s];
                FaultAction::EncoderDrift { joint, rate: self.value(joint, keys, written)? }
            }
            FaultSettings::FlippedAxis(fault) => {
                FaultAction::FlippedAxis { joint: self.joint(&fault.joint)? }
            }
            FaultSettings::StuckJoint(fault) => FaultAction::StuckJoint { joint: self.joint(&fault.joint)? },
            FaultSettings::LostTorque(fault) => {
                FaultAction::ScaledTorque { joint: self.joint(&fault.joint)?, share: 0.0 }
            }
            FaultSettings::ScaledTorque(fault) => {
                let joint = self.joint(&fault.joint)?;
                let is_sound =
                    |share: f64| (LEAST..=LARGEST_SHARE).contains(&share) && (share - 1.0).abs() >= LEAST;
                let range = "a factor above 0 and at most 10, not 1 (for 0 use the fault `lost_torque`)";
                self.within("share", fault.share, is_sound, range)?;
                FaultAction::ScaledTorque { joint, share: fault.share }
            }
            FaultSettings::AddedFriction(fault) => self.friction(fault)?,
            FaultSettings::WrongPayload(fault) => self.payload(fault)?,
            FaultSettings::ShiftedTool(fault) => self.tool(fault)?,
            FaultSettings::SwappedJoints(fault) => self.swapped(&fault.joints)?,
            FaultSettings::Latency(fault) => FaultAction::Latency { steps: self.whole_steps(fault.time_s)? },
            FaultSettings::DroppedSamples(fault) => {
                let is_sound = |share| (LEAST..1.0).contains(&share);
                self.within("share", fault.share, is_sound, "a share above 0 and below 1")?;
                FaultAction::DroppedSamples { share: fault.share }
            }
        })
    }

    /// A latency as steps: a reading arrives in one of them, not between two.
    fn whole_steps(&self, time_s: f64) -> Result<usize, Diagnostic> {
        let step_s = self.clock.step_s;
        let is_sound = |time_s: f64| time_s > 0.0 && time_s < self.clock.duration_s();
        self.within("time_s", time_s, is_sound, "a time above 0 and below the duration of the run")?;
        let steps = time_s / step_s;
        let refused = |message: String, help: String| {
            let error = Diagnostic::error(codes::scenario::FAULT_VALUE, message).with_help(help);
            Err(self.place.key("time_s").mark(error))
        };
        // Below half a step the nearest whole number is 0, which delays nothing.
        if (steps - steps.round()).abs() > WHOLE_STEPS || steps < 0.5 {
            let message =
                format!("time_s = {time_s} is {} steps of {step_s} s, not a whole number", number(steps));
            let near = [steps.floor(), steps.ceil()].into_iter().filter(|steps| *steps >= 1.0);
            let near: Vec<String> = near.map(|steps| quantity_in_full(steps * step_s, "s")).collect();
            let near = near.join(" or ");
            let help = format!("give {near}, or another `step_s` under [simulation]");
            return refused(message, help);
        }
        if steps > MOST_DELAYED {
            let message = format!("time_s = {time_s} is {} steps, limit <= {MOST_DELAYED}", number(steps));
            return refused(message, "give a shorter latency, or a longer `step_s`".to_owned());
        }
        Ok(usize::try_from(nearest_step(time_s, step_s)).unwrap_or(usize::MAX))
    }

    fn joint(&self, name: &str) -> Result<usize, Diagnostic> {
        let robot = &self.description.robot;
        let joint = moving_joint(robot, name).map_err(|error| self.place.key("joint").mark(error))?;
        Ok(robot.coordinate(joint).expect("a moving joint has a coordinate"))
    }

    fn is_prismatic(&self, coordinate: usize) -> bool {
        let robot = &self.description.robot;
        robot.joint(robot.movable_joints()[coordinate]).kind == JointKind::Prismatic
    }

    /// The one value that is given, of keys in rad, deg, m and mm; not zero.
    fn value(
        &self,
        joint: usize,
        keys: [&'static str; 4],
        written: [Option<f64>; 4],
    ) -> Result<f64, Diagnostic> {
        let given = keys.into_iter().zip(written);
        let given: Vec<(&'static str, f64)> = given.filter_map(|(key, value)| Some((key, value?))).collect();
        let fitting = if self.is_prismatic(joint) { [keys[2], keys[3]] } else { [keys[0], keys[1]] };
        let [(key, value)] = given[..] else {
            let message = format!("the fault has {} values, but needs exactly one", given.len());
            let help = format!("give `{}` or `{}`", fitting[0], fitting[1]);
            let error = Diagnostic::error(codes::scenario::FAULT_VALUE, message).with_help(help);
            return Err(self.place.mark(error));
        };
        let unit = WrittenUnit::of_key(key);
        if (unit.unit == Unit::Length) != self.is_prismatic(joint) {
            let help = format!("give `{}` or `{}`", fitting[0], fitting[1]);
            let message = format!("`{key}` has the wrong unit for this joint");
            let error =
                Diagnostic::error(congruent_motion::codes::scenario::JOINT_UNIT, message).with_help(help);
            return Err(self.place.key(key).mark(error));
        }
        let in_si = unit.to_si(value);
        let [unit, _] = unit.unit.names();
        let range =
            format!("a value between {} and {LARGEST_M} {unit}, of either sign", quantity(LEAST, unit));
        // The message quotes the number as written, the range is checked in SI.
        self.within(key, value, |_| (LEAST..=LARGEST_M).contains(&in_si.abs()), &range)?;
        Ok(in_si)
    }

    fn within(
        &self,
        key: &str,
        value: f64,
        is_sound: impl Fn(f64) -> bool,
        range: &str,
    ) -> Result<(), Diagnostic> {
        if is_sound(value) {
            return Ok(());
        }
        let message = format!("{key} = {value}: expected {range}");
        Err(self.place.key(key).mark(Diagnostic::error(codes::scenario::FAULT_VALUE, message)))
    }

    fn friction(&self, fault: &AddedFrictionFault) -> Result<FaultAction, Diagnostic> {
        let joint = self.joint(&fault.joint)?;
        let angular = [("dry_n_m", fault.dry_n_m), ("viscous_n_m_s_per_rad", fault.viscous_n_m_s_per_rad)];
        let linear = [("dry_n", fault.dry_n), ("viscous_n_s_per_m", fault.viscous_n_s_per_m)];
        let (fitting, others) = if self.is_prismatic(joint) { (linear, angular) } else { (angular, linear) };
        let help = format!("give `{}`, `{}` or both", fitting[0].0, fitting[1].0);
        if let Some((key, _)) = others.into_iter().find(|(_, value)| value.is_some()) {
            let message = format!("`{key}` has the wrong unit for this joint");
            let error =
                Diagnostic::error(congruent_motion::codes::scenario::JOINT_UNIT, message).with_help(help);
            return Err(self.place.key(key).mark(error));
        }
        for (key, value) in fitting {
            let value = value.unwrap_or(0.0);
            let is_sound = |value: f64| (0.0..=MOST_FRICTION).contains(&value);
            self.within(key, value, is_sound, "a number between 0 and 1e9")?;
        }
        let [dry, viscous] = fitting.map(|(_, value)| value.unwrap_or(0.0));
        // A sum of different units only as a test for zero.
        if dry + viscous < LEAST {
            let error =
                Diagnostic::error(codes::scenario::FAULT_VALUE, "no friction is added").with_help(help);
            return Err(self.place.mark(error));
        }
        Ok(FaultAction::AddedFriction { joint, dry, viscous })
    }

    fn payload(&self, fault: &WrongPayloadFault) -> Result<FaultAction, Diagnostic> {
        let RobotDescription { tip, tip_from_tcp, robot, .. } = self.description;
        let is_sound = |mass_kg: f64| mass_kg.is_finite() && mass_kg >= LEAST;
        self.within("mass_kg", fault.mass_kg, is_sound, "a finite number of at least 1e-9")?;
        let masses = robot.links().iter().filter_map(|link| link.inertia.as_ref());
        let robot_kg: f64 = masses.map(|inertia| inertia.mass_kg).sum();
        if fault.mass_kg > HEAVIEST_PART * robot_kg {
            let (mass, limit) = (quantity(fault.mass_kg, "kg"), quantity(HEAVIEST_PART * robot_kg, "kg"));
            let message = format!(
                "mass_kg = {mass} is more than {HEAVIEST_PART} times the mass of the robot: limit <= {limit}"
            );
            let error = Diagnostic::error(codes::scenario::FAULT_VALUE, message);
            return Err(self
                .place
                .key("mass_kg")
                .mark(error.with_help("give a mass that the drives could lift")));
        }
        let com_in_tcp = fault.com_m.unwrap_or_default();
        for value in com_in_tcp {
            let range = format!("three lengths of at most {LARGEST_M} m");
            self.within("com_m", value, |value| value.abs() <= LARGEST_M, &range)?;
        }
        // A load on the root's body loads no joint.
        if robot.body(*tip) == robot.root() {
            let error = Diagnostic::error(
                codes::scenario::FAULT_NO_EFFECT,
                "the fault has no effect: no joint moves the tip link",
            );
            return Err(self.place.mark(error.with_help("choose another `tip` in the robot file")));
        }
        let tip_from_tcp = tip_from_tcp.unwrap_or_else(Isometry3::identity);
        // A point mass: the fault has no key for an inertia.
        let com_in_tip = tip_from_tcp * nalgebra::Point3::from(com_in_tcp);
        let inertia = Inertia {
            mass_kg: fault.mass_kg,
            link_from_inertial: Translation3::from(com_in_tip.coords).into(),
            tensor_kg_m2: Matrix3::zeros(),
        };
        Ok(FaultAction::WrongPayload { load: CarriedBody { link: *tip, inertia } })
    }

    fn tool(&self, fault: &ShiftedToolFault) -> Result<FaultAction, Diagnostic> {
        let ShiftedToolFault { xyz_m, xyz_mm, rpy_deg, rpy_rad, .. } = *fault;
        let pose = PoseSettings { xyz_m, xyz_mm, rpy_rad, rpy_deg, ..PoseSettings::default() };
        let tip_from_shifted = pose.isometry(self.place)?;
        let shift_m = tip_from_shifted.translation.vector.norm();
        // A sum of metres and radians only as a test for zero.
        if shift_m + tip_from_shifted.rotation.angle() < LEAST {
            let error = Diagnostic::error(
                codes::scenario::FAULT_VALUE,
                "fault `shifted_tool` has no effect: its shift is 0",
            );
            let help = "give `xyz_m` or `xyz_mm`, `rpy_deg` or `rpy_rad`, not all 0; a full turn does not change the pose";
            return Err(self.place.mark(error.with_help(help)));
        }
        if shift_m > LARGEST_M {
            let message =
                format!("the tool is shifted by {}, limit <= {LARGEST_M} m", quantity(shift_m, "m"));
            return Err(self.place.mark(Diagnostic::error(codes::scenario::FAULT_VALUE, message)));
        }
        let (robot, tip) = (&self.description.robot, self.description.tip);
        let links = robot.link_indices().filter(|&link| hangs_below(robot, link, tip));
        Ok(FaultAction::ShiftedTool {
            tip: tip.get(),
            tip_from_shifted,
            links: links.map(LinkIndex::get).collect(),
        })
    }

    fn swapped(&self, names: &[String; 2]) -> Result<FaultAction, Diagnostic> {
        let robot = &self.description.robot;
        let place = self.place.key("joints");
        let mut joints = [0; 2];
        for (index, (name, joint)) in names.iter().zip(&mut joints).enumerate() {
            let found = moving_joint(robot, name).map_err(|error| place.item(index).mark(error))?;
            *joint = robot.coordinate(found).expect("a moving joint has a coordinate");
        }
        let message = if joints[0] == joints[1] {
            format!("joint \"{}\" is exchanged with itself", names[0])
        } else if self.is_prismatic(joints[0]) != self.is_prismatic(joints[1]) {
            "a turning joint cannot be exchanged with a sliding joint".to_owned()
        } else {
            return Ok(FaultAction::SwappedJoints { joints });
        };
        Err(place
            .mark(Diagnostic::error(codes::scenario::FAULT_VALUE, message).with_help("choose another joint")))
    }

    /// A fault that cannot have an effect is an error: the run would test nothing.
    fn has_effect(&self, kind: FaultKind, controller: ControllerKind) -> Result<(), Diagnostic> {
        let needs_forces = matches!(
            kind,
            FaultKind::LostTorque
                | FaultKind::ScaledTorque
                | FaultKind::AddedFriction
                | FaultKind::WrongPayload
        );
        let needs_commands = matches!(kind, FaultKind::LostTorque | FaultKind::ScaledTorque);
        let why = match controller {
            ControllerKind::Kinematic if needs_forces => {
                "controller \"kinematic\" places the robot without forces"
            }
            ControllerKind::Passive if needs_commands => "controller \"passive\" commands no efforts",
            _ => return Ok(()),
        };
        let message = format!("{kind} has no effect: {why}");
        let error = Diagnostic::error(codes::scenario::FAULT_NO_EFFECT, message)
            .with_help("choose another controller, for example kind = \"pd\" with stiffness and damping");
        Err(self.place.key("kind").mark(error))
    }
}

/// Whether a link is `tip` or hangs below it.
fn hangs_below(robot: &Robot, mut link: LinkIndex, tip: LinkIndex) -> bool {
    // From the link up: each link has one parent, but `tip` may have many children.
    while link != tip {
        match robot.parent_joint(link) {
            Some(joint) => link = robot.joint(joint).parent,
            None => return false,
        }
    }
    true
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 <= time < 1e8 steps")]
fn nearest_step(time_s: f64, step_s: f64) -> u64 {
    (time_s / step_s).round() as u64
}
