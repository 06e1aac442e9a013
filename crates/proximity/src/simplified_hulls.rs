//! Meshes whose convex hulls are simplified to a bounded number of points: by how much every distance is too small.

use congruent_description::{Geometry, HullPoints, Obstacle, RobotDescription};
use congruent_input::{Diagnostic, display::length};

use crate::codes;

/// Smaller errors are not reported: a clearance is printed to a tenth of a millimetre at best. Unit: m; kind: choice.
const WORTH_A_WORD_M: f64 = 1e-5;

/// A warning for each link and obstacle whose mesh has a simplified hull.
pub fn simplified_hulls(description: &RobotDescription, obstacles: &[Obstacle]) -> Vec<Diagnostic> {
    let links = description.robot.links().iter();
    let links =
        links.flat_map(|link| link.collisions.iter().map(move |shape| ("link", &link.name, &shape.geometry)));
    let obstacles = obstacles.iter().map(|obstacle| ("obstacle", &obstacle.name, &obstacle.geometry));
    let warning = |(what, name, geometry): (&str, &String, &Geometry)| {
        let Geometry::Mesh(mesh) = geometry else { return None };
        let hull_error_m = HullPoints::from_vertices(&mesh.vertices_m).error_m;
        (hull_error_m > WORTH_A_WORD_M).then(|| {
            let message = format!(
                "{what} \"{name}\": its mesh reaches up to {} beyond the simplified convex hull; every distance is \
                 reduced by that",
                length(hull_error_m)
            );
            Diagnostic::warning(codes::mesh::CUT_HULL, message)
                .one_of("meshes have simplified convex hulls", name)
                .with_help("a mesh with fewer vertices is measured exactly, and faster")
        })
    };
    links.chain(obstacles).filter_map(warning).collect()
}
