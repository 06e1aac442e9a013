//! Mass of what moves: links that fixed joints hold together are one body, and a body that moves
//! needs mass. Frames without mass, such as `tool0`, are normal on a body that has some.

use std::{collections::BTreeMap, ops::Range};

use crate::{diagnostic::Diagnostic, diagnostics::Diagnostics, model::Robot};

/// Warns of moving bodies without mass.
pub(super) fn check(robot: &Robot, spans: &BTreeMap<&str, Range<usize>>, diagnostics: &mut Diagnostics) {
    let mut mass_kg = vec![0.0; robot.links().len()];
    // Parents come first, so a link's body is known when the link is reached.
    let mut bodies: Vec<usize> = Vec::with_capacity(mass_kg.len());
    for link in robot.link_indices() {
        let above = robot.parent_joint(link).map(|joint| robot.joint(joint));
        let body = match above {
            Some(joint) if !joint.kind.is_movable() => bodies[joint.parent.get()],
            _ => link.get(),
        };
        bodies.push(body);
        mass_kg[body] += robot.link(link).inertia.map_or(0.0, |inertia| inertia.mass_kg);
    }
    for link in robot.link_indices().skip(1).filter(|link| bodies[link.get()] == link.get()) {
        if mass_kg[link.get()] > 0.0 {
            continue;
        }
        let link = robot.link(link);
        let what = if link.inertia.is_some() { "its mass is zero" } else { "has no <inertial>" };
        let message = format!("link \"{}\" moves but {what}: it cannot be simulated with forces", link.name);
        let at = spans.get(link.name.as_str()).cloned().unwrap_or(0..0);
        diagnostics.push(
            Diagnostic::warning("urdf::massless", message)
                .at(at)
                .with_help("give it an <inertial> with mass and inertia"),
        );
    }
}
