//! Values of `[[inertial]]` entries that are those of the URDF within the digits that both are written with.

use congruent_description::{InertiaRounding, InertialDigits, InertialPoint, Link, RobotDescription};
use congruent_dynamics_agreement::{DynamicsModel, Inertial};
use congruent_kinematics::PoseError;
use congruent_mapping::{inertia_within_digits, is_rounded_value};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use super::declared_body::DeclaredBody;

/// Gives the declared model the values of the URDF that are the same within the digits, and names them. `of_table` is what digits
/// leave open of the frames of the table.
pub(super) fn with_values_of_urdf(
    model: &mut DynamicsModel,
    urdf: &DynamicsModel,
    bodies: &[DeclaredBody],
    description: &RobotDescription,
    of_table: PoseError,
) -> Vec<String> {
    let digits = description.places.inertials.as_ref().map(|places| places.digits()).unwrap_or_default();
    let robot = &description.robot;
    let mut names = Vec::new();
    for (body, digits) in bodies.iter().zip(&digits) {
        let mut found = adopt_terms(model, urdf, body, digits, description);
        names.extend(found.drain(..).map(|(joint, term)| format!("{joint}: {term}")));
        let (Some(own), Some(declared)) = (urdf.inertials[body.link], model.inertials[body.link]) else {
            continue;
        };
        let link = &robot.links()[body.link];
        let own = Link { inertia: Some(own.to_inertia()), ..link.clone() };
        let there = Link {
            inertia: Some(declared.to_inertia()),
            inertia_rounding: rounding(body, digits),
            ..Link::default()
        };
        let of_frame = if body.is_in_table() { of_table } else { PoseError::default() };
        if let Some((inertia, values)) = inertia_within_digits([&own, &there], of_frame, &Vector3::zeros()) {
            model.inertials[body.link] = Some(Inertial::from(&inertia));
            names.extend(values.into_iter().map(|value| format!("{}: {value}", link.name)));
        }
    }
    names
}

/// Damping, dry friction and armature of the joint of a body; returns the names of joint and term.
fn adopt_terms(
    model: &mut DynamicsModel,
    urdf: &DynamicsModel,
    body: &DeclaredBody,
    digits: &InertialDigits,
    description: &RobotDescription,
) -> Vec<(String, &'static str)> {
    let robot = &description.robot;
    let joint = robot.joint(robot.movable_joints()[body.joint]);
    let halves = &joint.value_rounding;
    let (there, own) = (&mut model.resistances[body.joint], &urdf.resistances[body.joint]);
    let terms = [
        ("damping", &mut there.damping, own.damping, digits.damping.max(halves.damping)),
        ("friction", &mut there.friction, own.friction, digits.friction.max(halves.friction)),
        ("armature", &mut there.armature, own.armature, digits.armature.max(halves.armature)),
    ];
    let mut names = Vec::new();
    for (name, declared, value, half) in terms {
        if is_rounded_value(value, *declared, half) {
            *declared = value;
            names.push((joint.name.clone(), name));
        }
    }
    names
}

/// What the digits of an entry leave open, in the frame of the link.
fn rounding(body: &DeclaredBody, digits: &InertialDigits) -> InertiaRounding {
    let InertialDigits { mass_kg, com_m, mut tensor_kg_m2, .. } = *digits;
    let written = body.written();
    if body.about == InertialPoint::Frame {
        // The tensor about the centre of mass follows from that about the frame, mass and centre of mass.
        let (mass, point) = (written.mass_kg, written.com_m.amax());
        tensor_kg_m2.add_scalar_mut(2.0 * mass * point * com_m.amax() + mass_kg * point * point);
    }
    let turn = Rotation3::from_matrix_unchecked(body.link_from_frame.rotation);
    let rounding = InertiaRounding { mass_kg, com_m, tensor_kg_m2 };
    rounding.expressed_in(&UnitQuaternion::from_rotation_matrix(&turn))
}
