//! Scenario files: TOML in, a checked [`Scenario`] out; every diagnostic stands at its line.

mod joint_values;
mod number;
mod obstacle;
mod resolved;
mod section;
mod simulation;
mod written;
mod zone;

use std::path::{Path, PathBuf};

use congruent_description::{Diagnostic, RobotDescription, RobotQ, Severity, load_robot};
use congruent_simulation::{Gains, Obstacle};
use nalgebra::Vector3;

pub(crate) use joint_values::{JointValues, WrittenJoints};
pub use number::{Finite, NonNegative, Positive};
pub use section::Section;
pub use zone::Zone;

use crate::{monitor::Check, motion::Trajectory, verdict::Expectation};

/// The clock and the world of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulationSettings {
    /// Length of a physics step.
    pub step_s: f64,
    /// Number of steps.
    pub steps: u64,
    /// Gravity, in the root link's frame, which is the world.
    pub gravity_in_world: Vector3<f64>,
}

impl SimulationSettings {
    /// Simulated time of the whole run.
    pub fn duration_s(&self) -> f64 {
        self.time_s(self.steps)
    }

    /// Simulated time after a number of steps.
    #[expect(clippy::cast_precision_loss, reason = "steps are bounded far below 2^52")]
    pub fn time_s(&self, steps: u64) -> f64 {
        steps as f64 * self.step_s
    }
}

/// What moves the twin.
#[derive(Debug, Clone, PartialEq)]
pub struct ControllerSettings {
    /// Name of the controller.
    pub kind: String,
    /// Its gains.
    pub gains: Gains,
}

/// A scenario, checked against its robot: nothing downstream validates again.
#[derive(Debug)]
pub struct Scenario {
    /// The file.
    pub path: PathBuf,
    /// Its name.
    pub name: String,
    /// Seed of everything random.
    pub seed: u64,
    /// The robot with its model.
    pub description: RobotDescription,
    /// Clock and world.
    pub simulation: SimulationSettings,
    /// Configuration at the start.
    pub start: RobotQ,
    /// What moves the twin.
    pub controller: ControllerSettings,
    /// What it is asked to do.
    pub trajectory: Trajectory,
    /// What stands around, in the root link's frame.
    pub obstacles: Vec<Obstacle>,
    /// Where named links may not be, in the root link's frame.
    pub zones: Vec<Zone>,
    /// What is looked at.
    pub checks: Vec<Check>,
    /// What must come out.
    pub expect: Expectation,
    /// What is suspicious in the scenario; the robot's own warnings are in its description.
    pub warnings: Vec<Diagnostic>,
}

/// What the command line may change in a scenario.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Overrides {
    /// Another seed.
    pub seed: Option<u64>,
}

/// Largest scenario file that is read.
const MOST_BYTES: u64 = 4 << 20;

impl Scenario {
    /// Reads a scenario file and the robot that it names.
    ///
    /// # Errors
    /// Every finding, when at least one is an error.
    pub fn load(path: &Path, overrides: Overrides) -> Result<Self, Vec<Diagnostic>> {
        let source = congruent_description::read_text(path, MOST_BYTES).map_err(|error| vec![error])?;
        let in_file = |findings: Vec<Diagnostic>| -> Vec<Diagnostic> {
            findings.into_iter().map(|finding| finding.in_file(&source)).collect()
        };
        let document = written::Document::parse(&source.text).map_err(in_file)?;
        let description = match load_robot(&document.robot_path(path)) {
            Ok(description) => description,
            Err(mut findings) => {
                findings.extend(in_file(document.robot_refused()));
                return Err(findings);
            }
        };
        let mut scenario = document.check(path, description, overrides).map_err(in_file)?;
        scenario.warnings = in_file(std::mem::take(&mut scenario.warnings));
        debug_assert!(scenario.warnings.iter().all(|finding| finding.severity == Severity::Warning));
        Ok(scenario)
    }

    /// The scenario as TOML with every default written out; it names the robot by its whole path,
    /// so that it runs from wherever it lies.
    pub fn resolved(&self) -> String {
        resolved::toml(self)
    }
}
