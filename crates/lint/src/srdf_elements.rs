//! Elements of an SRDF: misspelt ones, elements of a URDF, and virtual joints of an unknown type.

use congruent_description::node::tag;
use congruent_input::{Diagnostic, known_names};
use roxmltree::Node;

use crate::codes;

/// The elements of an SRDF, and of the extensions that are in use.
const ELEMENTS: [&str; 16] = [
    "chain",
    "disable_collisions",
    "disable_default_collisions",
    "enable_collisions",
    "end_effector",
    "group",
    "group_state",
    "joint",
    "joint_property",
    "link",
    "link_sphere_approximation",
    "passive_joint",
    "property",
    "robot",
    "sphere",
    "virtual_joint",
];
/// The types that a virtual joint may have.
const VIRTUAL: [&str; 3] = ["fixed", "planar", "floating"];

/// Findings about elements that readers ignore. Extensions have names of their own, so an unknown name is reported only if it
/// is similar to a known one.
pub(super) fn examine_elements(root: Node<'_, '_>) -> Vec<Diagnostic> {
    if let Some(link) = root.children().find(|node| is_of_urdf(*node)) {
        let error = Diagnostic::error(codes::srdf::ROOT, "this is a URDF, not an SRDF").at(tag(link));
        return vec![error.with_help("an SRDF has groups and pairs of links whose collisions are disabled")];
    }
    let elements = root.descendants().filter(Node::is_element);
    elements.filter_map(|node| misspelt(node).or_else(|| virtual_type(node))).collect()
}

/// Whether an element is a link or a joint with content that only a URDF has.
fn is_of_urdf(node: Node<'_, '_>) -> bool {
    let has = |name: &str| node.children().any(|child| child.has_tag_name(name));
    match node.tag_name().name() {
        "link" => ["inertial", "visual", "collision"].into_iter().any(has),
        "joint" => has("parent") && has("child"),
        _ => false,
    }
}

fn misspelt(node: Node<'_, '_>) -> Option<Diagnostic> {
    let name = node.tag_name().name();
    if ELEMENTS.contains(&name) || node.tag_name().namespace().is_some() {
        return None;
    }
    // Two wrong letters in a short name would match other known names.
    let most = if name.len() < 8 { 1 } else { 2 };
    let near = ELEMENTS.into_iter().find(|known| strsim::osa_distance(name, known) <= most)?;
    let message = format!("<{name}> is unknown, so readers ignore it");
    let warning = Diagnostic::warning(codes::srdf::UNKNOWN_ELEMENT, message).at(tag(node));
    Some(warning.with_help(format!("did you mean <{near}>?")))
}

fn virtual_type(node: Node<'_, '_>) -> Option<Diagnostic> {
    let kind = node.attribute("type").filter(|_| node.has_tag_name("virtual_joint"))?;
    if VIRTUAL.contains(&kind) {
        return None;
    }
    let message = format!("unknown type \"{kind}\" of a virtual joint");
    let warning = Diagnostic::warning(codes::srdf::VIRTUAL_JOINT, message).at(tag(node));
    Some(warning.with_help(known_names(kind, "types", VIRTUAL)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use congruent_input::xml;

    #[test]
    fn elements_are_examined() {
        let examined = |inside: &str| {
            let text = format!("<robot name='r'>{inside}</robot>");
            let document = xml::parse(&text).unwrap();
            let found = examine_elements(document.root_element());
            found.into_iter().map(|found| found.message).collect::<Vec<_>>()
        };
        let good = "<virtual_joint name='v' type='floating' parent_frame='world' child_link='a'/>\
                    <group name='g'><link name='a'/><joint name='j'/></group><my_planner tolerance='1'/>";
        assert_eq!(examined(good), [""; 0]);
        for (text, message) in [
            ("<disable_colisions link1='a' link2='b'/>", "<disable_colisions> is unknown"),
            ("<group_sate name='g' group='h'/>", "<group_sate> is unknown"),
            ("<virtual_joint name='v' type='floting'/>", "unknown type \"floting\""),
            ("<link name='a'><visual/></link>", "this is a URDF"),
            ("<joint name='j'><parent link='a'/><child link='b'/></joint>", "this is a URDF"),
        ] {
            let found = examined(text);
            assert!(found.len() == 1 && found[0].contains(message), "{text}: {found:?}");
        }
    }
}
