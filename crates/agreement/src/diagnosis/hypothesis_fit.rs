//! One fit: a hypothesis, or some together, applied and fitted.

use super::{
    candidate::{Candidate, DhEntry, ModelParameter},
    evaluation_point::EvaluationPoint,
    hypothesis::{Hypothesis, ModelPair},
    least_squares::{FitTarget, FittedCandidate},
    reference_model::ChainState,
};

/// Starts of an angle, away from where it stands: a quarter of the circle misses no valley, and at
/// half a turn the slope is zero.
const ANGLE_STARTS_RAD: [f64; 2] = [2.1, -2.1];

/// Hypotheses with their free numbers fitted.
#[derive(Debug, Clone)]
pub(super) struct HypothesisFit {
    /// Numbers of the hypotheses.
    pub(super) hypotheses: Vec<usize>,
    /// The models with the faults undone.
    pub(super) corrected: ModelPair,
    /// What is left of screws and tip, without unit.
    pub(super) norm: f64,
    /// How far each free number has moved.
    pub(super) moves: Vec<f64>,
}

/// What all fits share.
pub(super) struct FitContext<'a> {
    pub(super) models: &'a ModelPair,
    pub(super) hypotheses: &'a [Hypothesis],
    pub(super) evaluation_point: EvaluationPoint,
    pub(super) snapshot: ChainState,
}

impl<'a> FitContext<'a> {
    pub(super) fn new(models: &'a ModelPair, hypotheses: &'a [Hypothesis]) -> Self {
        let evaluation_point = EvaluationPoint::of(&models.reference);
        let snapshot = models.reference.snapshot(&evaluation_point.q);
        Self { models, hypotheses, evaluation_point, snapshot }
    }

    /// What is left of the models as it stands.
    pub(super) fn norm(&self, models: &ModelPair) -> f64 {
        let snapshot = models.reference.snapshot(&self.evaluation_point.q);
        FitTarget { evaluation_point: &self.evaluation_point, snapshot: &snapshot }.norm(&models.candidate)
    }

    /// One hypothesis, from every start.
    pub(super) fn single(&self, hypothesis: usize) -> HypothesisFit {
        self.fit(vec![hypothesis], &self.angle_starts(hypothesis))
    }

    /// Where the free numbers of a single fit may start in company: where they ended alone, and
    /// around the circle.
    pub(super) fn starts(&self, single: &HypothesisFit) -> Vec<Vec<f64>> {
        if single.moves.is_empty() {
            return Vec::new();
        }
        let mut starts = vec![single.moves.clone()];
        starts.extend(self.angle_starts(single.hypotheses[0]));
        starts
    }

    fn angle_starts(&self, hypothesis: usize) -> Vec<Vec<f64>> {
        match self.hypotheses[hypothesis].free[..] {
            [only] if is_angle(only) => ANGLE_STARTS_RAD.iter().map(|&start| vec![start]).collect(),
            _ => Vec::new(),
        }
    }

    /// Hypotheses together: from where the model stands, and from further starts of the free
    /// numbers. The best end counts.
    pub(super) fn fit(&self, hypotheses: Vec<usize>, starts: &[Vec<f64>]) -> HypothesisFit {
        let mut models = self.models.clone();
        for &hypothesis in &hypotheses {
            self.hypotheses[hypothesis].apply(&mut models);
        }
        let free: Vec<ModelParameter> =
            hypotheses.iter().flat_map(|&at| self.hypotheses[at].free.iter().copied()).collect();
        let of_edited;
        let snapshot = if models.reference == self.models.reference {
            &self.snapshot
        } else {
            of_edited = models.reference.snapshot(&self.evaluation_point.q);
            &of_edited
        };
        let target = FitTarget { evaluation_point: &self.evaluation_point, snapshot };
        let mut best = target.refit(&models.candidate, &free);
        let mut consider = |start: Candidate| {
            if best.norm > STARTS_ABOVE {
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
        for start in self.aligned(&models.candidate, snapshot, &free).into_iter().flatten() {
            consider(start);
        }
        let FittedCandidate { candidate, norm } = best;
        let moves = free.iter().map(|&at| moved(&models.candidate, &candidate, at)).collect();
        HypothesisFit {
            hypotheses,
            corrected: ModelPair { candidate, reference: models.reference },
            norm,
            moves,
        }
    }

    /// Starts in closed form for a declared transform that is free as a whole: the one that makes
    /// the tips meet.
    fn aligned(
        &self,
        candidate: &Candidate,
        snapshot: &ChainState,
        free: &[ModelParameter],
    ) -> [Option<Candidate>; 2] {
        let is_free = |parameter: fn(usize) -> ModelParameter| (0..6).all(|at| free.contains(&parameter(at)));
        let base_from_tip = candidate.base_from_tip(&self.evaluation_point.q);
        let with_tool = is_free(ModelParameter::Tool).then(|| {
            let tip_from_corrected = base_from_tip.inverse() * snapshot.base_from_tip;
            Candidate { tool: (candidate.tool.pose * tip_from_corrected).into(), ..candidate.clone() }
        });
        let with_base = is_free(ModelParameter::Base).then(|| {
            let corrected_from_base = snapshot.base_from_tip * base_from_tip.inverse();
            Candidate { base: (corrected_from_base * candidate.base.pose).into(), ..candidate.clone() }
        });
        [with_tool, with_base]
    }
}

/// Above this norm, without unit, another start may do better.
const STARTS_ABOVE: f64 = 1e-12;

fn is_angle(parameter: ModelParameter) -> bool {
    match parameter {
        ModelParameter::Row(_, entry) => matches!(entry, DhEntry::Alpha | DhEntry::Theta),
        ModelParameter::Base(component) | ModelParameter::Tool(component) => component >= 3,
        ModelParameter::Rate(_) => false,
    }
}

/// How far a parameter has moved; of a declared transform, as if its components commuted.
fn moved(from: &Candidate, to: &Candidate, parameter: ModelParameter) -> f64 {
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
