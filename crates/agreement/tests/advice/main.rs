//! What a check advises: put into the robot file as it stands, it makes table and URDF agree; and faults that come
//! together are named in turn, the one with the largest effect first.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

mod inline_arms;
mod pasting;
mod robots;
mod stages;
mod typed_sheets;
