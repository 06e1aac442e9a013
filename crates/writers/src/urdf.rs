//! A robot as URDF.

use std::path::Path;

use congruent_description::{Geometry, Inertia, Joint, JointKind, Link, Robot, Shape};
use congruent_input::rpy_fixed_xyz_rad;
use nalgebra::Isometry3;

use crate::{
    mesh_file::file_name,
    xml_text::{Attributes, XmlText},
};

/// Writes all that a robot has as URDF, for a file in `folder` (absolute, without links), to which paths of meshes are relative.
/// A mesh without a file and an ellipsoid are left out: [`robot_text`](crate::robot_text) reports them.
///
/// # Examples
/// ```
/// use std::path::Path;
/// use congruent_description::{Link, Robot, parse_urdf};
/// use congruent_writers::urdf_text;
/// let link = |name: &str| Link { name: name.into(), ..Link::default() };
/// let robot = Robot::new("stand", vec![link("base")], vec![]).unwrap();
/// assert_eq!(parse_urdf(&urdf_text(&robot, Path::new("/"))).unwrap(), robot);
/// ```
pub fn urdf_text(robot: &Robot, folder: &Path) -> String {
    let mut text = XmlText::new();
    let name = Attributes::default().text("name", robot.name());
    // The limits of acceleration and jerk mean nothing before this version.
    let has_rates = robot.joints().iter().any(|joint| joint.kind.is_movable() && has_rates(joint));
    text.begin("robot", if has_rates { name.text("version", "1.2") } else { name });
    for link in robot.links() {
        write_link(&mut text, link, folder);
    }
    for joint in robot.joints() {
        write_joint(&mut text, joint, robot);
    }
    text.finish()
}

fn write_link(text: &mut XmlText, link: &Link, folder: &Path) {
    let name = Attributes::default().text("name", &link.name);
    if link.inertia.is_none() && link.visuals.is_empty() && link.collisions.is_empty() {
        return text.element("link", name);
    }
    text.begin("link", name);
    if let Some(inertia) = &link.inertia {
        write_inertia(text, inertia);
    }
    for visual in &link.visuals {
        write_shape(text, "visual", visual, folder);
    }
    for collision in &link.collisions {
        write_shape(text, "collision", collision, folder);
    }
    text.end();
}

fn write_inertia(text: &mut XmlText, inertia: &Inertia) {
    text.begin("inertial", Attributes::default());
    write_origin(text, &inertia.link_from_inertial);
    text.element("mass", Attributes::default().number("value", inertia.mass_kg));
    let entries = [("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2)];
    let entry = |attributes: Attributes, (key, row, column): (&str, usize, usize)| {
        attributes.number(key, inertia.tensor_kg_m2[(row, column)])
    };
    text.element("inertia", entries.into_iter().fold(Attributes::default(), entry));
    text.end();
}

fn write_shape(text: &mut XmlText, tag: &'static str, shape: &Shape, folder: &Path) {
    let attributes = Attributes::default();
    let (kind, attributes) = match &shape.geometry {
        Geometry::Box { size_m } => ("box", attributes.numbers("size", size_m.iter().copied())),
        Geometry::Cylinder { radius_m, length_m } => {
            ("cylinder", attributes.number("radius", *radius_m).number("length", *length_m))
        }
        Geometry::Sphere { radius_m } => ("sphere", attributes.number("radius", *radius_m)),
        Geometry::Ellipsoid { .. } => return,
        Geometry::Mesh(mesh) => {
            let Some(file) = file_name(mesh, folder) else { return };
            ("mesh", attributes.text("filename", &file).numbers("scale", mesh.scale.iter().copied()))
        }
    };
    text.begin(tag, Attributes::default());
    write_origin(text, &shape.link_from_shape);
    text.begin("geometry", Attributes::default());
    text.element(kind, attributes);
    text.end();
    if let Some(color) = shape.color_rgba.filter(|_| tag == "visual") {
        // Without a name: a colour with one would hold for all materials of that name.
        text.begin("material", Attributes::default().text("name", ""));
        text.element("color", Attributes::default().text("rgba", &color_text(color)));
        text.end();
    }
    text.end();
}

/// A colour in the shortest form that reads back as the same.
pub(crate) fn color_text(color: [f32; 4]) -> String {
    color.map(|channel| channel.to_string()).join(" ")
}

fn write_origin(text: &mut XmlText, pose: &Isometry3<f64>) {
    let xyz = Attributes::default().numbers("xyz", pose.translation.vector.iter().copied());
    text.element("origin", xyz.numbers("rpy", rpy_fixed_xyz_rad(pose)));
}

fn write_joint(text: &mut XmlText, joint: &Joint, robot: &Robot) {
    text.begin("joint", Attributes::default().text("name", &joint.name).text("type", joint.kind.name()));
    text.element("parent", Attributes::default().text("link", &robot.link(joint.parent).name));
    text.element("child", Attributes::default().text("link", &robot.link(joint.child).name));
    write_origin(text, &joint.parent_from_joint);
    if joint.kind.is_movable() {
        write_motion(text, joint, robot);
    }
    text.end();
}

/// Whether a joint has a limit that only version 1.2 of URDF can state.
fn has_rates(joint: &Joint) -> bool {
    let rates = joint.limit.map(|limit| [limit.acceleration, limit.deceleration, limit.jerk]);
    rates.is_some_and(|rates| rates.iter().any(Option::is_some))
}

/// What only a joint has that moves.
fn write_motion(text: &mut XmlText, joint: &Joint, robot: &Robot) {
    text.element("axis", Attributes::default().numbers("xyz", joint.axis_in_joint.iter().copied()));
    let is_stated = |limit: &congruent_description::JointLimit| {
        let is_any = limit.effort.is_some() || limit.velocity.is_some() || has_rates(joint);
        joint.kind != JointKind::Continuous || is_any
    };
    if let Some(limit) = joint.limit.filter(is_stated) {
        let [lower, upper] = joint.position_range().map_or([None; 2], |(low, high)| [Some(low), Some(high)]);
        let range = Attributes::default().optional("lower", lower).optional("upper", upper);
        let limits = range.optional("effort", limit.effort).optional("velocity", limit.velocity);
        let limits = limits.optional("acceleration", limit.acceleration);
        let limits = limits.optional("deceleration", limit.deceleration);
        text.element("limit", limits.optional("jerk", limit.jerk));
    }
    if joint.damping != 0.0 || joint.friction != 0.0 {
        let losses = Attributes::default().number("damping", joint.damping);
        text.element("dynamics", losses.number("friction", joint.friction));
    }
    if let Some(mimic) = joint.mimic {
        let master = Attributes::default().text("joint", &robot.joint(mimic.master).name);
        text.element("mimic", master.number("multiplier", mimic.multiplier).number("offset", mimic.offset));
    }
}
