//! The checks of a scenario on the joint states that a recording holds, and on its errors of the links.

use congruent_input::{Quantity, SiUnit};
use congruent_monitors::{NoRecorder, verdict::Bound};
use congruent_results::comparison::Scalars;
use congruent_scenario::{CheckKind, OnViolation};
use congruent_twin::{Run, RunError, RunSetup};

use super::states::{RecordedStates, RecordedUntil};
use crate::{
    read::evidence::{Evidence, LimitedQuantity, merged},
    rrd::paths,
};

/// What the checks find at the recorded instants.
#[derive(Debug, Default)]
pub(super) struct Replay {
    /// Times of the recorded instants; empty if the joint positions are not recorded.
    pub(super) times_s: Vec<f64>,
    /// What each check of the scenario finds; nothing if it cannot be evaluated at recorded instants.
    pub(super) found: Vec<Vec<Evidence>>,
    /// The limits of the scenario.
    limits: ScenarioLimits,
}

/// The quantities of each check.
#[derive(Debug, Default)]
struct ScenarioLimits(Vec<Vec<LimitedQuantity>>);

impl ScenarioLimits {
    /// The limits that the checks of the scenario state, before any sample.
    fn from_setup(setup: &RunSetup) -> Self {
        let (checks, robot) = (setup.checks(), &setup.description.robot);
        let quantities = checks
            .iter()
            .map(|check| check.limits(robot).iter().map(LimitedQuantity::from_measure).collect());
        Self(quantities.collect())
    }
}

/// Whether the joint states at recorded instants are all that a check needs. The others compare one step with the next,
/// or the physics with itself.
fn needs_states_alone(kind: CheckKind) -> bool {
    match kind {
        CheckKind::Clearance
        | CheckKind::Contact
        | CheckKind::CycleTime
        | CheckKind::Goal
        | CheckKind::Limits
        | CheckKind::Tracking
        | CheckKind::Zone => true,
        CheckKind::Agreement
        | CheckKind::Dynamics
        | CheckKind::Effort
        | CheckKind::Invariants
        | CheckKind::Pose
        | CheckKind::Power
        | CheckKind::Recording
        | CheckKind::Step
        | CheckKind::SamePoint
        | CheckKind::Velocity
        | CheckKind::Twist => false,
    }
}

impl Replay {
    /// Lets the checks of the scenario see the recorded states, up to where the recording goes; `left_out` are not to
    /// be evaluated.
    ///
    /// # Errors
    /// [`RunError`] if the robot has no model or a shape no hull.
    pub(super) fn evaluate(
        scalars: &Scalars,
        setup: &RunSetup,
        until: RecordedUntil,
        left_out: &[CheckKind],
    ) -> Result<Self, RunError> {
        let found = vec![Vec::new(); setup.scenario.check.len()];
        let mut replay = Self { found, limits: ScenarioLimits::from_setup(setup), ..Self::default() };
        if let Some(states) = RecordedStates::new(scalars, setup, until) {
            replay.times_s = states.times_s();
            replay.run(states, setup, left_out)?;
        }
        // Errors of links are recorded as scalars with all digits; poses of links have those of the viewer and
        // would not do.
        for (at, check) in setup.scenario.check.iter().enumerate() {
            if check.kind() == CheckKind::Agreement {
                replay.found[at] = replay.errors(at, scalars, setup);
            }
        }
        Ok(replay)
    }

    fn run(
        &mut self,
        states: RecordedStates,
        setup: &RunSetup,
        left_out: &[CheckKind],
    ) -> Result<(), RunError> {
        let mut checks = setup.checks();
        for check in &mut checks {
            // The states after a stop are recorded, too.
            check.on_violation = OnViolation::Continue;
        }
        let mut run = Run::with_source(setup, Box::new(states))?;
        let (_, result) = run.finish(&mut checks, &mut NoRecorder, |_| ());
        result?;
        // A run lets all its checks observe; results that need every step, or the end of the run, are not taken
        // over.
        for (found, check) in self.found.iter_mut().zip(&checks) {
            if needs_states_alone(check.kind) && !left_out.contains(&check.kind) {
                let result = check.result(run.names());
                *found = merged(result.measures.iter().filter_map(Evidence::from_measure));
            }
        }
        Ok(())
    }

    /// The recorded errors of all links.
    fn errors(&self, check: usize, scalars: &Scalars, setup: &RunSetup) -> Vec<Evidence> {
        let of_quantity = |name: Quantity, unit: SiUnit, path: fn(&str) -> re_log_types::EntityPath| {
            let limit = self.limit(check, name, unit)?;
            let of = LimitedQuantity { name, unit, bound: Bound::AtMost, limit };
            let of_link = |link: &str| {
                let found = Evidence::from_values(of, scalars.get(&path(link).to_string())?)?;
                Some(Evidence { subject: Some(link.to_owned()), ..found })
            };
            let links = setup.description.robot.links().iter();
            merged(links.filter_map(|link| of_link(&link.name))).pop()
        };
        let position = of_quantity(Quantity::Position, SiUnit::Metre, paths::position_error);
        position
            .into_iter()
            .chain(of_quantity(Quantity::Orientation, SiUnit::Radian, paths::orientation_error))
            .collect()
    }

    /// The limit of a quantity by the scenario, if its check has one.
    pub(super) fn limit(&self, check: usize, name: Quantity, unit: SiUnit) -> Option<f64> {
        // A limit of the scenario comes before one that the check derived from what it observed.
        let scenario_limit = self.limits.0[check].iter().find(|quantity| quantity.is(name, unit));
        let found = || self.found[check].iter().map(|found| &found.of).find(|of| of.is(name, unit));
        scenario_limit.or_else(found).map(|of| of.limit)
    }
}
