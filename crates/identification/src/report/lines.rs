//! The lines that give a robot its identified parameters: in its URDF or MJCF, in a robot file, in a scenario.

use std::fmt::Write;

use congruent_description::{Inertia, JointResistance, RobotDescription};
use congruent_dynamics::SpatialInertia;
use congruent_input::{TextEdit, edited, number::significant};

use super::{
    identification_report::WrittenLines,
    names::{kind, link_name, name},
};
use crate::{
    identified::{IdentifiedBody, IdentifiedJoint, IdentifiedParameters},
    pseudo_inertia::is_body,
    unknowns::JointUnknown,
};

/// The lines of all that was identified.
pub(super) fn lines(
    description: &RobotDescription,
    identified: &IdentifiedParameters,
    payload_frame: &str,
) -> WrittenLines {
    let (edits, not_in_description) = edits(description, identified);
    let places = description.places.parameters();
    WrittenLines {
        of_description: places.map(|places| places.changed_lines(&edits)).unwrap_or_default(),
        file: description.urdf_path.display().to_string(),
        of_robot_file: of_robot_file(description, identified),
        of_scenario: of_scenario(description, identified, payload_frame),
        not_in_description,
    }
}

/// The text of the URDF or MJCF with what was identified.
pub fn edited_text(description: &RobotDescription, identified: &IdentifiedParameters) -> Option<String> {
    let places = description.places.parameters()?;
    let (edits, _) = edits(description, identified);
    (!edits.is_empty()).then(|| edited(&places.source().text, &edits))
}

/// The terms of a joint as identified, those that were not free as the description has them.
fn resistance(description: &RobotDescription, joint: &IdentifiedJoint) -> JointResistance {
    let robot = &description.robot;
    let mut resistance = JointResistance::from(robot.joint(robot.movable_joints()[joint.joint]));
    for (term, value) in &joint.terms {
        // What brakes its followers stays with them.
        let change = rounded(value.value, value.standard_error) - value.nominal;
        // What may be no difference is none.
        if (value.value - value.nominal).abs() < SIGNIFICANT * value.standard_error {
            continue;
        }
        match term {
            JointUnknown::Viscous => resistance.damping = (resistance.damping + change).max(0.0),
            JointUnknown::Coulomb => resistance.friction = (resistance.friction + change).max(0.0),
            JointUnknown::Armature => resistance.armature = (resistance.armature + change).max(0.0),
            JointUnknown::Offset => {}
        }
    }
    resistance
}

/// Standard errors from which on a value differs from that of the description. Kind: choice, as usual.
const SIGNIFICANT: f64 = 2.0;

/// A value to a hundredth of its size: no unit; kind: choice. Digits that the recording does not show are not written.
fn rounded(value: f64, size: f64) -> f64 {
    if !(size > 0.0 && size.is_finite()) {
        return value;
    }
    // A power of ten, so that the written number has few digits.
    let step = 10.0_f64.powi(exponent(size / 100.0));
    // Dividing by its inverse keeps 0.3 what it is.
    if step < 1.0 {
        (value * (1.0 / step)).round() / (1.0 / step).round()
    } else {
        (value / step).round() * step
    }
}

#[expect(clippy::cast_possible_truncation, reason = "exponents of doubles are small")]
fn exponent(size: f64) -> i32 {
    libm::log10(size).floor() as i32
}

/// An inertia to six digits of its largest entries.
fn rounded_inertia(inertia: &Inertia) -> Inertia {
    const DIGITS: f64 = 1e-4;
    let center = inertia.link_from_inertial.translation.vector;
    let mut rounded_inertia = *inertia;
    rounded_inertia.mass_kg = rounded(inertia.mass_kg, inertia.mass_kg * DIGITS);
    rounded_inertia.link_from_inertial.translation.vector =
        center.map(|of| rounded(of, center.amax() * DIGITS));
    let largest = inertia.tensor_kg_m2.amax();
    rounded_inertia.tensor_kg_m2 = inertia.tensor_kg_m2.map(|of| rounded(of, largest * DIGITS));
    rounded_inertia
}

fn has(joint: &IdentifiedJoint, wanted: JointUnknown) -> bool {
    joint.terms.iter().any(|(term, _)| *term == wanted)
}

/// The joints whose terms are written: a term that has the effect of several is no value of one.
fn written_joints(identified: &IdentifiedParameters) -> impl Iterator<Item = &IdentifiedJoint> {
    let is_sum = |joint: &IdentifiedJoint| {
        let mut of = identified.indistinct.iter().filter(|of| of.joint == joint.joint);
        of.any(|of| of.term != JointUnknown::Offset && !of.from.is_empty())
    };
    identified.joints.iter().filter(move |joint| !is_sum(joint))
}

/// The inertia of the link of a body's joint, if all that differs from the description is in that link; `None` if that link cannot exist.
fn link_inertia(description: &RobotDescription, body: &IdentifiedBody) -> Option<Inertia> {
    let robot = &description.robot;
    let link = robot.link(robot.joint(robot.movable_joints()[body.joint]).child);
    let own = link.inertia.as_ref().map_or_else(SpatialInertia::zero, SpatialInertia::from_link);
    let parameters = |inertia: &SpatialInertia| inertia.parameters();
    let (estimated, nominal) = (parameters(&body.inertia), parameters(&body.nominal));
    let mut changed = parameters(&own);
    for (changed, (estimated, nominal)) in changed.iter_mut().zip(estimated.iter().zip(nominal)) {
        *changed += estimated - nominal;
    }
    let changed = is_body(&changed.into()).then(|| SpatialInertia::from_parameters(changed).to_link())??;
    Some(rounded_inertia(&changed))
}

fn edits(description: &RobotDescription, identified: &IdentifiedParameters) -> (Vec<TextEdit>, Vec<String>) {
    let (mut edits, mut missing) = (Vec::new(), Vec::new());
    let Some(places) = description.places.parameters() else { return (edits, missing) };
    let robot = &description.robot;
    let has_armature = description.urdf_path.extension().is_none_or(|extension| extension != "urdf");
    for joint in written_joints(identified) {
        let of = name(robot, joint.joint);
        if has(joint, JointUnknown::Viscous) || has(joint, JointUnknown::Armature) && has_armature {
            match places.set_terms(&of, &resistance(description, joint)) {
                Some(changed) => edits.extend(changed),
                None => missing.push(format!("damping, friction and armature of {of}")),
            }
        }
    }
    if !has_armature && written_joints(identified).any(|joint| has(joint, JointUnknown::Armature)) {
        missing.push("armature: a URDF has no place for it".to_owned());
    }
    for body in &identified.bodies {
        let link = link_name(robot, body.joint);
        let changed =
            link_inertia(description, body).and_then(|inertia| places.set_inertial(&link, &inertia));
        match changed {
            Some(changed) => edits.extend(changed),
            None => missing
                .push(format!("mass and inertia of link {link}: [[inertial]] has those of the whole body")),
        }
    }
    (edits, missing)
}

/// `[[inertial]]` of each joint: its body, and its terms.
fn of_robot_file(description: &RobotDescription, identified: &IdentifiedParameters) -> String {
    let robot = &description.robot;
    let mut text = String::new();
    for joint in &identified.joints {
        let body = identified.bodies.iter().find(|body| body.joint == joint.joint);
        let Some(body) = body.and_then(|body| body.inertia.to_link()) else { continue };
        let body = rounded_inertia(&body);
        let (center, tensor) = (body.link_from_inertial.translation.vector, body.tensor_kg_m2);
        let number = significant;
        let _ = write!(
            text,
            "[[inertial]]\njoint = \"{}\"\nframe = \"link\"\nabout = \"com\"\nmass_kg = {}\ncom_m = [{}, {}, {}]\n\
             inertia_kg_m2 = {{ xx = {}, yy = {}, zz = {}, xy = {}, xz = {}, yz = {} }}\n",
            name(robot, joint.joint),
            number(body.mass_kg),
            number(center.x),
            number(center.y),
            number(center.z),
            number(tensor[(0, 0)]),
            number(tensor[(1, 1)]),
            number(tensor[(2, 2)]),
            number(tensor[(0, 1)]),
            number(tensor[(0, 2)]),
            number(tensor[(1, 2)]),
        );
        let resistance = resistance(description, joint);
        let units = if kind(robot, joint.joint).is_angular() {
            ["kg_m2", "n_m_s_rad", "n_m"]
        } else {
            ["kg", "n_s_m", "n"]
        };
        let values = [resistance.armature, resistance.damping, resistance.friction];
        let is_known = [JointUnknown::Armature, JointUnknown::Viscous, JointUnknown::Coulomb]
            .map(|term| has(joint, term));
        for (at, key) in
            ["armature", "damping", "friction"].into_iter().enumerate().filter(|(at, _)| is_known[*at])
        {
            let _ = writeln!(text, "{key}_{} = {}", units[at], number(values[at]));
        }
        text.push('\n');
    }
    text.trim_end().to_owned()
}

/// `[joints]` and `[[payload]]`.
fn of_scenario(
    description: &RobotDescription,
    identified: &IdentifiedParameters,
    payload_frame: &str,
) -> String {
    let robot = &description.robot;
    let mut text = String::new();
    let keys = [
        ("damping", JointUnknown::Viscous, (|of| of.damping) as fn(&JointResistance) -> f64),
        ("friction", JointUnknown::Coulomb, |of| of.friction),
        ("armature", JointUnknown::Armature, |of| of.armature),
    ];
    for (key, term, value) in keys {
        let values: Vec<String> = written_joints(identified)
            .filter(|joint| has(joint, term))
            .map(|joint| {
                format!(
                    "{} = {}",
                    name(robot, joint.joint),
                    significant(value(&resistance(description, joint)))
                )
            })
            .collect();
        if !values.is_empty() {
            let head = if text.is_empty() { "[joints]\n" } else { "" };
            let _ = writeln!(text, "{head}{key} = {{ {} }}", values.join(", "));
        }
    }
    if let Some((payload, inertia)) =
        identified.payload.as_ref().and_then(|payload| Some((payload, payload.inertia.to_link()?)))
    // A mass that may be none is no payload.
    && payload.inertia.mass_kg > 2.0 * payload.mass_error_kg
    {
        let inertia = rounded_inertia(&inertia);
        let (center, tensor) = (inertia.link_from_inertial.translation.vector, inertia.tensor_kg_m2);
        let separator = if text.is_empty() { "" } else { "\n" };
        let link = if payload_frame == TCP { String::new() } else { format!("link = \"{payload_frame}\"\n") };
        let _ = write!(
            text,
            "{separator}[[payload]]\nname = \"identified\"\n{link}mass_kg = {}\ncom_m = [{}, {}, {}]\n",
            significant(inertia.mass_kg),
            significant(center.x),
            significant(center.y),
            significant(center.z),
        );
        // A tensor that the recording does not show would be a guess.
        if has_known_tensor(payload) {
            let entries = [
                ("xx", (0, 0)),
                ("yy", (1, 1)),
                ("zz", (2, 2)),
                ("xy", (0, 1)),
                ("xz", (0, 2)),
                ("yz", (1, 2)),
            ];
            let entries = entries.map(|(key, at)| format!("{key} = {}", significant(tensor[at])));
            let _ = writeln!(text, "inertia_kg_m2 = {{ {} }}", entries.join(", "));
        }
    }
    text.trim_end().to_owned()
}

/// The name of the frame of a payload at the tool centre point.
pub(super) const TCP: &str = "TCP";

/// Whether the moments of inertia of a body are known to a half of themselves.
fn has_known_tensor(body: &IdentifiedBody) -> bool {
    let Some(inertia) = body.inertia.to_link() else { return false };
    let moments = [(0, 0, 0), (1, 1, 3), (2, 2, 5)];
    moments
        .iter()
        .all(|&(row, column, at)| body.tensor_error_kg_m2[at] <= inertia.tensor_kg_m2[(row, column)] / 2.0)
}
