//! The twin against its setpoint: the error during the run and at its end, the part of the commanded travel that joints make,
//! and, while the setpoint is at rest, settling time and overshoot of the joints.

use congruent_description::{JointKind, LinkIndex, Robot, RobotDescription, RobotQ};
use congruent_input::{Diagnostic, Quantity, SiUnit};
use congruent_kinematics::UrdfTree;
use congruent_scenario::{FilePlace, TrackingCheck};
use nalgebra::{Isometry3, Vector3};

use super::travel::TravelShare;
use crate::{
    CheckContext, Names, codes,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::{Bound, InstantValue},
    watch::Watch,
};

/// Errors of joints that turn, of joints that slide, and of the TCP; `None` where the check has no limit.
struct Errors {
    turning: Option<Watch>,
    sliding: Option<Watch>,
    tcp: Option<Watch>,
}

pub(crate) struct TrackingMonitor {
    kinds: Vec<JointKind>,
    tcp: TcpOfSetpoint,
    path: Errors,
    goal: Errors,
    overshoot: Errors,
    settling: Option<Watch>,
    travel: Option<TravelShare>,
    /// Whether the run ended before the setpoint came to rest after a motion.
    was_never_at_rest: bool,
    rest_detector: RestDetector,
    samples: u64,
    is_commanded: bool,
}

/// The setpoint between its motions.
struct RestDetector {
    /// The setpoint in the previous sample.
    q: RobotQ,
    has_begun: bool,
    /// Time since which the setpoint is at rest; `None` while it moves.
    since_s: Option<f64>,
    /// Direction of the last motion of each joint: 1, -1, or 0 for a joint that has not moved since the previous rest.
    direction: Vec<f64>,
}

/// The TCP at the setpoint, by forward kinematics of the robot that controllers know.
struct TcpOfSetpoint {
    tree: UrdfTree,
    tip: LinkIndex,
    known_tip_from_tcp: Isometry3<f64>,
    tip_from_tcp: Isometry3<f64>,
}

/// At least one limit, of joints that the robot has; settling needs a band.
pub(crate) fn examine(check: &TrackingCheck, place: FilePlace<'_>, robot: &Robot) -> Result<(), Diagnostic> {
    let limits = check.unit_keys();
    let refused = |message: String, help: &str| {
        Diagnostic::error(codes::scenario::TRACKING, message).with_help(help.to_owned())
    };
    if limits.iter().all(|keys| keys.value().is_none())
        && (check.travel_share.is_none() || check.settling_s.is_some())
    {
        let help = "give for example path_deg, path_tcp_mm, goal_deg, travel_share or overshoot_deg";
        let what = if check.settling_s.is_some() {
            "`settling_s` needs a limit `goal_*`: the band in which the joints must stay"
        } else {
            "the check `tracking` has no limit"
        };
        return Err(place.mark(refused(what.to_owned(), help)));
    }
    let [_, _, _, goal_rad, goal_m, ..] = &limits;
    if check.settling_s.is_some() && goal_rad.value().or(goal_m.value()).is_none() {
        let message = "`settling_s` needs a limit `goal_*` for joints: the band in which they must stay";
        let error =
            refused(message.to_owned(), "give goal_deg or goal_rad, for sliding joints goal_m or goal_mm");
        return Err(place.key("settling_s").mark(error));
    }
    let joints = || robot.movable_joints().iter().map(|&joint| robot.joint(joint).kind.is_angular());
    let (turning, sliding) = (joints().any(|turns| turns), joints().any(|turns| !turns));
    let without = limits.iter().find_map(|keys| {
        let key = keys.keys.into_iter().zip(keys.written).find_map(|(key, value)| value.map(|_| key))?;
        let is_angle = keys.keys[0].ends_with("_rad");
        let has_none = !key.contains("tcp") && if is_angle { !turning } else { !sliding };
        has_none.then_some((key, if is_angle { "turns" } else { "slides" }))
    });
    match without {
        None => Ok(()),
        Some((key, moves)) => {
            let message = format!("`{key}` has no effect: no joint of \"{}\" {moves}", robot.name());
            Err(place.key(key).mark(refused(message, "remove the key")))
        }
    }
}

impl TrackingMonitor {
    pub(crate) fn new(check: &TrackingCheck, context: &CheckContext<'_>) -> Self {
        let (description, dof) = (context.description, context.dof());
        let watch = |quantity, unit, limit| Watch::new(quantity, unit, Bound::AtMost, limit, dof);
        let limits = check.unit_keys().map(|keys| keys.value());
        let tcp = |of: &RobotDescription| of.tip_from_tcp.unwrap_or_else(Isometry3::identity);
        let [path_rad, path_m, path_tcp_m, goal_rad, goal_m, goal_tcp_m, overshoot_rad, overshoot_m] = limits;
        Self {
            kinds: context.joint_kinds(),
            tcp: TcpOfSetpoint {
                tree: UrdfTree::new(&context.known.robot),
                tip: description.tip,
                known_tip_from_tcp: tcp(context.known),
                tip_from_tcp: tcp(description),
            },
            path: Errors {
                turning: path_rad.map(|limit| watch(Quantity::PathErrorOfAngle, SiUnit::Radian, limit)),
                sliding: path_m.map(|limit| watch(Quantity::PathErrorOfShift, SiUnit::Metre, limit)),
                tcp: path_tcp_m.map(|limit| watch(Quantity::PathErrorOfTcp, SiUnit::Metre, limit)),
            },
            goal: Errors {
                turning: goal_rad.map(|limit| watch(Quantity::GoalErrorOfAngle, SiUnit::Radian, limit)),
                sliding: goal_m.map(|limit| watch(Quantity::GoalErrorOfShift, SiUnit::Metre, limit)),
                tcp: goal_tcp_m.map(|limit| watch(Quantity::GoalErrorOfTcp, SiUnit::Metre, limit)),
            },
            overshoot: Errors {
                turning: overshoot_rad.map(|limit| watch(Quantity::OvershootOfAngle, SiUnit::Radian, limit)),
                sliding: overshoot_m.map(|limit| watch(Quantity::OvershootOfShift, SiUnit::Metre, limit)),
                tcp: None,
            },
            settling: check.settling_s.map(|limit| watch(Quantity::SettlingTime, SiUnit::Second, limit)),
            travel: check.travel_share.map(|limit| TravelShare::new(limit, dof)),
            was_never_at_rest: false,
            rest_detector: RestDetector {
                q: RobotQ::zeros(dof),
                has_begun: false,
                since_s: None,
                direction: vec![0.0; dof],
            },
            samples: 0,
            is_commanded: true,
        }
    }

    fn watches(&self) -> impl Iterator<Item = &Watch> {
        let groups = [&self.path, &self.goal, &self.overshoot];
        let of_groups = groups.into_iter().flat_map(|group| [&group.turning, &group.sliding, &group.tcp]);
        of_groups.chain([&self.settling]).flatten().chain(self.travel.as_ref().map(|travel| &travel.watch))
    }

    /// While the setpoint is at rest: overshoot of the joints, and the time until they stay in their bands.
    fn observe_rest(&mut self, since_s: f64, q: &RobotQ, sample: &Sample<'_>) {
        let bands = [&self.goal.sliding, &self.goal.turning].map(|goal| goal.as_ref().map(Watch::limit));
        let mut unsettled = None;
        for (joint, (reference, true_q)) in q.iter().zip(sample.joints.state().q).enumerate() {
            let kind = self.kinds[joint];
            let beyond = (true_q - reference) * self.rest_detector.direction[joint];
            if let Some(watch) =
                self.overshoot.of(kind).filter(|_| self.rest_detector.direction[joint] != 0.0)
            {
                // `max` drops a NaN; the term `0 * beyond` brings it back.
                watch.observe(beyond.max(0.0) + 0.0 * beyond, joint, sample);
            }
            let band = bands[usize::from(kind.is_angular())];
            // NaN fails every comparison, so that it would count as settled.
            let error = (true_q - reference).abs();
            if band.is_some_and(|band| error.is_nan() || error > band) {
                unsettled = Some(joint);
            }
        }
        // Before the first motion there is no settling: the initial sag of an arm is not a response to a motion.
        let has_moved = self.rest_detector.direction.iter().any(|&direction| direction != 0.0);
        if let Some(watch) = self.settling.as_mut().filter(|_| has_moved) {
            let (joint, time_s) = match unsettled {
                None => (q.len(), 0.0),
                Some(joint) if sample.is_last => (joint, f64::INFINITY),
                Some(joint) => (joint, sample.time_s - since_s),
            };
            watch.observe(time_s, joint, sample);
        }
    }
}

impl Errors {
    fn of(&mut self, kind: JointKind) -> Option<&mut Watch> {
        if kind.is_angular() { self.turning.as_mut() } else { self.sliding.as_mut() }
    }

    fn observe_joints(&mut self, kinds: &[JointKind], q: &RobotQ, sample: &Sample<'_>) {
        for (joint, (reference, true_q)) in q.iter().zip(sample.joints.state().q).enumerate() {
            if let Some(watch) = self.of(kinds[joint]) {
                watch.observe((true_q - reference).abs(), joint, sample);
            }
        }
    }

    fn observe_tcp(&mut self, error_m: f64, tip: LinkIndex, sample: &Sample<'_>) {
        if let Some(watch) = &mut self.tcp {
            watch.observe(error_m, tip.get(), sample);
        }
    }
}

impl TcpOfSetpoint {
    /// Distance of the twin's TCP from the setpoint's.
    fn error_m(&self, q: &RobotQ, sample: &Sample<'_>) -> f64 {
        let Ok(root_from_tip) = self.tree.root_from_link(q, self.tip) else { return f64::NAN };
        let tcp_in_tip: Vector3<f64> = self.known_tip_from_tcp.translation.vector;
        let wanted = root_from_tip.rotation * tcp_in_tip + root_from_tip.translation;
        let found = sample.twin[self.tip.get()] * self.tip_from_tcp;
        (found.translation.vector - wanted).norm()
    }
}

impl RestDetector {
    /// Takes the setpoint of a sample; returns the time since which it is at rest.
    fn take(&mut self, q: &RobotQ, time_s: f64) -> Option<f64> {
        let is_still = !self.has_begun || self.q == *q;
        if !is_still {
            // A new motion: a joint that it does not move must not keep the direction of the motion before.
            if self.since_s.is_some() {
                self.direction.fill(0.0);
            }
            for (direction, (now, before)) in self.direction.iter_mut().zip(q.iter().zip(&self.q)) {
                let step = now - before;
                if step.abs() > 0.0 {
                    *direction = step.signum();
                }
            }
        }
        self.since_s = if is_still { Some(self.since_s.unwrap_or(time_s)) } else { None };
        self.has_begun = true;
        self.q.copy_from_slice(q);
        self.since_s
    }
}

impl Monitor for TrackingMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        let Some(setpoint) = sample.joints.setpoint else {
            self.is_commanded = false;
            return;
        };
        self.samples += 1;
        let needs_tcp = self.path.tcp.is_some() || self.goal.tcp.is_some();
        let tcp_error_m = if needs_tcp { self.tcp.error_m(setpoint.q, sample) } else { 0.0 };
        self.path.observe_joints(&self.kinds, setpoint.q, sample);
        self.path.observe_tcp(tcp_error_m, self.tcp.tip, sample);
        if let Some(travel) = &mut self.travel {
            travel.observe(setpoint.q, sample);
        }
        let since_s = self.rest_detector.take(setpoint.q, sample.time_s);
        if let Some(since_s) = since_s {
            self.observe_rest(since_s, setpoint.q, sample);
        }
        if sample.is_last {
            self.end(sample);
        }
    }

    fn end(&mut self, sample: &Sample<'_>) {
        let Some(setpoint) = sample.joints.setpoint else { return };
        // A settling time that is required but was never measured is a failure, not a skipped check.
        if let Some(watch) = self.settling.as_mut().filter(|watch| watch.worst().is_none()) {
            self.was_never_at_rest = true;
            watch.observe(f64::INFINITY, setpoint.q.len(), sample);
        }
        self.goal.observe_joints(&self.kinds, setpoint.q, sample);
        let tcp_error_m = if self.goal.tcp.is_some() { self.tcp.error_m(setpoint.q, sample) } else { 0.0 };
        self.goal.observe_tcp(tcp_error_m, self.tcp.tip, sample);
    }

    fn finish(&self, names: &Names) -> Observed {
        let name = |watch: &Watch| {
            let of_link = watch.quantity().is_of_tcp();
            move |subject: usize| {
                if of_link { names.links[subject].clone() } else { names.joint_or_all(subject) }
            }
        };
        let measures = self.watches().map(|watch| watch.measure(&names.joints, name(watch))).collect();
        let mut notes = Vec::new();
        if !self.is_commanded {
            notes.push("the source of joint states has no setpoint".to_owned());
        } else if self.was_never_at_rest {
            notes.push(
                "no settling time: the setpoint was never at rest after a motion. Give a longer `duration_s`"
                    .to_owned(),
            );
        }
        Observed { samples: self.samples, measures, notes, ..Observed::default() }
    }

    fn values(&self, time_s: f64, take: &mut dyn FnMut(InstantValue)) {
        let errors = [&self.path, &self.overshoot].into_iter();
        let watches = errors.flat_map(|errors| [&errors.turning, &errors.sliding, &errors.tcp]);
        watches.flatten().filter_map(|watch| watch.at(time_s)).for_each(take);
    }

    fn has_failed(&self) -> bool {
        self.watches().any(Watch::is_violated)
    }
}
