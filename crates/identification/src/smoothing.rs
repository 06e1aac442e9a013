//! Positions, velocities, accelerations and efforts at one instant, from the rows around it.

use std::{collections::VecDeque, sync::Arc};

use congruent_description::RobotQ;
use nalgebra::{Matrix5, Vector5};

/// A polynomial is fitted to the rows of a window. Its degree: with 4, the acceleration at the middle is exact to the fifth power.
const DEGREE: usize = 4;
/// Fewest rows of a window: two more than the coefficients.
const FEWEST_ROWS: usize = DEGREE + 3;
/// Half windows that are tried, s: longer ones flatten the motion of an arm. Kind: choice.
const LONGEST_S: f64 = 0.2;
/// Each window that is tried is longer than the one before by this factor. Kind: choice.
const LONGER: f64 = 1.6;
/// A part of a half window that rows have to reach on both sides.
const REACHED: f64 = 0.7;

/// One row of a recording.
#[derive(Debug, Clone)]
pub(crate) struct KeptRow {
    pub(crate) time_s: f64,
    pub(crate) q: RobotQ,
    pub(crate) effort: Vec<f64>,
}

/// The window that smooths a recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smoothing {
    /// From its middle to its end, s.
    pub half_window_s: f64,
}

/// A joint state without noise.
#[derive(Debug, Clone)]
pub struct SmoothedInstant {
    /// When, s.
    pub time_s: f64,
    /// Positions, rad or m.
    pub q: RobotQ,
    /// Velocities, rad/s or m/s.
    pub qd: Vec<f64>,
    /// Accelerations, rad/s^2 or m/s^2.
    pub qdd: Vec<f64>,
    /// Efforts as recorded; NaN where one is missing in the window.
    pub effort: Vec<f64>,
    /// Their derivatives by the time.
    pub effort_rate: Vec<f64>,
    /// Variance of the positions about the polynomial of the window: noise of the encoders, rad^2 or m^2.
    pub q_variance: Vec<f64>,
    /// The same of the efforts.
    pub effort_variance: Vec<f64>,
    /// By what variances of values are multiplied to be those of their first and second derivatives, 1/s^2 and 1/s^4.
    pub of_derivatives: [f64; 2],
    /// The change of the velocities from the beginning to the end of the window, as its polynomial has it, rad/s or m/s.
    pub velocity_change: Vec<f64>,
}

/// What the rows of a window are multiplied by: value, first and second derivative at the middle.
struct DerivativeWeights {
    value: Vec<f64>,
    first: Vec<f64>,
    second: Vec<f64>,
    third: Vec<f64>,
}

impl Smoothing {
    /// Windows for rows at these times, from the shortest one that always has enough rows.
    pub(crate) fn candidates(parts: &[Vec<Arc<KeptRow>>]) -> Vec<Self> {
        let mut periods: Vec<f64> = parts
            .iter()
            .flat_map(|part| part.windows(2).map(|pair| pair[1].time_s - pair[0].time_s))
            .collect();
        periods.retain(|period| *period > 0.0);
        periods.sort_by(f64::total_cmp);
        let Some(period_s) = periods.get(periods.len() / 2) else { return Vec::new() };
        Self::of_period(*period_s).collect()
    }

    /// Windows for rows that are this far apart.
    pub(crate) fn of_period(period_s: f64) -> impl Iterator<Item = Self> {
        // Wherever its middle is between two rows.
        #[expect(clippy::cast_precision_loss, reason = "it is small")]
        let shortest_s = period_s * FEWEST_ROWS as f64 * 0.52;
        let longer = std::iter::successors(Some(shortest_s), |half_window_s| Some(half_window_s * LONGER));
        longer
            .enumerate()
            .take_while(|(at, half_window_s)| *at == 0 || *half_window_s <= LONGEST_S)
            .map(|(_, half_window_s)| Self { half_window_s })
    }
}

/// Powers of the times of a window, and the inverse of their normal equations.
struct Polynomial {
    powers: Vec<Vector5<f64>>,
    inverse: Matrix5<f64>,
}

impl Polynomial {
    /// `None` if the rows do not fill the window.
    fn new(times_s: &[f64], center_s: f64, half_window_s: f64) -> Option<Self> {
        let (first, last) = (times_s.first()?, times_s.last()?);
        let is_filled =
            center_s - first >= REACHED * half_window_s && last - center_s >= REACHED * half_window_s;
        if times_s.len() < FEWEST_ROWS || !is_filled {
            return None;
        }
        let powers: Vec<Vector5<f64>> = times_s
            .iter()
            .map(|time_s| {
                let s = (time_s - center_s) / half_window_s;
                Vector5::new(1.0, s, s * s, s * s * s, s * s * s * s)
            })
            .collect();
        let normal = powers.iter().map(|powers| powers * powers.transpose()).sum::<Matrix5<f64>>();
        Some(Self { inverse: normal.cholesky()?.inverse(), powers })
    }

    /// Variance of values about the polynomial that is nearest to them.
    fn variance(&self, values: impl Iterator<Item = f64> + Clone) -> f64 {
        let right: Vector5<f64> =
            self.powers.iter().zip(values.clone()).map(|(powers, value)| powers * value).sum();
        let coefficients = self.inverse * right;
        let left = self.powers.iter().zip(values);
        let left: f64 = left.map(|(powers, value)| (value - powers.dot(&coefficients)).powi(2)).sum();
        #[expect(clippy::cast_precision_loss, reason = "windows have few rows")]
        let freedom = (self.powers.len() - DEGREE - 1) as f64;
        left / freedom
    }

    fn weights(&self, half_window_s: f64) -> DerivativeWeights {
        let of = |row: usize, factor: f64| {
            self.powers.iter().map(|powers| (self.inverse.row(row) * powers)[0] * factor).collect()
        };
        let h = half_window_s;
        DerivativeWeights {
            value: of(0, 1.0),
            first: of(1, 1.0 / h),
            second: of(2, 2.0 / (h * h)),
            third: of(3, 6.0 / (h * h * h)),
        }
    }
}

/// A joint that turns or shifts by more from one row to the next has been counted anew, as an angle from pi to -pi. rad or m; kind: choice.
const JUMP: f64 = 3.0;

fn jumps(before: &RobotQ, after: &RobotQ) -> bool {
    before.iter().zip(after.iter()).any(|(before, after)| (after - before).abs() > JUMP)
}

/// Rows around the next instant.
#[derive(Debug)]
pub(crate) struct SmoothingWindow {
    smoothing: Smoothing,
    /// Shared with windows of other lengths.
    rows: VecDeque<Arc<KeptRow>>,
    /// The middle of the next window, s.
    next_s: Option<f64>,
}

impl SmoothingWindow {
    pub(crate) fn new(smoothing: Smoothing) -> Self {
        Self { smoothing, rows: VecDeque::new(), next_s: None }
    }

    /// Ends a part: the next row is not connected with those before.
    pub(crate) fn break_here(&mut self) {
        self.rows.clear();
        self.next_s = None;
    }

    /// Adds a row, and gives each instant whose window is complete to `each`: one every half of a half window.
    ///
    /// A row at which a joint was counted anew is not connected with those before.
    pub(crate) fn push(&mut self, row: Arc<KeptRow>, mut each: impl FnMut(&SmoothedInstant)) {
        if self.rows.back().is_some_and(|last| jumps(&last.q, &row.q)) {
            self.break_here();
        }
        let h = self.smoothing.half_window_s;
        let newest_s = row.time_s;
        let mut next_s = *self.next_s.get_or_insert(newest_s + h);
        self.rows.push_back(row);
        while newest_s >= next_s + h {
            if let Some(instant) = self.instant(next_s) {
                each(&instant);
            }
            next_s += h / 2.0;
            while self.rows.front().is_some_and(|oldest| oldest.time_s < next_s - h) {
                self.rows.pop_front();
            }
        }
        self.next_s = Some(next_s);
    }

    fn instant(&self, center_s: f64) -> Option<SmoothedInstant> {
        let h = self.smoothing.half_window_s;
        let inside = || self.rows.iter().take_while(|row| row.time_s <= center_s + h);
        let times: Vec<f64> = inside().map(|row| row.time_s).collect();
        let polynomial = Polynomial::new(&times, center_s, h)?;
        let weights = polynomial.weights(h);
        let first = self.rows.front()?;
        let joints = first.effort.len();
        let sum = |weights: &[f64], value: &dyn Fn(&KeptRow) -> f64| -> f64 {
            inside().zip(weights).map(|(row, weight)| weight * value(row)).sum()
        };
        // Derivatives of differences to the first row: a joint that does not move has none, without rounding.
        let derivative = |weights: &[f64]| -> Vec<f64> {
            (0..joints).map(|joint| sum(weights, &|row| row.q[joint] - first.q[joint])).collect()
        };
        let variances = |value: &dyn Fn(&KeptRow, usize) -> f64| -> Vec<f64> {
            (0..joints).map(|joint| polynomial.variance(inside().map(|row| value(row, joint)))).collect()
        };
        let squares = |weights: &[f64]| weights.iter().map(|weight| weight * weight).sum::<f64>();
        let (second, third) = (derivative(&weights.second), derivative(&weights.third));
        let moved = derivative(&weights.value);
        Some(SmoothedInstant {
            time_s: center_s,
            q: (0..joints).map(|joint| first.q[joint] + moved[joint]).collect(),
            qd: derivative(&weights.first),
            // From -h to h the even terms of the velocity cancel.
            velocity_change: second
                .iter()
                .zip(&third)
                .map(|(second, third)| (second * h).abs() + third.abs() * h * h / 2.0)
                .collect(),
            qdd: second,
            effort: (0..joints).map(|joint| sum(&weights.value, &|row| row.effort[joint])).collect(),
            q_variance: variances(&|row, joint| row.q[joint] - first.q[joint]),
            effort_variance: variances(&|row, joint| row.effort[joint]),
            of_derivatives: [squares(&weights.first), squares(&weights.second)],
            effort_rate: (0..joints).map(|joint| sum(&weights.first, &|row| row.effort[joint])).collect(),
        })
    }
}
