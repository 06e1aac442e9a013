//! Pairs of links and obstacles that are chosen or ignored by their names.

use congruent_input::{Diagnostic, known_names};

use crate::codes;

/// Pairs by names of links and obstacles. `*` matches any characters; the order of the two names does not matter.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PairNames {
    /// Only these pairs are evaluated; all pairs if the list is empty.
    pub pairs: Vec<[String; 2]>,
    /// These pairs are ignored.
    pub ignore: Vec<[String; 2]>,
}

/// An entry of `pairs` or `ignore` that is wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct PairFault {
    /// The list that the entry is in: `pairs` or `ignore`.
    pub key: &'static str,
    /// Index of the entry in that list, from 0.
    pub entry: usize,
    /// The error, without a place in a file: the caller knows the file.
    pub diagnostic: Diagnostic,
}

impl PairNames {
    /// Whether a pair is evaluated: chosen, and not ignored.
    pub fn is_evaluated(&self, pair: [&str; 2]) -> bool {
        (self.pairs.is_empty() || self.pairs.iter().any(|entry| is_named(entry, pair)))
            && !self.is_ignored(pair)
    }

    /// Whether a pair is ignored by its name.
    pub fn is_ignored(&self, pair: [&str; 2]) -> bool {
        self.ignore.iter().any(|entry| is_named(entry, pair))
    }

    /// Checks that the names are those of `subjects`, that no entry is in both lists, and that every entry of `pairs`
    /// matches a measured pair: a check of a pair that is never evaluated would always pass.
    ///
    /// # Errors
    /// The first entry that is wrong.
    pub fn examine(&self, subjects: &[&str], measured: &[[&str; 2]]) -> Result<(), Box<PairFault>> {
        // Names first: a misspelt name would be reported as a pair that is not measured, which sends the user to the
        // SRDF.
        let lists = [("pairs", &self.pairs), ("ignore", &self.ignore)];
        for (key, list) in lists {
            for (entry, [a, b]) in list.iter().enumerate() {
                let unknown =
                    [a, b].into_iter().find(|name| !subjects.iter().any(|known| matches(name, known)));
                if let Some(name) = unknown {
                    let message = format!("no link or obstacle is named \"{name}\"");
                    let help = known_names(name, "links and obstacles", subjects.iter().copied());
                    let diagnostic =
                        Diagnostic::error(codes::clearance::UNKNOWN_NAME, message).with_help(help);
                    return Err(Box::new(PairFault { key, entry, diagnostic }));
                }
            }
        }
        for (entry, [a, b]) in self.pairs.iter().enumerate() {
            // Only equal names in either order; overlapping patterns are meant as "all of these, except those".
            let fault = if self.ignore.iter().any(|[c, d]| (a, b) == (c, d) || (a, b) == (d, c)) {
                let message = format!("the pair of \"{a}\" and \"{b}\" is in `pairs` and in `ignore`");
                Diagnostic::error(codes::clearance::PAIR_IN_BOTH, message)
                    .with_help("remove it from one of them")
            } else if measured.iter().any(|&pair| is_named(&[a.clone(), b.clone()], pair)) {
                continue;
            } else {
                let message = format!("the distance of \"{a}\" and \"{b}\" is not measured");
                Diagnostic::error(codes::clearance::PAIR_NOT_MEASURED, message).with_help(
                    "pairs that are not measured: links without a collision shape, links on the same or on \
                     neighbouring moving bodies, and pairs that the SRDF disables",
                )
            };
            return Err(Box::new(PairFault { key: "pairs", entry, diagnostic: fault }));
        }
        // No single entry is at fault: the last one is where the list ends.
        if let Some(entry) = self.ignore.len().checked_sub(1)
            && !measured.is_empty()
            && !measured.iter().any(|&pair| self.is_evaluated(pair))
        {
            let diagnostic =
                Diagnostic::error(codes::clearance::NO_PAIR, "`ignore` excludes every measured pair")
                    .with_help(
                        "a check without a pair would always pass: ignore fewer pairs, or remove the check",
                    );
            return Err(Box::new(PairFault { key: "ignore", entry, diagnostic }));
        }
        Ok(())
    }

    /// Entries of `ignore` that match no measured pair.
    pub fn without_effect<'a>(
        &'a self,
        measured: impl Iterator<Item = [&'a str; 2]> + Clone + 'a,
    ) -> impl Iterator<Item = &'a [String; 2]> + 'a {
        self.ignore.iter().filter(move |entry| !measured.clone().any(|pair| is_named(entry, pair)))
    }
}

fn is_named([a, b]: &[String; 2], [first, second]: [&str; 2]) -> bool {
    (matches(a, first) && matches(b, second)) || (matches(a, second) && matches(b, first))
}

/// Whether `name` matches `pattern`, in which each `*` is any number of characters.
pub fn matches(pattern: &str, name: &str) -> bool {
    let Some((start, rest)) = pattern.split_once('*') else { return pattern == name };
    let Some(mut name) = name.strip_prefix(start) else { return false };
    let mut pieces: Vec<&str> = rest.split('*').collect();
    // The last piece has to be at the end: found greedily it could match too early. `ends_with` on the rest also
    // keeps it from overlapping the pieces before.
    let end = pieces.pop().unwrap_or_default();
    for piece in pieces {
        // Greedy is exact: the first match gives the longest rest of the name to the other pieces.
        let Some(at) = name.find(piece) else { return false };
        name = &name[at + piece.len()..];
    }
    name.ends_with(end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_stands_for_any_characters() {
        for (pattern, name, is_match) in [
            ("*", "wrist_1_link", true),
            ("wrist_*", "wrist_1_link", true),
            ("wrist_*", "forearm_link", false),
            ("*_link", "wrist_1_link", true),
            ("*_link", "tool0", false),
            ("w*_1_*k", "wrist_1_link", true),
            ("w*_3_*k", "wrist_1_link", false),
            ("wrist_1_link*", "wrist_1_link", true),
            ("**", "", true),
            ("a*a", "a", false),
            ("*ab*ab", "aab", false),
            ("*ab*ab", "abab", true),
            ("wrist", "wrist_1_link", false),
        ] {
            assert_eq!(matches(pattern, name), is_match, "{pattern} {name}");
        }
    }

    fn names(pairs: &[[&str; 2]], ignore: &[[&str; 2]]) -> PairNames {
        let owned = |list: &[[&str; 2]]| list.iter().map(|pair| pair.map(str::to_owned)).collect();
        PairNames { pairs: owned(pairs), ignore: owned(ignore) }
    }

    #[test]
    fn pairs_in_either_order() {
        assert!(names(&[], &[]).is_evaluated(["a", "b"]));
        assert!(names(&[["b", "a"]], &[]).is_evaluated(["a", "b"]));
        assert!(!names(&[["b", "a"]], &[]).is_evaluated(["a", "c"]));
        assert!(!names(&[], &[["b", "a"]]).is_evaluated(["a", "b"]));
        let around_table = names(&[["*", "table"]], &[["table", "base"]]);
        assert!(
            around_table.is_evaluated(["wrist", "table"]) && !around_table.is_evaluated(["base", "table"])
        );
    }

    #[test]
    fn faults_name_their_entry() {
        let (subjects, measured) = (["base", "wrist", "table"], [["wrist", "table"]]);
        for (found, key, entry, code) in [
            (names(&[["wrist", "table"], ["wirst", "table"]], &[]), "pairs", 1, "clearance::unknown_name"),
            (names(&[], &[["base", "chair*"]]), "ignore", 0, "clearance::unknown_name"),
            (names(&[["wrist", "table"]], &[["table", "wrist"]]), "pairs", 0, "clearance::pair_in_both"),
            (names(&[["wrist", "base"]], &[]), "pairs", 0, "clearance::pair_not_measured"),
        ] {
            let fault = found.examine(&subjects, &measured).unwrap_err();
            assert_eq!((fault.key, fault.entry, fault.diagnostic.code.name), (key, entry, code));
        }
        let nothing = names(&[], &[["*", "*"]]).examine(&subjects, &measured).unwrap_err();
        assert_eq!((nothing.key, nothing.diagnostic.code.name), ("ignore", "clearance::no_pair"));
        let fault = names(&[], &[["wirst", "table"]]).examine(&subjects, &measured).unwrap_err();
        assert!(fault.diagnostic.help.unwrap().contains("did you mean \"wrist\""));
        assert_eq!(names(&[["*", "table"]], &[["base", "table"]]).examine(&subjects, &measured), Ok(()));
    }

    #[test]
    fn ignoring_what_is_not_measured_has_no_effect() {
        let both = names(&[], &[["wrist", "table"], ["base", "table"]]);
        let idle: Vec<_> = both.without_effect([["wrist", "table"]].into_iter()).collect();
        assert_eq!(idle, [&["base".to_owned(), "table".to_owned()]]);
    }
}
