//! Compares the sizes of meshes and shapes with each other.

use congruent_description::{Geometry, Shape};
use congruent_input::{display::length, units::LARGEST_PLAUSIBLE_M};

use super::{
    UnitCheck, UnitMistake,
    features::{diagonal_m, median},
    thresholds::{
        LEAST_LARGE_SHAPE_M, LEAST_MESH_M, LEAST_MESH_TO_MEDIAN, MOST_SHAPE_TO_MEDIAN, MOST_SHAPE_TO_ORIGINS,
    },
};
use crate::codes;

const SMALL: UnitMistake = UnitMistake {
    code: codes::units::SMALL_MESH,
    words: "links have a mesh that is far too small",
    element: "",
};
const LARGE: UnitMistake = UnitMistake {
    code: codes::units::LARGE_SHAPE,
    words: "links have a shape that is far too large",
    element: "",
};

/// The kind of link that a shape belongs to, by which its size is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ShapeOwner {
    /// The root link: compared with the other shapes only, since a floor is attached to the root.
    Root,
    /// A large link: not compared, since its mass and inertia confirm its size.
    Large,
    /// Any other link: compared with the other shapes and with the sum of all joint origins.
    Other,
}

/// A shape of a link with its size.
struct Measured<'a> {
    link: &'a str,
    is_mesh: bool,
    owner: ShapeOwner,
    diagonal_m: f64,
}

fn is_mesh(shape: &Shape) -> bool {
    matches!(shape.geometry, Geometry::Mesh(_))
}

impl UnitCheck<'_> {
    pub(super) fn shapes(&mut self) {
        let (robot, large) = (self.robot, &self.large);
        let measured: Vec<Measured<'_>> = robot
            .link_indices()
            .flat_map(|index| {
                let link = robot.link(index);
                let shapes = link.visuals.iter().chain(&link.collisions);
                shapes.filter_map(move |shape| {
                    let diagonal_m = diagonal_m(shape).filter(|diagonal| *diagonal > 0.0)?;
                    let owner = match large.get(index) {
                        Some(_) => ShapeOwner::Large,
                        None if index == robot.root() => ShapeOwner::Root,
                        None => ShapeOwner::Other,
                    };
                    Some(Measured { link: &link.name, is_mesh: is_mesh(shape), owner, diagonal_m })
                })
            })
            .collect();
        let meshes = || measured.iter().filter(|shape| shape.is_mesh);
        let middle_mesh_m = median(meshes().map(|shape| shape.diagonal_m)).unwrap_or(0.0);
        let has_several = meshes().count() >= 3;
        let middle_m = median(measured.iter().map(|shape| shape.diagonal_m)).unwrap_or(0.0);
        let mut reported_link = "";
        for shape in &measured {
            let size_m = shape.diagonal_m;
            let is_small = shape.is_mesh
                && (size_m < LEAST_MESH_M || (has_several && size_m < LEAST_MESH_TO_MEDIAN * middle_mesh_m));
            // Larger meshes were reported by `urdf/shape.rs` when the file was read.
            let is_reported_elsewhere = shape.is_mesh && size_m > LARGEST_PLAUSIBLE_M;
            let against_shapes = shape.owner != ShapeOwner::Large
                && measured.len() >= 3
                && size_m > MOST_SHAPE_TO_MEDIAN * middle_m;
            let against_origins = shape.owner == ShapeOwner::Other
                && self.sizes.origins_m > 0.0
                && size_m > MOST_SHAPE_TO_ORIGINS * self.sizes.origins_m;
            let is_large =
                size_m > LEAST_LARGE_SHAPE_M && !is_reported_elsewhere && (against_shapes || against_origins);
            // One message for a link: visuals and collisions mostly have the same mesh.
            if reported_link == shape.link {
                continue;
            }
            if is_small {
                let what = format!("one of its meshes measures only {}", length(size_m));
                let help =
                    "if the mesh file is in metres already, remove scale=\"0.001 0.001 0.001\"".to_owned();
                self.warn_link(&SMALL, shape.link, &what, help);
                reported_link = shape.link;
            } else if is_large {
                let what = format!(
                    "one of its shapes measures {}, but the median shape of the robot {} and all joint origins together {}",
                    length(size_m),
                    length(middle_m),
                    length(self.sizes.origins_m)
                );
                let help = "sizes are read in metres: is the value in centimetres or millimetres?".to_owned();
                self.warn_link(&LARGE, shape.link, &what, help);
                reported_link = shape.link;
            }
        }
    }
}
