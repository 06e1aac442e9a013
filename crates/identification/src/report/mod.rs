//! What was identified, by names, with units and with the lines to write.

mod assemble;
mod identification_report;
mod lines;

pub use assemble::{Identification, identification_report, term_unit};
pub use identification_report::{
    CombinedJoint, IdentificationReport, IdentificationVerdict, ReportedBody, ReportedEffort, ReportedJoint,
    ReportedTerm, ReportedValue, TorqueConstant, WrittenLines,
};
pub use lines::edited_text;
