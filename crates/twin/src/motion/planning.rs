//! The inputs of planning a motion, and what every planned move is held against.

use std::path::Path;

use congruent_description::{Diagnostic, RobotDescription, RobotQ, display::quantity};

use super::{
    course::{PlannedMove, SetpointMut, Way},
    timing::MotionLimits,
};
use crate::scenario::{FilePlace, OverLimit};

/// Instants at which the velocities of a move are held against their limits; splines have four for each knot. Even: one
/// is in the middle, where profiles are fastest.
const INSTANTS: usize = 400;
/// Part of a velocity limit by which rounding may exceed it.
const ROUNDING: f64 = 1e-9;

/// The robot, the start of the motion, and its place in the scenario file.
pub(super) struct Planning<'a> {
    pub(super) description: &'a RobotDescription,
    pub(super) limits: &'a MotionLimits,
    /// The folder of the scenario file, in which other files are found.
    pub(super) folder: &'a Path,
    /// The end of the previous motion; after a servo, whose end is not known, the last configuration that is.
    pub(super) from: &'a RobotQ,
    pub(super) place: FilePlace<'a>,
    /// Whether the run has begun: when its motions begin is settled, so that none can be slowed.
    pub(super) is_in_run: bool,
    pub(super) warnings: &'a mut Vec<Diagnostic>,
}

/// The largest excess of a velocity over its limit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Excess {
    coordinate: usize,
    /// Time of the pace.
    pub(super) time_s: f64,
    value: f64,
    /// Value by limit.
    pub(super) times: f64,
}

impl Planning<'_> {
    /// The move with its duration; slower, or refused, if it breaks a velocity limit. `where_` says for a time of its
    /// pace where along a path that is.
    pub(super) fn within_limits(
        &mut self,
        mut planned: PlannedMove,
        where_: impl Fn(f64) -> String,
    ) -> Result<PlannedMove, Diagnostic> {
        let Some(excess) = self.excess(&planned) else { return Ok(planned) };
        let duration_s = planned.pace.duration_s();
        let least_s = rounded_up(duration_s * excess.times);
        let robot = &self.description.robot;
        let joint = robot.joint(robot.movable_joints()[excess.coordinate]);
        let unit = format!("{}/s", joint.kind.unit());
        let [value, limit] =
            [excess.value, self.limits.velocity[excess.coordinate]].map(|value| quantity(value, &unit));
        let message = format!(
            "joint \"{}\" would move at {value} at {}{}, its limit is {limit}",
            joint.name,
            quantity(excess.time_s, "s"),
            where_(excess.time_s),
        );
        let least = quantity(least_s, "s");
        match self.limits.over_limit {
            over_limit if self.is_in_run || over_limit == OverLimit::Refuse => {
                let shortest = format!(
                    "{least} instead of {} is the shortest duration that would do",
                    quantity(duration_s, "s")
                );
                let help = if self.is_in_run {
                    shortest
                } else {
                    format!("{shortest}, or write over_limit = \"slow\" under [limits]")
                };
                let error = Diagnostic::error("scenario::over_limit", message).with_help(help);
                Err(self.place.mark(error))
            }
            _ => {
                let help = format!("the motion takes {least} instead of {}", quantity(duration_s, "s"));
                let warning = Diagnostic::warning("scenario::slowed", message).with_help(help);
                self.warnings.push(self.place.mark(warning));
                planned.pace = planned.pace.slowed(least_s / duration_s);
                Ok(planned)
            }
        }
    }

    fn excess(&self, planned: &PlannedMove) -> Option<Excess> {
        let dof = planned.to.len();
        let (mut q, mut qd, mut qdd) = (vec![0.0; dof], vec![0.0; dof], vec![0.0; dof]);
        let instants = match &planned.way {
            Way::Straight(_) => INSTANTS,
            Way::Spline(spline) => INSTANTS.max(4 * spline.knots().len()),
        };
        let mut worst: Option<Excess> = None;
        let (duration_s, begins_s) = (planned.pace.duration_s(), planned.begins_s);
        for instant in 1..instants {
            #[expect(clippy::cast_precision_loss, reason = "far below 2^52")]
            let time_s = duration_s * instant as f64 / instants as f64;
            let setpoint = SetpointMut { q: &mut q, qd: &mut qd, qdd: &mut qdd };
            planned.at(time_s - begins_s, setpoint);
            for (coordinate, (&value, &limit)) in qd.iter().zip(&self.limits.velocity).enumerate() {
                let times = value.abs() / limit;
                if times > worst.map_or(1.0 + ROUNDING, |worst| worst.times) {
                    worst = Some(Excess { coordinate, time_s, value: value.abs(), times });
                }
            }
        }
        worst
    }
}

/// Up to the next value of three digits, as people read and write it.
fn rounded_up(duration_s: f64) -> f64 {
    let unit = 10.0_f64.powf(duration_s.log10().floor() - 2.0);
    (duration_s / unit - ROUNDING).ceil() * unit
}

/// The fault of a move without a duration whose joint has no velocity limit.
pub(super) fn no_velocity_limit(planning: &Planning<'_>, coordinate: usize) -> Diagnostic {
    let robot = &planning.description.robot;
    let name = &robot.joint(robot.movable_joints()[coordinate]).name;
    let message = format!("joint \"{name}\" has no velocity limit, which the least time needs");
    let help = "give `duration_s`, or a velocity under [limits]";
    planning.place.mark(Diagnostic::error("scenario::no_velocity_limit", message).with_help(help))
}

/// The fault of a move without a duration that goes nowhere.
pub(super) fn nothing_moves(planning: &Planning<'_>) -> Diagnostic {
    let error =
        Diagnostic::error("scenario::nothing_moves", "the motion ends where it starts: no time is the least");
    planning.place.mark(error.with_help("give `duration_s`, or leave the motion out"))
}
