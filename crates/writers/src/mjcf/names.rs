//! Names that an MJCF cannot keep: those of fixed joints, of links called `world`, and of links that become joints of a body.

use std::collections::BTreeMap;

use congruent_description::{JointKind, Link, Robot};
use congruent_input::{Diagnostic, Diagnostics};

use super::{
    plan::{before_name, bodies, keeps_frame},
    world::WORLD,
};
use crate::{codes, links::Parts};

/// Gives links and joints the names that the reader will find, and reports those that change.
pub(crate) fn fit_names(robot: &Robot, parts: &mut Parts, diagnostics: &mut Diagnostics) {
    let mut renamed = BTreeMap::new();
    let name = |link| robot.link(link).name.clone();
    for body in bodies(robot) {
        for pair in body.joints.windows(2) {
            let between = robot.joint(pair[0].index).child;
            let made = before_name(&name(body.link), &robot.joint(pair[1].index).name);
            if name(between) != made || !keeps_frame(robot, &pair[0]) {
                renamed.insert(name(between), made);
            }
        }
    }
    for Link { name, .. } in robot.links().iter().skip(1).filter(|link| link.name == WORLD) {
        renamed.insert(name.clone(), free_name(robot));
    }
    report(robot, &renamed, diagnostics);
    let change = |text: &mut String| {
        if let Some(made) = renamed.get(text) {
            text.clone_from(made);
        }
    };
    parts.links.iter_mut().for_each(|link| change(&mut link.name));
    for joint in &mut parts.joints {
        change(&mut joint.parent);
        change(&mut joint.child);
    }
    root_mass(&mut parts.links, diagnostics);
}

fn report(robot: &Robot, renamed: &BTreeMap<String, String>, diagnostics: &mut Diagnostics) {
    for (link, made) in renamed {
        let message = format!(
            "link \"{link}\" is called \"{made}\" when the MJCF is read; between joints its axes are those of the body"
        );
        let kind = "links between joints, or called as the world, have another name when the MJCF is read";
        diagnostics.push(Diagnostic::warning(codes::write::NAME, message).one_of(kind, link));
    }
    let fixed = robot.joints().iter().filter(|joint| joint.kind == JointKind::Fixed);
    let is_named = |joint: &&congruent_description::Joint| {
        joint.name != format!("{} (fixed)", robot.link(joint.child).name)
    };
    for joint in fixed.filter(is_named) {
        let message = format!("MJCF has no fixed joints, so the name \"{}\" is not written", joint.name);
        let kind = "names of fixed joints are not written, which MJCF does not have";
        diagnostics.push(Diagnostic::warning(codes::write::NAME, message).one_of(kind, &joint.name));
    }
}

/// A name for a link that is called as the world.
fn free_name(robot: &Robot) -> String {
    let numbered = (2..).map(|number| format!("{WORLD}_link_{number}"));
    let mut names = std::iter::once(format!("{WORLD}_link")).chain(numbered);
    names.find(|name| robot.find_link(name).is_none()).unwrap_or_default()
}

/// The world has no mass.
fn root_mass(links: &mut [Link], diagnostics: &mut Diagnostics) {
    let Some(root) = links.first_mut().filter(|root| root.name == WORLD) else { return };
    if let Some(inertia) = root.inertia.take().filter(|of| of.mass_kg > 0.0) {
        let message = format!(
            "the root link is the world of the MJCF, which has no mass: its {} kg are not written",
            inertia.mass_kg
        );
        diagnostics.push(Diagnostic::warning(codes::write::MASS, message));
    }
}
