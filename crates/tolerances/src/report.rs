//! The answer of `congruent tolerances`.

use congruent_description::{JointValues, ReportedChain};
use congruent_input::Finding;
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    first_order::FirstOrderError,
    monte_carlo::MonteCarloError,
    ranking::{Halving, ParameterShare},
};

/// The answer of `congruent tolerances`: SI units and radians.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ToleranceReport {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// Where the tolerances are from.
    pub source: ToleranceSource,
    /// Standard deviations of a tolerance, if the errors are normal; without it they are uniform within the tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sigmas: Option<f64>,
    /// Where the error is computed.
    pub configurations: ConfigurationsOfStudy,
    /// Seed of the draws and of the random configurations.
    pub seed: u64,
    /// Over all configurations, each as likely as the others.
    pub overall: ErrorLevels,
    /// At the configuration with the largest 99.7 % quantile of the distance, to first order.
    pub worst: WorstConfiguration,
    /// At the configuration with the largest 99.7 % quantile of the angle, to first order.
    pub worst_orientation: WorstConfiguration,
    /// All parameters within their tolerances at once, as bad as possible.
    pub worst_case: WorstCase,
    /// Every parameter with a tolerance, the largest share of the variance first.
    pub parameters: Vec<ParameterShare>,
    /// Halvings one after another, each of the parameter with the largest share then.
    pub halvings: Vec<Halving>,
    /// The errors at each given configuration, in the order of the file; none of random ones.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<ConfigurationError>,
    /// Whether the error is within what was required; none if nothing was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub requirement: Option<Requirement>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// Where tolerances are from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ToleranceSource {
    /// `[tolerances]` of the robot file.
    RobotFile,
    /// The options of the call.
    Options,
    /// The covariance of a calibration.
    Calibration,
    /// Half of the last place of each value that is written.
    Digits,
}

/// The configurations of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ConfigurationsOfStudy {
    /// Who chose them.
    pub chosen: ChosenBy,
    /// How many.
    pub count: usize,
}

/// Who chose the configurations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ChosenBy {
    /// They are given.
    Given,
    /// Random ones within the joint ranges.
    Random,
}

/// An error by both methods.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ErrorLevels {
    /// By derivatives.
    pub first_order: FirstOrderError,
    /// By draws of all parameters, without linearisation.
    pub monte_carlo: MonteCarloError,
    /// Difference of the two root mean squares of the distance in standard errors of Monte Carlo; up to 3 is chance.
    pub standard_errors_apart: f64,
}

/// The error at the configuration where the 99.7 % quantile of the distance, or of the angle, is largest.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct WorstConfiguration {
    /// The errors there.
    #[serde(flatten)]
    pub levels: ErrorLevels,
    /// The configuration, rad or m.
    pub at: JointValues,
}

/// All parameters within their tolerances, as bad as possible.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct WorstCase {
    /// A distance that parameters within their tolerances attain, m: as a rule at the ends of these.
    pub attained_m: f64,
    /// No parameters within their tolerances move the tool farther, m: at a configuration of the joint range, or at those that are
    /// given.
    pub certified_m: f64,
    /// An angle that such parameters attain, rad.
    pub attained_rad: f64,
    /// No parameters within their tolerances turn the tool farther, rad.
    pub certified_rad: f64,
    /// The configuration of `attained_m`, rad or m.
    pub at: JointValues,
}

/// The error at one of the given configurations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ConfigurationError {
    /// To first order.
    pub first_order: FirstOrderError,
    /// No parameters within their tolerances move the tool farther here, m.
    pub certified_m: f64,
    /// No parameters within their tolerances turn the tool farther here, rad.
    pub certified_rad: f64,
}

/// Whether the error is within what was required.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Requirement {
    /// The largest distance that is allowed, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_m: Option<f64>,
    /// The largest angle that is allowed, rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation_rad: Option<f64>,
    /// The distance that is compared, m: the largest of the 99.7 % quantiles of Monte Carlo over all configurations, at the worst
    /// one for the distance, and at the worst one for the angle.
    pub p997_m: f64,
    /// The angle that is compared, likewise, rad.
    pub p997_rad: f64,
    /// The verdict.
    pub verdict: ToleranceVerdict,
}

/// Whether tolerances are tight enough.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ToleranceVerdict {
    /// Even the certified worst case is within the requirement.
    Certified,
    /// The 99.7 % quantile is within the requirement; the certified worst case is not.
    Within,
    /// The 99.7 % quantile exceeds the requirement.
    Exceeded,
}

impl WorstCase {
    /// The same with the largest errors that were drawn within the tolerances: of large ones the worst need not be at their ends.
    pub(crate) fn or_drawn(self, drawn: [&WorstConfiguration; 2]) -> Self {
        let with = |worst: Self, of: &WorstConfiguration| {
            let MonteCarloError { largest_m, largest_rad, .. } = of.levels.monte_carlo;
            let attained_rad = worst.attained_rad.max(largest_rad);
            if largest_m > worst.attained_m {
                Self { attained_m: largest_m, attained_rad, at: of.at.clone(), ..worst }
            } else {
                Self { attained_rad, ..worst }
            }
        };
        drawn.into_iter().fold(self, with)
    }

    /// The same with what is certified at given configurations, if there are some: no bound over the whole range is tighter.
    pub(crate) fn or_largest_of(self, at: &[ConfigurationError]) -> Self {
        if at.is_empty() {
            return self;
        }
        let largest = |value: fn(&ConfigurationError) -> f64| at.iter().map(value).fold(0.0, f64::max);
        let (certified_m, certified_rad) = (largest(|of| of.certified_m), largest(|of| of.certified_rad));
        Self { certified_m, certified_rad, ..self }
    }
}

/// The largest 99.7 % quantile of Monte Carlo among these errors: of the distance, m, and of the angle, rad.
pub(crate) fn largest_p997(levels: [&ErrorLevels; 3]) -> [f64; 2] {
    let largest = |value: fn(&MonteCarloError) -> f64| {
        levels.iter().map(|of| value(&of.monte_carlo)).fold(0.0, f64::max)
    };
    [largest(|of| of.p997_m), largest(|of| of.p997_rad)]
}

impl ToleranceReport {
    /// The 99.7 % quantiles that a requirement is compared with: of the distance, m, and of the angle, rad.
    pub fn largest_p997(&self) -> [f64; 2] {
        largest_p997([&self.overall, &self.worst.levels, &self.worst_orientation.levels])
    }
}

impl Requirement {
    /// Compares what is required with what was found.
    pub(crate) fn judge(
        position_m: Option<f64>,
        orientation_rad: Option<f64>,
        [p997_m, p997_rad]: [f64; 2],
        worst_case: &WorstCase,
    ) -> Self {
        let is_within = |metres: f64, radians: f64| {
            position_m.is_none_or(|most| metres <= most) && orientation_rad.is_none_or(|most| radians <= most)
        };
        let verdict = if !is_within(p997_m, p997_rad) {
            ToleranceVerdict::Exceeded
        } else if is_within(worst_case.certified_m, worst_case.certified_rad) {
            ToleranceVerdict::Certified
        } else {
            ToleranceVerdict::Within
        };
        Self { position_m, orientation_rad, p997_m, p997_rad, verdict }
    }
}
