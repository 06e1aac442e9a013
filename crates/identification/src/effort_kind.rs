//! What recorded efforts are: drivers write torques, torques without gravity and currents under one name.

use nalgebra::{DMatrix, DVector};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    equations::{BLOCKS, JointEquations, RecordedEquations, SummedRows},
    estimate::{float, is_in_fold},
    held_out::FOLDS,
    unknowns::JointUnknown,
};

/// What efforts are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EffortKind {
    /// Torques and forces of the joints, N m and N.
    Torque,
    /// The same without those of gravity, which the controller adds by itself.
    TorqueWithoutGravity,
    /// Currents of the motors, A, or anything else that is proportional to the torque.
    Current,
    /// None: they are zero, or do not change.
    None,
    /// Nothing of these.
    Unknown,
}

/// What the efforts of a recording are, by how well the description explains them as each kind.
#[derive(Debug, Clone, PartialEq)]
pub struct RecognisedEffort {
    /// The kind.
    pub kind: EffortKind,
    /// The part of the variance of the efforts that is left as torques, as torques without gravity, and as currents; of data that
    /// were left out, the mean of the joints.
    pub left: [f64; 3],
    /// The same of each driven joint; `None` of one whose effort does not change.
    pub left_of_joints: Vec<Option<[f64; 3]>>,
    /// For each driven joint what its effort has to be multiplied by to be a torque, with its standard error; `None` if masses have too
    /// small a part in it.
    pub factors: Vec<Option<(f64, f64)>>,
}

/// Torques whose factor is at most this, or its inverse, are torques of a robot with other masses; a motor with its gear has factors of
/// some N m/A. No unit; kind: choice.
const STILL_TORQUE: f64 = 2.5;
/// The residual as a torque, compared with the residual as a current, which has one unknown more. No unit; kind: choice.
const AS_GOOD: f64 = 1.5;
/// Torques without gravity leave less than torques by this factor at least. No unit; kind: choice.
const CLEARLY: f64 = 2.0;
/// More than this part of the variance is not explained: no unit; kind: choice. It is 0.02 of a UR5e, 0.3 of the worst joint of a Panda.
const UNEXPLAINED: f64 = 0.5;
/// A factor is known if its standard error is at most this part of it. No unit; kind: choice.
const KNOWN_FACTOR: f64 = 0.2;
/// Efforts whose deviation is below this part of their size do not change. No unit; kind: rounding.
const UNCHANGED: f64 = 1e-9;

/// Recognises what the efforts are.
pub fn recognise(equations: &RecordedEquations) -> RecognisedEffort {
    let small = |(row, joint): (usize, &JointEquations)| {
        let map = small_columns(equations, row, joint);
        let block = |at: usize| {
            let sum = joint.sum(|block| block == at);
            SummedRows { gram: map.transpose() * &sum.gram * &map, ..sum }
        };
        (0..BLOCKS).map(block).collect()
    };
    recognise_small(&equations.joints.iter().enumerate().map(small).collect::<Vec<SmallBlocks>>())
}

/// The inner products of the few columns of a joint in each block of time, with the number of rows.
pub(crate) type SmallBlocks = Vec<SummedRows>;

/// The same from the few columns of each joint.
pub(crate) fn recognise_small(joints: &[SmallBlocks]) -> RecognisedEffort {
    let tried: Vec<Option<Tried>> = joints.iter().map(Tried::new).collect();
    let used = || tried.iter().flatten();
    let left_of_joints = tried.iter().map(|of| of.as_ref().map(|of| of.left)).collect();
    let factors: Vec<Option<(f64, f64)>> = tried.iter().map(|of| of.as_ref()?.factor).collect();
    if used().next().is_none() {
        return RecognisedEffort { kind: EffortKind::None, left: [f64::NAN; 3], left_of_joints, factors };
    }
    let left =
        std::array::from_fn(|kind| used().map(|of| of.left[kind]).sum::<f64>() / float(used().count()));
    let mut sizes: Vec<f64> = factors.iter().flatten().map(|(factor, _)| *factor).collect();
    sizes.sort_by(f64::total_cmp);
    let middle = sizes.get(sizes.len() / 2).copied();
    RecognisedEffort { kind: kind(left, middle), left, left_of_joints, factors }
}

fn kind([torque, without_gravity, current]: [f64; 3], middle_factor: Option<f64>) -> EffortKind {
    if current >= UNEXPLAINED {
        return EffortKind::Unknown;
    }
    let is_good = |left: f64| left <= AS_GOOD * current;
    // An upright slide has the same gravity everywhere: a constant effort takes its place, and nothing distinguishes the two.
    if is_good(without_gravity) && without_gravity < torque / CLEARLY {
        return EffortKind::TorqueWithoutGravity;
    }
    let is_near_one =
        middle_factor.is_some_and(|factor| (1.0 / STILL_TORQUE..=STILL_TORQUE).contains(&factor));
    if is_good(torque) || is_near_one {
        return EffortKind::Torque;
    }
    if middle_factor.is_some() { EffortKind::Current } else { EffortKind::Unknown }
}

/// A joint's effort, explained as each kind.
struct Tried {
    left: [f64; 3],
    factor: Option<(f64, f64)>,
}

/// The columns that explain an effort: the torque of the rigid bodies by the description, then gravity, which is part of it, then the terms,
/// the delay and the effort.
pub(crate) const RIGID: usize = 0;
pub(crate) const GRAVITY: usize = 1;
pub(crate) const TERMS: usize = 2;
pub(crate) const DELAY: usize = TERMS + JointUnknown::ALL.len();
const OFFSET: usize = DELAY - 1;
pub(crate) const EFFORT: usize = DELAY + 1;
pub(crate) const SMALL: usize = EFFORT + 1;

impl Tried {
    /// `None` if the effort does not change.
    fn new(blocks: &SmallBlocks) -> Option<Self> {
        let small = |is_taken: &dyn Fn(usize) -> bool| {
            let taken = blocks.iter().enumerate().filter(|(at, _)| is_taken(*at));
            taken.fold((DMatrix::zeros(SMALL, SMALL), 0), |(sum, rows), (_, block)| {
                (sum + &block.gram, rows + block.rows)
            })
        };
        let (whole, rows) = small(&|_| true);
        let variance = whole[(EFFORT, EFFORT)] - whole[(EFFORT, OFFSET)].powi(2) / float(rows).max(1.0);
        if rows == 0 || variance <= UNCHANGED * whole[(EFFORT, EFFORT)] {
            return None;
        }
        let mut left = [0.0; 3];
        let mut factors = Vec::new();
        for fold in 0..FOLDS {
            let is_left_out = |block: usize| is_in_fold(block, fold, FOLDS);
            let (known, _) = small(&|block| !is_left_out(block));
            let (tested, _) = small(&is_left_out);
            let solutions = solutions(&known);
            for (left, solution) in left.iter_mut().zip(&solutions) {
                *left += (solution.dot(&(&tested * solution))).max(0.0) / variance;
            }
            factors.push(1.0 / solutions[2][RIGID]);
        }
        Some(Self { left, factor: known_factor(&factors) })
    }
}

/// The mean of the factors without one fifth each, and its standard error by the jackknife; `None` if it is not known.
fn known_factor(factors: &[f64]) -> Option<(f64, f64)> {
    let n = float(factors.len());
    let mean = factors.iter().sum::<f64>() / n;
    let spread = factors.iter().map(|factor| (factor - mean).powi(2)).sum::<f64>();
    let error = (spread * (n - 1.0) / n).sqrt();
    (mean.is_finite() && error <= KNOWN_FACTOR * mean.abs()).then_some((mean, error))
}

/// From the columns of a joint to the few.
fn small_columns(equations: &RecordedEquations, row: usize, joint: &JointEquations) -> DMatrix<f64> {
    let mut map = DMatrix::zeros(joint.columns(), SMALL);
    let bodies = joint.term_column(JointUnknown::Viscous);
    let unknowns = joint.unknowns(&equations.layout, row);
    for column in 0..bodies {
        map[(column, RIGID)] = equations.nominal[unknowns[column]];
    }
    map[(joint.gravity_column(), GRAVITY)] = 1.0;
    for (at, term) in JointUnknown::ALL.into_iter().enumerate() {
        map[(joint.term_column(term), TERMS + at)] = 1.0;
    }
    map[(joint.delay_column(), DELAY)] = 1.0;
    map[(joint.effort_column(), EFFORT)] = 1.0;
    map
}

/// What multiplies the few columns so that their sum is the residual of the effort, as each kind.
fn solutions(gram: &DMatrix<f64>) -> [DVector<f64>; 3] {
    let known = |rigid: f64, gravity: f64| {
        let mut known = DVector::zeros(SMALL);
        (known[RIGID], known[GRAVITY], known[EFFORT]) = (rigid, gravity, -1.0);
        known
    };
    let terms: Vec<usize> = (TERMS..EFFORT).collect();
    let with_rigid: Vec<usize> = std::iter::once(RIGID).chain(TERMS..EFFORT).collect();
    [
        solved(gram, known(1.0, 0.0), &terms),
        solved(gram, known(1.0, -1.0), &terms),
        solved(gram, known(0.0, 0.0), &with_rigid),
    ]
}

/// The columns that are free make the residual smallest.
fn solved(gram: &DMatrix<f64>, mut known: DVector<f64>, free: &[usize]) -> DVector<f64> {
    let right = -(gram * &known).select_rows(free);
    let part = gram.select_rows(free).select_columns(free);
    // A joint that moves in one direction has columns that are alike.
    let scale = part.diagonal().map(|entry| if entry > 0.0 { 1.0 / entry.sqrt() } else { 0.0 });
    let balanced = DMatrix::from_fn(free.len(), free.len(), |row, column| {
        part[(row, column)] * scale[row] * scale[column]
    });
    let svd = balanced.svd(true, true);
    if let Ok(solution) = svd.solve(&right.component_mul(&scale), 1e-9) {
        let solution = solution.component_mul(&scale);
        free.iter().zip(solution.iter()).for_each(|(at, value)| known[*at] = *value);
    }
    known
}
