//! The joint states of a recording, as a source for a run: the same checks see them again.

use congruent_description::{LinkIndex, Robot, RobotQ};
use congruent_kinematics::{Pose, UrdfTree};
use congruent_monitors::{JointSample, JointStateView, SetpointView};
use congruent_results::comparison::Scalars;
use congruent_twin::{
    RunSetup,
    source::{Advance, JointStateSource, SourceError},
};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use crate::{rrd::paths, series::joints::COORDINATES};

/// How far a recording goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RecordedUntil {
    /// To the end of the run.
    End,
    /// The run ended before its time.
    Early,
}

/// All joints at one recorded instant.
#[derive(Debug, Clone)]
struct RecordedInstant {
    /// The time of the step, without the rounding of the recording to nanoseconds.
    time_s: f64,
    truth: RobotQ,
    /// Empty if it is not recorded; likewise the efforts.
    qd: Vec<f64>,
    effort: Vec<f64>,
    measured: RobotQ,
    setpoint: Option<(RobotQ, Vec<f64>)>,
    root_from_tcp: Option<Isometry3<f64>>,
}

/// The recorded instants, one after another.
#[derive(Debug)]
pub(super) struct RecordedStates {
    instants: Vec<RecordedInstant>,
    at: usize,
    /// Whether the last instant is the end of the run.
    is_whole: bool,
    tree: UrdfTree,
    /// The poses of the links at this instant, by the URDF.
    poses: Vec<Pose>,
    tip: LinkIndex,
    tip_from_tcp: Isometry3<f64>,
    /// The tip and the links below it, which move with the tool if it is placed differently.
    with_tip: Vec<LinkIndex>,
    /// Accelerations of setpoints are not recorded, and no check that is evaluated again needs them.
    no_accelerations: Vec<f64>,
}

impl RecordedStates {
    /// All states, up to where the recording goes; `None` if the recording does not have the position of every joint at every one of them.
    pub(super) fn new(scalars: &Scalars, setup: &RunSetup, until: RecordedUntil) -> Option<Self> {
        let description = &setup.description;
        let robot = &description.robot;
        let values = |quantity: &str| -> Option<Vec<&Vec<(f64, f64)>>> {
            let path = |joint: &str| paths::joint_value(quantity, joint).to_string();
            robot.movable_joint_names().map(|joint| scalars.get(&path(joint))).collect()
        };
        let positions = values("position")?;
        let times: Vec<f64> = positions.first()?.iter().map(|&(time_s, _)| time_s).collect();
        let rows = |series: Vec<&Vec<(f64, f64)>>| -> Option<Vec<Vec<f64>>> {
            // A series that lacks a row would shift its later values to other times, so it counts as not recorded.
            let is_whole = |series: &&Vec<(f64, f64)>| {
                series.len() == times.len()
                    && series
                        .iter()
                        .zip(&times)
                        .all(|(&(at_s, _), time_s)| at_s.to_bits() == time_s.to_bits())
            };
            let row = |row: usize| series.iter().map(|series| series[row].1).collect();
            series.iter().all(is_whole).then(|| (0..times.len()).map(row).collect())
        };
        let truth = rows(positions)?;
        let other = |quantity: &str| values(quantity).and_then(rows);
        let [qd, effort, measured] = ["velocity", "effort", "measured_position"].map(other);
        let setpoint = other("reference_position").zip(other("reference_velocity"));
        let row = |rows: &Option<Vec<Vec<f64>>>, at: usize| rows.as_ref().map(|rows| rows[at].clone());
        let tcp = rows(
            COORDINATES
                .iter()
                .filter_map(|coordinate| scalars.get(&paths::tcp("twin", coordinate).to_string()))
                .collect(),
        );
        let instant = |(at, truth): (usize, Vec<f64>)| RecordedInstant {
            // The times of a log are as they were recorded, in any distance.
            time_s: match setup.recorded {
                Some(_) => times[at],
                None => setup.clock.time_s(steps(times[at], setup.clock.step_s)),
            },
            qd: row(&qd, at).unwrap_or_default(),
            effort: row(&effort, at).unwrap_or_default(),
            measured: row(&measured, at).unwrap_or_else(|| truth.clone()).into(),
            setpoint: setpoint.as_ref().map(|(q, qd)| (q[at].clone().into(), qd[at].clone())),
            root_from_tcp: tcp.as_ref().and_then(|rows| pose(&rows[at])),
            truth: truth.into(),
        };
        let instants: Vec<RecordedInstant> = truth.into_iter().enumerate().map(instant).collect();
        let mut states = Self {
            instants,
            at: 0,
            is_whole: until == RecordedUntil::End,
            tree: UrdfTree::new(robot),
            poses: vec![Pose::identity(); robot.links().len()],
            tip: description.tip,
            tip_from_tcp: description.tip_from_tcp.unwrap_or_else(Isometry3::identity),
            with_tip: robot.link_indices().filter(|&link| is_below(robot, link, description.tip)).collect(),
            no_accelerations: vec![0.0; robot.dof()],
        };
        (!states.instants.is_empty()).then(|| {
            states.place();
            states
        })
    }

    /// Places the links at this instant.
    fn place(&mut self) {
        let q = &self.instants[self.at].truth;
        if self.tree.root_from_links_into(q, &mut self.poses).is_err() {
            // As many positions as joints were read: this does not happen, and shows if it does.
            self.poses.fill(Pose::from(Isometry3::translation(f64::NAN, f64::NAN, f64::NAN)));
        }
    }

    /// The times of the instants.
    pub(super) fn times_s(&self) -> Vec<f64> {
        self.instants.iter().map(|instant| instant.time_s).collect()
    }
}

/// Whether a link is `above` or follows from it.
fn is_below(robot: &Robot, mut link: LinkIndex, above: LinkIndex) -> bool {
    loop {
        match robot.parent_joint(link) {
            _ if link == above => return true,
            Some(joint) => link = robot.joint(joint).parent,
            None => return false,
        }
    }
}

/// The pose with these coordinates, in the order of the recording.
fn pose(coordinates: &[f64]) -> Option<Isometry3<f64>> {
    let &[x, y, z, qw, qx, qy, qz] = coordinates else { return None };
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(qw, qx, qy, qz));
    Some(Isometry3::from_parts(Translation3::new(x, y, z), rotation))
}

/// Steps until a time.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast of floats saturates, and times are not negative"
)]
pub(super) fn steps(time_s: f64, step_s: f64) -> u64 {
    (time_s / step_s).round() as u64
}

impl JointStateSource for RecordedStates {
    fn joints(&self) -> JointSample<'_> {
        let instant = &self.instants[self.at];
        let truth = JointStateView { q: &instant.truth, qd: &instant.qd, effort: &instant.effort };
        let measured = JointStateView { q: &instant.measured, qd: &[], effort: &[] };
        let setpoint = |(q, qd)| SetpointView { q, qd, qdd: &self.no_accelerations, effort: &[] };
        let setpoint = instant.setpoint.as_ref().map(|(q, qd)| (q, &qd[..])).map(setpoint);
        JointSample { truth: Some(truth), measured, setpoint, recorded_effort: &[] }
    }

    // The recorded poses of links have the digits of the viewer, those of the URDF and of the TCP have all.
    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool {
        for (isometry, pose) in root_from_links.iter_mut().zip(&self.poses) {
            *isometry = pose.to_isometry();
        }
        if let Some(root_from_tcp) = self.instants[self.at].root_from_tcp {
            // How far the recorded TCP is from the pose by the URDF: identity, unless the tool of the twin is
            // placed differently.
            let recorded = root_from_tcp * self.tip_from_tcp.inverse();
            let moved = recorded * root_from_links[self.tip.get()].inverse();
            for link in &self.with_tip {
                root_from_links[link.get()] = moved * root_from_links[link.get()];
            }
        }
        true
    }

    fn start_s(&self) -> f64 {
        self.instants[0].time_s
    }

    fn advance(&mut self, _: f64) -> Result<Advance, SourceError> {
        if self.at + 1 == self.instants.len() {
            return Ok(Advance::End);
        }
        self.at += 1;
        self.place();
        Ok(Advance::At(self.instants[self.at].time_s))
    }

    fn is_last(&self) -> bool {
        self.is_whole && self.at + 1 == self.instants.len()
    }
}
