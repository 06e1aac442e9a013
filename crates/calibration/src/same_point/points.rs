//! The tool points of a chain whose files each touch one unknown point, and their spread about it.

use congruent_description::ChainQ;
use congruent_kinematics::{
    Twist,
    least_squares::{BalancedCholesky, Damping, damped_step},
};
use nalgebra::{DMatrix, DVector, Vector3};

use crate::estimation::CorrectedChain;

/// Most steps of a fit. Kind: loop bound; some ten are needed.
const MOST_STEPS: usize = 100;
/// A step below this, in rad and m, ends the fit. Kind: solver stop; a micrometre of an arm is a thousand times as much.
const STEP: f64 = 1e-10;
/// Damping of the first step and the largest, relative to the diagonal of the information.
const DAMPING: [f64; 2] = [1e-6, 1e9];
/// A corrected chain with the configurations of each file, in which its tool is at one point that nobody has measured.
#[derive(Debug, Clone, Copy)]
pub(super) struct Points<'a> {
    pub(super) chain: &'a CorrectedChain,
    pub(super) files: &'a [Vec<ChainQ>],
}

/// Corrections with which the tool points of each file are nearest to each other.
#[derive(Debug, Clone)]
pub(super) struct PointFit {
    pub(super) corrections: Vec<f64>,
    /// Of each correction; 0 of one that was not estimated.
    pub(super) standard_deviations: Vec<f64>,
    /// Of one coordinate of a row, m.
    pub(super) noise_m: f64,
    pub(super) converged: bool,
    pub(super) steps: usize,
}

/// Jacobian of all tool points about the mean of their file, three rows for each, and the points themselves so.
struct Centred {
    jacobian: DMatrix<f64>,
    points: DVector<f64>,
}

impl Points<'_> {
    /// Number of rows of all files.
    pub(super) fn rows(&self) -> usize {
        self.files.iter().map(Vec::len).sum()
    }

    /// The tool point of each row in the base, by file, m.
    pub(super) fn tips(&self, p: &[f64]) -> Vec<Vec<Vector3<f64>>> {
        let tip = |q: &ChainQ| self.chain.base_from_tip(q, p).translation;
        self.files.iter().map(|rows| rows.iter().map(tip).collect()).collect()
    }

    /// Distance of each tool point from the mean of its file, by file, m.
    pub(super) fn distances(&self, p: &[f64]) -> Vec<Vec<f64>> {
        let about_mean = |tips: &Vec<Vector3<f64>>| {
            let mean = mean(tips);
            tips.iter().map(|tip| (tip - mean).norm()).collect()
        };
        self.tips(p).iter().map(about_mean).collect()
    }

    /// Largest distance of a nominal tool point from the base, m.
    pub(super) fn reach_m(&self) -> f64 {
        let nominal = vec![0.0; self.chain.parameters().len()];
        let reach = self.tips(&nominal).iter().flatten().map(Vector3::norm).fold(0.0, f64::max);
        if reach > 0.0 { reach } else { 1.0 }
    }

    /// The information about all corrections at the start.
    pub(super) fn information(&self) -> DMatrix<f64> {
        let all: Vec<usize> = (0..self.chain.parameters().len()).collect();
        let Centred { jacobian, .. } = self.centred(self.chain.start(), &all);
        jacobian.transpose() * jacobian
    }

    /// Least squares of the spread over the corrections `kept`, by Levenberg and Marquardt. The points of the files are eliminated:
    /// for given corrections the best one is the mean.
    pub(super) fn fit(&self, kept: &[usize]) -> PointFit {
        let mut p = self.chain.start().to_vec();
        let (mut damping, mut converged, mut steps) = (DAMPING[0], kept.is_empty(), 0);
        let mut centred = self.centred(&p, kept);
        while !converged && steps < MOST_STEPS && damping < DAMPING[1] {
            steps += 1;
            let information = centred.jacobian.transpose() * &centred.jacobian;
            // The residual is the mean minus the point.
            let gradient = -(centred.jacobian.transpose() * &centred.points);
            let damped = Damping { relative: damping, absolute: 0.0 };
            let Some(step) = damped_step(&information, &gradient, damped) else {
                damping *= 10.0;
                continue;
            };
            let mut moved = p.clone();
            kept.iter().zip(step.iter()).for_each(|(&at, step)| moved[at] += step);
            let next = self.centred(&moved, kept);
            if next.points.norm_squared() <= centred.points.norm_squared() {
                (p, centred) = (moved, next);
                damping /= 10.0;
            } else {
                damping *= 10.0;
            }
            converged = step.amax() < STEP;
        }
        let freedom = (centred.points.len()).saturating_sub(3 * self.files.len() + kept.len());
        let noise_m = (centred.points.norm_squared() / at_least_one(freedom)).sqrt();
        let information = centred.jacobian.transpose() * &centred.jacobian;
        let covariance = BalancedCholesky::new(information).map(|factor| factor.inverse());
        let mut standard_deviations = vec![0.0; p.len()];
        for (row, &at) in kept.iter().enumerate() {
            standard_deviations[at] =
                covariance.as_ref().map_or(f64::NAN, |of| noise_m * of[(row, row)].sqrt());
        }
        PointFit { corrections: p, standard_deviations, noise_m, converged, steps }
    }

    fn centred(&self, p: &[f64], kept: &[usize]) -> Centred {
        let mut jacobian = DMatrix::zeros(3 * self.rows(), kept.len());
        let mut points = DVector::zeros(3 * self.rows());
        let mut twists = vec![Twist::zero(); p.len()];
        let mut first = 0;
        for rows in self.files {
            for (at, q) in rows.iter().enumerate() {
                let tip = self.chain.linearise(q, p, &mut twists).translation;
                let row = 3 * (first + at);
                points.fixed_rows_mut::<3>(row).copy_from(&tip);
                for (column, twist) in kept.iter().map(|&at| &twists[at]).enumerate() {
                    let rate = twist.linear + twist.angular.cross(&tip);
                    jacobian.fixed_view_mut::<3, 1>(row, column).copy_from(&rate);
                }
            }
            let range = 3 * first..3 * (first + rows.len());
            for coordinate in 0..3 {
                let every = |values: &mut [f64]| about_mean(&mut values[range.clone()], coordinate);
                every(points.as_mut_slice());
                jacobian.as_mut_slice().chunks_exact_mut(3 * self.rows()).for_each(every);
            }
            first += rows.len();
        }
        Centred { jacobian, points }
    }
}

/// Subtracts the mean of every third value, from `first` on.
fn about_mean(values: &mut [f64], first: usize) {
    let count = at_least_one(values.len() / 3);
    let mean = values.iter().skip(first).step_by(3).sum::<f64>() / count;
    values.iter_mut().skip(first).step_by(3).for_each(|value| *value -= mean);
}

/// The mean of some points.
pub(super) fn mean(points: &[Vector3<f64>]) -> Vector3<f64> {
    points.iter().sum::<Vector3<f64>>() / at_least_one(points.len())
}

/// A count as a divisor; none counts as one.
#[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 rows")]
fn at_least_one(count: usize) -> f64 {
    count.max(1) as f64
}
