//! A diagnosis in names, lines and values of the robot file.

mod advice;
mod as_written;
mod content;
mod describe;
mod diagnose_models;
mod exchanged;
mod fault_message;
mod joint_advice;
mod joint_parts;
mod mimic;
mod names;
mod preferred;
mod reference;
mod signs;
mod statement;
mod table;
mod typed_values;
mod units;
mod values;

pub use content::{
    ComparedValue, CorrectedFile, Fault, ReportedAlternative, ReportedCause, ReportedDiagnosis,
    ReportedDifference, ReportedStage, TableComparison,
};
pub use diagnose_models::diagnose_models;
pub(crate) use diagnose_models::{digits_of_table, screw_differences};
pub(crate) use joint_parts::{diagnosed_by_joints, may_be_unit};
pub(crate) use mimic::{FollowedJoint, Relation, with_mimics};
pub use statement::foremost;
pub use values::ReportedValue;
