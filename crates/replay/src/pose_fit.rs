//! Base, target and clock of recorded poses, fitted together.
//!
//! The parameters are a displacement of the frame of the poses, one of the target, and the offset `a` and drift `b` of their clock:
//! recorded = frame model(t + a + b t) target. A clock alone would take over a part of a wrong frame, and the other way round.
//! Levenberg-Marquardt with central differences.

use congruent_kinematics::least_squares::{Damping, damped_step};
use nalgebra::{DMatrix, DVector, Isometry3, Translation3, UnitQuaternion, Vector3, Vector6};

use super::paired::OFFSETS_S;

/// A length that makes angles and distances one number, m: the reach of a wrist.
const LENGTH_M: f64 = 0.3;
/// Fewest poses for which a clock is estimated.
const FEWEST: usize = 30;
/// A clock counts if the residual becomes smaller than this share of what it is without one: errors of the arm, which an offset
/// explains in part, are no clock.
const SHARE: f64 = 0.7;
/// And if it is larger than so many of its standard deviations.
const SIGMAS: f64 = 5.0;
/// Offsets that are smaller are none, s: the jitter of stamps.
const SMALLEST_S: f64 = 1e-3;
const ITERATIONS: usize = 40;
/// Parameters: of the frame, of the target, offset, drift.
const PARAMETERS: usize = 14;
const OFFSET: usize = 12;
const DRIFT: usize = 13;

/// A recorded pose, and those of the model at each offset of the clock.
#[derive(Debug, Clone)]
pub(super) struct PoseOverOffsets {
    pub(super) time_s: f64,
    pub(super) by_model: Vec<Isometry3<f64>>,
    pub(super) recorded: Isometry3<f64>,
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
}

/// Displacements and clock of poses.
#[derive(Debug, Clone, Copy)]
pub(super) struct FittedPoses {
    pub(super) clock: PoseClock,
    /// The fitted frame in the assumed one, and the assumed target in the fitted one: recorded = frame model target.
    pub(super) frame: Isometry3<f64>,
    pub(super) target: Isometry3<f64>,
    /// Root mean square of the distances with all of it, m.
    pub(super) rms_m: f64,
}

/// The poses of one target, in order of time.
pub(super) struct PosesToFit<'a> {
    pub(super) poses: &'a [PoseOverOffsets],
    /// Whether the rotations are known.
    pub(super) with_rotations: bool,
}

/// An estimate with its parameters.
struct Estimate {
    values: [f64; PARAMETERS],
    /// Sum of squared residuals.
    squares: f64,
    /// Standard deviations of offset and drift.
    sigmas: [f64; 2],
}

impl PosesToFit<'_> {
    /// Frame, target and clock; the clock is that of the joints unless another one makes the residual much smaller.
    pub(super) fn fit(&self) -> FittedPoses {
        let frames: Vec<usize> = (0..OFFSET).collect();
        let none = self.estimate([0.0; PARAMETERS], &frames);
        if self.poses.len() < FEWEST {
            return self.fitted(&none);
        }
        let with_offset: Vec<usize> = (0..=OFFSET).collect();
        let start = self.start_of_offset(&none.values);
        let offset = self.estimate(start, &with_offset);
        let all: Vec<usize> = (0..PARAMETERS).collect();
        let drifting = self.estimate(offset.values, &all);
        let has_drift = drifting.values[DRIFT].abs() > SIGMAS * drifting.sigmas[1];
        let clock = if has_drift { drifting } else { offset };
        let offset_s = clock.values[OFFSET].abs();
        let is_better = clock.squares.sqrt() < SHARE * none.squares.sqrt();
        let is_known = (SMALLEST_S.max(SIGMAS * clock.sigmas[0])..largest_offset_s()).contains(&offset_s);
        self.fitted(if is_better && is_known { &clock } else { &none })
    }

    /// The best of a grid of offsets for fitted frames.
    fn start_of_offset(&self, values: &[f64; PARAMETERS]) -> [f64; PARAMETERS] {
        let at = |offset_s: f64| {
            let mut values = *values;
            values[OFFSET] = offset_s;
            values
        };
        let by_squares = |a: &f64, b: &f64| self.squares(&at(*a)).total_cmp(&self.squares(&at(*b)));
        at(OFFSETS_S.into_iter().min_by(by_squares).unwrap_or_default())
    }

    fn fitted(&self, estimate: &Estimate) -> FittedPoses {
        let Estimate { values, sigmas, .. } = estimate;
        let clock = PoseClock { offset_s: values[OFFSET], drift: values[DRIFT], sigma_s: sigmas[0] };
        let (frame, target) = (displacement(&values[..6]), displacement(&values[6..12]));
        let shift = |pose| residual(pose, values).fixed_rows::<3>(0).norm_squared();
        let squares: f64 = self.poses.iter().map(shift).sum();
        FittedPoses { clock, frame, target, rms_m: (squares / count(self.poses.len())).sqrt() }
    }

    fn rows(&self) -> usize {
        if self.with_rotations { 6 } else { 3 }
    }

    fn residuals(&self, values: &[f64; PARAMETERS]) -> DVector<f64> {
        let rows = self.rows();
        let mut all = DVector::zeros(rows * self.poses.len());
        for (at, pose) in self.poses.iter().enumerate() {
            all.rows_mut(rows * at, rows).copy_from(&residual(pose, values).rows(0, rows));
        }
        all
    }

    fn squares(&self, values: &[f64; PARAMETERS]) -> f64 {
        self.residuals(values).norm_squared()
    }

    /// Least squares over the `free` parameters.
    fn estimate(&self, start: [f64; PARAMETERS], free: &[usize]) -> Estimate {
        let (mut values, mut damping) = (start, 1e-6);
        let mut residuals = self.residuals(&values);
        let mut normal = DMatrix::zeros(free.len(), free.len());
        for _ in 0..ITERATIONS {
            let jacobian = self.jacobian(&values, free);
            normal = jacobian.tr_mul(&jacobian);
            let right = jacobian.tr_mul(&residuals);
            let absolute = damping * normal.diagonal().max();
            let Some(step) = damped_step(&normal, &right, Damping { relative: 0.0, absolute }) else { break };
            let mut next = values;
            free.iter().zip(step.iter()).for_each(|(&at, step)| next[at] -= step);
            let there = self.residuals(&next);
            if there.norm_squared() < residuals.norm_squared() {
                let gain = 1.0 - there.norm_squared() / residuals.norm_squared();
                (values, residuals, damping) = (next, there, (damping * 0.1).max(1e-12));
                if gain < 1e-9 {
                    break;
                }
            } else {
                damping *= 10.0;
                if damping > 1e3 {
                    break;
                }
            }
        }
        let squares = residuals.norm_squared();
        let variance = squares / count(residuals.len().saturating_sub(free.len()).max(1));
        let inverse = normal.pseudo_inverse(f64::EPSILON).ok();
        let sigma = |parameter: usize| {
            let at = free.iter().position(|&of| of == parameter);
            at.zip(inverse.as_ref()).map_or(0.0, |(at, inverse)| (variance * inverse[(at, at)]).sqrt())
        };
        Estimate { values, squares, sigmas: [sigma(OFFSET), sigma(DRIFT)] }
    }

    fn jacobian(&self, values: &[f64; PARAMETERS], free: &[usize]) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(self.rows() * self.poses.len(), free.len());
        for (column, &parameter) in free.iter().enumerate() {
            let apart = if parameter == OFFSET { 1e-4 } else { 1e-6 };
            let moved = |by: f64| {
                let mut moved = *values;
                moved[parameter] += by;
                self.residuals(&moved)
            };
            jacobian.set_column(column, &((moved(apart) - moved(-apart)) / (2.0 * apart)));
        }
        jacobian
    }
}

/// The largest offset that can be found, s.
pub(super) fn largest_offset_s() -> f64 {
    OFFSETS_S[OFFSETS_S.len() - 1]
}

#[expect(clippy::cast_precision_loss, reason = "some thousand")]
fn count(number: usize) -> f64 {
    number as f64
}

fn displacement(values: &[f64]) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(values[3], values[4], values[5]));
    Isometry3::from_parts(Translation3::new(values[0], values[1], values[2]), rotation)
}

fn modelled(pose: &PoseOverOffsets, values: &[f64; PARAMETERS]) -> Isometry3<f64> {
    let at = pose.at(values[OFFSET] + values[DRIFT] * pose.time_s);
    displacement(&values[..6]) * at * displacement(&values[6..12])
}

fn residual(pose: &PoseOverOffsets, values: &[f64; PARAMETERS]) -> Vector6<f64> {
    let modelled = modelled(pose, values);
    let shift = modelled.translation.vector - pose.recorded.translation.vector;
    let turn = (modelled.rotation * pose.recorded.rotation.inverse()).scaled_axis() * LENGTH_M;
    Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
}

impl PoseOverOffsets {
    /// Distance of the positions at an offset, m.
    pub(super) fn distance_m(&self, clock: &PoseClock) -> f64 {
        let at = self.at(clock.offset_s + clock.drift * self.time_s);
        (self.recorded.translation.vector - at.translation.vector).norm()
    }

    /// The pose by the model at an offset, by the parabola through the three nearest.
    fn at(&self, offset_s: f64) -> Isometry3<f64> {
        let after = OFFSETS_S.partition_point(|known| *known < offset_s);
        let first = after.saturating_sub(1).min(OFFSETS_S.len() - 3);
        let [x0, x1, x2] = [first, first + 1, first + 2].map(|at| OFFSETS_S[at]);
        let weights = [
            (offset_s - x1) * (offset_s - x2) / ((x0 - x1) * (x0 - x2)),
            (offset_s - x0) * (offset_s - x2) / ((x1 - x0) * (x1 - x2)),
            (offset_s - x0) * (offset_s - x1) / ((x2 - x0) * (x2 - x1)),
        ];
        let nearest = &self.by_model[first + 1];
        let (mut position, mut turn) = (Vector3::zeros(), Vector3::zeros());
        for (pose, weight) in self.by_model[first..].iter().zip(weights) {
            position += pose.translation.vector * weight;
            turn += (nearest.rotation.inverse() * pose.rotation).scaled_axis() * weight;
        }
        let rotation = nearest.rotation * UnitQuaternion::from_scaled_axis(turn);
        Isometry3::from_parts(Translation3::from(position), rotation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moving_target(t: f64) -> Isometry3<f64> {
        let position = Vector3::new(0.5 * t.cos(), 0.5 * t.sin(), 0.3 + 0.1 * (1.7 * t).sin());
        let turn = Vector3::new(0.8 * (0.9 * t).sin(), 0.6 * (1.3 * t).cos(), 0.5 * t.sin());
        Isometry3::from_parts(position.into(), UnitQuaternion::from_scaled_axis(turn))
    }

    /// A target on a path whose recorded stamps are late, in another frame, of another target.
    fn recorded(
        late_s: f64,
        drift: f64,
        frame: Isometry3<f64>,
        target: Isometry3<f64>,
    ) -> Vec<PoseOverOffsets> {
        let at = |number: u32| {
            let time_s = f64::from(number) * 0.05;
            PoseOverOffsets {
                time_s,
                by_model: OFFSETS_S.iter().map(|offset_s| moving_target(time_s + offset_s)).collect(),
                recorded: frame * moving_target(time_s + late_s + drift * time_s) * target,
            }
        };
        (0..200).map(at).collect()
    }

    #[test]
    fn offset_drift_and_frames_are_found_together() {
        let frame = displacement(&[0.03, -0.02, 0.05, 0.02, 0.01, -0.03]);
        let target = displacement(&[0.01, 0.02, 0.0, 0.0, 0.03, 0.01]);
        for with_rotations in [true, false] {
            for late_s in [-0.08, 0.02, 0.2] {
                let poses = recorded(late_s, 2e-4, frame, target);
                let found = PosesToFit { poses: &poses, with_rotations }.fit();
                assert!((found.clock.offset_s - late_s).abs() < 5e-4, "{late_s}: {found:?}");
                assert!(found.rms_m < 2e-4, "{late_s}: {found:?}");
            }
        }
    }

    #[test]
    fn the_clock_of_the_joints_stays_beside_other_frames() {
        let frame = displacement(&[0.03, -0.02, 0.05, 0.0, 0.0, 0.0]);
        for frame in [Isometry3::identity(), frame] {
            let poses = recorded(0.0, 0.0, frame, Isometry3::identity());
            let found = PosesToFit { poses: &poses, with_rotations: true }.fit();
            assert!(found.clock.offset_s.abs() + found.clock.drift.abs() < f64::EPSILON, "{found:?}");
        }
    }
}
