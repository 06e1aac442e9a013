//! A robot's tree as URDF text: joints, and links by name. Masses and shapes are left out.

use std::fmt::Write;

use congruent_input::{
    number::{number, numbers},
    rpy_fixed_xyz_rad,
};

use crate::model::{Joint, Robot};

/// Writes the joints of a robot as URDF; links have their names and nothing else.
///
/// # Examples
/// ```
/// use congruent_description::{Link, Robot, parse_urdf, urdf_text};
/// let link = |name: &str| Link { name: name.into(), ..Link::default() };
/// let robot = Robot::new("stand", vec![link("base")], vec![]).unwrap();
/// assert_eq!(parse_urdf(&urdf_text(&robot)).unwrap(), robot);
/// ```
pub fn urdf_text(robot: &Robot) -> String {
    let mut text = String::from("<?xml version=\"1.0\"?>\n");
    let _ = writeln!(text, "<robot name=\"{}\">", escaped(robot.name()));
    for link in robot.links() {
        let _ = writeln!(text, "  <link name=\"{}\"/>", escaped(&link.name));
    }
    for joint in robot.joints() {
        write_joint(&mut text, joint, robot);
    }
    text.push_str("</robot>\n");
    text
}

fn write_joint(text: &mut String, joint: &Joint, robot: &Robot) {
    let kind = joint.kind.name();
    let link = |index| escaped(&robot.link(index).name);
    let _ = writeln!(text, "  <joint name=\"{}\" type=\"{kind}\">", escaped(&joint.name));
    let _ = writeln!(text, "    <parent link=\"{}\"/>", link(joint.parent));
    let _ = writeln!(text, "    <child link=\"{}\"/>", link(joint.child));
    let pose = &joint.parent_from_joint;
    let xyz = numbers(pose.translation.vector.iter().copied(), " ");
    let _ = writeln!(text, "    <origin xyz=\"{xyz}\" rpy=\"{}\"/>", numbers(rpy_fixed_xyz_rad(pose), " "));
    if joint.kind.is_movable() {
        let _ = writeln!(text, "    <axis xyz=\"{}\"/>", numbers(joint.axis_in_joint.iter().copied(), " "));
    }
    if let Some(limit) = joint.limit.filter(|_| joint.kind.is_movable()) {
        let range = joint.position_range().map_or(String::new(), |(lower, upper)| {
            format!("lower=\"{}\" upper=\"{}\" ", number(lower), number(upper))
        });
        let capability = |key: &str, value: Option<f64>| {
            value.map_or(String::new(), |value| format!("{key}=\"{}\" ", number(value)))
        };
        let (effort, velocity) = (capability("effort", limit.effort), capability("velocity", limit.velocity));
        let attributes = format!("{range}{effort}{velocity}");
        let _ = writeln!(text, "    <limit {}/>", attributes.trim_end());
    }
    if let Some(mimic) = joint.mimic {
        let master = escaped(&robot.joint(mimic.master).name);
        let (multiplier, offset) = (number(mimic.multiplier), number(mimic.offset));
        let _ =
            writeln!(text, "    <mimic joint=\"{master}\" multiplier=\"{multiplier}\" offset=\"{offset}\"/>");
    }
    text.push_str("  </joint>\n");
}

fn escaped(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
