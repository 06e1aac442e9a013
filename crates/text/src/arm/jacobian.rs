//! What `congruent jacobian` prints.

use std::fmt::Write;

use congruent_analysis::jacobians::{
    JacobianBlocks, JacobianKind, JacobianReport, JacobianResult, JacobianStream,
};
use congruent_description::RobotDescription;
use congruent_input::{display::in_column, serde_name};

use crate::{TextOptions, layout::Table};

type Report<'a> = JacobianReport<JacobianStream<'a>>;

/// What `congruent jacobian` prints: the frame and the point, then the columns of the Jacobian at each configuration, in parts
/// of whole lines. `first` is the number of the first configuration; the heading is left out if that is not 1.
pub fn jacobian_text_parts<'a>(
    report: &'a JacobianReport<JacobianStream<'_>>,
    description: &RobotDescription,
    first: usize,
    options: &'a TextOptions,
) -> impl Iterator<Item = String> + 'a {
    let frame = frame(report, description);
    let mut text =
        format!("{}: {}\n{} Jacobian of {frame}\n", report.robot, report.chain, serde_name(&report.kind));
    text += match report.kind {
        JacobianKind::Space => {
            "  in the axes of the root link; linear velocity of the point at the root's origin"
        }
        JacobianKind::Body => "  in the axes of this frame; linear velocity of its origin",
        JacobianKind::Geometric => "  in the axes of the root link; linear velocity of the frame's origin",
    };
    text += "; unit m and rad per rad, for sliding joints per m\n";
    let configuration = move |(number, result): (usize, JacobianResult)| {
        let mut text = format!("configuration {number}\n");
        columns(&mut text, &report.joints, &result.jacobian, options);
        if let Some(derivative) = &result.derivative {
            let _ = writeln!(text, "derivative, per s");
            columns(&mut text, &report.joints, derivative, options);
        }
        text
    };
    (first == 1).then_some(text).into_iter().chain((first..).zip(report.results.iter()).map(configuration))
}

/// The frame, and the other one that could be meant.
fn frame(report: &Report<'_>, description: &RobotDescription) -> String {
    let tip = &description.robot.link(description.tip).name;
    match (&report.tcp, description.tip_from_tcp) {
        (Some(tcp), _) => {
            let [x, y, z] = tcp.link_from_tcp.translation_m.map(|value| in_column(value, "m"));
            format!("the TCP at {x}, {y}, {z} mm in {}", tcp.link)
        }
        (None, Some(_)) if report.link == *tip => {
            format!("{tip} (--link {} for the declared TCP)", description.robot.tcp_name())
        }
        _ => report.link.clone(),
    }
}

/// A row for each joint, whose column of the Jacobian it is: joints have long names.
fn columns(text: &mut String, joints: &[String], blocks: &JacobianBlocks, options: &TextOptions) {
    let mut table = Table::headed(["", "linear x", "y", "z", "angular x", "y", "z"]);
    for (at, joint) in joints.iter().enumerate() {
        let values = blocks.linear.iter().chain(&blocks.angular).map(|row| in_column(row[at], ""));
        table.row([joint.clone()].into_iter().chain(values));
    }
    table.write(text, options.columns);
}
