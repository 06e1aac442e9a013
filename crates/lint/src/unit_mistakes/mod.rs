//! Values of a URDF that are probably in another unit, found by comparing related values: inertia with mass and shapes,
//! joint origins with the shapes of the parent link, speeds with torques and lengths, damping with torques. The bounds are in `thresholds.rs`.
//!
//! Values that are implausible by themselves, such as 1000 m or an angle of 90 rad, are reported when the file is read.

mod bodies;
mod efforts;
mod features;
mod lengths;
mod shapes;
mod speeds;
mod thresholds;

use std::collections::BTreeMap;

use congruent_description::{
    LargeLinks, Robot, RobotDescription,
    node::{element, elements, place, tag},
};
use congruent_input::{Code, Diagnostic, Diagnostics, xml};
use roxmltree::Node;

use self::{features::Sizes, thresholds::FASTEST_TIP_M_S};

/// Code and words of the warnings about one kind of unit mistake.
struct UnitMistake {
    code: &'static Code,
    /// The words of a joined warning, after the number of links or joints.
    words: &'static str,
    /// The child element with the value, empty for the link itself.
    element: &'static str,
}

impl UnitMistake {
    fn warning(&self, name: &str, message: &str) -> Diagnostic {
        Diagnostic::warning(self.code, message).one_of(self.words, name)
    }
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
        || description
            .warnings
            .iter()
            .any(|warning| warning.code == congruent_description::codes::urdf::MILLIMETRES);
    unit_check.travels();
    unit_check.shapes();
    unit_check.bodies();
    unit_check.speeds((!lengths_are_reported).then_some(FASTEST_TIP_M_S));
    unit_check.efforts();
    unit_check.found.in_file(places.source())
}

impl UnitCheck<'_> {
    fn warn_joint(&mut self, kind: &UnitMistake, name: &str, what: &str, help: String) {
        let at = self.joints.get(name).map_or(0..0, |node| place(*node, kind.element));
        let warning = kind.warning(name, &format!("joint \"{name}\": {what}"));
        self.found.push(warning.at(at).with_help(help));
    }

    fn warn_link(&mut self, kind: &UnitMistake, name: &str, what: &str, help: String) {
        let at = self.links.get(name).map_or(0..0, |node| match element(*node, "inertial") {
            Some(inertial) if !kind.element.is_empty() => place(inertial, kind.element),
            _ => tag(*node),
        });
        let warning = kind.warning(name, &format!("link \"{name}\": {what}"));
        self.found.push(warning.at(at).with_help(help));
    }
}

#[cfg(test)]
mod tests;
