//! Do two kinematic models describe the same robot? One rung of the answer in each file.

mod certificate;

pub use certificate::{Bracket, Budget, Certificate, certify, certify_driven};
