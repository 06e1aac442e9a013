//! The reasons why links and joints do not form a robot; `tree.rs` detects them.

use congruent_input::units::LARGEST;

/// Why links and joints do not make a robot.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RobotError {
    /// There is no link at all.
    #[error("the robot has no link")]
    NoLink,
    /// Two links share a name.
    #[error("duplicate link name \"{link}\"")]
    DuplicateLink {
        /// The name that two links have.
        link: String,
    },
    /// Two joints share a name.
    #[error("duplicate joint name \"{joint}\"")]
    DuplicateJoint {
        /// The name that two joints have.
        joint: String,
    },
    /// A joint names a link that does not exist.
    #[error("joint \"{joint}\": {role} link \"{link}\" not found")]
    UnknownLink {
        /// Name of the joint.
        joint: String,
        /// Role of the missing link: `parent` or `child`.
        role: &'static str,
        /// The name that the robot does not have.
        link: String,
        /// Names of all links, for suggestions.
        known: Vec<String>,
    },
    /// A joint connects a link with itself.
    #[error("joint \"{joint}\": parent and child are the same link \"{link}\"")]
    SelfJoint {
        /// Name of the joint.
        joint: String,
        /// Name of the link.
        link: String,
    },
    /// A link is the child of two joints.
    #[error(
        "link \"{link}\" already has a parent: it is the child of joint \"{first}\" and of joint \"{second}\""
    )]
    TwoParents {
        /// Name of the link.
        link: String,
        /// The joint above the link that comes first in the file.
        first: String,
        /// The joint above the link that comes second.
        second: String,
    },
    /// A link is its own ancestor.
    #[error("kinematic loop {}", .links.join(" -> "))]
    Loop {
        /// The links of the loop, the first again at the end.
        links: Vec<String>,
        /// The joint that closes it.
        joint: String,
    },
    /// More than one link has no parent.
    #[error("{} root links: {}; a robot is one connected tree", .roots.len(), .roots.join(", "))]
    SeveralRoots {
        /// The links without a parent.
        roots: Vec<String>,
    },
    /// A joint mimics a joint that does not exist or does not move.
    #[error("joint \"{joint}\": mimicked joint \"{target}\" not found among the moving joints")]
    UnknownMimic {
        /// Name of the joint.
        joint: String,
        /// The name that the robot does not have.
        target: String,
        /// Names of all moving joints, for suggestions.
        known: Vec<String>,
    },
    /// A joint mimics itself, directly or through others.
    #[error("joint \"{joint}\" mimics itself{}", if .through.is_empty() { String::new() } else { format!(" through {}", .through.join(", ")) })]
    MimicLoop {
        /// Name of the joint.
        joint: String,
        /// The joints of the loop after it.
        through: Vec<String>,
    },
    /// A joint follows one that follows another, and its position is too large a multiple of the last one's.
    #[error(
        "joint \"{joint}\": mimic: {what} {value:e} with those of the joints that \"{master}\" follows, limit <= {LARGEST:e}"
    )]
    MimicTooLarge {
        /// Name of the joint.
        joint: String,
        /// The joint that it follows, which follows another.
        master: String,
        /// `multiplier` or `offset`.
        what: &'static str,
        /// The product of the multipliers, or the offset that follows from them.
        value: f64,
    },
}

impl RobotError {
    /// The joint at fault, if it is a joint.
    pub fn joint(&self) -> Option<&str> {
        match self {
            Self::DuplicateJoint { joint }
            | Self::UnknownLink { joint, .. }
            | Self::SelfJoint { joint, .. }
            | Self::Loop { joint, .. }
            | Self::UnknownMimic { joint, .. }
            | Self::MimicLoop { joint, .. }
            | Self::MimicTooLarge { joint, .. } => Some(joint),
            Self::TwoParents { second, .. } => Some(second),
            Self::NoLink | Self::DuplicateLink { .. } | Self::SeveralRoots { .. } => None,
        }
    }

    /// The link at fault, if it is a link.
    pub fn link(&self) -> Option<&str> {
        match self {
            Self::DuplicateLink { link } => Some(link),
            Self::SeveralRoots { roots } => roots.last().map(String::as_str),
            _ => None,
        }
    }
}
