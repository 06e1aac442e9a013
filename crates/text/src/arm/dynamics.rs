//! What `congruent dynamics` prints.

use std::fmt::Write;

use congruent_analysis::dynamics::{DynamicsResult, DynamicsStream, JointDynamicsReport, PointPayload};
use congruent_input::{SiUnit, display::quantity, serde_name};

use crate::layout::column_width;

type Report<'a> = JointDynamicsReport<DynamicsStream<'a>>;

/// What `congruent dynamics` prints: the source, then torques, accelerations and the mass matrix at each state, in parts of
/// whole lines. `first` is the number of the first state; the heading is left out if that is not 1.
pub fn joint_dynamics_text_parts<'a>(
    report: &'a JointDynamicsReport<DynamicsStream<'_>>,
    first: usize,
) -> impl Iterator<Item = String> + 'a {
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
    (first == 1).then_some(text).into_iter().chain((first..).zip(report.results.iter()).map(one))
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
