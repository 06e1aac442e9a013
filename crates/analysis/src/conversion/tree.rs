//! Screws as a tree of joints: each joint frame on its axis, at zero parallel to the base.

use congruent_description::{
    Joint, JointIndex, JointKind, JointParts, Link, LinkIndex, Mimic, PlacedAxis, Robot,
};
use congruent_input::Diagnostic;
use congruent_kinematics::Twist;
use nalgebra::Vector3;

use super::converted_model::ConvertedModel;
use crate::codes;

/// The model's chain as a robot of its own: the base link, one link for each joint, the tip.
pub(super) fn tree(model: &ConvertedModel<'_>) -> Result<Robot, Diagnostic> {
    let source = &model.description.robot;
    let screws = model.screws();
    let (base, tip) = (name(source, model.description.base), name(source, model.description.tip));
    let (mut links, mut parts) = (vec![link(&base)], Vec::new());
    let (mut parent, mut here_in_base) = (base, Vector3::zeros());
    for (&joint, twist) in model.joints.iter().zip(&screws.twists_in_base) {
        let written = source.joint(joint);
        let placed = placed(written, twist, &here_in_base)?;
        let child = moved_link(written, source, &tip);
        links.push(link(&child));
        parts.push(JointParts {
            joint: Joint {
                parent_from_joint: placed.shift_from(&here_in_base),
                axis_in_joint: placed.axis_in_base,
                mimic: None,
                ..written.clone()
            },
            parent: std::mem::replace(&mut parent, child.clone()),
            child,
            mimic: written.mimic.and_then(|mimic| followed(source, &mimic, &model.joints)),
        });
        here_in_base = placed.origin_in_base;
    }
    let last = PlacedAxis::last_shift(&screws.base_from_tip_at_zero.to_isometry(), &here_in_base);
    links.push(link(&tip));
    parts.push(JointParts::new(&format!("{parent}_to_{tip}"), JointKind::Fixed, &parent, &tip, last));
    Robot::new(source.name(), links, parts)
        .map_err(|error| Diagnostic::error(codes::convert::TREE, error.to_string()))
}

fn placed(written: &Joint, twist: &Twist, here_in_base: &Vector3<f64>) -> Result<PlacedAxis, Diagnostic> {
    let placed = PlacedAxis::on_screw(&twist.angular, &twist.linear, here_in_base);
    if placed.is_angular != written.kind.is_angular() {
        let message =
            format!("joint \"{}\" is revolute in one model and prismatic in the other", written.name);
        return Err(Diagnostic::error(codes::convert::KIND, message).with_help(
            "a URDF joint needs limits, and an angle limit cannot become a length limit, or the reverse",
        ));
    }
    if !placed.is_angular && written.limit.is_none() {
        let message = format!("joint \"{}\" slides without a range, and a URDF needs one", written.name);
        return Err(Diagnostic::error(codes::convert::KIND, message)
            .with_help("a row of a robot file without a URDF gives it, for example range_mm = [0, 200]"));
    }
    Ok(placed)
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
