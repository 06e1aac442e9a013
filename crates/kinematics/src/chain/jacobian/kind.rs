//! The three kinds of Jacobians.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::spatial::{pose::Pose, twist::Twist};

/// The kind of a Jacobian of a link. The three kinds differ in the axes of a column and in the
/// point whose velocity its linear part is.
///
/// | kind | axes | linear part is the velocity of |
/// |---|---|---|
/// | `Space` | root | the point of the link that passes the root's origin |
/// | `Body` | link | the link's origin |
/// | `Geometric` | root | the link's origin |
///
/// Source: Lynch & Park, *Modern Robotics* (2017), eq. 5.11 and 5.18; Siciliano et al., *Robotics*
/// (2009), section 3.1 for the geometric one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JacobianKind {
    /// Space twist: axes and reference point of the root.
    Space,
    /// Body twist: axes and reference point of the link.
    Body,
    /// Axes of the root, reference point of the link.
    Geometric,
}

impl JacobianKind {
    /// A body twist of the link, as a column of this kind.
    #[inline]
    pub(crate) fn column_from_body_twist(self, body: &Twist, root_from_link: &Pose) -> Twist {
        // Geometric turns the axes and keeps the reference point; Space also moves the reference point (adjoint).
        let turn = &root_from_link.rotation;
        match self {
            Self::Body => *body,
            Self::Geometric => Twist { angular: turn * body.angular, linear: turn * body.linear },
            Self::Space => body.transformed_by(root_from_link),
        }
    }
}
