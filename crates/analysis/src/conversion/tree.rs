//! Screws as a tree of joints: each joint frame on its axis, at zero parallel to the base.

use congruent_description::{Joint, JointIndex, JointKind, JointParts, Link, LinkIndex, Mimic, Robot};
use congruent_input::Diagnostic;
use congruent_kinematics::Twist;
use nalgebra::{Isometry3, Unit, Vector3};

use super::converted_model::ConvertedModel;
use crate::codes;

/// Components below this are written as 0. Kind: rounding of a dozen products within 2 m.
const NOISE: f64 = 1e-15;

/// The model's chain as a robot of its own: the base link, one link for each joint, the tip.
pub(super) fn tree(model: &ConvertedModel<'_>) -> Result<Robot, Diagnostic> {
    let source = &model.description.robot;
    let screws = model.screws();
    let (base, tip) = (name(source, model.description.base), name(source, model.description.tip));
    let (mut links, mut parts) = (vec![link(&base)], Vec::new());
    let (mut parent, mut here_in_base) = (base, Vector3::zeros());
    for (&joint, twist) in model.joints.iter().zip(&screws.twists_in_base) {
        let written = source.joint(joint);
        let PlacedJoint { axis, origin_in_base } = placed(written, twist, &here_in_base)?;
        let child = moved_link(written, source, &tip);
        links.push(link(&child));
        parts.push(JointParts {
            joint: Joint {
                parent_from_joint: shift(origin_in_base - here_in_base),
                axis_in_joint: axis,
                mimic: None,
                ..written.clone()
            },
            parent: std::mem::replace(&mut parent, child.clone()),
            child,
            mimic: written.mimic.and_then(|mimic| followed(source, &mimic, &model.joints)),
        });
        here_in_base = origin_in_base;
    }
    let mut last = screws.base_from_tip_at_zero.to_isometry();
    // The tip keeps its own orientation, which no joint frame has.
    last.translation.vector = (last.translation.vector - here_in_base).map(clean);
    links.push(link(&tip));
    parts.push(JointParts::new(&format!("{parent}_to_{tip}"), JointKind::Fixed, &parent, &tip, last));
    Robot::new(source.name(), links, parts)
        .map_err(|error| Diagnostic::error(codes::convert::TREE, error.to_string()))
}

/// A joint whose frame is parallel to the base.
struct PlacedJoint {
    axis: Unit<Vector3<f64>>,
    origin_in_base: Vector3<f64>,
}

fn placed(written: &Joint, twist: &Twist, here_in_base: &Vector3<f64>) -> Result<PlacedJoint, Diagnostic> {
    let is_revolute = twist.angular.norm() > twist.linear.norm() * NOISE;
    if is_revolute != written.kind.is_angular() {
        let message =
            format!("joint \"{}\" is revolute in one model and prismatic in the other", written.name);
        return Err(Diagnostic::error(codes::convert::KIND, message).with_help(
            "a URDF joint needs limits, and an angle limit cannot become a length limit, or the reverse",
        ));
    }
    if !is_revolute {
        let axis = Unit::new_normalize(twist.linear.map(clean));
        return Ok(PlacedJoint { axis, origin_in_base: *here_in_base });
    }
    let axis = Unit::new_normalize(twist.angular.map(clean));
    let on_axis = axis.cross(&twist.linear);
    // The origin slides along the axis to the point nearest to the joint before: links stay short, and the model
    // is the same.
    let nearest = on_axis + axis.into_inner() * (here_in_base - on_axis).dot(&axis);
    Ok(PlacedJoint { axis, origin_in_base: nearest.map(clean) })
}

/// Name of the link that a joint moves; if that is the name of the tip, which has a frame of its own, another.
fn moved_link(joint: &Joint, source: &Robot, tip: &str) -> String {
    let child = name(source, joint.child);
    if child == tip { format!("{}_frame", joint.name) } else { child }
}

/// The joint that a mimic joint follows, if it is part of the chain.
fn followed(source: &Robot, mimic: &Mimic, joints: &[JointIndex]) -> Option<(String, f64, f64)> {
    let master = joints.contains(&mimic.master).then(|| source.joint(mimic.master).name.clone())?;
    Some((master, mimic.multiplier, mimic.offset))
}

fn link(name: &str) -> Link {
    Link { name: name.to_owned(), ..Link::default() }
}

fn name(robot: &Robot, link: LinkIndex) -> String {
    robot.link(link).name.clone()
}

fn clean(component: f64) -> f64 {
    if component.abs() < NOISE { 0.0 } else { component }
}

fn shift(by: Vector3<f64>) -> Isometry3<f64> {
    Isometry3::translation(clean(by.x), clean(by.y), clean(by.z))
}
