//! `[limits]` and the robot's own limits as limits of its coordinates.

use std::collections::BTreeMap;

use congruent_description::{Joint, Robot, RobotDescription};
use congruent_input::{
    Diagnostic, Findings, known_names,
    units::{Unit, WrittenUnit},
};
use congruent_scenario::{FilePlace, LimitSettings};

use crate::{MotionLimits, codes};

/// Time in which a joint reaches its velocity limit if no acceleration limit is given. Kind: engineering.
const TO_VELOCITY_S: f64 = 0.25;
/// Time in which a joint reaches its acceleration limit if no jerk limit is given. Kind: engineering.
const TO_ACCELERATION_S: f64 = 0.1;

/// The name that means every joint of a kind.
const EVERY: &str = "*";

/// The limits that planned moves of this robot keep: those of the scenario, of the robot file and of the URDF.
///
/// # Errors
/// A limit names no moving joint, is given twice, or is not a positive number.
pub fn build(
    settings: &LimitSettings,
    place: FilePlace<'_>,
    description: &RobotDescription,
) -> Result<MotionLimits, Findings> {
    let robot = &description.robot;
    let LimitSettings { over_limit, velocity_deg_s, velocity_rad_s, velocity_m_s, velocity_mm_s, .. } =
        settings;
    let LimitSettings { acceleration_deg_s2, acceleration_rad_s2, acceleration_m_s2, .. } = settings;
    let LimitSettings { acceleration_mm_s2, jerk_deg_s3, jerk_rad_s3, jerk_m_s3, jerk_mm_s3, .. } = settings;
    let mut reader = Reader { robot, place, errors: Vec::new() };
    let mut velocity = reader.given([
        ("velocity_deg_s", velocity_deg_s),
        ("velocity_rad_s", velocity_rad_s),
        ("velocity_m_s", velocity_m_s),
        ("velocity_mm_s", velocity_mm_s),
    ]);
    let mut acceleration = reader.given([
        ("acceleration_deg_s2", acceleration_deg_s2),
        ("acceleration_rad_s2", acceleration_rad_s2),
        ("acceleration_m_s2", acceleration_m_s2),
        ("acceleration_mm_s2", acceleration_mm_s2),
    ]);
    let mut jerk = reader.given([
        ("jerk_deg_s3", jerk_deg_s3),
        ("jerk_rad_s3", jerk_rad_s3),
        ("jerk_m_s3", jerk_m_s3),
        ("jerk_mm_s3", jerk_mm_s3),
    ]);
    if !reader.errors.is_empty() {
        return Err(reader.errors.into());
    }
    // Declared limits are those of the files alone: copied before the defaults below are filled in.
    for (acceleration, of_robot) in acceleration.iter_mut().zip(&description.accelerations) {
        *acceleration = acceleration.min(of_robot.unwrap_or(f64::INFINITY));
    }
    let (declared_acceleration, declared_jerk) = (acceleration.clone(), jerk.clone());
    for (coordinate, &joint) in robot.movable_joints().iter().enumerate() {
        // Zero is what descriptions write for unknown.
        let own = robot.joint(joint).limit.and_then(|limit| limit.velocity).filter(|&limit| limit > 0.0);
        velocity[coordinate] = velocity[coordinate].min(own.unwrap_or(f64::INFINITY));
        // Infinite if the velocity is: such a joint never needs a ramp.
        if acceleration[coordinate].is_infinite() {
            acceleration[coordinate] = velocity[coordinate] / TO_VELOCITY_S;
        }
        if jerk[coordinate].is_infinite() {
            jerk[coordinate] = acceleration[coordinate] / TO_ACCELERATION_S;
        }
    }
    let over_limit = *over_limit;
    Ok(MotionLimits { velocity, acceleration, jerk, declared_acceleration, declared_jerk, over_limit })
}

/// One entry of a key, as it is written.
struct WrittenLimit<'a> {
    /// The key, whose name ends with the unit.
    key: &'static str,
    /// The joint, or [`EVERY`].
    name: &'a str,
    /// In the unit of the key.
    value: f64,
}

struct Reader<'a> {
    robot: &'a Robot,
    place: FilePlace<'a>,
    errors: Vec<Diagnostic>,
}

impl Reader<'_> {
    /// One quantity under its four keys: in degrees, radians, metres and millimetres. Infinity if no limit is given.
    fn given(&mut self, keys: [(&'static str, &BTreeMap<String, f64>); 4]) -> Vec<f64> {
        let mut values = vec![f64::INFINITY; self.robot.dof()];
        // Named joints come after all others, so that they keep their own value.
        for is_every in [true, false] {
            // Anew for both rounds: a joint's own limit beside `*` is an exception to it, not a repetition.
            let mut given_by = vec![None; self.robot.dof()];
            for (key, by_joint) in keys {
                let chosen = by_joint.iter().filter(|(name, _)| (*name == EVERY) == is_every);
                let place = self.place.key(key);
                let set = chosen.filter_map(|(name, &value)| {
                    let limit = WrittenLimit { key, name, value };
                    let found = self.set(&mut values, &limit, &mut given_by);
                    found.map_err(|error| congruent_scenario::mark(error, place.key_span(name))).err()
                });
                let errors: Vec<Diagnostic> = set.collect();
                self.errors.extend(errors);
            }
        }
        values
    }

    fn set(
        &self,
        values: &mut [f64],
        limit: &WrittenLimit<'_>,
        given_by: &mut [Option<&'static str>],
    ) -> Result<(), Diagnostic> {
        let &WrittenLimit { key, name, value } = limit;
        let unit = WrittenUnit::of_key(key);
        if !(value.is_finite() && value > 0.0) {
            let message = format!("limit of \"{name}\": expected a finite number above 0");
            return Err(Diagnostic::error(congruent_scenario::codes::scenario::NUMBER, message));
        }
        for coordinate in self.coordinates(name, unit.unit)? {
            if let Some(first) = given_by[coordinate].replace(key) {
                return Err(self.twice(name, first));
            }
            values[coordinate] = unit.to_si(value);
        }
        Ok(())
    }

    /// The fault of a value that another key has given already; the caller marks its own place.
    fn twice(&self, name: &str, first: &str) -> Diagnostic {
        let place = self.place.key(first);
        let written = place.has(name).then(|| place.key(name).line()).flatten();
        let line = written.map_or_else(String::new, |line| format!(" in line {line}"));
        let message = format!("the limit of \"{name}\" is given twice, first by {first}{line}");
        Diagnostic::error(codes::scenario::LIMIT_TWICE, message).with_help("remove one of the two")
    }

    /// The coordinates that a name means, of joints that turn or of joints that slide.
    fn coordinates(&self, name: &str, unit: Unit) -> Result<Vec<usize>, Diagnostic> {
        let turning = matches!(unit, Unit::Angle);
        let of_kind = |joint: &Joint| joint.kind.is_angular() == turning;
        let joints = || self.robot.movable_joints().iter().map(|&joint| self.robot.joint(joint)).enumerate();
        if name == EVERY {
            return Ok(joints().filter(|(_, joint)| of_kind(joint)).map(|(at, _)| at).collect());
        }
        match joints().find(|(_, joint)| joint.name == name) {
            Some((at, joint)) if of_kind(joint) => Ok(vec![at]),
            Some((_, joint)) => {
                let (kind, keys) =
                    if turning { ("slides", "`_m_` or `_mm_`") } else { ("turns", "`_deg_` or `_rad_`") };
                let message = format!("joint \"{}\" {kind}", joint.name);
                let help = format!("give its limit under a key with {keys}");
                Err(Diagnostic::error(codes::scenario::JOINT_UNIT, message).with_help(help))
            }
            None => {
                let message = format!("robot \"{}\" has no moving joint \"{name}\"", self.robot.name());
                let known = known_names(name, "joints", self.robot.movable_joint_names());
                Err(Diagnostic::error(codes::scenario::UNKNOWN_JOINT, message).with_help(known))
            }
        }
    }
}
