//! Joint positions by name, in the unit that the key names, as positions of a robot's joints.

use std::{collections::BTreeMap, ops::Range};

use congruent_description::{Joint, JointIndex, JointKind, Robot, RobotQ};
use congruent_input::{
    Diagnostic, Findings,
    display::limit_number,
    known_names,
    units::{Unit, WrittenUnit},
};
use congruent_scenario::{FilePlace, JointMotion, JointPathMotion, StartSettings};

use crate::codes;

/// Positions under one key, as written.
type ByName = BTreeMap<String, f64>;

/// The four keys under which positions may be given: angles for revolute joints, lengths for prismatic ones.
#[derive(Debug, Clone, Copy)]
pub struct JointTargets<'a> {
    /// Beginning of the keys, before their units.
    prefix: &'static str,
    /// Of a list of points under each key, the number of one, from 0.
    point: Option<usize>,
    /// In the order of [`WrittenUnit::ALL`].
    written: [&'a ByName; 4],
}

impl<'a> From<&'a StartSettings> for JointTargets<'a> {
    fn from(start: &'a StartSettings) -> Self {
        let StartSettings { joints_deg, joints_rad, joints_m, joints_mm } = start;
        Self { prefix: "joints", point: None, written: [joints_deg, joints_rad, joints_m, joints_mm] }
    }
}

impl<'a> From<&'a JointMotion> for JointTargets<'a> {
    fn from(motion: &'a JointMotion) -> Self {
        let JointMotion { move_joints_deg: deg, move_joints_rad: rad, .. } = motion;
        let JointMotion { move_joints_m: m, move_joints_mm: mm, .. } = motion;
        Self { prefix: "move_joints", point: None, written: [deg, rad, m, mm] }
    }
}

impl<'a> JointTargets<'a> {
    /// One point of a path, from 0; `none` stands for a key that is not given.
    pub(crate) fn of_point(motion: &'a JointPathMotion, point: usize, none: &'a ByName) -> Self {
        let JointPathMotion { path_joints_deg: deg, path_joints_rad: rad, .. } = motion;
        let JointPathMotion { path_joints_m: m, path_joints_mm: mm, .. } = motion;
        let written = [deg, rad, m, mm].map(|points| points.get(point).unwrap_or(none));
        Self { prefix: "path_joints", point: Some(point), written }
    }
}

/// One joint position in SI units, with its place.
#[derive(Debug, Clone)]
pub struct JointTarget {
    pub(crate) joint: JointIndex,
    /// Position of the joint, rad or m.
    pub(crate) value: f64,
    /// The unit that it is written in.
    unit: WrittenUnit,
    /// Byte range of the value in the file, if there is a file.
    pub span: Option<Range<usize>>,
}

impl JointTarget {
    /// The message if the position is beyond the joint's limits; `what` names the position.
    pub fn beyond_limits(&self, robot: &Robot, what: &str) -> Option<String> {
        let joint = robot.joint(self.joint);
        let (lower, upper) = joint.position_range()?;
        (!(lower..=upper).contains(&self.value)).then(|| {
            // In the unit of the file: who has written degrees does not compare radians.
            let (name, unit) = (&joint.name, self.unit.name());
            let [value, lower, upper] =
                [self.value, lower, upper].map(|si| limit_number(si / self.unit.to_si(1.0)));
            format!("joint \"{name}\": {what} {value} {unit} is outside its range [{lower}, {upper}] {unit}")
        })
    }

    /// Writes it into a configuration.
    pub fn put(&self, robot: &Robot, q: &mut RobotQ) {
        q[robot.coordinate(self.joint).expect("resolved joints move")] = self.value;
    }
}

impl JointTargets<'_> {
    /// Resolves names and units.
    ///
    /// # Errors
    /// Every unknown, repeated, fixed or mimicking joint and every value in the wrong kind of unit.
    pub fn resolve(self, robot: &Robot, place: FilePlace<'_>) -> Result<Vec<JointTarget>, Findings> {
        let mut targets: Vec<JointTarget> = Vec::new();
        let mut errors = Vec::new();
        for (unit, written) in WrittenUnit::ALL.into_iter().zip(self.written) {
            let place = place.key(&format!("{}_{}", self.prefix, unit.name()));
            let place = self.point.map_or(place, |point| place.item(point));
            for (name, &value) in written {
                let at_name = |error: Diagnostic| congruent_scenario::mark(error, place.key_span(name));
                match joint_named(robot, name, unit.unit) {
                    // Before the search for a repeated joint, as a value that is not finite is never stored.
                    Ok(_) if !value.is_finite() => {
                        let message = format!("expected a finite number, found {value}");
                        errors.push(
                            place
                                .key(name)
                                .mark(Diagnostic::error(congruent_input::codes::toml::INVALID, message)),
                        );
                    }
                    Ok(joint) if targets.iter().any(|known| known.joint == joint) => {
                        errors.push(at_name(repeated(name)));
                    }
                    Ok(joint) => {
                        let value = unit.to_si(value);
                        targets.push(JointTarget { joint, value, unit, span: place.entry_span(name) });
                    }
                    Err(error) => errors.push(at_name(error)),
                }
            }
        }
        if errors.is_empty() { Ok(targets) } else { Err(errors.into()) }
    }
}

fn repeated(name: &str) -> Diagnostic {
    Diagnostic::error(codes::scenario::JOINT_TWICE, format!("joint \"{name}\" is given twice"))
}

fn joint_named(robot: &Robot, name: &str, unit: Unit) -> Result<JointIndex, Diagnostic> {
    let index = moving_joint(robot, name)?;
    let joint = robot.joint(index);
    if joint.kind.is_angular() != (unit == Unit::Angle) {
        return Err(wrong_unit(joint));
    }
    Ok(index)
}

/// The joint of this name if it moves and follows no other.
///
/// # Errors
/// The robot has no such joint; the finding lists the known ones, nearest first.
pub fn moving_joint(robot: &Robot, name: &str) -> Result<JointIndex, Diagnostic> {
    let Some(index) = robot.find_joint(name).filter(|&joint| robot.coordinate(joint).is_some()) else {
        let message = format!("robot \"{}\" has no moving joint \"{name}\"", robot.name());
        return Err(Diagnostic::error(codes::scenario::UNKNOWN_JOINT, message).with_help(known_names(
            name,
            "joints",
            robot.movable_joint_names(),
        )));
    };
    let joint = robot.joint(index);
    if let Some(mimic) = joint.mimic {
        let message = format!("joint \"{name}\" mimics \"{}\"", robot.joint(mimic.master).name);
        return Err(Diagnostic::error(codes::scenario::MIMIC_JOINT, message)
            .with_help("give the position of the joint that it mimics"));
    }
    Ok(index)
}

fn wrong_unit(joint: &Joint) -> Diagnostic {
    let (kind, keys) = match joint.kind {
        JointKind::Prismatic => ("prismatic", "`_m` or `_mm`"),
        _ => ("revolute", "`_deg` or `_rad`"),
    };
    Diagnostic::error(codes::scenario::JOINT_UNIT, format!("joint \"{}\" is {kind}", joint.name))
        .with_help(format!("give its position under a key that ends in {keys}"))
}
