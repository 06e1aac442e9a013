//! Fits of hypotheses: the free parameters by least squares at one generic configuration.

pub(super) mod evaluation_point;
pub(super) mod hypothesis_fit;
pub(super) mod least_squares;
