//! What has to be known of a recording before its equations are made: the window, and how fast the joints move.

use congruent_dynamics::{BodyTree, DynamicsError};

use crate::{
    collect::{Collector, Instants, RecordedRow},
    effort_kind::recognise,
    smoothing::{KeptRow, Smoothing, SmoothingWindow},
};

/// Parts of a recording that are looked at first. Kind: choice.
const PARTS: f64 = 60.0;
/// Length of each, s: five of the longest half windows.
const PART_S: f64 = 1.0;
/// A joint moves if it is faster than this part of the speed that it exceeds in a twentieth of the time. No unit; kind: choice.
const MOVING: f64 = 0.1;
/// A robot is still if its joints are slower than this part of it. No unit; kind: choice.
const STILL: f64 = 0.01;

/// A window is taken if it leaves at most this much more of the efforts than the best one, and no shorter one does. No unit; kind: choice.
pub(crate) const AS_GOOD: f64 = 1.1;

/// Parts of a recording, evenly over its time, in memory that does not grow with it.
#[derive(Debug)]
pub struct SampledParts {
    from_s: f64,
    period_s: f64,
    parts: Vec<Vec<KeptRow>>,
    is_connected: bool,
}

impl SampledParts {
    /// Of a recording of this length.
    pub fn new(from_s: f64, duration_s: f64) -> Self {
        Self { from_s, period_s: (duration_s / PARTS).max(PART_S), parts: Vec::new(), is_connected: false }
    }

    /// Ends a part: what follows is not connected with the rows so far.
    pub fn break_here(&mut self) {
        self.is_connected = false;
    }

    /// Looks at a row.
    pub fn push(&mut self, row: RecordedRow<'_>) {
        let since_s = (row.time_s - self.from_s).rem_euclid(self.period_s);
        if since_s > PART_S {
            self.is_connected = false;
            return;
        }
        if !self.is_connected {
            self.parts.push(Vec::new());
            self.is_connected = true;
        }
        if let Some(part) = self.parts.last_mut() {
            part.push(row.kept());
        }
    }

    /// What the parts show with a given window; `None` if they have too few rows for it.
    pub fn survey_with(&self, smoothing: Smoothing) -> Option<RecordingSurvey> {
        let mut speeds: Vec<Vec<f64>> = Vec::new();
        for part in &self.parts {
            let mut window = SmoothingWindow::new(smoothing);
            for row in part {
                window.push(row.clone(), |instant| {
                    speeds.resize(instant.qd.len(), Vec::new());
                    speeds.iter_mut().zip(&instant.qd).for_each(|(all, qd)| all.push(qd.abs()));
                });
            }
        }
        let fast = |all: &mut Vec<f64>| {
            all.sort_by(f64::total_cmp);
            all.get(all.len() * 19 / 20).copied().unwrap_or(0.0)
        };
        let fast_speeds: Vec<f64> = speeds.iter_mut().map(fast).collect();
        (!fast_speeds.is_empty()).then_some(RecordingSurvey { smoothing, fast_speeds })
    }

    /// What the parts show, with the window by which the description explains the efforts best; `None` if they have too few rows.
    ///
    /// A window that is too short leaves the noise of the positions in the accelerations, one that is too long flattens the motion: both
    /// show in the efforts. By the positions alone the noise of an encoder, which repeats its steps, is not distinguished from motion.
    ///
    /// # Errors
    /// The rows are another robot's.
    pub fn survey(&self, tree: &BodyTree) -> Result<Option<RecordingSurvey>, DynamicsError> {
        let mut tried: Vec<(f64, RecordingSurvey)> = Vec::new();
        for smoothing in Smoothing::candidates(&self.parts) {
            let Some(survey) = self.survey_with(smoothing) else { continue };
            tried.push((self.left(tree, &survey)?, survey));
        }
        let best = tried.iter().map(|(left, _)| *left).fold(f64::INFINITY, f64::min);
        let is_chosen = |(left, _): &(f64, RecordingSurvey)| *left <= AS_GOOD * best;
        let at = tried.iter().position(is_chosen).unwrap_or(0);
        Ok((at < tried.len()).then(|| tried.swap_remove(at).1))
    }

    /// What the description leaves of the efforts, if these may be currents.
    fn left(&self, tree: &BodyTree, survey: &RecordingSurvey) -> Result<f64, DynamicsError> {
        let moving = Instants::Moving(survey.moving_speeds());
        #[expect(clippy::cast_precision_loss, reason = "there are few parts")]
        let duration_s = self.period_s * self.parts.len() as f64;
        let mut collector = Collector::new(tree, survey.smoothing, moving, self.from_s, duration_s);
        for part in &self.parts {
            collector.break_here();
            for row in part {
                collector.push(RecordedRow { time_s: row.time_s, q: &row.q, effort: &row.effort })?;
            }
        }
        let [_, _, as_current] = recognise(&collector.finish()).left;
        Ok(if as_current.is_nan() { f64::INFINITY } else { as_current })
    }
}

/// What a recording shows before its equations.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordingSurvey {
    /// The window.
    pub smoothing: Smoothing,
    /// The speed that each moving joint exceeds in a twentieth of the time, rad/s or m/s.
    pub fast_speeds: Vec<f64>,
}

impl RecordingSurvey {
    /// The speed from which on a joint counts as moving, of each joint; infinite for one that never does.
    pub fn moving_speeds(&self) -> Vec<f64> {
        let of = |fast: &f64| if *fast > 0.0 { MOVING * fast } else { f64::INFINITY };
        self.fast_speeds.iter().map(of).collect()
    }

    /// The speed up to which the robot counts as still.
    pub fn still_speeds(&self) -> Vec<f64> {
        self.fast_speeds.iter().map(|fast| STILL * fast).collect()
    }
}
