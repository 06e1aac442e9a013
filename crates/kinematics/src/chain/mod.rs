//! Chains and trees of joints: tables, screws, URDF trees, the fast serial chain, and their Jacobians.

pub(crate) mod dh;
pub(crate) mod jacobian;
pub(crate) mod proof;
pub(crate) mod screws;
pub(crate) mod serial;
pub(crate) mod sin_cos;
pub(crate) mod urdf;

pub use dh::{
    Axes, AxisPair, AxisRelation, Choice, DeriveError, DhChain, DhDerivation, DhDerivatives, DhFrames,
    DhRowTwists, FreeChoice, ModifiedDh, NotADhTransform, SerialDh, SerialDhRow, StandardDh, derive_dh,
};
pub use jacobian::{Jacobian, JacobianKind};
pub use proof::Proof;
pub use screws::{chain::ScrewChain, derivatives::ScrewDerivatives, tree::ScrewTree};
pub use serial::chain::SerialChain;
pub use sin_cos::SinCos;
pub use urdf::UrdfTree;
