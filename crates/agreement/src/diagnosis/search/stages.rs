//! A cause with a large effect and the parameters that are wrong besides: the first is found under a tolerance
//! as loose as what the others leave, these are added one by one.

use congruent_description::Tolerance;
use congruent_kinematics::PoseError;

use super::ExplanationSearch;
use crate::diagnosis::{
    explanation::Criterion,
    fit::hypothesis_fit::HypothesisFit,
    hypothesis::{Cause, Hypothesis},
    thresholds::{
        GROSS_PART, GROSS_WITHIN, MAX_GROSS, MAX_PARAMETERS, PARAMETER_GAIN, SAME_EFFECT, SAME_NORM,
    },
};

impl ExplanationSearch<'_> {
    /// The causes that explain most of the difference, the best first: those that a diagnosis would name
    /// under a tolerance as loose as the smallest residual of all. None if no cause explains most of it.
    pub(super) fn gross(&self, singles: &[HypothesisFit]) -> Vec<HypothesisFit> {
        let unchanged = self.context.norm(self.context.models);
        let gross: Vec<HypothesisFit> =
            singles.iter().filter(|fit| fit.norm < GROSS_PART * unchanged).cloned().collect();
        let residual =
            |fit: &HypothesisFit| self.criterion.in_tolerances(&fit.corrected.residual(self.criterion));
        let Some(best) = gross.iter().map(residual).min_by(f64::total_cmp) else { return Vec::new() };
        let Tolerance { position_m, orientation_rad } = self.criterion.tolerance;
        let loose = Criterion {
            tolerance: Tolerance {
                position_m: GROSS_WITHIN * best * position_m,
                orientation_rad: GROSS_WITHIN * best * orientation_rad,
            },
            configurations: self.criterion.configurations.clone(),
        };
        ExplanationSearch { context: self.context, criterion: &loose }.explaining(&gross)
    }

    /// Each gross cause, and none, with the parameters that are wrong besides; those that reach the
    /// tolerance with the fewest faults.
    pub(super) fn staged(&self, gross: &[HypothesisFit]) -> Vec<HypothesisFit> {
        let grown: Vec<HypothesisFit> = gross
            .iter()
            .take(MAX_GROSS)
            .map(Some)
            .chain([None])
            .filter_map(|gross| self.with_parameters(gross.cloned()))
            .collect();
        let Some(fewest) = grown.iter().map(|fit| fit.hypotheses.len()).min() else { return Vec::new() };
        let simplest: Vec<HypothesisFit> =
            grown.into_iter().filter(|fit| fit.hypotheses.len() == fewest).collect();
        self.explaining(&simplest)
    }

    /// Several parameters that are wrong together: adds the parameter with the smallest norm each time, and
    /// in the end removes those that are not needed.
    fn with_parameters(&self, gross: Option<HypothesisFit>) -> Option<HypothesisFit> {
        let is_parameter = |hypothesis: &usize| {
            let Hypothesis { cause, free, .. } = &self.context.hypotheses[*hypothesis];
            free.len() == 1 && *cause != Cause::Ratio
        };
        let kept = usize::from(gross.is_some());
        let parameters: Vec<usize> = (0..self.context.hypotheses.len()).filter(is_parameter).collect();
        let mut chosen = gross;
        for _ in 0..MAX_PARAMETERS {
            let (before, changes, norm) = match &chosen {
                Some(fit) => (fit.hypotheses.clone(), fit.changes.clone(), fit.norm),
                None => (Vec::new(), Vec::new(), self.context.norm(self.context.models)),
            };
            let with = |&parameter: &usize| {
                let start = [changes.clone(), vec![0.0]].concat();
                self.context.fit([before.clone(), vec![parameter]].concat(), &[start])
            };
            let further =
                parameters.iter().filter(|parameter| !self.overlaps(&before, **parameter)).map(with);
            let best = further.min_by(|a, b| self.compare_parameters(a, b))?;
            if best.norm > PARAMETER_GAIN * norm {
                return None;
            }
            if self.accepts(&best) {
                return Some(self.pruned(best, kept));
            }
            chosen = Some(best);
        }
        None
    }

    /// Whether one of the hypotheses fits the same parameter already.
    fn overlaps(&self, chosen: &[usize], parameter: usize) -> bool {
        let free = |at: usize| &self.context.hypotheses[at].free;
        chosen.iter().any(|&at| free(parameter).iter().any(|each| free(at).contains(each)))
    }

    /// Without the parameters that are not needed; the first `kept` hypotheses stay.
    fn pruned(&self, mut fit: HypothesisFit, kept: usize) -> HypothesisFit {
        let mut at = kept;
        while fit.hypotheses.len() > 2 && at < fit.hypotheses.len() {
            let (mut fewer, mut start) = (fit.hypotheses.clone(), fit.changes.clone());
            fewer.remove(at);
            // One free parameter each, behind those of the first.
            start.remove(fit.changes.len() - fit.hypotheses.len() + at);
            let without = self.context.fit(fewer, &[start]);
            if self.accepts(&without) { fit = without } else { at += 1 }
        }
        fit
    }

    /// The smaller norm first; of equal norms the better rank.
    fn compare_parameters(&self, a: &HypothesisFit, b: &HypothesisFit) -> std::cmp::Ordering {
        if (a.norm - b.norm).abs() <= SAME_NORM * a.norm.max(b.norm) + SAME_EFFECT {
            self.rank(a).cmp(&self.rank(b))
        } else {
            a.norm.total_cmp(&b.norm)
        }
    }

    /// The hypotheses of a fit in the order in which they are corrected, that with the largest effect first,
    /// and the residual after each.
    pub(super) fn in_turn(&self, fit: &HypothesisFit) -> (Vec<usize>, Vec<PoseError>) {
        let mut order = fit.hypotheses.clone();
        if let [first, second] = order[..] {
            let [one, other] = [first, second].map(|hypothesis| self.context.single(hypothesis).norm);
            if other < one {
                order.reverse();
            }
        }
        let mut residuals: Vec<PoseError> = Vec::new();
        let mut changes: Vec<f64> = Vec::new();
        for count in 1..order.len() {
            let added = self.context.hypotheses[order[count - 1]].free.len();
            let start = [changes, vec![0.0; added]].concat();
            let partial = if count == 1 {
                self.context.single(order[0])
            } else {
                self.context.fit(order[..count].to_vec(), &[start])
            };
            residuals.push(partial.corrected.residual(self.criterion));
            changes = partial.changes;
        }
        residuals.push(fit.corrected.residual(self.criterion));
        (order, residuals)
    }
}
