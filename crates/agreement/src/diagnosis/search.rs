//! The search for the simplest explanation: one hypothesis, then two, then several figures.

use congruent_kinematics::PoseError;

use super::{
    cause,
    equivalence::{self, Equivalence},
    explanation::{Criterion, Explanation, Part},
    hypothesis::{Cause, Hypothesis, ModelPair, Place},
    hypothesis_fit::{FitContext, HypothesisFit},
    invariants::{self, JointDifference},
    score::{Rank, is_refuted, rank},
};

/// Hypotheses tried in pairs at most, those that leave least first.
const MOST_IN_PAIRS: usize = 260;
/// Figures that may be off together before the difference counts as unexplained.
const MOST_FIGURES: usize = 8;
/// A further figure must leave less than this share.
const FIGURE_GAIN: f64 = 0.9;
/// Explanations shown that leave more than the first.
const NEXT_BEST: usize = 4;
/// Edits whose screws differ by less, without unit, do the same.
const SAME_EDIT: f64 = 1e-13;

/// Why two models differ: the answer of [`diagnose`].
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The simplest explanation that reaches the tolerance, or `unexplained`; then what comes next
    /// and leaves more.
    pub explanations: Vec<Explanation>,
    /// Explanations that leave as little as the first: the models cannot tell them apart, and why.
    pub indistinguishable: Vec<(Explanation, Equivalence)>,
    /// Where the screws differ, in the order in which quantities survive a change of frames.
    pub differences: Vec<JointDifference>,
}

/// Why a candidate is not its reference; without explanations where it is.
///
/// | value | unit | meaning |
/// |---|---|---|
/// | `models` | m, rad | the model under suspicion and the chain that it should be |
/// | `criterion` | m, rad | tolerance, and configurations at which residuals are measured |
/// | result | | the simplest explanation first |
///
/// Every hypothesis of the catalogue is undone in turn, its free numbers fitted to the screws and
/// the tip, and what is left is measured at the criterion's configurations. The simplest of those
/// that reach the tolerance is named; pairs are tried only where none does.
///
/// Source: two chains are equal for every configuration if and only if their screws and home poses
/// are, Lynch & Park, *Modern Robotics* (2017), eq. 4.14 and its derivative.
///
/// # Examples
/// A turntable whose model turns the other way:
/// ```
/// use congruent_agreement::diagnosis::{
///     Candidate, Cause, Criterion, ModelPair, ReferenceModel, diagnose,
/// };
/// use congruent_description::Tolerance;
/// use congruent_kinematics::{Pose, ScrewChain, Twist};
/// use nalgebra::{Matrix3, Vector3};
/// let chain = ScrewChain {
///     twists_in_base: vec![Twist { angular: Vector3::z(), linear: Vector3::zeros() }],
///     base_from_tip_at_zero: Pose::from_parts(Matrix3::identity(), Vector3::new(0.5, 0.1, 0.)),
/// };
/// let mut candidate = Candidate::from_screws(&chain);
/// candidate.rows[0].rate = -1.0;
/// let models = ModelPair { candidate, reference: ReferenceModel::from_screws(&chain) };
/// let criterion = Criterion { tolerance: Tolerance::default(), configurations: vec![[1.0].into()] };
/// let diagnosis = diagnose(&models, &criterion);
/// assert_eq!(diagnosis.explanations[0].cause(), Cause::AxisFlipped);
/// assert_eq!(diagnosis.explanations[0].corrected.candidate.rows[0].rate, 1.0);
/// ```
pub fn diagnose(models: &ModelPair, criterion: &Criterion) -> Diagnosis {
    let differences = invariants::compare(models);
    if models.is_accepted(criterion) {
        return Diagnosis { explanations: Vec::new(), indistinguishable: Vec::new(), differences };
    }
    let hypotheses = cause::hypotheses(models);
    let context = FitContext::new(models, &hypotheses);
    let search = ExplanationSearch { context, criterion };
    let (explained, others) = search.run();
    let mut found: Vec<Explanation> = explained.iter().map(|fit| search.explanation(fit)).collect();
    let others_alike = found.split_off(found.len().min(1));
    let alike = |other: Explanation| {
        let equivalence = equivalence::equivalence(models, criterion, &found[0], &other);
        (other, equivalence)
    };
    let indistinguishable = others_alike.into_iter().map(alike).collect();
    if found.is_empty() {
        let residual = models.residual(criterion);
        found.push(Explanation { parts: Vec::new(), corrected: models.clone(), residual });
    }
    found.extend(others.iter().map(|fit| search.explanation(fit)));
    Diagnosis { explanations: found, indistinguishable, differences }
}

struct ExplanationSearch<'a> {
    context: FitContext<'a>,
    criterion: &'a Criterion,
}

impl ExplanationSearch<'_> {
    /// Trials that reach the tolerance, the best first, and the best of those that do not.
    fn run(&self) -> (Vec<HypothesisFit>, Vec<HypothesisFit>) {
        let singles = self.singles();
        let explained = self.explaining(&singles);
        if !explained.is_empty() {
            return (explained, self.next_best(&singles));
        }
        let mut pairs = self.pairs(&singles);
        let explained = self.explaining(&pairs);
        if !explained.is_empty() {
            return (explained, self.next_best(&singles));
        }
        let explained: Vec<HypothesisFit> = self.figures().into_iter().collect();
        pairs.extend(singles);
        (explained, self.next_best(&pairs))
    }

    /// Every hypothesis alone, without edits that change nothing here.
    fn singles(&self) -> Vec<HypothesisFit> {
        let unchanged = self.effect(self.context.models);
        let changes = |fit: &HypothesisFit| {
            !self.context.hypotheses[fit.hypotheses[0]].free.is_empty()
                || !is_same(&self.effect(&fit.corrected), &unchanged)
        };
        (0..self.context.hypotheses.len()).map(|index| self.context.single(index)).filter(changes).collect()
    }

    /// Those that are worth trying in pairs: of edits with one effect only the first, and those that
    /// leave least alone.
    fn worth_pairing<'a>(&self, singles: &'a [HypothesisFit]) -> Vec<&'a HypothesisFit> {
        let mut effects: Vec<Vec<f64>> = Vec::new();
        let is_new = |fit: &&HypothesisFit| {
            if !self.context.hypotheses[fit.hypotheses[0]].free.is_empty() {
                return true;
            }
            let effect = self.effect(&fit.corrected);
            let is_new = !effects.iter().any(|known| is_same(known, &effect));
            effects.push(effect);
            is_new
        };
        let mut best: Vec<&HypothesisFit> = singles.iter().filter(is_new).collect();
        best.sort_by(|a, b| a.norm.total_cmp(&b.norm));
        best.truncate(MOST_IN_PAIRS);
        best.sort_by_key(|fit| fit.hypotheses[0]);
        best
    }

    fn effect(&self, models: &ModelPair) -> Vec<f64> {
        let evaluation_point = &self.context.evaluation_point;
        let snapshot = models.reference.snapshot(&evaluation_point.q);
        evaluation_point.difference(&models.candidate, &models.candidate.walk(&evaluation_point.q), &snapshot)
    }

    /// Two hypotheses together, for all that are worth it.
    fn pairs(&self, singles: &[HypothesisFit]) -> Vec<HypothesisFit> {
        let best = self.worth_pairing(singles);
        let mut fits = Vec::new();
        for (at, second) in best.iter().enumerate() {
            for first in &best[..at] {
                let [a, b] = [first, second].map(|fit| &self.context.hypotheses[fit.hypotheses[0]]);
                if a.free.iter().any(|parameter| b.free.contains(parameter)) {
                    continue;
                }
                fits.push(self.pair(first, second));
                // Two edits of one place give another model in the other order.
                if a.edit.is_some() && b.edit.is_some() {
                    fits.push(self.pair(second, first));
                }
            }
        }
        let repeats = self.repeats(singles, &fits);
        fits.extend(repeats);
        fits
    }

    /// Two hypotheses that were tried alone, together.
    fn pair(&self, first: &HypothesisFit, second: &HypothesisFit) -> HypothesisFit {
        let [a, b] = [first, second].map(|fit| self.context.starts(fit));
        let still = |fit: &HypothesisFit| vec![0.0; fit.moves.len()];
        let with_a = a.into_iter().map(|start| [start, still(second)].concat());
        let with_b = b.into_iter().map(|start| [still(first), start].concat());
        let starts: Vec<Vec<f64>> = with_a.chain(with_b).collect();
        self.context.fit([&first.hypotheses[..], &second.hypotheses[..]].concat(), &starts)
    }

    /// The pairs that explain, with edits of the same effect in the place of theirs.
    fn repeats(&self, singles: &[HypothesisFit], pairs: &[HypothesisFit]) -> Vec<HypothesisFit> {
        let effects: Vec<Vec<f64>> = singles.iter().map(|fit| self.effect(&fit.corrected)).collect();
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

    /// Single figures that are off together, by the one that leaves least each time; those that are
    /// not needed in the end are left out again.
    fn figures(&self) -> Option<HypothesisFit> {
        let is_figure = |hypothesis: &&usize| {
            let Hypothesis { cause, free, .. } = &self.context.hypotheses[**hypothesis];
            free.len() == 1 && *cause != Cause::Ratio
        };
        let all: Vec<usize> = (0..self.context.hypotheses.len()).collect();
        let figures: Vec<usize> = all.iter().filter(is_figure).copied().collect();
        let mut chosen: Option<HypothesisFit> = None;
        for _ in 0..MOST_FIGURES {
            let (before, moves, norm) = match &chosen {
                Some(fit) => (fit.hypotheses.clone(), fit.moves.clone(), fit.norm),
                None => (Vec::new(), Vec::new(), self.context.norm(self.context.models)),
            };
            let with = |&figure: &usize| {
                let start = [moves.clone(), vec![0.0]].concat();
                self.context.fit([before.clone(), vec![figure]].concat(), &[start])
            };
            let further = figures.iter().filter(|figure| !before.contains(figure)).map(with);
            let best = further.min_by(|a, b| self.compare_figures(a, b))?;
            if best.norm > FIGURE_GAIN * norm {
                return None;
            }
            if self.accepts(&best) {
                return Some(self.pruned(best));
            }
            chosen = Some(best);
        }
        None
    }

    fn pruned(&self, mut fit: HypothesisFit) -> HypothesisFit {
        let mut at = 0;
        while fit.hypotheses.len() > 2 && at < fit.hypotheses.len() {
            let (mut fewer, mut start) = (fit.hypotheses.clone(), fit.moves.clone());
            fewer.remove(at);
            start.remove(at); // one free number each
            let without = self.context.fit(fewer, &[start]);
            if self.accepts(&without) { fit = without } else { at += 1 }
        }
        fit
    }

    /// The one that leaves less; of those that leave the same the likelier.
    fn compare_figures(&self, a: &HypothesisFit, b: &HypothesisFit) -> std::cmp::Ordering {
        /// Norms closer than this share are one: figures along one axis do the same.
        const SAME_NORM: f64 = 1e-6;
        if (a.norm - b.norm).abs() <= SAME_NORM * a.norm.max(b.norm) + SAME_EDIT {
            self.rank(a).cmp(&self.rank(b))
        } else {
            a.norm.total_cmp(&b.norm)
        }
    }

    fn explaining(&self, fits: &[HypothesisFit]) -> Vec<HypothesisFit> {
        let accepted: Vec<&HypothesisFit> = fits.iter().filter(|fit| self.accepts(fit)).collect();
        let left = accepted.iter().map(|fit| fit.corrected.residual(self.criterion));
        let by_share =
            |a: &PoseError, b: &PoseError| self.criterion.share(a).total_cmp(&self.criterion.share(b));
        let Some(best) = left.min_by(by_share) else { return Vec::new() };
        let refuted = |fit: &HypothesisFit| is_refuted(&self.context, fit, self.criterion, &best);
        let mut explaining: Vec<(bool, Rank, &HypothesisFit)> =
            accepted.iter().map(|fit| (refuted(fit), self.rank(fit), *fit)).collect();
        explaining.sort_by(|(a, rank_a, _), (b, rank_b, _)| (a, rank_a).cmp(&(b, rank_b)));
        // Of the same fault with more or fewer free numbers the first says it all.
        explaining.into_iter().map(|(.., fit)| fit).filter(self.once()).cloned().collect()
    }

    /// What a fit faults, in an order of its own.
    fn fault(&self, fit: &HypothesisFit) -> Vec<(Cause, &Place)> {
        let mut hypotheses = fit.hypotheses.clone();
        hypotheses.sort_unstable();
        let fault = |at: usize| (self.context.hypotheses[at].cause, &self.context.hypotheses[at].place);
        hypotheses.into_iter().map(fault).collect()
    }

    /// Those that leave least beyond the tolerance, each fault once.
    fn next_best(&self, fits: &[HypothesisFit]) -> Vec<HypothesisFit> {
        let is_other = |fit: &&HypothesisFit| fit.norm.is_finite() && !self.accepts(fit);
        let mut others: Vec<&HypothesisFit> = fits.iter().filter(is_other).collect();
        others.sort_by(|a, b| a.norm.total_cmp(&b.norm));
        others.into_iter().filter(self.once()).take(NEXT_BEST).cloned().collect()
    }

    /// Passes fits whose fault was not passed before.
    fn once(&self) -> impl FnMut(&&HypothesisFit) -> bool {
        let mut named: Vec<Vec<(Cause, &Place)>> = Vec::new();
        move |fit| {
            let fault = self.fault(fit);
            let is_new = !named.contains(&fault);
            named.push(fault);
            is_new
        }
    }

    /// Whether a fit reaches the tolerance; the configurations are asked only where the screws
    /// leave a chance.
    fn accepts(&self, fit: &HypothesisFit) -> bool {
        /// How much more the screws may differ than the tips within the joints' ranges.
        const CHANCE: f64 = 1e4;
        let Self { criterion, context } = self;
        let tolerance = criterion
            .tolerance
            .orientation_rad
            .max(criterion.tolerance.position_m / context.evaluation_point.length_m);
        fit.norm <= CHANCE * tolerance && fit.corrected.is_accepted(criterion)
    }

    fn rank(&self, fit: &HypothesisFit) -> Rank {
        rank(&self.context, fit, self.criterion)
    }

    /// A fit as it is told: figures of one declared transform are one part.
    fn explanation(&self, fit: &HypothesisFit) -> Explanation {
        let mut parts: Vec<Part> = Vec::new();
        for &at in &fit.hypotheses {
            let Hypothesis { cause, place, free, .. } = &self.context.hypotheses[at];
            match parts.iter_mut().find(|part| part.cause == *cause && part.place == *place) {
                Some(part) if !free.is_empty() => part.free.extend(free),
                _ => parts.push(Part { cause: *cause, place: place.clone(), free: free.clone() }),
            }
        }
        let residual = fit.corrected.residual(self.criterion);
        Explanation { parts, residual, corrected: fit.corrected.clone() }
    }
}

fn is_same(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < SAME_EDIT)
}
