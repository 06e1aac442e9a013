//! The joint states of a recording, as a source for a run: the same checks see them again.

use congruent_description::{Robot, RobotQ};
use congruent_twin::{
    comparison::Scalars,
    source::{JointSample, JointStateSource, JointStateView, SetpointView, SourceError},
};
use nalgebra::Isometry3;

use crate::rrd::paths;

/// All joints at one recorded instant.
#[derive(Debug, Clone)]
struct Instant {
    step: u64,
    truth: RobotQ,
    /// Empty if it is not recorded; likewise the efforts.
    qd: Vec<f64>,
    effort: Vec<f64>,
    measured: RobotQ,
    setpoint: Option<(RobotQ, Vec<f64>)>,
}

/// The recorded instants, one after another.
#[derive(Debug)]
pub(super) struct RecordedStates {
    instants: Vec<Instant>,
    at: usize,
    /// Accelerations of setpoints are not recorded, and no check that is evaluated again needs them.
    no_accelerations: Vec<f64>,
}

impl RecordedStates {
    /// The states until `until_s`; `None` if the recording does not have the position of every joint at every one of them.
    pub(super) fn new(scalars: &Scalars, robot: &Robot, step_s: f64, until_s: f64) -> Option<Self> {
        let values = |quantity: &str| -> Option<Vec<&Vec<(f64, f64)>>> {
            let path = |joint: &str| paths::joint_value(quantity, joint).to_string();
            robot.movable_joint_names().map(|joint| scalars.get(&path(joint))).collect()
        };
        let positions = values("position")?;
        let times: Vec<f64> = positions.first()?.iter().map(|&(time_s, _)| time_s).collect();
        let rows = |series: Vec<&Vec<(f64, f64)>>| -> Option<Vec<Vec<f64>>> {
            let is_whole = |series: &&Vec<(f64, f64)>| {
                series.len() == times.len()
                    && series.iter().zip(&times).all(|(&(at_s, _), &time_s)| at_s <= time_s && at_s >= time_s)
            };
            let row = |row: usize| series.iter().map(|series| series[row].1).collect();
            series.iter().all(is_whole).then(|| (0..times.len()).map(row).collect())
        };
        let truth = rows(positions)?;
        let other = |quantity: &str| values(quantity).and_then(rows);
        let [qd, effort, measured] = ["velocity", "effort", "measured_position"].map(other);
        let setpoint = other("reference_position").zip(other("reference_velocity"));
        let row = |rows: &Option<Vec<Vec<f64>>>, at: usize| rows.as_ref().map(|rows| rows[at].clone());
        let instant = |(at, truth): (usize, Vec<f64>)| Instant {
            step: steps(times[at], step_s),
            qd: row(&qd, at).unwrap_or_default(),
            effort: row(&effort, at).unwrap_or_default(),
            measured: row(&measured, at).unwrap_or_else(|| truth.clone()).into(),
            setpoint: setpoint.as_ref().map(|(q, qd)| (q[at].clone().into(), qd[at].clone())),
            truth: truth.into(),
        };
        let count = times.partition_point(|&time_s| time_s <= until_s);
        let instants: Vec<Instant> = truth.into_iter().enumerate().take(count).map(instant).collect();
        let no_accelerations = vec![0.0; robot.dof()];
        (!instants.is_empty()).then_some(Self { instants, at: 0, no_accelerations })
    }

    /// The steps of the instants.
    pub(super) fn steps(&self) -> Vec<u64> {
        self.instants.iter().map(|instant| instant.step).collect()
    }
}

/// Steps until a time.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast of floats saturates, and times are not negative"
)]
fn steps(time_s: f64, step_s: f64) -> u64 {
    (time_s / step_s).round() as u64
}

impl JointStateSource for RecordedStates {
    fn joints(&self) -> JointSample<'_> {
        let instant = &self.instants[self.at];
        let truth = JointStateView { q: &instant.truth, qd: &instant.qd, effort: &instant.effort };
        let measured = JointStateView { q: &instant.measured, qd: &[], effort: &[] };
        let setpoint = |(q, qd)| SetpointView { q, qd, qdd: &self.no_accelerations };
        let setpoint = instant.setpoint.as_ref().map(|(q, qd)| (q, &qd[..])).map(setpoint);
        JointSample { truth, measured, setpoint }
    }

    fn step_count(&self) -> u64 {
        self.instants[self.at].step
    }

    // Recorded poses have the digits of the viewer; the URDF has all.
    fn root_from_links_into(&self, _: &mut [Isometry3<f64>]) -> bool {
        false
    }

    fn advance(&mut self, _: f64) -> Result<(), SourceError> {
        self.at = (self.at + 1).min(self.instants.len() - 1);
        Ok(())
    }
}
