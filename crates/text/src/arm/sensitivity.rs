//! What `congruent sensitivity` prints.

use std::fmt::Write;

use congruent_analysis::sensitivity::SensitivityReport;
use congruent_description::Robot;
use congruent_input::display::{in_column, length, number};

use crate::{
    TextOptions,
    layout::{Table, wrapped},
};

/// By how much all lengths of the arm are multiplied, if they are.
fn lengths(factor: f64) -> String {
    // The factor is an argument of the caller, 1 unless another is given.
    if factor.to_bits() == 1.0_f64.to_bits() {
        String::new()
    } else {
        format!(", all lengths times {}", number(factor))
    }
}

/// What `congruent sensitivity` prints: the displacement of the tool by an error of each parameter, and the worst of all.
pub fn sensitivity_text(report: &SensitivityReport, robot: &Robot, options: &TextOptions) -> String {
    let mut text = format!("{}: {}\n", report.robot, report.chain);
    for arm in &report.arms {
        let _ = writeln!(
            text,
            "displacement of the tool by one error, at {} random configurations{}",
            report.samples,
            lengths(arm.length_factor)
        );
        let mut table = Table::headed(["joint", "entry", "error", "worst mm", "mean mm", "rotation deg"]);
        for parameter in &arm.parameters {
            let values = [parameter.worst_mm, parameter.mean_mm].map(|value| in_column(value / 1e3, "m"));
            let rotation = in_column(parameter.worst_deg.to_radians(), "rad");
            let named =
                [parameter.joint.clone(), parameter.parameter.to_string(), parameter.error.to_string()];
            table.row(named.into_iter().chain(values).chain([rotation]));
        }
        table.write(&mut text, options.columns);
        let worst = arm.parameters.iter().max_by(|a, b| a.worst_mm.total_cmp(&b.worst_mm));
        if let Some(worst) = worst {
            let _ = writeln!(
                text,
                "  largest: {} for an error of {} in {} of {}, at",
                length(worst.worst_mm / 1e3),
                worst.error,
                worst.parameter,
                worst.joint
            );
            text += &wrapped(&worst.worst_at.for_people(robot));
        }
    }
    text
}
