//! The search for the simplest explanation: one hypothesis, then two (`pairs.rs`) or any set of flipped joints
//! (`flips.rs`), also where only a whole transform explains everything (`transforms.rs`), then a gross cause together with wrong single values (`stages.rs`).

mod fewest;
mod flips;
mod pairs;
mod stages;
mod transforms;

use congruent_kinematics::PoseError;

use super::{
    candidate::CandidateModel,
    cause,
    equivalence::{self, Equivalence},
    explanation::{Criterion, ExplainedFault, Explanation},
    fit::hypothesis_fit::{FitContext, HypothesisFit},
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
    invariants::{self, JointDifference},
    origin_reading::origin_readings,
    score::{ExplanationRank, is_certain_unit, is_refuted, rank},
    thresholds::{EVALUATED_BELOW, MAX_NEXT_BEST, SAME_EFFECT},
};

/// Why two models differ: the answer of [`diagnose`].
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The simplest explanation with a residual within the tolerance, or `unexplained`; then the next best
    /// ones, with larger residuals.
    pub explanations: Vec<Explanation>,
    /// Explanations that also reach the tolerance and cannot be distinguished from the first, each with the
    /// reason.
    pub indistinguishable: Vec<(Explanation, Equivalence)>,
    /// Quantities in which the chains differ, the most invariant first.
    pub differences: Vec<JointDifference>,
}

/// Why a candidate differs from its reference model; without explanations if it does not.
///
/// | value | unit | meaning |
/// |---|---|---|
/// | `models` | m, rad | candidate and reference model |
/// | `criterion` | m, rad | tolerance, and configurations at which residuals are measured |
/// | result | | the simplest explanation first |
///
/// The correction of every hypothesis of the catalogue is applied in turn, its free parameters are fitted
/// to the screws and the tip, and the residual is measured at the criterion's configurations. The simplest
/// hypothesis that reaches the tolerance is named; pairs are tried only if none does.
///
/// Source: two chains are equal for every configuration if and only if their screws and home poses
/// are, Lynch & Park, *Modern Robotics* (2017), eq. 4.14 and its derivative.
///
/// # Examples
/// A turntable whose model turns in the opposite direction:
/// ```
/// use congruent_agreement::diagnosis::{
///     CandidateModel, Cause, Criterion, ModelPair, ReferenceModel, diagnose,
/// };
/// use congruent_description::Tolerance;
/// use congruent_kinematics::{Pose, ScrewChain, Twist};
/// use nalgebra::{Matrix3, Vector3};
/// let chain = ScrewChain {
///     twists_in_base: vec![Twist { angular: Vector3::z(), linear: Vector3::zeros() }],
///     base_from_tip_at_zero: Pose::from_parts(Matrix3::identity(), Vector3::new(0.5, 0.1, 0.)),
/// };
/// let mut candidate = CandidateModel::from_screws(&chain);
/// candidate.rows[0].rate = -1.0;
/// let models = ModelPair { candidate, reference: ReferenceModel::from_screws(&chain) };
/// let criterion = Criterion {
///     tolerance: Tolerance::default(),
///     configurations: vec![[1.0].into()],
///     ..Criterion::default()
/// };
/// let diagnosis = diagnose(&models, &criterion);
/// assert_eq!(diagnosis.explanations[0].cause(), Cause::AxisFlipped);
/// assert_eq!(diagnosis.explanations[0].corrected.candidate.rows[0].rate, 1.0);
/// ```
pub fn diagnose(models: &ModelPair, criterion: &Criterion) -> Diagnosis {
    let differences = invariants::compare(models);
    // Agreement first: without a difference every hypothesis without effect would be an explanation.
    if models.is_accepted(criterion) {
        return Diagnosis { explanations: Vec::new(), indistinguishable: Vec::new(), differences };
    }
    let mut hypotheses = cause::hypotheses(models);
    hypotheses.retain(|it| !it.is_rounding() || !is_within_digits(it, models, criterion));
    let context = FitContext::new(models, &hypotheses, criterion);
    let search = ExplanationSearch { context: &context, criterion };
    let (explained, others) = search.run();
    let mut found: Vec<Explanation> = explained.iter().map(|fit| search.explanation(fit)).collect();
    // The first is the answer, the others are alternatives to it.
    let others_alike = found.split_off(found.len().min(1));
    let alike = |other: Explanation| {
        let equivalence = equivalence::equivalence(models, criterion, &found[0], &other);
        (other, equivalence)
    };
    let mut indistinguishable: Vec<_> = others_alike.into_iter().map(alike).collect();
    if found.is_empty() {
        found.push(Explanation::without_faults(models, criterion));
    }
    found.extend(others.iter().map(|fit| search.explanation(fit)));
    with_origins(models, criterion, &mut found, &mut indistinguishable);
    Diagnosis { explanations: found, indistinguishable, differences }
}

/// Whether angles that a hypothesis takes for rounded are so within half of their last place: the digits account for them
/// already, and rounding is no cause. `3.1415` is not: it is cut off.
fn is_within_digits(rounding: &PoseHypothesis, models: &ModelPair, criterion: &Criterion) -> bool {
    let mut exact = models.clone();
    rounding.apply(&mut exact);
    // The file beside itself with exact angles, whatever else differs from the table.
    let candidate = CandidateModel::from_screws(&exact.reference.screws());
    let own = ModelPair { candidate, reference: models.reference.clone() };
    criterion.digits.of_reference().explain(&own, &criterion.configurations)
}

/// Adds the joints of the reference model whose origin alone explains what takes several corrections of the candidate: as
/// the other reading, or first if no correction of the candidate is known, or if these give only what digits excuse and the origin
/// is exact.
fn with_origins(
    models: &ModelPair,
    criterion: &Criterion,
    found: &mut Vec<Explanation>,
    indistinguishable: &mut Vec<(Explanation, Equivalence)>,
) {
    let is_explained = found[0].is_complete;
    if is_explained && found[0].faults.len() < 2 {
        return;
    }
    let mut origins = origin_readings(models, criterion);
    let is_exact = |of: &Explanation| criterion.is_beyond_digits(&of.residual);
    if is_explained && !is_exact(&found[0]) && origins.first().is_some_and(is_exact) {
        // In its place, so that the corrections of the candidate become the other reading.
        std::mem::swap(&mut found[0], &mut origins[0]);
    }
    let mut origins = origins.into_iter();
    if !is_explained && let Some(origin) = origins.next() {
        // Nothing was found, which is no explanation of its own.
        found.retain(|explanation| !explanation.faults.is_empty());
        found.insert(0, origin);
    }
    let alike = origins.map(|other| {
        let equivalence = equivalence::equivalence(models, criterion, &found[0], &other);
        (other, equivalence)
    });
    indistinguishable.extend(alike);
}

impl Diagnosis {
    /// The diagnosis with another of the explanations that cannot be distinguished named first, and the one that was named
    /// behind it.
    pub(crate) fn preferring(mut self, other: usize, models: &ModelPair, criterion: &Criterion) -> Self {
        let (named, _) = self.indistinguishable.remove(other);
        let before = std::mem::replace(&mut self.explanations[0], named);
        let named = &self.explanations[0];
        let others = self.indistinguishable.into_iter().map(|(other, _)| other);
        let alike = [before].into_iter().chain(others).map(|other| {
            let equivalence = equivalence::equivalence(models, criterion, named, &other);
            (other, equivalence)
        });
        Self { indistinguishable: alike.collect(), ..self }
    }
}

/// Fits that reach the tolerance, and those that do not.
struct JudgedFits {
    accepted: Vec<HypothesisFit>,
    others: Vec<HypothesisFit>,
}

struct ExplanationSearch<'a> {
    context: &'a FitContext<'a>,
    criterion: &'a Criterion,
}

impl ExplanationSearch<'_> {
    /// Fits that reach the tolerance, the best first, and the best of those that do not.
    fn run(&self) -> (Vec<HypothesisFit>, Vec<HypothesisFit>) {
        // From simple to complex, and only as far as needed: single faults are some three hundred fits, pairs tens of
        // thousands, and with more faults the answer becomes less certain.
        let JudgedFits { mut accepted, others: singles } = self.judged(self.singles());
        if !accepted.is_empty() {
            accepted.extend(self.in_place_of_transforms(&accepted, &singles));
            return (self.explaining(&accepted), self.next_best(&singles));
        }
        let pairs = self.pairs(&singles);
        let flips = self.judged(self.flips());
        // Together, so that two flips and three compete by rank and not by which was tried first.
        let accepted = [pairs.accepted, flips.accepted].concat();
        if !accepted.is_empty() {
            return (self.explaining(&accepted), self.next_best(&singles));
        }
        let gross = self.gross(&[&singles[..], &flips.others].concat());
        let explained = self.staged(&gross);
        // One fault takes most of the difference away, but nothing explains the rest: the first step is still worth
        // naming.
        if explained.is_empty() && !gross.is_empty() {
            return (gross, Vec::new());
        }
        (explained, self.next_best(&[pairs.others, flips.others, singles].concat()))
    }

    /// The fits by whether they reach the tolerance, which takes far longer than the fits: each is judged once.
    fn judged(&self, fits: Vec<HypothesisFit>) -> JudgedFits {
        let (accepted, others) = fits.into_iter().partition(|fit| self.accepts(fit));
        JudgedFits { accepted, others }
    }

    /// Every hypothesis alone, without edits that have no effect.
    fn singles(&self) -> Vec<HypothesisFit> {
        let unchanged = self.difference(self.context.models);
        let changes = |fit: &HypothesisFit| {
            !self.context.hypotheses[fit.hypotheses[0]].free.is_empty()
                || !is_same(&self.difference(&self.context.corrected(fit)), &unchanged)
        };
        (0..self.context.hypotheses.len()).map(|index| self.context.single(index)).filter(changes).collect()
    }

    fn difference(&self, models: &ModelPair) -> Vec<f64> {
        let evaluation_point = &self.context.evaluation_point;
        let state = models.reference.state(&evaluation_point.q);
        evaluation_point.difference(&models.candidate, &models.candidate.walk(&evaluation_point.q), &state)
    }

    /// The accepted fits, the best first, each fault once.
    fn explaining(&self, accepted: &[HypothesisFit]) -> Vec<HypothesisFit> {
        // Without what rounding alone has moved: a whole transform that also absorbs the rounding of the other values is no
        // better evidence than one value.
        let mut accepted: Vec<HypothesisFit> =
            accepted.iter().map(|fit| self.context.without_rounding(fit, self.criterion)).collect();
        let given = self.context.models.residual(self.criterion);
        accepted.retain(|fit| !self.make_up_for_each_other(fit, &given));
        // If the correction of something makes the files agree far better than their digits say, nothing is left to be
        // explained by the digits; but an angle of 3.1416 under degrees is the right one in radians, of five digits.
        let is_beyond = |fit: &HypothesisFit| {
            let residual = self.context.corrected(fit).residual(self.criterion);
            self.criterion.is_beyond_digits(&residual) || is_certain_unit(self.context, fit, &residual)
        };
        if accepted.iter().any(is_beyond) {
            accepted.retain(is_beyond);
        }
        // The best residual of all shows how precise the files are; only then is a larger one known to be wrong.
        let residuals = accepted.iter().map(|fit| self.context.corrected(fit).residual(self.criterion));
        let in_tolerances = |a: &PoseError, b: &PoseError| {
            self.criterion.in_tolerances(a).total_cmp(&self.criterion.in_tolerances(b))
        };
        let Some(best) = residuals.min_by(in_tolerances) else { return Vec::new() };
        let refuted = |fit: &HypothesisFit| is_refuted(self.context, fit, self.criterion, &best);
        let mut explaining: Vec<(bool, ExplanationRank, &HypothesisFit)> =
            // Refuted ones last, not removed: they still show what would fit within the tolerance.
            accepted.iter().map(|fit| (refuted(fit), self.rank(fit), fit)).collect();
        explaining.sort_by(|(a, rank_a, _), (b, rank_b, _)| (a, rank_a).cmp(&(b, rank_b)));
        // Of one fault with different free parameters only the first is kept.
        explaining.into_iter().map(|(.., fit)| fit).filter(self.distinct_faults()).cloned().collect()
    }

    /// The faults of a fit, in the order of the hypotheses.
    fn named_faults(&self, fit: &HypothesisFit) -> Vec<(Cause, &FaultPlace)> {
        let mut hypotheses = fit.hypotheses.clone();
        hypotheses.sort_unstable();
        let fault = |at: usize| (self.context.hypotheses[at].cause, &self.context.hypotheses[at].place);
        hypotheses.into_iter().map(fault).collect()
    }

    /// The fits with the smallest norms of those that do not reach the tolerance, each fault once.
    fn next_best(&self, others: &[HypothesisFit]) -> Vec<HypothesisFit> {
        let mut others: Vec<&HypothesisFit> = others.iter().filter(|fit| fit.norm.is_finite()).collect();
        others.sort_by(|a, b| a.norm.total_cmp(&b.norm));
        others.into_iter().filter(self.distinct_faults()).take(MAX_NEXT_BEST).cloned().collect()
    }

    /// A filter that passes fits whose faults were not passed before.
    fn distinct_faults(&self) -> impl FnMut(&&HypothesisFit) -> bool {
        let mut named: Vec<Vec<(Cause, &FaultPlace)>> = Vec::new();
        move |fit| {
            let fault = self.named_faults(fit);
            let is_new = !named.contains(&fault);
            named.push(fault);
            is_new
        }
    }

    /// Whether a fit reaches the tolerance; evaluated at the configurations only if the norm is small enough.
    fn accepts(&self, fit: &HypothesisFit) -> bool {
        let Self { criterion, context } = self;
        let tolerance = criterion
            .tolerance
            .orientation_rad
            .max(criterion.tolerance.position_m / context.evaluation_point.length_m);
        let corrected = || context.corrected(fit);
        // The norm is known, while poses at all configurations cost more than the fit itself.
        (fit.norm <= EVALUATED_BELOW * tolerance && corrected().is_within_tolerance(criterion))
            || context.within_digits(fit, criterion).is_some()
    }

    fn rank(&self, fit: &HypothesisFit) -> ExplanationRank {
        rank(self.context, fit, self.criterion)
    }

    /// A fit as an explanation: components of one declared transform are one fault.
    fn explanation(&self, fit: &HypothesisFit) -> Explanation {
        let mut faults: Vec<ExplainedFault> = Vec::new();
        let mut stages = vec![self.context.models.residual(self.criterion)];
        let (order, residuals) = self.in_turn(fit);
        for (at, residual) in order.into_iter().zip(residuals) {
            let PoseHypothesis { cause, place, free, .. } = &self.context.hypotheses[at];
            match faults.iter().position(|fault| fault.cause == *cause && fault.place == *place) {
                Some(known) if !free.is_empty() => faults[known].free.extend(free),
                _ => {
                    faults.push(ExplainedFault { cause: *cause, place: place.clone(), free: free.clone() });
                    stages.push(residual);
                    continue;
                }
            }
            if let Some(last) = stages.last_mut() {
                *last = residual;
            }
        }
        let corrected = self.context.corrected_within_digits(fit, self.criterion);
        let residual = corrected.residual(self.criterion);
        let digits = self.context.digits(fit, &self.criterion.digits).into_owned();
        Explanation { faults, stages, residual, is_complete: self.accepts(fit), corrected, digits }
    }
}

fn is_same(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < SAME_EFFECT)
}
