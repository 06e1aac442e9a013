//! The pairs whose distance the checks of a scenario judge: what shows a smallest distance beside its limit shows that of these.

use congruent_proximity::{Clearance, Nearest, PairNames};
use congruent_scenario::Check;

/// The pairs that the checks `clearance` evaluate; without one, those of `contact`; without either, all that are measured.
#[derive(Debug, Clone, Default)]
pub struct JudgedPairs {
    rules: Vec<PairNames>,
    /// For each measured pair; empty before the first instant, since only then the pairs are known.
    is_judged: Vec<bool>,
    /// The nearest pair of the last instant, which is nearly always still the nearest.
    nearest: Option<usize>,
}

impl JudgedPairs {
    /// The pairs of the checks of a scenario.
    pub fn new(checks: &[Check]) -> Self {
        let clearance = |check: &Check| match check {
            Check::Clearance(check) => Some(names(&check.pairs, &check.ignore)),
            _ => None,
        };
        let contact = |check: &Check| match check {
            Check::Contact(check) => Some(names(&check.pairs, &check.ignore)),
            _ => None,
        };
        let mut rules: Vec<PairNames> = checks.iter().filter_map(clearance).collect();
        if rules.is_empty() {
            rules.extend(checks.iter().filter_map(contact));
        }
        Self { rules, ..Self::default() }
    }

    /// The smallest distance of a judged pair at this instant; `None` if there is none.
    pub fn nearest(&mut self, clearance: &mut Clearance) -> Option<Nearest> {
        self.choose(clearance);
        let is_judged = &self.is_judged;
        // The last nearest pair is measured first: it prunes all others. `next_up`, so that it is found again.
        let first_m = self.nearest.and_then(|pair| clearance.measure_below(pair, f64::INFINITY));
        let first_m = first_m.unwrap_or(f64::INFINITY);
        let nearest = clearance.nearest_of(first_m.next_up(), |pair, _| is_judged[pair]);
        self.nearest = nearest.map(|nearest| nearest.pair);
        nearest
    }

    /// Whether a check judges a pair, by its index; none before the first call of [`JudgedPairs::nearest`].
    pub fn contains(&self, pair: usize) -> bool {
        self.is_judged.get(pair).is_some_and(|is_judged| *is_judged)
    }

    fn choose(&mut self, clearance: &Clearance) {
        let count = clearance.pairs().len();
        if self.is_judged.len() == count {
            return;
        }
        let is_judged = |pair: usize| {
            self.rules.is_empty() || self.rules.iter().any(|rule| rule.is_evaluated(clearance.names(pair)))
        };
        self.is_judged = (0..count).map(is_judged).collect();
    }
}

fn names(pairs: &[[String; 2]], ignore: &[[String; 2]]) -> PairNames {
    PairNames { pairs: pairs.to_vec(), ignore: ignore.to_vec() }
}
