//! What a change does to a robot: the description of today against that of a revision, in the terms of who reviews it.

use congruent_description::{Robot, RobotDescription, RobotQ};
use congruent_dynamics::BodyTree;
use congruent_input::{
    RevisionName, SiUnit,
    display::{counted, quantity},
};
use congruent_kinematics::{KinematicsError, PoseError, UrdfTree, sample_configurations};
use schemars::JsonSchema;
use serde::Serialize;

/// Random configurations beside zero, single axes and the limits.
const RANDOM: usize = 200;
/// Smaller changes of a mass or torque are rounding, relative to the value.
const ROUNDED: f64 = 1e-9;
/// Links whose masses a headline names.
const MOST_NAMED: usize = 3;

/// The robot against the same one in a revision.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RevisionChange {
    /// The revision, as the caller names it.
    pub revision: String,
    /// The tip.
    pub link: String,
    /// The largest change of its pose at zero, single axes, the limits and 200 random configurations.
    #[serde(flatten)]
    pub moved: PoseError,
    /// Links whose masses differ.
    pub masses: Vec<ChangedMass>,
    /// The joint whose largest gravity torque at these configurations changes most; missing if none does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity: Option<ChangedTorque>,
}

/// A link whose mass differs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ChangedMass {
    /// Its name.
    pub link: String,
    /// Its mass today; `null` if the link has none, or is new.
    pub found_kg: Option<f64>,
    /// Its mass in the revision; `null` if the link had none, or is new.
    pub before_kg: Option<f64>,
}

impl ChangedMass {
    fn added_kg(&self) -> f64 {
        self.found_kg.unwrap_or_default() - self.before_kg.unwrap_or_default()
    }
}

/// The largest gravity torque of a joint, today and before.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ChangedTorque {
    /// The joint.
    pub joint: String,
    /// Today, N m or N.
    pub found: f64,
    /// In the revision.
    pub before: f64,
    /// `N m` or `N`.
    #[schemars(with = "String")]
    pub unit: SiUnit,
}

impl RevisionChange {
    /// Compares a robot with one of a revision; `None` if the other is of no revision, or if they have other joints.
    ///
    /// # Errors
    /// The poses of one of them cannot be computed.
    pub(super) fn new(
        description: &RobotDescription,
        before: &RobotDescription,
        seed: u64,
    ) -> Result<Option<Self>, KinematicsError> {
        let Some(name) = RevisionName::of(&before.path) else { return Ok(None) };
        let Some(pair) = SameJoints::new([&description.robot, &before.robot], seed) else { return Ok(None) };
        let link = description.robot.link(description.tip).name.clone();
        Ok(Some(Self {
            revision: name.revision,
            moved: pair.moved(&link)?,
            link,
            masses: changed_masses(&description.robot, &before.robot),
            gravity: pair.gravity(),
        }))
    }

    /// What it does to masses and torques, in words.
    pub(super) fn parts(&self) -> Vec<String> {
        let mut parts = Vec::new();
        let added = |mass: &ChangedMass| {
            let added_kg = mass.added_kg();
            let verb = if added_kg > 0.0 { "adds" } else { "removes" };
            format!("{verb} {} at {}", quantity(added_kg.abs(), "kg"), mass.link)
        };
        if self.masses.len() <= MOST_NAMED {
            parts.extend(self.masses.iter().map(added));
        } else {
            let total_kg: f64 = self.masses.iter().map(ChangedMass::added_kg).sum();
            let sign = if total_kg < 0.0 { "-" } else { "+" };
            let links = counted(self.masses.len(), "link");
            parts.push(format!(
                "changes the masses of {links} ({sign}{} in all)",
                quantity(total_kg.abs(), "kg")
            ));
        }
        parts.extend(self.gravity.as_ref().map(|torque| {
            let by = torque.found - torque.before;
            let sign = if by < 0.0 { "-" } else { "+" };
            let [by, found] = [by.abs(), torque.found].map(|value| quantity(value, torque.unit.symbol()));
            format!("largest gravity torque of {} {sign}{by} (now {found})", torque.joint)
        }));
        parts
    }
}

/// Two robots with the same moving joints by name.
struct SameJoints<'a> {
    robots: [&'a Robot; 2],
    /// Pairs of configurations, each in the coordinates of its robot.
    configurations: Vec<[RobotQ; 2]>,
}

impl<'a> SameJoints<'a> {
    fn new(robots: [&'a Robot; 2], seed: u64) -> Option<Self> {
        let [own, before] = robots;
        let coordinate = |&joint| {
            let other = before.find_joint(&own.joint(joint).name)?;
            before.coordinate(other)
        };
        let coordinates: Vec<usize> = own.movable_joints().iter().map(coordinate).collect::<Option<_>>()?;
        if coordinates.len() != before.dof() {
            return None;
        }
        let of_both = |q: RobotQ| {
            let mut there = RobotQ::zeros(before.dof());
            for (value, &coordinate) in q.iter().zip(&coordinates) {
                there[coordinate] = *value;
            }
            [q, there]
        };
        let configurations = sample_configurations(own, seed, RANDOM).into_iter().map(of_both).collect();
        Some(Self { robots, configurations })
    }

    /// The largest change of the pose of a link.
    fn moved(&self, link: &str) -> Result<PoseError, KinematicsError> {
        let mut largest = PoseError::default();
        let [own, before] = self.robots;
        let Some(indices) = own.find_link(link).zip(before.find_link(link)) else { return Ok(largest) };
        let [own, before] = [UrdfTree::new(own), UrdfTree::new(before)];
        for [q, there] in &self.configurations {
            let poses = [own.root_from_link(q, indices.0)?, before.root_from_link(there, indices.1)?];
            largest = largest.larger(PoseError::between(&poses[0], &poses[1]));
        }
        Ok(largest)
    }

    /// The joint whose largest gravity torque changes most.
    fn gravity(&self) -> Option<ChangedTorque> {
        let [own, before] = [0, 1].map(|at| self.largest_gravity(at));
        let robot = self.robots[0];
        let torque = |(coordinate, &joint): (usize, &congruent_description::JointIndex)| {
            let joint = robot.joint(joint);
            let there = self.robots[1].coordinate(self.robots[1].find_joint(&joint.name)?)?;
            let (found, before) = (own[coordinate], before[there]);
            let is_rounding = (found - before).abs() <= ROUNDED * found.max(before);
            (!is_rounding).then(|| ChangedTorque {
                joint: joint.name.clone(),
                found,
                before,
                unit: if joint.kind.is_angular() { SiUnit::NewtonMetre } else { SiUnit::Newton },
            })
        };
        let changed = robot.movable_joints().iter().enumerate().filter_map(torque);
        changed.max_by(|a, b| (a.found - a.before).abs().total_cmp(&(b.found - b.before).abs()))
    }

    /// The largest gravity torque of each coordinate of one of the robots; zeros if it cannot be computed.
    fn largest_gravity(&self, at: usize) -> Vec<f64> {
        let tree = BodyTree::new(self.robots[at]);
        let mut buffer = tree.buffer();
        let (mut tau, mut largest) = (vec![0.0; tree.dof()], vec![0.0_f64; tree.dof()]);
        for q in &self.configurations {
            if tree.gravity_into(&q[at], &mut buffer, &mut tau).is_ok() {
                largest.iter_mut().zip(&tau).for_each(|(most, tau)| *most = most.max(tau.abs()));
            }
        }
        largest
    }
}

fn changed_masses(robot: &Robot, before: &Robot) -> Vec<ChangedMass> {
    let mass =
        |robot: &Robot, name: &str| robot.link(robot.find_link(name)?).inertia.as_ref().map(|of| of.mass_kg);
    let own = robot.links().iter().map(|link| &link.name);
    let only_before =
        before.links().iter().map(|link| &link.name).filter(|name| robot.find_link(name).is_none());
    let of = |name: &String| ChangedMass {
        link: name.clone(),
        found_kg: mass(robot, name),
        before_kg: mass(before, name),
    };
    let differs = |mass: &ChangedMass| {
        mass.added_kg().abs()
            > ROUNDED * mass.found_kg.unwrap_or_default().max(mass.before_kg.unwrap_or_default())
    };
    own.chain(only_before).map(of).filter(differs).collect()
}
