//! Mimic joints of two URDFs with the same joints: whether each follows the same joint in the same way. The
//! comparison of poses takes each joint for a driven one, which finds the faults of the chain itself; what follows is
//! compared here.

use congruent_description::{
    Joint, JointIndex, JointValues, Mimic, Robot, RobotDescription, RobotQ, Tolerance,
};
use congruent_kinematics::{LinkPoses, Pose, PoseError, Uniform, UrdfTree, range, sample_configurations};

use super::{
    check::{CheckOptions, RANDOM_CONFIGURATIONS, verdict, worst_difference},
    check_report::{Agreement, CheckReport},
    error::CheckError,
    grade::Grade,
};
use crate::{
    report::{FollowedJoint, Relation, with_mimics},
    source_pair::SourcePair,
};

impl CheckReport {
    /// Adds joints that follow another one in `description` and in `other` in different ways: to the verdict, the
    /// differences, and the diagnosis.
    ///
    /// `poses` are those of the other description, at the configurations of this one.
    ///
    /// # Errors
    /// [`CheckError`] if a source rejects a configuration.
    ///
    /// # Panics
    /// If [`CheckReport::add_other`] was not called before, or if the two have other moving joints.
    pub fn add_mimics(
        &mut self,
        description: &RobotDescription,
        other: &RobotDescription,
        poses: &mut dyn LinkPoses,
        options: &CheckOptions,
    ) -> Result<(), CheckError> {
        let mut joints = Vec::new();
        for joint in differing(&description.robot, &other.robot) {
            // Numbers of two files differ in their last digits; only what moves a link beyond the tolerance is a
            // fault.
            if joint.matters(description, options.seed)? {
                joints.push(joint);
            }
        }
        if joints.is_empty() {
            return Ok(());
        }
        let compared = self.comparisons.iter().find(|of| of.name == SourcePair::UrdfOther);
        let of_chain = compared.map_or(Agreement::NothingCompared, |of| of.verdict);
        let mut worst_remaining = Vec::with_capacity(joints.len() + 1);
        // With none of them corrected, then with the first, the first two, and so on: the residuals of the stages.
        for corrected in 0..=joints.len() {
            let mut differences = MimicDifferences::new(description, &joints[corrected..]);
            let own = sample_configurations(&description.robot, options.seed, RANDOM_CONFIGURATIONS);
            // Seeded by the options, so that a second check gives the same numbers.
            let mut random = Uniform::seeded(options.seed);
            for q in own {
                differences.observe(differences.both(&q, &mut random), poses)?;
            }
            if corrected == 0 {
                for q in options.configurations.iter() {
                    let followed = differences.followed(&q);
                    differences.observe([q, followed], poses)?;
                }
                self.enlarge(description, &differences);
            }
            worst_remaining
                .push(differences.links.iter().copied().fold(PoseError::default(), PoseError::larger));
        }
        let at = self.diagnoses.iter().position(|diagnosis| diagnosis.name == SourcePair::UrdfOther);
        let known = at.map(|at| self.diagnoses.remove(at));
        let words: Vec<FollowedJoint> = joints.into_iter().map(|joint| joint.words).collect();
        let mut diagnoses = std::mem::take(&mut self.diagnoses);
        let mut diagnosis = with_mimics(known, &words, [description, other], &worst_remaining);
        // With all joints driven the poses agree, by the tolerance or by the digits: nothing else is wrong.
        diagnosis.causes[0].within_tolerance |= of_chain == Agreement::Agree;
        diagnoses.push(diagnosis);
        self.set_diagnoses(diagnoses);
        Ok(())
    }

    /// The comparison of the two, its certificate and the verdict with these differences.
    fn enlarge(&mut self, description: &RobotDescription, differences: &MimicDifferences<'_>) {
        for comparison in self.comparisons.iter_mut().filter(|of| of.name == SourcePair::UrdfOther) {
            comparison.verdict = Agreement::Disagree;
            let furthest = differences.furthest.as_ref();
            if let Some((link, [own, other], error)) = furthest
                && !is_farther(&comparison.worst.error, error, &description.tolerance)
            {
                let robot = &description.robot;
                comparison.worst.link.clone_from(&robot.links()[*link].name);
                comparison.worst.at = JointValues::for_movable_joints(robot, own);
                let values = robot.movable_joint_names().zip(own.iter().zip(other.iter()));
                let elsewhere = values.filter(|(_, (own, other))| own.total_cmp(other).is_ne());
                comparison.worst.at_in_other =
                    elsewhere.map(|(name, (_, other))| (name.to_owned(), *other)).collect();
            }
            for (link, error) in comparison.links.iter_mut().zip(&differences.links) {
                link.error = link.error.larger(*error);
                comparison.worst.error = comparison.worst.error.larger(*error);
            }
        }
        // No digits explain it, whatever they explain of the chain.
        self.grade = self.grade.max(Some(Grade::Different));
        // The bounds hold for chains with the same mimic relations; with different ones there is no bound.
        for certificate in self.certificates.iter_mut().filter(|of| of.name == SourcePair::UrdfOther) {
            certificate.brackets = None;
        }
        (self.certificate, self.certificate_bracket) = (None, None);
        self.verdict = verdict(&self.comparisons);
        self.worst = worst_difference(&self.comparisons, &self.tolerance);
    }
}

/// Whether a link is farther off than another: by its position, or if no position is beyond the tolerance, by its orientation.
fn is_farther(error: &PoseError, than: &PoseError, tolerance: &Tolerance) -> bool {
    let key = |of: &PoseError| {
        let beyond_m = if of.position_m > tolerance.position_m { of.position_m } else { 0.0 };
        [beyond_m, of.orientation_rad]
    };
    key(error) > key(than)
}

/// A joint with two relations that are not the same.
struct DifferingMimic {
    coordinate: usize,
    /// The relation in each file: coordinate of the master, multiplier and offset.
    relations: [Option<(usize, f64, f64)>; 2],
    words: FollowedJoint,
}

/// Both robots have the same moving joints by name.
fn differing(robot: &Robot, other: &Robot) -> Vec<DifferingMimic> {
    let relation = |of: &Robot, joint: JointIndex| {
        let Mimic { master, multiplier, offset } = of.joint(joint).mimic?;
        Some(Relation { master: of.joint(master).name.clone(), multiplier, offset })
    };
    let in_coordinates = |relation: &Relation| {
        let coordinate = robot.find_joint(&relation.master).and_then(|master| robot.coordinate(master));
        (coordinate.expect("the joints are the same"), relation.multiplier, relation.offset)
    };
    let differs = |(coordinate, &joint): (usize, &JointIndex)| {
        let name = &robot.joint(joint).name;
        let there = other.find_joint(name).expect("the joints are the same");
        let relations = [relation(robot, joint), relation(other, there)];
        (relations[0] != relations[1]).then(|| DifferingMimic {
            coordinate,
            relations: [0, 1].map(|file| relations[file].as_ref().map(in_coordinates)),
            words: FollowedJoint { joint: name.clone(), unit: robot.joint(joint).kind.unit(), relations },
        })
    };
    robot.movable_joints().iter().enumerate().filter_map(differs).collect()
}

impl DifferingMimic {
    /// Whether the two relations are not the same within the tolerance: two that follow the same joint may differ by
    /// the rounding of their numbers.
    fn matters(&self, description: &RobotDescription, seed: u64) -> Result<bool, CheckError> {
        // Driven in one file and following in the other: this differs at every other position.
        let [Some((master, ..)), Some((other_master, ..))] = self.relations else { return Ok(true) };
        if master != other_master {
            return Ok(true);
        }
        let only = std::slice::from_ref(self);
        let mut differences = MimicDifferences::new(description, only);
        let mut same_chain = UrdfTree::new(&description.robot);
        let mut random = Uniform::seeded(seed);
        for q in sample_configurations(&description.robot, seed, RANDOM_CONFIGURATIONS) {
            let error = differences.observe(differences.both(&q, &mut random), &mut same_chain)?;
            if !error.is_within(&description.tolerance) {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

/// The differences of two sources if some joints have different mimic relations.
struct MimicDifferences<'a> {
    robot: &'a Robot,
    joints: &'a [DifferingMimic],
    tolerance: Tolerance,
    own: UrdfTree,
    own_links: Vec<Pose>,
    other_links: Vec<Pose>,
    /// The worst at each link.
    links: Vec<PoseError>,
    /// The link that is furthest, where by both, and by how much.
    furthest: Option<(usize, [RobotQ; 2], PoseError)>,
}

impl<'a> MimicDifferences<'a> {
    fn new(description: &'a RobotDescription, joints: &'a [DifferingMimic]) -> Self {
        let robot = &description.robot;
        let links = robot.links().len();
        Self {
            robot,
            joints,
            tolerance: description.tolerance,
            own: UrdfTree::new(robot),
            own_links: vec![Pose::identity(); links],
            other_links: vec![Pose::identity(); links],
            links: vec![PoseError::default(); links],
            furthest: None,
        }
    }

    /// A configuration of this description and of the other: a joint that one of them drives is anywhere in its range.
    fn both(&self, q: &RobotQ, random: &mut Uniform) -> [RobotQ; 2] {
        // Zero and the steps from it may be outside of the ranges.
        let joints = self.robot.movable_joints().iter().map(|&joint| self.robot.joint(joint));
        let within = |(joint, q): (&Joint, &f64)| {
            let (lower, upper) = range(joint);
            q.max(lower).min(upper)
        };
        let mut driven: RobotQ = joints.zip(q.iter()).map(within).collect();
        for joint in self.joints.iter().filter(|joint| joint.relations.iter().any(Option::is_none)) {
            let index = self.robot.movable_joints()[joint.coordinate];
            let (lower, upper) = range(self.robot.joint(index));
            driven[joint.coordinate] = random.between(lower, upper);
        }
        let mut own = driven.clone();
        self.robot.apply_mimic(&mut own);
        [own, self.followed(&driven)]
    }

    /// The configuration of the other description.
    fn followed(&self, q: &RobotQ) -> RobotQ {
        let mut there = q.clone();
        for DifferingMimic { coordinate, relations, .. } in self.joints {
            if let Some((master, multiplier, offset)) = relations[1] {
                there[*coordinate] = multiplier * there[master] + offset;
            }
        }
        there
    }

    /// Adds a configuration of both; returns the largest difference there.
    fn observe(
        &mut self,
        [own, other]: [RobotQ; 2],
        poses: &mut dyn LinkPoses,
    ) -> Result<PoseError, CheckError> {
        self.own.root_from_links_into(&own, &mut self.own_links)?;
        poses.root_from_links_into(&other, &mut self.other_links)?;
        let mut here = PoseError::default();
        for link in 0..self.links.len() {
            let error = PoseError::between(&self.own_links[link], &self.other_links[link]);
            here = here.larger(error);
            self.links[link] = self.links[link].larger(error);
            let is_first = |(.., most): &(_, _, PoseError)| is_farther(&error, most, &self.tolerance);
            if self.furthest.as_ref().is_none_or(is_first) {
                self.furthest = Some((link, [own.clone(), other.clone()], error));
            }
        }
        Ok(here)
    }
}
