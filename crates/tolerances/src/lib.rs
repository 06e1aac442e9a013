//! From the tolerance of each parameter of an arm to the error at its tool: distribution to first order and by Monte
//! Carlo, a worst case that holds, and which parameter to tighten.
//!
//! [`declared`], [`calibrated`] and [`written_digits`] make a chain with errors, [`tolerance_study`] answers what they do.

mod calibrated;
pub mod codes;
mod digits;
mod error_chain;
mod farthest_sum;
mod first_order;
mod monte_carlo;
mod norm_quantile;
mod parameters;
mod plot;
mod ranking;
mod report;
mod spread;
mod study;
#[cfg(test)]
mod tests;
mod worst_case;

pub use calibrated::calibrated;
pub use digits::written_digits;
pub use first_order::FirstOrderError;
pub use monte_carlo::MonteCarloError;
pub use parameters::{ToleratedChain, declared, no_tolerances};
pub use plot::plot;
pub use ranking::{Halving, ParameterShare};
pub use report::{
    ChosenBy, ConfigurationError, ConfigurationsOfStudy, ErrorLevels, Requirement, ToleranceReport,
    ToleranceSource, ToleranceVerdict, WorstCase, WorstConfiguration,
};
pub use study::{StudyOptions, tolerance_study};
