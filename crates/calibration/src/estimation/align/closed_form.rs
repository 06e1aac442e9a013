//! Base and tool in closed form: from orientations, from points, and of the candidates the one that agrees best.

use congruent_kinematics::Pose;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::{
    frames::{BaseAndTool, WhichFrames},
    rotations,
    rows::{AlignmentRow, median_size_m},
};
use crate::estimation::robust::median;

/// Most times that the better half of the rows is taken. Kind: bound; two or three suffice.
const MOST_ROUNDS: usize = 8;
/// Fewest rows that are taken. Kind: bound: five points determine the fifteen unknowns of [`linear`].
const FEWEST_ROWS: usize = 6;
/// A point further from the median point than so many median distances is left out. Kind: judgement: an arm whose points are
/// spread evenly has none beyond three, and one row of another unit would decide a linear fit alone.
const FAR: f64 = 5.0;
/// Weight of "no change" for unknowns that nothing determines, relative. Kind: conditioning.
const PRIOR: f64 = 1e-12;

/// The frames by the closed form that agrees best with the median row, from rows without those that disagree; `None` if
/// no row determines anything.
///
/// The worse half is left out again and again while that helps, as in least trimmed squares.
/// Source: Rousseeuw & Van Driessen, *Computing LTS regression for large data sets* (2006), the concentration step.
pub(super) fn aligned_by_closed_forms(
    rows: &[AlignmentRow<'_>],
    which: WhichFrames,
    threshold: f64,
    reach_m: f64,
) -> Option<BaseAndTool> {
    let residuals = |frames: &BaseAndTool| -> Vec<_> {
        rows.iter()
            .map(|row| row.measured.residual(&frames.measured_from_target(&row.base_from_tip)))
            .collect()
    };
    let size_m = |frames: &BaseAndTool| median_size_m(&residuals(frames), reach_m);
    let best_of = |used: &[AlignmentRow<'_>]| {
        let sized = candidates(used, which, threshold).into_iter().map(|frames| (size_m(&frames), frames));
        sized.min_by(|(a, _), (b, _)| a.total_cmp(b))
    };
    let (mut best_m, mut best) = best_of(&near(rows))?;
    for _ in 0..MOST_ROUNDS {
        let mut order: Vec<(f64, AlignmentRow<'_>)> = residuals(&best)
            .iter()
            .map(|each| each.position_m.norm() + reach_m * each.orientation_rad.norm())
            .zip(rows.iter().copied())
            .collect();
        order.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        order.truncate(rows.len().div_ceil(2).max(FEWEST_ROWS));
        let half: Vec<AlignmentRow<'_>> = order.into_iter().map(|(_, row)| row).collect();
        match best_of(&half) {
            Some((size_m, frames)) if size_m < best_m => (best_m, best) = (size_m, frames),
            _ => break,
        }
    }
    Some(best)
}

/// The rows without points that no arm reaches together with the others.
fn near<'a>(rows: &[AlignmentRow<'a>]) -> Vec<AlignmentRow<'a>> {
    let of = |row: &AlignmentRow<'_>, at: usize| row.measured.tip_in_base_m[at];
    let middle = [0, 1, 2].map(|at| median(rows.iter().filter_map(|row| of(row, at)).collect()));
    let distance_m = |row: &AlignmentRow<'_>| {
        let along = |at: usize| of(row, at).map_or(0.0, |value| value - middle[at]);
        Vector3::new(along(0), along(1), along(2)).norm()
    };
    let most_m = FAR * median(rows.iter().map(distance_m).collect());
    rows.iter().filter(|row| distance_m(row) <= most_m).copied().collect()
}

/// The frames by each closed form that applies: each gives the rotation of the base, from which the others follow.
fn candidates(rows: &[AlignmentRow<'_>], which: WhichFrames, threshold: f64) -> Vec<BaseAndTool> {
    let rotations_of_base = if which.base {
        let from_orientations = if which.tool {
            rotations::of_both(rows, threshold)
        } else {
            rotations::of_base(rows, &Matrix3::identity())
        };
        let linear = which.tool.then(|| linear(rows, threshold)).flatten();
        vec![from_orientations, linear, rotations::of_points(rows)]
    } else {
        vec![Some(Matrix3::identity())]
    };
    let complete = |of_base: Matrix3<f64>| {
        let of_tool = which.tool.then(|| rotations::of_tool(rows, &of_base)).flatten();
        translations(rows, which, threshold, &of_base, &of_tool.unwrap_or_else(Matrix3::identity))
    };
    rotations_of_base.into_iter().flatten().filter_map(complete).collect()
}

/// The rotation of the base from points, whatever the point of the tool is: linear least squares of
/// `M m - c - R x = t` over the nine entries of `M` (the inverse rotation), the offset `c` and the point `x` of the tool, for the
/// measured point `m` and the nominal pose `R, t` of the tip. `M` is then the nearest rotation.
fn linear(rows: &[AlignmentRow<'_>], threshold: f64) -> Option<Matrix3<f64>> {
    const ENTRIES: usize = 9;
    const OFFSET: usize = 9;
    const TOOL: usize = 12;
    let mut normal = SMatrix::<f64, 15, 15>::zeros();
    let mut right = SVector::<f64, 15>::zeros();
    let points: Vec<_> = rows.iter().filter_map(|row| Some((row.point()?, row.base_from_tip))).collect();
    for (point, base_from_tip) in &points {
        for k in 0..3 {
            let mut row = SVector::<f64, 15>::zeros();
            for j in 0..3 {
                row[ENTRIES / 3 * j + k] = point[j];
                row[TOOL + j] = -base_from_tip.rotation[(k, j)];
            }
            row[OFFSET + k] = -1.0;
            normal += row * row.transpose();
            right += row * base_from_tip.translation[k];
        }
    }
    let scale = normal.trace() * PRIOR;
    (0..15).for_each(|at| normal[(at, at)] += scale);
    let count = count(&points);
    // An arm that hardly turns its flange determines the tool and the base together only: then the tool is near the tip.
    (0..3).for_each(|at| normal[(TOOL + at, TOOL + at)] += threshold * threshold * count);
    let solution = normal.cholesky()?.solve(&right);
    let inverse = Matrix3::from_column_slice(&solution.as_slice()[..ENTRIES]);
    rotations::nearest(&inverse.transpose())
}

/// Linear least squares of the two translations for given rotations: `p + B R x = m - B t`.
fn translations(
    rows: &[AlignmentRow<'_>],
    which: WhichFrames,
    threshold: f64,
    of_base: &Matrix3<f64>,
    of_tool: &Matrix3<f64>,
) -> Option<BaseAndTool> {
    const TOOL: usize = 3;
    let mut normal = SMatrix::<f64, 6, 6>::zeros();
    let mut right = SVector::<f64, 6>::zeros();
    for row in rows {
        let turned = of_base * row.base_from_tip.rotation;
        let nominal_m = of_base * row.base_from_tip.translation;
        for k in 0..3 {
            let Some(measured_m) = row.measured.tip_in_base_m[k] else { continue };
            let mut by = SVector::<f64, 6>::zeros();
            if which.base {
                by[k] = 1.0;
            }
            if which.tool {
                (0..3).for_each(|j| by[TOOL + j] = turned[(k, j)]);
            }
            normal += by * by.transpose();
            right += by * (measured_m - nominal_m[k]);
        }
    }
    for at in 0..3 {
        normal[(at, at)] += PRIOR;
        // As in `linear`: what the rows hardly determine is given to the base, which is further away than the tool.
        normal[(TOOL + at, TOOL + at)] += threshold * threshold * count(rows) + PRIOR;
    }
    let solution = normal.cholesky()?.solve(&right);
    let three = |from: usize| solution.fixed_rows::<3>(from).into_owned();
    Some(BaseAndTool {
        measured_from_base: Pose::from_parts(*of_base, three(0)),
        tip_from_target: Pose::from_parts(*of_tool, three(TOOL)),
    })
}

#[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 rows")]
fn count<T>(rows: &[T]) -> f64 {
    rows.len() as f64
}
