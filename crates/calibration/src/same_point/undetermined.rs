//! What no point determines of an arm: a turn of everything, and its size.
//!
//! Both change the spread of tool points as long as it is not zero, by as much as it is itself: a smaller arm has a smaller spread.
//! So what has no effect cannot be read off the measured rows; it is found over the whole joint range.

use congruent_description::ChainQ;
use congruent_kinematics::{Twist, hat};
use nalgebra::{DMatrix, DVector};

use crate::estimation::{CorrectedChain, CorrectionEntry, ParameterUnit};

/// Singular values below this share of the largest are rounding. No unit; kind: rounding; those of real corrections are above 1e-3.
const ROUNDING: f64 = 1e-8;
/// The same of eigenvalues, squares of singular values, which the rounding of the largest limits. No unit; kind: rounding; those of real
/// corrections are above 1e-6.
const ROUNDING_OF_SQUARES: f64 = 1e-12;
/// The free lengths give another size if they reproduce it within this share. No unit; kind: rounding, with a wide margin.
const REPRODUCED: f64 = 1e-6;

/// The corrections that move all tool points as one, or that make the whole arm larger.
#[derive(Debug, Clone)]
pub(super) struct Undetermined {
    /// `I - G G'` with these directions as orthonormal columns of `G`, in rad and m.
    without: DMatrix<f64>,
    /// The free length that is largest in an arm of another size, which is held so that the others are in its scale; `None` if the
    /// free lengths cannot make the whole arm larger.
    pub(super) scale_giving: Option<usize>,
}

/// Effects of corrections on the tool point at some configurations: three rows for each.
struct Effects {
    /// A column for each correction.
    jacobian: DMatrix<f64>,
    tips: DVector<f64>,
}

impl Undetermined {
    pub(super) fn new(chain: &CorrectedChain, configurations: &[ChainQ]) -> Self {
        let effects = effects(chain, configurations);
        Self { without: projector(&effects), scale_giving: scale_giving(chain, &effects) }
    }

    /// An information matrix in which these directions have none.
    pub(super) fn without(&self, information: &DMatrix<f64>) -> DMatrix<f64> {
        &self.without * information * &self.without
    }
}

fn effects(chain: &CorrectedChain, configurations: &[ChainQ]) -> Effects {
    let corrections = chain.parameters().len();
    let mut jacobian = DMatrix::zeros(3 * configurations.len(), corrections);
    let mut tips = DVector::zeros(3 * configurations.len());
    let mut twists = vec![Twist::zero(); corrections];
    for (at, q) in configurations.iter().enumerate() {
        let tip = chain.linearise(q, chain.start(), &mut twists).translation;
        tips.fixed_rows_mut::<3>(3 * at).copy_from(&tip);
        for (column, twist) in twists.iter().enumerate() {
            let rate = twist.linear + twist.angular.cross(&tip);
            jacobian.fixed_view_mut::<3, 1>(3 * at, column).copy_from(&rate);
        }
    }
    Effects { jacobian, tips }
}

/// Motions of everything: three shifts `o`, three turns `w x t` and another size `s t`.
fn motions(tips: &DVector<f64>) -> DMatrix<f64> {
    let mut motions = DMatrix::zeros(tips.len(), 7);
    for row in (0..tips.len()).step_by(3) {
        let tip = tips.fixed_rows::<3>(row).into_owned();
        motions.fixed_view_mut::<3, 3>(row, 0).fill_with_identity();
        motions.fixed_view_mut::<3, 3>(row, 3).copy_from(&-hat(&tip));
        motions.fixed_view_mut::<3, 1>(row, 6).copy_from(&tip);
    }
    motions
}

/// The null space of `[J, motions]`: corrections `g` with `J g` a motion of everything.
fn projector(Effects { jacobian, tips }: &Effects) -> DMatrix<f64> {
    let (corrections, motions) = (jacobian.ncols(), motions(tips));
    let mut all = DMatrix::zeros(jacobian.nrows(), corrections + motions.ncols());
    all.columns_mut(0, corrections).copy_from(jacobian);
    all.columns_mut(corrections, motions.ncols()).copy_from(&motions);
    // Of the square matrix, so that it has all right vectors also if rows are few.
    let eigen = (all.transpose() * all).symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    let is_null = |at: &usize| eigen.eigenvalues[*at] <= ROUNDING_OF_SQUARES * largest;
    let null: Vec<usize> = (0..eigen.eigenvalues.len()).filter(is_null).collect();
    let null = eigen.eigenvectors.select_columns(&null).rows(0, corrections).into_owned();
    let svd = null.svd(true, false);
    let directions = svd.u.unwrap_or_else(|| DMatrix::zeros(corrections, 0));
    let real: Vec<usize> =
        (0..svd.singular_values.len()).filter(|&at| svd.singular_values[at] > REPRODUCED).collect();
    let directions = directions.select_columns(&real);
    DMatrix::identity(corrections, corrections) - &directions * directions.transpose()
}

/// An arm of size `1 + s` has its tip at `(1 + s) t`, up to a shift of everything: the lengths `g` with `J g + o = t`.
fn scale_giving(chain: &CorrectedChain, Effects { jacobian, tips }: &Effects) -> Option<usize> {
    let is_length = |&at: &usize| {
        let parameter = &chain.parameters()[at];
        parameter.unit() == ParameterUnit::Length && parameter.entry != CorrectionEntry::Base
    };
    let lengths: Vec<usize> = (0..jacobian.ncols()).filter(is_length).collect();
    let size = tips.norm();
    if lengths.is_empty() || size == 0.0 {
        return None;
    }
    let mut effects = DMatrix::zeros(tips.len(), lengths.len() + 3);
    effects.columns_mut(0, lengths.len()).copy_from(&jacobian.select_columns(&lengths));
    effects.columns_mut(lengths.len(), 3).copy_from(&motions(tips).columns(0, 3));
    let svd = effects.clone().svd(true, true);
    let growth = svd.solve(tips, ROUNDING * svd.singular_values.max()).ok()?;
    let is_reproduced = (effects * &growth - tips).norm() <= REPRODUCED * size;
    let largest = (0..lengths.len()).max_by(|&a, &b| growth[a].abs().total_cmp(&growth[b].abs()))?;
    is_reproduced.then(|| lengths[largest])
}
