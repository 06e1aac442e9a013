//! A gross cause together with wrong single values: the gross cause is found under a tolerance as loose as the
//! residual that the other faults cause, then the values are added one by one.

use std::borrow::Cow;

use congruent_description::Tolerance;
use congruent_kinematics::PoseError;

use super::ExplanationSearch;
use crate::diagnosis::{
    candidate::ModelParameter,
    explanation::Criterion,
    fit::hypothesis_fit::{HypothesisFit, moved},
    hypothesis::{FaultPlace, PoseHypothesis},
    nearest_table::nearby_table,
    thresholds::{
        FAR_WORSE, GROSS_PART, GROSS_WITHIN, MAX_GROSS, MAX_GROSS_ONE_BY_ONE, MAX_PARAMETERS, PARAMETER_GAIN,
        SAME_EFFECT, SAME_NORM, SAME_VALUE,
    },
};

impl ExplanationSearch<'_> {
    /// The causes that explain most of the difference, the best first: those that a diagnosis would name
    /// under a tolerance as loose as the smallest residual of all. None if no cause explains most of it.
    pub(super) fn gross(&self, singles: &[HypothesisFit]) -> Vec<HypothesisFit> {
        let unchanged = self.context.norm(self.context.models);
        let gross: Vec<HypothesisFit> =
            singles.iter().filter(|fit| fit.norm < GROSS_PART * unchanged).cloned().collect();
        let residual = |fit: &HypothesisFit| {
            self.criterion.in_tolerances(&self.context.corrected(fit).residual(self.criterion))
        };
        // What the best gross cause fails to explain is due to the other faults. It takes the place of the
        // tolerance, with which the ordinary ranking then names the gross cause.
        let Some(best) = gross.iter().map(residual).min_by(f64::total_cmp) else { return Vec::new() };
        let Tolerance { position_m, orientation_rad } = self.criterion.insignificant();
        let loose = Criterion {
            tolerance: Tolerance {
                position_m: GROSS_WITHIN * best * position_m,
                orientation_rad: GROSS_WITHIN * best * orientation_rad,
            },
            ..self.criterion.clone()
        };
        let search = ExplanationSearch { context: self.context, criterion: &loose };
        search.explaining(&search.judged(gross).accepted)
    }

    /// Each gross cause, and none, together with further wrong values; of those that reach the tolerance the ones
    /// with the fewest faults.
    pub(super) fn staged(&self, gross: &[HypothesisFit]) -> Vec<HypothesisFit> {
        // Rounding has a small effect, but one that many values would have to make up for.
        let rounding = (0..self.context.hypotheses.len()).find(|&at| self.is_rounding(at));
        let rounding = rounding.map(|at| self.context.single(at));
        // Other large faults can hide that a mistake of the whole table explains anything: it is tried in any case.
        let is_tried = |at: usize| gross.iter().take(MAX_GROSS).any(|fit| fit.hypotheses == [at]);
        let whole = (0..self.context.hypotheses.len()).filter(|&at| self.is_of_table(at) && !is_tried(at));
        let whole: Vec<HypothesisFit> = whole.map(|at| self.context.single(at)).collect();
        let starts: Vec<Option<&HypothesisFit>> =
            gross.iter().take(MAX_GROSS).chain(&whole).chain(&rounding).map(Some).chain([None]).collect();
        let nearest = starts.iter().filter_map(|start| self.with_changed_values(*start));
        let mut grown: Vec<HypothesisFit> = self.fewest_changes().into_iter().chain(nearest).collect();
        if grown.is_empty() {
            // One by one is slower.
            let starts = gross.iter().take(MAX_GROSS_ONE_BY_ONE).map(Some).chain([None]);
            grown = starts.filter_map(|start| self.with_parameters(start.cloned())).collect();
        }
        // Fewer wrong values are likelier than many; the residual does not decide, since each value added makes it
        // smaller.
        let changes = |fit: &HypothesisFit| {
            let fitted_edits =
                fit.hypotheses.iter().filter(|&&at| self.context.hypotheses[at].is_fitted_edit());
            fit.hypotheses.len() + fitted_edits.count()
        };
        let Some(fewest) = grown.iter().map(changes).min() else { return Vec::new() };
        let simplest: Vec<HypothesisFit> = grown.into_iter().filter(|fit| changes(fit) == fewest).collect();
        self.explaining(&simplest)
    }

    /// Several parameters that are wrong together, the rounding of the reference model's file among them: adds
    /// the one with the smallest norm each time, and in the end removes those that are not needed.
    fn with_parameters(&self, gross: Option<HypothesisFit>) -> Option<HypothesisFit> {
        let is_parameter = |hypothesis: &usize| {
            self.context.hypotheses[*hypothesis].is_single_value() || self.is_rounding(*hypothesis)
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
                // From the fit so far: the values that are known only have to give way to the next one.
                let start = [changes.clone(), vec![0.0]].concat();
                self.context.fit([before.clone(), vec![parameter]].concat(), &[start])
            };
            let further =
                parameters.iter().filter(|parameter| !self.overlaps(&before, **parameter)).map(with);
            let best = further.min_by(|a, b| self.compare_parameters(a, b))?;
            // A value that gains so little is not the fault, and the next ones would gain less.
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

    /// The values that differ in the nearest table that agrees.
    fn with_changed_values(&self, gross: Option<&HypothesisFit>) -> Option<HypothesisFit> {
        let (mut hypotheses, mut changes, models) = match gross {
            Some(fit) => (fit.hypotheses.clone(), fit.changes.clone(), self.context.corrected(fit)),
            None => (Vec::new(), Vec::new(), Cow::Borrowed(self.context.models)),
        };
        let kept = hypotheses.len();
        let fitted: Vec<ModelParameter> =
            hypotheses.iter().flat_map(|&at| self.context.hypotheses[at].free.iter().copied()).collect();
        let nearest = nearby_table(&models, &fitted)?;
        let length_m = self.context.evaluation_point.length_m;
        let mut changed: Vec<(f64, usize, f64)> = Vec::new();
        for (at, hypothesis) in self.context.hypotheses.iter().enumerate() {
            // Edits and whole transforms are gross causes.
            let (true, &[parameter]) = (hypothesis.is_single_value(), &hypothesis.free[..]) else { continue };
            let by = moved(&models.candidate, &nearest, parameter);
            // The offset of a prismatic joint has two hypotheses.
            let is_known =
                changed.iter().any(|(_, known, _)| self.context.hypotheses[*known].free == hypothesis.free);
            if by.abs() > SAME_VALUE && !fitted.contains(&parameter) && !is_known {
                changed.push((if parameter.is_angle() { by.abs() * length_m } else { by.abs() }, at, by));
            }
        }
        if changed.len() > MAX_PARAMETERS {
            return None;
        }
        // The largest effect first: the last ones are the first that are tried without.
        changed.sort_by(|(one, ..), (other, ..)| other.total_cmp(one));
        hypotheses.extend(changed.iter().map(|(_, at, _)| *at));
        changes.extend(changed.iter().map(|(.., by)| *by));
        let fit = self.context.fit(hypotheses, &[changes]);
        self.accepts(&fit).then(|| self.pruned(fit, kept))
    }

    /// Whether a hypothesis corrects the whole table or whole columns, without a fit.
    pub(super) fn is_of_table(&self, hypothesis: usize) -> bool {
        let PoseHypothesis { place, free, .. } = &self.context.hypotheses[hypothesis];
        let is_whole =
            matches!(place, FaultPlace::Model | FaultPlace::Column(_) | FaultPlace::ShiftedColumn(..));
        is_whole && free.is_empty()
    }

    /// Whether a hypothesis is about rounded angles in the reference model's file.
    fn is_rounding(&self, hypothesis: usize) -> bool {
        self.context.hypotheses[hypothesis].is_rounding()
    }

    /// The number of free parameters of a hypothesis.
    fn free(&self, hypothesis: usize) -> usize {
        self.context.hypotheses[hypothesis].free.len()
    }

    /// Whether one of the hypotheses fits the same parameter already.
    fn overlaps(&self, chosen: &[usize], parameter: usize) -> bool {
        let free = |at: usize| &self.context.hypotheses[at].free;
        chosen.iter().any(|&at| free(parameter).iter().any(|each| free(at).contains(each)))
    }

    /// The fit without the parameters that are not needed; the first `kept` hypotheses stay.
    pub(super) fn pruned(&self, mut fit: HypothesisFit, kept: usize) -> HypothesisFit {
        // The last ones have the smallest effects.
        for at in (kept..fit.hypotheses.len()).rev() {
            if fit.hypotheses.len() <= 1 {
                break;
            }
            let (mut fewer, mut start) = (fit.hypotheses.clone(), fit.changes.clone());
            fewer.remove(at);
            // `changes` holds the parameters of all hypotheses one after another: those of the removed one begin
            // behind those of the hypotheses before it.
            let first: usize = fit.hypotheses[..at].iter().map(|&before| self.free(before)).sum();
            start.drain(first..first + self.free(fit.hypotheses[at]));
            let without = self.context.fit(fewer, &[start]);
            if self.accepts(&without) {
                fit = without;
            }
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

    /// Whether one correction makes the models far worse than they are as given and another takes it back: together they are a small
    /// change, and no two mistakes.
    pub(super) fn make_up_for_each_other(&self, fit: &HypothesisFit, given: &PoseError) -> bool {
        let most = FAR_WORSE * self.criterion.in_tolerances(given);
        let is_far_worse = |residual: &PoseError| self.criterion.in_tolerances(residual) > most;
        fit.hypotheses.len() > 1 && self.in_turn(fit).1.iter().any(is_far_worse)
    }

    /// The hypotheses of a fit in the order in which they are corrected, each time the one behind which the least remains,
    /// and the residual after each: with the values to write, as a person would paste them.
    pub(super) fn in_turn(&self, fit: &HypothesisFit) -> (Vec<usize>, Vec<PoseError>) {
        let mut residuals: Vec<PoseError> = Vec::new();
        let mut chosen: Vec<usize> = Vec::new();
        let mut left: Vec<usize> = (0..fit.hypotheses.len()).collect();
        while left.len() > 1 {
            let after = |at: usize| {
                let corrected = self.context.corrected_in_part(fit, &[&chosen[..], &[at]].concat());
                corrected.residual(self.criterion)
            };
            let next = left.iter().map(|&at| (at, after(at)));
            let least = next.min_by(|(_, one), (_, other)| {
                self.criterion.in_tolerances(one).total_cmp(&self.criterion.in_tolerances(other))
            });
            let Some((at, residual)) = least else { break };
            chosen.push(at);
            residuals.push(residual);
            left.retain(|&other| other != at);
        }
        chosen.extend(left);
        residuals.push(self.context.corrected(fit).residual(self.criterion));
        (chosen.into_iter().map(|at| fit.hypotheses[at]).collect(), residuals)
    }
}
