//! The root mean square of the error over the slice of the workspace by height and distance from the base's z axis.

use std::collections::BTreeMap;

use congruent_analysis::{
    heat_map::{HeatCell, HeatMap, heat_map},
    plot::PlotError,
};
use congruent_description::RobotDescription;
use congruent_input::display::length;
use congruent_kinematics::Arm;

use crate::{
    first_order::ErrorCovariances, parameters::ToleratedChain, report::ToleranceReport,
    study::random_configurations,
};

/// Random configurations behind the figure: some ten in each cell.
const CONFIGURATIONS: usize = 60_000;
/// Cells along the larger extent.
const CELLS: f64 = 70.0;

/// The sum of the squares in a cell, and their number.
#[derive(Debug, Clone, Copy, Default)]
struct CellSum {
    square_m2: f64,
    count: f64,
}

/// The figure of a report: the root mean square over random configurations in each cell.
///
/// # Errors
/// [`PlotError`] if the drawing library refuses, or the robot has no arm, of which there is no report.
pub fn plot(
    report: &ToleranceReport,
    description: &RobotDescription,
    tolerated: &ToleratedChain,
) -> Result<String, PlotError> {
    let Ok(arm) = Arm::from_description(description) else { return heat_map(&figure(report, &[])) };
    let mut covariances = ErrorCovariances::new(tolerated);
    let drawn = random_configurations(description, &arm, CONFIGURATIONS, report.seed);
    let of = |q| {
        let [position, _] = covariances.at(&q);
        let rms_m = position.trace().sqrt();
        let tcp = covariances.tcp_in_base();
        [libm::hypot(tcp.x, tcp.y), tcp.z, rms_m]
    };
    heat_map(&figure(report, &drawn.iter().map(of).collect::<Vec<_>>()))
}

/// Of points with their distance from the axis, height and error, m.
fn figure(report: &ToleranceReport, points: &[[f64; 3]]) -> HeatMap {
    let extent = |axis: usize| {
        let values = points.iter().map(|point| point[axis]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    // A tool that stays at one place has a cell all the same.
    let cell_m = (extent(0).max(extent(1)) / CELLS).max(1e-3);
    let mut sums: BTreeMap<[i64; 2], CellSum> = BTreeMap::new();
    for [radius_m, height_m, rms_m] in points {
        #[expect(clippy::cast_possible_truncation, reason = "at most some hundred cells along an axis")]
        let cell = [radius_m, height_m].map(|along| (along / cell_m).floor() as i64);
        let sum = sums.entry(cell).or_default();
        sum.square_m2 += rms_m * rms_m;
        sum.count += 1.0;
    }
    #[expect(clippy::cast_precision_loss, reason = "a small index")]
    let cell = |(cell, sum): (&[i64; 2], &CellSum)| HeatCell {
        corner: cell.map(|along| along as f64 * cell_m),
        value: (sum.square_m2 / sum.count).sqrt() * 1e3,
    };
    HeatMap {
        title: format!(
            "{}: error of the tool by tolerances, rms {} over the joint range",
            report.robot,
            length(report.overall.first_order.rms_m)
        ),
        axes: ["distance from the base's z axis in m".to_owned(), "z in m".to_owned()],
        cells: sums.iter().map(cell).collect(),
        cell_m,
        value: "rms in mm".to_owned(),
        note: "Each cell: all configurations that reach it. Collisions are not considered.".to_owned(),
    }
}
