//! The content of a recording as people read it; its tables have 80 columns.

use std::fmt::Write;

use super::{layout::paragraph, options::TextOptions};
use congruent_input::{Quantity, SiUnit, display::quantity, serde_name};
use congruent_monitors::verdict::{Bound, Moment, Status};
use congruent_recording::{
    Basis, CheckSummary, Disagreement, Recheck, RecheckedCheck, RecheckedQuantity, RecordingSummary,
    TimelineSummary,
};
use congruent_results::report::{
    is_not_reached, not_finite_words, quantity_words, share_in_full, value_and_margin,
};

/// The property that is printed as the verdict.
const VERDICT: &str = "congruent/verdict";
/// The widest first column; a longer path has a line of its own.
const PATH_WIDTH: usize = 35;

/// What `congruent inspect` prints of a recording: the verdict, the file and its timelines, its content and properties (in full
/// if the options say so), then the checks.
pub fn recording_text(summary: &RecordingSummary, options: &TextOptions) -> String {
    let mut text = summary.headline() + "\n";
    let state = if summary.complete { "complete" } else { "incomplete" };
    let duration = summary.duration_s.map_or_else(|| "none".to_owned(), |seconds| quantity(seconds, "s"));
    let file = format!("{} bytes, {state}", summary.bytes);
    let inputs = inputs(summary);
    let heading: [(&str, &str); 5] = [
        ("application", &summary.application_id),
        ("recording", &summary.recording_id),
        ("file", &file),
        ("inputs", &inputs),
        ("duration", &duration),
    ];
    for (name, value) in heading {
        let _ = writeln!(text, "{name}: {value}");
    }
    if options.is_in_full {
        for (name, value) in summary.properties.iter().filter(|(name, _)| *name != VERDICT) {
            let _ = writeln!(text, "property {name}: {value}");
        }
    }
    for timeline in &summary.timelines {
        push_timeline(&mut text, timeline);
    }
    if options.is_in_full {
        push_entities(&mut text, summary);
        push_scalars(&mut text, summary);
    } else {
        let (entities, scalars) = (summary.entities.len(), summary.scalars.len());
        let _ = writeln!(text, "content: {entities} entities, {scalars} scalar series; --verbose lists them");
    }
    push_verdict(&mut text, summary);
    text
}

/// The checks, what is wrong with the file, and the verdict with its reason.
fn push_verdict(text: &mut String, summary: &RecordingSummary) {
    text.push('\n');
    let of_run = summary.run.iter().flat_map(|run| &run.checks).map(Some).chain(std::iter::repeat(None));
    for (check, of_run) in summary.checks.iter().zip(of_run) {
        push_check(text, check, of_run.and_then(|check| check.nearest_that_changes.as_ref()));
    }
    if let Some(recheck) = &summary.recheck {
        push_recheck(text, recheck);
    }
    for problem in &summary.problems {
        let _ = writeln!(text, "problem: {problem}");
    }
    if !summary.missing_results.is_empty() {
        let missing = summary.missing_results.join(", ");
        let _ =
            writeln!(text, "missing beside the recording: {missing}; its results are not compared in full");
    }
}

/// Whether the files of the run are as they were.
fn inputs(summary: &RecordingSummary) -> String {
    match (&summary.changed_inputs, &summary.report) {
        (Some(changed), _) if changed.is_empty() => "as in the run".to_owned(),
        (Some(changed), _) => changed.join("; "),
        (None, Some(_)) => "not compared: the scenario is missing or needs --allow".to_owned(),
        (None, None) => "unknown".to_owned(),
    }
}

/// A check; before the nearest distance, if that is constant, the nearest one that changes.
fn push_check(text: &mut String, check: &CheckSummary, changing: Option<&Moment>) {
    let _ = writeln!(text, "  {:10} {}", check.check, check.status);
    let mut quantities = check.quantities.iter();
    if let Some(moment) = changing
        && let Some(of) = quantities.next()
    {
        let limit = format!("{} {}", of.bound.words(), share_in_full(of.limit, of.unit));
        let [distance, constant] = [moment.value, of.worst].map(|value| quantity(value, of.unit.symbol()));
        let (words, pair) = (quantity_words(of.quantity), &moment.subject);
        let _ =
            writeln!(text, "    {words} {distance} at {pair} ({}), {limit}", quantity(moment.time_s, "s"));
        let pair = of.subject.as_deref().unwrap_or_default();
        let _ = writeln!(text, "    nearer, but constant in this run: {constant} at {pair}");
    }
    for of in quantities {
        let subject = of.subject.as_ref().map(|subject| format!(" at {subject}")).unwrap_or_default();
        let place = format!("{subject} ({})", quantity(of.worst_s, "s"));
        let limited = Limited { quantity: of.quantity, unit: of.unit, bound: of.bound, limit: of.limit };
        let limit = share_in_full(of.limit, of.unit);
        let _ = writeln!(text, "    {}", value_and_limit(limited, of.worst, &place, &limit));
    }
}

/// What a worst value is compared with.
#[derive(Clone, Copy)]
struct Limited {
    quantity: Quantity,
    unit: SiUnit,
    bound: Bound,
    limit: f64,
}

/// A worst value with its place and its limit, in the words of `run`.
fn value_and_limit(of: Limited, value: f64, place: &str, words_of_limit: &str) -> String {
    let Limited { quantity: name, unit, bound, limit } = of;
    let words = quantity_words(name);
    if let Some(margin) = value_and_margin(name, unit, bound, [value, limit]) {
        return margin + place;
    }
    let limit = format!("{} {words_of_limit}", bound.words());
    match name {
        Quantity::NotFiniteValues if value > 0.0 => not_finite_words(value) + place,
        Quantity::NotFiniteValues => not_finite_words(value),
        _ if is_not_reached(value, unit) => format!("{words} not reached{place}, {limit}"),
        _ => format!("{words} {}{place}, {limit}", quantity(value, unit.symbol())),
    }
}

fn push_recheck(text: &mut String, recheck: &Recheck) {
    let file = recheck.scenario.as_deref().unwrap_or("the scenario");
    let _ = writeln!(text, "\nchecked again with {file}");
    if !recheck.same_limits {
        let other = "limits or expectation differ from those of the run, so the verdict may differ";
        let _ = writeln!(text, "  {other}");
    }
    if recheck.instants == 0 {
        let _ = writeln!(text, "  the recording has no joint positions");
    } else if recheck.gap_s > 1.5 * recheck.step_s {
        let (gap, step) = (quantity(recheck.gap_s, "s"), quantity(recheck.step_s, "s"));
        let thinned = format!(
            "{} recorded samples, up to {gap} apart, of a run in steps of {step}: between two samples only \
             the worst value of a check is known",
            recheck.instants
        );
        let _ = writeln!(text, "  {thinned}");
    }
    for check in &recheck.checks {
        text.push_str(&rechecked_text(check));
    }
    for disagreement in &recheck.disagreements {
        let _ = writeln!(text, "  DISAGREES: {}", disagreement_sentence(disagreement));
    }
    for sample in &recheck.samples {
        let _ = writeln!(text, "  DISAGREES: {sample}");
    }
    let verdict = serde_name(&recheck.verdict);
    let agrees = recheck.disagreements.is_empty() && recheck.samples.is_empty();
    let compared = match (recheck.same_verdict, agrees) {
        (true, true) => "as in the run".to_owned(),
        (true, false) => "as in the run, but the series and the report disagree".to_owned(),
        (false, _) => format!("but {} in the run", recheck.recorded_verdict),
    };
    let _ = writeln!(text, "  verdict {verdict}, {compared}");
}

/// A check that was evaluated again: its result, then a line for each quantity.
pub fn rechecked_text(check: &RecheckedCheck) -> String {
    let basis = match check.basis {
        Basis::EveryStep => "from the worst values over every step",
        Basis::RecordedSamples => "from the recorded samples",
        Basis::Report if check.status == Status::Skipped => "there was nothing to check",
        _ if check.status == Status::Inconclusive => "too few samples were evaluated in the run",
        Basis::Report => "NOT fully evaluated again: in part from the report of the run",
    };
    let mut text = format!("  {:10} {:7} {basis}\n", check.check.word(), check.status.word());
    for of in &check.quantities {
        let report = if of.basis == Basis::Report { ", from the report only" } else { "" };
        let place = format!(" ({})", quantity(of.worst_s, "s"));
        let limited = Limited { quantity: of.quantity, unit: of.unit, bound: of.bound, limit: of.limit };
        let line = value_and_limit(limited, of.worst, &place, &limit(of));
        let _ = writeln!(text, "    {line}{report}");
    }
    text
}

/// The limit, and that of the run if it was another.
fn limit(of: &RecheckedQuantity) -> String {
    let shown = |limit: f64| share_in_full(limit, of.unit);
    let is_same = of.limit.to_bits() == of.recorded_limit.to_bits();
    let before = if is_same { String::new() } else { format!(" (in the run {})", shown(of.recorded_limit)) };
    format!("{}{before}", shown(of.limit))
}

/// A disagreement as a sentence.
pub fn disagreement_sentence(disagreement: &Disagreement) -> String {
    let Disagreement { check, line, quantity: name, unit, time_s, value, problem } = disagreement;
    let line = line.map(|line| format!(" (line {line})")).unwrap_or_default();
    let value = match (name, unit, time_s, value) {
        (Some(name), Some(unit), Some(time_s), Some(value)) => {
            format!(
                ", {}: {} at {}",
                quantity_words(*name),
                quantity(*value, unit.symbol()),
                quantity(*time_s, "s")
            )
        }
        _ => String::new(),
    };
    format!("{check}{line}{value} {problem}")
}

fn push_timeline(text: &mut String, timeline: &TimelineSummary) {
    let TimelineSummary { name, kind, first, last } = timeline;
    #[expect(clippy::cast_precision_loss, reason = "shown with a few digits")]
    let seconds = |nanoseconds: i64| nanoseconds as f64 * 1e-9;
    let _ = if *kind == "duration" {
        writeln!(text, "timeline {name}: {:.3} s to {:.3} s", seconds(*first), seconds(*last))
    } else {
        writeln!(text, "timeline {name}: {first} to {last}")
    };
}

/// The first column of a row: a path that is too long ends its line.
fn path_cell(path: &str, width: usize) -> String {
    if path.chars().count() > width { format!("{path}\n{:width$}", "") } else { format!("{path:width$}") }
}

fn width<'a>(paths: impl Iterator<Item = &'a String>) -> usize {
    paths.map(|path| path.chars().count()).max().unwrap_or(0).min(PATH_WIDTH)
}

fn push_entities(text: &mut String, summary: &RecordingSummary) {
    let width = width(summary.entities.iter().map(|entity| &entity.path));
    let _ = writeln!(text, "\n{:width$}  {:>7}  archetypes", "entity", "rows");
    for entity in &summary.entities {
        let archetypes = paragraph(&archetypes(&entity.components).join(", "), width + 11, width + 11);
        let _ = write!(text, "{}  {:>7}  ", path_cell(&entity.path, width), entity.rows);
        text.push_str(archetypes.trim_start());
        if archetypes.trim().is_empty() {
            text.truncate(text.trim_end().len());
            text.push('\n');
        }
    }
}

/// The archetypes of components that are sorted by name, each once.
fn archetypes(components: &[String]) -> Vec<&str> {
    let mut archetypes: Vec<_> =
        components.iter().map(|name| name.split(':').next().unwrap_or(name)).collect();
    archetypes.dedup();
    archetypes
}

fn push_scalars(text: &mut String, summary: &RecordingSummary) {
    let width = width(summary.scalars.iter().map(|scalar| &scalar.path));
    let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.3e}"));
    let _ =
        writeln!(text, "\n{:width$}  {:>7}  {:>10}  {:>10}  {:>10}", "scalar", "count", "min", "max", "last");
    for scalar in &summary.scalars {
        let [min, max, last] = [scalar.min, scalar.max, scalar.last].map(number);
        let path = path_cell(&scalar.path, width);
        let _ = writeln!(text, "{path}  {:>7}  {min:>10}  {max:>10}  {last:>10}", scalar.count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_that_is_too_long_has_a_line_of_its_own() {
        assert_eq!(path_cell("/short", 8), "/short  ");
        assert_eq!(path_cell("/much/longer", 8), "/much/longer\n        ");
    }
}
