//! A scenario with its robot, ready to run any number of times.

use std::{path::PathBuf, sync::Arc};

use congruent_description::{Obstacle, RobotDescription, RobotQ};
use congruent_dynamics::JointResistance;
use congruent_input::{Capability, Diagnostic, Diagnostics, FileAccess, Findings, InputFile};
use congruent_logs::SurveyedLog;
use congruent_monitors::{
    ActuatorLimits, CheckContext, ComparedPoses, RunClock, RunDynamics, RunPayload, RunningCheck,
};
use congruent_motion::{Trajectory, codes::scenario::TARGET_LIMIT};
use congruent_proximity::{MovingBody, ObstacleMobility, Zone, simplified_hulls};
use congruent_scenario::{ControllerKind, FilePlace, Scenario, ScenarioFolder, numbers};

use super::{
    actuation::{Actuation, ControllerSetup, SensorSetup},
    checks::{default_checks, examine_checks, needs_shapes},
    cost::long_run,
    default_values::write_out,
    head::check_head,
    motions::{trajectory, written_s},
    recorded::RecordedSetup,
    start::{inside_limits, start},
    surroundings::{FirstStep, Surroundings, jumps, mobility},
    timing::RunTiming,
    uncertain_case::{CaseValue, KnownValues, UncertainCase},
    written_at::WrittenAt,
};
use crate::{
    fault::{PlannedFault, resolve},
    setup::surroundings::{overlaps, zones},
};

/// A scenario checked against its robot. It is plain data: each run builds its own physics, controller and
/// checks.
#[derive(Debug, Clone)]
pub struct RunSetup {
    /// The scenario with every default written out; it names the robot by its absolute path, so that it runs
    /// from any folder.
    pub scenario: Scenario,
    /// The file that it came from; `None` for one that was made in code.
    pub path: Option<PathBuf>,
    /// Values that replace those of the file, `KEY=VALUE`.
    pub overrides: Vec<String>,
    /// The files that were read: the scenario, those of the robot, and those that the scenario names.
    pub inputs: Vec<InputFile>,
    /// The robot with its model.
    pub description: RobotDescription,
    /// Length of a step, number of steps, and gravity.
    pub clock: RunClock,
    /// Configuration at the start.
    pub start: RobotQ,
    /// The motions, planned from the start on.
    pub trajectory: Trajectory,
    /// The controller with one gain for each joint.
    pub controller: ControllerSetup,
    /// Obstacles with their poses at the start, in the root link's frame.
    pub obstacles: Vec<Obstacle>,
    /// Zones that named links may not enter, in the root link's frame.
    pub zones: Vec<Zone>,
    /// Obstacles that move along a path or are carried.
    pub bodies: Vec<MovingBody>,
    /// Bodies that links carry for a time, in addition to their own masses: known to controllers and checks.
    pub payloads: Vec<RunPayload>,
    /// Damping, dry friction and armature of each moving joint: known to controllers and checks.
    pub resistances: Vec<JointResistance>,
    /// Faults of the twin, unknown to controllers and checks.
    pub faults: Vec<PlannedFault>,
    /// Resolution and noise of the encoders.
    pub sensors: SensorSetup,
    /// The log whose joint states the run takes, in place of a simulation.
    pub recorded: Option<RecordedSetup>,
    /// The case of `[uncertainty]` that it is; `None` for a scenario as it is written.
    pub uncertain_case: Option<UncertainCase>,
    /// Warnings about the scenario; the robot's own warnings are in its description.
    pub warnings: Vec<Diagnostic>,
    /// Errors that matter for a simulation only: obstacles that overlap the robot at the start, and a run without an end.
    pub(super) for_simulation: Vec<Diagnostic>,
    /// Lines of the scenario's own checks; the default ones follow them.
    check_lines: Vec<Option<usize>>,
}

impl RunSetup {
    /// Checks a scenario that was made in code against a robot; the robot that the scenario names is not read.
    ///
    /// # Errors
    /// Every finding, if at least one is an error.
    pub fn new(scenario: Scenario, description: RobotDescription) -> Result<Self, Findings> {
        Self::new_for(scenario, description, None)
    }

    /// The same for a stream in place of the log of `source`, of which `stream` says what its first messages have.
    ///
    /// # Errors
    /// As [`RunSetup::new`].
    pub fn new_live(
        scenario: Scenario,
        description: RobotDescription,
        stream: &SurveyedLog,
    ) -> Result<Self, Findings> {
        Self::new_for(scenario, description, Some(stream))
    }

    fn new_for(
        scenario: Scenario,
        description: RobotDescription,
        stream: Option<&SurveyedLog>,
    ) -> Result<Self, Findings> {
        let wrong = numbers::check(&scenario);
        if !wrong.is_empty() {
            return Err(wrong.into());
        }
        let folder = PathBuf::from(scenario.folder.clone().unwrap_or_default());
        let folder = ScenarioFolder { path: &folder, access: &FileAccess::default() };
        Self::build(
            scenario,
            description,
            WrittenAt { place: FilePlace::nowhere(), folder, stream, known: None },
        )
    }

    pub(super) fn build(
        mut scenario: Scenario,
        description: RobotDescription,
        written: WrittenAt<'_>,
    ) -> Result<Self, Findings> {
        let WrittenAt { place, folder, .. } = written;
        let (mut found, mut warnings) = (Diagnostics::default(), Vec::new());
        let own_checks = scenario.check.len();
        // Before anything is checked, so that default checks go through the same examination.
        scenario.check.extend(default_checks(&scenario, &description.robot));
        // From here on errors are collected, not returned: one call reports all sections.
        let robot = &description.robot;
        found.keep(check_head(&scenario, place));
        let start = found.keep(start(&scenario.start, place.key("start"), robot));
        let start = inside_limits(start, &scenario, robot, &mut warnings);
        let trajectory = found.keep(trajectory(&scenario, written, &description, &start, &mut warnings));
        // Without a plan the duration as written stands in, so that the clock is checked in the same call.
        let motions_s = trajectory.as_ref().map_or_else(|| written_s(&scenario), Trajectory::duration_s);
        let RunTiming { clock, recorded, warnings: of_timing } =
            RunTiming::new(&scenario, written, &description, motions_s, &mut found);
        warnings.extend(of_timing);
        let actuation = found.keep(Actuation::new(&scenario, place, folder, &description));
        let Surroundings { obstacles, moving, payloads: held } =
            Surroundings::new(&scenario, written, &description, trajectory.as_ref(), &mut found);
        let mobility = mobility(&moving, scenario.obstacle.len());
        let zones = found.keep(zones(&scenario.zone, place.key("zone"), robot));
        warnings.extend(examine_checks(&scenario, place, &description, &mobility, &mut found));
        let faults = clock.as_ref().and_then(|clock| {
            let faults =
                resolve(&scenario.fault, place.key("fault"), &description, clock, scenario.controller.kind);
            found.keep(faults)
        });
        let (Some(trajectory), Some(clock), Some(actuation), Some(obstacles), Some(zones), Some(faults)) =
            (trajectory, clock, actuation, obstacles, zones, faults)
        else {
            return Err(beside_ranges(found, warnings));
        };
        if found.has_error() {
            return Err(beside_ranges(found, warnings));
        }
        // After all checks: messages refer to what the user has written.
        write_out(&mut scenario, &description, &clock, &start, written);
        // Only the scenario's own checks have lines; default checks follow them and have none.
        let check_lines = (0..own_checks).map(|at| place.key("check").item(at).line()).collect();
        let Actuation { controller, resistances, sensors, payloads } = actuation;
        Ok(Self {
            scenario,
            path: None,
            overrides: Vec::new(),
            inputs: description.inputs.clone(),
            description,
            clock,
            start,
            trajectory,
            controller,
            obstacles,
            zones,
            bodies: moving,
            payloads: payloads.into_iter().chain(held).collect(),
            sensors,
            resistances,
            faults,
            recorded,
            uncertain_case: None,
            warnings,
            for_simulation: Vec::new(),
            check_lines,
        }
        .with_overlaps(place.key("obstacle"))
        .with_costs())
    }

    /// Adds warnings about long computing times and simplified hulls.
    fn with_costs(mut self) -> Self {
        if self.is_driven_by_forces() {
            self.warnings.extend(long_run(self.description.robot.dof(), &self.clock));
        }
        if needs_shapes(&self.scenario) {
            self.warnings.extend(simplified_hulls(&self.description, &self.obstacles));
        }
        self
    }

    /// Finds obstacles that are too fast, and those that overlap the robot at the start; the controller `kinematic` moves it without forces.
    fn with_overlaps(mut self, places: FilePlace<'_>) -> Self {
        self.warnings.extend(jumps(&self.bodies, &self.obstacles, self.clock.step_s, places));
        if self.is_driven_by_forces() {
            let Self { start, obstacles, bodies, clock, .. } = &self;
            let first = FirstStep { q: start, obstacles, moving: bodies, step_s: clock.step_s };
            self.for_simulation = overlaps(first, &self.description.robot, places);
        }
        if self.recorded.is_none() {
            self.for_simulation.extend(self.clock.examine_length().err());
        }
        self
    }

    /// Whether the physics moves the robot: it is neither placed at its setpoints nor where a log says.
    fn is_driven_by_forces(&self) -> bool {
        !matches!(self.scenario.controller.kind, ControllerKind::Absent | ControllerKind::Kinematic)
    }

    /// The same if it can be simulated: another source of joint states needs no inertias, and pushes no obstacle away.
    ///
    /// # Errors
    /// Every error that a simulation has: a missing inertia, or an obstacle that overlaps a link at the start.
    pub fn for_simulation(self) -> Result<Self, Findings> {
        self.examine_for_simulation()?;
        Ok(self)
    }

    /// The errors of [`RunSetup::for_simulation`], without consuming the setup.
    pub(crate) fn examine_for_simulation(&self) -> Result<(), Findings> {
        let mut found = self.for_simulation.clone();
        if self.recorded.is_some() {
            return if found.is_empty() { Ok(()) } else { Err(found.into()) };
        }
        found.extend(self.description.check_capability(Capability::Physics).err().into_iter().flatten());
        if found.is_empty() { Ok(()) } else { Err(found.into()) }
    }

    /// The checks, each before its first sample.
    pub fn checks(&self) -> Vec<RunningCheck<'_>> {
        let context = CheckContext {
            description: &self.description,
            known: self.known_description(),
            clock: &self.clock,
            payloads: &self.payloads,
            is_recorded: self.recorded.is_some(),
            held: self.recorded.as_ref().map_or(&[], |recorded| &recorded.held),
            unknown: self.recorded.as_ref().map_or(&[], |recorded| &recorded.unknown),
            poses: self.poses(),
            dynamics: self.declared_dynamics(),
        };
        let running = |(at, check)| match self.check_lines.get(at) {
            Some(&line) => RunningCheck::new(check, line, &context),
            None => RunningCheck::by_default(check, &context),
        };
        self.scenario.check.iter().enumerate().map(running).collect()
    }

    /// The poses of the log that are compared with those of the model.
    pub fn poses(&self) -> &[ComparedPoses] {
        self.recorded.as_ref().map_or(&[], |recorded| &recorded.poses)
    }

    /// How each obstacle moves.
    pub fn mobility(&self) -> Vec<ObstacleMobility> {
        mobility(&self.bodies, self.obstacles.len())
    }

    /// The declared dynamics: resistances, gravity and payloads are those of the scenario, whatever a fault changes in
    /// the physics.
    pub fn declared_dynamics(&self) -> RunDynamics<'_> {
        let gravity = self.clock.gravity_in_world;
        RunDynamics::new(&self.description.robot, &self.payloads, &self.resistances, gravity)
    }

    /// The dynamics that controllers know. In a case of `[uncertainty]` they are those of the scenario as it is written.
    pub fn known_dynamics(&self) -> RunDynamics<'_> {
        self.uncertain_case.as_ref().map_or_else(|| self.declared_dynamics(), |case| case.known_dynamics())
    }

    /// The robot that controllers and planner know. In a case of `[uncertainty]` it is that of the files.
    pub fn known_description(&self) -> &RobotDescription {
        self.uncertain_case.as_ref().map_or(&self.description, |case| &case.known.description)
    }

    /// What controllers and planner know in cases of this scenario: its values as they are written.
    pub fn known_values(&self) -> KnownValues {
        KnownValues {
            scenario: self.scenario.clone(),
            description: self.description.clone(),
            overrides: self.overrides.clone(),
            payloads: self.payloads.clone(),
            resistances: self.resistances.clone(),
            gravity_in_root_m_s2: self.clock.gravity_in_world,
        }
    }

    /// This scenario as a case of another one, whose values its controllers know.
    #[must_use]
    pub fn as_case(mut self, known: Arc<KnownValues>, case: u64, values: Vec<CaseValue>) -> Self {
        self.overrides.clone_from(&known.overrides);
        self.uncertain_case = Some(UncertainCase { case, values, known });
        self
    }

    /// Largest effort and speed of each joint's actuator.
    pub fn actuator_limits(&self) -> Vec<ActuatorLimits> {
        ActuatorLimits::for_joints(&self.description.robot, &self.scenario.joints)
    }
}

/// The errors beside the targets outside of their ranges: such a target is often the reason why a later motion fails.
fn beside_ranges(mut found: Diagnostics, warnings: Vec<Diagnostic>) -> Findings {
    found.extend(warnings.into_iter().filter(|warning| warning.code == TARGET_LIMIT));
    found.into()
}
