//! What a model on its own cannot have, and what a robot file with a URDF cannot have.

use std::ops::Range;

use congruent_input::{Capability, Diagnostic, Diagnostics};
use toml::Spanned;

use super::OwnModelPlaces;
use crate::{codes, robot_file::WrittenRobot};

/// Refuses keys that are about links, shapes and masses of a URDF.
pub(super) fn refuse_keys(written: &WrittenRobot, diagnostics: &mut Diagnostics) {
    let first = |span: Option<Range<usize>>, key: &'static str| span.map(|at| (key, at));
    let keys = [
        first(written.srdf.as_ref().map(Spanned::span), "srdf"),
        first(written.packages.values().next().map(Spanned::span), "packages"),
        first(written.inertia.values().next().map(Spanned::span), "[inertia]"),
        first(written.inertial.first().map(Spanned::span), "[[inertial]]"),
        // It has no place of its own.
        first(written.dynamics.as_ref().map(|_| 0..0), "[dynamics]"),
    ];
    for (key, at) in keys.into_iter().flatten() {
        let message = format!("{key} needs a URDF, and the robot file names none");
        let fault = Diagnostic::error(codes::robot_file::OWN_MODEL, message).at(at);
        diagnostics.push(fault.with_help("add urdf = \"robot.urdf\", or remove this entry"));
    }
}

/// Refuses what only a model on its own can have in a robot file that has a URDF.
pub(crate) fn refuse_beside_model(written: &WrittenRobot, diagnostics: &mut Diagnostics) {
    if let Some(poe) = &written.poe {
        let message = "[poe] takes the place of a URDF, and the robot file has one";
        let fault = Diagnostic::error(codes::robot_file::OWN_MODEL, message).at(poe.get_ref().frame.span());
        diagnostics.push(fault.with_help(
            "leave one of them out; to compare the two, put [poe] into a file of its own: congruent check ROBOT --against SCREWS.toml",
        ));
    }
    let rows = written.dh.iter().flat_map(|dh| &dh.get_ref().row).map(Spanned::get_ref);
    for row in rows {
        let Some((key, range)) = row.range().first() else { continue };
        let message = format!("{key}: the range of joint \"{}\" is that of the URDF", row.joint.get_ref());
        let fault = Diagnostic::error(codes::robot_file::RANGE, message).at(range.span());
        diagnostics.push(fault.with_help("leave it out; only a table without a URDF has ranges in its rows"));
    }
}

/// The finding that a model on its own has no bodies, for a use that needs them.
pub(crate) fn without_bodies(places: &OwnModelPlaces, needed: Capability) -> Option<Diagnostic> {
    let lacking = match needed {
        Capability::Kinematics => return None,
        Capability::Clearance => "no shapes",
        Capability::Physics => "no masses",
    };
    let source = places.source();
    let message = format!(
        "{}: the robot is {} without a URDF, so its links have {lacking}",
        source.path.display(),
        places.form().words()
    );
    Some(
        Diagnostic::error(codes::robot_file::NO_BODIES, message).with_help(
            "name a URDF or an MJCF with shapes and masses in the robot file: urdf = \"robot.urdf\"",
        ),
    )
}
