//! The inputs of planning a motion, and the comparison of every planned move with the limits.

use congruent_description::{RobotDescription, RobotQ};
use congruent_input::{
    Diagnostic,
    display::{compared_quantities, quantity, quantity_in_full},
};
use congruent_scenario::{FilePlace, OverLimit, ScenarioFolder};

use super::{
    motion_plan::PlannedMove,
    timing::MotionLimits,
    violation::{LimitViolation, worst_violation},
};
use crate::codes;

/// In units of the fourth digit: a duration that exceeds a value of four digits by rounding alone is not rounded up. Kind:
/// rounding.
const ROUNDING: f64 = 1e-9;

/// Inputs of planning a motion: the robot with its limits, the start, and the place in the scenario file.
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
    /// The move itself if it keeps all limits; otherwise slower, refused, or with a warning, as the scenario says. `where_`
    /// gives the place along a path at a time, for the message.
    pub(super) fn within_limits(
        &mut self,
        planned: PlannedMove,
        where_: impl Fn(f64) -> String,
    ) -> Result<PlannedMove, Diagnostic> {
        let Some(violation) = worst_violation(&planned, self.limits) else { return Ok(planned) };
        self.over_limit(planned, &violation, &where_(violation.time_s))
    }

    /// The same for a table of few digits, which may exceed a limit by this factor; `where_` gives the place in the table of a
    /// joint at a time.
    pub(super) fn table_within_limits(
        &mut self,
        planned: PlannedMove,
        times: f64,
        where_: impl Fn(usize, f64) -> String,
    ) -> Result<PlannedMove, Diagnostic> {
        let violation = worst_violation(&planned, self.limits)
            .filter(|violation| violation.value > times * violation.limit);
        let Some(violation) = violation else { return Ok(planned) };
        self.over_limit(planned, &violation, &where_(violation.coordinate, violation.time_s))
    }

    /// Applies `over_limit` of the scenario to a move that violates a limit.
    fn over_limit(
        &mut self,
        mut planned: PlannedMove,
        violation: &LimitViolation,
        where_: &str,
    ) -> Result<PlannedMove, Diagnostic> {
        let duration_s = planned.time_scaling.duration_s();
        // Before the message: it names a duration that keeps the limit as it is printed.
        let least_s = rounded_up(duration_s * violation.slower);
        let message = self.in_words(violation, where_);
        let [least, given] = [quantity_in_full(least_s, "s"), quantity(duration_s, "s")];
        match self.limits.over_limit {
            OverLimit::Refuse => {
                let error = Diagnostic::error(codes::scenario::OVER_LIMIT, message);
                let help = format!(
                    "the shortest duration within the limits is {least} instead of {given}; or write \
                     over_limit = \"slow\" under [limits]"
                );
                Err(self.place.mark(error.with_help(help)))
            }
            OverLimit::Slow => {
                let help = format!("the motion takes {least} instead of {given}");
                let warning = Diagnostic::warning(codes::scenario::SLOWED, message).with_help(help);
                self.warnings.push(self.place.mark(warning));
                // By the rounded duration, so that the motion takes what the warning says.
                planned.time_scaling = planned.time_scaling.slowed(least_s / duration_s);
                Ok(planned)
            }
            OverLimit::Warn => {
                let help = format!(
                    "the motion is not changed; it would keep this limit with a duration of {least} instead of {given}"
                );
                let warning = Diagnostic::warning(codes::scenario::OVER_LIMIT, message).with_help(help);
                self.warnings.push(self.place.mark(warning));
                Ok(planned)
            }
        }
    }

    /// The message of a limit violation; `where_` is its place along a path.
    fn in_words(&self, violation: &LimitViolation, where_: &str) -> String {
        let robot = &self.description.robot;
        let joint = robot.joint(robot.movable_joints()[violation.coordinate]);
        let unit = format!("{}{}", joint.kind.unit(), violation.rate.per());
        let [value, limit] = compared_quantities([violation.value, violation.limit], &unit);
        format!(
            "joint \"{}\" {} {value} at {}{where_}, its limit is {limit}",
            joint.name,
            violation.rate.words(),
            quantity(violation.time_s, "s"),
        )
    }
}

/// Rounded up to four digits: a duration that a user can copy from the message and that still keeps the limit.
fn rounded_up(duration_s: f64) -> f64 {
    // Divided by a power of ten, a whole number has the digits that it is written with.
    let per_s = libm::pow(10.0_f64, 3.0 - libm::log10(duration_s).floor());
    (duration_s * per_s - ROUNDING).ceil() / per_s
}

/// The error if a move has no duration and a joint no velocity limit to compute one from.
pub(super) fn no_velocity_limit(planning: &Planning<'_>, coordinate: usize) -> Diagnostic {
    let robot = &planning.description.robot;
    let name = &robot.joint(robot.movable_joints()[coordinate]).name;
    let message = format!("the shortest duration cannot be computed: joint \"{name}\" has no velocity limit");
    let help = "give `duration_s`, or a velocity under [limits]";
    planning.place.mark(Diagnostic::error(codes::scenario::NO_VELOCITY_LIMIT, message).with_help(help))
}

/// The error if a move without a duration ends where it starts.
pub(super) fn nothing_moves(planning: &Planning<'_>) -> Diagnostic {
    let error = Diagnostic::error(
        codes::scenario::NOTHING_MOVES,
        "the motion ends where it starts and has no `duration_s`",
    );
    planning.place.mark(error.with_help("give `duration_s`, or remove the motion"))
}
