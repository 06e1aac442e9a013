//! The joint states of one topic.

use std::{
    collections::{BTreeMap, BTreeSet},
    hash::{DefaultHasher, Hash, Hasher},
    sync::Arc,
};

use congruent_robot::Robot;

use super::{
    clock::MessageSum,
    limits::{LimitsTrack, moving_names},
    names::{NameMatch, match_names},
    report::{JointsSurvey, LoggedJoint, MissingShares},
};
use crate::event::{LoggedJoints, float};

/// Most joints of a topic; further names are not followed. Kind: choice; a log with other names in each message is damaged.
const MOST_JOINTS: usize = 1000;

/// A joint of the topic so far.
#[derive(Debug)]
pub(super) struct JointTrack {
    pub(super) name: String,
    /// Messages that name it.
    present: u64,
    position_range: Option<[f64; 2]>,
    largest_velocity: Option<f64>,
    largest_effort: Option<f64>,
    /// The joint of the robot that it is.
    pub(super) of_robot: Option<NameMatch>,
    pub(super) limits: Option<LimitsTrack>,
}

impl JointTrack {
    fn named(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            present: 0,
            position_range: None,
            largest_velocity: None,
            largest_effort: None,
            of_robot: None,
            limits: None,
        }
    }
}

/// How many values there are, and how many of them are not numbers: NaN, or infinite.
#[derive(Debug, Default)]
struct MissingCount {
    values: u64,
    missing: u64,
}

/// The joint states of a topic so far.
#[derive(Debug, Default)]
pub(super) struct JointsTrack {
    pub(super) joints: Vec<JointTrack>,
    by_name: BTreeMap<String, usize>,
    names: Option<Arc<[String]>>,
    /// Of the current names: their joints, and the sum of the names.
    indices: Vec<Option<usize>>,
    names_sum: u64,
    messages: u64,
    /// Messages by the number of different joints that they name.
    by_number: BTreeMap<usize, u64>,
    number: usize,
    order_changes: u64,
    wrong_lengths: u64,
    without: [u64; 3],
    missing: [MissingCount; 3],
}

impl JointsTrack {
    /// Takes a message.
    pub(super) fn take(&mut self, message: &LoggedJoints, robot: Option<&Robot>) {
        if !self.names.as_ref().is_some_and(|names| Arc::ptr_eq(names, &message.names)) {
            self.order_changes += u64::from(self.names.is_some());
            self.set_names(&message.names, robot);
        }
        self.messages += 1;
        *self.by_number.entry(self.number).or_default() += 1;
        self.indices.iter().flatten().for_each(|&joint| self.joints[joint].present += 1);
        let arrays = [&message.position, &message.velocity, &message.effort];
        for (without, array) in self.without.iter_mut().zip(arrays) {
            *without += u64::from(array.is_empty());
        }
        if message.has_wrong_length() {
            self.wrong_lengths += 1;
            return;
        }
        for (count, array) in self.missing.iter_mut().zip(arrays) {
            count.values += array.len() as u64;
            count.missing += array.iter().filter(|value| !value.is_finite()).count() as u64;
        }
        self.values(message);
    }

    fn set_names(&mut self, names: &Arc<[String]>, robot: Option<&Robot>) {
        self.names = Some(Arc::clone(names));
        let different: BTreeSet<&str> = names.iter().map(String::as_str).collect();
        self.number = different.len();
        self.add_joints(names, robot);
        self.indices = names.iter().map(|name| self.by_name.get(name).copied()).collect();
        let mut hasher = DefaultHasher::new();
        names.hash(&mut hasher);
        self.names_sum = hasher.finish();
    }

    /// Adds those that are not known yet.
    fn add_joints(&mut self, names: &[String], robot: Option<&Robot>) {
        let mut fresh: Vec<&str> = Vec::new();
        for name in names {
            let is_known = self.by_name.contains_key(name);
            if !is_known && self.joints.len() < MOST_JOINTS {
                self.by_name.insert(name.clone(), self.joints.len());
                self.joints.push(JointTrack::named(name));
                fresh.push(name);
            }
        }
        let Some(robot) = robot.filter(|_| !fresh.is_empty()) else { return };
        let is_taken = |joint: usize| {
            let mut of_robot = self.joints.iter().filter_map(|known| known.of_robot.as_ref());
            of_robot.any(|of_robot| of_robot.joint == joint)
        };
        let matched = match_names(&fresh, &moving_names(robot), is_taken);
        let first = self.joints.len() - fresh.len();
        for (joint, matched) in self.joints[first..].iter_mut().zip(matched) {
            let of_robot = matched.as_ref().map(|of| robot.joint(robot.movable_joints()[of.joint]));
            joint.limits = of_robot.and_then(LimitsTrack::new);
            joint.of_robot = matched;
        }
    }

    fn values(&mut self, message: &LoggedJoints) {
        for (at, joint) in self.indices.iter().enumerate() {
            let Some(joint) = joint.map(|joint| &mut self.joints[joint]) else { continue };
            let value = |array: &[f64]| array.get(at).copied().filter(|value| value.is_finite());
            if let Some(position) = value(&message.position) {
                let [least, largest] = joint.position_range.unwrap_or([position; 2]);
                joint.position_range = Some([least.min(position), largest.max(position)]);
                joint.limits.iter_mut().for_each(|limits| limits.take(position));
            }
            let largest = |known: Option<f64>, value: Option<f64>| match (known, value) {
                (Some(known), Some(value)) => Some(known.max(value.abs())),
                (known, value) => known.or(value.map(f64::abs)),
            };
            joint.largest_velocity = largest(joint.largest_velocity, value(&message.velocity));
            joint.largest_effort = largest(joint.largest_effort, value(&message.effort));
        }
    }

    /// The sum of the message that was taken last.
    pub(super) fn sum(&self, message: &LoggedJoints) -> MessageSum {
        let mut hasher = DefaultHasher::new();
        for array in [&message.position, &message.velocity, &message.effort] {
            array.len().hash(&mut hasher);
            for value in array {
                value.to_bits().hash(&mut hasher);
            }
        }
        MessageSum { about: self.names_sum, values: hasher.finish() }
    }

    pub(super) fn report(&self) -> JointsSurvey {
        let joint = |of: &JointTrack| LoggedJoint {
            name: of.name.clone(),
            missing_in: self.messages - of.present.min(self.messages),
            position_range: of.position_range,
            largest_velocity: of.largest_velocity,
            largest_effort: of.largest_effort,
        };
        let all = self.joints.len();
        let incomplete =
            self.by_number.iter().filter(|(number, _)| **number < all).map(|(_, messages)| messages);
        let share =
            |of: &MissingCount| if of.values == 0 { 0.0 } else { float(of.missing) / float(of.values) };
        let [position, velocity, effort] = &self.missing;
        JointsSurvey {
            joints: self.joints.iter().map(joint).collect(),
            messages: self.messages,
            order_changes: self.order_changes,
            incomplete: incomplete.sum(),
            wrong_lengths: self.wrong_lengths,
            without_positions: self.without[0],
            without_velocities: self.without[1],
            without_efforts: self.without[2],
            missing_values: MissingShares {
                position: share(position),
                velocity: share(velocity),
                effort: share(effort),
            },
        }
    }
}
