//! `congruent fk`: poses of the links.

use std::fmt::Write;

use congruent::{
    analysis::forward::{ForwardReport, Source},
    description::Use,
};

use crate::{
    failure::Failure,
    input::{ArmArguments, ConfigurationArguments, named},
    print::Printer,
    table::{POSE_COLUMNS, Table, pose_cells},
};

/// Poses of all links in the root link's frame, by a chosen source.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// The source of the poses.
    #[arg(long, default_value = "urdf", value_parser = named::<Source>())]
    source: Source,
    #[command(flatten)]
    configurations: ConfigurationArguments,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let needed = if arguments.source == Source::Simulation { Use::Physics } else { Use::Kinematics };
    let mut description = arguments.arm.load_for(needed, printer)?;
    let configurations = arguments.configurations.read(&mut description, printer)?;
    let report = congruent::forward(&description, arguments.source, &configurations)?;
    let root = &description.robot.link(description.robot.root()).name;
    printer.result(&report, |report| text(report, root))?;
    Ok(0)
}

fn text(report: &ForwardReport, root: &str) -> String {
    let mut text = format!("{}\n", report.chain);
    for (index, poses) in report.results.iter().enumerate() {
        let _ = writeln!(text, "configuration {}: poses in the root link {root}", index + 1);
        let mut table = Table::headed(POSE_COLUMNS);
        for (name, pose) in &poses.links {
            table.row([name.clone()].into_iter().chain(pose_cells(pose)));
        }
        table.write(&mut text);
    }
    text
}
