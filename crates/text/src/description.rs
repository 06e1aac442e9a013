//! The summary of a robot as text for people, in 80 columns.

use std::{collections::BTreeMap, fmt::Write, iter::once};

use super::{
    TextOptions,
    layout::{Table, paragraph},
};
use congruent_analysis::description_summary::{
    DescriptionSummary, JointOrders, JointSummary, LinkSummary, ShapeSummary, UseSummary,
};
use congruent_description::JointKind;
use congruent_input::{
    display::{counted, number, position, quantity},
    serde_name,
};

/// What `congruent describe` prints of a robot: what its files say, the tree of links and joints, and for what it can be
/// used.
///
/// # Examples
/// ```
/// use congruent_analysis::description_summary::describe;
/// use congruent_text::description_text;
///
/// # let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/ur5e");
/// let description = congruent_description::load_robot(folder.as_ref())?;
/// assert!(description_text(&describe(&description)).starts_with("  robot ur5e\n"));
/// # Ok::<(), congruent_input::Findings>(())
/// ```
pub fn description_text(summary: &DescriptionSummary) -> String {
    let mut text = String::new();
    head(&mut text, summary);
    tree(&mut text, summary);
    for each in &summary.uses {
        describe_use(&mut text, each);
    }
    text
}

/// What `congruent describe --orders` prints of a robot: a row for each place, a column for each order that differs from those
/// before it, and where they differ.
pub fn joint_orders_text(orders: &JointOrders, options: &TextOptions) -> String {
    let named = [
        ("file", &orders.in_file),
        ("depth first (MuJoCo)", &orders.depth_first),
        ("breadth first (Isaac)", &orders.breadth_first),
        ("breadth first, fixed joints kept", &orders.breadth_first_of_links),
    ];
    // The last one is a special case of the one before.
    let columns =
        if orders.breadth_first == orders.breadth_first_of_links { &named[..3] } else { &named[..] };
    let mut table = Table::default();
    table.row(once("place").chain(columns.iter().map(|of| of.0)).map(str::to_owned));
    for place in 0..orders.in_file.len() {
        table.row(once((place + 1).to_string()).chain(columns.iter().map(|(_, order)| order[place].clone())));
    }
    let mut text = format!("  moving joints of {} in the orders of programs\n", orders.robot);
    table.write(&mut text, options.columns);
    if orders.remarks.is_empty() {
        text += "  all orders are the same\n";
    }
    orders.remarks.iter().for_each(|remark| text += &paragraph(remark, 2, 4));
    text
}

fn head(text: &mut String, summary: &DescriptionSummary) {
    let mut line = |line: String| *text += &paragraph(&line, 2, 4);
    line(format!("robot {}", summary.robot));
    line(format!("file {}", summary.file));
    if summary.urdf != summary.file {
        line(format!("{} {}", summary.format, summary.urdf));
    }
    if let Some(srdf) = &summary.srdf {
        line(format!("SRDF {srdf}: {}", counted(summary.disabled_collisions, "disabled pair")));
    }
    line(summary.chain.to_string());
    let tips = summary.likely_tips.iter();
    let tips: Vec<String> =
        tips.map(|tip| format!("{} ({})", tip.link, counted(tip.joints, "moving joint"))).collect();
    line(format!("likely {}: {}", if tips.len() == 1 { "tip" } else { "tips" }, tips.join(", ")));
    line(match &summary.table {
        Some(table) => {
            format!("table: {} convention, {}", serde_name(&table.convention), counted(table.rows, "row"))
        }
        None => "table: none".to_owned(),
    });
    if let Some(tcp) = &summary.tcp {
        let at = tcp.link_from_tcp.translation_m.map(|value| position(value, "m")).join(", ");
        let turn = tcp.link_from_tcp.rpy_rad().map(|value| position(value, "rad")).join(", ");
        line(format!("TCP in {}: at {at}; roll, pitch, yaw {turn}", tcp.link));
    }
    if summary.has_declared_dynamics {
        line("the robot file declares dynamics ([[inertial]])".to_owned());
    }
    let triangles: usize = summary.meshes.iter().map(|mesh| mesh.triangles).sum();
    let not_found = congruent_input::codes::mesh::NOT_FOUND.name;
    let lacks_meshes = summary.warnings.iter().any(|warning| warning.code == not_found);
    let meshes = match summary.meshes.len() {
        0 if lacks_meshes => "no mesh file is found".to_owned(),
        0 => "no mesh file".to_owned(),
        files => {
            let others = if lacks_meshes { ", others are not found" } else { "" };
            format!("{} with {}{others}", counted(files, "mesh file"), counted(triangles, "triangle"))
        }
    };
    line(format!("{}; {meshes}", summary.parts()));
}

/// Each link below the joint that carries it. The only child of a link is indented as deep as the link; branches are
/// indented deeper.
fn tree(text: &mut String, summary: &DescriptionSummary) {
    /// Deeper branches are not indented further.
    const MOST_LEVELS: usize = 12;
    text.push('\n');
    let mut children: BTreeMap<&str, usize> = BTreeMap::new();
    for joint in &summary.joints {
        *children.entry(&joint.parent).or_default() += 1;
    }
    let carried: BTreeMap<&str, &JointSummary> =
        summary.joints.iter().map(|joint| (joint.child.as_str(), joint)).collect();
    let mut levels: BTreeMap<&str, usize> = BTreeMap::new();
    // Parents come before their children.
    for link in &summary.links {
        let mut level = 0;
        if let Some(joint) = carried.get(link.name.as_str()) {
            let is_branch = children.get(joint.parent.as_str()).is_some_and(|&count| count > 1);
            level = levels.get(joint.parent.as_str()).copied().unwrap_or(0) + usize::from(is_branch);
            let indent = 2 + 2 * level.min(MOST_LEVELS);
            *text += &paragraph(&joint_line(joint), indent + 2, indent + 6);
        }
        levels.insert(&link.name, level);
        let indent = 2 + 2 * level.min(MOST_LEVELS);
        *text += &paragraph(&link_line(link), indent, indent + 4);
    }
    text.push('\n');
}

/// `elbow_joint: revolute about z, -180 deg to 180 deg, at most 180 deg/s and 150 N m`.
fn joint_line(joint: &JointSummary) -> String {
    let mut line = format!("{}: {}", joint.name, joint.kind.name());
    if let Some(axis) = joint.axis_in_joint {
        let word = if joint.kind == JointKind::Prismatic { "along" } else { "about" };
        let _ = write!(line, " {word} {}", axis_words(axis));
    }
    if let (Some(lower), Some(upper)) = (joint.lower, joint.upper) {
        let _ = write!(line, ", {} to {}", position(lower, joint.unit), position(upper, joint.unit));
    }
    let speed = joint.velocity.map(|velocity| quantity(velocity, &format!("{}/s", joint.unit)));
    let force = if joint.kind == JointKind::Prismatic { "N" } else { "N m" };
    let effort = joint.effort.map(|effort| quantity(effort, force));
    let most: Vec<String> = speed.into_iter().chain(effort).collect();
    if !most.is_empty() {
        let _ = write!(line, ", at most {}", most.join(" and "));
    }
    let slower = joint.deceleration.filter(|_| joint.deceleration != joint.acceleration);
    let rates =
        [("acceleration", joint.acceleration, 2), ("deceleration", slower, 2), ("jerk", joint.jerk, 3)];
    for (what, value, power) in rates {
        if let Some(value) = value {
            let _ =
                write!(line, ", {what} at most {}", quantity(value, &format!("{}/s^{power}", joint.unit)));
        }
    }
    let per_speed = if joint.kind == JointKind::Prismatic { "N s/m" } else { "N m s/rad" };
    let inertia = if joint.kind == JointKind::Prismatic { "kg" } else { "kg m^2" };
    let terms = [
        ("damping", joint.damping, per_speed),
        ("friction", joint.friction, force),
        ("armature", joint.armature.unwrap_or(0.0), inertia),
    ];
    for (what, value, unit) in terms {
        if value != 0.0 {
            let _ = write!(line, ", {what} {}", quantity(value, unit));
        }
    }
    if let Some(mimic) = &joint.mimic {
        let _ = write!(line, ", follows {} x {}", mimic.master, number(mimic.multiplier));
        if mimic.offset != 0.0 {
            let _ = write!(line, " + {}", position(mimic.offset, joint.unit));
        }
    }
    line
}

/// `z`, `-x`, or the components.
fn axis_words(axis: [f64; 3]) -> String {
    /// An axis written as 0.9999999 or with rounding beside it is still that axis.
    const ROUNDING: f64 = 1e-6;
    for (at, name) in ["x", "y", "z"].into_iter().enumerate() {
        let others = (0..3).filter(|&other| other != at).all(|other| axis[other].abs() < ROUNDING);
        if others {
            return format!("{}{name}", if axis[at] < 0.0 { "-" } else { "" });
        }
    }
    format!("({})", axis.map(number).join(", "))
}

/// `forearm_link: 2.85 kg, visual mesh, collision mesh`.
fn link_line(link: &LinkSummary) -> String {
    let mut parts: Vec<String> = link.mass_kg.map(|mass_kg| quantity(mass_kg, "kg")).into_iter().collect();
    for (what, shapes) in [("visual", &link.visuals), ("collision", &link.collisions)] {
        if !shapes.is_empty() {
            parts.push(format!("{what} {}", shape_words(shapes)));
        }
    }
    if parts.is_empty() {
        parts.push("frame".to_owned());
    }
    format!("{}: {}", link.name, parts.join(", "))
}

/// `mesh`, `2 boxes and sphere`.
fn shape_words(shapes: &[ShapeSummary]) -> String {
    let mut counts: BTreeMap<ShapeSummary, usize> = BTreeMap::new();
    for &shape in shapes {
        *counts.entry(shape).or_default() += 1;
    }
    let words = counts.into_iter().map(|(shape, count)| match (count, shape) {
        (1, _) => serde_name(&shape).to_owned(),
        (_, ShapeSummary::Box) => format!("{count} boxes"),
        (_, ShapeSummary::Mesh) => format!("{count} meshes"),
        _ => format!("{count} {}s", serde_name(&shape)),
    });
    words.collect::<Vec<_>>().join(" and ")
}

fn describe_use(text: &mut String, of: &UseSummary) {
    if let Some(why) = of.why_nothing() {
        let _ = writeln!(text, "  {}: {why}", serde_name(&of.needed_for));
        return;
    }
    let _ = writeln!(text, "  {}: {}", serde_name(&of.needed_for), of.readiness());
    for finding in &of.stopped_by {
        *text += &paragraph(&finding.to_string(), 4, 6);
    }
    for missing in &of.missing {
        let names = if missing.names.is_empty() {
            String::new()
        } else {
            format!(" ({}): {}", missing.names.len(), missing.names.join(", "))
        };
        *text += &paragraph(&format!("{}{names}", missing.what), 4, 6);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_have_short_names() {
        let names = [[0.0, 0.0, 1.0], [-1.0, 1e-9, 0.0], [0.0, 0.6, 0.8]].map(axis_words);
        assert_eq!(names, ["z", "-x", "(0, 0.6, 0.8)"]);
    }

    #[test]
    fn shapes_are_counted() {
        let shapes = [ShapeSummary::Box, ShapeSummary::Mesh, ShapeSummary::Box, ShapeSummary::Sphere];
        assert_eq!(shape_words(&shapes), "2 boxes and sphere and mesh");
        assert_eq!(shape_words(&[ShapeSummary::Ellipsoid; 2]), "2 ellipsoids");
    }
}
