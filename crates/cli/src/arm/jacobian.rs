//! `congruent jacobian`: the velocity of a link by the velocities of the joints.

use std::fmt::Write;

use congruent::{
    analysis::jacobians::{JacobianBlocks, JacobianKind, JacobianReport, jacobians, jacobians_in_motion},
    description::{Diagnostic, known_names, serde_name},
};

use crate::{
    failure::Failure,
    input::{ArmArguments, ConfigurationArguments, named},
    print::Printer,
};

/// The Jacobian of a link: its velocity per velocity of each joint, linear and angular block by name.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// The link that moves; the model's tip if it is left out.
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
    let robot = &description.robot;
    let link = match &arguments.link {
        None => description.tip,
        Some(name) => robot.find_link(name).ok_or_else(|| {
            let links: Vec<&str> = robot.links().iter().map(|link| link.name.as_str()).collect();
            let message = format!("robot \"{}\" has no link \"{name}\"", robot.name());
            Diagnostic::error("jacobian::link", message).with_help(known_names(name, "links", links))
        })?,
    };
    let kind = arguments.kind;
    let report = if arguments.derivative {
        let states = arguments.configurations.read_states(&mut description, printer)?;
        jacobians_in_motion(&description, link, kind, &states)
    } else {
        let configurations = arguments.configurations.read(&mut description, printer)?;
        jacobians(&description, link, kind, &configurations)
    }
    .map_err(|error| Diagnostic::error("jacobian::configuration", error.to_string()))?;
    printer.result(&report, text)?;
    Ok(0)
}

fn text(report: &JacobianReport) -> String {
    let mut text = format!(
        "{}\n{} Jacobian of {}, columns: {}\n",
        report.chain,
        serde_name(&report.kind),
        report.link,
        report.joints.join(", ")
    );
    for (index, result) in report.results.iter().enumerate() {
        let _ = writeln!(text, "configuration {}", index + 1);
        rows(&mut text, &result.jacobian);
        if let Some(derivative) = &result.derivative {
            let _ = writeln!(text, "  derivative, per s");
            rows(&mut text, derivative);
        }
    }
    text
}

fn rows(text: &mut String, blocks: &JacobianBlocks) {
    for (name, block) in [("linear", &blocks.linear), ("angular", &blocks.angular)] {
        for (row, axis) in block.iter().zip(["x", "y", "z"]) {
            let values: Vec<String> = row.iter().map(|value| format!("{value:12.9}")).collect();
            let _ = writeln!(text, "  {name:7} {axis}  {}", values.join(" "));
        }
    }
}
