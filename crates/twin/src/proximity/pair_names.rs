//! Which pairs of links and obstacles are looked at, by their names.

use congruent_description::{Diagnostic, known_names};

/// Pairs by names of links and obstacles, in which `*` stands for any characters; the order of the two does not
/// matter.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PairNames {
    /// Only these pairs are looked at; all of them if there is none.
    pub pairs: Vec<[String; 2]>,
    /// These pairs are left out.
    pub ignore: Vec<[String; 2]>,
}

/// What is wrong with an entry.
#[derive(Debug, Clone, PartialEq)]
pub struct PairFault {
    /// The list that it is in.
    pub key: &'static str,
    /// Its number in that list, from 0.
    pub entry: usize,
    /// The fault, without a place.
    pub diagnostic: Diagnostic,
}

impl PairNames {
    /// Whether a pair is looked at.
    pub fn look_at(&self, pair: (&str, &str)) -> bool {
        (self.pairs.is_empty() || self.pairs.iter().any(|entry| is_named(entry, pair)))
            && !self.is_ignored(pair)
    }

    /// Whether a pair is left out by its name.
    pub fn is_ignored(&self, pair: (&str, &str)) -> bool {
        self.ignore.iter().any(|entry| is_named(entry, pair))
    }

    /// Whether the names are those of `subjects`, no entry is in both lists, and every entry of `pairs` has a
    /// pair that is measured: a check of a pair that is never looked at would always pass.
    ///
    /// # Errors
    /// The first entry that is wrong.
    pub fn examine(&self, subjects: &[&str], measured: &[(&str, &str)]) -> Result<(), Box<PairFault>> {
        let lists = [("pairs", &self.pairs), ("ignore", &self.ignore)];
        for (key, list) in lists {
            for (entry, [a, b]) in list.iter().enumerate() {
                let unknown =
                    [a, b].into_iter().find(|name| !subjects.iter().any(|known| matches(name, known)));
                if let Some(name) = unknown {
                    let message = format!("there is no link and no obstacle \"{name}\"");
                    let help = known_names(name, "links and obstacles", subjects.iter().copied());
                    let diagnostic = Diagnostic::error("clearance::unknown_name", message).with_help(help);
                    return Err(Box::new(PairFault { key, entry, diagnostic }));
                }
            }
        }
        for (entry, [a, b]) in self.pairs.iter().enumerate() {
            let fault = if self.ignore.iter().any(|[c, d]| (a, b) == (c, d) || (a, b) == (d, c)) {
                let message = format!("the pair of \"{a}\" and \"{b}\" is in `pairs` and in `ignore`");
                Diagnostic::error("clearance::pair_in_both", message).with_help("leave it out of one of them")
            } else if measured.iter().any(|&pair| is_named(&[a.clone(), b.clone()], pair)) {
                continue;
            } else {
                let message = format!("the distance of \"{a}\" and \"{b}\" is not measured");
                Diagnostic::error("clearance::pair_not_measured", message).with_help(
                    "left out are links without a collision shape, links of the same or of neighbouring moving \
                     bodies, and pairs that the SRDF disables",
                )
            };
            return Err(Box::new(PairFault { key: "pairs", entry, diagnostic: fault }));
        }
        if let Some(entry) = self.ignore.len().checked_sub(1)
            && !measured.is_empty()
            && !measured.iter().any(|&pair| self.look_at(pair))
        {
            let diagnostic = Diagnostic::error("clearance::no_pair", "`ignore` leaves no pair to look at")
                .with_help(
                    "a check that looks at nothing would always pass: leave out fewer pairs, or the check",
                );
            return Err(Box::new(PairFault { key: "ignore", entry, diagnostic }));
        }
        Ok(())
    }

    /// Entries of `ignore` that leave out no pair that is measured.
    pub fn without_effect<'a>(
        &'a self,
        measured: impl Iterator<Item = (&'a str, &'a str)> + Clone + 'a,
    ) -> impl Iterator<Item = &'a [String; 2]> + 'a {
        self.ignore.iter().filter(move |entry| !measured.clone().any(|pair| is_named(entry, pair)))
    }
}

fn is_named([a, b]: &[String; 2], (first, second): (&str, &str)) -> bool {
    (matches(a, first) && matches(b, second)) || (matches(a, second) && matches(b, first))
}

/// Whether `name` is `pattern`, in which each `*` stands for any characters or none.
pub(crate) fn matches(pattern: &str, name: &str) -> bool {
    let Some((start, rest)) = pattern.split_once('*') else { return pattern == name };
    let Some(mut name) = name.strip_prefix(start) else { return false };
    let mut pieces: Vec<&str> = rest.split('*').collect();
    let end = pieces.pop().unwrap_or_default();
    for piece in pieces {
        // The first place is as good as any: what follows has the more room.
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
        assert!(names(&[], &[]).look_at(("a", "b")));
        assert!(names(&[["b", "a"]], &[]).look_at(("a", "b")));
        assert!(!names(&[["b", "a"]], &[]).look_at(("a", "c")));
        assert!(!names(&[], &[["b", "a"]]).look_at(("a", "b")));
        let around_table = names(&[["*", "table"]], &[["table", "base"]]);
        assert!(around_table.look_at(("wrist", "table")) && !around_table.look_at(("base", "table")));
    }

    #[test]
    fn faults_name_their_entry() {
        let (subjects, measured) = (["base", "wrist", "table"], [("wrist", "table")]);
        for (found, key, entry, code) in [
            (names(&[["wrist", "table"], ["wirst", "table"]], &[]), "pairs", 1, "clearance::unknown_name"),
            (names(&[], &[["base", "chair*"]]), "ignore", 0, "clearance::unknown_name"),
            (names(&[["wrist", "table"]], &[["table", "wrist"]]), "pairs", 0, "clearance::pair_in_both"),
            (names(&[["wrist", "base"]], &[]), "pairs", 0, "clearance::pair_not_measured"),
        ] {
            let fault = found.examine(&subjects, &measured).unwrap_err();
            assert_eq!((fault.key, fault.entry, fault.diagnostic.code), (key, entry, code));
        }
        let nothing = names(&[], &[["*", "*"]]).examine(&subjects, &measured).unwrap_err();
        assert_eq!((nothing.key, nothing.diagnostic.code), ("ignore", "clearance::no_pair"));
        let fault = names(&[], &[["wirst", "table"]]).examine(&subjects, &measured).unwrap_err();
        assert!(fault.diagnostic.help.unwrap().contains("did you mean \"wrist\""));
        assert_eq!(names(&[["*", "table"]], &[["base", "table"]]).examine(&subjects, &measured), Ok(()));
    }

    #[test]
    fn ignoring_what_is_not_measured_has_no_effect() {
        let both = names(&[], &[["wrist", "table"], ["base", "table"]]);
        let idle: Vec<_> = both.without_effect([("wrist", "table")].into_iter()).collect();
        assert_eq!(idle, [&["base".to_owned(), "table".to_owned()]]);
    }
}
