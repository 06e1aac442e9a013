//! Two hypotheses together.

use crate::diagnosis::{fit::hypothesis_fit::HypothesisFit, thresholds::most_in_pairs};

use super::{ExplanationSearch, JudgedFits, is_same};

impl ExplanationSearch<'_> {
    /// The hypotheses to try in pairs: those with the smallest norms alone; of edits with the same effect
    /// only the first.
    fn pair_candidates<'a>(&self, singles: &'a [HypothesisFit]) -> Vec<&'a HypothesisFit> {
        let most = most_in_pairs(self.context.models.candidate.rows.len());
        let mut by_norm: Vec<&HypothesisFit> = singles.iter().collect();
        by_norm.sort_by(|a, b| a.norm.total_cmp(&b.norm));
        let mut best: Vec<&HypothesisFit> = Vec::new();
        let mut effects: Vec<Option<Vec<f64>>> = Vec::new();
        for fit in by_norm {
            let is_edit = self.context.hypotheses[fit.hypotheses[0]].free.is_empty();
            let effect = is_edit.then(|| self.difference(&self.context.corrected(fit)));
            let is_known = |known: &Option<Vec<f64>>| {
                known.as_ref().zip(effect.as_ref()).is_some_and(|(known, effect)| is_same(known, effect))
            };
            match effects.iter().position(is_known) {
                // Their norms differ by rounding, which must not decide.
                Some(at) if fit.hypotheses < best[at].hypotheses => best[at] = fit,
                Some(_) => {}
                None if best.len() == most => break,
                None => {
                    best.push(fit);
                    effects.push(effect);
                }
            }
        }
        // Back in the order of the catalogue: it decides between pairs of equal rank.
        best.sort_by_key(|fit| fit.hypotheses[0]);
        best
    }

    /// Two hypotheses together, for all candidates: the pairs that reach the tolerance, and the best of the others.
    pub(super) fn pairs(&self, singles: &[HypothesisFit]) -> JudgedFits {
        let best = self.pair_candidates(singles);
        let (mut accepted, mut others) = (Vec::new(), Vec::new());
        for (at, second) in best.iter().enumerate() {
            let pairs = best[..at].iter().flat_map(|first| self.pair_in_both_orders(first, second));
            let judged = self.judged(pairs.collect());
            accepted.extend(judged.accepted);
            others.extend(judged.others);
            // All of them would be gigabytes for a long chain.
            others = self.next_best(&others);
        }
        let equivalent = self.judged(self.equivalent_pairs(singles, &accepted));
        accepted.extend(equivalent.accepted);
        JudgedFits { accepted, others: [equivalent.others, others].concat() }
    }

    /// The fit of two hypotheses together, in both orders if that makes a difference; none if they fit the same
    /// parameter.
    fn pair_in_both_orders(&self, first: &HypothesisFit, second: &HypothesisFit) -> Vec<HypothesisFit> {
        let [a, b] = [first, second].map(|fit| &self.context.hypotheses[fit.hypotheses[0]]);
        // Two parameters that are one would make the normal equations singular.
        if a.free.iter().any(|parameter| b.free.contains(parameter)) {
            return Vec::new();
        }
        let mut fits = vec![self.pair(first, second)];
        // The order of two edits of one place matters.
        if a.edit.is_some() && b.edit.is_some() {
            fits.push(self.pair(second, first));
        }
        fits
    }

    /// The fit of two hypotheses together, given the fits of each alone.
    fn pair(&self, first: &HypothesisFit, second: &HypothesisFit) -> HypothesisFit {
        let [a, b] = [first, second].map(|fit| self.context.starts(fit));
        let unchanged = |fit: &HypothesisFit| vec![0.0; fit.changes.len()];
        // Each fit alone is a start for the pair, since one of the two faults often has nearly the right value by
        // itself. Starts of both together would multiply.
        let with_a = a.into_iter().map(|start| [start, unchanged(second)].concat());
        let with_b = b.into_iter().map(|start| [unchanged(first), start].concat());
        let starts: Vec<Vec<f64>> = with_a.chain(with_b).collect();
        self.context.fit([&first.hypotheses[..], &second.hypotheses[..]].concat(), &starts)
    }

    /// For each pair that reaches the tolerance, the pairs with other edits of the same effect.
    fn equivalent_pairs(&self, singles: &[HypothesisFit], accepted: &[HypothesisFit]) -> Vec<HypothesisFit> {
        if accepted.is_empty() {
            return Vec::new();
        }
        // `pair_candidates` has kept one edit of each effect; the others come back here, for the list of
        // explanations that cannot be distinguished.
        let effects: Vec<Vec<f64>> =
            singles.iter().map(|fit| self.difference(&self.context.corrected(fit))).collect();
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
        for pair in accepted {
            let [firsts, seconds] = [same(pair.hypotheses[0]), same(pair.hypotheses[1])];
            let all = firsts.iter().flat_map(|first| seconds.iter().map(move |second| (first, second)));
            let others = all
                .filter(|(first, second)| [first.hypotheses[0], second.hypotheses[0]] != pair.hypotheses[..]);
            fits.extend(others.map(|(first, second)| self.pair(first, second)));
        }
        fits
    }
}
