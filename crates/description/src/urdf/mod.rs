//! URDF text to a [`Robot`], or to diagnostics with their places.
//!
//! Four passes, each of which relies on what the one before has checked:
//! 1. `xml`: tokens, then the tree; refuses what would overflow a stack or the memory;
//! 2. `grammar`: the XML with positions against the grammar of URDF, every number token by token; parts that
//!    are wrong and that kinematics can do without are blanked;
//! 3. `urdf-rs`: the structure. It accepts much that is wrong (it drops vector tokens that are not
//!    numbers, it does not distinguish a missing element from its default), which is why pass 2 exists;
//! 4. `joint`, `link`, `shape`: what the values mean, then the tree, then `inertial`: the bodies.
//!
//! Every value is taken from `urdf-rs`; pass 2 reads the same text but only judges it. The one
//! exception is `quat_xyzw`, which `urdf-rs` turns into angles and loses up to 4 mrad near a pitch
//! of a quarter turn: it is taken from the XML.

mod dialect;
mod digits;
mod edits;
mod grammar;
mod inertial;
mod joint;
mod large;
mod link;
pub mod node;
mod parameters;
mod places;
mod pose;
mod shape;
mod value_digits;

pub use digits::JointDigits;
pub use places::UrdfPlaces;

use std::{fmt::Write, ops::Range};

use congruent_input::{Diagnostic, Diagnostics, Findings, known_names, xml};
use congruent_meshes::{FindMesh, FoundMesh, codes::mesh::NO_FOLDER};
use congruent_robot::{Link, Robot, RobotError};
use nalgebra::Vector3;
use roxmltree::Node;

use self::node::{elements, last, place, tag};
use crate::codes;

pub(crate) use inertial::{Repairs, repair_inertias};
pub(crate) use large::without_large_links;

/// Size limit of a URDF, bytes.
pub const URDF_BYTES: u64 = 16 << 20;
/// The largest number of links: far above any robot, far below what would take minutes.
const MOST_LINKS: usize = 10_000;
/// The largest number of joints that move. Matrices have one entry for each pair of them, and a check four configurations for each:
/// 130 MB for these, a few GB for 10,000. A humanoid with two hands has 100.
pub(crate) const MOST_MOVING: usize = 2_000;

/// The inputs beside the text of a URDF: a source of its meshes, and the repairs that the robot file declares.
pub(crate) struct UrdfInputs<'a, 'm> {
    pub(crate) find_mesh: &'a mut FindMesh<'m>,
    pub(crate) repairs: &'a Repairs,
}

/// Reads a robot; `None` if `diagnostics` holds an error.
///
/// A part that kinematics does not need is left out if it cannot be read, with a finding that says which use of the robot
/// this blocks.
pub(crate) fn parse(
    text: &str,
    mut inputs: UrdfInputs<'_, '_>,
    diagnostics: &mut Diagnostics,
) -> Option<Robot> {
    let document = diagnostics.keep(xml::parse(text).map_err(dialect::explain))?;
    let root = document.root_element();
    diagnostics.keep(dialect::check(root))?;
    // Our own grammar first: `urdf-rs` stops at the first fault, without its place.
    let unread = grammar::check(root, diagnostics);
    let links = elements(root, "link").count();
    if links > MOST_LINKS {
        let message = format!("too many links: {links}, the limit is {MOST_LINKS}");
        diagnostics.push(Diagnostic::error(codes::urdf::TOO_MANY_LINKS, message).at(tag(root)));
    }
    let is_moving = |joint: &roxmltree::Node<'_, '_>| joint.attribute("type") != Some("fixed");
    let moving = elements(root, "joint").filter(is_moving).count();
    if moving > MOST_MOVING {
        let message = format!("too many moving joints: {moving}, the limit is {MOST_MOVING}");
        diagnostics.push(Diagnostic::error(codes::urdf::TOO_MANY_LINKS, message).at(tag(root)));
    }
    if diagnostics.has_error() {
        return None;
    }
    if unread.is_empty() {
        return read(root, &mut inputs, diagnostics);
    }
    // Blanked, not cut: all later places remain those of the file.
    let readable = blanked(text, &unread);
    let document = diagnostics.keep(xml::parse(&readable))?;
    read(document.root_element(), &mut inputs, diagnostics)
}

/// The text without some ranges, all other places unchanged.
fn blanked(text: &str, ranges: &[Range<usize>]) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for byte in ranges.iter().cloned().flatten() {
        if bytes[byte] != b'\n' {
            bytes[byte] = b' ';
        }
    }
    // Ranges are whole elements and attributes, so no character is cut.
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Reads what the grammar has accepted.
fn read(root: Node<'_, '_>, inputs: &mut UrdfInputs<'_, '_>, diagnostics: &mut Diagnostics) -> Option<Robot> {
    let urdf = diagnostics.keep(urdf_rs::read_from_string(&for_urdf_rs(root)).map_err(|error| {
        // Faults that the grammar check does not find and urdf-rs does.
        Diagnostic::error(codes::urdf::STRUCTURE, format!("not a valid URDF: {error}")).at(tag(root))
    }))?;
    let mut robot = build(&urdf, root, inputs.find_mesh, diagnostics)?;
    // Masses are judged even if a joint is wrong: whoever corrects the joint would get their errors only then.
    inertial::judge(&mut robot, root, inputs.repairs, diagnostics);
    (!diagnostics.has_error()).then_some(robot)
}

/// Reads a robot from URDF text alone; meshes cannot be found, so it may name none.
///
/// The robot is complete for every use. [`parse_robot`](crate::parse_robot) also accepts a robot with faults that block only
/// some uses.
///
/// # Errors
/// Every diagnostic if at least one is an error or blocks a use.
/// # Examples
/// ```
/// use congruent_description::parse_urdf;
/// assert_eq!(parse_urdf("<robot name='stand'><link name='base'/></robot>").unwrap().links().len(), 1);
/// ```
pub fn parse_urdf(text: &str) -> Result<Robot, Findings> {
    let mut diagnostics = Diagnostics::default();
    let inputs = UrdfInputs { find_mesh: &mut no_mesh, repairs: &Repairs::default() };
    let robot = parse(text, inputs, &mut diagnostics);
    let found = diagnostics.into_vec();
    robot.filter(|_| found.iter().all(|found| found.stops.is_none())).ok_or_else(|| found.into())
}

/// Refuses every mesh: for texts without a folder.
pub(crate) fn no_mesh(uri: &str, _: Vector3<f64>) -> Result<FoundMesh, Diagnostic> {
    let message = format!("mesh \"{uri}\" cannot be opened: the URDF was given as text, without a folder");
    Err(Diagnostic::error(NO_FOLDER, message))
}

/// The document as `urdf-rs` takes it. Every text between elements is left out: it means nothing in a URDF, real
/// files hold some by accident, and `urdf-rs` refuses it in some places. A limit gets the attributes that it
/// must have; `joint` knows which of them are in the file.
fn for_urdf_rs(root: Node<'_, '_>) -> String {
    let text = root.document().input_text();
    let mut written = String::with_capacity(text.len());
    let mut copied = 0;
    for node in root.descendants() {
        // Text between elements is left out: `urdf-rs` refuses some of it, and it has no meaning.
        if node.is_text() {
            written += &text[copied..node.range().start];
            copied = node.range().end;
        } else if node.has_tag_name("limit") {
            let tag_end = tag(node).end;
            written += &text[copied..tag_end];
            copied = tag_end;
            // `urdf-rs` demands both, URDF does not.
            for key in ["effort", "velocity"].into_iter().filter(|key| !node.has_attribute(*key)) {
                let _ = write!(written, " {key}=\"0\"");
            }
        }
    }
    written + &text[copied..]
}

fn build(
    urdf: &urdf_rs::Robot,
    root: Node<'_, '_>,
    find_mesh: &mut FindMesh<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Robot> {
    // urdf-rs lists links and joints in file order, as the XML does.
    let colors = shape::named_colors(urdf);
    let mut reader = shape::ShapeReader { colors, find_mesh, diagnostics };
    let links: Vec<Link> = urdf
        .links
        .iter()
        .zip(elements(root, "link"))
        .map(|(link, node)| link::read(link, node, &mut reader))
        .collect();
    let nodes: Vec<Node<'_, '_>> = elements(root, "joint").collect();
    let read = urdf.joints.iter().zip(&nodes).map(|(joint, node)| joint::read(joint, *node, diagnostics));
    let mut joints: Vec<_> = read.collect();
    digits::add_roundings(&mut joints, &nodes.into_iter().map(Some).collect::<Vec<_>>());
    let name = urdf.name.clone();
    diagnostics.keep(Robot::new(name, links, joints).map_err(|error| tree_fault(&error, root)))
}

fn tree_fault(error: &RobotError, root: Node<'_, '_>) -> Diagnostic {
    // The element inside the joint that names what is not there.
    let part = match error {
        RobotError::UnknownLink { role, .. } => role,
        RobotError::UnknownMimic { .. } | RobotError::MimicLoop { .. } | RobotError::MimicTooLarge { .. } => {
            "mimic"
        }
        _ => "",
    };
    let joint = error.joint().and_then(|name| last(root, "joint", name)).map(|node| place(node, part));
    let link = error.link().and_then(|name| last(root, "link", name)).map(tag);
    let code = match error {
        RobotError::MimicTooLarge { .. } => codes::urdf::NUMBER,
        _ => codes::urdf::TREE,
    };
    let fault = Diagnostic::error(code, error.to_string()).at(joint.or(link).unwrap_or_else(|| tag(root)));
    match error {
        RobotError::UnknownLink { link, known, .. } => {
            fault.with_help(known_names(link, "links", known.iter().map(String::as_str)))
        }
        RobotError::UnknownMimic { target, known, .. } => {
            fault.with_help(known_names(target, "moving joints", known.iter().map(String::as_str)))
        }
        RobotError::DuplicateLink { link } => first_at(fault, root, "link", link),
        RobotError::DuplicateJoint { joint } => first_at(fault, root, "joint", joint),
        RobotError::SeveralRoots { .. } => {
            fault.with_help("join them with a fixed joint, or keep one robot in a file")
        }
        _ => fault,
    }
}

fn first_at(fault: Diagnostic, root: Node<'_, '_>, tag_name: &str, name: &str) -> Diagnostic {
    let first = elements(root, tag_name).find(|node| node.attribute("name") == Some(name));
    let line = first.map(|node| root.document().text_pos_at(node.range().start).row);
    match line {
        Some(line) => fault.with_help(format!("the first one is at line {line}")),
        None => fault,
    }
}

#[cfg(test)]
mod tests;
pub use grammar::{Misspelling, Misspelt, misspellings};
pub use inertial::{LARGEST_GYRATION_M, nearest_possible_tensor};
pub use large::LargeLinks;
