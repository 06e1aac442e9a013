//! The comparison of sources of link poses: without motion, at given configurations, and as chains of
//! screws over the whole joint range.

mod against;
pub(crate) mod basics;
pub(crate) mod certificate;
pub(crate) mod check;
pub(crate) mod check_report;
mod comparing;
mod configurations;
pub(crate) mod diagnosis;
mod differences_at;
pub(crate) mod error;
mod grade;
mod graded;
pub(crate) mod identified;
mod mimic;
pub(crate) mod model;

pub use basics::{Basics, BySource, CoordinateUnit, SingleJointMotion, TcpDisplacement};
pub use certificate::{Brackets, Premise, ReportedBracket, ReportedCertificate};
pub use check::{CheckOptions, RANDOM_CONFIGURATIONS, check};
pub use check_report::{
    Agreement, CheckReport, ComparedSource, Comparison, LinkDifference, NotCompared, TipDifference,
    WorstDifference,
};
pub use diagnosis::diagnose;
pub use differences_at::{DifferenceAt, DifferencesAt};
pub use error::CheckError;
pub use grade::Grade;
pub use model::{Model, PoseSource};
