//! Chains and trees of joints: tables, screws, URDF trees, the fast serial chain, and their Jacobians.
//!
//! | type | made from | positions | purpose |
//! |---|---|---|---|
//! | [`DhChain`] | a declared table and its robot | `RobotQ` | the frames of the table itself, its equation row by row; derivatives by every parameter |
//! | [`SerialDh`] | a table, or the axes of a chain | `ChainQ` | a table as data, without a robot: converts between conventions and to screws; for writing, not for loops |
//! | [`ScrewChain`] | any forward kinematics | `ChainQ` | screws and home pose: the form in which two models are equal or not |
//! | [`UrdfTree`] | a description | `RobotQ` | all links, joint after joint as the description writes them; Jacobians |
//! | [`ScrewTree`] | a description | `RobotQ` | all links, by products of exponentials and the platform's sine: a path of its own to the same poses |
//! | [`SerialChain`] | any of these | `ChainQ` | speed: tip and Jacobian in one pass, batches; no frames between |
//!
//! [`StandardDh`] and [`ModifiedDh`] are the equations of one row and its inverse; a row as data is
//! `congruent_description::DhRow`. Private to `serial/`: a path of joints with constants between them, from which
//! [`SerialChain`] is built.

pub(crate) mod axes;
pub(crate) mod dh;
pub(crate) mod jacobian;
pub(crate) mod proof;
pub(crate) mod screws;
pub(crate) mod serial;
pub(crate) mod sin_cos;
pub(crate) mod urdf;

pub use axes::Axes;
pub use dh::{
    AxisPair, AxisRelation, Choice, DeriveError, DhChain, DhDerivation, DhDerivatives, DhFrames, DhRowTwists,
    FreeChoice, ModifiedDh, NotADhTransform, ROUNDED_M, ROUNDED_RAD, RoundedPair, SerialDh, StandardDh,
    derive_dh, without_rounding,
};
pub use jacobian::{Jacobian, JacobianKind};
pub use proof::Proof;
pub use screws::{chain::ScrewChain, derivatives::ScrewDerivatives, tree::ScrewTree};
pub use serial::chain::SerialChain;
pub use sin_cos::SinCos;
pub use urdf::UrdfTree;
