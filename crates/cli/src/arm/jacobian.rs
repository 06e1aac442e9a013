//! `congruent jacobian`: the velocity of a link by the velocities of the joints.

use congruent::{
    analysis::jacobians::{
        JacobianFrame, JacobianKind, JacobianReport, JacobianStream, jacobians, jacobians_in_motion,
    },
    description::RobotDescription,
    text::jacobian_text_parts,
};

use crate::{
    configurations::ConfigurationArguments,
    failure::Failure,
    input::{FollowerArgument, SetArmArguments, named},
    terminal::print::{Printer, text_options},
};

/// The Jacobian of a link: its velocity per velocity of each joint, linear and angular block by name.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: SetArmArguments,
    /// The link that moves, or `tcp` for the declared tool centre point (`declared_tcp` if a link is called `tcp`); the model's tip if it is left out.
    #[arg(long, value_name = "NAME")]
    link: Option<String>,
    /// In which frame and at which point the velocity is taken.
    #[arg(long, default_value = "geometric", value_parser = named::<JacobianKind>())]
    kind: JacobianKind,
    #[command(flatten)]
    configurations: ConfigurationArguments,
    #[command(flatten)]
    followers: FollowerArgument,
    /// Add the time derivative at the velocities "v" of the configurations, in rad/s and m/s.
    #[arg(long)]
    derivative: bool,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.arm.load(printer)?;
    let frame = JacobianFrame::named(&description, arguments.link.as_deref())?;
    let (kind, followers) = (arguments.kind, arguments.followers.followers());
    let options = text_options();
    let print = |report: JacobianReport<JacobianStream<'_>>, description: &RobotDescription, first| {
        let printed =
            printer.parts(&report, |report| jacobian_text_parts(report, description, first, &options));
        report.results.end()?;
        printed
    };
    if arguments.derivative {
        arguments.configurations.answer_states(&mut description, printer, |description, states, first| {
            print(
                jacobians_in_motion(description, frame, kind, followers, states.iter())?,
                description,
                first,
            )
        })?;
    } else {
        arguments.configurations.answer(
            &mut description,
            printer,
            |description, configurations, first| {
                print(
                    jacobians(description, frame, kind, followers, configurations.iter())?,
                    description,
                    first,
                )
            },
        )?;
    }
    Ok(0)
}
