//! The comparison as data and in words.

mod compare_descriptions;
mod compare_long;
mod compare_with_source;
mod content;
mod explained;
mod link_by_link;
mod places;
mod told;
mod unmatched;
mod words;

pub use compare_descriptions::{CompareError, certify, compare};
pub use compare_with_source::compare_with_source;
pub use content::{
    DynamicsExplanation, DynamicsPremise, DynamicsReport, DynamicsVerdict, PlacedCause, Sides,
    TorqueCertificates,
};
pub use places::ParameterPlaces;
pub use told::NamedSide;
