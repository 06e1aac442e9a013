//! The inputs of planning a motion, and what every planned move is held against.

use congruent_description::{
    Diagnostic, Elementary as _, RobotDescription, RobotQ,
    display::{quantity, quantity_in_full},
};

use super::{
    course::PlannedMove,
    excess::{Excess, worst_excess},
    timing::MotionLimits,
};
use crate::scenario::{FilePlace, OverLimit, ScenarioFolder};

/// The code of the warning that a motion takes longer than the scenario says.
pub(super) const SLOWED: &str = "scenario::slowed";
/// In units of the fourth digit: a duration that rounding has put above it is not rounded up. Kind: rounding.
const ROUNDING: f64 = 1e-9;

/// The robot, the start of the motion, and its place in the scenario file.
pub(super) struct Planning<'a> {
    pub(super) description: &'a RobotDescription,
    pub(super) limits: &'a MotionLimits,
    /// The folder of the scenario file, in which other files are found.
    pub(super) folder: ScenarioFolder<'a>,
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
        planned: PlannedMove,
        where_: impl Fn(f64) -> String,
    ) -> Result<PlannedMove, Diagnostic> {
        let Some(excess) = worst_excess(&planned, self.limits) else { return Ok(planned) };
        self.over_limit(planned, &excess, &where_(excess.time_s))
    }

    /// The same of a table of few digits, which may exceed a limit by this factor; `where_` is of a joint, and a time.
    pub(super) fn table_within_limits(
        &mut self,
        planned: PlannedMove,
        times: f64,
        where_: impl Fn(usize, f64) -> String,
    ) -> Result<PlannedMove, Diagnostic> {
        let excess = worst_excess(&planned, self.limits).filter(|excess| excess.value > times * excess.limit);
        let Some(excess) = excess else { return Ok(planned) };
        self.over_limit(planned, &excess, &where_(excess.coordinate, excess.time_s))
    }

    /// What the scenario says of a move that breaks a limit.
    fn over_limit(
        &mut self,
        mut planned: PlannedMove,
        excess: &Excess,
        where_: &str,
    ) -> Result<PlannedMove, Diagnostic> {
        let duration_s = planned.pace.duration_s();
        let least_s = rounded_up(duration_s * excess.slower);
        let message = self.in_words(excess, where_);
        let [least, given] = [quantity_in_full(least_s, "s"), quantity(duration_s, "s")];
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
            OverLimit::Warn => {
                let help = format!(
                    "the motion goes on as it is; over {least} instead of {given} it would keep this limit"
                );
                let warning = Diagnostic::warning("scenario::over_limit", message).with_help(help);
                self.warnings.push(self.place.mark(warning));
                Ok(planned)
            }
        }
    }

    /// An excess in words; `where_` says where along a path it is.
    fn in_words(&self, excess: &Excess, where_: &str) -> String {
        let robot = &self.description.robot;
        let joint = robot.joint(robot.movable_joints()[excess.coordinate]);
        let unit = format!("{}{}", joint.kind.unit(), excess.rate.per());
        let [value, limit] = [excess.value, excess.limit].map(|value| quantity(value, &unit));
        format!(
            "joint \"{}\" {} {value} at {}{where_}, its limit is {limit}",
            joint.name,
            excess.rate.words(),
            quantity(excess.time_s, "s"),
        )
    }
}

/// Up to the next value of four digits, as people read and write it.
fn rounded_up(duration_s: f64) -> f64 {
    // Divided by a power of ten, a whole number has the digits that it is written with.
    let per_s = 10.0_f64.to_power(3.0 - duration_s.decimal_logarithm().floor());
    (duration_s * per_s - ROUNDING).ceil() / per_s
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
