//! `congruent clearance`: distances between links at given configurations.

use congruent_description::{Finding, RobotDescription, RobotQ};
use congruent_kinematics::{KinematicsError, Pose, UrdfTree};
use congruent_simulation::Obstacle;
use nalgebra::Isometry3;
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    clearance::Clearance,
    cut_hulls::cut_hulls,
    hulls::ProximityError,
    pair_names::{PairFault, PairNames},
    pairs::PairChoice,
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
    /// Pairs that were left out by their names.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ignored: Vec<[String; 2]>,
    /// One entry for each configuration, in input order.
    pub results: Vec<Distances>,
    /// Smallest distance that is allowed, if one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit_m: Option<f64>,
    /// Every pair that comes below the limit, the nearest first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub below: Vec<BelowLimit>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// A pair below the limit.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BelowLimit {
    /// Its links.
    pub pair: [String; 2],
    /// Its least distance over the configurations.
    pub distance_m: f64,
    /// The configuration of that distance, from 1.
    pub configuration: usize,
}

/// What is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct DistanceOptions {
    /// Which pairs are left out by the structure of the robot.
    pub choice: PairChoice,
    /// Pairs that are chosen or left out by name.
    pub names: PairNames,
    /// Whether overlaps have a depth.
    pub overlap: Overlap,
    /// Smallest distance that is allowed.
    pub limit_m: Option<f64>,
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
    /// A joint's range is too wide for samples of it to mean anything.
    #[error("joint \"{joint}\" has a range of {width:.1e}: it cannot be sampled")]
    Range {
        /// The joint.
        joint: String,
        /// The width of its range, rad or m.
        width: f64,
    },
    /// A pair is named that is not measured.
    #[error("{}", .0.diagnostic)]
    Pair(Box<PairFault>),
}

/// Distances between convex hulls of links (and to obstacles) at each configuration.
///
/// # Errors
/// [`DistanceError`] if a collision mesh has no extent, or a name is unknown.
pub fn distances(
    description: &RobotDescription,
    obstacles: &[Obstacle],
    options: &DistanceOptions,
    configurations: &[RobotQ],
) -> Result<DistanceReport, DistanceError> {
    let robot = &description.robot;
    let mut clearance = Clearance::new(description, obstacles, options.choice)?;
    let measured: Vec<(&str, &str)> =
        (0..clearance.pairs().len()).map(|pair| clearance.names(pair)).collect();
    let subjects: Vec<&str> = clearance.subjects().iter().map(String::as_str).collect();
    options.names.examine(&subjects, &measured).map_err(DistanceError::Pair)?;
    let names = |chosen: &dyn Fn((&str, &str)) -> bool| -> Vec<[String; 2]> {
        let pairs = measured.iter().filter(|&&pair| chosen(pair));
        pairs.map(|&(a, b)| [a.to_owned(), b.to_owned()]).collect()
    };
    let pairs = names(&|pair| options.names.look_at(pair));
    let ignored = names(&|pair| options.names.is_ignored(pair));
    let looked_at: Vec<usize> =
        (0..measured.len()).filter(|&pair| options.names.look_at(measured[pair])).collect();
    let tree = UrdfTree::new(robot);
    let mut by_analysis = vec![Pose::identity(); robot.links().len()];
    let mut root_from_links = vec![Isometry3::identity(); robot.links().len()];
    let mut results = Vec::with_capacity(configurations.len());
    for q in configurations {
        tree.root_from_links_into(q, &mut by_analysis)?;
        for (pose, by_analysis) in root_from_links.iter_mut().zip(&by_analysis) {
            *pose = by_analysis.to_isometry();
        }
        clearance.move_links(&root_from_links);
        let measure = |&pair: &usize| match options.overlap {
            Overlap::Zero => clearance.measure(pair),
            Overlap::Depth => clearance.measure_signed(pair),
        };
        results.push(Distances { distances_m: looked_at.iter().map(measure).collect() });
    }
    Ok(DistanceReport {
        robot: robot.name().to_owned(),
        joints: robot.movable_joint_names().map(str::to_owned).collect(),
        below: options.limit_m.map_or_else(Vec::new, |limit_m| below(&pairs, &results, limit_m)),
        pairs,
        ignored,
        results,
        limit_m: options.limit_m,
        warnings: description
            .warnings
            .iter()
            .chain(&cut_hulls(description, obstacles))
            .map(Finding::from)
            .collect(),
    })
}

/// Pairs whose least distance is below the limit, the nearest first.
fn below(pairs: &[[String; 2]], results: &[Distances], limit_m: f64) -> Vec<BelowLimit> {
    let least = |(at, pair): (usize, &[String; 2])| {
        let distances = results.iter().enumerate().map(|(index, result)| (result.distances_m[at], index + 1));
        let (distance_m, configuration) = distances.min_by(|(a, _), (b, _)| a.total_cmp(b))?;
        Some(BelowLimit { pair: pair.clone(), distance_m, configuration })
    };
    let least = pairs.iter().enumerate().filter_map(least);
    let mut below: Vec<BelowLimit> = least.filter(|least| least.distance_m < limit_m).collect();
    below.sort_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
    below
}
