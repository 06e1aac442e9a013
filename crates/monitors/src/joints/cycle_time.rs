//! Cycle time: the time from which on the arm is at rest at the end of the last motion.

use congruent_description::JointKind;
use congruent_input::{Quantity, SiUnit};
use congruent_scenario::CycleTimeCheck;

use crate::{
    CheckContext, Names,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::Bound,
    watch::Watch,
};

/// Default distance of a joint from the end of the last motion, rad and m. Kind: engineering; a tenth of a degree is 1.7e-3
/// rad.
pub(crate) const AT_THE_END: f64 = 1e-3;
/// A joint below this speed is at rest, rad/s and m/s. Kind: engineering; in a second it moves by the distance above
/// that counts as reached.
const AT_REST: f64 = 1e-3;

pub(crate) struct CycleTimeMonitor {
    kinds: Vec<JointKind>,
    /// Of joints that slide, of joints that turn.
    tolerances: [f64; 2],
    /// Half a step: times of samples are rounded.
    slack_s: f64,
    time: Watch,
    /// Time since which all joints are at the end of the last motion.
    since_s: Option<f64>,
    samples: u64,
    /// Why there is no cycle time.
    why_none: Option<&'static str>,
    is_stopped: bool,
}

impl CycleTimeMonitor {
    pub(crate) fn new(check: &CycleTimeCheck, context: &CheckContext<'_>) -> Self {
        let [turning, sliding] = check.unit_keys().map(|keys| keys.value().unwrap_or(AT_THE_END));
        Self {
            kinds: context.joint_kinds(),
            tolerances: [sliding, turning],
            slack_s: context.clock.step_s / 2.0,
            time: Watch::new(
                Quantity::CycleTime,
                SiUnit::Second,
                Bound::AtMost,
                check.limit_s,
                context.dof(),
            ),
            since_s: None,
            samples: 0,
            why_none: None,
            is_stopped: false,
        }
    }

    /// The first joint that is not at the end of the last motion, or not at rest.
    fn unfinished(&self, sample: &Sample<'_>) -> Option<usize> {
        let (truth, setpoint) = (sample.joints.state(), sample.joints.setpoint?);
        let is_under_way = sample.time_s < sample.motions_s - self.slack_s;
        let is_there = |joint: usize| {
            let tolerance = self.tolerances[usize::from(self.kinds[joint].is_angular())];
            let speed = truth.qd.get(joint).copied().unwrap_or(0.0);
            (truth.q[joint] - setpoint.q[joint]).abs() <= tolerance && speed.abs() <= AT_REST
        };
        let joint = (0..truth.q.len()).find(|&joint| !is_there(joint));
        if is_under_way { joint.or(Some(0)) } else { joint }
    }
}

impl CycleTimeMonitor {
    /// The run is being stopped: an arm that has not reached the end of its motions by now never does.
    fn stop(&mut self, sample: &Sample<'_>) {
        if std::mem::replace(&mut self.is_stopped, true) {
            return;
        }
        match (self.since_s, self.time.worst_subject()) {
            (Some(since_s), _) => self.time.observe(since_s, self.kinds.len(), sample),
            (None, Some(unfinished)) => self.time.observe(f64::INFINITY, unfinished, sample),
            (None, None) => {}
        }
    }
}

impl Monitor for CycleTimeMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.why_none = match sample.joints.setpoint {
            None => Some("the source of joint states has no setpoint"),
            Some(_) if sample.motions_s <= 0.0 => Some("no cycle time: the scenario has no motions"),
            Some(_) => None,
        };
        if self.why_none.is_some() {
            return;
        }
        self.samples += 1;
        if sample.is_stopping {
            self.stop(sample);
            return;
        }
        let unfinished = self.unfinished(sample);
        match unfinished {
            None => self.since_s = Some(self.since_s.unwrap_or(sample.time_s)),
            Some(joint) => {
                self.since_s = None;
                // Violated from here on, whenever the joint arrives: a run may stop at the first violation.
                if sample.time_s > self.time.limit() {
                    self.time.observe(sample.time_s, joint, sample);
                }
            }
        }
        if sample.is_last {
            // Infinite if a joint is not at its goal at the end: worse than every limit.
            self.time.observe(
                self.since_s.unwrap_or(f64::INFINITY),
                unfinished.unwrap_or(self.kinds.len()),
                sample,
            );
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let measure = self.time.measure(&names.joints, |joint| names.joint_or_all(joint));
        let mut notes = Vec::new();
        if let Some(why) = self.why_none {
            notes.push(why.to_owned());
        } else if self.is_stopped && self.since_s.is_none() {
            notes.push("no cycle time: the run was stopped before the end of its motions".to_owned());
        } else if measure.worst.is_none() {
            notes.push("no cycle time: the run did not reach its end".to_owned());
        }
        Observed { samples: self.samples, measures: vec![measure], notes, ..Observed::default() }
    }

    fn has_failed(&self) -> bool {
        self.time.is_violated()
    }
}
