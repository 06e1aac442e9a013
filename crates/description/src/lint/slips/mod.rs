//! Values of a URDF that are probably in another unit, judged by what belongs together: inertia against mass and shapes,
//! joints against the shapes that carry them, speeds against torques and lengths. The bounds are in `thresholds.rs`.
//!
//! What a single value gives away, such as 1000 m or an angle of 90 rad, is told when the file is read.

mod bodies;
mod features;
mod lengths;
mod shapes;
mod speeds;
mod thresholds;

use std::{collections::BTreeMap, ops::Range};

use roxmltree::Node;

use self::{features::Sizes, thresholds::FASTEST_TIP_M_S};
use crate::{
    description::RobotDescription,
    diagnostic::{Diagnostic, Diagnostics},
    model::Robot,
    urdf::{
        LargeLinks,
        node::{element, elements, place, tag},
    },
    xml,
};

/// What is told of a kind of slips.
struct Kind {
    code: &'static str,
    /// What several have, after their number.
    words: &'static str,
}

/// The robot and its text, while it is judged.
struct Judge<'a> {
    robot: &'a Robot,
    sizes: Sizes,
    large: LargeLinks,
    links: BTreeMap<&'a str, Node<'a, 'a>>,
    joints: BTreeMap<&'a str, Node<'a, 'a>>,
    found: Diagnostics,
}

/// Values of the URDF that are probably in another unit.
pub fn unit_slips(description: &RobotDescription) -> Vec<Diagnostic> {
    let Some(places) = &description.places.urdf else { return Vec::new() };
    let Ok(document) = xml::parse(&places.source().text) else { return Vec::new() };
    let root = document.root_element();
    let named = |tag_name| {
        let nodes = elements(root, tag_name);
        nodes.filter_map(|node| Some((node.attribute("name")?, node))).collect()
    };
    let robot = &description.robot;
    let mut judge = Judge {
        robot,
        sizes: Sizes::of(robot),
        large: LargeLinks::of(robot),
        links: named("link"),
        joints: named("joint"),
        found: Diagnostics::default(),
    };
    let lengths_are_told =
        judge.origins() || description.warnings.iter().any(|warning| warning.code == crate::urdf::TOO_FAR);
    judge.travels();
    judge.shapes();
    judge.bodies();
    judge.speeds((!lengths_are_told).then_some(FASTEST_TIP_M_S));
    judge.found.in_file(places.source())
}

impl Judge<'_> {
    fn warn_joint(&mut self, kind: &Kind, name: &str, what: &str, (child, help): (&str, String)) {
        let at = self.joints.get(name).map_or(0..0, |node| place(*node, child));
        self.push(kind, name, &format!("joint \"{name}\": {what}"), (at, help));
    }

    fn warn_link(&mut self, kind: &Kind, name: &str, what: &str, (child, help): (&str, String)) {
        let at = self.links.get(name).map_or(0..0, |node| match element(*node, "inertial") {
            Some(inertial) if ["mass", "inertia", "origin"].contains(&child) => place(inertial, child),
            _ => tag(*node),
        });
        self.push(kind, name, &format!("link \"{name}\": {what}"), (at, help));
    }

    fn push(&mut self, kind: &Kind, name: &str, message: &str, (at, help): (Range<usize>, String)) {
        let warning = Diagnostic::warning(kind.code, message).one_of(kind.words, name);
        self.found.push(warning.at(at).with_help(help));
    }
}

#[cfg(test)]
mod tests;
