//! What `congruent compare` prints of two runs.

use std::fmt::Write;

use serde_json::Value;

use crate::{
    RunComparison,
    input::{
        display::{counted, quantity},
        visible,
    },
    results::comparison::{ComparedFile, FileComparison, SeriesDifference, ValueDifference},
};
use congruent_text::{
    TextOptions,
    layout::{Table, wrapped},
};

/// Most series, names and statements that are shown to people.
const MOST_SHOWN: usize = 20;

/// What `congruent compare` prints of two runs: whether they are the same, and the first and the worst difference of each
/// series.
pub fn comparison_text(comparison: &RunComparison, options: &TextOptions) -> String {
    let mut text = String::new();
    let RunComparison { a, b, tolerance, same, files, not_compared, .. } = comparison;
    let within = if *tolerance > 0.0 { format!(" within {tolerance:?}") } else { String::new() };
    let answer = match (*same, comparison.exit_code) {
        (true, 0) => format!("the same{within}"),
        (true, _) => "nothing was compared".to_owned(),
        (false, _) => format!("different{}", first_in_time(files)),
    };
    let _ = writeln!(text, "{answer}\nA {a}\nB {b}");
    for file in files {
        described(&mut text, file, options);
    }
    for statement in not_compared {
        let _ = writeln!(text, "{statement}: not compared");
    }
    text
}

fn described(text: &mut String, file: &FileComparison, options: &TextOptions) {
    let FileComparison { kind, same, compared, statements, first, series, only_in_a, only_in_b } = file;
    let (one, what) = if *kind == ComparedFile::Report { ("value", "values") } else { ("series", "series") };
    if *same {
        let _ = writeln!(text, "{kind}: {compared} {what} are the same");
        return;
    }
    let _ = writeln!(text, "{kind}: {} of {compared} {what} differ", series.len());
    for statement in statements.iter().take(MOST_SHOWN) {
        let _ = writeln!(text, "  {}", visible(statement));
    }
    // Joint positions of a report are those of worst values, which come first in time by chance.
    if let Some(first) = first.as_ref().filter(|first| *kind != ComparedFile::Report || first.joint.is_none())
    {
        let _ = writeln!(text, "  first{}", in_words(first, series));
    }
    let (of_moments, others): (Vec<_>, Vec<_>) =
        series.iter().partition(|series| *kind == ComparedFile::Report && series.series.contains(".q."));
    let worst = rows(&others);
    if !worst.is_empty() {
        let mut table = Table::headed(["differs", "first at", "values", "worst at", "difference"]);
        for row in worst {
            table.row(row);
        }
        table.write(text, options.columns);
    }
    if others.len() > MOST_SHOWN {
        let _ = writeln!(text, "  and {} more", others.len() - MOST_SHOWN);
    }
    if !of_moments.is_empty() {
        let joints = counted(of_moments.len(), "joint position");
        let _ = writeln!(text, "  and {joints} at these values, which --format json lists");
    }
    for (side, only) in [("A", only_in_a), ("B", only_in_b)] {
        if !only.is_empty() {
            let names = if only.len() > MOST_SHOWN { groups(only) } else { only.clone() };
            let of = format!("{} {}", only.len(), if only.len() == 1 { one } else { what });
            let _ = write!(text, "  only in {side}: {of}\n{}", wrapped(&visible(&names.join(", "))));
        }
    }
}

/// Names by the two parts that they begin with, each with how many there are: `checks.10 (16)`.
fn groups(names: &[String]) -> Vec<String> {
    let group = |name: &str| -> String {
        let name = name.trim_start_matches('/');
        let parts: Vec<&str> = name.split(['.', '/']).take(2).collect();
        parts.join(if name.contains('/') { "/" } else { "." })
    };
    let mut counts: Vec<(String, usize)> = Vec::new();
    for name in names {
        let group = group(name);
        match counts.iter_mut().find(|(known, _)| *known == group) {
            Some((_, count)) => *count += 1,
            None => counts.push((group, 1)),
        }
    }
    counts.into_iter().map(|(group, count)| format!("{group} ({count})")).collect()
}

/// The first difference in time of all files; values of a report have only the times of its worst values.
fn first_in_time(files: &[FileComparison]) -> String {
    let timed = files.iter().filter(|file| file.kind != ComparedFile::Report);
    let firsts = timed.filter_map(|file| {
        let first = file.first.as_ref()?;
        Some((first.time_s?, first, file))
    });
    let first = firsts.min_by(|(a, ..), (b, ..)| a.total_cmp(b));
    first.map_or_else(String::new, |(_, first, file)| format!(", first{}", in_words(first, &file.series)))
}

/// A difference with its time: ` at 0.01 s: elbow_joint.q_rad is 1 in A and 2 in B, 1 rad apart`.
fn in_words(difference: &ValueDifference, series: &[SeriesDifference]) -> String {
    let ValueDifference { series: name, label, time_s, a, b, difference, .. } = difference;
    let time = time_s.map_or_else(String::new, |time_s| format!(" at {}", moment(time_s)));
    let unit = series.iter().find(|series| series.series == *name).map_or("", |series| series.unit);
    let apart =
        difference.map_or_else(String::new, |apart| format!(", {} apart", quantity(apart.abs(), unit)));
    let [a, b] = pair([a, b], unit);
    let name = label.as_ref().unwrap_or(name);
    format!("{time}: {} is {a} in A and {b} in B{apart}", visible(name))
}

/// The worst difference of each series, joints first.
fn rows(series: &[&SeriesDifference]) -> Vec<[String; 5]> {
    let time = |difference: &Option<ValueDifference>| {
        let time_s = difference.as_ref().and_then(|difference| difference.time_s);
        time_s.map_or_else(|| "-".to_owned(), moment)
    };
    let row = |series: &&SeriesDifference| {
        let SeriesDifference { series: name, unit, compared, differing, only_in_a, only_in_b, first, worst } =
            series;
        let apart = worst.as_ref().map_or_else(
            || format!("{only_in_a} only in A, {only_in_b} only in B"),
            |worst| match worst.difference {
                Some(apart) => quantity(apart.abs(), unit),
                None => format!("{} and {}", shown(&worst.a), shown(&worst.b)),
            },
        );
        let label = worst.as_ref().and_then(|worst| worst.label.as_ref());
        [
            visible(label.unwrap_or(name)).into_owned(),
            time(first),
            format!("{differing} of {compared}"),
            time(worst),
            apart,
        ]
    };
    // Poses and errors follow from the joints.
    let has_joint =
        |series: &&&SeriesDifference| series.first.as_ref().is_some_and(|first| first.joint.is_some());
    let joints = series.iter().filter(has_joint);
    joints.chain(series.iter().filter(|series| !has_joint(series))).take(MOST_SHOWN).map(row).collect()
}

/// A time without the rounding of many steps added up, which starts far below a nanosecond.
fn moment(time_s: f64) -> String {
    const PARTS: f64 = 1e9;
    format!("{:?} s", (time_s * PARTS).round() / PARTS)
}

/// Two values in engineering units, or with as many digits as show the difference.
fn pair(values: [&Value; 2], unit: &str) -> [String; 2] {
    let [Some(a), Some(b)] = values.map(Value::as_f64) else { return values.map(shown) };
    if unit.is_empty() {
        return values.map(shown);
    }
    let short = [a, b].map(|value| quantity(value, unit));
    if short[0] == short[1] { distinct([a, b]).map(|value| format!("{value} {unit}")) } else { short }
}

/// Two values with as few digits as show that they differ.
fn distinct(values: [f64; 2]) -> [String; 2] {
    /// Significant digits that show any difference of two values of an `f64`.
    const ALL: usize = 17;
    let rounded = |digits: usize| {
        values.map(|value| {
            let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
            format!("{rounded:?}")
        })
    };
    let mut shown = (4..=ALL).map(rounded);
    shown.find(|[a, b]| a != b).unwrap_or_else(|| rounded(ALL))
}

/// A value with all its digits.
fn shown(value: &Value) -> String {
    match value {
        Value::Null => "missing".to_owned(),
        Value::String(text) => visible(text).into_owned(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_names_are_counted_by_their_beginnings() {
        let names =
            ["checks.1.status", "checks.1.samples", "checks.2.status", "exit_code"].map(str::to_owned);
        assert_eq!(groups(&names), ["checks.1 (2)", "checks.2 (1)", "exit_code (1)"]);
        assert_eq!(groups(&["/joint/effort/elbow".to_owned()]), ["joint/effort (1)"]);
    }

    #[test]
    fn values_have_the_digits_that_show_their_difference() {
        let near = [-1.547_394_486e-6, -1.547_522_216e-6];
        assert_eq!(distinct(near), ["-1.547e-6", "-1.548e-6"]);
        assert_eq!(distinct([0.25, 0.250_000_1]), ["0.25", "0.2500001"]);
    }

    #[test]
    fn times_are_printed_without_the_rounding_of_a_sum() {
        assert_eq!([1.1 + 2.2, 0.0, 1e-6].map(moment), ["3.3 s", "0.0 s", "1e-6 s"]);
    }
}
