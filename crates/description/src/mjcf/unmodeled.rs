//! What forces would need and a robot has no place for: each is reported with its value, and left out.

use std::fmt::Display;

use congruent_input::{Diagnostic, Diagnostics, display::quantity};
use congruent_mjcf::{MjJoint, MjJointKind, MjModel};

use super::{placed::placed, tree::RobotParts};
use crate::codes;

/// The gravity with which all forces are computed, m/s^2.
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

/// Reports springs, damping that is not linear, gravity and its compensation, and a medium around the bodies.
pub(super) fn report(model: &MjModel, parts: &RobotParts, diagnostics: &mut Diagnostics) {
    let gravity = &model.gravity_in_world;
    if gravity.value.iter().zip(GRAVITY).any(|(found, usual)| (found - usual).abs() > 0.0) {
        let [x, y, z] = gravity.value.into();
        let message =
            format!("gravity is ({x}, {y}, {z}) m/s^2; forces are computed with (0, 0, -9.81) m/s^2");
        let found = Diagnostic::warning(codes::mjcf::GRAVITY, message);
        diagnostics.push(placed(found, gravity.place.as_ref()));
    }
    let medium = [
        (&model.medium_density_kg_m3, "density", "kg/m^3"),
        (&model.medium_viscosity_pa_s, "viscosity", "Pa s"),
    ];
    for (value, what, unit) in medium.into_iter().filter(|(value, ..)| value.value != 0.0) {
        let message =
            format!("a medium with a {what} of {} is left out of forces", quantity(value.value, unit));
        diagnostics.push(placed(Diagnostic::warning(codes::mjcf::MEDIUM, message), value.place.as_ref()));
    }
    for body in model.bodies.iter().filter(|body| body.gravcomp.value != 0.0) {
        let share = body.gravcomp.value;
        let message = format!(
            "body \"{}\": gravcomp {share} carries a part of its weight, which is left out",
            body.name
        );
        let kind = "bodies have a gravcomp, which is left out: their weight counts in full";
        let found = Diagnostic::warning(codes::mjcf::GRAVITY, message).one_of(kind, &body.name.text);
        diagnostics.push(placed(found, &body.place));
    }
    for (joint, _) in model.joints.iter().zip(&parts.joint_positions).filter(|(_, at)| at.is_some()) {
        of_joint(joint, diagnostics);
    }
}

fn of_joint(joint: &MjJoint, diagnostics: &mut Diagnostics) {
    let stiffness = if joint.kind == MjJointKind::Slide { "N/m" } else { "N m/rad" };
    let mut left_out = |code, what: &str, value: &dyn Display| {
        let message = format!("joint \"{}\": {what} {value} is left out of forces", joint.name);
        let kind = format!("joints have {what} {value}, which is left out of forces");
        let found = Diagnostic::warning(code, message).one_of(kind, &joint.name.text);
        diagnostics.push(placed(found, &joint.place));
    };
    let [linear, square, cube] = joint.stiffness.value;
    if joint.stiffness.value.iter().any(|&value| value != 0.0) {
        let is_linear = square == 0.0 && cube == 0.0;
        let value =
            if is_linear { quantity(linear, stiffness) } else { format!("{linear}, {square}, {cube}") };
        left_out(codes::mjcf::SPRING, "a spring of", &value);
    }
    let [_, square, cube] = joint.damping.value;
    if square != 0.0 || cube != 0.0 {
        left_out(codes::mjcf::DAMPING, "a damping by powers of the speed", &format!("{square}, {cube}"));
    }
}
