//! The size of a workspace, volume or area: the share of random points of its bounding box that inverse
//! kinematics reaches, with an interval. Counting the cells that random configurations hit converges from
//! below at a rate that the count does not show; whether a single point can be reached can be decided.

use congruent_description::ArmQ;
use nalgebra::{Matrix3, Vector3};

use super::{
    ik::{IkOptions, IkSolver, IkTarget, TargetPart},
    model::Arm,
    sensitivity::Sampling,
};
use crate::{spatial::pose::Pose, uniform::Uniform};

/// Half width of the interval in standard errors: 99.7 % if errors are normal.
const STANDARD_ERRORS: f64 = 3.0;
/// Distance that counts as reached, as a share of the reach. Kind: solver stop. Bound: it adds itself times the
/// surface to the size, 1e-5 of a compact workspace.
const REACHED_SHARE: f64 = 1e-6;
/// Steps of inverse kinematics for one point: some twenty attempts.
const STEPS: usize = 200;
/// Points that are tested, up to the number of samples, ...
const POINTS: usize = 20_000;
/// ... and one for so many configurations if these are more.
const CONFIGURATIONS_PER_POINT: usize = 20;

/// The size of a workspace by points that were tested, two in each of equal cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkspaceSize {
    /// Volume in m^3 or area in m^2: the share of the points that are reached, of the bounding box.
    pub estimate: f64,
    /// Lower end of the interval of three standard errors.
    pub lower: f64,
    /// Upper end; it counts points that were reached with difficulty twice, for those that were missed.
    pub upper: f64,
    /// Points that were tested.
    pub points: usize,
    /// Edge of the cells, m; the mean edge if they are no cubes.
    pub cell_m: f64,
}

impl WorkspaceSize {
    /// The size of a workspace that has none: a surface has no volume, a curve no area.
    pub(super) fn none() -> Self {
        Self { estimate: 0.0, lower: 0.0, upper: 0.0, points: 0, cell_m: 0.0 }
    }
}

/// The results of sampling that the size is computed from.
pub(super) struct KnownWorkspace<'a> {
    /// Corners of the bounding box.
    pub(super) corners_in_base: [Vector3<f64>; 2],
    /// Axes along which the tool moves.
    pub(super) moves: Vector3<bool>,
    /// Smallest and largest distance from the base's origin.
    pub(super) reach_m: [f64; 2],
    /// Positions with a configuration each, from which the nearest is the start of a search.
    pub(super) starts: &'a [(Vector3<f64>, ArmQ)],
}

/// Equal cells that fill a box.
struct Cells {
    corner: Vector3<f64>,
    edges: Vector3<f64>,
    counts: [usize; 3],
}

impl Cells {
    /// About `count` cells, as nearly cubes as that allows.
    #[expect(clippy::cast_precision_loss, reason = "cells are far fewer than 2^52")]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count of cells")]
    fn filling(known: &KnownWorkspace<'_>, count: usize) -> Self {
        let [corner, end] = known.corners_in_base;
        let extents = end - corner;
        let mut axes: Vec<usize> = (0..3).filter(|&axis| known.moves[axis]).collect();
        axes.sort_by(|&a, &b| extents[a].total_cmp(&extents[b]));
        let mut counts = [1; 3];
        // The shortest axis first: if it has room for one cell only, the others share what it does not use.
        let mut left = count;
        for (at, &axis) in axes.iter().enumerate() {
            let size: f64 = axes[at..].iter().map(|&axis| extents[axis]).product();
            let edge = libm::pow(size / left as f64, 1.0 / (axes.len() - at) as f64);
            counts[axis] = ((extents[axis] / edge).round() as usize).clamp(1, left);
            left = (left / counts[axis]).max(1);
        }
        let edges = Vector3::from_fn(|axis, _| extents[axis] / counts[axis] as f64);
        Self { corner, edges, counts }
    }

    /// A random point in each cell, twice.
    #[expect(clippy::cast_precision_loss, reason = "cells are far fewer than 2^52")]
    fn pairs_of_points(&self, mut random: Uniform) -> impl Iterator<Item = [Vector3<f64>; 2]> {
        let [columns, rows, layers] = self.counts;
        (0..columns * rows * layers).map(move |cell| {
            // Column fastest, then row, then layer.
            let place = [cell % columns, cell / columns % rows, cell / (columns * rows)];
            [(); 2].map(|()| {
                Vector3::from_fn(|axis, _| {
                    let share = place[axis] as f64 + random.between(0.0, 1.0);
                    self.corner[axis] + self.edges[axis] * share
                })
            })
        })
    }
}

/// Whether inverse kinematics reaches a point.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ReachTest {
    No,
    Yes,
    /// In the second half of the steps: about as many again would be found with twice the steps.
    Late,
}

/// Tests points of the bounding box; the more configurations were drawn, the more points.
pub(super) fn size(arm: &Arm, known: &KnownWorkspace<'_>, sampling: Sampling) -> WorkspaceSize {
    let points = sampling.samples.min(POINTS.max(sampling.samples / CONFIGURATIONS_PER_POINT));
    // Two points in each cell (stratified sampling): cells entirely inside or outside add no variance, so only the boundary of
    // the workspace contributes to the error.
    let cells = Cells::filling(known, (points / 2).max(1));
    // Relative to the reach, so that large and small arms are counted alike.
    let tolerance_m = REACHED_SHARE * known.reach_m[1];
    let options =
        IkOptions { tolerance_m, max_iterations: STEPS, seed: sampling.seed, ..IkOptions::default() };
    let mut solver = IkSolver::new(arm.clone());
    let (mut reached, mut late, mut mixed, mut pairs) = (0_u32, 0_u32, 0_u32, 0_u32);
    for pair in cells.pairs_of_points(Uniform::seeded(sampling.seed)) {
        let found = pair.map(|point| test(&mut solver, known, &point, &options));
        let is_reached = found.map(|found| found != ReachTest::No);
        reached += is_reached.map(u32::from).iter().sum::<u32>();
        // Points found only in the second half of the steps suggest as many again that would be found with twice the steps: they
        // widen the upper end of the interval.
        late += found.map(|found| u32::from(found == ReachTest::Late)).iter().sum::<u32>();
        mixed += u32::from(is_reached[0] != is_reached[1]);
        pairs += 1;
    }
    let moving = || (0..3).filter(|&axis| known.moves[axis]);
    let of_cell: f64 = moving().map(|axis| cells.edges[axis]).product();
    // Two points in each stratum: the variance of their sum is estimated by the square of their difference,
    // so by the count of the cells that the boundary divides. Its own scatter, and none seen, is what the
    // added squares of the standard errors are for (as in Wilson's interval).
    let half_width = of_cell * STANDARD_ERRORS / 2.0 * (f64::from(mixed) + STANDARD_ERRORS.powi(2)).sqrt();
    let estimate = of_cell * f64::from(reached) / 2.0;
    #[expect(clippy::cast_precision_loss, reason = "2 or 3 axes")]
    let cell_m = libm::pow(of_cell, 1.0 / moving().count() as f64);
    WorkspaceSize {
        estimate,
        lower: (estimate - half_width).max(0.0),
        upper: (estimate + half_width + of_cell * f64::from(late) / 2.0).min(of_cell * f64::from(pairs)),
        points: 2 * pairs as usize,
        cell_m,
    }
}

fn test(
    solver: &mut IkSolver,
    known: &KnownWorkspace<'_>,
    point: &Vector3<f64>,
    options: &IkOptions,
) -> ReachTest {
    // Points outside the reach need no search, which would use all its steps on them.
    let [nearest_m, farthest_m] = known.reach_m;
    let distance_m = point.norm();
    if distance_m < nearest_m - options.tolerance_m || distance_m > farthest_m + options.tolerance_m {
        return ReachTest::No;
    }
    // From the nearest sample: a few steps reach the point instead of a search over the whole range.
    let apart = |start: &&(Vector3<f64>, ArmQ)| (start.0 - point).norm_squared();
    let Some((_, start)) = known.starts.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))) else {
        return ReachTest::No;
    };
    let base_from_tcp = Pose::from_parts(Matrix3::identity(), *point);
    let target = IkTarget { base_from_tcp, part: TargetPart::Position };
    let result = solver.solve(&target, start, options, || true).expect("the start is of this arm");
    match (result.converged, result.iterations) {
        (false, _) => ReachTest::No,
        (true, steps) if steps <= STEPS / 2 => ReachTest::Yes,
        (true, _) => ReachTest::Late,
    }
}
