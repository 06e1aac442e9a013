//! `congruent jacobian`: the velocity of a link by the velocities of the joints.

use std::{fmt::Write, iter::once};

use congruent::{
    analysis::jacobians::{
        JacobianBlocks, JacobianFrame, JacobianKind, JacobianReport, JacobianResult, JacobianStream,
        jacobians, jacobians_in_motion,
    },
    description::RobotDescription,
    input::{display::in_column, serde_name},
};

use crate::{
    failure::Failure,
    input::{ArmArguments, ConfigurationArguments, named},
    terminal::{self, layout::Table, print::Printer},
};

/// The Jacobian of a link: its velocity per velocity of each joint, linear and angular block by name.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// The link that moves, or `tcp` for the declared tool centre point (`declared_tcp` if a link is called `tcp`); the model's tip if it is left out.
    #[arg(long, value_name = "NAME")]
    link: Option<String>,
    /// In which frame and at which point the velocity is taken.
    #[arg(long, default_value = "geometric", value_parser = named::<JacobianKind>())]
    kind: JacobianKind,
    #[command(flatten)]
    configurations: ConfigurationArguments,
    /// Add the time derivative at the velocities "v" of the configurations, in rad/s and m/s.
    #[arg(long)]
    derivative: bool,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.arm.load(printer)?;
    let frame = JacobianFrame::named(&description, arguments.link.as_deref())?;
    let kind = arguments.kind;
    let (states, configurations);
    let report = if arguments.derivative {
        states = arguments.configurations.read_states(&mut description, printer)?;
        jacobians_in_motion(&description, frame, kind, states.iter())?
    } else {
        configurations = arguments.configurations.read(&mut description, printer)?;
        jacobians(&description, frame, kind, configurations.iter())?
    };
    let printed = printer.parts(&report, |report| parts(report, &description));
    report.results.end()?;
    printed?;
    Ok(0)
}

type Report<'a> = JacobianReport<JacobianStream<'a>>;

/// The heading, and each configuration.
fn parts<'a>(report: &'a Report<'_>, description: &RobotDescription) -> impl Iterator<Item = String> + 'a {
    let frame = frame(report, description);
    let mut text = format!("{}\n{} Jacobian of {frame}\n", report.chain, serde_name(&report.kind));
    text += match report.kind {
        JacobianKind::Space => "  in the axes of the root link; linear part at the root's origin",
        JacobianKind::Body => "  in its own axes; linear part at its origin",
        JacobianKind::Geometric => "  in the axes of the root link; linear part at its origin",
    };
    text += "; unit m and rad per rad, for sliding joints per m\n";
    let configuration = |(number, result): (usize, JacobianResult)| {
        let mut text = format!("configuration {number}\n");
        columns(&mut text, &report.joints, &result.jacobian);
        if let Some(derivative) = &result.derivative {
            let _ = writeln!(text, "derivative, per s");
            columns(&mut text, &report.joints, derivative);
        }
        text
    };
    once(text).chain((1..).zip(report.results.iter()).map(configuration))
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
fn columns(text: &mut String, joints: &[String], blocks: &JacobianBlocks) {
    let mut table = Table::headed(["", "linear x", "y", "z", "angular x", "y", "z"]);
    for (at, joint) in joints.iter().enumerate() {
        let values = blocks.linear.iter().chain(&blocks.angular).map(|row| in_column(row[at], ""));
        table.row([joint.clone()].into_iter().chain(values));
    }
    table.write(text, terminal::columns());
}
