//! `congruent workspace`: the reachable positions of the tool within the joint limits.

use std::collections::BTreeSet;

use congruent_description::{JointValues, ReportedChain, RobotDescription};
use congruent_input::Finding;
use congruent_kinematics::{Arm, KinematicsError, Sampling, Workspace};
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    arm_joints::joint_names,
    plot::{AXES, Curve, PLANES, PlaneLabel, PlaneView, PlaneViews, PlotError, views},
};

/// The answer of `congruent workspace`; positions of the tool centre point in link `base`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct WorkspaceReport {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// Number of random configurations.
    pub samples: usize,
    /// Seed of the random configurations.
    pub seed: u64,
    /// Smallest and largest distance from the base's origin.
    pub reach: [ReachExtreme; 2],
    /// Lower corner of the bounding box, in the base.
    pub lower_m: [f64; 3],
    /// Upper corner of the bounding box, in the base.
    pub upper_m: [f64; 3],
    /// Volume; none for an arm that moves in a plane parallel to two axes. It is the volume of the bounding box times the share of
    /// its tested points that inverse kinematics reaches.
    pub volume_m3: Option<f64>,
    /// Area, for an arm that moves in such a plane.
    pub area_m2: Option<f64>,
    /// Interval of three standard errors around the estimate of volume or area.
    pub between: Option<[f64; 2]>,
    /// Points that were tested, two in each cell of the bounding box.
    pub points: usize,
    /// Edge of these cells; the mean edge if they are no cubes.
    pub cell_m: f64,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// An extreme distance from the base.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReachExtreme {
    /// Distance of the tool from the base's origin.
    pub distance_m: f64,
    /// The configuration with it, rad or m.
    pub at: JointValues,
}

/// The workspace of the robot's arm, as values for the report and as points for the plot.
///
/// # Errors
/// [`KinematicsError::NoJoint`] if the robot has no arm, [`KinematicsError::SearchedJoints`] if the arm has too many joints.
pub fn workspace(
    description: &RobotDescription,
    sampling: Sampling,
) -> Result<(WorkspaceReport, Workspace), KinematicsError> {
    let mut arm = Arm::from_description(description)?;
    arm.check_search()?;
    let names = joint_names(description, &arm);
    let found = arm.workspace(sampling);
    let size = found.size;
    let of_size = |dimensions| size.filter(|_| found.dimensions == dimensions).map(|size| size.estimate);
    let reach = [0, 1].map(|end| ReachExtreme {
        distance_m: found.reach_m[end],
        at: JointValues::new(&names, &found.reach_at[end]),
    });
    let report = WorkspaceReport {
        robot: description.name.clone(),
        chain: description.reported_chain(),
        samples: sampling.samples,
        seed: sampling.seed,
        reach,
        lower_m: found.lower_in_base.into(),
        upper_m: found.upper_in_base.into(),
        volume_m3: of_size(3),
        area_m2: of_size(2),
        between: size.map(|size| [size.lower, size.upper]),
        points: size.map_or(0, |size| size.points),
        cell_m: size.map_or(0.0, |size| size.cell_m),
        warnings: description.warnings.iter().map(Finding::from).collect(),
    };
    Ok((report, found))
}

/// Cells along the largest extent of a view, for an area and for a volume, whose samples are spread over more cells.
const DRAWN_CELLS: [f64; 2] = [160.0, 80.0];

/// Corners of a circle.
const CORNERS: u32 = 180;
/// What the plot does not show.
const NOT_CONSIDERED: &str = "Within the joint limits. Collisions of the arm with itself and with its surroundings are not considered.";

/// The reached positions as a data sheet shows them: from the side, turned about the base's z axis into one plane, and from
/// above; for an arm that moves in a plane, in that plane alone.
///
/// # Errors
/// [`PlotError`] if the drawing library refuses.
pub fn plot(report: &WorkspaceReport, workspace: &Workspace) -> Result<String, PlotError> {
    let extents = workspace.upper_in_base - workspace.lower_in_base;
    let thin = workspace.dimensions < 3;
    let cell_m = (extents.max() / DRAWN_CELLS[usize::from(!thin)]).max(f64::MIN_POSITIVE);
    let seen = if thin {
        let flat = |axes: &[usize; 2]| axes.iter().any(|&axis| extents[axis] < cell_m);
        let planes = PLANES.iter().filter(|axes| !flat(axes));
        planes.map(|&axes| view(projected(workspace, axes), axes.map(|axis| AXES[axis]), cell_m)).collect()
    } else {
        let side = view(turned(workspace), [SIDE_AXIS, AXES[2]], cell_m);
        let mut above = view(projected(workspace, [0, 1]), [AXES[0], AXES[1]], cell_m);
        // Of the sampled points: three digits of it are known.
        let radius_m = workspace.points_in_base.iter().map(|point| point.xy().norm()).fold(0.0, f64::max);
        add_circle(&mut above, radius_m, format!("{radius_m:.2} m from the z axis"));
        vec![side, above]
    };
    let mut seen: Vec<PlaneView> = seen;
    // Circles of the distance from the base's origin belong to the view in which that distance is seen: the first.
    if let Some(first) = seen.first_mut() {
        add_reach(first, &report.reach, cell_m);
    }
    let size = match (report.volume_m3, report.area_m2) {
        (Some(volume_m3), _) => format!(", about {volume_m3:.3} m3"),
        (_, Some(area_m2)) => format!(", about {area_m2:.3} m2"),
        _ => String::new(),
    };
    views(&PlaneViews {
        title: format!(
            "{}: the tool reaches {:.3} to {:.3} m from the base's origin{size}",
            report.robot, report.reach[0].distance_m, report.reach[1].distance_m
        ),
        series: vec!["reached".to_owned()],
        views: seen,
        note: NOT_CONSIDERED.to_owned(),
    })
}

/// The axis of the view from the side.
const SIDE_AXIS: &str = "distance from the base's z axis in m, to both sides";

fn projected(workspace: &Workspace, axes: [usize; 2]) -> Vec<[f64; 2]> {
    workspace.points_in_base.iter().map(|point| axes.map(|axis| point[axis])).collect()
}

/// The points turned about the z axis into one plane, on both sides of the axis.
fn turned(workspace: &Workspace) -> Vec<[f64; 2]> {
    let both = |point: &nalgebra::Vector3<f64>| {
        let radius_m = libm::hypot(point.x, point.y);
        [[radius_m, point.z], [-radius_m, point.z]]
    };
    workspace.points_in_base.iter().flat_map(both).collect()
}

/// The circles of the smallest and the largest distance from the base's origin, with their radii.
fn add_reach(view: &mut PlaneView, reach: &[ReachExtreme], cell_m: f64) {
    // A circle that is smaller than the squares is none.
    for ReachExtreme { distance_m, .. } in reach.iter().filter(|of| of.distance_m > 2.0 * cell_m) {
        add_circle(view, *distance_m, format!("{distance_m:.3} m from the base's origin"));
    }
}

fn add_circle(view: &mut PlaneView, radius_m: f64, text: String) {
    let point = |corner: u32| {
        let angle = std::f64::consts::TAU * f64::from(corner) / f64::from(CORNERS);
        let (sin, cos) = libm::sincos(angle);
        [radius_m * cos, radius_m * sin]
    };
    view.curves.push(Curve { points: (0..=CORNERS).map(point).collect(), series: None });
    view.labels.push(PlaneLabel { at: [0.0, radius_m], text });
}

/// The cells of points in a plane, with the base's origin and its axis.
fn view(points: Vec<[f64; 2]>, axes: [&str; 2], cell_m: f64) -> PlaneView {
    #[expect(clippy::cast_possible_truncation, reason = "at most some hundred cells along an axis")]
    let cell = |point: [f64; 2]| point.map(|along| (along / cell_m).floor() as i32);
    // By rows, so that neighbours in a row are drawn as one.
    let cells: BTreeSet<[i32; 2]> = points.into_iter().map(cell).map(|[column, row]| [row, column]).collect();
    let mut runs: Vec<[i32; 3]> = Vec::new();
    for [row, column] in cells {
        match runs.last_mut() {
            Some(run) if run[0] == row && run[2] == column => run[2] += 1,
            _ => runs.push([row, column, column + 1]),
        }
    }
    let corner = |column: i32, row: i32| [f64::from(column) * cell_m, f64::from(row) * cell_m];
    let cross = 2.0 * cell_m;
    PlaneView {
        axes: axes.map(str::to_owned),
        areas: runs.iter().map(|&[row, first, end]| [corner(first, row), corner(end, row + 1)]).collect(),
        // The base's origin.
        curves: vec![
            Curve { points: vec![[-cross, 0.0], [cross, 0.0]], series: None },
            Curve { points: vec![[0.0, -cross], [0.0, cross]], series: None },
        ],
        marks: Vec::new(),
        labels: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_circles_of_the_reach_are_labelled() {
        let mut seen = view(vec![[0.5, 0.2], [-0.5, 0.2]], [SIDE_AXIS, AXES[2]], 0.01);
        assert_eq!(seen.areas.len(), 2);
        let extreme = |distance_m: f64| ReachExtreme { distance_m, at: JointValues::new(&[], &[]) };
        add_reach(&mut seen, &[extreme(0.001), extreme(0.54)], 0.01);
        // The inner one is smaller than a square.
        let labels: Vec<&str> = seen.labels.iter().map(|label| label.text.as_str()).collect();
        assert_eq!((labels, seen.curves.len()), (vec!["0.540 m from the base's origin"], 3));
    }
}
