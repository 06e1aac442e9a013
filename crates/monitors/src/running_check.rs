//! A check of a scenario in a run. A new kind of check is a variant of [`Check`], a file in one of the folders here, and
//! a line in [`RunningCheck::new`].

use congruent_description::{Robot, RobotDescription};
use congruent_input::Diagnostic;
use congruent_proximity::{ObstacleMobility, PairNames};
use congruent_scenario::{Check, CheckKind, FilePlace, ObstacleSettings, OnViolation};

use super::{
    context::CheckContext,
    forces::{
        DYNAMICS_RELATIVE_PER_S, DynamicsMonitor, EFFORT_RELATIVE, EffortMonitor, POWER_RELATIVE_PER_S,
        PowerMonitor,
    },
    joints::{
        AT_THE_END, AT_THE_LIMIT, CycleTimeMonitor, LARGEST_EFFORT_SHARE, LARGEST_VELOCITY_SHARE,
        LimitsMonitor, TrackingMonitor, examine_limits, examine_tracking,
    },
    monitor::{Monitor, Observed},
    names::Names,
    pose::{
        AgreementMonitor, GoalMonitor, InvariantsMonitor, TwistMonitor, default_rotation, examine_goal,
        twist_limits,
    },
    recorded::{
        FACTOR, PoseMonitor, RecordedEffortMonitor, RecordingMonitor, SPREAD_M, SamePointMonitor,
        StepMonitor, UNEXPLAINED_SHARE, USED_SHARE, VelocityMonitor, default_jumps, default_limits,
    },
    space::{ClearanceMonitor, ContactMonitor, ZoneMonitor, examine_minimum, examine_pairs},
};
use crate::verdict::{CheckResult, InstantValue, Measure, Status};

/// A check that evaluates fewer than one in this number of samples is inconclusive. Kind: judgement; a fault that lasts nine tenths
/// of the run could lie in samples that were not evaluated as a whole. A violation counts however few there are.
const FEWEST_ARE_ONE_IN: u64 = 10;

/// A check with its results so far.
pub struct RunningCheck<'a> {
    /// Kind of the check, as the scenario names it.
    pub kind: CheckKind,
    /// Line of the section in the scenario file, from 1.
    pub line: Option<usize>,
    /// Whether the check is a default one: the scenario has no check of this kind.
    pub is_default: bool,
    /// What the run does at the first violation of the check.
    pub on_violation: OnViolation,
    /// The evaluation of the check.
    pub monitor: Box<dyn Monitor + 'a>,
}

impl std::fmt::Debug for RunningCheck<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RunningCheck")
            .field("kind", &self.kind)
            .field("line", &self.line)
            .finish_non_exhaustive()
    }
}

impl<'a> RunningCheck<'a> {
    /// Whether the settings of a check are consistent, with the robot and its obstacles.
    ///
    /// # Errors
    /// A diagnostic at the value that is not.
    pub fn examine(
        check: &Check,
        place: FilePlace<'_>,
        description: &RobotDescription,
        obstacles: &[ObstacleSettings],
        mobility: &[ObstacleMobility],
    ) -> Result<(), Diagnostic> {
        check.unit_keys().iter().try_for_each(|keys| keys.examine(place))?;
        let pairs = |pairs: &[[String; 2]], ignore: &[[String; 2]]| {
            let names = PairNames { pairs: pairs.to_vec(), ignore: ignore.to_vec() };
            examine_pairs(&names, place, description, obstacles, mobility)
        };
        match check {
            Check::Clearance(check) => {
                examine_minimum(check, place)?;
                pairs(&check.pairs, &check.ignore)
            }
            Check::Contact(check) => pairs(&check.pairs, &check.ignore),
            Check::Goal(check) => examine_goal(check, place).map(|_| ()),
            Check::Limits(check) => examine_limits(check, place),
            Check::Tracking(check) => examine_tracking(check, place, &description.robot),
            Check::Agreement(_)
            | Check::CycleTime(_)
            | Check::Dynamics(_)
            | Check::Effort(_)
            | Check::Invariants(_)
            | Check::Pose(_)
            | Check::Power(_)
            | Check::Recording(_)
            | Check::SamePoint(_)
            | Check::Step(_)
            | Check::Twist(_)
            | Check::Velocity(_)
            | Check::Zone(_) => Ok(()),
        }
    }

    /// The check before the first sample.
    ///
    /// # Panics
    /// For settings that [`RunningCheck::examine`] rejects.
    pub fn new(check: &Check, line: Option<usize>, context: &CheckContext<'a>) -> Self {
        let description = context.description;
        let monitor: Box<dyn Monitor + 'a> = match check {
            Check::Agreement(check) => Box::new(AgreementMonitor::new(check, description)),
            Check::Clearance(check) => Box::new(ClearanceMonitor::new(check, description)),
            Check::Contact(check) => Box::new(ContactMonitor::new(check, context)),
            Check::CycleTime(check) => Box::new(CycleTimeMonitor::new(check, context)),
            Check::Dynamics(check) => Box::new(DynamicsMonitor::new(check, context)),
            Check::Effort(check) if context.is_recorded => {
                Box::new(RecordedEffortMonitor::new(check, context))
            }
            Check::Effort(check) => Box::new(EffortMonitor::new(check, context)),
            Check::Goal(check) => Box::new(GoalMonitor::new(check, description)),
            Check::Invariants(check) => Box::new(InvariantsMonitor::new(check, context)),
            Check::Limits(check) => Box::new(LimitsMonitor::new(check, context)),
            Check::Pose(check) => Box::new(PoseMonitor::new(check, context)),
            Check::Power(check) => Box::new(PowerMonitor::new(check, context)),
            Check::Recording(check) => Box::new(RecordingMonitor::new(check, context)),
            Check::SamePoint(check) => Box::new(SamePointMonitor::new(check, context)),
            Check::Step(check) => Box::new(StepMonitor::new(check, context)),
            Check::Tracking(check) => Box::new(TrackingMonitor::new(check, context)),
            Check::Twist(check) => Box::new(TwistMonitor::new(check, context)),
            Check::Velocity(check) => Box::new(VelocityMonitor::new(check, context)),
            Check::Zone(_) => Box::new(ZoneMonitor::new(description)),
        };
        Self { kind: check.kind(), line, is_default: false, on_violation: check.on_violation(), monitor }
    }

    /// A check that the scenario does not have, before the first sample.
    pub fn by_default(check: &Check, context: &CheckContext<'a>) -> Self {
        Self { is_default: true, ..Self::new(check, None, context) }
    }

    /// Whether the check would end the run if it failed.
    pub fn may_stop(&self) -> bool {
        self.on_violation == OnViolation::Stop
    }

    /// Whether the check has failed and ends the run with that.
    pub fn stops(&self) -> bool {
        self.may_stop() && self.monitor.has_failed()
    }

    /// Calls `take` with the values of the check at this time.
    pub fn values(&self, time_s: f64, take: &mut dyn FnMut(CheckKind, InstantValue)) {
        self.monitor.values(time_s, &mut |value| take(self.kind, value));
    }

    /// The quantities of the check with their limits, before its first sample.
    pub fn limits(&self, robot: &Robot) -> Vec<Measure> {
        self.monitor.finish(&Names::of_robot(robot)).measures
    }

    /// The result of the check.
    pub fn result(&self, names: &Names) -> CheckResult {
        let Observed { samples, not_evaluated, measures, nearest_that_changes, contacts, mut notes } =
            self.monitor.finish(names);
        let status = match samples {
            _ if self.monitor.has_failed() => Status::Fail,
            0 => Status::Skipped,
            _ if measures.iter().all(|measure| measure.worst.is_none()) => Status::Skipped,
            _ if samples * FEWEST_ARE_ONE_IN < samples + not_evaluated => Status::Inconclusive,
            _ => Status::Pass,
        };
        if status == Status::Inconclusive {
            let all = samples + not_evaluated;
            notes.insert(
                0,
                format!("{samples} of {all} samples evaluated, fewer than one in {FEWEST_ARE_ONE_IN}"),
            );
        }
        let Self { kind: check, line, is_default, .. } = *self;
        CheckResult {
            check,
            line,
            is_default,
            status,
            samples,
            measures,
            nearest_that_changes,
            contacts,
            notes,
        }
    }
}

/// Writes the default limits into a check that does not give them.
pub fn write_out_limits(check: &mut Check, description: &RobotDescription, step_s: f64) {
    let fill = |si: &mut Option<f64>, engineering: Option<f64>, default: f64| {
        if engineering.is_none() {
            si.get_or_insert(default);
        }
    };
    match check {
        Check::Agreement(check) => {
            fill(&mut check.position_m, check.position_mm, description.tolerance.position_m);
            fill(&mut check.orientation_rad, check.orientation_deg, description.tolerance.orientation_rad);
        }
        Check::CycleTime(check) => {
            fill(&mut check.tolerance_rad, check.tolerance_deg, AT_THE_END);
            fill(&mut check.tolerance_m, check.tolerance_mm, AT_THE_END);
        }
        Check::Dynamics(check) => {
            check.relative.get_or_insert(DYNAMICS_RELATIVE_PER_S * step_s);
        }
        Check::Effort(check) => {
            check.relative.get_or_insert(EFFORT_RELATIVE);
            check.unexplained_share.get_or_insert(UNEXPLAINED_SHARE);
        }
        Check::Invariants(check) => {
            check.rotation.get_or_insert_with(|| default_rotation(&description.robot));
        }
        Check::Limits(check) => {
            fill(&mut check.tolerance_rad, check.tolerance_deg, AT_THE_LIMIT);
            fill(&mut check.tolerance_m, check.tolerance_mm, AT_THE_LIMIT);
            check.velocity_share.get_or_insert(LARGEST_VELOCITY_SHARE);
            check.effort_share.get_or_insert(LARGEST_EFFORT_SHARE);
        }
        Check::Pose(check) => {
            let [position_m, orientation_rad] = default_limits();
            fill(&mut check.position_m, check.position_mm, position_m);
            fill(&mut check.orientation_rad, check.orientation_deg, orientation_rad);
        }
        Check::Recording(check) => {
            check.used_share.get_or_insert(USED_SHARE);
        }
        Check::SamePoint(check) => fill(&mut check.spread_m, check.spread_mm, SPREAD_M),
        Check::Step(check) => {
            let [angle_rad, shift_m] = default_jumps();
            fill(&mut check.angle_rad, check.angle_deg, angle_rad);
            fill(&mut check.shift_m, check.shift_mm, shift_m);
        }
        Check::Velocity(check) => {
            check.factor.get_or_insert(FACTOR);
        }
        Check::Power(check) => {
            check.relative.get_or_insert(POWER_RELATIVE_PER_S * step_s);
        }
        Check::Twist(check) => {
            let [linear_m_s, angular_rad_s] = twist_limits(step_s);
            fill(&mut check.linear_m_s, check.linear_mm_s, linear_m_s);
            fill(&mut check.angular_rad_s, check.angular_deg_s, angular_rad_s);
        }
        Check::Clearance(_) | Check::Contact(_) | Check::Goal(_) | Check::Tracking(_) | Check::Zone(_) => {}
    }
}
