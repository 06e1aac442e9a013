//! A robot file that is a description by itself: its table or its screws make links and joints, without a URDF.

mod chain;
mod places;
mod refused;
mod rounding;

use std::{path::Path, sync::Arc};

use congruent_input::{Diagnostic, Diagnostics, SourceFile, hidden_character, line_column};
use congruent_robot::{DhRowKind, Joint, JointKind, JointLimit, JointParts, Link, PlacedAxis, Robot};
use nalgebra::{Translation3, Vector3};
use toml::Spanned;

use self::chain::{OwnChain, OwnJoint};
pub use self::places::{OwnModelForm, OwnModelPlaces};
pub(crate) use self::refused::{refuse_beside_model, without_bodies};
use crate::{codes, robot_file::WrittenRobot, urdf::MOST_MOVING};

/// The names of base and tip if the file gives none.
const BASE: &str = "base";
pub(crate) const TIP: &str = "tip";

/// The robot that a table or screws describe, with the places of its joints.
pub(crate) struct OwnModel {
    pub(crate) robot: Robot,
    pub(crate) places: Arc<OwnModelPlaces>,
}

/// Whether a robot file is a description by itself.
pub(crate) fn is_own(written: &WrittenRobot) -> bool {
    written.model().is_none() && (written.dh.is_some() || written.poe.is_some())
}

/// Makes the robot of such a file: the base, one link for each joint, the tip. At zero all frames but the tip's are parallel to
/// the base, so that a table of either convention and the screws of one robot give the same links and joints.
pub(crate) fn own_model(
    written: &WrittenRobot,
    robot_file: &Arc<SourceFile>,
    diagnostics: &mut Diagnostics,
) -> Option<OwnModel> {
    refused::refuse_keys(written, diagnostics);
    let (form, chain) = match (&written.dh, &written.poe) {
        (Some(_), Some(poe)) => {
            let message = "the robot file has both a table ([dh]) and screws ([poe])";
            diagnostics.push(Diagnostic::error(codes::robot_file::OWN_MODEL, message).at(poe.get_ref().frame.span()).with_help(
                "keep one of them; to compare the two, put each into a file of its own: congruent check A.toml --against B.toml",
            ));
            return None;
        }
        (Some(dh), None) => (OwnModelForm::Table, OwnChain::of_table(dh, robot_file, diagnostics)?),
        (None, Some(poe)) => (OwnModelForm::Screws, OwnChain::of_screws(poe, &robot_file.text, diagnostics)?),
        (None, None) => return None,
    };
    let rows = chain.joints.iter().map(|joint| (joint.name.get_ref().clone(), joint.name.span()));
    let places = OwnModelPlaces::new(Arc::clone(robot_file), form, rows.collect());
    let are_distinct = names(&chain, &robot_file.text, diagnostics);
    let name = written.name.as_ref().map_or_else(|| stem(&robot_file.path), |name| name.get_ref().clone());
    let robot = tree(&chain, name, written);
    // The faults of names are better said by name; the tree only repeats them.
    let robot = if are_distinct { diagnostics.keep(robot) } else { None };
    Some(OwnModel { robot: robot?, places: Arc::new(places) })
}

/// The name of a file without its ending.
fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "robot".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Checks the names and the number of the joints. Whether a robot can be made of them.
fn names(chain: &OwnChain, text: &str, diagnostics: &mut Diagnostics) -> bool {
    let before = diagnostics.len();
    if chain.joints.len() > MOST_MOVING {
        let message = format!("too many joints: {}, the limit is {MOST_MOVING}", chain.joints.len());
        diagnostics.push(
            Diagnostic::error(codes::robot_file::OWN_MODEL, message)
                .at(chain.joints[MOST_MOVING].name.span()),
        );
        return false;
    }
    for (index, OwnJoint { name, .. }) in chain.joints.iter().enumerate() {
        let refused = |code, message: String| Diagnostic::error(code, message).at(name.span());
        if name.get_ref().is_empty() {
            diagnostics
                .push(refused(codes::robot_file::OWN_MODEL, "the name of a joint is empty".to_owned()));
        }
        if let Some(hidden) = hidden_character(name.get_ref()) {
            let message = format!("the name of joint {} has an invisible character: {hidden}", index + 1);
            diagnostics.push(refused(codes::robot_file::OWN_MODEL, message).with_help("type the name again"));
        }
        let same = |before: &&OwnJoint| before.name.get_ref() == name.get_ref();
        if let Some(first) = chain.joints[..index].iter().find(same) {
            let lines = [&first.name, name].map(|at| line_column(text, at.span().start).0);
            let message =
                format!("two joints are called \"{}\" (lines {} and {})", name.get_ref(), lines[0], lines[1]);
            diagnostics
                .push(refused(codes::robot_file::JOINT_TWICE, message).with_help("each joint has one name"));
        }
    }
    diagnostics.len() == before
}

fn tree(chain: &OwnChain, name: String, written: &WrittenRobot) -> Result<Robot, Diagnostic> {
    let given = |written: &Option<Spanned<String>>, default: &str| {
        written.as_ref().map_or_else(|| default.to_owned(), |name| name.get_ref().clone())
    };
    let (base, tip) = (given(&written.base, BASE), given(&written.tip, TIP));
    let link = |name: &str| Link { name: name.to_owned(), ..Link::default() };
    let (mut links, mut parts) = (vec![link(&base)], Vec::new());
    let (mut parent, mut here_in_base) = (base, Vector3::zeros());
    for joint in &chain.joints {
        let placed = PlacedAxis::on_screw(&joint.angular_in_base, &joint.linear_in_base, &here_in_base);
        let child = format!("{}_link", joint.name.get_ref());
        links.push(link(&child));
        let new = JointParts::new(
            joint.name.get_ref(),
            kind(joint),
            &parent,
            &child,
            placed.shift_from(&here_in_base),
        );
        let limit = joint.range.map(|[lower, upper]| JointLimit { lower, upper, ..JointLimit::default() });
        let rounding = joint.rounding.expressed_in(&Translation3::from(-here_in_base).into());
        parts.push(JointParts {
            joint: Joint { axis_in_joint: placed.axis_in_base, limit, rounding, ..new.joint },
            ..new
        });
        (parent, here_in_base) = (child, placed.origin_in_base);
    }
    let last = PlacedAxis::last_shift(&chain.base_from_tip_at_zero, &here_in_base);
    links.push(link(&tip));
    let mut to_tip = JointParts::new(&format!("{parent}_to_{tip}"), JointKind::Fixed, &parent, &tip, last);
    to_tip.joint.rounding = chain.rounding_of_tip.expressed_in(&Translation3::from(-here_in_base).into());
    parts.push(to_tip);
    Robot::new(name, links, parts).map_err(|error| {
        let at = written.tip.as_ref().or(written.base.as_ref()).map_or(0..0, Spanned::span);
        Diagnostic::error(codes::robot_file::OWN_MODEL, error.to_string()).at(at).with_help(
            "links are called as `base` and `tip` say, and JOINT_link for each joint: choose other names",
        )
    })
}

/// A joint that turns has no limits without a range.
fn kind(joint: &OwnJoint) -> JointKind {
    match (joint.kind, joint.range) {
        (DhRowKind::Revolute, Some(_)) => JointKind::Revolute,
        (DhRowKind::Revolute, None) => JointKind::Continuous,
        (DhRowKind::Prismatic, _) => JointKind::Prismatic,
    }
}
