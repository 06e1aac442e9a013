//! What has to be known of a recording before its equations are made: the window, and how fast the joints move.

use std::sync::Arc;

use crate::{
    collect::RecordedRow,
    smoothing::{KeptRow, SmoothedInstant, Smoothing, SmoothingWindow},
};

/// Parts of a recording that are looked at first. Kind: choice.
const PARTS: f64 = 60.0;
/// Length of each, s: five of the longest half windows.
const PART_S: f64 = 1.0;
/// A joint moves if it is faster than this part of the speed that it exceeds in a twentieth of the time. No unit; kind: choice.
const MOVING: f64 = 0.1;
/// A robot is still if its joints are slower than this part of it. No unit; kind: choice.
const STILL: f64 = 0.01;

/// A window is long enough if this part of the squares of the accelerations is noise: by as much an armature seems smaller than it is. No
/// unit; kind: choice.
const NOISE: f64 = 1e-3;
/// A joint moves if less than this part of the squares of its velocities is noise. No unit; kind: choice.
const MOVES: f64 = 0.01;

/// Parts of a recording, evenly over its time, in memory that does not grow with it.
#[derive(Debug)]
pub struct SampledParts {
    from_s: f64,
    period_s: f64,
    parts: Vec<Vec<Arc<KeptRow>>>,
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
        self.seen_with(smoothing).map(|seen| seen.survey)
    }

    /// What the parts show, with the shortest window that averages the noise of the positions out of the accelerations; `None` if they
    /// have too few rows. Longer windows flatten the motion.
    pub fn survey(&self) -> Option<RecordingSurvey> {
        let seen = Smoothing::candidates(&self.parts).into_iter().filter_map(|of| self.seen_with(of));
        let mut seen: Vec<SeenWithWindow> = seen.collect();
        let joints = 0..seen.last()?.means.len();
        // The residual of a polynomial is noise, and motion that it does not describe: of the latter, some window has least.
        let least =
            |joint: usize| seen.iter().map(|of| of.means[joint].q_variance).fold(f64::INFINITY, f64::min);
        let noise: Vec<f64> = joints.clone().map(least).collect();
        // The longest window decides which joints move: its velocities have the least noise.
        let longest = seen.last()?;
        let moves: Vec<bool> =
            joints.map(|joint| longest.noise_of_velocity(joint, noise[joint]) < MOVES).collect();
        let part_of = |of: &SeenWithWindow| {
            let moving = (0..noise.len()).filter(|joint| moves[*joint]);
            moving.map(|joint| of.noise_of_acceleration(joint, noise[joint])).fold(0.0, f64::max)
        };
        let best = seen.iter().map(part_of).fold(f64::INFINITY, f64::min);
        let at = seen.iter().position(|of| part_of(of) <= best.max(NOISE))?;
        let mut chosen = seen.swap_remove(at).survey;
        // The speed of a joint at rest is noise.
        let speeds = chosen.fast_speeds.iter_mut().zip(&moves);
        speeds.filter(|(_, moves)| !**moves).for_each(|(speed, _)| *speed = 0.0);
        Some(chosen)
    }

    fn seen_with(&self, smoothing: Smoothing) -> Option<SeenWithWindow> {
        let mut speeds: Vec<Vec<f64>> = Vec::new();
        let mut means: Vec<MeanSquares> = Vec::new();
        for part in &self.parts {
            let mut window = SmoothingWindow::new(smoothing);
            for row in part {
                window.push(Arc::clone(row), |instant| {
                    speeds.resize(instant.qd.len(), Vec::new());
                    speeds.iter_mut().zip(&instant.qd).for_each(|(speeds, qd)| speeds.push(qd.abs()));
                    means.resize(instant.qd.len(), MeanSquares::default());
                    means.iter_mut().enumerate().for_each(|(joint, mean)| mean.add(instant, joint));
                });
            }
        }
        let fast = |all: &mut Vec<f64>| {
            all.sort_by(f64::total_cmp);
            all.get(all.len() * 19 / 20).copied().unwrap_or(0.0)
        };
        let fast_speeds: Vec<f64> = speeds.iter_mut().map(fast).collect();
        let survey = RecordingSurvey { smoothing, fast_speeds };
        (!means.is_empty()).then_some(SeenWithWindow { survey, means })
    }
}

/// Means over the instants of a window, of one joint.
#[derive(Debug, Clone, Copy, Default)]
struct MeanSquares {
    count: f64,
    qd: f64,
    qdd: f64,
    q_variance: f64,
    of_derivatives: [f64; 2],
}

impl MeanSquares {
    fn add(&mut self, instant: &SmoothedInstant, joint: usize) {
        self.count += 1.0;
        let part = 1.0 / self.count;
        let mut mean = |mean: fn(&mut Self) -> &mut f64, value: f64| {
            let mean = mean(self);
            *mean += part * (value - *mean);
        };
        mean(|of| &mut of.qd, instant.qd[joint].powi(2));
        mean(|of| &mut of.qdd, instant.qdd[joint].powi(2));
        mean(|of| &mut of.q_variance, instant.q_variance[joint]);
        mean(|of| &mut of.of_derivatives[0], instant.of_derivatives[0]);
        mean(|of| &mut of.of_derivatives[1], instant.of_derivatives[1]);
    }
}

/// What the parts show with a window.
struct SeenWithWindow {
    survey: RecordingSurvey,
    means: Vec<MeanSquares>,
}

impl SeenWithWindow {
    /// The part of the squares of the velocities that is noise, of positions with this variance.
    fn noise_of_velocity(&self, joint: usize, variance: f64) -> f64 {
        let of = &self.means[joint];
        if of.qd > 0.0 { variance * of.of_derivatives[0] / of.qd } else { f64::INFINITY }
    }

    /// The same of the accelerations.
    fn noise_of_acceleration(&self, joint: usize, variance: f64) -> f64 {
        let of = &self.means[joint];
        if of.qdd > 0.0 { variance * of.of_derivatives[1] / of.qdd } else { f64::INFINITY }
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
