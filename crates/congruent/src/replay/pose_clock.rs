//! How late the clock of the poses is against that of the joints.
//!
//! The offset `a` and the drift `b` minimise the distance of the recorded positions from those of the model at
//! `t + a + b t`, by Gauss-Newton from the best of a grid of offsets.

use nalgebra::{Matrix2, Vector2, Vector3};

use super::paired::OFFSETS_S;

/// Fewest poses for which a clock is estimated.
const FEWEST: usize = 30;
/// The estimate counts if the distance becomes smaller than this share of what it was: errors of the arm, which an offset explains in
/// part, are no clock.
const SHARE: f64 = 0.5;
/// Offsets that are smaller are none, s: the jitter of stamps.
const SMALLEST_S: f64 = 1e-3;
const ITERATIONS: usize = 20;

/// The positions by the model at each offset, and the recorded one.
#[derive(Debug, Clone)]
pub(super) struct PositionsOverOffsets {
    pub(super) time_s: f64,
    pub(super) by_model: Vec<Vector3<f64>>,
    pub(super) recorded: Vector3<f64>,
}

/// The clock of poses.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct PoseClock {
    /// Is added to their times, s.
    pub(super) offset_s: f64,
    /// Is multiplied by their times and added, s/s.
    pub(super) drift: f64,
    /// Standard deviation of the offset, s.
    pub(super) sigma_s: f64,
    /// Root mean square of the distances with it, m.
    pub(super) rms_m: f64,
}

/// The clock, or that of the joints if another one does not bring the positions much nearer.
pub(super) fn pose_clock(positions: &[PositionsOverOffsets]) -> PoseClock {
    let none = PoseClock { rms_m: rms(positions, 0.0, 0.0), ..PoseClock::default() };
    if positions.len() < FEWEST {
        return none;
    }
    let by_rms = |a: &f64, b: &f64| rms(positions, *a, 0.0).total_cmp(&rms(positions, *b, 0.0));
    let mut clock = PoseClock { offset_s: OFFSETS_S.into_iter().min_by(by_rms).unwrap_or_default(), ..none };
    for _ in 0..ITERATIONS {
        let Some((step, sigma_s)) = step(positions, &clock) else { return none };
        (clock.offset_s, clock.drift, clock.sigma_s) =
            (clock.offset_s + step.x, clock.drift + step.y, sigma_s);
        if step.x.abs() < 1e-9 {
            break;
        }
    }
    clock.rms_m = rms(positions, clock.offset_s, clock.drift);
    let is_better = clock.rms_m < SHARE * none.rms_m;
    let largest_s = OFFSETS_S[OFFSETS_S.len() - 1];
    if is_better && (SMALLEST_S..largest_s).contains(&clock.offset_s.abs()) { clock } else { none }
}

/// A step of Gauss-Newton, with the standard deviation of the offset; `None` if the arm does not move.
fn step(positions: &[PositionsOverOffsets], clock: &PoseClock) -> Option<(Vector2<f64>, f64)> {
    const APART_S: f64 = 1e-4;
    let (mut normal, mut right, mut squares) = (Matrix2::zeros(), Vector2::zeros(), 0.0);
    let mean_s = positions.iter().map(|at| at.time_s).sum::<f64>() / count(positions.len());
    for at in positions {
        let offset_s = clock.offset_s + clock.drift * at.time_s;
        let speed = (at.at(offset_s + APART_S) - at.at(offset_s - APART_S)) / (2.0 * APART_S);
        let error = at.recorded - at.at(offset_s);
        // About the mean time, since offset and drift about 0 are hard to distinguish in a late part of a log.
        let row = [speed, speed * (at.time_s - mean_s)];
        normal +=
            Matrix2::new(row[0].dot(&row[0]), row[0].dot(&row[1]), row[1].dot(&row[0]), row[1].dot(&row[1]));
        right += Vector2::new(row[0].dot(&error), row[1].dot(&error));
        squares += error.norm_squared();
    }
    let inverse = normal.try_inverse()?;
    let solved = inverse * right;
    let variance = squares / count(3 * positions.len() - 2);
    Some((Vector2::new(solved.x - solved.y * mean_s, solved.y), (variance * inverse[(0, 0)]).sqrt()))
}

fn rms(positions: &[PositionsOverOffsets], offset_s: f64, drift: f64) -> f64 {
    let squares =
        positions.iter().map(|at| (at.recorded - at.at(offset_s + drift * at.time_s)).norm_squared());
    (squares.sum::<f64>() / count(positions.len().max(1))).sqrt()
}

#[expect(clippy::cast_precision_loss, reason = "some hundred")]
fn count(number: usize) -> f64 {
    number as f64
}

impl PositionsOverOffsets {
    /// The distance without an offset.
    pub(super) fn distance_m(&self) -> f64 {
        (self.recorded - self.by_model[OFFSETS_S.len() / 2]).norm()
    }

    /// The position by the model at an offset, by the parabola through the three nearest.
    fn at(&self, offset_s: f64) -> Vector3<f64> {
        let after = OFFSETS_S.partition_point(|known| *known < offset_s);
        let first = after.saturating_sub(1).min(OFFSETS_S.len() - 3);
        let [x0, x1, x2] = [first, first + 1, first + 2].map(|at| OFFSETS_S[at]);
        let weights = [
            (offset_s - x1) * (offset_s - x2) / ((x0 - x1) * (x0 - x2)),
            (offset_s - x0) * (offset_s - x2) / ((x1 - x0) * (x1 - x2)),
            (offset_s - x0) * (offset_s - x1) / ((x2 - x0) * (x2 - x1)),
        ];
        (0..3).map(|at| self.by_model[first + at] * weights[at]).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point on a circle of 0.5 m with 1 rad/s whose recorded stamps are late.
    fn moving(late_s: f64, drift: f64) -> Vec<PositionsOverOffsets> {
        let point = |t: f64| Vector3::new(0.5 * t.cos(), 0.5 * t.sin(), 0.1 * (2.0 * t).sin());
        let at = |number: u32| {
            let time_s = f64::from(number) * 0.05;
            PositionsOverOffsets {
                time_s,
                by_model: OFFSETS_S.iter().map(|offset_s| point(time_s + offset_s)).collect(),
                recorded: point(time_s + late_s + drift * time_s),
            }
        };
        (0..200).map(at).collect()
    }

    #[test]
    fn an_offset_with_drift_is_found() {
        let found = pose_clock(&moving(-0.035, 2e-4));
        assert!((found.offset_s + 0.035).abs() < 1e-5 && (found.drift - 2e-4).abs() < 1e-6, "{found:?}");
        assert!(found.rms_m < 1e-5, "{found:?}");
    }

    #[test]
    fn the_clock_of_the_joints_stays() {
        let found = pose_clock(&moving(0.0, 0.0));
        assert!(found.offset_s.abs() + found.drift.abs() < f64::EPSILON, "{found:?}");
        // A constant error is no clock.
        let shifted: Vec<_> = moving(0.0, 0.0)
            .into_iter()
            .map(|at| PositionsOverOffsets { recorded: at.recorded + Vector3::z() * 0.01, ..at })
            .collect();
        assert!(pose_clock(&shifted).offset_s.abs() < f64::EPSILON);
    }
}
