//! Meshes whose hulls have more points than are taken: by how much every distance is too small.

use congruent_description::{Diagnostic, Geometry, HullPoints, RobotDescription, display::length};
use congruent_simulation::Obstacle;

/// Less is not worth a word: a clearance is told to the tenth of a millimetre at best. Unit: m; kind: choice.
const WORTH_A_WORD_M: f64 = 1e-5;

/// A warning for each link and obstacle whose mesh has more points on its hull than are taken.
pub(crate) fn cut_hulls(description: &RobotDescription, obstacles: &[Obstacle]) -> Vec<Diagnostic> {
    let links = description.robot.links().iter();
    let links =
        links.flat_map(|link| link.collisions.iter().map(move |shape| ("link", &link.name, &shape.geometry)));
    let obstacles = obstacles.iter().map(|obstacle| ("obstacle", &obstacle.name, &obstacle.geometry));
    let warning = |(what, name, geometry): (&str, &String, &Geometry)| {
        let Geometry::Mesh(mesh) = geometry else { return None };
        let left_out_m = HullPoints::of(&mesh.vertices_m).error_m;
        (left_out_m > WORTH_A_WORD_M).then(|| {
            let message = format!(
                "{what} \"{name}\": the convex hull of its mesh leaves out up to {}, which is taken off every distance",
                length(left_out_m)
            );
            Diagnostic::warning("mesh::cut_hull", message)
                .one_of("shapes have hulls of so many points that not all are taken", name)
                .with_help("a mesh of fewer points is measured exactly, and faster")
        })
    };
    links.chain(obstacles).filter_map(warning).collect()
}
