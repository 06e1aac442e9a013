//! One trial: a hypothesis, or some together, applied and fitted.

use super::{
    hypothesis::{Case, Hypothesis},
    refit::{Fit, Target},
    snapshot::{Snapshot, Viewpoint},
    suspect::{Entry, Parameter, Suspect},
};

/// Starts of an angle, away from where it stands: a quarter of the circle misses no valley, and at
/// half a turn the slope is zero.
const ANGLE_STARTS_RAD: [f64; 2] = [2.1, -2.1];

/// Hypotheses with their free numbers fitted.
#[derive(Debug, Clone)]
pub(super) struct Trial {
    /// Numbers of the hypotheses.
    pub(super) hypotheses: Vec<usize>,
    /// The models with the faults undone.
    pub(super) mended: Case,
    /// What is left of screws and tip, without unit.
    pub(super) norm: f64,
    /// How far each free number has moved.
    pub(super) moves: Vec<f64>,
}

/// What all trials share.
pub(super) struct Bench<'a> {
    pub(super) case: &'a Case,
    pub(super) hypotheses: &'a [Hypothesis],
    pub(super) viewpoint: Viewpoint,
    pub(super) snapshot: Snapshot,
}

impl<'a> Bench<'a> {
    pub(super) fn new(case: &'a Case, hypotheses: &'a [Hypothesis]) -> Self {
        let viewpoint = Viewpoint::of(&case.reference);
        let snapshot = case.reference.snapshot(&viewpoint.q);
        Self { case, hypotheses, viewpoint, snapshot }
    }

    /// What is left of the case as it stands.
    pub(super) fn norm(&self, case: &Case) -> f64 {
        let snapshot = case.reference.snapshot(&self.viewpoint.q);
        Target { viewpoint: &self.viewpoint, snapshot: &snapshot }.norm(&case.suspect)
    }

    /// One hypothesis, from every start.
    pub(super) fn single(&self, hypothesis: usize) -> Trial {
        self.trial(vec![hypothesis], &self.angle_starts(hypothesis))
    }

    /// Where the free numbers of a single trial may start in company: where they ended alone, and
    /// around the circle.
    pub(super) fn starts(&self, single: &Trial) -> Vec<Vec<f64>> {
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
    pub(super) fn trial(&self, hypotheses: Vec<usize>, starts: &[Vec<f64>]) -> Trial {
        let mut case = self.case.clone();
        for &hypothesis in &hypotheses {
            self.hypotheses[hypothesis].apply(&mut case);
        }
        let free: Vec<Parameter> =
            hypotheses.iter().flat_map(|&at| self.hypotheses[at].free.iter().copied()).collect();
        let of_edited;
        let snapshot = if case.reference == self.case.reference {
            &self.snapshot
        } else {
            of_edited = case.reference.snapshot(&self.viewpoint.q);
            &of_edited
        };
        let target = Target { viewpoint: &self.viewpoint, snapshot };
        let mut best = target.refit(&case.suspect, &free);
        let mut consider = |start: Suspect| {
            if best.norm > STARTS_ABOVE {
                let fit = target.refit(&start, &free);
                if fit.norm < best.norm {
                    best = fit;
                }
            }
        };
        for start in starts {
            let mut suspect = case.suspect.clone();
            free.iter().zip(start).for_each(|(&parameter, &by)| suspect.shift(parameter, by));
            consider(suspect);
        }
        for start in self.aligned(&case.suspect, snapshot, &free).into_iter().flatten() {
            consider(start);
        }
        let Fit { suspect, norm } = best;
        let moves = free.iter().map(|&at| moved(&case.suspect, &suspect, at)).collect();
        Trial { hypotheses, mended: Case { suspect, reference: case.reference }, norm, moves }
    }

    /// Starts in closed form for a declared transform that is free as a whole: the one that makes
    /// the tips meet.
    fn aligned(&self, suspect: &Suspect, snapshot: &Snapshot, free: &[Parameter]) -> [Option<Suspect>; 2] {
        let is_free = |parameter: fn(usize) -> Parameter| (0..6).all(|at| free.contains(&parameter(at)));
        let base_from_tip = suspect.base_from_tip(&self.viewpoint.q);
        let with_tool = is_free(Parameter::Tool).then(|| {
            let tip_from_mended = base_from_tip.inverse() * snapshot.base_from_tip;
            Suspect { tool: (suspect.tool.pose * tip_from_mended).into(), ..suspect.clone() }
        });
        let with_base = is_free(Parameter::Base).then(|| {
            let mended_from_base = snapshot.base_from_tip * base_from_tip.inverse();
            Suspect { base: (mended_from_base * suspect.base.pose).into(), ..suspect.clone() }
        });
        [with_tool, with_base]
    }
}

/// Above this norm, without unit, another start may do better.
const STARTS_ABOVE: f64 = 1e-12;

fn is_angle(parameter: Parameter) -> bool {
    match parameter {
        Parameter::Row(_, entry) => matches!(entry, Entry::Alpha | Entry::Theta),
        Parameter::Base(component) | Parameter::Tool(component) => component >= 3,
        Parameter::Rate(_) => false,
    }
}

/// How far a parameter has moved; of a declared transform, as if its components commuted.
fn moved(from: &Suspect, to: &Suspect, parameter: Parameter) -> f64 {
    let of_pose = |from: &congruent_kinematics::Pose, to: &congruent_kinematics::Pose, component: usize| {
        if component < 3 {
            (to.translation - from.translation)[component]
        } else {
            congruent_kinematics::rotation_log(&(from.rotation.transpose() * to.rotation))[component - 3]
        }
    };
    match parameter {
        Parameter::Row(row, entry) => {
            to.entry(row, entry).unwrap_or_default() - from.entry(row, entry).unwrap_or_default()
        }
        Parameter::Rate(row) => to.rows[row].rate - from.rows[row].rate,
        Parameter::Base(component) => of_pose(&from.base.pose, &to.base.pose, component),
        Parameter::Tool(component) => of_pose(&from.tool.pose, &to.tool.pose, component),
    }
}
