//! The report in sentences.

use std::fmt::Write;

use super::{CalibrationReport, CalibrationVerdict, Recommendation, RowResidual};

/// Most terms of a relation that are written out.
const MOST_TERMS: usize = 4;
/// A factor this near to 1 is written as none. Kind: display.
const UNIT_FACTOR: f64 = 1e-3;

/// Why a correction is held at nominal: what it is correlated with, in units of the estimated ones.
pub(super) fn why_fixed(unit: &str, terms: &[(&str, f64, &'static str)]) -> String {
    if let [(name, factor, of)] = terms
        && *of == unit
        && (factor.abs() - 1.0).abs() < UNIT_FACTOR
    {
        let what = if *factor > 0.0 { "sum" } else { "difference" };
        return format!("cannot be told from {name}: only their {what} can be identified");
    }
    if terms.is_empty() {
        return "has no effect on these measurements".to_owned();
    }
    let mut largest = terms.to_vec();
    largest.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    let term = |(name, factor, of): &(&str, f64, &'static str)| format!("{factor:.3} {of} of {name}");
    let shown: Vec<String> = largest.iter().take(MOST_TERMS).map(term).collect();
    let more = match terms.len().saturating_sub(MOST_TERMS) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!("1 {unit} of it looks like {}{more}", shown.join(", "))
}

/// What one should know before using a correction, the most important first.
pub(super) fn statements(report: &CalibrationReport) -> Vec<String> {
    let mut statements = vec![verdict(report)];
    let insignificant: Vec<&str> =
        report.parameters.iter().filter(|each| !each.significant).map(|each| each.name.as_str()).collect();
    let is_known = report.parameters.iter().all(|each| each.standard_deviation.is_finite());
    if !insignificant.is_empty() && is_known {
        statements.push(format!(
            "not significantly different from zero (within two standard deviations): {}",
            insignificant.join(", ")
        ));
    }
    if !report.fixed.is_empty() {
        let names: Vec<&str> = report.fixed.iter().map(|each| each.name.as_str()).collect();
        statements.push(format!(
            "held at nominal, since these measurements do not tell them: {}",
            names.join(", ")
        ));
    }
    for (word, estimation) in
        [("least squares", &report.least_squares), ("the robust estimate", &report.robust)]
    {
        if !estimation.converged {
            statements.push(format!("{word} did not converge in {} steps", estimation.iterations));
        }
    }
    statements
}

fn verdict(report: &CalibrationReport) -> String {
    match report.verdict {
        CalibrationVerdict::NothingIdentified => {
            "nothing can be identified from these measurements".to_owned()
        }
        CalibrationVerdict::Unexplained => nothing_explained(report),
        CalibrationVerdict::Misread => misread(report),
        CalibrationVerdict::NothingToJudgeBy => nothing_to_judge_by(report),
        CalibrationVerdict::UnexplainedRows => unexplained(report),
        CalibrationVerdict::NoiseExceeded => format!(
            "what is left ({} root mean square) is larger than the stated noise allows: the free corrections \
             do not explain the measurements",
            size(report.least_squares.left.rms_m, report.least_squares.left.rms_rad)
        ),
        CalibrationVerdict::NoImprovement => {
            "on measurements that were left out the corrections are no better than the nominal model: keep it"
                .to_owned()
        }
        CalibrationVerdict::Explained => {
            let held_out = report.held_out.as_ref();
            held_out.map_or_else(String::new, |error| {
                format!(
                    "the corrections explain the measurements: {} on rows that were left out, {} before",
                    size(error.rms_m, error.rms_rad),
                    size(error.nominal_rms_m, error.nominal_rms_rad)
                )
            })
        }
    }
}

fn nothing_explained(report: &CalibrationReport) -> String {
    let (left, before) = match &report.held_out {
        Some(error) => (
            format!("{} on rows that were left out", size(error.rms_m, error.rms_rad)),
            size(error.nominal_rms_m, error.nominal_rms_rad),
        ),
        None => (
            size(report.least_squares.left.rms_m, report.least_squares.left.rms_rad),
            size(report.nominal.rms_m, report.nominal.rms_rad),
        ),
    };
    let mut text =
        format!("the free corrections do NOT explain the measurements: they leave {left}, {before} before");
    let _ = match &report.likely_reason {
        Some(reason) => {
            write!(text, "; if {}, {} would be left", reason.what, size(reason.rms_m, reason.rms_rad))
        }
        None => write!(text, "; no common slip of units, order, sign or frame explains them either"),
    };
    text
}

fn misread(report: &CalibrationReport) -> String {
    report.likely_reason.as_ref().map_or_else(String::new, |reason| {
        format!(
            "the measurements are explained only by corrections as large as parts of the arm; if {}, small ones \
             would do and leave {}",
            reason.what,
            size(reason.rms_m, reason.rms_rad)
        )
    })
}

fn nothing_to_judge_by(report: &CalibrationReport) -> String {
    if report.redundancy > 0 {
        return "all measurements are at one configuration: whether the corrections hold elsewhere is not known"
            .to_owned();
    }
    format!(
        "the measurements say no more than the {} corrections take (repetitions at one configuration count \
         once): nothing is left to judge them by",
        report.parameters.len()
    )
}

fn unexplained(report: &CalibrationReport) -> String {
    let rows: Vec<String> = report.outliers.iter().map(|each| each.row.to_string()).collect();
    let left: Vec<String> = report
        .outliers
        .iter()
        .map(|each: &RowResidual| size(each.least_squares_m, each.least_squares_rad))
        .collect();
    let several = rows.len() > 1;
    let (plural, keep, them) = if several { ("s", "keep", "them") } else { ("", "keeps", "it") };
    let corrections = match &report.parameters[..] {
        [only] => only.name.as_str(),
        _ => "the free corrections",
    };
    let mut text = format!(
        "measurement{plural} {} {keep} {} after least squares: no value of {corrections} explains {them}",
        listed(&rows),
        listed(&left),
    );
    if report.recommended == Recommendation::Robust {
        let _ = write!(
            text,
            "; the robust estimate leaves {} out and has {} on the others",
            them,
            report
                .held_out
                .as_ref()
                .map_or_else(String::new, |error| format!("{} held out", size(error.rms_m, error.rms_rad)))
        );
    }
    text
}

fn listed(words: &[String]) -> String {
    const MOST: usize = 8;
    match words {
        [] => String::new(),
        [one] => one.clone(),
        words if words.len() > MOST => {
            format!("{} and {} more", words[..MOST].join(", "), words.len() - MOST)
        }
        [before @ .., last] => format!("{} and {last}", before.join(", ")),
    }
}

/// A distance, with the angle where orientations were measured.
fn size(metres: f64, radians: f64) -> String {
    let length = length(metres);
    if radians > 0.0 { format!("{length} / {:.4} deg", radians.to_degrees()) } else { length }
}

fn length(metres: f64) -> String {
    let millimetres = metres * 1e3;
    if millimetres >= 10.0 {
        format!("{millimetres:.1} mm")
    } else if millimetres >= 1e-3 {
        format!("{millimetres:.3} mm")
    } else {
        format!("{metres:.1e} m")
    }
}
