//! A check of a scenario in a run. A new kind of check is a variant of [`Check`], a file here, and a line in
//! [`RunningCheck::new`].

use congruent_description::{Diagnostic, RobotDescription};

use super::{
    agreement::AgreementMonitor,
    clearance::{self, ClearanceMonitor},
    goal::{self, GoalMonitor},
    limits::{self, LimitsMonitor},
    monitor::{Monitor, Observed},
    names::Names,
    zone::ZoneMonitor,
};
use crate::{
    proximity::ObstacleMobility,
    scenario::{Check, CheckKind, FilePlace, ObstacleSettings, OnViolation},
    verdict::{CheckResult, Status},
};

/// A check with its results so far.
pub struct RunningCheck {
    /// The kind, as the scenario names it.
    pub kind: CheckKind,
    /// Line of its section in the scenario file, from 1.
    pub line: Option<usize>,
    /// What follows its first violation.
    pub on_violation: OnViolation,
    /// The check itself.
    pub monitor: Box<dyn Monitor>,
}

impl std::fmt::Debug for RunningCheck {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RunningCheck")
            .field("kind", &self.kind)
            .field("line", &self.line)
            .finish_non_exhaustive()
    }
}

impl RunningCheck {
    /// Whether the settings of a check are consistent, with the robot and its obstacles.
    ///
    /// # Errors
    /// A diagnostic at the value that is not.
    pub fn examine(
        check: &Check,
        place: FilePlace<'_>,
        around: (&RobotDescription, &[ObstacleSettings], &[ObstacleMobility]),
    ) -> Result<(), Diagnostic> {
        match check {
            Check::Clearance(check) => clearance::examine(check, place, around),
            Check::Goal(check) => goal::examine(check, place).map(|_| ()),
            Check::Limits(check) => limits::examine(check, place),
            Check::Agreement(_) | Check::Zone(_) => Ok(()),
        }
    }

    /// The check before the first sample.
    ///
    /// # Panics
    /// For settings that [`RunningCheck::examine`] rejects.
    pub fn new(check: &Check, line: Option<usize>, description: &RobotDescription) -> Self {
        let monitor: Box<dyn Monitor> = match check {
            Check::Agreement(check) => Box::new(AgreementMonitor::new(check, description)),
            Check::Clearance(check) => Box::new(ClearanceMonitor::new(check, description)),
            Check::Goal(check) => Box::new(GoalMonitor::new(check, description)),
            Check::Limits(check) => Box::new(LimitsMonitor::new(check, description)),
            Check::Zone(_) => Box::new(ZoneMonitor::new(description)),
        };
        Self { kind: check.kind(), line, on_violation: check.on_violation(), monitor }
    }

    /// Whether the check has failed and ends the run with that.
    pub fn stops(&self) -> bool {
        self.on_violation == OnViolation::Stop && self.monitor.has_failed()
    }

    /// The result of the check.
    pub fn result(&self, names: &Names) -> CheckResult {
        let Observed { samples, measures, notes } = self.monitor.finish(names);
        let status = match samples {
            _ if self.monitor.has_failed() => Status::Fail,
            0 => Status::Skipped,
            _ if measures.iter().all(|measure| measure.worst.is_none()) => Status::Skipped,
            _ => Status::Pass,
        };
        CheckResult { check: self.kind, line: self.line, status, samples, measures, notes }
    }
}
