//! Which cases: a range, a shard, those that are missing.

use congruent_input::Diagnostic;

use crate::codes;

/// Cases from the first to before the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct CaseRange {
    /// The first case.
    pub first: u64,
    /// The case after the last one.
    pub end: u64,
}

impl CaseRange {
    /// All cases of a plan.
    pub fn all(cases: u64) -> Self {
        Self { first: 0, end: cases }
    }

    /// A range that is written as `A..B`, of a plan with so many cases.
    ///
    /// # Errors
    /// It is none, or not of the plan.
    ///
    /// # Examples
    /// ```
    /// use congruent_sweep::store::CaseRange;
    /// assert_eq!(CaseRange::parse("10..20", 100)?, CaseRange { first: 10, end: 20 });
    /// assert!(CaseRange::parse("90..120", 100).is_err());
    /// # Ok::<(), congruent_input::Diagnostic>(())
    /// ```
    pub fn parse(text: &str, cases: u64) -> Result<Self, Diagnostic> {
        let parts = text.split_once("..").and_then(|(first, end)| {
            Some(Self { first: first.trim().parse().ok()?, end: end.trim().parse().ok()? })
        });
        parts.filter(|range| range.first < range.end && range.end <= cases).ok_or_else(|| {
            let message = format!("--cases {text} are no cases of the plan, which has 0..{cases}");
            Diagnostic::error(codes::sweep::RANGE, message).with_help("--cases A..B is from A to before B")
        })
    }

    /// Part `I` of `N`, counted from 1 and written as `I/N`: parts differ by one case at most.
    ///
    /// # Errors
    /// It is no part.
    ///
    /// # Panics
    /// Never: a part of the cases has no more than all.
    ///
    /// # Examples
    /// ```
    /// use congruent_sweep::store::CaseRange;
    /// assert_eq!(CaseRange::shard("1/3", 10)?, CaseRange { first: 0, end: 3 });
    /// assert_eq!(CaseRange::shard("3/3", 10)?, CaseRange { first: 6, end: 10 });
    /// # Ok::<(), congruent_input::Diagnostic>(())
    /// ```
    pub fn shard(text: &str, cases: u64) -> Result<Self, Diagnostic> {
        let parts: Option<(u64, u64)> = text
            .split_once('/')
            .and_then(|(at, of)| Some((at.trim().parse().ok()?, of.trim().parse().ok()?)));
        let Some((at, of)) = parts.filter(|(at, of)| (1..=*of).contains(at)) else {
            let message = format!("--shard {text} is no part");
            return Err(Diagnostic::error(codes::sweep::RANGE, message)
                .with_help("--shard I/N is part I of N, from 1/N to N/N"));
        };
        let bound = |part: u64| {
            // 128 bits, since the product of two counts may exceed 64.
            let bound = u128::from(cases) * u128::from(part) / u128::from(of);
            u64::try_from(bound).expect("at most the number of cases")
        };
        Ok(Self { first: bound(at - 1), end: bound(at) })
    }

    /// Number of cases.
    pub fn count(self) -> u64 {
        self.end - self.first
    }

    /// Whether a case is one of them.
    pub fn contains(self, case: u64) -> bool {
        (self.first..self.end).contains(&case)
    }
}

impl std::fmt::Display for CaseRange {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{}..{}", self.first, self.end)
    }
}

/// The cases of a range that are not among `known`, which ascend, as ranges.
pub fn missing(range: CaseRange, known: impl IntoIterator<Item = u64>) -> Vec<CaseRange> {
    let mut missing = Vec::new();
    let mut first = range.first;
    for case in known.into_iter().filter(|&case| range.contains(case)) {
        if case > first {
            missing.push(CaseRange { first, end: case });
        }
        first = case + 1;
    }
    if first < range.end {
        missing.push(CaseRange { first, end: range.end });
    }
    missing
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_all_cases_once() {
        for (cases, of) in [(10, 3), (3, 10), (1_000_003, 7), (1, 1)] {
            let shards: Vec<CaseRange> =
                (1..=of).map(|at| CaseRange::shard(&format!("{at}/{of}"), cases).unwrap()).collect();
            assert_eq!((shards[0].first, shards[shards.len() - 1].end), (0, cases));
            assert!(shards.windows(2).all(|pair| pair[0].end == pair[1].first));
        }
        for wrong in ["0/3", "4/3", "1", "a/b", "1/0"] {
            assert!(CaseRange::shard(wrong, 10).is_err(), "{wrong}");
        }
        for wrong in ["5..5", "5..11", "..3", "7..3", "x"] {
            assert!(CaseRange::parse(wrong, 10).is_err(), "{wrong}");
        }
    }

    #[test]
    fn what_is_missing_is_between_and_behind_what_is_known() {
        let ranges = |pairs: &[(u64, u64)]| -> Vec<CaseRange> {
            pairs.iter().map(|&(first, end)| CaseRange { first, end }).collect()
        };
        let all = CaseRange { first: 2, end: 10 };
        assert_eq!(missing(all, [0, 3, 4, 8]), ranges(&[(2, 3), (5, 8), (9, 10)]));
        assert_eq!(missing(all, []), ranges(&[(2, 10)]));
        assert_eq!(missing(all, 0..12), ranges(&[]));
    }
}
