//! Checks of a scenario. A new one is a file here and a line in `KINDS`.

mod agreement;
mod clearance;
mod goal;
mod limits;
mod on_violation;
mod watch;
mod zone;

use congruent_description::{Diagnostic, Robot, RobotDescription};

pub use on_violation::OnViolation;
pub(crate) use zone::NAME as ZONE;

use crate::{
    proximity::Clearance,
    sample::Sample,
    scenario::Section,
    verdict::{CheckResult, Measure, Status},
};

/// A check that looks at every sample of a run.
pub trait Monitor: Send {
    /// Looks at one instant.
    fn observe(&mut self, sample: &mut Sample<'_>);

    /// What was found so far.
    fn finish(&self, names: &Names) -> Findings;

    /// Whether the check has failed already.
    fn has_failed(&self) -> bool;

    /// The settings with every default written out, as they go into the resolved scenario.
    fn resolved(&self) -> toml::Table;
}

/// What a monitor found, before it is known which check of which file it belongs to.
#[derive(Debug, Clone, PartialEq)]
pub struct Findings {
    /// Instants looked at.
    pub samples: u64,
    /// The quantities with their limits.
    pub measures: Vec<Measure>,
    /// What to know beside the figures.
    pub notes: Vec<String>,
}

/// Names that turn numbers of a sample into words.
#[derive(Debug, Clone, PartialEq)]
pub struct Names {
    /// Links, in the robot's order.
    pub links: Vec<String>,
    /// Movable joints, in the order of configuration vectors.
    pub joints: Vec<String>,
    /// Watched pairs, as `a--b`.
    pub pairs: Vec<String>,
    /// Links with the zones that are forbidden to them, as `link--zone`.
    pub zones: Vec<String>,
}

impl Names {
    /// The names of a robot, of the pairs that are watched around it, and of its zones.
    pub fn new(robot: &Robot, clearance: &Clearance, zones: &Clearance) -> Self {
        let pair = |index| {
            let (a, b) = clearance.names(index);
            format!("{a}--{b}")
        };
        let in_zone = |index| {
            let (zone, link) = zones.names(index);
            format!("{link}--{zone}")
        };
        Self {
            links: robot.links().iter().map(|link| link.name.clone()).collect(),
            joints: robot.movable_joint_names().map(str::to_owned).collect(),
            pairs: (0..clearance.pairs().len()).map(pair).collect(),
            zones: (0..zones.pairs().len()).map(in_zone).collect(),
        }
    }
}

/// Reads the section of a check; the robot gives names, limits and tolerances.
type Parse = fn(Section<'_>, &RobotDescription) -> Result<Box<dyn Monitor>, Vec<Diagnostic>>;

/// How one kind of check is made from its section of a scenario file.
struct Kind {
    name: &'static str,
    parse: Parse,
}

/// Every kind of check.
const KINDS: &[Kind] = &[
    Kind { name: agreement::NAME, parse: agreement::parse },
    Kind { name: clearance::NAME, parse: clearance::parse },
    Kind { name: goal::NAME, parse: goal::parse },
    Kind { name: limits::NAME, parse: limits::parse },
    Kind { name: zone::NAME, parse: zone::parse },
];

/// A check of a scenario: a monitor with its place in the file.
pub struct Check {
    /// The kind, as the scenario names it.
    pub kind: &'static str,
    /// Line of its section, from 1.
    pub line: usize,
    /// What follows its first violation.
    pub on_violation: OnViolation,
    /// What looks at the samples.
    pub monitor: Box<dyn Monitor>,
}

impl std::fmt::Debug for Check {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Check").field("kind", &self.kind).field("line", &self.line).finish_non_exhaustive()
    }
}

impl Check {
    /// Makes the check that a `[[check]]` section asks for.
    ///
    /// # Errors
    /// Diagnostics at the section's kind or at the keys that are wrong.
    pub fn parse(mut section: Section<'_>, description: &RobotDescription) -> Result<Self, Vec<Diagnostic>> {
        let line = section.line();
        let kind = section.select("kind", "check", KINDS, |kind| kind.name)?;
        let on_violation = OnViolation::take(&mut section)?;
        let monitor = (kind.parse)(section, description).map_err(|errors| {
            errors.into_iter().map(on_violation::name_common_keys).collect::<Vec<Diagnostic>>()
        })?;
        Ok(Self { kind: kind.name, line, on_violation, monitor })
    }

    /// Whether the check has failed and ends the run with that.
    pub fn stops(&self) -> bool {
        self.on_violation == OnViolation::Stop && self.monitor.has_failed()
    }

    /// The result of the check.
    pub fn result(&self, names: &Names) -> CheckResult {
        let Findings { samples, measures, notes } = self.monitor.finish(names);
        let status = match samples {
            _ if self.monitor.has_failed() => Status::Fail,
            0 => Status::Skipped,
            _ if measures.iter().all(|measure| measure.worst.is_none()) => Status::Skipped,
            _ => Status::Pass,
        };
        CheckResult { check: self.kind, line: self.line, status, samples, measures, notes }
    }
}

/// Names of all kinds of check.
pub fn kinds() -> impl Iterator<Item = &'static str> + Clone {
    KINDS.iter().map(|kind| kind.name)
}
