//! Joints against the limits that the description states: position, velocity and effort.
//!
//! A joint that rests on its stop, because it was commanded there or sags onto it, is a little beyond its limit: a stop
//! yields. A joint that is driven beyond differs: its setpoint is outside, or it continues to move outwards.

use congruent_description::{Joint, JointKind, RobotDescription, SPEED_MARGIN};
use congruent_input::{Diagnostic, Quantity, SiUnit, display::quantity};
use congruent_scenario::{FilePlace, LimitsCheck};

use crate::{
    CheckContext, Names, StepForces, codes,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::{Bound, InstantValue},
    watch::Watch,
};

/// Default tolerance beyond a position limit, rad and m. Kind: digits of files. A limit that is written with six decimals,
/// 1.570796 for a quarter turn, has an error of up to 5e-7, and steps that add up to a limit of 1e-9 at most; the resolution of
/// an encoder is coarser.
pub(crate) const AT_THE_LIMIT: f64 = 1e-6;
/// Largest depth at which a joint rests on its stop, rad and m. Kind: physics; the stop acts from the step after the touch on,
/// in which a joint at 1 rad/s moves by 1e-3 rad with steps of 1 ms.
const ON_THE_STOP: f64 = 1e-3;
/// Efforts are clipped at their limit; rounding may exceed it by this share. No unit.
const ROUNDING: f64 = 1e-9;

/// Largest share of the velocity limit if the scenario does not say: motions are planned up to the limit, and the controller that
/// follows them may drive a joint faster by what the actuators allow.
pub(crate) const LARGEST_VELOCITY_SHARE: f64 = 1.0 + SPEED_MARGIN;
/// Largest share of the effort limit, at which efforts are clipped, if the scenario does not say.
pub(crate) const LARGEST_EFFORT_SHARE: f64 = 1.0;

/// The limits of one coordinate, and the events at its stop.
struct CoordinateLimits {
    coordinate: usize,
    kind: JointKind,
    range: Option<(f64, f64)>,
    velocity: Option<f64>,
    effort: Option<f64>,
    /// How far it was beyond its limit in the sample before.
    beyond_before: f64,
    rest: Option<RestOnStop>,
    drive: Option<DrivenBeyond>,
    /// Whether its position was beyond the limit, which is then what fails.
    was_beyond: bool,
    /// Samples in which its effort was at the limit.
    saturated: u64,
}

/// A joint that has come to rest on its stop.
struct RestOnStop {
    time_s: f64,
    /// How far its setpoint was inside the range.
    setpoint_inside: f64,
}

/// A joint that was driven beyond its limit.
struct DrivenBeyond {
    time_s: f64,
    /// How far its setpoint was outside at most; `None` if it was inside or is not known.
    setpoint_outside: Option<f64>,
    is_commanded: bool,
}

/// Values of joints that turn, and of joints that slide.
struct ByKind {
    angular: Watch,
    linear: Watch,
}

pub(crate) struct LimitsMonitor {
    coordinates: Vec<CoordinateLimits>,
    /// Required margins to the limit, of turning and of sliding joints, rad and m.
    margins: [f64; 2],
    /// Tolerances beyond the limit, of turning and of sliding joints, rad and m.
    tolerances: [f64; 2],
    beyond: ByKind,
    on_stop: ByKind,
    /// Setpoints of joints that their stop holds.
    held_back: ByKind,
    velocity: Watch,
    effort: Watch,
    samples: u64,
}

/// Whether the shares are shares.
pub(crate) fn examine(check: &LimitsCheck, place: FilePlace<'_>) -> Result<(), Diagnostic> {
    let shares = [
        ("velocity_share", check.velocity_share, LARGEST_VELOCITY_SHARE),
        ("effort_share", check.effort_share, LARGEST_EFFORT_SHARE),
    ];
    match shares.into_iter().find(|&(_, share, largest)| share.is_some_and(|share| share > largest)) {
        None => Ok(()),
        Some((key, share, largest)) => {
            let message = format!("`{key}` = {}, limit <= {largest}", share.unwrap_or_default());
            let error = Diagnostic::error(codes::scenario::SHARE, message);
            let help = format!(
                "a larger share would allow more than the limit of the joint; the default is {largest}"
            );
            Err(place.key(key).mark(error.with_help(help)))
        }
    }
}

impl LimitsMonitor {
    pub(crate) fn new(check: &LimitsCheck, context: &CheckContext<'_>) -> Self {
        let [tolerance_rad, margin_rad, tolerance_m, margin_m] = check.unit_keys().map(|keys| keys.value());
        let watch = |quantity, unit, limit| Watch::new(quantity, unit, Bound::AtMost, limit, context.dof());
        let share = |share: Option<f64>, largest: f64| share.unwrap_or(largest) + ROUNDING;
        let margins = [margin_rad, margin_m].map(|margin| margin.unwrap_or(0.0));
        let tolerances = [tolerance_rad, tolerance_m].map(|tolerance| tolerance.unwrap_or(AT_THE_LIMIT));
        // With a margin, a value that holds is negative: inside the range.
        let [angle, shift] = [0, 1].map(|kind| tolerances[kind] - margins[kind]);
        Self {
            coordinates: coordinates(context.description, context.held),
            margins,
            tolerances,
            beyond: ByKind {
                angular: watch(Quantity::AngleBeyondLimit, SiUnit::Radian, angle),
                linear: watch(Quantity::ShiftBeyondLimit, SiUnit::Metre, shift),
            },
            on_stop: ByKind {
                angular: watch(Quantity::AngleIntoStop, SiUnit::Radian, ON_THE_STOP),
                linear: watch(Quantity::ShiftIntoStop, SiUnit::Metre, ON_THE_STOP),
            },
            held_back: ByKind {
                angular: watch(
                    Quantity::AngleOfSetpointBeyondLimit,
                    SiUnit::Radian,
                    tolerances[0].max(ON_THE_STOP),
                ),
                linear: watch(
                    Quantity::ShiftOfSetpointBeyondLimit,
                    SiUnit::Metre,
                    tolerances[1].max(ON_THE_STOP),
                ),
            },
            velocity: watch(
                Quantity::ShareOfVelocityLimit,
                SiUnit::Ratio,
                share(check.velocity_share, LARGEST_VELOCITY_SHARE),
            ),
            effort: watch(
                Quantity::ShareOfEffortLimit,
                SiUnit::Ratio,
                share(check.effort_share, LARGEST_EFFORT_SHARE),
            ),
            samples: 0,
        }
    }

    fn observe_position(&mut self, at: usize, sample: &Sample<'_>) {
        let limits = &mut self.coordinates[at];
        let Some((lower, upper)) = limits.range else { return };
        let outside = |q: f64| (lower - q).max(q - upper);
        let (coordinate, kind) = (limits.coordinate, limits.kind);
        let q = sample.joints.state().q[coordinate];
        // `max` drops a NaN: a position that is not a number would count as inside the range.
        let beyond = if q.is_nan() { q } else { outside(q) };
        let [margin, tolerance] =
            [self.margins, self.tolerances].map(|of| of[usize::from(!kind.is_angular())]);
        let setpoint = sample.joints.setpoint.map(|setpoint| outside(setpoint.q[coordinate]));
        // A joint that rests on its stop is held by it. One that goes deeper at every sample is pushed, whatever its
        // setpoint.
        let grows = limits.beyond_before > 0.0 && beyond > limits.beyond_before;
        let is_commanded_inside = setpoint.is_some_and(|outside| outside <= tolerance.min(AT_THE_LIMIT));
        let rests = margin == 0.0 && is_commanded_inside && !grows && beyond <= ON_THE_STOP;
        // A joint that only lags behind its setpoint still moves.
        let is_at_rest = (beyond - limits.beyond_before).abs() <= AT_THE_LIMIT;
        limits.beyond_before = beyond;
        if rests && beyond > tolerance {
            limits.rest.get_or_insert(RestOnStop {
                time_s: sample.time_s,
                setpoint_inside: -setpoint.unwrap_or_default(),
            });
            self.on_stop.of(kind).observe(beyond, coordinate, sample);
            return;
        }
        let outside = setpoint.filter(|_| !is_commanded_inside);
        // A stop that the joint has reached gently holds it exactly at its limit, however far its setpoint goes on: the
        // position alone would make the push look like rest.
        limits.was_beyond |= beyond > tolerance;
        let held_back = outside.filter(|&outside| {
            !limits.was_beyond
                && is_at_rest
                && beyond.abs() <= ON_THE_STOP
                && outside > tolerance.max(ON_THE_STOP)
        });
        if beyond > tolerance || held_back.is_some() {
            limits.drive.get_or_insert(DrivenBeyond {
                time_s: sample.time_s,
                setpoint_outside: outside,
                is_commanded: setpoint.is_some(),
            });
        }
        if let (Some(drive), Some(now)) = (&mut limits.drive, outside) {
            drive.setpoint_outside = drive.setpoint_outside.map(|before| before.max(now));
        }
        if let Some(outside) = held_back {
            self.held_back.of(kind).observe(outside, coordinate, sample);
        }
        self.beyond.of(kind).observe(beyond, coordinate, sample);
    }

    fn observe_shares(&mut self, at: usize, sample: &Sample<'_>) {
        let limits = &mut self.coordinates[at];
        let (truth, coordinate) = (sample.joints.state(), limits.coordinate);
        // A source without the truth has NaN where it measured nothing.
        let is_known = |value: &&f64| sample.joints.truth.is_some() || !value.is_nan();
        if let (Some(limit), Some(qd)) = (limits.velocity, truth.qd.get(coordinate).filter(is_known)) {
            self.velocity.observe(qd.abs() / limit, coordinate, sample);
        }
        let effort = truth.effort.get(coordinate).filter(is_known);
        if let (Some(limit), Some(effort)) = (limits.effort, effort) {
            let share = effort.abs() / limit;
            // A robot that was placed, or has taken no step, has exerted no effort: a share of 0 would make the check pass
            // without a measured value.
            if share == 0.0 && (sample.forces == StepForces::Unknown || sample.time_s <= 0.0) {
                return;
            }
            limits.saturated += u64::from(share >= 1.0 - ROUNDING);
            self.effort.observe(share, coordinate, sample);
        }
    }

    fn notes(&self, names: &Names) -> Vec<String> {
        let mut notes: Vec<String> =
            self.coordinates.iter().flat_map(|limits| limits.notes(&names.joints)).collect();
        if self.coordinates.iter().all(|limits| limits.range.is_none()) {
            notes.push("no joint has position limits".to_owned());
        }
        let unstated = |what: &str, is_stated: &dyn Fn(&CoordinateLimits) -> bool| {
            let without = self.coordinates.iter().filter(|limits| !is_stated(limits));
            let without: Vec<&str> = without.map(|limits| names.joints[limits.coordinate].as_str()).collect();
            let note = format!("not checked (no {what} limit in the description): {}", without.join(", "));
            (!without.is_empty()).then_some(note)
        };
        notes.extend(unstated("velocity", &|limits| limits.velocity.is_some()));
        notes.extend(unstated("effort", &|limits| limits.effort.is_some()));
        notes
    }

    fn watches(&self) -> impl Iterator<Item = &Watch> {
        let (beyond, on_stop, held_back) = (&self.beyond, &self.on_stop, &self.held_back);
        let [turning, sliding] = [&held_back.angular, &held_back.linear];
        let positions =
            [&beyond.angular, &beyond.linear, &on_stop.angular, &on_stop.linear, turning, sliding];
        positions.into_iter().chain([&self.velocity, &self.effort])
    }
}

impl ByKind {
    fn of(&mut self, kind: JointKind) -> &mut Watch {
        if kind.is_angular() { &mut self.angular } else { &mut self.linear }
    }
}

impl CoordinateLimits {
    /// Remarks on the joint at its stop and at its effort limit.
    fn notes(&self, joints: &[String]) -> Vec<String> {
        let name = &joints[self.coordinate];
        let shown = |value: f64| quantity(value, if self.kind.is_angular() { "rad" } else { "m" });
        // A joint that was driven beyond its limit has failed by that: where else it rested explains nothing.
        let rest = self.rest.as_ref().filter(|_| self.drive.is_none()).map(
            |RestOnStop { time_s, setpoint_inside }| {
                let why = if *setpoint_inside <= AT_THE_LIMIT {
                    "its setpoint is at the limit".to_owned()
                } else {
                    format!("it sags by {}, from its setpoint inside the range", shown(*setpoint_inside))
                };
                format!("{name} rests on its stop from {} on: {why}", quantity(*time_s, "s"))
            },
        );
        let drive = self.drive.as_ref().map(|DrivenBeyond { time_s, setpoint_outside, is_commanded }| {
            let why = match setpoint_outside {
                Some(outside) => format!("its setpoint is up to {} outside the range", shown(*outside)),
                None if *is_commanded => format!(
                    "its setpoint is inside the range, but it moves outwards, or deeper into its stop than {}",
                    shown(ON_THE_STOP)
                ),
                None => "its setpoint is not known".to_owned(),
            };
            format!("{name} is driven beyond its limit from {} on: {why}", quantity(*time_s, "s"))
        });
        let saturated = (self.saturated > 0)
            .then(|| format!("the actuator of {name} is at its effort limit in {} samples", self.saturated));
        rest.into_iter().chain(drive).chain(saturated).collect()
    }
}

impl Monitor for LimitsMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.samples += 1;
        for at in 0..self.coordinates.len() {
            self.observe_position(at, sample);
            self.observe_shares(at, sample);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let name = |coordinate: usize| names.joints[coordinate].clone();
        let with_value = self.watches().filter(|watch| watch.worst().is_some());
        let measures = with_value.map(|watch| watch.measure(&names.joints, name)).collect();
        Observed { samples: self.samples, measures, notes: self.notes(names), ..Observed::default() }
    }

    fn values(&self, time_s: f64, take: &mut dyn FnMut(InstantValue)) {
        self.watches().filter_map(|watch| watch.at(time_s)).for_each(take);
    }

    fn has_failed(&self) -> bool {
        self.watches().any(Watch::is_violated)
    }
}

/// The limits of all coordinates. A limit of zero counts as none: some descriptions write it for an unknown limit.
fn coordinates(description: &RobotDescription, held: &[String]) -> Vec<CoordinateLimits> {
    let robot = &description.robot;
    let stated = |limit: Option<f64>| limit.filter(|&limit| limit > 0.0);
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let is_held = |joint: &Joint| {
        let master = joint.mimic.map(|mimic| &robot.joint(mimic.master).name);
        held.contains(&joint.name) || master.is_some_and(|master| held.contains(master))
    };
    let judged = joints.enumerate().filter(|(_, joint)| !is_held(joint));
    let limits = judged.map(|(coordinate, joint)| CoordinateLimits {
        coordinate,
        kind: joint.kind,
        range: joint.position_range(),
        velocity: stated(joint.limit.and_then(|limit| limit.velocity)),
        effort: stated(joint.limit.and_then(|limit| limit.effort)),
        beyond_before: 0.0,
        rest: None,
        drive: None,
        was_beyond: false,
        saturated: 0,
    });
    limits.collect()
}
