//! Which pairs are watched: those that could touch, and that no one has left out.

use congruent_description::{Geometry, Link, LinkIndex, Robot, RobotDescription};

/// Two subjects whose distance is watched: indices into [`Clearance::subjects`](super::Clearance::subjects).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pair {
    /// The first link, or a zone.
    pub a: usize,
    /// The second link, or an obstacle; of a zone, the link.
    pub b: usize,
}

/// Which link pairs are left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PairChoice {
    /// Pairs on the same or on neighbouring moving bodies, and pairs that an SRDF disables.
    Usual,
    /// Only pairs on the same body.
    All,
}

/// The pairs that [`Clearance::new`](super::Clearance::new) watches among so many obstacles, without their hulls.
pub fn measured_pairs(description: &RobotDescription, obstacles: usize, choice: PairChoice) -> Vec<Pair> {
    let links = description.robot.links();
    let is_empty =
        |geometry: &Geometry| matches!(geometry, Geometry::Mesh(mesh) if mesh.triangles.is_empty());
    let has_shape = |link: &Link| link.collisions.iter().any(|shape| !is_empty(&shape.geometry));
    let is_solid = |subject: usize| links.get(subject).is_none_or(has_shape);
    pairs(description, (links.len() + obstacles, is_solid), choice)
}

/// Pairs among so many subjects, links first, of which some are solid.
pub(super) fn pairs(
    description: &RobotDescription,
    (subjects, is_solid): (usize, impl Fn(usize) -> bool),
    choice: PairChoice,
) -> Vec<Pair> {
    let robot = &description.robot;
    let links: Vec<LinkIndex> = robot.link_indices().collect();
    let body = |subject: usize| links.get(subject).map_or(robot.root(), |&link| robot.body(link));
    let solid: Vec<usize> = (0..subjects).filter(|&subject| is_solid(subject)).collect();
    let is_watched = |a: usize, b: usize| {
        let (body_a, body_b) = (body(a), body(b));
        // Obstacles stand still, as the root body does.
        if body_a == body_b {
            return false;
        }
        let (Some(&a), Some(&b)) = (links.get(a), links.get(b)) else { return true };
        choice == PairChoice::All
            || !(are_neighbours(robot, body_a, body_b) || description.disabled_collisions.contains(&(a, b)))
    };
    let of_link = |&a: &usize| a < links.len();
    let all = solid
        .iter()
        .filter(|a| of_link(a))
        .flat_map(|&a| solid.iter().filter(move |&&b| b > a).map(move |&b| Pair { a, b }));
    all.filter(|pair| is_watched(pair.a, pair.b)).collect()
}

/// Whether one joint connects the two bodies.
fn are_neighbours(robot: &Robot, a: LinkIndex, b: LinkIndex) -> bool {
    let hangs_on = |lower: LinkIndex, upper: LinkIndex| {
        robot.parent_joint(lower).is_some_and(|joint| robot.body(robot.joint(joint).parent) == upper)
    };
    hangs_on(a, b) || hangs_on(b, a)
}
