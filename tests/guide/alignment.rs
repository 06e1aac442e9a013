//! Lines that a page shows against lines that a command printed. A line `...` stands for any number of lines; blank lines,
//! numbers of spaces and what rounding decides do not count.

use regex_lite::Regex;

/// What machines may disagree on, and what is compared in its place.
const ROUNDING: [(&str, &str); 8] = [
    (r"\b\d(\.\d+)?e-[123]\d\b|\b0\.0+e0\b", "<rounding>"),
    (r"(<rounding> (?:m|rad) +at )\S+", "$1<place>"),
    (r"\([\d.]+ s\)", "(<time>)"), // of an extreme that lasts
    (r"\b\d+\.\d{12,}(?:e-?\d+)?", "<digits>"),
    (r"\b(?:[0-9a-f]{64}|[0-9a-f]{16})\b", "<hash>"),
    (r"\b\d+ bytes", "<size> bytes"),
    (r"-(0(?:\.0+)?)([^.\d]|$)", "$1$2"),
    (r"[\s─]+", " "),
];

/// A line without what machines may disagree on; empty if nothing is left.
fn plain(line: &str) -> String {
    let mut plain = line.trim().to_owned();
    for (pattern, word) in ROUNDING {
        plain = Regex::new(pattern).unwrap().replace_all(&plain, word).into_owned();
    }
    plain.trim().to_owned()
}

fn is_gap(line: &str) -> bool {
    line.trim() == "..."
}

/// The lines of a text that count.
fn lines(text: &str) -> Vec<&str> {
    text.lines().filter(|line| !line.trim().is_empty()).collect()
}

/// Whether what is shown was printed, in this order and without gaps that are not shown.
pub(crate) fn compare(shown: &[String], printed: &str) -> Result<(), String> {
    if shown.is_empty() {
        return Ok(());
    }
    let printed_lines: Vec<String> = lines(printed).into_iter().map(plain).collect();
    let shown: Vec<&String> = shown.iter().filter(|line| !line.trim().is_empty()).collect();
    let mut at = 0;
    let mut may_skip = false;
    for segment in shown.split(|line| is_gap(line)) {
        let wanted: Vec<String> = segment.iter().map(|line| plain(line)).collect();
        let starts = if may_skip { at..=printed_lines.len() } else { at..=at };
        let found = starts.into_iter().find(|&start| printed_lines[start..].starts_with(&wanted));
        let first = segment.first().map_or("", |line| line.trim_end());
        let Some(start) = found else {
            return Err(format!("is not printed, from: {first}\nprinted:\n{printed}"));
        };
        at = start + wanted.len();
        may_skip = true;
    }
    let ends_open = shown.last().is_some_and(|line| is_gap(line));
    if at == printed_lines.len() || ends_open || ends_with(&shown, &printed_lines) {
        return Ok(());
    }
    Err(format!("more is printed than shown, from: {}\nprinted:\n{printed}", printed_lines[at]))
}

/// Whether the last segment is what is printed last, of several places that it could be at.
fn ends_with(shown: &[&String], printed: &[String]) -> bool {
    let mut segments = shown.rsplit(|line| is_gap(line));
    let last: Vec<String> = segments.next().unwrap_or_default().iter().map(|line| plain(line)).collect();
    segments.next().is_some() && printed.ends_with(&last)
}

/// The lines to show now: those that are most like the ones that are shown, or all if none is left out.
pub(crate) fn updated(shown: &[String], printed: &str) -> String {
    let printed: Vec<&str> = lines(printed);
    if !shown.iter().any(|line| is_gap(line)) {
        return printed.iter().flat_map(|line| [line.trim_end(), "\n"]).collect();
    }
    let mut text = String::new();
    let mut next = 0;
    for line in shown.iter().filter(|line| !is_gap(line) && !line.trim().is_empty()) {
        let by_likeness =
            |one: &usize, two: &usize| alike(line, printed[*one]).total_cmp(&alike(line, printed[*two]));
        // Of equals the first.
        let Some(best) = (next..printed.len()).rev().max_by(by_likeness) else { break };
        if alike(line, printed[best]) < LIKE {
            continue;
        }
        if best > next {
            text.push_str("...\n");
        }
        text.push_str(printed[best].trim_end());
        text.push('\n');
        next = best + 1;
    }
    if next < printed.len() {
        text.push_str("...\n");
    }
    text
}

/// Lines with a smaller share of words in common are different ones. No unit; kind: choice.
const LIKE: f64 = 0.3;

/// The share of words that two lines have in common.
fn alike(one: &str, other: &str) -> f64 {
    let [one, other] = [one, other].map(|line| line.split_whitespace().collect::<Vec<_>>());
    let common = one.iter().filter(|word| other.contains(word)).count();
    let count = |number: usize| f64::from(u32::try_from(number).unwrap());
    count(2 * common) / count(one.len() + other.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> Vec<String> {
        text.lines().map(|line| format!("{line}\n")).collect()
    }

    #[test]
    fn gaps_are_where_they_are_shown() {
        let printed = "one\ntwo 1.2e-15 m at tool\n\nthree\nfour\n";
        for right in [
            "one\n...",
            "...\ntwo 3.4e-16 m at tip\n...\nfour",
            "one\ntwo 1e-12 m at tip\nthree\nfour",
            "...\nfour",
        ] {
            assert_eq!(compare(&shown(right), printed), Ok(()), "{right}");
        }
        for wrong in
            ["two\n...", "one", "...\none\n...\nthree", "...\ntwo", "one\n...\nfive", "one\nthree\n..."]
        {
            assert!(compare(&shown(wrong), printed).is_err(), "{wrong}");
        }
    }

    #[test]
    fn an_update_keeps_the_choice_of_lines() {
        let printed = "mass is 2 kg\nmore\nmass is 3 kg of 4\nlast\n";
        assert_eq!(
            updated(&shown("...\nmass is 3.5 kg of 4\n..."), printed),
            "...\nmass is 3 kg of 4\n...\n"
        );
        assert_eq!(updated(&shown("mass is 9 kg"), printed), printed);
    }
}
