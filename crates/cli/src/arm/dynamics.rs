//! `congruent dynamics`: torques and accelerations at given states.

use congruent::{
    analysis::dynamics::{DynamicsOptions, DynamicsSource, PointPayload, robot_with_options, stiction},
    configurations::JointStateList,
    description::RobotDescription,
    input::Capability,
    text::joint_dynamics_text_parts,
};

use super::base_parameters::base_parameters;
use crate::{
    configurations::ConfigurationArguments,
    failure::Failure,
    input::{FollowerArgument, SetArmArguments, named},
    quantity::{Dimension, QuantityArgument, three_lengths},
    terminal::print::Printer,
};

/// Torques that hold and move a robot, its mass matrix, and its accelerations under torques.
///
/// A state of --configurations may have velocities "v", accelerations "a" and torques "tau" beside its
/// positions "q"; a value that is not given is zero.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: SetArmArguments,
    /// The source of torques and accelerations.
    #[arg(long, default_value = "model", value_parser = named::<DynamicsSource>())]
    source: DynamicsSource,
    #[command(flatten)]
    configurations: ConfigurationArguments,
    /// Include the damping and the dry friction of the description.
    #[arg(long)]
    friction: bool,
    #[command(flatten)]
    followers: FollowerArgument,
    /// A mass at the tool centre point, 3kg; with X,Y,Z it is there in the frame of the TCP: 3kg,0,0,50mm. Without units
    /// in kg and m.
    #[arg(long, value_name = "MASS[,X,Y,Z]", value_parser = payload, allow_hyphen_values = true)]
    payload: Option<PointPayload>,
    /// Print the base parameters instead: the sums of masses, first moments and inertias that are identifiable from
    /// joint torques, with the parameters grouped in each, and the parameters that change no torque.
    #[arg(long, conflicts_with_all = ["source", "configurations", "at", "friction", "payload"])]
    base_parameters: bool,
}

fn payload(text: &str) -> Result<PointPayload, String> {
    let (mass, position) = text.split_once(',').map_or((text, None), |(mass, at)| (mass, Some(at)));
    let refused = |why| format!("{why}; for example 3kg or 3kg,0,0,50mm");
    Ok(PointPayload {
        mass_kg: QuantityArgument::positive(mass, Dimension::Mass).map_err(refused)?,
        position_m: position.map_or(Ok([0.0; 3]), three_lengths).map_err(refused)?,
    })
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.arm.load_urdf(printer)?;
    let &Arguments { source, friction, payload, .. } = arguments;
    let followers = arguments.followers.followers();
    if arguments.base_parameters {
        return base_parameters(&description, followers, printer);
    }
    let options = DynamicsOptions { source, friction, payload, followers };
    description.check_capability(Capability::Physics)?;
    let robot = robot_with_options(&description, &options)?;
    let print = |description: &RobotDescription, states: &JointStateList, first| {
        let report = congruent::joint_dynamics(description, &robot, &options, states)?;
        printer.warnings(None, stiction(&description.robot, &options, states).as_slice());
        let printed = printer.parts(&report, |report| joint_dynamics_text_parts(report, first));
        report.results.end()?;
        printed
    };
    arguments.configurations.answer_states_or_rest(&mut description, printer, print)?;
    Ok(0)
}
