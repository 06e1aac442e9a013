//! Why links and joints form no robot; `tree.rs` finds it out.

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
        /// The name.
        link: String,
    },
    /// Two joints share a name.
    #[error("duplicate joint name \"{joint}\"")]
    DuplicateJoint {
        /// The name.
        joint: String,
    },
    /// A joint names a link that does not exist.
    #[error("joint \"{joint}\": {role} link \"{link}\" not found")]
    UnknownLink {
        /// The joint.
        joint: String,
        /// `parent` or `child`.
        role: &'static str,
        /// The name that is not there.
        link: String,
        /// All links.
        known: Vec<String>,
    },
    /// A joint connects a link with itself.
    #[error("joint \"{joint}\": parent and child are the same link \"{link}\"")]
    SelfJoint {
        /// The joint.
        joint: String,
        /// The link.
        link: String,
    },
    /// A link is the child of two joints.
    #[error(
        "link \"{link}\" already has a parent: it is the child of joint \"{first}\" and of joint \"{second}\""
    )]
    TwoParents {
        /// The link.
        link: String,
        /// The first joint.
        first: String,
        /// The second joint.
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
        /// The joint.
        joint: String,
        /// The name that is not there.
        target: String,
        /// All moving joints.
        known: Vec<String>,
    },
    /// A joint mimics itself, directly or through others.
    #[error("joint \"{joint}\" mimics itself{}", if .through.is_empty() { String::new() } else { format!(" through {}", .through.join(", ")) })]
    MimicLoop {
        /// The joint.
        joint: String,
        /// The joints between.
        through: Vec<String>,
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
            | Self::MimicLoop { joint, .. } => Some(joint),
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
