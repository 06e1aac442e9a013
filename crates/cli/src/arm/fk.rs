//! `congruent fk`: poses of the links.

use congruent::{analysis::forward::Source, input::Capability, text::forward_text_parts};

use crate::{
    configurations::ConfigurationArguments,
    failure::Failure,
    input::{SetArmArguments, named},
    terminal::print::{Printer, text_options},
};

/// Poses of all links in the root link's frame, by a chosen source.
///
/// --from gives the poses in another frame, --to the pose of one frame only: --from A --to B is the pose of B in A. A
/// frame is a link (with --source dh: `dh0` to `dhn`, base or tip), or `tcp`, the declared tool centre point
/// (`declared_tcp` if a link is called `tcp`). --base and --tip choose the chain of the table, not the frame of the
/// poses.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: SetArmArguments,
    /// The source of the poses.
    #[arg(long, default_value = "urdf", value_parser = named::<Source>())]
    source: Source,
    /// The frame that the poses are in; the root link if it is left out.
    #[arg(long, value_name = "FRAME")]
    from: Option<String>,
    /// The frame whose pose is given; all if it is left out.
    #[arg(long, value_name = "FRAME")]
    to: Option<String>,
    #[command(flatten)]
    configurations: ConfigurationArguments,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let needed =
        if arguments.source == Source::Simulation { Capability::Physics } else { Capability::Kinematics };
    let mut description = arguments.arm.load_for(needed, printer)?;
    let options = text_options();
    arguments.configurations.answer(&mut description, printer, |description, configurations, first| {
        let report = congruent::forward(description, arguments.source, configurations.iter())?;
        let report = report.between(arguments.from.as_deref(), arguments.to.as_deref())?;
        let root = &description.robot.link(description.robot.root()).name;
        let printed = printer.parts(&report, |report| forward_text_parts(report, root, first, &options));
        report.results.end()?;
        printed
    })?;
    Ok(0)
}
