//! The path of an arm to rest, after the first violation of a check that stops the run.

use congruent_description::{JointValues, Robot, RobotQ};
use congruent_input::display::{length, quantity};
use congruent_monitors::{
    JointSample,
    verdict::{CheckResult, MotionToRest, RunStop, StopAcceleration, StopLimit},
};
use nalgebra::Vector3;

/// An arm is at rest if every joint is slower, rad/s and m/s. Kind: engineering; in a second it moves by 0.06 deg.
const AT_REST: f64 = 1e-3;
/// It is so for this long: an arm that swings is as slow where it turns. Kind: engineering; a joint that passes through
/// a turning point with 0.04 rad/s^2 or more is slow for a shorter time.
const STAYS_S: f64 = 0.05;
/// The run waits no longer for the arm to come to rest. Kind: engineering; stops of arms take tenths of a second.
const LONGEST_S: f64 = 5.0;

/// A stop in progress, and where it has led so far.
#[derive(Debug, Clone)]
pub(crate) struct Stopping {
    check: usize,
    step: u64,
    time_s: f64,
    from: RobotQ,
    /// Whether the source can be brought to rest.
    pub(crate) can_stop: bool,
    /// Since when every joint is slow.
    slow_since_s: Option<f64>,
    is_at_rest: bool,
    /// Until rest, or until now.
    duration_s: f64,
    q: RobotQ,
    tcp_in_root: Vector3<f64>,
    tcp_path_m: f64,
}

impl Stopping {
    /// By the check of this number, at this step and state.
    pub(crate) fn new(check: usize, step: u64, time_s: f64, q: RobotQ, tcp_in_root: Vector3<f64>) -> Self {
        Self {
            check,
            step,
            time_s,
            from: q.clone(),
            can_stop: false,
            slow_since_s: None,
            is_at_rest: false,
            duration_s: 0.0,
            q,
            tcp_in_root,
            tcp_path_m: 0.0,
        }
    }

    /// The number of the check that stops the run.
    pub(crate) fn check(&self) -> usize {
        self.check
    }

    /// Goes on to an instant; returns whether the run ends with it.
    pub(crate) fn ends(&mut self, time_s: f64, joints: &JointSample<'_>, tcp_in_root: Vector3<f64>) -> bool {
        self.q.copy_from_slice(joints.state().q);
        self.tcp_path_m += (tcp_in_root - self.tcp_in_root).norm();
        self.tcp_in_root = tcp_in_root;
        let slow = |qd: &[f64]| qd.iter().all(|qd| qd.abs() <= AT_REST);
        let is_commanded_to_rest =
            joints.setpoint.is_none_or(|setpoint| setpoint.qd.iter().all(|&qd| qd == 0.0));
        self.slow_since_s =
            // Without the condition on the setpoint, an arm that has not begun to brake at a turning point would
            // count.
            (is_commanded_to_rest && slow(joints.state().qd)).then(|| self.slow_since_s.unwrap_or(time_s));
        // An arm that is placed, not driven, is at rest as soon as its setpoint is.
        let is_still = joints.state().qd.iter().all(|&qd| qd == 0.0);
        let rest_s = self.slow_since_s.filter(|since_s| is_still || time_s - since_s >= STAYS_S);
        self.is_at_rest = rest_s.is_some();
        // To the beginning of the rest, without the time that was waited to be sure.
        self.duration_s = rest_s.unwrap_or(time_s) - self.time_s;
        !self.can_stop || self.is_at_rest || self.duration_s >= LONGEST_S
    }

    /// In words, as a remark on the check.
    pub(crate) fn note(
        &self,
        steps: Option<u64>,
        robot: &Robot,
        accelerations: &[StopAcceleration],
    ) -> String {
        let (time, step) = (quantity(self.time_s, "s"), self.step);
        let of_all = steps.map_or_else(String::new, |steps| format!(" of {steps}"));
        let note = format!("stopped the run at {time}, after {step}{of_all} steps");
        if !self.can_stop {
            return note;
        }
        let (duration, path) = (quantity(self.duration_s, "s"), length(self.tcp_path_m));
        let rest = if self.is_at_rest { "at rest" } else { "not at rest" };
        let declared = accelerations.iter().filter(|used| used.source == StopLimit::Declared).count();
        let braked = match declared {
            0 => "none declared, velocity limits / 0.25 s".to_owned(),
            _ if declared == accelerations.len() => "as declared".to_owned(),
            _ => format!("as declared for {declared} of {} joints", accelerations.len()),
        };
        let ends = ends_of_range(robot, accelerations);
        format!(
            "{note}; the arm is {rest} {duration} later, after {path} of TCP path (accelerations: {braked}{ends})"
        )
    }

    /// The stop for the report of the run.
    pub(crate) fn report(
        &self,
        result: &CheckResult,
        joints: &[String],
        accelerations: Vec<StopAcceleration>,
    ) -> RunStop {
        let gone: Vec<f64> = self.q.iter().zip(&self.from).map(|(to, from)| to - from).collect();
        RunStop {
            check: result.check,
            line: result.line,
            step: self.step,
            time_s: self.time_s,
            q: JointValues::new(joints, &self.from),
            rest: self.can_stop.then(|| MotionToRest {
                is_at_rest: self.is_at_rest,
                duration_s: self.duration_s,
                joints: JointValues::new(joints, &gone),
                tcp_path_m: self.tcp_path_m,
                accelerations,
            }),
        }
    }
}

/// Joints that came to the end of their range on the path to rest, in words.
fn ends_of_range(robot: &Robot, accelerations: &[StopAcceleration]) -> String {
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let lost =
        joints.zip(accelerations).filter_map(|(joint, used)| Some((joint, used.lost_at_end_of_range?)));
    let words = lost.map(|(joint, speed)| {
        let speed = quantity(speed, &format!("{}/s", joint.kind.unit()));
        format!(
            ", but {} reached the end of its range at {speed} and its setpoint stopped at once",
            joint.name
        )
    });
    words.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use congruent_monitors::JointStateView;

    /// When the stop of one joint ends that has this speed.
    fn stopped(speed: impl Fn(f64) -> f64) -> (Stopping, f64) {
        let q = RobotQ::zeros(1);
        let mut stopping = Stopping::new(0, 0, 0.0, q.clone(), Vector3::zeros());
        stopping.can_stop = true;
        let mut times_s = (1..=10_000).map(|step| f64::from(step) * 1e-3);
        let end_s = times_s.find(|&time_s| {
            let state = JointStateView { q: &q, qd: &[speed(time_s)], effort: &[] };
            let joints = JointSample::measured(state);
            stopping.ends(time_s, &joints, Vector3::zeros())
        });
        (stopping, end_s.unwrap())
    }

    #[test]
    fn an_arm_that_turns_round_is_not_at_rest() {
        let (swinging, end_s) = stopped(|time_s| 0.5 * (3.0 * time_s).cos());
        assert!(!swinging.is_at_rest && (end_s - LONGEST_S).abs() < 1e-9, "{swinging:?}");
        let (decaying, end_s) = stopped(|time_s| 0.5 * (-10.0 * time_s).exp());
        // 0.5 exp(-10 t) is 1e-3 at 0.6215 s.
        assert!(decaying.is_at_rest && (decaying.duration_s - 0.622).abs() < 1e-9, "{decaying:?}");
        assert!((end_s - 0.672).abs() < 1.5e-3, "{end_s}");
        let (placed, end_s) = stopped(|time_s| (0.1 - time_s).max(0.0));
        assert!(placed.is_at_rest && (end_s - 0.1).abs() < 1.5e-3, "{end_s}");
    }
}
