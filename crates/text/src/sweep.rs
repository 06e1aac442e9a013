//! What `congruent sweep` prints.

use std::fmt::Write;

use congruent_input::display::{counted, number};
use congruent_results::report::{KeyImportance, requirement_sentence};
use congruent_sweep::{
    store::SweepProgress,
    summary::{MeasureSummary, SweepSummary},
};

use super::layout::{Table, paragraph};

/// Most quantities that are listed.
const MOST_QUANTITIES: usize = 8;
/// Most ranges of missing cases that are listed.
const MOST_RANGES: usize = 8;

/// What `congruent sweep merge` prints, and `sweep run` of a whole plan: verdicts, which value matters, the worst cases, and where
/// the results are.
pub fn sweep_text(summary: &SweepSummary, folder: &str) -> String {
    let header = &summary.header;
    let mut text = format!(
        "{}: {} of {} pass ({}, robot {}){}\n",
        header.name,
        summary.verdicts.get("pass").copied().unwrap_or(0),
        counted(usize::try_from(summary.rows).unwrap_or(usize::MAX), "case"),
        header.scenario,
        header.robot,
        others(&summary.verdicts.iter().map(|(word, count)| (*word, *count)).collect::<Vec<_>>())
    );
    if summary.missing > 0 {
        let _ = writeln!(text, "  {} cases of the plan have no row yet", summary.missing);
    }
    if let Some(requirement) = &summary.requirement {
        text += &paragraph(&requirement_sentence(requirement), 2, 4);
    }
    quantities(&mut text, summary);
    worst(&mut text, summary);
    for (case, error) in &summary.refused {
        text += &paragraph(&format!("case {case} has no result: {error}"), 2, 4);
    }
    let _ = writeln!(text, "  rows: SHA-256 {}", summary.table_sha256);
    let _ = writeln!(text, "  {folder}/index.html, cases.csv, cases.parquet, sweep_summary.json");
    text
}

/// Verdicts other than `pass`, in words.
fn others(verdicts: &[(&str, u64)]) -> String {
    let other = |(word, count): &(&str, u64)| {
        (*word != "pass").then(|| format!(", {count} {}", word.replace('_', " ")))
    };
    verdicts.iter().filter_map(other).collect()
}

fn quantities(text: &mut String, summary: &SweepSummary) {
    if summary.measures.is_empty() {
        return;
    }
    let mut table = Table::headed(["quantity", "least", "median", "largest", "outside"]);
    for MeasureSummary { name, range, outside, .. } in summary.measures.iter().take(MOST_QUANTITIES) {
        let range = range.map(number);
        table.row([name.clone()].into_iter().chain(range).chain([outside.to_string()]));
    }
    text.push('\n');
    table.write(text, None);
    let deciding =
        summary.measures.iter().take(MOST_QUANTITIES).filter(|measure| !measure.importance.is_empty());
    for measure in deciding {
        text.push_str(&paragraph(&decided_by(measure), 2, 4));
    }
    if summary.measures.len() > MOST_QUANTITIES {
        let _ = writeln!(text, "  and {} more in cases.csv", summary.measures.len() - MOST_QUANTITIES);
    }
}

/// Which keys decide a quantity: `clearance.distance_m: payload.1.mass_kg 83 % of the variance (79 to 87)`.
fn decided_by(measure: &MeasureSummary) -> String {
    let deciding = measure.importance.iter().filter(|key| key.interval[0] > 0.0);
    let percent = |share: f64| format!("{:.0}", 100.0 * share);
    let words = |key: &KeyImportance| {
        let [from, to] = key.interval.map(percent);
        let direction = key.direction().map_or_else(String::new, |direction| format!(", {direction}"));
        format!("{} decides {} of its variance ({from} to {to} %{direction})", key.key, key.percent())
    };
    let deciding: Vec<String> = deciding.map(words).collect();
    if deciding.is_empty() {
        return format!("{}: no key alone decides it", measure.name);
    }
    format!("{}: {}", measure.name, deciding.join("; "))
}

fn worst(text: &mut String, summary: &SweepSummary) {
    if summary.worst.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n  the cases with the smallest margins");
    for worst in &summary.worst {
        let values = summary.header.keys.iter().zip(&worst.values);
        let values: Vec<String> = values.map(|(key, value)| format!("{key}={}", short(value))).collect();
        let value = worst.value.map_or_else(|| "no number".to_owned(), number);
        let line = format!(
            "case {} {}: {} {value}, limit {}, margin {} %, at {}",
            worst.case,
            worst.verdict.word().replace('_', " "),
            worst.quantity,
            number(worst.limit),
            number(100.0 * worst.margin_share),
            values.join(", ")
        );
        text.push_str(&paragraph(&line, 2, 4));
        if let Some(cause) = &worst.cause {
            text.push_str(&paragraph(&format!("cause: {cause}"), 4, 6));
        }
    }
}

/// A number with the digits that people read; a word as it is.
fn short(value: &str) -> String {
    value.parse().map_or_else(|_| value.to_owned(), number)
}

/// What `congruent sweep status` prints, and `sweep run` of a part.
pub fn sweep_progress_text(progress: &SweepProgress) -> String {
    let SweepProgress { header, folder, rows, .. } = progress;
    let verdicts: Vec<String> =
        progress.verdicts.iter().map(|(word, count)| format!("{count} {}", word.replace('_', " "))).collect();
    let mut text = format!("{}: {rows} of {} cases have a row in {folder}", header.name, header.cases);
    if !verdicts.is_empty() {
        let _ = write!(text, ": {}", verdicts.join(", "));
    }
    text.push('\n');
    if progress.ran > 0 {
        let _ = writeln!(text, "  {} ran in this call", progress.ran);
    }
    if progress.missing_count > 0 {
        let shown = progress.missing.iter().take(MOST_RANGES).cloned().collect::<Vec<_>>().join(", ");
        let more = progress.missing.len().saturating_sub(MOST_RANGES);
        let more = if more > 0 { format!(" and {more} more ranges") } else { String::new() };
        let _ = writeln!(text, "  missing: {} cases, {shown}{more}", progress.missing_count);
    } else {
        let _ = writeln!(text, "  complete: congruent sweep merge {folder}");
    }
    text
}
