//! What couples bodies and joints beside the tree: equalities, tendons, excluded contacts; and keyframes.

use super::written::{MjPlace, MjWritten};

/// What an equality holds equal.
#[derive(Debug, Clone, PartialEq)]
pub enum MjEqualityKind {
    /// `q1 - ref1 = c0 + c1 x + c2 x^2 + c3 x^3 + c4 x^4` with `x = q2 - ref2`; without a second joint, `q1 - ref1 = c0`.
    Joint {
        /// The joint that follows.
        follower: usize,
        /// The joint that it follows.
        leader: Option<usize>,
        /// The coefficients.
        coefficients: MjWritten<[f64; 5]>,
    },
    /// A point of two bodies, as in a ball joint.
    Connect {
        /// The two bodies; the second may be the world.
        bodies: [usize; 2],
    },
    /// The relative pose of two bodies.
    Weld {
        /// The two bodies; the second may be the world.
        bodies: [usize; 2],
    },
    /// Lengths of one or two tendons.
    Tendon {
        /// The tendons.
        tendons: Vec<usize>,
    },
}

/// An equality constraint.
#[derive(Debug, Clone, PartialEq)]
pub struct MjEquality {
    /// Name; empty if the file has none.
    pub name: String,
    /// What it holds equal.
    pub kind: MjEqualityKind,
    /// Whether it holds at the start.
    pub is_active: bool,
    /// The opening of its tag.
    pub place: MjPlace,
}

/// A tendon.
#[derive(Debug, Clone, PartialEq)]
pub struct MjTendon {
    /// Name; empty if the file has none.
    pub name: String,
    /// Joints and coefficients whose sum is its length; empty for a tendon in space.
    pub joints: Vec<(usize, f64)>,
    /// The opening of its tag.
    pub place: MjPlace,
}

/// Two bodies whose contacts are excluded.
#[derive(Debug, Clone, PartialEq)]
pub struct MjContactExclusion {
    /// The bodies.
    pub bodies: [usize; 2],
    /// The opening of its tag.
    pub place: MjPlace,
}

/// A configuration that the file names.
#[derive(Debug, Clone, PartialEq)]
pub struct MjKeyframe {
    /// Name; empty if the file has none.
    pub name: String,
    /// Positions of all joints, in their order, rad and m, quaternions w first; `None` if the file gives none.
    pub positions: Option<MjWritten<Vec<f64>>>,
}
