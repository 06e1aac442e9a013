//! Joint torques of two sides, and what their difference can be explained by.

pub(crate) mod compressed;
pub(crate) mod held_out;
pub(crate) mod least_squares;
pub(crate) mod source;
pub(crate) mod states;

pub use compressed::SeenNumbers;
pub use source::{AccelerationSource, Probing};
