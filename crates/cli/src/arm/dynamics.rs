//! `congruent dynamics`: torques and accelerations at given states.

use congruent::{
    analysis::dynamics::{DynamicsOptions, DynamicsSource, PointPayload, robot_with_options, stiction},
    description::{JointStateList, RobotDescription},
    input::Capability,
    text::joint_dynamics_text_parts,
};

use crate::{
    configurations::ConfigurationArguments,
    failure::Failure,
    input::{ArmArguments, FollowerArgument, named},
    terminal::print::Printer,
};

/// Torques that hold and move a robot, its mass matrix, and its accelerations under torques.
///
/// A state of --configurations may have velocities "v", accelerations "a" and torques "tau" beside its
/// positions "q"; a value that is not given is zero.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
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
    /// A mass at the tool centre point, in kg; with X,Y,Z in m it is there in the frame of the TCP.
    #[arg(long, value_name = "KG[,X,Y,Z]", value_parser = payload, allow_hyphen_values = true)]
    payload: Option<PointPayload>,
}

fn payload(text: &str) -> Result<PointPayload, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse::<f64>()).collect();
    let numbers =
        numbers.map_err(|_| "expected KG or KG,X,Y,Z, for example 2.5 or 2.5,0,0,0.05".to_owned())?;
    let (mass_kg, position_m) = match numbers[..] {
        [mass_kg] => (mass_kg, [0.0; 3]),
        [mass_kg, x, y, z] => (mass_kg, [x, y, z]),
        _ => return Err(format!("{} numbers, expected KG or KG,X,Y,Z", numbers.len())),
    };
    let is_possible = mass_kg > 0.0 && numbers.iter().all(|number| number.is_finite());
    is_possible
        .then_some(PointPayload { mass_kg, position_m })
        .ok_or_else(|| format!("payload mass must be > 0 and its position finite, not {mass_kg} kg"))
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.arm.load_urdf(printer)?;
    let &Arguments { source, friction, payload, .. } = arguments;
    let followers = arguments.followers.followers();
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
