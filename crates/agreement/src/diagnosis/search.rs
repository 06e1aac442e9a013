//! The search for the simplest explanation: one hypothesis, then two, then several figures.

use super::{
    cause,
    diagnosis::{Diagnosis, Explanation, Part, Question, Residual},
    gauge,
    hypothesis::{Case, Cause, Hypothesis, Place},
    invariants,
    score::{Rank, is_refuted, rank},
    trial::{Bench, Trial},
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

/// Why a suspect is not its reference; without explanations where it is.
///
/// | value | unit | meaning |
/// |---|---|---|
/// | `case` | m, rad | the model under suspicion and the chain that it should be |
/// | `question` | m, rad | tolerance, and configurations at which residuals are measured |
/// | result | | the simplest explanation first |
///
/// Every hypothesis of the catalogue is undone in turn, its free numbers fitted to the screws and
/// the tip, and what is left is measured at the question's configurations. The simplest of those
/// that reach the tolerance is named; pairs are tried only where none does.
///
/// Source: two chains are equal for every configuration if and only if their screws and home poses
/// are, Lynch & Park, *Modern Robotics* (2017), eq. 4.14 and its derivative.
///
/// # Examples
/// A turntable whose model turns the other way:
/// ```
/// use congruent_kinematics::{
///     Pose, ScrewChain, Twist,
///     agreement::{Case, Cause, Question, Reference, Suspect, diagnose},
/// };
/// use nalgebra::{Matrix3, Vector3};
/// let chain = ScrewChain {
///     twists_in_base: vec![Twist { angular: Vector3::z(), linear: Vector3::zeros() }],
///     base_from_tip_at_zero: Pose::from_parts(Matrix3::identity(), Vector3::new(0.5, 0.1, 0.)),
/// };
/// let mut suspect = Suspect::from_screws(&chain);
/// suspect.rows[0].rate = -1.0;
/// let case = Case { suspect, reference: Reference::from_screws(&chain) };
/// let question = Question { position_m: 1e-9, orientation_rad: 1e-9, configurations: vec![vec![1.0]] };
/// let diagnosis = diagnose(&case, &question);
/// assert_eq!(diagnosis.explanations[0].cause(), Cause::AxisFlipped);
/// assert_eq!(diagnosis.explanations[0].mended.suspect.rows[0].rate, 1.0);
/// ```
pub fn diagnose(case: &Case, question: &Question) -> Diagnosis {
    let differences = invariants::compare(case);
    if case.is_accepted(question) {
        return Diagnosis { explanations: Vec::new(), indistinguishable: Vec::new(), differences };
    }
    let hypotheses = cause::hypotheses(case);
    let bench = Bench::new(case, &hypotheses);
    let search = Search { bench, question };
    let (explained, others) = search.run();
    let mut found: Vec<Explanation> = explained.iter().map(|trial| search.explanation(trial)).collect();
    let others_alike = found.split_off(found.len().min(1));
    let alike = |other: Explanation| {
        let gauge = gauge::gauge(case, question, &found[0], &other);
        (other, gauge)
    };
    let indistinguishable = others_alike.into_iter().map(alike).collect();
    if found.is_empty() {
        let residual = case.residual(question);
        found.push(Explanation { parts: Vec::new(), mended: case.clone(), residual });
    }
    found.extend(others.iter().map(|trial| search.explanation(trial)));
    Diagnosis { explanations: found, indistinguishable, differences }
}

struct Search<'a> {
    bench: Bench<'a>,
    question: &'a Question,
}

impl Search<'_> {
    /// Trials that reach the tolerance, the best first, and the best of those that do not.
    fn run(&self) -> (Vec<Trial>, Vec<Trial>) {
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
        let explained: Vec<Trial> = self.figures().into_iter().collect();
        pairs.extend(singles);
        (explained, self.next_best(&pairs))
    }

    /// Every hypothesis alone, without edits that change nothing here.
    fn singles(&self) -> Vec<Trial> {
        let unchanged = self.effect(self.bench.case);
        let changes = |trial: &Trial| {
            !self.bench.hypotheses[trial.hypotheses[0]].free.is_empty()
                || !is_same(&self.effect(&trial.mended), &unchanged)
        };
        (0..self.bench.hypotheses.len()).map(|index| self.bench.single(index)).filter(changes).collect()
    }

    /// Those that are worth trying in pairs: of edits with one effect only the first, and those that
    /// leave least alone.
    fn worth_pairing<'a>(&self, singles: &'a [Trial]) -> Vec<&'a Trial> {
        let mut effects: Vec<Vec<f64>> = Vec::new();
        let is_new = |trial: &&Trial| {
            if !self.bench.hypotheses[trial.hypotheses[0]].free.is_empty() {
                return true;
            }
            let effect = self.effect(&trial.mended);
            let is_new = !effects.iter().any(|known| is_same(known, &effect));
            effects.push(effect);
            is_new
        };
        let mut best: Vec<&Trial> = singles.iter().filter(is_new).collect();
        best.sort_by(|a, b| a.norm.total_cmp(&b.norm));
        best.truncate(MOST_IN_PAIRS);
        best.sort_by_key(|trial| trial.hypotheses[0]);
        best
    }

    fn effect(&self, case: &Case) -> Vec<f64> {
        let viewpoint = &self.bench.viewpoint;
        let snapshot = case.reference.snapshot(&viewpoint.q);
        viewpoint.difference(&case.suspect, &case.suspect.walk(&viewpoint.q), &snapshot)
    }

    /// Two hypotheses together, for all that are worth it.
    fn pairs(&self, singles: &[Trial]) -> Vec<Trial> {
        let best = self.worth_pairing(singles);
        let mut trials = Vec::new();
        for (at, second) in best.iter().enumerate() {
            for first in &best[..at] {
                let [a, b] = [first, second].map(|trial| &self.bench.hypotheses[trial.hypotheses[0]]);
                if a.free.iter().any(|parameter| b.free.contains(parameter)) {
                    continue;
                }
                trials.push(self.pair(first, second));
                // Two edits of one place give another model in the other order.
                if a.edit.is_some() && b.edit.is_some() {
                    trials.push(self.pair(second, first));
                }
            }
        }
        let repeats = self.repeats(singles, &trials);
        trials.extend(repeats);
        trials
    }

    /// Two hypotheses that were tried alone, together.
    fn pair(&self, first: &Trial, second: &Trial) -> Trial {
        let [a, b] = [first, second].map(|trial| self.bench.starts(trial));
        let still = |trial: &Trial| vec![0.0; trial.moves.len()];
        let with_a = a.into_iter().map(|start| [start, still(second)].concat());
        let with_b = b.into_iter().map(|start| [still(first), start].concat());
        let starts: Vec<Vec<f64>> = with_a.chain(with_b).collect();
        self.bench.trial([&first.hypotheses[..], &second.hypotheses[..]].concat(), &starts)
    }

    /// The pairs that explain, with edits of the same effect in the place of theirs.
    fn repeats(&self, singles: &[Trial], pairs: &[Trial]) -> Vec<Trial> {
        let effects: Vec<Vec<f64>> = singles.iter().map(|trial| self.effect(&trial.mended)).collect();
        let same = |hypothesis: usize| -> Vec<&Trial> {
            let Some(at) = singles.iter().position(|trial| trial.hypotheses[0] == hypothesis) else {
                return Vec::new();
            };
            let is_edit = |trial: &Trial| self.bench.hypotheses[trial.hypotheses[0]].free.is_empty();
            let is_same = |other: &usize| {
                *other == at
                    || (is_edit(&singles[at])
                        && is_edit(&singles[*other])
                        && is_same(&effects[*other], &effects[at]))
            };
            (0..singles.len()).filter(is_same).map(|other| &singles[other]).collect()
        };
        let mut trials = Vec::new();
        for pair in pairs.iter().filter(|pair| self.accepts(pair)) {
            let [firsts, seconds] = [same(pair.hypotheses[0]), same(pair.hypotheses[1])];
            let all = firsts.iter().flat_map(|first| seconds.iter().map(move |second| (first, second)));
            let others = all
                .filter(|(first, second)| [first.hypotheses[0], second.hypotheses[0]] != pair.hypotheses[..]);
            trials.extend(others.map(|(first, second)| self.pair(first, second)));
        }
        trials
    }

    /// Single figures that are off together, by the one that leaves least each time; those that are
    /// not needed in the end are left out again.
    fn figures(&self) -> Option<Trial> {
        let is_figure = |hypothesis: &&usize| {
            let Hypothesis { cause, free, .. } = &self.bench.hypotheses[**hypothesis];
            free.len() == 1 && *cause != Cause::Ratio
        };
        let all: Vec<usize> = (0..self.bench.hypotheses.len()).collect();
        let figures: Vec<usize> = all.iter().filter(is_figure).copied().collect();
        let mut chosen: Option<Trial> = None;
        for _ in 0..MOST_FIGURES {
            let (before, moves, norm) = match &chosen {
                Some(trial) => (trial.hypotheses.clone(), trial.moves.clone(), trial.norm),
                None => (Vec::new(), Vec::new(), self.bench.norm(self.bench.case)),
            };
            let with = |&figure: &usize| {
                let start = [moves.clone(), vec![0.0]].concat();
                self.bench.trial([before.clone(), vec![figure]].concat(), &[start])
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

    fn pruned(&self, mut trial: Trial) -> Trial {
        let mut at = 0;
        while trial.hypotheses.len() > 2 && at < trial.hypotheses.len() {
            let (mut fewer, mut start) = (trial.hypotheses.clone(), trial.moves.clone());
            fewer.remove(at);
            start.remove(at); // one free number each
            let without = self.bench.trial(fewer, &[start]);
            if self.accepts(&without) { trial = without } else { at += 1 }
        }
        trial
    }

    /// The one that leaves less; of those that leave the same the likelier.
    fn compare_figures(&self, a: &Trial, b: &Trial) -> std::cmp::Ordering {
        /// Norms closer than this share are one: figures along one axis do the same.
        const SAME_NORM: f64 = 1e-6;
        if (a.norm - b.norm).abs() <= SAME_NORM * a.norm.max(b.norm) + SAME_EDIT {
            self.rank(a).cmp(&self.rank(b))
        } else {
            a.norm.total_cmp(&b.norm)
        }
    }

    fn explaining(&self, trials: &[Trial]) -> Vec<Trial> {
        let accepted: Vec<&Trial> = trials.iter().filter(|trial| self.accepts(trial)).collect();
        let left = accepted.iter().map(|trial| trial.mended.residual(self.question));
        let by_share = |a: &Residual, b: &Residual| self.question.share(a).total_cmp(&self.question.share(b));
        let Some(best) = left.min_by(by_share) else { return Vec::new() };
        let refuted = |trial: &Trial| is_refuted(&self.bench, trial, self.question, &best);
        let mut explaining: Vec<(bool, Rank, &Trial)> =
            accepted.iter().map(|trial| (refuted(trial), self.rank(trial), *trial)).collect();
        explaining.sort_by(|(a, rank_a, _), (b, rank_b, _)| (a, rank_a).cmp(&(b, rank_b)));
        // Of the same blame with more or fewer free numbers the first says it all.
        explaining.into_iter().map(|(.., trial)| trial).filter(self.once()).cloned().collect()
    }

    /// What a trial blames, in an order of its own.
    fn blame(&self, trial: &Trial) -> Vec<(Cause, &Place)> {
        let mut hypotheses = trial.hypotheses.clone();
        hypotheses.sort_unstable();
        let blame = |at: usize| (self.bench.hypotheses[at].cause, &self.bench.hypotheses[at].place);
        hypotheses.into_iter().map(blame).collect()
    }

    /// Those that leave least beyond the tolerance, each blame once.
    fn next_best(&self, trials: &[Trial]) -> Vec<Trial> {
        let is_other = |trial: &&Trial| trial.norm.is_finite() && !self.accepts(trial);
        let mut others: Vec<&Trial> = trials.iter().filter(is_other).collect();
        others.sort_by(|a, b| a.norm.total_cmp(&b.norm));
        others.into_iter().filter(self.once()).take(NEXT_BEST).cloned().collect()
    }

    /// Passes trials whose blame was not passed before.
    fn once(&self) -> impl FnMut(&&Trial) -> bool {
        let mut blamed: Vec<Vec<(Cause, &Place)>> = Vec::new();
        move |trial| {
            let blame = self.blame(trial);
            let is_new = !blamed.contains(&blame);
            blamed.push(blame);
            is_new
        }
    }

    /// Whether a trial reaches the tolerance; the configurations are asked only where the screws
    /// leave a chance.
    fn accepts(&self, trial: &Trial) -> bool {
        /// How much more the screws may differ than the tips within the joints' ranges.
        const CHANCE: f64 = 1e4;
        let Self { question, bench } = self;
        let tolerance = question.orientation_rad.max(question.position_m / bench.viewpoint.length_m);
        trial.norm <= CHANCE * tolerance && trial.mended.is_accepted(question)
    }

    fn rank(&self, trial: &Trial) -> Rank {
        rank(&self.bench, trial, self.question)
    }

    /// A trial as it is told: figures of one declared transform are one part.
    fn explanation(&self, trial: &Trial) -> Explanation {
        let mut parts: Vec<Part> = Vec::new();
        for &at in &trial.hypotheses {
            let Hypothesis { cause, place, free, .. } = &self.bench.hypotheses[at];
            match parts.iter_mut().find(|part| part.cause == *cause && part.place == *place) {
                Some(part) if !free.is_empty() => part.free.extend(free),
                _ => parts.push(Part { cause: *cause, place: place.clone(), free: free.clone() }),
            }
        }
        let residual = trial.mended.residual(self.question);
        Explanation { parts, residual, mended: trial.mended.clone() }
    }
}

fn is_same(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < SAME_EDIT)
}
