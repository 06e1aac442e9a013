//! `congruent clearance`: distances between links at given configurations.

use std::{cell::RefCell, fmt};

use congruent_description::{Obstacle, RobotDescription, RobotQ, RobotQList};
use congruent_input::{Diagnostic, Finding};
use congruent_kinematics::{KinematicsError, Pose, UrdfTree};
use nalgebra::Isometry3;
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use super::{
    clearance::Clearance,
    error::ProximityError,
    pair_names::{PairFault, PairNames},
    pairs::PairChoice,
    simplified_hulls::simplified_hulls,
};

/// Distances at one configuration, in the order of the report's pairs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Distances {
    /// 0 if a pair touches or overlaps; negative depths with `--penetration`.
    pub distances_m: Vec<f64>,
}

/// The answer of `congruent clearance`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DistanceReport<'a> {
    /// Name of the robot.
    pub robot: String,
    /// Movable joints, in the order of configuration vectors.
    pub joints: Vec<String>,
    /// The links of each pair.
    pub pairs: Vec<[String; 2]>,
    /// Pairs that `--ignore` excludes by name.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ignored: Vec<[String; 2]>,
    /// One entry for each configuration, in input order.
    #[schemars(with = "Vec<Distances>")]
    pub results: DistanceList<'a>,
    /// Smallest distance that is allowed, if one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit_m: Option<f64>,
    /// Smallest distance over all configurations, if a limit was given.
    #[serde(skip)]
    pub least_m: Option<f64>,
    /// Every pair that comes below the limit, the nearest first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub below: Vec<BelowLimit>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
    /// Those of them that are about hulls with fewer points, for printing.
    #[serde(skip)]
    pub hull_warnings: Vec<Diagnostic>,
}

/// A pair of links that comes nearer than the limit.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BelowLimit {
    /// Names of the two links.
    pub pair: [String; 2],
    /// Its least distance over the configurations.
    pub distance_m: f64,
    /// The configuration of that distance, from 1.
    pub configuration: usize,
}

/// Which pairs are measured, and how overlaps are reported.
#[derive(Debug, Clone, PartialEq)]
pub struct DistanceOptions {
    /// Which pairs the structure of the robot excludes.
    pub choice: PairChoice,
    /// Pairs that are chosen or excluded by name.
    pub names: PairNames,
    /// Distance that is reported for an overlap.
    pub overlap: Overlap,
    /// Smallest distance that is allowed.
    pub limit_m: Option<f64>,
}

/// Distance that is reported for two bodies that overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Overlap {
    /// Overlaps are at distance 0.
    Zero,
    /// Overlaps are at minus their depth.
    Depth,
}

/// Why distances, or a suggestion of pairs, cannot be computed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DistanceError {
    /// A collision shape has no convex hull.
    #[error(transparent)]
    Proximity(#[from] ProximityError),
    /// A configuration does not have one value for each movable joint of the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// A joint's range is too wide for random samples of it to be meaningful.
    #[error(
        "joint \"{joint}\" has a range of width {width:.1e} rad or m, which is too wide to sample (limit 1e6)"
    )]
    Range {
        /// Name of the joint in the URDF.
        joint: String,
        /// The width of its range, rad or m.
        width: f64,
    },
    /// The robot has too many pairs of links to examine.
    #[error("{links} links with collision shapes are {pairs} pairs, limit <= {most}")]
    Pairs {
        /// Number of links with collision shapes.
        links: usize,
        /// Number of pairs of these.
        pairs: usize,
        /// Largest number of pairs.
        most: usize,
    },
    /// The names of pairs do not fit the pairs that can be measured.
    #[error("{}", .0.diagnostic)]
    Pair(Box<PairFault>),
}

/// Distances between convex hulls of links (and to obstacles) at each configuration.
///
/// # Errors
/// [`DistanceError`] if a collision mesh has no extent, a name is unknown, or configurations are those of another robot.
pub fn distances<'a>(
    description: &RobotDescription,
    obstacles: &[Obstacle],
    options: &DistanceOptions,
    configurations: &'a RobotQList,
) -> Result<DistanceReport<'a>, DistanceError> {
    let robot = &description.robot;
    let clearance = Clearance::new(description, obstacles, options.choice)?;
    let measured: Vec<[&str; 2]> = (0..clearance.pairs().len()).map(|pair| clearance.names(pair)).collect();
    let subjects: Vec<&str> = clearance.subjects().iter().map(String::as_str).collect();
    // Before anything is measured: a misspelt name would exclude nothing, silently.
    options.names.examine(&subjects, &measured).map_err(DistanceError::Pair)?;
    let names = |chosen: &dyn Fn([&str; 2]) -> bool| -> Vec<[String; 2]> {
        let pairs = measured.iter().filter(|&&pair| chosen(pair));
        pairs.map(|pair| pair.map(str::to_owned)).collect()
    };
    let pairs = names(&|pair| options.names.is_evaluated(pair));
    let ignored = names(&|pair| options.names.is_ignored(pair));
    let evaluated: Vec<usize> =
        (0..measured.len()).filter(|&pair| options.names.is_evaluated(measured[pair])).collect();
    let links = robot.links().len();
    let measuring = Measuring {
        tree: UrdfTree::new(robot),
        by_analysis: vec![Pose::identity(); links],
        root_from_links: vec![Isometry3::identity(); links],
        clearance,
        evaluated,
        overlap: options.overlap,
    };
    let results = DistanceList::new(configurations, measuring)?;
    // Only for a limit: it goes through all configurations, which are measured again when they are written.
    let least = options.limit_m.map_or_else(Vec::new, |_| least(&pairs, &results));
    let hull_warnings = simplified_hulls(description, obstacles);
    Ok(DistanceReport {
        robot: description.name.clone(),
        joints: robot.movable_joint_names().map(str::to_owned).collect(),
        least_m: least.first().map(|least| least.distance_m),
        below: least
            .into_iter()
            .filter(|of| options.limit_m.is_some_and(|limit_m| of.distance_m < limit_m))
            .collect(),
        pairs,
        ignored,
        results,
        limit_m: options.limit_m,
        warnings: description.warnings.iter().chain(&hull_warnings).map(Finding::from).collect(),
        hull_warnings,
    })
}

/// The least distance of each pair over the configurations, the nearest pair first.
fn least(pairs: &[[String; 2]], results: &DistanceList<'_>) -> Vec<BelowLimit> {
    let mut least: Vec<Option<BelowLimit>> = vec![None; pairs.len()];
    for (configuration, result) in (1..).zip(results.iter()) {
        for ((pair, least), distance_m) in pairs.iter().zip(&mut least).zip(result.distances_m) {
            // Strictly less: the first of several configurations with the same distance is reported.
            if least.as_ref().is_none_or(|least| distance_m < least.distance_m) {
                *least = Some(BelowLimit { pair: pair.clone(), distance_m, configuration });
            }
        }
    }
    let mut least: Vec<BelowLimit> = least.into_iter().flatten().collect();
    least.sort_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
    least
}

/// Distances at many configurations, each measured when it is read, so that memory does not grow with their number.
/// Serialised as a list of [`Distances`].
pub struct DistanceList<'a> {
    configurations: &'a RobotQList,
    measuring: RefCell<Measuring>,
}

/// A robot's hulls, which are moved to one configuration after the other.
struct Measuring {
    tree: UrdfTree,
    by_analysis: Vec<Pose>,
    root_from_links: Vec<Isometry3<f64>>,
    clearance: Clearance,
    evaluated: Vec<usize>,
    overlap: Overlap,
}

impl<'a> DistanceList<'a> {
    /// Measures the first configuration once, so that errors are found here: all configurations have the same joints.
    fn new(configurations: &'a RobotQList, mut measuring: Measuring) -> Result<Self, KinematicsError> {
        if let Some(q) = configurations.get(0) {
            measuring.at(&q)?;
        }
        Ok(Self { configurations, measuring: measuring.into() })
    }

    /// Whether there is no configuration.
    pub fn is_empty(&self) -> bool {
        self.configurations.is_empty()
    }

    /// The distances of every configuration, in input order.
    #[expect(clippy::missing_panics_doc, reason = "the first was measured, and all have as many joints")]
    pub fn iter(&self) -> impl Iterator<Item = Distances> + '_ {
        let at =
            |q| self.measuring.borrow_mut().at(&q).expect("the first has as many joints, and was measured");
        self.configurations.iter().map(at)
    }
}

impl Measuring {
    fn at(&mut self, q: &RobotQ) -> Result<Distances, KinematicsError> {
        let Self { tree, by_analysis, root_from_links, clearance, evaluated, overlap } = self;
        tree.root_from_links_into(q, by_analysis)?;
        for (pose, by_analysis) in root_from_links.iter_mut().zip(by_analysis) {
            *pose = by_analysis.to_isometry();
        }
        // Every call is a new instant, so that no distance of the configuration before counts as current.
        clearance.move_links(root_from_links);
        let measure = |&pair: &usize| match overlap {
            Overlap::Zero => clearance.measure(pair),
            Overlap::Depth => clearance.measure_signed(pair),
        };
        Ok(Distances { distances_m: evaluated.iter().map(measure).collect() })
    }
}

impl Serialize for DistanceList<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl fmt::Debug for DistanceList<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DistanceList")
            .field("configurations", &self.configurations.len())
            .finish_non_exhaustive()
    }
}
