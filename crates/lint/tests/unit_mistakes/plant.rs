//! The unit mistakes that are planted: where and how.

use std::ops::Range;

use roxmltree::{Document, Node};

/// One class of mistakes: which values are multiplied, and which finding must report them.
pub(crate) struct Class {
    pub(crate) name: &'static str,
    pub(crate) codes: &'static [&'static str],
    factor: f64,
    /// The attributes of an element that are multiplied; empty for none.
    of: fn(&Node<'_, '_>) -> &'static [&'static str],
    /// The smallest value, by magnitude, in which a mistake has an effect.
    least: f64,
}

/// A file with a mistake; `element` is the link or joint, `None` for the whole file.
pub(crate) struct Planted {
    pub(crate) text: String,
    pub(crate) element: Option<String>,
}

const LENGTH: &[&str] = &["urdf::millimetres", "units::origin"];
const BODY: &[&str] = &["units::mass", "units::inertia", "urdf::inertia_size"];
const MOMENTS: &[&str] = &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
const COM: &[&str] = &["urdf::center_of_mass"];
const TRAVEL: &[&str] = &["units::travel"];
const SIZE: &[&str] = &["urdf::millimetres", "units::large_shape", "units::mass", "units::inertia"];

const fn class(
    name: &'static str,
    codes: &'static [&'static str],
    factor: f64,
    of: fn(&Node<'_, '_>) -> &'static [&'static str],
    least: f64,
) -> Class {
    Class { name, codes, factor, of, least }
}

const DEGREES: f64 = 180.0 / std::f64::consts::PI;

/// Origins of less than 10 mm are offsets that any unit could have; turns of less than 6.3 deg stay below a full turn.
pub(crate) const CLASSES: &[Class] = &[
    class("joint origin, mm", LENGTH, 1000.0, joint_xyz, 0.01),
    class("joint origin, cm", LENGTH, 100.0, joint_xyz, 0.01),
    class("joint origin, deg", &["urdf::degrees"], DEGREES, joint_rpy, 0.11),
    class("joint limits, deg", &["urdf::degrees"], DEGREES, turn_range, 0.11),
    class("joint velocity, deg/s", &["units::speed"], DEGREES, turn_speed, 0.1),
    class("joint velocity, rpm", &["units::speed"], 30.0 / std::f64::consts::PI, turn_speed, 0.1),
    class("effort, N mm", &["units::effort"], 1000.0, turn_effort, 0.5),
    class("damping times 1000", &["units::damping"], 1000.0, turn_damping, 0.05),
    class("travel, mm", TRAVEL, 1000.0, slide_range, 0.005),
    class("travel, cm", TRAVEL, 100.0, slide_range, 0.01),
    class("slide velocity, mm/s", &["units::slide_speed"], 1000.0, slide_speed, 0.02),
    class("mass, g", BODY, 1000.0, mass, 0.005),
    class("inertia, kg mm2", BODY, 1e6, moments, 0.0),
    class("inertia, g m2", BODY, 1e3, moments, 0.0),
    class("inertia, 1e-6", BODY, 1e-6, moments, 0.0),
    class("inertia, 1e-3", BODY, 1e-3, moments, 0.0),
    class("centre of mass, mm", COM, 1000.0, com, 0.005),
    class("centre of mass, cm", COM, 100.0, com, 0.02),
    class("mesh scale left out", SIZE, 1000.0, mesh_scale, 0.0),
    class("mesh scale twice", &["units::small_mesh", "units::mass"], 1e-3, mesh_scale, 0.0),
    class("box, mm", SIZE, 1000.0, box_size, 0.0),
    class("box, cm", SIZE, 100.0, box_size, 0.0),
];

fn in_joint(node: &Node<'_, '_>, child: &str, types: &[&str]) -> bool {
    let joint = node.parent_element().filter(|parent| parent.has_tag_name("joint"));
    node.has_tag_name(child)
        && joint
            .is_some_and(|joint| types.is_empty() || types.contains(&joint.attribute("type").unwrap_or("")))
}

fn joint_xyz(node: &Node<'_, '_>) -> &'static [&'static str] {
    if in_joint(node, "origin", &[]) { &["xyz"] } else { &[] }
}

fn joint_rpy(node: &Node<'_, '_>) -> &'static [&'static str] {
    if in_joint(node, "origin", &[]) { &["rpy"] } else { &[] }
}

fn turn_range(node: &Node<'_, '_>) -> &'static [&'static str] {
    if in_joint(node, "limit", &["revolute"]) { &["lower", "upper"] } else { &[] }
}

fn turn_speed(node: &Node<'_, '_>) -> &'static [&'static str] {
    // 1000 and more is a placeholder.
    let speed: f64 = node.attribute("velocity").and_then(|speed| speed.parse().ok()).unwrap_or(0.0);
    if in_joint(node, "limit", &["revolute", "continuous"]) && speed < 1000.0 { &["velocity"] } else { &[] }
}

fn turn_effort(node: &Node<'_, '_>) -> &'static [&'static str] {
    // 1000 and more is a placeholder.
    let effort: f64 = node.attribute("effort").and_then(|effort| effort.parse().ok()).unwrap_or(0.0);
    if in_joint(node, "limit", &["revolute", "continuous"]) && effort < 1000.0 { &["effort"] } else { &[] }
}

fn turn_damping(node: &Node<'_, '_>) -> &'static [&'static str] {
    if in_joint(node, "dynamics", &["revolute", "continuous"]) { &["damping"] } else { &[] }
}

fn slide_range(node: &Node<'_, '_>) -> &'static [&'static str] {
    if in_joint(node, "limit", &["prismatic"]) { &["lower", "upper"] } else { &[] }
}

fn slide_speed(node: &Node<'_, '_>) -> &'static [&'static str] {
    if in_joint(node, "limit", &["prismatic"]) { &["velocity"] } else { &[] }
}

/// Whether a link has more than the mass of a marker, and another tensor than that of examples, 1 kg m^2 about every axis,
/// which means nothing.
fn is_body(inertial: Option<Node<'_, '_>>) -> bool {
    let tensor = inertial.and_then(|inertial| inertial.children().find(|node| node.has_tag_name("inertia")));
    let is = |node: Node<'_, '_>, keys: &[&str], wanted: f64| {
        keys.iter().all(|key| node.attribute(*key).and_then(|value| value.parse().ok()) == Some(wanted))
    };
    let is_example =
        |tensor| is(tensor, &["ixx", "iyy", "izz"], 1.0) && is(tensor, &["ixy", "ixz", "iyz"], 0.0);
    if tensor.is_some_and(is_example) {
        return false;
    }
    let mass = inertial.and_then(|inertial| inertial.children().find(|node| node.has_tag_name("mass")));
    let mass: Option<f64> = mass.and_then(|mass| mass.attribute("value")?.parse().ok());
    mass.is_some_and(|mass| mass >= 0.005)
}

fn in_inertial(node: &Node<'_, '_>, child: &str) -> bool {
    let inertial = node.parent_element().filter(|parent| parent.has_tag_name("inertial"));
    node.has_tag_name(child) && is_body(inertial)
}

fn mass(node: &Node<'_, '_>) -> &'static [&'static str] {
    if in_inertial(node, "mass") { &["value"] } else { &[] }
}

fn moments(node: &Node<'_, '_>) -> &'static [&'static str] {
    if in_inertial(node, "inertia") { MOMENTS } else { &[] }
}

fn com(node: &Node<'_, '_>) -> &'static [&'static str] {
    if in_inertial(node, "origin") { &["xyz"] } else { &[] }
}

fn mesh_scale(node: &Node<'_, '_>) -> &'static [&'static str] {
    if node.has_tag_name("mesh") { &["scale"] } else { &[] }
}

fn box_size(node: &Node<'_, '_>) -> &'static [&'static str] {
    if node.has_tag_name("box") { &["size"] } else { &[] }
}

/// The places of an element's values and what they become; `None` if none of them is large enough.
fn edits(node: Node<'_, '_>, class: &Class) -> Option<Vec<(Range<usize>, String)>> {
    let attributes = (class.of)(&node);
    let mut largest: f64 = 0.0;
    let mut edits = Vec::new();
    for attribute in node.attributes().filter(|found| attributes.contains(&found.name())) {
        let numbers: Option<Vec<f64>> =
            attribute.value().split_whitespace().map(|number| number.parse().ok()).collect();
        let numbers = numbers?;
        largest = numbers.iter().fold(largest, |largest, number| largest.max(number.abs()));
        let scaled: Vec<String> = numbers.iter().map(|number| (number * class.factor).to_string()).collect();
        edits.push((attribute.range_value(), scaled.join(" ")));
    }
    if attributes == ["scale"] && edits.is_empty() {
        let at = node.range().start + "<mesh".len();
        let factor = class.factor;
        return Some(vec![(at..at, format!(" scale=\"{factor} {factor} {factor}\""))]);
    }
    (largest > class.least).then_some(edits)
}

/// The file with a class of mistakes: everywhere, and in up to three elements.
pub(crate) fn planted(class: &Class, text: &str) -> Vec<Planted> {
    let Ok(document) = Document::parse(text) else { return Vec::new() };
    let mut places = Vec::new();
    for node in document.descendants().filter(Node::is_element) {
        let owner = node.ancestors().find(|node| node.has_tag_name("link") || node.has_tag_name("joint"));
        let name = owner.and_then(|owner| owner.attribute("name"));
        if let (Some(name), Some(edits)) = (name, edits(node, class)) {
            places.push((name.to_owned(), edits));
        }
    }
    let Some(last) = places.len().checked_sub(1) else { return Vec::new() };
    let everywhere = places.iter().flat_map(|(_, edits)| edits.clone()).collect();
    let mut planted = vec![Planted { text: edited(text, everywhere), element: None }];
    let mut singles = vec![0, last / 2, last];
    singles.dedup();
    for at in singles {
        let (name, edits) = &places[at];
        planted.push(Planted { text: edited(text, edits.clone()), element: Some(name.clone()) });
    }
    planted
}

fn edited(text: &str, mut edits: Vec<(Range<usize>, String)>) -> String {
    edits.sort_by_key(|(place, _)| place.start);
    let mut edited = text.to_owned();
    for (place, value) in edits.into_iter().rev() {
        edited.replace_range(place, &value);
    }
    edited
}
