//! `congruent dynamics`: torques and accelerations at given states.

use std::{fmt::Write, iter::once};

use congruent::{
    analysis::dynamics::{
        DynamicsOptions, DynamicsResult, DynamicsSource, DynamicsStream, JointDynamicsReport, PointPayload,
        robot_with_options, stiction,
    },
    input::{Capability, SiUnit, display::quantity, serde_name},
};

use crate::{
    failure::Failure,
    input::{ArmArguments, ConfigurationArguments, named},
    terminal::{layout::column_width, print::Printer},
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
    let states = arguments.configurations.read_states_or_rest(&mut description, printer)?;
    let options = DynamicsOptions { friction: arguments.friction, payload: arguments.payload };
    description.check_capability(Capability::Physics)?;
    let robot = robot_with_options(&description, &options)?;
    let report = congruent::joint_dynamics((&description, &robot), arguments.source, &options, &states)?;
    printer.warnings(None, stiction(&description.robot, (arguments.source, &options), &states).as_slice());
    let printed = printer.parts(&report, parts);
    report.results.end()?;
    printed?;
    Ok(0)
}

type Report<'a> = JointDynamicsReport<DynamicsStream<'a>>;

/// The heading, and each state.
fn parts<'a>(report: &'a Report<'_>) -> impl Iterator<Item = String> + 'a {
    let source = serde_name(&report.source);
    let mut text = format!("{}: dynamics by the {source}", report.robot);
    text += if report.friction { ", with damping and dry friction" } else { ", without friction" };
    if let Some(PointPayload { mass_kg, position_m: [x, y, z] }) = report.payload {
        let _ = write!(text, ", with {mass_kg} kg at ({x}, {y}, {z}) m from the TCP");
    }
    let _ = writeln!(text, "\n  {}", report.chain);
    text += "  gravity: holding torque; bias: torque at velocities v; motion: torque at v and accelerations a; acceleration: under torques tau\n";
    let one = |(number, result): (usize, DynamicsResult)| {
        let mut text = format!("state {number}\n");
        state(&mut text, report, &result);
        text
    };
    once(text).chain((1..).zip(report.results.iter()).map(one))
}

fn state(text: &mut String, report: &Report<'_>, result: &DynamicsResult) {
    let width = column_width(report.joints.iter().map(String::len)).max("joint".len());
    let _ = writeln!(
        text,
        "  {:width$}  {:>12}  {:>12}  {:>12}  {:>15}",
        "joint", "gravity", "bias", "motion", "acceleration"
    );
    let [gravity, bias, inverse, forward] =
        [&result.gravity_n_m, &result.bias_n_m, &result.inverse_dynamics_n_m, &result.forward_dynamics]
            .map(|values| without_rounding(values));
    for (row, (joint, &unit)) in report.joints.iter().zip(&report.units).enumerate() {
        let (torque, acceleration) = if unit == SiUnit::Metre { ("N", "m/s^2") } else { ("N m", "rad/s^2") };
        let [gravity, bias, inverse] =
            [&gravity, &bias, &inverse].map(|values| quantity(values[row], torque));
        let forward = quantity(forward[row], acceleration);
        let _ = writeln!(text, "  {joint:width$}  {gravity:>12}  {bias:>12}  {inverse:>12}  {forward:>15}");
    }
    let _ = writeln!(text, "  mass matrix, kg m^2 (kg m and kg if joints slide)");
    for (joint, row) in report.joints.iter().zip(&result.mass_matrix) {
        let row = without_rounding(row).into_iter().map(|value| format!("{:>9}", quantity(value, "")));
        let _ = writeln!(text, "  {joint:width$}  {}", row.collect::<Vec<_>>().join(" "));
    }
}

/// Values that are nothing but rounding of the largest one are zero for people.
fn without_rounding(values: &[f64]) -> Vec<f64> {
    /// Some thousand roundings, as a share of the largest value. No unit. Kind: rounding.
    const ROUNDING: f64 = 1e-12;
    let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    values.iter().map(|&value| if value.abs() > ROUNDING * largest { value } else { 0.0 }).collect()
}
