//! Models against what MuJoCo 4.0.0 says about them. The goldens are in a folder beside the project; without it the tests
//! pass and say what they left out.

#![expect(clippy::unwrap_used, reason = "a test that lacks what it compares with must fail")]

mod constructs;
mod kinematics;
mod robots;
mod shared;
