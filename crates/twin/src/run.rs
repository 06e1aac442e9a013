//! The run loop: physics, comparison, clearance, checks and recording, one step after another.

use congruent_agreement::compare::Model;
use congruent_kinematics::{KinematicsError, Pose, PoseError};
use congruent_simulation::{Controller, Setpoint, SimulationError, World, WorldSettings, controller};
use nalgebra::Isometry3;
use sha2::{Digest, Sha256};

use crate::{
    monitor::{Check, Names},
    motion::{ReferenceGenerator, ServoResult},
    proximity::{Clearance, PairChoice, ProximityError},
    recorder::{Recorder, RecordingError},
    sample::Sample,
    scenario::Scenario,
    verdict::{CheckResult, Stop},
};

/// Why a run cannot start or cannot go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The physics refused the robot or broke on the way.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// The model does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// A collision shape has no convex hull.
    #[error(transparent)]
    Proximity(#[from] ProximityError),
    /// The recording cannot be written.
    #[error(transparent)]
    Recording(#[from] RecordingError),
}

/// What a finished run has found.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Results of all checks, in the order of the scenario.
    pub checks: Vec<CheckResult>,
    /// Steps taken.
    pub steps: u64,
    /// Where a check ended the run before its time.
    pub stopped: Option<Stop>,
    /// How far each servo has brought the TCP.
    pub servos: Vec<ServoResult>,
    /// SHA-256 over the joint positions of every sample.
    pub trajectory_sha256: String,
}

/// A run under way. [`Run::finish`] does all of it; the stages are public so that a benchmark can
/// take them apart.
pub struct Run<'a> {
    scenario: &'a Scenario,
    world: World,
    controller: Box<dyn Controller>,
    model: Model,
    clearance: Clearance,
    zones: Clearance,
    names: Names,
    reference_generator: ReferenceGenerator<'a>,
    root_from_links: Vec<Isometry3<f64>>,
    errors: Vec<PoseError>,
    hash: Sha256,
}

impl std::fmt::Debug for Run<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Run")
            .field("scenario", &self.scenario.name)
            .field("steps", &self.world.step_count())
            .finish_non_exhaustive()
    }
}

impl<'a> Run<'a> {
    /// Builds world and model and places the robot at the start.
    ///
    /// # Errors
    /// [`RunError`] where the robot cannot be simulated.
    pub fn new(scenario: &'a Scenario) -> Result<Self, RunError> {
        let robot = &scenario.description.robot;
        let settings = WorldSettings {
            step_s: scenario.simulation.step_s,
            gravity_in_world: scenario.simulation.gravity_in_world,
            obstacles: scenario.obstacles.clone(),
            contacts: true,
        };
        let mut world = World::new(robot, &settings)?;
        world.set_state(&scenario.start, &vec![0.0; robot.dof()])?;
        let clearance = Clearance::new(&scenario.description, &scenario.obstacles, PairChoice::Usual)?;
        let zones = clearance.before_zones(&scenario.zones)?;
        Ok(Self {
            scenario,
            world,
            controller: controller(&scenario.controller.kind, scenario.controller.gains)?,
            model: Model::new(&scenario.description)?,
            names: Names::new(robot, &clearance, &zones),
            clearance,
            zones,
            reference_generator: ReferenceGenerator::new(&scenario.trajectory, &scenario.description)?,
            root_from_links: vec![Isometry3::identity(); robot.links().len()],
            errors: vec![PoseError::default(); robot.links().len()],
            hash: Sha256::new(),
        })
    }

    /// What is run.
    pub fn scenario(&self) -> &'a Scenario {
        self.scenario
    }

    /// Names for the numbers of samples.
    pub fn names(&self) -> &Names {
        &self.names
    }

    /// The analytical side.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// One step of physics towards the motion's next point, which may depend on where the robot is.
    ///
    /// # Errors
    /// [`RunError::Simulation`] when the physics breaks.
    pub fn step(&mut self) -> Result<(), RunError> {
        let time_s = self.scenario.simulation.time_s(self.world.step_count() + 1);
        self.reference_generator.advance(time_s, self.world.q())?;
        let reference = Setpoint { q: self.reference_generator.q(), qd: self.reference_generator.qd() };
        Ok(self.world.step(&mut *self.controller, &reference)?)
    }

    /// Poses of all links by both witnesses at this instant, and how far they are apart.
    ///
    /// # Errors
    /// [`KinematicsError`] never comes once [`Run::new`] has succeeded.
    pub fn compare(&mut self) -> Result<(), KinematicsError> {
        self.world.root_from_links_into(&mut self.root_from_links);
        let model: &[Pose] = self.model.root_from_links(self.world.q())?;
        for ((error, model), twin) in self.errors.iter_mut().zip(model).zip(&self.root_from_links) {
            *error = PoseError::to_isometry(model, twin);
        }
        Ok(())
    }

    /// Shows this instant to all checks and to the recorder; gives the number of the check that ends
    /// the run here, where one does.
    ///
    /// # Errors
    /// [`RunError::Recording`] when the recorder cannot write.
    pub fn observe(
        &mut self,
        checks: &mut [Check],
        recorder: &mut dyn Recorder,
    ) -> Result<Option<usize>, RunError> {
        self.clearance.move_links(&self.root_from_links);
        self.zones.move_links(&self.root_from_links);
        let step = self.world.step_count();
        let mut sample = Sample {
            step,
            time_s: self.scenario.simulation.time_s(step),
            is_last: step >= self.scenario.simulation.steps,
            q: self.world.q(),
            model: self.model.latest(),
            twin: &self.root_from_links,
            errors: &self.errors,
            clearance: &mut self.clearance,
            zones: &mut self.zones,
        };
        for check in checks.iter_mut() {
            check.monitor.observe(&mut sample);
        }
        let stopping = checks.iter().position(Check::stops);
        sample.is_last |= stopping.is_some();
        for q in sample.q {
            self.hash.update(q.to_le_bytes());
        }
        recorder.record(&mut sample)?;
        Ok(stopping)
    }

    /// Runs to the end, or to the first violation of a check that stops the run. What was found before
    /// an error is in the results all the same.
    pub fn finish(
        mut self,
        checks: &mut [Check],
        recorder: &mut dyn Recorder,
        mut progress: impl FnMut(u64),
    ) -> (Outcome, Result<(), RunError>) {
        let end = self.scenario.simulation.steps;
        let mut stopping = None;
        let mut go = || -> Result<(), RunError> {
            self.compare()?;
            stopping = self.observe(checks, recorder)?;
            while stopping.is_none() && self.world.step_count() < end {
                self.step()?;
                self.compare()?;
                stopping = self.observe(checks, recorder)?;
                progress(self.world.step_count());
            }
            Ok(())
        };
        let result = go();
        let (servos, result) = match self.reference_generator.finish(self.world.q()) {
            Ok(servos) => (servos, result),
            Err(error) => (Vec::new(), result.and(Err(error.into()))),
        };
        let steps = self.world.step_count();
        let mut results: Vec<CheckResult> = checks.iter().map(|check| check.result(&self.names)).collect();
        let outcome = Outcome {
            stopped: stopping.map(|index| stopped_by(&mut results[index], self.scenario, steps)),
            checks: results,
            steps,
            servos,
            trajectory_sha256: hex(&self.hash.finalize()),
        };
        (outcome, result)
    }
}

/// Where a run stands after `step` steps, ended by a check; its result tells people so.
fn stopped_by(result: &mut CheckResult, scenario: &Scenario, step: u64) -> Stop {
    let (time_s, steps) = (scenario.simulation.time_s(step), scenario.simulation.steps);
    result.notes.push(format!("stopped the run at {time_s:.3} s, after {step} of {steps} steps"));
    Stop { check: result.check, line: result.line, step, time_s }
}

fn hex(bytes: &[u8]) -> String {
    use std::fmt::Write;
    bytes.iter().fold(String::new(), |mut text, byte| {
        write!(text, "{byte:02x}").expect("a String takes every byte");
        text
    })
}
