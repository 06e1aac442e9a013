//! Why distances cannot be measured.

/// Why a shape has no hull.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ProximityError {
    /// All vertices lie on a line or in a point. A mesh in a plane has a hull: a plate without
    /// thickness.
    #[error(
        "{subject}: the mesh has no convex hull, since its vertices lie on one line or in one point; correct the mesh or \
         remove its <collision>"
    )]
    NoHull {
        /// Kind and name of the link or obstacle: `link "forearm"`.
        subject: String,
    },
}
