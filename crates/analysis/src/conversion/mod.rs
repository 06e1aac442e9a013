//! One model of a chain written as another: standard and modified tables, screws, URDF. Every
//! conversion is proved by comparing the result with its source.

mod convert;
mod converted_model;
mod options;
mod report;
mod tree;

pub use convert::convert;
pub use options::{Conversion, ConversionSource, ConversionTarget, DEFAULT_ACCURACY};
pub use report::{
    AxisReport, ChoiceReport, ConversionReport, PoeReport, ProofReport, RowReport, ScrewReport, TableReport,
};
