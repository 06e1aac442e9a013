//! COLLADA: the scene as one list of triangles.
//!
//! Of the asset's settings `<unit meter>` is applied and `<up_axis>` is not: ROS tools ignore it,
//! and robot meshes are modelled in the axes of their link whatever it says. Nodes carry their
//! transforms and instances; materials, skins and animations mean nothing to a rigid link.

mod geometry;
mod node;
mod scene;

pub(super) use scene::parse;

#[cfg(test)]
mod tests;
