//! What `congruent plan` prints.

use std::fmt::Write;

use congruent_identification::JointUnknown;
use congruent_input::display::{length, number};
use congruent_text::{layout::Table, term_name};

use crate::identify::PlanReport;

/// What `congruent plan` prints: the motion, and what it will show.
pub fn plan_report_text(report: &PlanReport) -> String {
    let mut text = format!(
        "{}: a motion of {} s within all limits, the best of {} that were tried\n",
        report.robot,
        number(report.duration_s),
        report.tried
    );
    if let Some(nearest_m) = report.nearest_m {
        let _ = writeln!(text, "  links stay {} from each other and from obstacles", length(nearest_m));
    }
    if !report.always_near.is_empty() {
        let _ = writeln!(
            text,
            "  nearer wherever the robot is, so not counted: {}",
            report.always_near.join(", ")
        );
    }
    let acceleration = number(report.assumed_acceleration);
    let _ = writeln!(
        text,
        "  accelerations up to {acceleration} rad/s^2 or m/s^2, unless the robot file states less"
    );
    if !report.without_velocity_limit.is_empty() {
        let joints = report.without_velocity_limit.join(", ");
        let _ = writeln!(text, "  no limit of velocity: {joints}; look at the motion before an arm makes it");
    }
    let noise = number(100.0 * report.effort_noise);
    let _ = writeln!(
        text,
        "\n  standard errors that it will leave, with efforts that are noisy by {noise} % of the effort limits, at ten independent instants a second"
    );
    terms(&mut text, report);
    if let Some(error_kg) = report.payload_mass_error_kg {
        let _ = writeln!(text, "  mass of the payload: {} kg", number(error_kg));
    }
    if report.free_inertial_parameters > 0 {
        let _ = writeln!(
            text,
            "  {} of the {} free inertial parameters will show, as combinations",
            report.known_combinations, report.free_inertial_parameters
        );
    }
    text.push('\n');
    for file in &report.written {
        let _ = writeln!(text, "  written: {file}");
    }
    text
}

fn terms(text: &mut String, report: &PlanReport) {
    let shown: Vec<JointUnknown> =
        JointUnknown::ALL.into_iter().filter(|term| report.terms.iter().any(|of| of.term == *term)).collect();
    let mut joints: Vec<&str> = report.terms.iter().map(|of| of.joint.as_str()).collect();
    joints.dedup();
    let mut table = Table::default();
    table.row(std::iter::once(String::new()).chain(shown.iter().map(|term| term_name(*term).to_owned())));
    for joint in joints {
        let cell = |term: &JointUnknown| {
            let of = report.terms.iter().find(|of| of.joint == joint && of.term == *term);
            of.map_or_else(|| "-".to_owned(), |of| format!("{} {}", number(of.standard_error), of.unit))
        };
        table.row(std::iter::once(joint.to_owned()).chain(shown.iter().map(cell)));
    }
    table.write(text, None);
}
