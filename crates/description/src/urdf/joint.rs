//! `<joint>`: reads and checks the values of one joint.

use std::f64::consts::TAU;

use congruent_input::{Capability, Code, Diagnostic, Diagnostics, units::LARGEST};
use congruent_robot::{Joint, JointKind, JointLimit, JointParts};
use nalgebra::{Unit, Vector3};
use roxmltree::Node;
use urdf_rs::JointType;

use super::{
    node::{element, label, place, tag},
    pose, value_digits,
};
use crate::codes;

/// How far the length of an axis may be from 1 without a warning. Kind: six digits in the file.
const AXIS_LENGTH: f64 = 1e-6;
/// Limits beyond this many radians are taken for degrees: no cable survives four turns.
const LARGEST_PLAUSIBLE_RAD: f64 = 4.0 * TAU;
/// Limits from here on are no degrees either, but stand for "no limit", such as +-1e16. Unit: rad; kind: choice, 28 turns in degrees.
const UNLIMITED_RAD: f64 = 1e4;
/// Squares of larger positions, and sums of them, overflow. Unit: rad or m; kind: range of numbers.
const LARGEST_LIMIT: f64 = 1e30;

/// Reads one joint and reports what is wrong with it.
struct JointReader<'a, 'f> {
    joint: &'a urdf_rs::Joint,
    node: Node<'a, 'a>,
    diagnostics: &'f mut Diagnostics,
}

/// Reads a joint. Its links are found by name when the tree is built; a value that is wrong is replaced
/// by a valid one, so that the rest can be checked.
pub(super) fn read(joint: &urdf_rs::Joint, node: Node<'_, '_>, diagnostics: &mut Diagnostics) -> JointParts {
    let place = pose::OriginPlace { parent: node, owner: node, needed_by: Some(Capability::Kinematics) };
    let parent_from_joint = pose::read(&joint.origin, place, diagnostics);
    let mut reader = JointReader { joint, node, diagnostics };
    let kind = reader.kind();
    if let Some(mimic) = &joint.mimic {
        reader.mimic_numbers([mimic.multiplier.unwrap_or(1.0), mimic.offset.unwrap_or(0.0)]);
    }
    let parts = JointParts::new(&joint.name, kind, &joint.parent.link, &joint.child.link, parent_from_joint);
    let read = Joint {
        axis_in_joint: reader.axis(kind),
        limit: reader.limit(kind),
        damping: reader.loss("damping", joint.dynamics.as_ref().map(|dynamics| dynamics.damping)),
        friction: reader.loss("friction", joint.dynamics.as_ref().map(|dynamics| dynamics.friction)),
        value_rounding: value_digits::of_joint(node, kind),
        ..parts.joint
    };
    let mimic = joint
        .mimic
        .as_ref()
        .filter(|_| kind.is_movable())
        .map(|mimic| (mimic.joint.clone(), mimic.multiplier.unwrap_or(1.0), mimic.offset.unwrap_or(0.0)));
    JointParts { joint: read, mimic, ..parts }
}

impl JointReader<'_, '_> {
    fn report(&mut self, diagnostic: Diagnostic, child: &str) {
        let message = format!("{}: {}", label(self.node), diagnostic.message);
        self.diagnostics.push(Diagnostic { message, ..diagnostic }.at(place(self.node, child)));
    }

    /// Reports a fault of a value that only the simulation needs.
    fn physics(&mut self, code: &'static Code, what: String, child: &str) {
        self.report(Diagnostic::error(code, what).needed_by(Some(Capability::Physics)), child);
    }

    fn error(&mut self, code: &'static Code, what: impl Into<String>, child: &str) {
        self.report(Diagnostic::error(code, what), child);
    }

    fn warn(&mut self, code: &'static Code, what: impl Into<String>, child: &str) {
        self.report(Diagnostic::warning(code, what), child);
    }

    /// Refuses a multiplier or an offset whose products with positions would lose all digits, or overflow.
    fn mimic_numbers(&mut self, numbers: [f64; 2]) {
        for (key, number) in ["multiplier", "offset"].into_iter().zip(numbers) {
            if number.is_finite() && number.abs() > LARGEST {
                let what = format!("mimic: {key} {number:e}, limit <= {LARGEST:e}");
                self.error(codes::urdf::NUMBER, what, "mimic");
            }
        }
    }

    fn kind(&mut self) -> JointKind {
        match self.joint.joint_type {
            JointType::Fixed => JointKind::Fixed,
            JointType::Revolute => JointKind::Revolute,
            JointType::Continuous => JointKind::Continuous,
            JointType::Prismatic => JointKind::Prismatic,
            JointType::Floating | JointType::Planar | JointType::Spherical => {
                let written = self.node.attribute("type").unwrap_or_default();
                let fault = Diagnostic::error(
                    codes::urdf::JOINT_TYPE,
                    format!("type \"{written}\" is not supported"),
                )
                .with_help("use fixed, revolute, continuous or prismatic; replace it by a chain of these")
                .at(tag(self.node));
                self.report(fault, "");
                JointKind::Fixed
            }
        }
    }

    fn axis(&mut self, kind: JointKind) -> Unit<Vector3<f64>> {
        let axis = Vector3::from(self.joint.axis.xyz.0);
        // The squares of entries beyond 1e154 overflow, so the axis is divided by its largest entry first.
        let largest = axis.amax();
        let scaled = axis / largest;
        let length = largest * scaled.norm();
        // Exporters write a zero axis for fixed joints, for which it means nothing.
        if !kind.is_movable() {
            return Vector3::z_axis();
        }
        if largest == 0.0 {
            self.error(codes::urdf::AXIS, "axis is the zero vector", "axis");
            return Vector3::z_axis();
        }
        if !length.is_finite() {
            self.error(
                codes::urdf::AXIS,
                "the numbers of the axis are so large that its length overflows",
                "axis",
            );
            return Vector3::z_axis();
        }
        if (length - 1.0).abs() > AXIS_LENGTH {
            // 1e300 without an exponent has 301 digits.
            let is_short = (1e-6..1e6).contains(&length);
            let length = if is_short { length.to_string() } else { format!("{length:e}") };
            self.warn(codes::urdf::AXIS, format!("axis has length {length} and is normalised to 1"), "axis");
        }
        Unit::new_normalize(scaled)
    }

    fn limit(&mut self, kind: JointKind) -> Option<JointLimit> {
        let written = element(self.node, "limit");
        if written.is_none() && matches!(kind, JointKind::Revolute | JointKind::Prismatic) {
            let or = if kind == JointKind::Revolute { " (or type \"continuous\")" } else { "" };
            self.error(codes::urdf::LIMIT, format!("a {} joint needs <limit>{or}", kind.name()), "limit");
        }
        let limit = &self.joint.limit;
        // Limits of fixed joints mean nothing.
        let written = written.filter(|_| kind.is_movable())?;
        let effort = self.capability("effort", limit.effort, written);
        let velocity = self.capability("velocity", limit.velocity, written);
        // Infinite if the file gives none, or has a version below 1.2; a deceleration that is not given is the acceleration.
        let [acceleration, deceleration, jerk] = [limit.acceleration, limit.deceleration, limit.jerk]
            .map(|most| Some(most).filter(|of| of.is_finite()));
        let (lower, upper) = (limit.lower, limit.upper);
        let stated = JointLimit { lower, upper, velocity, effort, acceleration, deceleration, jerk };
        if kind == JointKind::Continuous {
            // Exporters write zeros for "none".
            if (limit.lower.is_finite() && limit.lower != 0.0)
                || (limit.upper.is_finite() && limit.upper != 0.0)
            {
                self.warn(
                    codes::urdf::LIMIT,
                    "a continuous joint ignores the limits lower and upper",
                    "limit",
                );
            }
            return Some(JointLimit { lower: f64::NEG_INFINITY, upper: f64::INFINITY, ..stated });
        }
        self.range(kind, written);
        Some(stated)
    }

    /// The largest effort or velocity; `None` if the file gives none.
    fn capability(&mut self, key: &str, value: f64, written: Node<'_, '_>) -> Option<f64> {
        if value < 0.0 {
            self.physics(codes::urdf::LIMIT, format!("limit {key} {value} is negative"), "limit");
        }
        // `urdf-rs` has 0 for one that is missing, which is another statement.
        written.has_attribute(key).then_some(value)
    }

    fn range(&mut self, kind: JointKind, written: Node<'_, '_>) {
        let (lower, upper) = (self.joint.limit.lower, self.joint.limit.upper);
        let missing: Vec<&str> =
            ["lower", "upper"].into_iter().filter(|key| !written.has_attribute(*key)).collect();
        // The most serious first: each range gets one message.
        if lower > upper {
            self.error(
                codes::urdf::LIMIT,
                format!("lower limit {lower} is above upper limit {upper}"),
                "limit",
            );
        } else if !missing.is_empty() && lower.is_finite() && upper.is_finite() {
            let what = format!(
                "<limit> has no {}, which counts as 0: the range is [{lower}, {upper}]",
                missing.join(" and ")
            );
            self.warn(codes::urdf::LIMIT, what, "limit");
        } else if upper <= lower {
            self.warn(
                codes::urdf::LIMIT,
                format!("lower and upper limit are both {lower}: the joint cannot move"),
                "limit",
            );
        }
        let furthest = lower.abs().max(upper.abs());
        if furthest.is_finite() && furthest > LARGEST_LIMIT {
            let what = format!("limit {furthest:e} is too large: poses are computed up to {LARGEST_LIMIT:e}");
            self.error(codes::urdf::LIMIT, what, "limit");
        } else if kind.is_angular() && (LARGEST_PLAUSIBLE_RAD.next_up()..UNLIMITED_RAD).contains(&furthest) {
            let what =
                format!("limits [{lower}, {upper}] are more than four turns: degrees instead of radians?");
            self.warn(codes::urdf::DEGREES, what, "limit");
        }
    }

    /// Damping or friction, which dissipate energy and are never negative.
    fn loss(&mut self, key: &str, value: Option<f64>) -> f64 {
        let value = value.unwrap_or(0.0);
        if value < 0.0 {
            self.physics(codes::urdf::DYNAMICS, format!("{key} {value} is negative"), "dynamics");
        }
        value
    }
}

#[cfg(test)]
mod tests {
    use crate::urdf::tests::{INERTIAL, arm, good, joint_stops, read};

    #[test]
    fn limits_of_version_1_2_are_read_in_it_alone() {
        let limit = "<limit lower='-1' upper='2' effort='3' velocity='4' acceleration='5'/>";
        let old = joint_stops(limit, None, "urdf::version", "<limit> acceleration is not read");
        assert_eq!(old.joints()[0].limit.unwrap().acceleration, None);
        let text = arm(limit, INERTIAL).replace("<robot ", "<robot version='1.2' ");
        let read_limit = |text: &str| good(text).joints()[0].limit.unwrap();
        let found = read_limit(&text);
        // A deceleration that is not given is the acceleration.
        assert_eq!((found.acceleration, found.deceleration, found.jerk), (Some(5.0), Some(5.0), None));
        let all =
            read_limit(&text.replace("acceleration='5'", "acceleration='5' deceleration='6' jerk='70'"));
        assert_eq!((all.deceleration, all.jerk), (Some(6.0), Some(70.0)));
        let (infinite, found) = read(&text.replace("'5'", "'inf'"));
        assert_eq!(infinite.unwrap().joints()[0].limit.unwrap().acceleration, None);
        assert!(found.iter().any(|of| of.message.contains("is not a finite number")), "{found:#?}");
        let (_, refused) = read(&text.replace("'5'", "'-5'"));
        assert!(
            refused.iter().any(|of| of.message.contains("acceleration value (-5) is negative")),
            "{refused:#?}"
        );
    }
}
