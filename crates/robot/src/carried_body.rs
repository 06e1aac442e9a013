//! A body that a link carries.

use super::{inertia::Inertia, link::LinkIndex};

/// A body that a link carries from now on, in addition to its own mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CarriedBody {
    /// Index of the link that carries the body.
    pub link: LinkIndex,
    /// Mass and inertia of the body, in the frame of the link.
    pub inertia: Inertia,
}
