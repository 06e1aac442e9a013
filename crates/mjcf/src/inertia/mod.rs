//! Mass and inertia of bodies: as a file states them, or from geoms as MuJoCo 4.0 computes them.

mod body;
mod mesh;
mod primitive;
mod tensor;

pub use body::{MjMassProperties, moving_body_without_mass};
pub use mesh::{MeshMass, mesh_mass};
pub(crate) use tensor::{is_possible, moments};
