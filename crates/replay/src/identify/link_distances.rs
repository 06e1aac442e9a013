//! Distances of the links at configurations, without pairs that are always near.

use std::collections::BTreeSet;

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::{Pose, Uniform, UrdfTree, range};
use congruent_proximity::{Clearance, PairChoice, ProximityError};
use congruent_twin::RunSetup;
use nalgebra::Isometry3;

/// Configurations at which a pair has to be near to count as always near. Kind: choice.
const CONFIGURATIONS: usize = 40;

/// And it is nearer than this, m: neighbours and fingers are. Kind: choice.
const ALWAYS_NEAR_M: f64 = 0.05;

/// Distances of the links from each other and from obstacles.
pub(super) struct LinkDistances {
    clearance: Clearance,
    tree: UrdfTree,
    poses: Vec<Pose>,
    root_from_links: Vec<Isometry3<f64>>,
    always_near: BTreeSet<usize>,
}

/// The nearest pair at a configuration.
pub(super) struct NearestLinks {
    pub(super) distance_m: f64,
    pub(super) names: [String; 2],
}

impl LinkDistances {
    /// Pairs that are nearer than `clearance_m` wherever the robot is, such as neighbours and the fingers of a gripper, do not count.
    pub(super) fn new(
        description: &RobotDescription,
        surroundings: Option<&RunSetup>,
        clearance_m: f64,
        seed: u64,
    ) -> Result<Self, ProximityError> {
        let obstacles = surroundings.map_or(&[][..], |setup| &setup.obstacles);
        let links = description.robot.links().len();
        let mut distances = Self {
            clearance: Clearance::new(description, obstacles, PairChoice::Usual)?,
            tree: UrdfTree::new(&description.robot),
            poses: vec![Pose::identity(); links],
            root_from_links: vec![Isometry3::identity(); links],
            always_near: BTreeSet::new(),
        };
        let robot = &description.robot;
        let mut random = Uniform::seeded(seed);
        let mut near: Option<BTreeSet<usize>> = None;
        for _ in 0..CONFIGURATIONS {
            let place = |&joint| {
                let (lower, upper) = range(robot.joint(joint));
                random.between(lower, upper)
            };
            let mut q: RobotQ = robot.movable_joints().iter().map(place).collect();
            robot.apply_mimic(&mut q);
            let now = distances.near(&q, clearance_m.min(ALWAYS_NEAR_M));
            near = Some(near.map_or_else(|| now.clone(), |before| &before & &now));
        }
        distances.always_near = near.unwrap_or_default();
        Ok(distances)
    }

    /// The nearest pair; `None` if no links can touch.
    pub(super) fn nearest(&mut self, q: &RobotQ) -> Option<NearestLinks> {
        self.place(q)?;
        let Self { clearance, always_near, .. } = self;
        let nearest = clearance.nearest_of(f64::INFINITY, |pair, _| !always_near.contains(&pair))?;
        let names = clearance.names(nearest.pair).map(str::to_owned);
        Some(NearestLinks { distance_m: nearest.distance_m, names })
    }

    /// Names of the pairs that do not count.
    pub(super) fn always_near(&self) -> Vec<String> {
        self.always_near.iter().map(|&pair| self.clearance.names(pair).join("--")).collect()
    }

    fn near(&mut self, q: &RobotQ, threshold_m: f64) -> BTreeSet<usize> {
        let mut found = BTreeSet::new();
        if self.place(q).is_some() {
            self.clearance.below(
                threshold_m,
                |_| threshold_m,
                |pair, _| {
                    found.insert(pair);
                },
            );
        }
        found
    }

    fn place(&mut self, q: &RobotQ) -> Option<()> {
        self.tree.root_from_links_into(q, &mut self.poses).ok()?;
        self.root_from_links.iter_mut().zip(&self.poses).for_each(|(link, pose)| *link = pose.to_isometry());
        self.clearance.move_links(&self.root_from_links);
        Some(())
    }
}
