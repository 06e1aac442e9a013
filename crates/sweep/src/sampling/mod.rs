//! Points in the unit cube, one for each case: any of them by its number alone, so that a sweep can be cut anywhere.

mod normal;
mod permutation;
mod point;
mod sobol;

pub(crate) use normal::normal_quantile;
pub(crate) use point::PointSource;
pub(crate) use sobol::MOST_DIMENSIONS;
