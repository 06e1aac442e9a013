//! What changes in a file, as a unified diff.

use std::{fmt::Write, ops::Range};

use congruent::input::ChangedLines;

/// Lines around a change that are shown.
const CONTEXT: usize = 2;

/// The difference of a text from what it becomes; empty if nothing changes.
pub(super) fn unified(name: &str, text: &str, changed: &[ChangedLines]) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let mut diff = String::new();
    if changed.is_empty() {
        return diff;
    }
    let _ = writeln!(diff, "--- {name}\n+++ {name}");
    let mut grown = 0_isize;
    for hunk in hunks(changed, lines.len()) {
        let before = hunk.lines.len();
        let (mut body, mut after, mut at) = (String::new(), 0, hunk.lines.start);
        let mut line = |sign: char, line: &str| {
            let _ = writeln!(body, "{sign}{line}");
            after += usize::from(sign != '-');
        };
        for change in &changed[hunk.changes] {
            let replaced = change.from_line - 1..change.to_line;
            lines[at..replaced.start].iter().for_each(|kept| line(' ', kept));
            lines[replaced.clone()].iter().for_each(|old| line('-', old));
            change.text.lines().for_each(|new| line('+', new));
            at = replaced.end;
        }
        lines[at..hunk.lines.end].iter().for_each(|kept| line(' ', kept));
        let start = hunk.lines.start + 1;
        let moved = start.saturating_add_signed(grown);
        let _ = write!(diff, "@@ -{start},{before} +{moved},{after} @@\n{body}");
        grown += after.cast_signed() - before.cast_signed();
    }
    diff
}

/// Changes that share their context.
struct Hunk {
    /// Their lines with the context, from 0.
    lines: Range<usize>,
    changes: Range<usize>,
}

fn hunks(changed: &[ChangedLines], count: usize) -> Vec<Hunk> {
    let mut hunks: Vec<Hunk> = Vec::new();
    for (at, change) in changed.iter().enumerate() {
        let start = (change.from_line - 1).saturating_sub(CONTEXT);
        let end = (change.to_line + CONTEXT).min(count);
        match hunks.last_mut() {
            Some(last) if start <= last.lines.end => {
                last.lines.end = end;
                last.changes.end = at + 1;
            }
            _ => hunks.push(Hunk { lines: start..end, changes: at..at + 1 }),
        }
    }
    hunks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(from_line: usize, to_line: usize, text: &str) -> ChangedLines {
        ChangedLines { from_line, to_line, text: text.to_owned() }
    }

    #[test]
    fn near_changes_share_a_hunk_and_numbers_count_what_was_added() {
        let line = |line: usize| format!("l{line}\n");
        let text: String = (1..=20).map(line).collect();
        let diff = unified("a", &text, &[change(2, 2, "x\ny"), change(4, 4, "z"), change(15, 16, "w")]);
        assert_eq!(
            diff,
            "--- a\n+++ a\n@@ -1,6 +1,7 @@\n l1\n-l2\n+x\n+y\n l3\n-l4\n+z\n l5\n l6\n\
             @@ -13,6 +14,5 @@\n l13\n l14\n-l15\n-l16\n+w\n l17\n l18\n"
        );
        assert_eq!(unified("a", &text, &[]), "");
    }
}
