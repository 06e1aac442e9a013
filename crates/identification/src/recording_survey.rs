//! What has to be known of a recording before its equations are made: the window, and how fast the joints move.

use congruent_description::RobotQ;

use crate::smoothing::{KeptRow, Smoothing, Window};

/// Parts of a recording that are looked at first. Kind: choice.
const PARTS: f64 = 60.0;
/// Length of each, s: two of the longest windows and a half.
const PART_S: f64 = 1.0;
/// A joint moves if it is faster than this part of the speed that it exceeds in a twentieth of the time. No unit; kind: choice.
const MOVING: f64 = 0.1;
/// A robot is still if its joints are slower than this part of it. No unit; kind: choice.
const STILL: f64 = 0.01;

/// Parts of a recording, evenly over its time, in memory that does not grow with it.
#[derive(Debug)]
pub struct SampledParts {
    from_s: f64,
    period_s: f64,
    parts: Vec<Vec<(f64, RobotQ)>>,
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
    pub fn push(&mut self, time_s: f64, q: &RobotQ) {
        let since_s = (time_s - self.from_s).rem_euclid(self.period_s);
        if since_s > PART_S {
            self.is_connected = false;
            return;
        }
        if !self.is_connected {
            self.parts.push(Vec::new());
            self.is_connected = true;
        }
        if let Some(part) = self.parts.last_mut() {
            part.push((time_s, q.clone()));
        }
    }

    /// What the parts show; `None` if they have too few rows.
    pub fn survey(&self, half_window_s: Option<f64>) -> Option<RecordingSurvey> {
        let chosen = half_window_s.map(|half_window_s| Smoothing { half_window_s });
        let smoothing = chosen.or_else(|| Smoothing::choose(&self.parts))?;
        let mut speeds: Vec<Vec<f64>> = Vec::new();
        for part in &self.parts {
            let mut window = Window::new(smoothing);
            for (time_s, q) in part {
                let row = KeptRow { time_s: *time_s, q: q.clone(), effort: vec![0.0; q.len()] };
                window.push(row, |instant| {
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
