//! Files that are not URDF: broken XML, SDF, other robot formats, xacro that nobody expanded.

use roxmltree::{Document, Error, Node};

use super::{depth::offset, label, tag};
use crate::diagnostic::Diagnostic;

/// xacro runs code, so it is never run here.
const RUN_XACRO: &str =
    "expand it first: `xacro robot.urdf.xacro > robot.urdf` (it is never run for you: xacro executes code)";

/// Part of the namespace that every xacro file declares, whatever its prefix.
const XACRO: &str = "xacro";

/// The tree builder's error as a diagnostic.
pub(super) fn malformed(error: &Error, text: &str) -> Diagnostic {
    let position = error.pos();
    let at = offset(text, position.row, position.col);
    let malformed = |message: String| Diagnostic::error("xml::malformed", message).at(at..at);
    match error {
        Error::DuplicatedAttribute(name, _) => malformed(format!("attribute \"{name}\" is given twice")),
        Error::UnknownNamespace(prefix, _) if prefix == XACRO => {
            Diagnostic::error("urdf::xacro", "unexpanded xacro").at(at..at).with_help(RUN_XACRO)
        }
        Error::NoRootNode => malformed("the file holds no XML element".to_owned()),
        _ => malformed(format!("XML is not well-formed: {error}")),
    }
}

/// Refuses documents that are no expanded URDF.
pub(super) fn check(root: Node<'_, '_>) -> Result<(), Diagnostic> {
    let name = root.tag_name().name();
    if name != "robot" {
        let what = match name {
            "sdf" | "gazebo" => "this is an SDF file; ",
            "mujoco" => "this is a MuJoCo model; ",
            "COLLADA" => "this is a COLLADA mesh; ",
            _ => "",
        };
        let message = format!("the root element is <{name}>: {what}a URDF begins with <robot>");
        return Err(Diagnostic::error("urdf::root", message)
            .at(tag(root))
            .with_help("export or convert the robot to URDF"));
    }
    unexpanded(root.document()).map_or(Ok(()), Err)
}

/// The first `${...}` or `$(...)`, else the first xacro element.
///
/// Vendor blocks are passed over: Gazebo plugins hold `$(find ...)` in their own right.
fn unexpanded(document: &Document<'_>) -> Option<Diagnostic> {
    let refused = |message: String| Diagnostic::error("urdf::xacro", message).with_help(RUN_XACRO);
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
