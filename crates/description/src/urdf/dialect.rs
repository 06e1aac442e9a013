//! Files that are not URDF: SDF, other robot formats, xacro that has not been expanded.

use congruent_input::Diagnostic;
use roxmltree::{Document, Node};

use super::node::{label, tag};
use crate::codes;

/// xacro runs code, so it is never run here.
const RUN_XACRO: &str =
    "expand it first: `xacro robot.urdf.xacro > robot.urdf` (it is never run for you: xacro executes code)";

/// Part of the namespace that every xacro file declares, whatever its prefix.
const XACRO: &str = "xacro";

/// Names the cause of an XML fault that is typical for a URDF: an undeclared `xacro:` prefix is unexpanded xacro.
pub(super) fn explain(fault: Diagnostic) -> Diagnostic {
    if fault.code == congruent_input::codes::xml::PREFIX && fault.message.contains(XACRO) {
        let message = "unexpanded xacro".to_owned();
        return Diagnostic { code: codes::urdf::XACRO, message, ..fault }.with_help(RUN_XACRO);
    }
    fault
}

/// Refuses documents that are no expanded URDF.
pub(super) fn check(root: Node<'_, '_>) -> Result<(), Diagnostic> {
    let name = root.tag_name().name();
    if name != "robot" {
        let what = match name {
            "sdf" | "gazebo" => "SDF files are not read; ",
            "mujoco" => "this is a MuJoCo model; ",
            "COLLADA" => "this is a COLLADA mesh; ",
            _ => "",
        };
        let message =
            format!("the root element is <{name}>: {what}a URDF begins with <robot>, an MJCF with <mujoco>");
        return Err(Diagnostic::error(codes::urdf::ROOT, message)
            .at(tag(root))
            .with_help("export or convert the robot to URDF or MJCF"));
    }
    unexpanded(root.document()).map_or(Ok(()), Err)
}

/// The first `${...}` or `$(...)`, else the first xacro element.
///
/// Vendor blocks are skipped: Gazebo plugins use `$(find ...)` legitimately.
fn unexpanded(document: &Document<'_>) -> Option<Diagnostic> {
    let refused = |message: String| Diagnostic::error(codes::urdf::XACRO, message).with_help(RUN_XACRO);
    let robot = document.root_element();
    let ours = |node: &Node<'_, '_>| ["link", "joint", "material"].contains(&node.tag_name().name());
    for owner in robot.children().filter(ours) {
        for node in owner.descendants().filter(Node::is_element) {
            let written = node.attributes().find(|a| a.value().contains("${") || a.value().contains("$("));
            if let Some(attribute) = written {
                let (element, key, value) = (node.tag_name().name(), attribute.name(), attribute.value());
                let message = format!("unexpanded xacro: {}: <{element}> {key} = \"{value}\"", label(owner));
                return Some(refused(message).at(attribute.range()));
            }
        }
    }
    let is_xacro = |node: &Node<'_, '_>| node.tag_name().namespace().is_some_and(|uri| uri.contains(XACRO));
    let node = document.descendants().find(is_xacro)?;
    Some(refused(format!("unexpanded xacro: <xacro:{}>", node.tag_name().name())).at(tag(node)))
}
