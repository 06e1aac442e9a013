//! The fit of one hypothesis, or of several together.

use std::borrow::Cow;

use congruent_description::Tolerance;

use crate::diagnosis::{
    candidate::{CandidateModel, DhEntry, ModelParameter},
    digits::{Weights, WrittenDigits, most_norm},
    explanation::Criterion,
    fit::evaluation_point::EvaluationPoint,
    fit::least_squares::{FitTarget, FittedCandidate},
    hypothesis::{ModelPair, PoseHypothesis},
    reference_model::ChainState,
    thresholds::{ANGLE_STARTS_RAD, GOOD_FIT, MOST_WEIGHTED_JOINTS, SAME_VALUE},
};

/// The effects of the digits are those in the models as given; with a gross cause corrected, the same digits have other
/// effects, at most so many times as large. No unit; kind: judgement.
const OTHER_EFFECTS: f64 = 10.0;

/// Hypotheses with their free parameters fitted.
#[derive(Debug, Clone)]
pub(in crate::diagnosis) struct HypothesisFit {
    /// Indices of the hypotheses.
    pub(in crate::diagnosis) hypotheses: Vec<usize>,
    /// The models with the faults corrected, if a parameter is fitted. Others are made again from the hypotheses
    /// ([`FitContext::corrected`]): of a long chain there are too many to keep.
    fitted: Option<ModelPair>,
    /// Norm of the remaining difference of screws and tip, without unit.
    pub(in crate::diagnosis) norm: f64,
    /// The change of each free parameter.
    pub(in crate::diagnosis) changes: Vec<f64>,
    /// Free parameters that keep their given values: only rounding had moved them.
    kept: Vec<ModelParameter>,
}

/// The models, the hypotheses and the target of all fits.
pub(in crate::diagnosis) struct FitContext<'a> {
    pub(in crate::diagnosis) models: &'a ModelPair,
    pub(in crate::diagnosis) hypotheses: &'a [PoseHypothesis],
    pub(in crate::diagnosis) evaluation_point: EvaluationPoint,
    /// The same without weights.
    unweighted: EvaluationPoint,
    /// An unweighted norm that the tolerance allows, or rounding.
    tolerated: f64,
    /// An unweighted norm that the digits may allow.
    by_digits: f64,
    pub(in crate::diagnosis) state: ChainState,
}

impl<'a> FitContext<'a> {
    pub(in crate::diagnosis) fn new(
        models: &'a ModelPair,
        hypotheses: &'a [PoseHypothesis],
        criterion: &Criterion,
    ) -> Self {
        let unweighted = EvaluationPoint::for_reference(&models.reference);
        let digits = &criterion.digits;
        let effects = (!digits.values.is_empty()).then(|| digits.effects(models, &unweighted));
        let by_digits = effects.as_ref().map_or(0.0, |effects| OTHER_EFFECTS * most_norm(effects));
        // A matrix of six rows for each joint costs more than it gives for a long chain.
        let is_weighted = unweighted.q.len() <= MOST_WEIGHTED_JOINTS;
        let weights = effects.filter(|_| is_weighted).map(|effects| Weights::new(&effects));
        let evaluation_point = unweighted.clone().weighted(weights);
        let state = models.reference.state(&evaluation_point.q);
        let Tolerance { position_m, orientation_rad } = criterion.tolerance;
        let tolerated = orientation_rad.min(position_m / unweighted.length_m).max(SAME_VALUE);
        Self { models, hypotheses, evaluation_point, unweighted, tolerated, by_digits, state }
    }

    /// The same pair as the corrected models within the digits that the correction moves with the values; fitted values are
    /// free. `None` if the digits allow no such pair.
    pub(in crate::diagnosis) fn within_digits(
        &self,
        fit: &HypothesisFit,
        criterion: &Criterion,
    ) -> Option<ModelPair> {
        let corrected = self.corrected(fit);
        let state = corrected.reference.state(&self.unweighted.q);
        let target = FitTarget { evaluation_point: &self.unweighted, state: &state };
        let left = target.norm(&corrected.candidate);
        // The search for values within the digits takes a hundred times as long.
        if left > self.by_digits {
            return None;
        }
        let mut digits = self.digits(fit, &criterion.digits).into_owned();
        digits.free(self.fitted(fit), self.unweighted.length_m, left);
        digits.explained(&corrected, &criterion.configurations)
    }

    /// The corrected models, with fitted values that the digits of the others allow.
    pub(in crate::diagnosis) fn corrected_within_digits(
        &self,
        fit: &HypothesisFit,
        criterion: &Criterion,
    ) -> ModelPair {
        let mut corrected = self.corrected(fit).into_owned();
        // In directions that count little a weighted fit ends anywhere; a value that is written is one of those that
        // agree.
        let nearest =
            if corrected.is_within_tolerance(criterion) { None } else { self.within_digits(fit, criterion) };
        if let Some(nearest) = nearest {
            for parameter in self.fitted(fit) {
                let by = moved(&corrected.candidate, &nearest.candidate, parameter);
                corrected.candidate.shift(parameter, by);
            }
        }
        corrected
    }

    /// The fitted parameters.
    fn fitted(&self, fit: &HypothesisFit) -> impl Iterator<Item = ModelParameter> {
        self.free(fit).filter(|parameter| !fit.kept.contains(parameter))
    }

    /// The free parameters, in the order of the changes.
    fn free(&self, fit: &HypothesisFit) -> impl Iterator<Item = ModelParameter> {
        fit.hypotheses.iter().flat_map(|&at| self.hypotheses[at].free.iter().copied())
    }

    /// The fit with those components of a declared transform at their given values that only the rounding of other values
    /// has moved: all that are, or else one by one.
    pub(in crate::diagnosis) fn without_rounding(
        &self,
        fit: &HypothesisFit,
        criterion: &Criterion,
    ) -> HypothesisFit {
        let digits = &criterion.digits;
        if digits.values.is_empty() {
            return fit.clone();
        }
        let length_m = self.unweighted.length_m;
        let of_rounding = |entry| digits.coarsest_effect(entry, length_m);
        let (length, angle) = (of_rounding(DhEntry::A), of_rounding(DhEntry::Alpha));
        let is_small = |(parameter, by): &(ModelParameter, f64)| {
            let most = match parameter {
                ModelParameter::Base(_) | ModelParameter::Tool(_) if parameter.is_angle() => angle,
                ModelParameter::Base(_) | ModelParameter::Tool(_) => length,
                _ => 0.0,
            };
            by.abs() <= most
        };
        let moved = self.free(fit).zip(fit.changes.iter().copied());
        let mut small: Vec<(ModelParameter, f64)> = moved.filter(is_small).collect();
        // One component alone is the fault itself.
        if small.is_empty() || small.len() == fit.changes.len() {
            return fit.clone();
        }
        small.sort_by(|(_, one), (_, other)| one.abs().total_cmp(&other.abs()));
        let small: Vec<ModelParameter> = small.into_iter().map(|(parameter, _)| parameter).collect();
        let accepted = |kept: &[ModelParameter]| {
            let fit = self.with_kept(fit, kept);
            // The transform is written anew, so that its own digits allow nothing.
            let mut digits = self.digits(&fit, &criterion.digits).into_owned();
            digits.fix(self.free(&fit));
            let corrected = self.corrected(&fit);
            let is_accepted = corrected.is_within_tolerance(criterion)
                || digits.explain(&corrected, &criterion.configurations);
            is_accepted.then_some(fit)
        };
        accepted(&small).unwrap_or_else(|| {
            let mut best = fit.clone();
            for parameter in small {
                let kept = [&best.kept[..], &[parameter]].concat();
                if let Some(fit) = accepted(&kept) {
                    best = fit;
                }
            }
            best
        })
    }

    /// A fit with these parameters at the values that they have before it.
    fn with_kept(&self, fit: &HypothesisFit, kept: &[ModelParameter]) -> HypothesisFit {
        let mut models = self.edited(&fit.hypotheses);
        let mut changes = fit.changes.clone();
        for (parameter, by) in self.free(fit).zip(&mut changes) {
            *by = if kept.contains(&parameter) { 0.0 } else { *by };
            models.candidate.shift(parameter, *by);
        }
        let norm = self.norm(&models);
        let hypotheses = fit.hypotheses.clone();
        HypothesisFit { hypotheses, fitted: Some(models), norm, changes, kept: kept.to_vec() }
    }

    /// The digits of the corrected models: edited values take theirs with them.
    pub(in crate::diagnosis) fn digits<'d>(
        &self,
        fit: &HypothesisFit,
        given: &'d WrittenDigits,
    ) -> Cow<'d, WrittenDigits> {
        let edits: Vec<&PoseHypothesis> =
            fit.hypotheses.iter().map(|&at| &self.hypotheses[at]).filter(|it| it.edit.is_some()).collect();
        if edits.is_empty() || given.values.is_empty() {
            return Cow::Borrowed(given);
        }
        Cow::Owned(given.after(self.models, |models| edits.iter().for_each(|edit| edit.apply(models))))
    }

    /// Norm of the difference of two models.
    pub(in crate::diagnosis) fn norm(&self, models: &ModelPair) -> f64 {
        let state = models.reference.state(&self.evaluation_point.q);
        FitTarget { evaluation_point: &self.evaluation_point, state: &state }.norm(&models.candidate)
    }

    /// The models with the faults of a fit corrected.
    pub(in crate::diagnosis) fn corrected<'f>(&self, fit: &'f HypothesisFit) -> Cow<'f, ModelPair> {
        match &fit.fitted {
            Some(models) => Cow::Borrowed(models),
            None => Cow::Owned(self.edited(&fit.hypotheses)),
        }
    }

    /// The models with some of the faults of a fit corrected: those at these places of its hypotheses, with the values of the
    /// whole fit.
    pub(in crate::diagnosis) fn corrected_in_part(&self, fit: &HypothesisFit, chosen: &[usize]) -> ModelPair {
        let corrected = self.corrected(fit);
        // In the order of the fit: one edit may need the other before it.
        let hypotheses: Vec<usize> =
            (0..fit.hypotheses.len()).filter(|at| chosen.contains(at)).map(|at| fit.hypotheses[at]).collect();
        let mut models = self.edited(&hypotheses);
        for &parameter in hypotheses.iter().flat_map(|&at| &self.hypotheses[at].free) {
            models.candidate.copy(parameter, &corrected.candidate);
        }
        models
    }

    /// The models after the edits of some hypotheses, before any fit.
    fn edited(&self, hypotheses: &[usize]) -> ModelPair {
        let mut models = self.models.clone();
        for &hypothesis in hypotheses {
            self.hypotheses[hypothesis].apply(&mut models);
        }
        models
    }

    /// One hypothesis, from every start.
    pub(in crate::diagnosis) fn single(&self, hypothesis: usize) -> HypothesisFit {
        self.fit(vec![hypothesis], &self.angle_starts(hypothesis))
    }

    /// Starts of the free parameters of a single fit in a pair: their result alone, and the starts of
    /// angles.
    pub(in crate::diagnosis) fn starts(&self, single: &HypothesisFit) -> Vec<Vec<f64>> {
        if single.changes.is_empty() {
            return Vec::new();
        }
        let mut starts = vec![single.changes.clone()];
        starts.extend(self.angle_starts(single.hypotheses[0]));
        starts
    }

    fn angle_starts(&self, hypothesis: usize) -> Vec<Vec<f64>> {
        // Only a single angle: starts of several angles would multiply.
        match self.hypotheses[hypothesis].free[..] {
            [only] if only.is_angle() => ANGLE_STARTS_RAD.iter().map(|&start| vec![start]).collect(),
            _ => Vec::new(),
        }
    }

    /// The fit of several hypotheses together: from the present values and from further starts of the free
    /// parameters. The best result counts.
    pub(in crate::diagnosis) fn fit(&self, hypotheses: Vec<usize>, starts: &[Vec<f64>]) -> HypothesisFit {
        let models = self.edited(&hypotheses);
        let free: Vec<ModelParameter> =
            hypotheses.iter().flat_map(|&at| self.hypotheses[at].free.iter().copied()).collect();
        let of_edited;
        // Most hypotheses change the candidate alone; the state of the reference is then the one that is known.
        let state = if models.reference == self.models.reference {
            &self.state
        } else {
            of_edited = models.reference.state(&self.evaluation_point.q);
            &of_edited
        };
        let target = FitTarget { evaluation_point: &self.evaluation_point, state };
        // From the present values first: most faults are small, and then no other start is needed.
        let mut best = target.refit(&models.candidate, &free);
        let mut consider = |start: CandidateModel| {
            // A further start can only find the same minimum again once the difference is rounding.
            if best.norm > GOOD_FIT {
                let fit = target.refit(&start, &free);
                if fit.norm < best.norm {
                    best = fit;
                }
            }
        };
        for start in starts {
            let mut candidate = models.candidate.clone();
            free.iter().zip(start).for_each(|(&parameter, &by)| candidate.shift(parameter, by));
            consider(candidate);
        }
        // With all rotations free at once a fit can end in a local minimum; the closed form starts next to the right
        // one.
        for start in self.aligned(&models.candidate, state, &free).into_iter().flatten() {
            consider(start);
        }
        let best = self.unweighted(best, state, &free);
        let FittedCandidate { candidate, norm } = best;
        let changes = free.iter().map(|&at| moved(&models.candidate, &candidate, at)).collect();
        HypothesisFit {
            hypotheses,
            fitted: (!free.is_empty()).then_some(ModelPair { candidate, reference: models.reference }),
            norm,
            changes,
            kept: Vec::new(),
        }
    }

    /// The unweighted fit in place of a weighted one, if it is within the tolerance: the digits need not explain anything then,
    /// and in directions that count little a weighted fit ends before its values have all their digits. Also if it alone is
    /// near enough for the digits: the weights are those of the given table, and behind a wrong sign others are right.
    fn unweighted(
        &self,
        best: FittedCandidate,
        state: &ChainState,
        free: &[ModelParameter],
    ) -> FittedCandidate {
        if !self.evaluation_point.is_weighted() || best.norm > self.tolerated.max(self.by_digits) {
            return best;
        }
        let target = FitTarget { evaluation_point: &self.unweighted, state };
        if best.norm > self.tolerated && target.norm(&best.candidate) <= self.by_digits {
            return best;
        }
        let exact = target.refit(&best.candidate, free);
        if exact.norm > self.tolerated.max(self.by_digits) {
            return best;
        }
        let weighted = FitTarget { evaluation_point: &self.evaluation_point, state };
        FittedCandidate { norm: weighted.norm(&exact.candidate), ..exact }
    }

    /// Starts in closed form for a declared transform of which all components are free: the transform that
    /// makes the tips coincide.
    fn aligned(
        &self,
        candidate: &CandidateModel,
        state: &ChainState,
        free: &[ModelParameter],
    ) -> [Option<CandidateModel>; 2] {
        let is_free = |parameter: fn(usize) -> ModelParameter| (0..6).all(|at| free.contains(&parameter(at)));
        let base_from_tip = candidate.base_from_tip(&self.evaluation_point.q);
        let with_tool = is_free(ModelParameter::Tool).then(|| {
            let tip_from_corrected = base_from_tip.inverse() * state.base_from_tip;
            CandidateModel { tool: (candidate.tool.pose * tip_from_corrected).into(), ..candidate.clone() }
        });
        let with_base = is_free(ModelParameter::Base).then(|| {
            let corrected_from_base = state.base_from_tip * base_from_tip.inverse();
            CandidateModel { base: (corrected_from_base * candidate.base.pose).into(), ..candidate.clone() }
        });
        [with_tool, with_base]
    }
}

/// The change of a parameter; of a declared transform as if its components commuted.
pub(in crate::diagnosis) fn moved(
    from: &CandidateModel,
    to: &CandidateModel,
    parameter: ModelParameter,
) -> f64 {
    let of_pose = |from: &congruent_kinematics::Pose, to: &congruent_kinematics::Pose, component: usize| {
        if component < 3 {
            (to.translation - from.translation)[component]
        } else {
            congruent_kinematics::rotation_log(&(from.rotation.transpose() * to.rotation))[component - 3]
        }
    };
    match parameter {
        ModelParameter::Row(row, entry) => {
            to.entry(row, entry).unwrap_or_default() - from.entry(row, entry).unwrap_or_default()
        }
        ModelParameter::Rate(row) => to.rows[row].rate - from.rows[row].rate,
        ModelParameter::Base(component) => of_pose(&from.base.pose, &to.base.pose, component),
        ModelParameter::Tool(component) => of_pose(&from.tool.pose, &to.tool.pose, component),
    }
}
