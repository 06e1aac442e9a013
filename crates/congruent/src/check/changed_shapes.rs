//! Links whose collision shapes are others than in a revision.

use congruent_description::{Robot, Shape};

/// Rounding of a pose. Unit: m, and no unit.
const ROUNDED: f64 = 1e-9;

/// Links of both robots that collide with other shapes, or with the same elsewhere.
pub(super) fn changed_shapes(robot: &Robot, before: &Robot) -> Vec<String> {
    let differs = |shapes: &[Shape], name: &str| {
        let before = before.find_link(name).map(|link| &before.link(link).collisions[..]);
        before.is_some_and(|before| !has_same_shapes(shapes, before))
    };
    let links = robot.links().iter().filter(|link| differs(&link.collisions, &link.name));
    links.map(|link| link.name.clone()).collect()
}

/// Whether two links have the same shapes in whatever order.
fn has_same_shapes(own: &[Shape], before: &[Shape]) -> bool {
    let has = |shapes: &[Shape], of: &Shape| shapes.iter().any(|other| is_same(of, other));
    own.len() == before.len() && own.iter().all(|of| has(before, of)) && before.iter().all(|of| has(own, of))
}

fn is_same(own: &Shape, before: &Shape) -> bool {
    let apart = own.link_from_shape.to_homogeneous() - before.link_from_shape.to_homogeneous();
    own.geometry == before.geometry && apart.amax() < ROUNDED
}
