//! Sizes of meshes and shapes against each other.

use super::{
    Judge, Kind,
    features::{diagonal_m, median},
    thresholds::{
        LEAST_LARGE_SHAPE_M, LEAST_MESH_M, LEAST_MESH_TO_MEDIAN, MOST_SHAPE_TO_MEDIAN, MOST_SHAPE_TO_ORIGINS,
    },
};
use crate::{
    display::length,
    model::{Geometry, Shape},
    urdf::LARGEST_PLAUSIBLE_M,
};

const SMALL: Kind = Kind { code: "units::small_mesh", words: "links have a mesh that is far too small" };
const LARGE: Kind = Kind { code: "units::large_shape", words: "links have a shape that is far too large" };

/// What the size of a shape is compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Owner {
    /// The shapes of the others: a floor hangs on the root.
    Root,
    /// Nothing: its mass and inertia are as large.
    Large,
    /// The shapes of the others and all joint origins.
    Other,
}

/// A shape of a link.
struct Measured<'a> {
    link: &'a str,
    is_mesh: bool,
    owner: Owner,
    diagonal_m: f64,
}

fn is_mesh(shape: &Shape) -> bool {
    matches!(shape.geometry, Geometry::Mesh(_))
}

impl Judge<'_> {
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
                        Some(_) => Owner::Large,
                        None if index == robot.root() => Owner::Root,
                        None => Owner::Other,
                    };
                    Some(Measured { link: &link.name, is_mesh: is_mesh(shape), owner, diagonal_m })
                })
            })
            .collect();
        let meshes = || measured.iter().filter(|shape| shape.is_mesh);
        let middle_mesh_m = median(meshes().map(|shape| shape.diagonal_m)).unwrap_or(0.0);
        let has_several = meshes().count() >= 3;
        let middle_m = median(measured.iter().map(|shape| shape.diagonal_m)).unwrap_or(0.0);
        let mut told = "";
        for shape in &measured {
            let size_m = shape.diagonal_m;
            let is_small = shape.is_mesh
                && (size_m < LEAST_MESH_M || (has_several && size_m < LEAST_MESH_TO_MEDIAN * middle_mesh_m));
            // Larger meshes are told when they are read.
            let is_told = shape.is_mesh && size_m > LARGEST_PLAUSIBLE_M;
            let against_shapes = shape.owner != Owner::Large
                && measured.len() >= 3
                && size_m > MOST_SHAPE_TO_MEDIAN * middle_m;
            let against_origins = shape.owner == Owner::Other
                && self.sizes.origins_m > 0.0
                && size_m > MOST_SHAPE_TO_ORIGINS * self.sizes.origins_m;
            let is_large = size_m > LEAST_LARGE_SHAPE_M && !is_told && (against_shapes || against_origins);
            if told == shape.link {
                continue;
            }
            if is_small {
                let what = format!("a mesh of it is {} large", length(size_m));
                let help = "the file is in metres already: leave scale=\"0.001 0.001 0.001\" out?".to_owned();
                self.warn_link(&SMALL, shape.link, &what, ("", help));
                told = shape.link;
            } else if is_large {
                let what = format!(
                    "a shape of it is {} large, the middle one of the robot {}, and its joint origins {} together",
                    length(size_m),
                    length(middle_m),
                    length(self.sizes.origins_m)
                );
                let help = "sizes are in metres: is it in centimetres or millimetres?".to_owned();
                self.warn_link(&LARGE, shape.link, &what, ("", help));
                told = shape.link;
            }
        }
    }
}
