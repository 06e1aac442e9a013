//! The inputs of planning a motion, and what every planned move is held against.

use std::path::Path;

use congruent_description::{Diagnostic, RobotDescription, RobotQ, display::quantity};

use super::{
    course::PlannedMove,
    excess::{Excess, worst_excess},
    timing::MotionLimits,
};
use crate::scenario::{FilePlace, OverLimit};

/// The code of the warning that a motion takes longer than the scenario says.
pub(super) const SLOWED: &str = "scenario::slowed";
/// In units of the third digit: a duration that rounding has put above it is not rounded up. Kind: rounding.
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
    pub(super) warnings: &'a mut Vec<Diagnostic>,
}

impl Planning<'_> {
    /// The move with its duration; slower, or refused, if it breaks a limit. `where_` says for a time of its pace where
    /// along a path that is.
    pub(super) fn within_limits(
        &mut self,
        mut planned: PlannedMove,
        where_: impl Fn(f64) -> String,
    ) -> Result<PlannedMove, Diagnostic> {
        let Some(excess) = worst_excess(&planned, self.limits) else { return Ok(planned) };
        let Excess { rate, time_s, value, limit, .. } = excess;
        let duration_s = planned.pace.duration_s();
        let least_s = rounded_up(duration_s * excess.slower);
        let robot = &self.description.robot;
        let joint = robot.joint(robot.movable_joints()[excess.coordinate]);
        let unit = format!("{}{}", joint.kind.unit(), rate.per());
        let [value, limit] = [value, limit].map(|value| quantity(value, &unit));
        let message = format!(
            "joint \"{}\" {} {value} at {}{}, its limit is {limit}",
            joint.name,
            rate.words(),
            quantity(time_s, "s"),
            where_(time_s),
        );
        let [least, given] = [least_s, duration_s].map(|duration_s| quantity(duration_s, "s"));
        match self.limits.over_limit {
            OverLimit::Refuse => {
                let error = Diagnostic::error("scenario::over_limit", message);
                let help = format!(
                    "{least} instead of {given} is the shortest duration that would do, or write over_limit = \"slow\" \
                     under [limits]"
                );
                Err(self.place.mark(error.with_help(help)))
            }
            OverLimit::Slow => {
                let help = format!("the motion takes {least} instead of {given}");
                let warning = Diagnostic::warning(SLOWED, message).with_help(help);
                self.warnings.push(self.place.mark(warning));
                planned.pace = planned.pace.slowed(least_s / duration_s);
                Ok(planned)
            }
        }
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
