//! A motion that shows the parameters of a robot: within its limits, and with the largest information of all that were tried.
//!
//! Source: Swevers, Ganseman, Tükel, De Schutter, Van Brussel, *Optimal robot excitation and identification* (1997): sums of sines, and
//! the determinant of the information. The search is a random one with refinement, so that limits of any kind can stop a candidate.

mod fourier;
mod search;

pub use fourier::FourierMotion;
pub use search::{Excitation, ExcitationError, ExcitationLimits, ExcitationOptions, PlannedError, excite};
