//! Values of a URDF that are probably in another unit, found by comparing related values: inertia with mass and shapes,
//! joint origins with the shapes of the parent link, speeds with torques and lengths. The bounds are in `thresholds.rs`.
//!
//! Values that are implausible by themselves, such as 1000 m or an angle of 90 rad, are reported when the file is read.

mod bodies;
mod features;
mod lengths;
mod shapes;
mod speeds;
mod thresholds;

use std::{collections::BTreeMap, ops::Range};

use congruent_description::{
    LargeLinks, Robot, RobotDescription,
    node::{element, elements, place, tag},
};
use congruent_input::{Diagnostic, Diagnostics, xml};
use roxmltree::Node;

pub use thresholds::INERTIA_UNIT;

use self::{features::Sizes, thresholds::FASTEST_TIP_M_S};

/// Code and words of the warnings about one kind of unit mistake.
struct UnitMistake {
    code: &'static str,
    /// The words of a joined warning, after the number of links or joints.
    words: &'static str,
}

/// The robot with its text, and the warnings found so far.
struct UnitCheck<'a> {
    robot: &'a Robot,
    sizes: Sizes,
    large: LargeLinks,
    links: BTreeMap<&'a str, Node<'a, 'a>>,
    joints: BTreeMap<&'a str, Node<'a, 'a>>,
    found: Diagnostics,
}

/// Values of the URDF that are probably in another unit.
pub fn unit_mistakes(description: &RobotDescription) -> Vec<Diagnostic> {
    let Some(places) = &description.places.urdf else { return Vec::new() };
    let Ok(document) = xml::parse(&places.source().text) else { return Vec::new() };
    let root = document.root_element();
    let named = |tag_name| {
        let nodes = elements(root, tag_name);
        nodes.filter_map(|node| Some((node.attribute("name")?, node))).collect()
    };
    let robot = &description.robot;
    let mut unit_check = UnitCheck {
        robot,
        sizes: Sizes::measure(robot),
        large: LargeLinks::find(robot),
        links: named("link"),
        joints: named("joint"),
        found: Diagnostics::default(),
    };
    // Origins come first: if lengths are in a wrong unit, so is the speed of carried parts, and the mistake would be reported
    // twice.
    let lengths_are_reported = unit_check.origins()
        || description.warnings.iter().any(|warning| warning.code == congruent_description::TOO_FAR);
    unit_check.travels();
    unit_check.shapes();
    unit_check.bodies();
    unit_check.speeds((!lengths_are_reported).then_some(FASTEST_TIP_M_S));
    unit_check.found.in_file(places.source())
}

impl UnitCheck<'_> {
    fn warn_joint(&mut self, kind: &UnitMistake, name: &str, what: &str, (child, help): (&str, String)) {
        let at = self.joints.get(name).map_or(0..0, |node| place(*node, child));
        self.push(kind, name, &format!("joint \"{name}\": {what}"), (at, help));
    }

    fn warn_link(&mut self, kind: &UnitMistake, name: &str, what: &str, (child, help): (&str, String)) {
        let at = self.links.get(name).map_or(0..0, |node| match element(*node, "inertial") {
            Some(inertial) if ["mass", "inertia", "origin"].contains(&child) => place(inertial, child),
            _ => tag(*node),
        });
        self.push(kind, name, &format!("link \"{name}\": {what}"), (at, help));
    }

    fn push(&mut self, kind: &UnitMistake, name: &str, message: &str, (at, help): (Range<usize>, String)) {
        let warning = Diagnostic::warning(kind.code, message).one_of(kind.words, name);
        self.found.push(warning.at(at).with_help(help));
    }
}

#[cfg(test)]
mod tests;
