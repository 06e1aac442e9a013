//! What a change does to a robot: the description of today against that of a revision, in the terms of who reviews it.

use congruent_description::{JointIndex, Robot, RobotDescription, RobotQ, Tolerance};
use congruent_dynamics::BodyTree;
use congruent_dynamics_agreement::DynamicsReport;
use congruent_input::{
    RevisionName, SiUnit,
    display::{counted, quantity},
};
use congruent_kinematics::{KinematicsError, Pose, PoseError, UrdfTree, sample_configurations};
use congruent_mapping::{ChangedValue, changed_inertias, changed_values};
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    cause_in_words::{MOST_NAMED, few_or_number},
    changed_shapes::changed_shapes,
    changed_table::{changed_table, has_other_table},
    forces_not_compared::forces_not_compared,
    reported_mapping::ReportedMapping,
};

/// Random configurations beside zero, single axes and the limits.
const RANDOM: usize = 200;
/// Smaller changes of a mass or torque are rounding, relative to the value.
const ROUNDED: f64 = 1e-9;

/// The robot against the same one in a revision.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RevisionChange {
    /// The revision, as the caller names it.
    pub revision: String,
    /// The tip, or `TCP` if a tool is declared.
    pub link: String,
    /// The largest change of its pose at zero, single axes, the limits and 200 random configurations.
    #[serde(flatten)]
    pub moved: PoseError,
    /// Joints that the revision lacks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joints_added: Vec<String>,
    /// Joints that only the revision has.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joints_removed: Vec<String>,
    /// Links that the revision lacks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub links_added: Vec<String>,
    /// Links that only the revision has.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub links_removed: Vec<String>,
    /// Links whose masses differ.
    pub masses: Vec<ChangedMass>,
    /// Links of both with another centre of mass or inertia.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub inertias: Vec<String>,
    /// Links of both that collide with other shapes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub collision_shapes: Vec<String>,
    /// Values of the table, limits and losses of joints that differ.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<ChangedValue>,
    /// Whether the Denavit-Hartenberg table is of another convention, has other rows or other frames at its ends, or is new.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub has_other_table: bool,
    /// The joint whose largest gravity torque at these configurations changes most; missing if none does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity: Option<ChangedTorque>,
    /// What is read and not compared, as a spring, if it differs.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub not_compared: Vec<String>,
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
    /// Compares a robot with one of a revision; `None` if the other is of no revision. Joints with other names, directions or
    /// zeros are those of `mapping`.
    ///
    /// # Errors
    /// The poses of one of them cannot be computed.
    pub(super) fn new(
        description: &RobotDescription,
        before: &RobotDescription,
        mapping: Option<&ReportedMapping>,
        seed: u64,
    ) -> Result<Option<Self>, KinematicsError> {
        let Some(name) = RevisionName::of(&before.path) else { return Ok(None) };
        let pair = CommonJoints::new([&description.robot, &before.robot], mapping, seed);
        let has_tool = description.tip_from_tcp.is_some() || before.tip_from_tcp.is_some();
        let tip = &description.robot.link(description.tip).name;
        Ok(Some(Self {
            revision: name.revision,
            moved: pair.moved([description, before])?,
            link: if has_tool { "the TCP".to_owned() } else { tip.clone() },
            joints_added: pair.alone(0),
            joints_removed: pair.alone(1),
            links_added: links_alone(&description.robot, &before.robot),
            links_removed: links_alone(&before.robot, &description.robot),
            masses: changed_masses(&description.robot, &before.robot),
            inertias: changed_inertias(&description.robot, &before.robot),
            collision_shapes: changed_shapes(&description.robot, &before.robot),
            values: changed_table([description, before]).into_iter().chain(pair.values()).collect(),
            has_other_table: has_other_table([description, before]),
            gravity: pair.gravity(),
            not_compared: forces_not_compared(description, before),
        }))
    }

    /// Whether the pose of the tip or the TCP changes by more than a tolerance.
    pub(super) fn is_moved(&self, tolerance: &Tolerance) -> bool {
        !self.moved.is_within(tolerance)
    }

    /// Whether a frame, a joint, a limit or a loss is another, or the tip moves: what other programs rely on.
    pub(super) fn decides(&self, tolerance: &Tolerance) -> bool {
        let lists = [&self.joints_added, &self.joints_removed, &self.links_added, &self.links_removed];
        self.is_moved(tolerance)
            || self.has_other_table
            || !self.values.is_empty()
            || lists.iter().any(|list| !list.is_empty())
    }

    /// What it does to masses and torques, in words.
    pub(super) fn parts(&self) -> Vec<String> {
        let mut parts = Vec::new();
        let lists = [
            ("adds", "joint", &self.joints_added),
            ("removes", "joint", &self.joints_removed),
            ("adds", "link", &self.links_added),
            ("removes", "link", &self.links_removed),
        ];
        for (verb, what, names) in lists {
            match names.len() {
                0 => {}
                1..=MOST_NAMED => parts.push(format!("{verb} {what} {}", few_or_number(names, what))),
                _ => parts.push(format!("{verb} {}", few_or_number(names, what))),
            }
        }
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
        let lists = [
            (["other centre of mass or inertia", "other centres of mass or inertias"], &self.inertias),
            (["other collision shapes"; 2], &self.collision_shapes),
        ];
        for ([of_few, of_many], links) in lists {
            let what = if links.len() > MOST_NAMED { of_many } else { of_few };
            if !links.is_empty() {
                parts.push(format!("{what} of {}", few_or_number(links, "link")));
            }
        }
        parts.extend(self.has_other_table.then(|| "another DH table".to_owned()));
        parts.extend(self.values.iter().take(MOST_NAMED).map(ChangedValue::sentence));
        if self.values.len() > MOST_NAMED {
            parts.push(format!("{} more", counted(self.values.len() - MOST_NAMED, "value")));
        }
        parts.extend(self.not_compared.first().map(|first| match self.not_compared.len() {
            1 => format!("not compared, and changed: {first}"),
            count => format!("not compared, and changed: {first}, and {} more", count - 1),
        }));
        parts
    }
}

/// A joint of a robot in one of a revision: `q_before = sign * q + offset`.
#[derive(Clone, Copy)]
struct Counterpart {
    coordinate: usize,
    sign: f64,
    offset: f64,
}

/// Two robots at the same positions of the joints that both have; the others are at 0.
struct CommonJoints<'a> {
    robots: [&'a Robot; 2],
    /// For each moving joint of the first the one of the second.
    counterparts: Vec<Option<Counterpart>>,
    /// Pairs of configurations, each in the coordinates of its robot.
    configurations: Vec<[RobotQ; 2]>,
}

impl<'a> CommonJoints<'a> {
    fn new(robots: [&'a Robot; 2], mapping: Option<&ReportedMapping>, seed: u64) -> Self {
        let [own, before] = robots;
        let counterpart = |&joint: &JointIndex| {
            let name = &own.joint(joint).name;
            let mapped = mapping.and_then(|mapping| mapping.joints.iter().find(|of| of.joint == *name));
            let other = mapped.map_or(name, |of| &of.other);
            let coordinate = before.coordinate(before.find_joint(other)?)?;
            let (sign, offset) = mapped.map_or((1.0, 0.0), |of| (f64::from(of.sign), of.offset));
            Some(Counterpart { coordinate, sign, offset })
        };
        let counterparts: Vec<Option<Counterpart>> = own.movable_joints().iter().map(counterpart).collect();
        let of_both = |mut q: RobotQ| {
            let mut there = RobotQ::zeros(before.dof());
            for (coordinate, of) in counterparts.iter().enumerate() {
                match of {
                    Some(of) => there[of.coordinate] = of.sign * q[coordinate] + of.offset,
                    None => q[coordinate] = 0.0,
                }
            }
            // A joint that follows another one follows as its own file says.
            before.apply_mimic(&mut there);
            [q, there]
        };
        let configurations = sample_configurations(own, seed, RANDOM).into_iter().map(of_both).collect();
        Self { robots, counterparts, configurations }
    }

    /// The moving joints that only one of the two has.
    fn alone(&self, of: usize) -> Vec<String> {
        let robot = self.robots[of];
        let is_common = |coordinate: usize| {
            let mut counterparts = self.counterparts.iter().flatten();
            if of == 0 {
                self.counterparts[coordinate].is_some()
            } else {
                counterparts.any(|other| other.coordinate == coordinate)
            }
        };
        let alone =
            robot.movable_joints().iter().enumerate().filter(|(coordinate, _)| !is_common(*coordinate));
        alone.map(|(_, &joint)| robot.joint(joint).name.clone()).collect()
    }

    /// Limits and losses that differ.
    fn values(&self) -> Vec<ChangedValue> {
        let [own, before] = self.robots;
        let of_joint = |(&joint, counterpart): (&JointIndex, &Option<Counterpart>)| {
            let counterpart = (*counterpart)?;
            let there = before.movable_joints()[counterpart.coordinate];
            let is_counted_alike = counterpart.sign > 0.0 && counterpart.offset == 0.0;
            let [joint, there] = [own.joint(joint), before.joint(there)];
            let ranges = [joint, there].map(|of| of.position_range().filter(|_| is_counted_alike));
            Some(changed_values(joint, there, ranges))
        };
        own.movable_joints().iter().zip(&self.counterparts).filter_map(of_joint).flatten().collect()
    }

    /// The largest change of the pose of the tip, with the tools that are declared.
    fn moved(&self, descriptions: [&RobotDescription; 2]) -> Result<PoseError, KinematicsError> {
        let mut largest = PoseError::default();
        let [description, before] = descriptions;
        let tip = &description.robot.link(description.tip).name;
        // A tip with another name is still the tip.
        let there = before.robot.find_link(tip).unwrap_or(before.tip);
        let trees = self.robots.map(UrdfTree::new);
        let tools = descriptions.map(|of| of.tip_from_tcp.map_or_else(Pose::identity, Pose::from));
        for q in &self.configurations {
            let own = trees[0].root_from_link(&q[0], description.tip)? * tools[0];
            let other = trees[1].root_from_link(&q[1], there)? * tools[1];
            largest = largest.larger(PoseError::between(&own, &other));
        }
        Ok(largest)
    }

    /// The joint whose largest gravity torque changes most.
    fn gravity(&self) -> Option<ChangedTorque> {
        let [own, before] = [0, 1].map(|at| self.largest_gravity(at));
        let robot = self.robots[0];
        let torque = |(coordinate, &joint): (usize, &JointIndex)| {
            let joint = robot.joint(joint);
            let (found, before) = (own[coordinate], before[self.counterparts[coordinate]?.coordinate]);
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

/// Whether dynamics is compared with that of a revision, and not with values of the robot file.
pub(super) fn is_of_revision(report: &DynamicsReport) -> bool {
    RevisionName::of(report.sides.reference.as_ref()).is_some()
}

fn links_alone(robot: &Robot, other: &Robot) -> Vec<String> {
    let names = robot.links().iter().map(|link| &link.name);
    names.filter(|name| other.find_link(name).is_none()).cloned().collect()
}

fn changed_masses(robot: &Robot, before: &Robot) -> Vec<ChangedMass> {
    let mass =
        |robot: &Robot, name: &str| robot.link(robot.find_link(name)?).inertia.as_ref().map(|of| of.mass_kg);
    let own = robot.links().iter().map(|link| link.name.clone());
    let of =
        |link: String| ChangedMass { found_kg: mass(robot, &link), before_kg: mass(before, &link), link };
    let differs = |mass: &ChangedMass| {
        mass.added_kg().abs()
            > ROUNDED * mass.found_kg.unwrap_or_default().max(mass.before_kg.unwrap_or_default())
    };
    own.chain(links_alone(before, robot)).map(of).filter(differs).collect()
}
