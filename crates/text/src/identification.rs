//! What `congruent identify` prints.

use std::fmt::Write;

use congruent_identification::{
    EffortKind, JointUnknown,
    report::{
        BodyReport, EffortReport, IdentificationReport, IdentificationVerdict, IdentifiedJointReport,
        IndistinctTerms, TermReport, WrittenLines,
    },
};
use congruent_input::display::{listed, number, quantity};

use super::layout::Table;

/// What `congruent identify` prints: whether the parameters are better, what they are with their uncertainty, and the lines to write.
pub fn identification_text(report: &IdentificationReport) -> String {
    let mut text = headline(report);
    let _ = writeln!(text, "  {}", effort_sentence(&report.effort));
    constants(&mut text, &report.effort);
    let at = if report.is_of_still_poses { "at rest" } else { "in motion" };
    let _ = writeln!(
        text,
        "  {} instants {at}, each from the rows within {} before and after it",
        report.instants,
        seconds(report.half_window_s)
    );
    if let (Some(delay_s), Some(error_s)) = (report.effort_delay_s, report.effort_delay_error_s) {
        let delay = with_error(1000.0 * delay_s.abs(), 1000.0 * error_s);
        let side = if delay_s < 0.0 { "earlier" } else { "later" };
        let is_long = delay_s.abs() > LONGEST_DELAY * report.half_window_s;
        let remark = if is_long { ": longer than the window, so that it is no delay" } else { "" };
        let _ = writeln!(text, "  efforts are recorded {delay} ms {side} than positions{remark}");
    }
    if !report.joints_not_in_log.is_empty() {
        let joints: Vec<&str> = report.joints_not_in_log.iter().map(String::as_str).collect();
        let _ = writeln!(
            text,
            "  not in the log, so taken to stand still at their start: {}; if they moved, all values are wrong",
            listed(&joints)
        );
    }
    left(&mut text, &report.joints);
    terms(&mut text, &report.joints);
    for combined in &report.indistinct {
        let _ = writeln!(text, "  {}", indistinct(combined));
    }
    if let Some(payload) = &report.payload {
        let is_none = payload.mass.value <= 2.0 * payload.mass.standard_error;
        let remark = if is_none { ": none shows" } else { "" };
        let _ = writeln!(text, "\n  payload at {}{remark}", payload.frame);
        body(&mut text, payload, "    ");
    }
    bodies(&mut text, report);
    match &report.lines {
        Some(lines) => lines_to_write(&mut text, lines),
        None => text.push_str(&why_not_better(&report.joints)),
    }
    for file in &report.written {
        let _ = writeln!(text, "  written: {file}");
    }
    text
}

/// Half windows up to which a delay is one: it is estimated from the derivative of the efforts. No unit; kind: choice.
const LONGEST_DELAY: f64 = 2.0;

fn headline(report: &IdentificationReport) -> String {
    let share = |of: fn(&IdentifiedJointReport) -> f64| -> f64 {
        let used = report.joints.iter().filter(|joint| joint.instants > 0 && joint.effort_rms > 0.0);
        let shares: Vec<f64> = used.map(|joint| of(joint) / joint.effort_rms).collect();
        #[expect(clippy::cast_precision_loss, reason = "a robot has few joints")]
        let count = shares.len().max(1) as f64;
        100.0 * shares.iter().sum::<f64>() / count
    };
    let (before, after) = (number(share(|joint| joint.before_rms)), number(share(|joint| joint.after_rms)));
    let verdict = match report.verdict {
        IdentificationVerdict::Better => "BETTER than the description",
        IdentificationVerdict::NotBetter => "NOT BETTER than the description",
    };
    format!(
        "{}: {verdict} ({})\n  left of the efforts, rms: {after} %, by the description {before} %; mean of the joints, on data that were left out of the estimate\n",
        report.robot, report.log
    )
}

/// Why no lines are written.
fn why_not_better(joints: &[IdentifiedJointReport]) -> String {
    let worst = joints
        .iter()
        .filter(|joint| joint.instants > 0 && joint.after_rms > joint.before_rms)
        .max_by(|a, b| (a.after_rms / a.before_rms).total_cmp(&(b.after_rms / b.before_rms)));
    match worst {
        Some(joint) => format!(
            "\n  no lines to write: efforts of {} that were left out are predicted worse ({}) than by the description ({}); free other parameters, or \
             record a motion that shows these\n",
            joint.joint,
            quantity(joint.after_rms, joint.unit),
            quantity(joint.before_rms, joint.unit)
        ),
        None => "\n  no lines to write: the description predicts these efforts as well\n".to_owned(),
    }
}

fn seconds(time_s: f64) -> String {
    format!("{} ms", number(time_s * 1000.0))
}

fn kind_words(kind: EffortKind) -> &'static str {
    match kind {
        EffortKind::Torque => "torques",
        EffortKind::TorqueWithoutGravity => "torques without those of gravity",
        EffortKind::Current => "currents",
        EffortKind::None => "none",
        EffortKind::Unknown => "unknown",
    }
}

fn effort_sentence(effort: &EffortReport) -> String {
    let share = |left: f64| format!("{} %", number(100.0 * left));
    let by = if effort.is_declared { ", as stated" } else { "" };
    let or_else = if effort.kind == EffortKind::Current && !effort.is_declared {
        "; if they are torques of an arm with other masses, state --effort torque"
    } else {
        ""
    };
    let [torque, without, current] =
        [effort.left_as_torque, effort.left_as_torque_without_gravity, effort.left_as_current].map(share);
    format!(
        "efforts: {}{by} (variance that is left with friction fitted, if they are torques {torque}, torques without gravity {without}, currents \
         {current}){or_else}",
        kind_words(effort.kind)
    )
}

fn constants(text: &mut String, effort: &EffortReport) {
    for constant in &effort.torque_constants {
        let value = match (constant.value, constant.standard_error) {
            (Some(value), Some(error)) => format!("{} {}", with_error(value, error), constant.unit),
            (Some(value), None) => format!("{} {} (given)", number(value), constant.unit),
            (None, _) => "not identified: gravity and inertia have too small a part in its effort".to_owned(),
        };
        let _ = writeln!(text, "  torque constant of {}: {value}", constant.joint);
    }
}

/// A value with its standard error, both to the second digit of the error.
fn with_error(value: f64, error: f64) -> String {
    if !(error > 0.0 && error.is_finite()) {
        return number(value);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 12")]
    let decimals = (1.0 - libm::log10(error).floor()).clamp(0.0, 12.0) as usize;
    format!("{value:.decimals$} ± {error:.decimals$}")
}

fn left(text: &mut String, joints: &[IdentifiedJointReport]) {
    let mut table = Table::headed(["", "instants", "effort rms", "left by description", "left by these"]);
    for joint in joints {
        let of = |value: f64| if joint.instants == 0 { "-".to_owned() } else { quantity(value, joint.unit) };
        table.row([
            joint.joint.clone(),
            joint.instants.to_string(),
            of(joint.effort_rms),
            of(joint.before_rms),
            of(joint.after_rms),
        ]);
    }
    text.push('\n');
    table.write(text, None);
    text.push_str("  left by these: in each fifth of the time, by the parameters from the other four\n");
}

/// The name of a term of a joint.
pub fn term_name(term: JointUnknown) -> &'static str {
    match term {
        JointUnknown::Viscous => "viscous friction",
        JointUnknown::Coulomb => "Coulomb friction",
        JointUnknown::Armature => "armature",
        JointUnknown::Offset => "constant effort",
    }
}

fn terms(text: &mut String, joints: &[IdentifiedJointReport]) {
    let shown: Vec<JointUnknown> = JointUnknown::ALL
        .into_iter()
        .filter(|term| joints.iter().any(|joint| joint.terms.iter().any(|of| of.term == *term)))
        .collect();
    if shown.is_empty() {
        return;
    }
    let mut table = Table::default();
    let heads = shown.iter().map(|term| term_name(*term).to_owned());
    table.row(std::iter::once(String::new()).chain(heads));
    for joint in joints.iter().filter(|joint| !joint.terms.is_empty()) {
        let cell = |term: &JointUnknown| {
            let of = joint.terms.iter().find(|of| of.term == *term);
            of.map_or_else(|| "as described".to_owned(), term_cell)
        };
        table.row(std::iter::once(joint.joint.clone()).chain(shown.iter().map(cell)));
    }
    text.push('\n');
    table.write(text, None);
    let is_zero = |of: &TermReport| !of.is_significant && of.term != JointUnknown::Offset;
    if joints.iter().flat_map(|joint| &joint.terms).any(is_zero) {
        text.push_str("  (0): differs from zero by less than two standard errors\n");
    }
}

fn term_cell(term: &TermReport) -> String {
    let value = &term.value;
    let mark = if term.is_significant || term.term == JointUnknown::Offset { "" } else { " (0)" };
    format!("{} {}{mark}", with_error(value.value, value.standard_error), value.unit)
}

fn indistinct(combined: &IndistinctTerms) -> String {
    let IndistinctTerms { joint, kept, like } = combined;
    let kept = term_name(*kept);
    if like.is_empty() {
        return format!("{joint}: {kept} has no effect here; kept as described");
    }
    let like: Vec<&str> = like.iter().map(|term| term_name(*term)).collect();
    let why = if like.contains(&term_name(JointUnknown::Coulomb)) && kept == term_name(JointUnknown::Offset) {
        ": the joint moves in one direction alone"
    } else {
        ""
    };
    format!("{joint}: {kept} cannot be distinguished from {}{why}; kept as described", listed(&like))
}

fn body(text: &mut String, of: &BodyReport, indent: &str) {
    let mass = with_error(of.mass.value, of.mass.standard_error);
    let _ = writeln!(text, "{indent}mass      {mass} kg");
    let axes = [0, 1, 2].map(|axis| with_error(1000.0 * of.center_m[axis], 1000.0 * of.center_error_m[axis]));
    let _ = writeln!(text, "{indent}center    x {}, y {}, z {} mm", axes[0], axes[1], axes[2]);
    let moments: Vec<String> = [("xx", 0), ("yy", 3), ("zz", 5)]
        .map(|(name, at)| format!("{name} {}", with_error(of.inertia_kg_m2[at], of.inertia_error_kg_m2[at])))
        .into();
    let _ = writeln!(text, "{indent}inertia   {} kg m^2, about the center", moments.join(", "));
}

fn bodies(text: &mut String, report: &IdentificationReport) {
    if report.bodies.is_empty() {
        return;
    }
    let _ = writeln!(
        text,
        "\n  {} of the {} inertial parameters show, as combinations; along the others the bodies are as near the description as they can be",
        report.known_combinations, report.free_inertial_parameters
    );
    let mut table = Table::headed(["body of", "mass kg", "described", "center x mm", "y mm", "z mm"]);
    for of in &report.bodies {
        let axes =
            [0, 1, 2].map(|axis| with_error(1000.0 * of.center_m[axis], 1000.0 * of.center_error_m[axis]));
        let mass = with_error(of.mass.value, of.mass.standard_error);
        table.row([of.joint.clone(), mass, number(of.mass.nominal)].into_iter().chain(axes));
    }
    table.write(text, None);
}

fn lines_to_write(text: &mut String, lines: &WrittenLines) {
    let mut part = |title: &str, lines: &str| {
        if !lines.is_empty() {
            let _ = writeln!(text, "\n  {title}");
            for line in lines.lines() {
                let _ = writeln!(text, "    {line}");
            }
        }
    };
    let of_description: Vec<String> = lines
        .of_description
        .iter()
        .map(|changed| format!("line {}:\n{}", changed.from_line, changed.text))
        .collect();
    part(&format!("to write into {}", lines.file), &of_description.join("\n"));
    part("to write into robot.toml", &lines.of_robot_file);
    part("to write into a scenario", &lines.of_scenario);
    for missing in &lines.not_in_description {
        let _ = writeln!(text, "  not in {}: {missing}", lines.file);
    }
}
