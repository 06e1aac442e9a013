//! What `congruent tolerances` prints.

use std::fmt::Write;

use congruent_calibration::estimation::ParameterUnit;
use congruent_description::Robot;
use congruent_input::display::{angle, counted, length, number};
use congruent_tolerances::{
    ChosenBy, ErrorLevels, FirstOrderError, MonteCarloError, ParameterShare, Requirement, ToleranceReport,
    ToleranceSource, ToleranceVerdict,
};

use crate::{
    TextOptions,
    layout::{Table, paragraph, wrapped},
};

/// Parameters that are listed; all are in the JSON.
const MOST_PARAMETERS: usize = 12;
/// Given configurations that are listed.
const MOST_CONFIGURATIONS: usize = 20;
/// Standard errors beyond which the two methods differ by more than chance.
const CHANCE: f64 = 3.0;

/// What `congruent tolerances` prints: the verdict if there is a requirement, the error by both methods, the worst case, and what
/// to tighten.
pub fn tolerances_text(report: &ToleranceReport, robot: &Robot, options: &TextOptions) -> String {
    let mut text = format!("{}: {}\n", report.robot, report.chain);
    if let Some(requirement) = &report.requirement {
        verdict(&mut text, requirement, report);
    }
    let kind = format!(
        "tolerances of {} {}, {}",
        counted(report.parameters.len(), "parameter"),
        source(report.source),
        distribution(report.sigmas)
    );
    text += &paragraph(&kind, 0, 2);
    let count = report.configurations.count;
    let place = if report.configurations.chosen == ChosenBy::Given {
        format!("{} given", counted(count, "configuration"))
    } else {
        format!("joint range ({count} random)")
    };
    let mut table =
        Table::headed(["error of the tool", "rms mm", "95 %", "99.7 %", "rms deg", "95 %", "99.7 %"]);
    levels(&mut table, &place, &report.overall);
    // The only configuration is the worst of all.
    if count > 1 {
        levels(&mut table, "worst configuration", &report.worst.levels);
        levels(&mut table, "worst for the angle", &report.worst_orientation.levels);
    }
    table.write(&mut text, options.columns);
    let worst = [&report.worst, &report.worst_orientation];
    agreement(&mut text, [&report.overall, &worst[0].levels, &worst[1].levels]);
    text += if count > 1 { "  worst configuration\n" } else { "  configuration\n" };
    text += &wrapped(&report.worst.at.for_people(robot));
    if count > 1 {
        text += "  worst for the angle\n";
        text += &wrapped(&report.worst_orientation.at.for_people(robot));
    }
    worst_case(&mut text, report);
    shares(&mut text, report, options);
    halvings(&mut text, report);
    at_each(&mut text, report, options);
    text
}

/// The answer in one line, for `--quiet`.
pub fn tolerances_line(report: &ToleranceReport) -> String {
    let [p997_m, p997_rad] = report.largest_p997();
    let word = report.requirement.map_or(String::new(), |of| format!(" {}:", verdict_word(of.verdict)));
    format!(
        "{}:{word} 99.7 % of all arms within {} and {}; certified {} and {}\n",
        report.robot,
        length(p997_m),
        angle(p997_rad),
        length(report.worst_case.certified_m),
        angle(report.worst_case.certified_rad)
    )
}

fn verdict_word(verdict: ToleranceVerdict) -> &'static str {
    match verdict {
        ToleranceVerdict::Certified => "within tolerance, certified",
        ToleranceVerdict::Within => "within tolerance",
        ToleranceVerdict::Exceeded => "tolerance exceeded",
    }
}

fn source(source: ToleranceSource) -> &'static str {
    match source {
        ToleranceSource::RobotFile => "of [tolerances] in the robot file",
        ToleranceSource::Options => "as given",
        ToleranceSource::Calibration => "from the covariance of the calibration",
        ToleranceSource::Digits => "from the digits that are written",
    }
}

fn distribution(sigmas: Option<f64>) -> String {
    match sigmas {
        None => "errors uniform within the tolerance".to_owned(),
        Some(sigmas) => {
            format!("errors normal, a tolerance is {} of each", counted_sigmas(sigmas))
        }
    }
}

fn counted_sigmas(sigmas: f64) -> String {
    format!("{} standard deviations", number(sigmas))
}

/// Word, value, limit and margin.
fn verdict(text: &mut String, of: &Requirement, report: &ToleranceReport) {
    let (word, worst_case) = (verdict_word(of.verdict), &report.worst_case);
    let place = match report.configurations.chosen {
        ChosenBy::Given => "at the given configurations",
        ChosenBy::Random => "over the joint range and at its worst configurations",
    };
    let _ = writeln!(text, "{word}: 99.7 % of all arms {place}");
    let mut line = |value: f64, certified: f64, limit: Option<f64>, shown: fn(f64) -> String| {
        let Some(limit) = limit else { return };
        let (margin, room) = (limit - value, if value <= limit { "margin" } else { "too large by" });
        let _ = writeln!(
            text,
            "  {}, limit <= {}, {room} {}; certified worst case {}",
            shown(value),
            shown(limit),
            shown(margin.abs()),
            shown(certified)
        );
    };
    line(of.p997_m, worst_case.certified_m, of.position_m, length);
    line(of.p997_rad, worst_case.certified_rad, of.orientation_rad, angle);
}

fn levels(table: &mut Table, place: &str, levels: &ErrorLevels) {
    let row = |name: String, metres: [f64; 3], radians: [f64; 3]| {
        let lengths = metres.map(|value| number(value * 1e3));
        let angles = radians.map(|value| number(value.to_degrees()));
        [name].into_iter().chain(lengths).chain(angles)
    };
    let FirstOrderError { rms_m, p95_m, p997_m, rms_rad, p95_rad, p997_rad } = levels.first_order;
    table.row(row(format!("{place}: first order"), [rms_m, p95_m, p997_m], [rms_rad, p95_rad, p997_rad]));
    let MonteCarloError { rms_m, p95_m, p997_m, rms_rad, p95_rad, p997_rad, .. } = levels.monte_carlo;
    let name = "  Monte Carlo".to_owned();
    table.row(row(name, [rms_m, p95_m, p997_m], [rms_rad, p95_rad, p997_rad]));
}

/// Whether linearisation is good enough.
fn agreement(text: &mut String, levels: [&ErrorLevels; 3]) {
    let apart = levels.iter().map(|of| of.standard_errors_apart).fold(0.0, f64::max);
    let samples = levels[0].monte_carlo.samples;
    let words = if apart <= CHANCE {
        format!("both methods agree: the rms within chance ({samples} draws)")
    } else {
        let apart = number(apart);
        format!(
            "the rms of the two methods differs by {apart} standard errors ({samples} draws): errors of this size do not add up linearly, take Monte Carlo"
        )
    };
    *text += &paragraph(&words, 2, 4);
}

fn worst_case(text: &mut String, report: &ToleranceReport) {
    let of = &report.worst_case;
    let place = if report.configurations.chosen == ChosenBy::Given {
        "at the given configurations"
    } else {
        "over the joint range"
    };
    let words = format!("worst case, all parameters within their tolerances at once, {place}");
    *text += &paragraph(&words, 0, 2);
    let _ = writeln!(
        text,
        "  {} is attained, {} is certified: no such arm is farther off\n  {} is attained, {} is certified",
        length(of.attained_m),
        length(of.certified_m),
        angle(of.attained_rad),
        angle(of.certified_rad)
    );
}

fn value(unit: ParameterUnit, value: f64) -> String {
    match unit {
        ParameterUnit::Length => length(value),
        ParameterUnit::Angle => angle(value),
    }
}

/// What is worth tightening.
fn shares(text: &mut String, report: &ToleranceReport, options: &TextOptions) {
    let p95_m = report.overall.first_order.p95_m;
    let _ = writeln!(text, "what to tighten: the 95 % error of {} falls", length(p95_m));
    let mut table = Table::headed(["parameter", "tolerance", "share", "per step", "step", "if halved"]);
    for ParameterShare { name, unit, tolerance, share, gain_per_step_m, p95_if_halved_m, .. } in
        report.parameters.iter().take(MOST_PARAMETERS)
    {
        let step = match unit {
            ParameterUnit::Length => "1 um",
            ParameterUnit::Angle => "0.001 deg",
        };
        table.row([
            name.clone(),
            value(*unit, *tolerance),
            format!("{:.1} %", share * 100.0),
            format!("{} um", number(gain_per_step_m * 1e6)),
            step.to_owned(),
            format!("to {}", length(*p95_if_halved_m)),
        ]);
    }
    table.write(text, options.columns);
    let rest = report.parameters.iter().skip(MOST_PARAMETERS);
    let (count, share) = (rest.clone().count(), rest.map(|of| of.share).sum::<f64>());
    if count > 0 {
        let _ = writeln!(text, "  {} more: {:.1} % together", counted(count, "parameter"), share * 100.0);
    }
}

fn halvings(text: &mut String, report: &ToleranceReport) {
    let _ = writeln!(text, "halved one after another, each where the share is largest");
    for (at, halving) in report.halvings.iter().enumerate() {
        let tolerance = value(halving.unit, halving.tolerance);
        let _ = writeln!(
            text,
            "  {}. {} to {tolerance}: 95 % error {}",
            at + 1,
            halving.parameter,
            length(halving.p95_m)
        );
    }
}

/// The given configurations, each by itself.
fn at_each(text: &mut String, report: &ToleranceReport, options: &TextOptions) {
    if report.at.len() < 2 {
        return;
    }
    let mut table = Table::headed([
        "configuration",
        "rms mm",
        "95 %",
        "99.7 %",
        "certified mm",
        "rms deg",
        "certified deg",
    ]);
    for (at, of) in report.at.iter().enumerate().take(MOST_CONFIGURATIONS) {
        let FirstOrderError { rms_m, p95_m, p997_m, rms_rad, .. } = of.first_order;
        let lengths = [rms_m, p95_m, p997_m, of.certified_m].map(|value| number(value * 1e3));
        let angles = [rms_rad, of.certified_rad].map(|value| number(value.to_degrees()));
        table.row([(at + 1).to_string()].into_iter().chain(lengths).chain(angles));
    }
    let _ = writeln!(text, "at each configuration, to first order");
    table.write(text, options.columns);
    if report.at.len() > MOST_CONFIGURATIONS {
        let _ = writeln!(text, "  and {} more, in the JSON", report.at.len() - MOST_CONFIGURATIONS);
    }
}
