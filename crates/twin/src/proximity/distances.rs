//! `congruent clearance`: distances between links at given configurations.

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::{KinematicsError, Pose, UrdfTree};
use congruent_simulation::Obstacle;
use nalgebra::Isometry3;
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    clearance::{Clearance, PairChoice},
    hulls::ProximityError,
};

/// Distances at one configuration, in the order of the report's pairs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Distances {
    /// 0 if a pair touches or overlaps; negative depths with `--penetration`.
    pub distances_m: Vec<f64>,
}

/// The answer of `congruent clearance`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DistanceReport {
    /// Name of the robot.
    pub robot: String,
    /// Movable joints, in the order of configuration vectors.
    pub joints: Vec<String>,
    /// The links of each pair.
    pub pairs: Vec<[String; 2]>,
    /// One entry for each configuration, in input order.
    pub results: Vec<Distances>,
}

/// Whether overlaps have a depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Overlap {
    /// Overlaps are at distance 0.
    Zero,
    /// Overlaps are at minus their depth.
    Depth,
}

/// Why there are no distances.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DistanceError {
    /// A collision shape has no convex hull.
    #[error(transparent)]
    Proximity(#[from] ProximityError),
    /// A configuration is none of the robot's.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
}

/// Distances between convex hulls of links (and to obstacles) at each configuration.
///
/// # Errors
/// [`DistanceError`] if a collision mesh has no extent.
pub fn distances(
    description: &RobotDescription,
    obstacles: &[Obstacle],
    (choice, overlap): (PairChoice, Overlap),
    configurations: &[RobotQ],
) -> Result<DistanceReport, DistanceError> {
    let robot = &description.robot;
    let mut clearance = Clearance::new(description, obstacles, choice)?;
    let tree = UrdfTree::new(robot);
    let pairs = clearance.pairs().len();
    let mut by_analysis = vec![Pose::identity(); robot.links().len()];
    let mut root_from_links = vec![Isometry3::identity(); robot.links().len()];
    let mut results = Vec::with_capacity(configurations.len());
    for q in configurations {
        tree.root_from_links_into(q, &mut by_analysis)?;
        for (pose, by_analysis) in root_from_links.iter_mut().zip(&by_analysis) {
            *pose = by_analysis.to_isometry();
        }
        clearance.move_links(&root_from_links);
        let measure = |pair| match overlap {
            Overlap::Zero => clearance.measure(pair),
            Overlap::Depth => clearance.measure_signed(pair),
        };
        results.push(Distances { distances_m: (0..pairs).map(measure).collect() });
    }
    let names = |pair| {
        let (a, b) = clearance.names(pair);
        [a.to_owned(), b.to_owned()]
    };
    Ok(DistanceReport {
        robot: robot.name().to_owned(),
        joints: robot.movable_joint_names().map(str::to_owned).collect(),
        pairs: (0..pairs).map(names).collect(),
        results,
    })
}
