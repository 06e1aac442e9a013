//! What `congruent dynamics --base-parameters` prints.

use std::fmt::Write;

use congruent_analysis::base_parameters::{BaseParameterReport, NamedParameter, ReportedBaseParameter};
use congruent_input::display::{number, quantity};

use crate::layout::wrapped;

/// What `congruent dynamics --base-parameters` prints: each sum of parameters with its value, and the parameters that change no torque.
pub fn base_parameters_text(report: &BaseParameterReport) -> String {
    let (identifiable, all) = (report.base_parameters.len(), report.of);
    let mut text = format!(
        "{}: {identifiable} base parameters of {all} inertial parameters are identifiable from joint torques\n",
        report.file
    );
    text += "  about the origin and in the axes of each link: ixx to izz inertia, mx to mz mass times centre of mass, m mass\n";
    for group in &report.base_parameters {
        let _ = writeln!(text, "  {}", sum(group));
    }
    if !report.not_seen.is_empty() {
        let _ = writeln!(text, "  not identifiable, since they change no joint torque:");
        let names: Vec<String> = report.not_seen.iter().map(name).collect();
        text += &wrapped(&names.join(", "));
    }
    text
}

fn name(of: &NamedParameter) -> String {
    format!("{} {}", of.link, of.parameter)
}

/// `upper_arm_link ixx - forearm_link mz + 0.18 forearm_link m = 1.2 kg m^2`.
fn sum(group: &ReportedBaseParameter) -> String {
    let mut sum = name(&group.of);
    for part in &group.grouped {
        let sign = if part.coefficient < 0.0 { '-' } else { '+' };
        let factor = number(part.coefficient.abs());
        let factor = if factor == "1" { String::new() } else { format!("{factor} ") };
        let _ = write!(sum, " {sign} {factor}{}", name(&part.of));
    }
    format!("{sum} = {}", quantity(group.value, group.unit))
}
