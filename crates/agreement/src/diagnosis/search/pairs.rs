//! Two hypotheses together.

use crate::diagnosis::{fit::hypothesis_fit::HypothesisFit, thresholds::MAX_IN_PAIRS};

use super::{ExplanationSearch, is_same};

impl ExplanationSearch<'_> {
    /// The hypotheses to try in pairs: those with the smallest norms alone; of edits with the same effect
    /// only the first.
    fn pair_candidates<'a>(&self, singles: &'a [HypothesisFit]) -> Vec<&'a HypothesisFit> {
        let mut effects: Vec<Vec<f64>> = Vec::new();
        let is_new = |fit: &&HypothesisFit| {
            if !self.context.hypotheses[fit.hypotheses[0]].free.is_empty() {
                return true;
            }
            let effect = self.difference(&fit.corrected);
            let is_new = !effects.iter().any(|known| is_same(known, &effect));
            effects.push(effect);
            is_new
        };
        let mut best: Vec<&HypothesisFit> = singles.iter().filter(is_new).collect();
        best.sort_by(|a, b| a.norm.total_cmp(&b.norm));
        best.truncate(MAX_IN_PAIRS);
        best.sort_by_key(|fit| fit.hypotheses[0]);
        best
    }

    /// Two hypotheses together, for all candidates.
    pub(super) fn pairs(&self, singles: &[HypothesisFit]) -> Vec<HypothesisFit> {
        let best = self.pair_candidates(singles);
        let mut fits = Vec::new();
        for (at, second) in best.iter().enumerate() {
            for first in &best[..at] {
                let [a, b] = [first, second].map(|fit| &self.context.hypotheses[fit.hypotheses[0]]);
                if a.free.iter().any(|parameter| b.free.contains(parameter)) {
                    continue;
                }
                fits.push(self.pair(first, second));
                // The order of two edits of one place matters.
                if a.edit.is_some() && b.edit.is_some() {
                    fits.push(self.pair(second, first));
                }
            }
        }
        let equivalent = self.equivalent_pairs(singles, &fits);
        fits.extend(equivalent);
        fits
    }

    /// The fit of two hypotheses together, given the fits of each alone.
    fn pair(&self, first: &HypothesisFit, second: &HypothesisFit) -> HypothesisFit {
        let [a, b] = [first, second].map(|fit| self.context.starts(fit));
        let unchanged = |fit: &HypothesisFit| vec![0.0; fit.changes.len()];
        let with_a = a.into_iter().map(|start| [start, unchanged(second)].concat());
        let with_b = b.into_iter().map(|start| [unchanged(first), start].concat());
        let starts: Vec<Vec<f64>> = with_a.chain(with_b).collect();
        self.context.fit([&first.hypotheses[..], &second.hypotheses[..]].concat(), &starts)
    }

    /// For each pair that reaches the tolerance, the pairs with other edits of the same effect.
    fn equivalent_pairs(&self, singles: &[HypothesisFit], pairs: &[HypothesisFit]) -> Vec<HypothesisFit> {
        let effects: Vec<Vec<f64>> = singles.iter().map(|fit| self.difference(&fit.corrected)).collect();
        let same = |hypothesis: usize| -> Vec<&HypothesisFit> {
            let Some(at) = singles.iter().position(|fit| fit.hypotheses[0] == hypothesis) else {
                return Vec::new();
            };
            let is_edit = |fit: &HypothesisFit| self.context.hypotheses[fit.hypotheses[0]].free.is_empty();
            let is_same = |other: &usize| {
                *other == at
                    || (is_edit(&singles[at])
                        && is_edit(&singles[*other])
                        && is_same(&effects[*other], &effects[at]))
            };
            (0..singles.len()).filter(is_same).map(|other| &singles[other]).collect()
        };
        let mut fits = Vec::new();
        for pair in pairs.iter().filter(|pair| self.accepts(pair)) {
            let [firsts, seconds] = [same(pair.hypotheses[0]), same(pair.hypotheses[1])];
            let all = firsts.iter().flat_map(|first| seconds.iter().map(move |second| (first, second)));
            let others = all
                .filter(|(first, second)| [first.hypotheses[0], second.hypotheses[0]] != pair.hypotheses[..]);
            fits.extend(others.map(|(first, second)| self.pair(first, second)));
        }
        fits
    }
}
