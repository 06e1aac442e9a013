//! Joint torques of two sides, and what their difference can be explained by.

pub(crate) mod compressed;
pub(crate) mod least_squares;
pub(crate) mod states;

pub use compressed::SeenNumbers;
pub use states::{State, random_states};
