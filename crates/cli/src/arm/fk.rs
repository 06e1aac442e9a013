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
    printer.result(&report, text)?;
    Ok(0)
}

fn text(report: &ForwardReport) -> String {
    let mut text = format!("{}\n", report.chain);
    let width =
        report.results.iter().flat_map(|poses| &poses.links).map(|(name, _)| name.len()).max().unwrap_or(0);
    for (index, poses) in report.results.iter().enumerate() {
        let _ = writeln!(text, "configuration {}: translation in m, quaternion w x y z", index + 1);
        for (name, pose) in &poses.links {
            let [x, y, z] = pose.translation_m;
            let [qw, qx, qy, qz] = pose.quaternion_wxyz;
            let _ = writeln!(
                text,
                "  {name:width$}  {x:13.9} {y:13.9} {z:13.9}   {qw:12.9} {qx:12.9} {qy:12.9} {qz:12.9}"
            );
        }
    }
    text
}
