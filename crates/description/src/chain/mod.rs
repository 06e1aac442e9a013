//! The chain of a robot, from base to tip: which one is taken if none is declared, and how that is reported.

mod branching;
mod frame_name;
mod reported;

pub(crate) use branching::choose_tip;
pub use reported::{ChainEnd, ChainEnds, ReportedChain};
