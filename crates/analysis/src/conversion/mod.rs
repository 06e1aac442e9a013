//! One model of a chain written as another: standard and modified tables, screws, URDF. Every
//! conversion is proved by comparing the result with its source.

mod convert;
mod converted_model;
mod options;
mod remarks;
mod report;
mod tree;

pub use convert::convert;
pub use options::{Conversion, ConversionSource, ConversionTarget, DEFAULT_ACCURACY, RoundedAxes};
pub use report::{
    AxisReport, ChoiceReport, ConversionReport, PoeReport, ProofReport, RoundedReport, RowReport,
    ScrewReport, TableReport,
};
