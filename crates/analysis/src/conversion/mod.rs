//! One model of a chain written as another: standard and modified tables, screws, URDF; and whole robots as URDF and MJCF. Every
//! conversion is proved by comparing the result with its source.

mod convert;
mod converted_model;
mod options;
mod remarks;
mod report;
mod tree;
mod whole;

pub use convert::convert;
pub use options::{
    Conversion, ConversionSource, ConversionTarget, DEFAULT_ACCURACY, Destination, RoundedAxes,
};
pub use report::{
    AxisReport, ChoiceReport, ConversionReport, PoeReport, ProofReport, RoundedReport, RowReport,
    ScrewReport, TableReport,
};
pub use whole::convert_robot;
