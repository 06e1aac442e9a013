//! The parameters that explain recorded efforts best.

use congruent_dynamics::PARAMETERS;
use congruent_kinematics::least_squares::BalancedCholesky;
use nalgebra::{DMatrix, DVector};

use crate::{
    equations::{BLOCKS, JointEquations, RecordedEquations, SummedRows},
    free_bodies::free_bodies,
    indistinct::dependent,
    solve::{Bounds, Quadratic},
    unknowns::{FreeUnknowns, JointUnknown, UnknownOrder},
};

/// The residual of the effort of a joint after an estimate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointNoise {
    /// Root mean square, N m or N.
    pub rms: f64,
    /// Rows that it is of.
    pub rows: usize,
    /// How many rows count as one, since the residual of an instant resembles the residual of the next one.
    pub alike: f64,
}

impl JointNoise {
    fn weight(&self) -> f64 {
        1.0 / (self.rms * self.rms * self.alike)
    }
}

/// An estimate of the free parameters.
#[derive(Debug, Clone)]
pub struct ParameterEstimate {
    /// All unknowns: the free ones as estimated, the others as the description has them.
    pub(crate) x: DVector<f64>,
    /// The free unknowns.
    pub(crate) free: Vec<usize>,
    /// Covariance of the free unknowns.
    pub(crate) covariance: DMatrix<f64>,
    /// Unknowns that would be free, and what they cannot be distinguished from.
    pub(crate) held: Vec<(usize, Vec<usize>)>,
    /// Combinations of the free inertial parameters that the recording says more of than was known before, and how many there are.
    pub(crate) known_combinations: [usize; 2],
    /// The residual, of each driven joint.
    pub noise: Vec<JointNoise>,
}

impl ParameterEstimate {
    /// Standard error of an unknown; `None` if it was not free.
    pub(crate) fn standard_error(&self, unknown: usize) -> Option<f64> {
        let at = self.free.iter().position(|of| *of == unknown)?;
        Some(self.covariance[(at, at)].max(0.0).sqrt())
    }

    /// Covariance of ten inertial parameters; `None` if they were not free.
    pub(crate) fn covariance_of(&self, first: usize) -> Option<DMatrix<f64>> {
        let at = self.free.iter().position(|of| *of == first)?;
        Some(self.covariance.view((at, at), (PARAMETERS, PARAMETERS)).into_owned())
    }
}

/// The noise is estimated from the residual, and weighs the joints in the next estimate. Kind: choice; the third changes it by less
/// than a percent.
const ROUNDS: usize = 4;
/// What is thought to be left at first, as part of the effort: so little that what was known before has no weight, or it would stay
/// what it was and be the noise. No unit; kind: choice.
const AT_FIRST: f64 = 1e-4;
/// The residual is at least this part of the effort: rounding in the sums of squares. No unit; kind: rounding.
const LEAST_LEFT: f64 = 1e-7;

/// The estimate from some of the blocks. `None` if no joint has rows.
pub(crate) fn estimate(
    equations: &RecordedEquations,
    free: &FreeUnknowns,
    is_taken: impl Fn(usize) -> bool,
) -> Option<ParameterEstimate> {
    let taken: Vec<usize> = (0..BLOCKS).filter(|block| is_taken(*block)).collect();
    let sums: Vec<SummedRows> =
        equations.joints.iter().map(|joint| joint.sum(|block| taken.contains(&block))).collect();
    let problem = WeightedEfforts { taken, ..WeightedEfforts::new(equations, free, &sums)? };
    let effort = |SummedRows { gram, rows, .. }: &SummedRows, joint: &JointEquations| {
        let at = joint.effort_column();
        (gram[(at, at)] / float(*rows).max(1.0)).sqrt()
    };
    let mut noise: Vec<JointNoise> = sums
        .iter()
        .zip(&equations.joints)
        .map(|(sum, joint)| JointNoise {
            rms: (AT_FIRST * effort(sum, joint)).max(f64::MIN_POSITIVE),
            rows: sum.rows,
            alike: 1.0,
        })
        .collect();
    let mut solved = None;
    for _ in 0..ROUNDS {
        let sum = problem.sum(&sums, &noise);
        let change = sum.smallest(&problem.bounds)?;
        let x = problem.x(&change);
        for (row, joint) in equations.joints.iter().enumerate() {
            let least = LEAST_LEFT * effort(&sums[row], joint);
            noise[row] = problem.noise(row, &x, &sums[row], least);
        }
        solved = Some((sum, x));
    }
    let (sum, x) = solved?;
    let covariance = BalancedCholesky::new(sum.information.clone())?.inverse();
    let known_combinations = problem.known_combinations(&sum);
    Some(ParameterEstimate {
        x,
        free: problem.free,
        covariance,
        held: problem.held,
        known_combinations,
        noise,
    })
}

/// What a motion will show, by the noise of its efforts.
#[derive(Debug, Clone)]
pub(crate) struct PlannedInformation {
    /// The free unknowns.
    pub(crate) free: Vec<usize>,
    /// Their covariance.
    pub(crate) covariance: DMatrix<f64>,
    /// Logarithm of the determinant of the information.
    pub(crate) log_determinant: f64,
    /// As of an estimate.
    pub(crate) known_combinations: [usize; 2],
}

/// What equations show whose efforts are not known yet; `None` if they do not determine a free unknown.
pub(crate) fn planned_information(
    equations: &RecordedEquations,
    free: &FreeUnknowns,
    noise: &[JointNoise],
) -> Option<PlannedInformation> {
    let sums: Vec<SummedRows> = equations.joints.iter().map(|joint| joint.sum(|_| true)).collect();
    let problem = WeightedEfforts::new(equations, free, &sums)?;
    if !problem.held.is_empty() {
        return None;
    }
    let sum = problem.sum(&sums, noise);
    let factor = sum.information.clone().cholesky()?;
    let log_determinant = 2.0 * factor.l_dirty().diagonal().iter().map(|of| libm::log(*of)).sum::<f64>();
    let covariance = BalancedCholesky::new(sum.information.clone())?.inverse();
    let known_combinations = problem.known_combinations(&sum);
    Some(PlannedInformation { free: problem.free, covariance, log_determinant, known_combinations })
}

struct WeightedEfforts<'a> {
    equations: &'a RecordedEquations,
    /// The free unknowns, those of each body together.
    free: Vec<usize>,
    held: Vec<(usize, Vec<usize>)>,
    /// What was known before, of the changes of the free unknowns.
    prior: DMatrix<f64>,
    /// Free inertial parameters, which come first.
    inertial: usize,
    bounds: Bounds,
    /// The blocks that the sums are of.
    taken: Vec<usize>,
}

impl<'a> WeightedEfforts<'a> {
    fn new(equations: &'a RecordedEquations, parameters: &FreeUnknowns, sums: &[SummedRows]) -> Option<Self> {
        let layout = &equations.layout;
        let mut free = Vec::new();
        let mut bounds = Bounds::default();
        let mut metrics = Vec::new();
        for of in free_bodies(equations, parameters) {
            bounds.bodies.push((free.len(), of.added_to));
            bounds.begin.push(of.begin);
            metrics.push(of.metric);
            free.extend(UnknownOrder::body(of.body));
        }
        let inertial = free.len();
        let (terms, held) = free_terms(equations, parameters, sums);
        for (unknown, term) in terms {
            if term.is_positive() {
                bounds.least.push((free.len(), -equations.nominal[unknown]));
            }
            free.push(unknown);
        }
        // Of efforts at rest, and of a motion without efforts, it has no effect, and of efforts that are noise none that shows.
        let shows_delay = sums.iter().any(|sum| sum.delay_signal > SHOWS_DELAY);
        free.extend(shows_delay.then(|| layout.delay()));
        let mut prior = DMatrix::zeros(free.len(), free.len());
        for ((first, _), metric) in bounds.bodies.iter().zip(metrics) {
            prior.fixed_view_mut::<PARAMETERS, PARAMETERS>(*first, *first).copy_from(&metric);
        }
        (!free.is_empty()).then_some(Self {
            equations,
            free,
            held,
            prior,
            inertial,
            bounds,
            taken: (0..BLOCKS).collect(),
        })
    }

    /// All unknowns after a change of the free ones.
    fn x(&self, change: &DVector<f64>) -> DVector<f64> {
        let mut x = self.equations.nominal.clone();
        self.free.iter().zip(change.iter()).for_each(|(at, change)| x[*at] += change);
        x
    }

    /// The sum of squares in changes of the free unknowns, joints by their noise.
    fn sum(&self, sums: &[SummedRows], noise: &[JointNoise]) -> Quadratic {
        let mut information = self.prior.clone();
        let mut right_side = DVector::zeros(self.free.len());
        let mut place = vec![None; self.equations.layout.len()];
        self.free.iter().enumerate().for_each(|(at, unknown)| place[*unknown] = Some(at));
        for (row, joint) in self.equations.joints.iter().enumerate() {
            let SummedRows { gram, rows, .. } = &sums[row];
            if *rows == 0 {
                continue;
            }
            let unknowns = joint.unknowns(&self.equations.layout, row);
            let nominal = DVector::from_iterator(
                unknowns.len(),
                unknowns.iter().map(|unknown| self.equations.nominal[*unknown]),
            );
            let columns = gram.view((0, 0), (unknowns.len(), unknowns.len()));
            let effort = gram.view((0, joint.effort_column()), (unknowns.len(), 1));
            let left = effort - columns * nominal;
            let weight = noise[row].weight();
            for (column, at) in unknowns.iter().enumerate().filter_map(|(c, of)| Some((c, place[*of]?))) {
                right_side[at] += weight * left[column];
                for (other, to) in unknowns.iter().enumerate().filter_map(|(c, of)| Some((c, place[*of]?))) {
                    information[(at, to)] += weight * columns[(column, other)];
                }
            }
        }
        Quadratic { information, right_side }
    }

    /// The residual of the effort of a joint after an estimate.
    fn noise(
        &self,
        row: usize,
        x: &DVector<f64>,
        SummedRows { gram, rows, .. }: &SummedRows,
        least: f64,
    ) -> JointNoise {
        let joint = &self.equations.joints[row];
        let local = local(self.equations, row, x);
        let used =
            self.free.iter().filter(|unknown| joint.unknowns(&self.equations.layout, row).contains(unknown));
        let freedom = (float(*rows) - float(used.count())).max(1.0);
        let rms = (quadratic(gram, &local).max(0.0) / freedom).sqrt().max(least).max(f64::MIN_POSITIVE);
        JointNoise { rms, rows: *rows, alike: self.alike(row, &local, rms) }
    }

    /// How many rows count as one: by how much more the gradients of the blocks differ than those of rows without a relation would.
    fn alike(&self, row: usize, local: &DVector<f64>, rms: f64) -> f64 {
        let joint = &self.equations.joints[row];
        let unknowns = joint.unknowns(&self.equations.layout, row);
        let columns: Vec<usize> =
            (0..unknowns.len()).filter(|column| self.free.contains(&unknowns[*column])).collect();
        let mut found = vec![0.0; unknowns.len()];
        let mut expected = vec![0.0; unknowns.len()];
        for (at, block) in joint.blocks.iter().enumerate().filter(|(at, _)| self.taken.contains(at)) {
            if joint.counts[at] == 0 {
                continue;
            }
            let mut whole = block.clone();
            whole.fill_upper_triangle_with_lower_triangle();
            let gradient = &whole * local;
            for &column in &columns {
                found[column] += gradient[column] * gradient[column];
                expected[column] += rms * rms * whole[(column, column)];
            }
        }
        let ratios = columns.iter().filter(|column| expected[**column] > 0.0);
        let ratios: Vec<f64> = ratios.map(|column| found[*column] / expected[*column]).collect();
        let mean = ratios.iter().sum::<f64>() / float(ratios.len()).max(1.0);
        mean.max(1.0)
    }

    /// Combinations of inertial parameters that the data say more of than was known before, and all combinations.
    fn known_combinations(&self, sum: &Quadratic) -> [usize; 2] {
        let n = self.inertial;
        if n == 0 {
            return [0, 0];
        }
        let prior = self.prior.view((0, 0), (n, n)).into_owned();
        let data = sum.information.view((0, 0), (n, n)) - &prior;
        let Some(factor) = prior.cholesky() else { return [0, n] };
        let Some(inverse) = factor.l().try_inverse() else { return [0, n] };
        let relative = &inverse * data * inverse.transpose();
        let known = relative.symmetric_eigenvalues().iter().filter(|value| **value > 1.0).count();
        [known, n]
    }
}

/// Accelerations whose squares are less than so many times those of the noise show nothing. No unit; kind: choice.
const NOISE_ALONE: f64 = 4.0;

/// The delay shows if at least this part of the square of its column is not noise, of one joint. No unit; kind: choice.
const SHOWS_DELAY: f64 = 0.2;

/// The terms of joints that are free, and those that cannot be distinguished from others.
type Terms = (Vec<(usize, JointUnknown)>, Vec<(usize, Vec<usize>)>);

fn free_terms(equations: &RecordedEquations, parameters: &FreeUnknowns, sums: &[SummedRows]) -> Terms {
    let (mut terms, mut held) = (Vec::new(), Vec::new());
    for (row, joint) in equations.joints.iter().enumerate() {
        let SummedRows { gram, rows, armature_noise, .. } = &sums[row];
        if *rows == 0 {
            continue;
        }
        // The known effort of the rigid bodies is no unknown, so that only terms are distinguished from each other here.
        let wanted: Vec<JointUnknown> =
            JointUnknown::ALL.into_iter().filter(|term| parameters.has(*term)).collect();
        let columns: Vec<usize> = wanted.iter().map(|term| joint.term_column(*term)).collect();
        let mut part = gram.select_rows(&columns).select_columns(&columns);
        // An acceleration that is noise of the encoder shows no armature.
        if let Some(at) = wanted.iter().position(|term| *term == JointUnknown::Armature)
            && part[(at, at)] < NOISE_ALONE * armature_noise
        {
            part.fill_row(at, 0.0);
            part.fill_column(at, 0.0);
        }
        let found = dependent(&part);
        for (at, term) in wanted.iter().enumerate() {
            let unknown = equations.layout.term(row, *term);
            match &found[at] {
                None => terms.push((unknown, *term)),
                Some(others) => {
                    let others = others.iter().map(|other| equations.layout.term(row, wanted[*other]));
                    held.push((unknown, others.collect()));
                }
            }
        }
    }
    (terms, held)
}

/// The unknowns of a joint's columns, and -1 for the recorded effort: the columns times this are the residual.
pub(crate) fn local(equations: &RecordedEquations, row: usize, x: &DVector<f64>) -> DVector<f64> {
    let joint = &equations.joints[row];
    let mut local = DVector::zeros(joint.columns());
    for (at, unknown) in joint.unknowns(&equations.layout, row).into_iter().enumerate() {
        local[at] = x[unknown];
    }
    local[joint.effort_column()] = -1.0;
    local
}

/// `v^T G v`.
pub(crate) fn quadratic(gram: &DMatrix<f64>, v: &DVector<f64>) -> f64 {
    v.dot(&(gram * v))
}

#[expect(clippy::cast_precision_loss, reason = "no recording has 2^53 rows")]
pub(crate) fn float(count: usize) -> f64 {
    count as f64
}

/// The block of another fifth of the time.
pub(crate) fn is_in_fold(block: usize, fold: usize, folds: usize) -> bool {
    block * folds / BLOCKS == fold
}
