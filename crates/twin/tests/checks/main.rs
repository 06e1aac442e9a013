//! Every check of a run: it passes on a correct run, and fails for the right reason on a wrong one. What is wrong is made
//! by running the physics of another robot than the declared one, or by changing what a source says.

#![expect(clippy::float_cmp, reason = "times of samples, and a share at its limit, are exact")]

mod forces;
mod joints;
mod pose;
mod space;
mod stop;
mod support;
