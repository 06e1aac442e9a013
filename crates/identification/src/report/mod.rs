//! What was identified, by names, with units and with the lines to write.

mod assemble;
mod identification_report;
mod lines;
mod names;

pub use assemble::{IdentificationParts, identification_report};
pub use identification_report::{
    BodyReport, EffortReport, IdentificationReport, IdentificationVerdict, IdentifiedJointReport,
    IndistinctTerms, TermReport, TorqueConstant, ValueWithError, WrittenLines,
};
pub use lines::edited_text;
pub use names::term_unit;
