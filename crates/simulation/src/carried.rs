//! What a link carries.

use congruent_description::{Inertia, LinkIndex};

/// A body that a link carries from now on, in addition to its own mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CarriedBody {
    /// The link that carries it.
    pub link: LinkIndex,
    /// Its inertia, in the frame of the link.
    pub inertia: Inertia,
}
