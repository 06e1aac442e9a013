//! The pairs that are watched: those that could touch, and that neither the robot's structure nor an SRDF excludes.

use congruent_description::{Geometry, Link, LinkIndex, Robot, RobotDescription};
use nalgebra::Isometry3;

/// Two subjects whose distance is watched: indices into [`Clearance::subjects`](super::Clearance::subjects).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pair {
    /// The first link, or a zone.
    pub a: usize,
    /// The second link, or an obstacle; of a zone, the link.
    pub b: usize,
}

/// Which pairs of links are excluded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PairChoice {
    /// Pairs on the same or on neighbouring moving bodies, and pairs that an SRDF disables.
    Usual,
    /// Only pairs on the same moving body, which cannot move against each other.
    All,
}

/// How an obstacle moves, as far as that decides which pairs are measured.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum ObstacleMobility {
    /// At rest: measured against the links that can move.
    #[default]
    Still,
    /// Moves along a path: measured against all links.
    Moves,
    /// These links carry it at times: measured against the links that can move, except these and their neighbours, which
    /// touch it by design; while it is carried, against all other links and against the other obstacles as well.
    Carried(Vec<LinkIndex>),
}

/// Whether a link carries an obstacle at this instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carried {
    /// A link carries the obstacle.
    Yes,
    /// The obstacle is at rest, or moves along its own path.
    No,
}

/// A pair with its last exact distance and its lower bound.
#[derive(Debug, Clone, Copy)]
pub(super) struct WatchedPair {
    pub(super) pair: Pair,
    /// Whether it counts only while one of the two is carried.
    pub(super) while_carried: bool,
    /// Relative pose at the last exact distance.
    pub(super) a_from_b: Isometry3<f64>,
    /// NaN before the first.
    pub(super) exact_m: f64,
    /// The instant of the last exact distance.
    pub(super) measured_at: u64,
    /// The distance is at least this minus the path lengths of the two since the start of the run.
    pub(super) reach_m: f64,
}

impl WatchedPair {
    /// A pair that was not measured yet.
    pub(super) fn new(pair: Pair) -> Self {
        let a_from_b = Isometry3::identity();
        let reach_m = f64::NEG_INFINITY;
        Self { pair, while_carried: false, a_from_b, exact_m: f64::NAN, measured_at: 0, reach_m }
    }
}

/// The pairs that [`Clearance::with_moving`](super::Clearance::with_moving) watches among these obstacles, without their hulls.
pub fn measured_pairs(
    description: &RobotDescription,
    mobility: &[ObstacleMobility],
    choice: PairChoice,
) -> Vec<Pair> {
    let links = description.robot.links();
    let is_empty =
        |geometry: &Geometry| matches!(geometry, Geometry::Mesh(mesh) if mesh.triangles.is_empty());
    // As `Hulls::new`, which skips empty meshes: the pairs agree with those of a `Clearance` without building hulls.
    let has_shape = |link: &Link| link.collisions.iter().any(|shape| !is_empty(&shape.geometry));
    let is_solid = |subject: usize| links.get(subject).is_none_or(has_shape);
    pairs(description, mobility, is_solid, choice)
}

/// Whether a watched pair counts only while one of the two is carried: both are at rest otherwise.
pub(super) fn while_carried(robot: &Robot, mobility: &[ObstacleMobility], pair: &Pair) -> bool {
    let links = robot.links().len();
    let is_held_at_times = |subject: usize| {
        subject >= links && matches!(mobility[subject - links], ObstacleMobility::Carried(_))
    };
    match robot.link_indices().nth(pair.a) {
        // A link fixed to the root never moves against an obstacle that rests, only against one that is carried.
        Some(link) => robot.body(link) == robot.root() && is_held_at_times(pair.b),
        // Two obstacles.
        None => true,
    }
}

/// Pairs among links and obstacles, links first, of which some are solid.
pub(super) fn pairs(
    description: &RobotDescription,
    mobility: &[ObstacleMobility],
    is_solid: impl Fn(usize) -> bool,
    choice: PairChoice,
) -> Vec<Pair> {
    let robot = &description.robot;
    let links: Vec<LinkIndex> = robot.link_indices().collect();
    let body = |subject: usize| links.get(subject).map_or(robot.root(), |&link| robot.body(link));
    let solid: Vec<usize> = (0..links.len() + mobility.len()).filter(|&subject| is_solid(subject)).collect();
    let is_watched = |a: usize, b: usize| {
        let (body_a, body_b) = (body(a), body(b));
        let moves = |subject: usize| subject.checked_sub(links.len()).map(|obstacle| &mobility[obstacle]);
        // Pairs have the lower index first, so a lone obstacle is always `b`.
        match (moves(a), moves(b)) {
            (None, Some(ObstacleMobility::Moves)) => return true,
            (None, Some(ObstacleMobility::Carried(by))) => {
                // The carrying link touches the object by design, and its neighbours are too close to measure
                // anything else.
                let near = |link: &LinkIndex| {
                    let body = robot.body(*link);
                    body == body_a || are_neighbours(robot, body, body_a)
                };
                return !by.iter().any(near);
            }
            // Two obstacles matter only if the robot brings one to the other; what paths of a scenario do to each
            // other is not the robot's.
            (Some(a), Some(b)) => {
                return [a, b].iter().any(|each| matches!(each, ObstacleMobility::Carried(_)));
            }
            _ => {}
        }
        // Both on one body never move against each other. Obstacles at rest count to the root body.
        if body_a == body_b {
            return false;
        }
        // An obstacle at rest against a link that moves.
        let (Some(&a), Some(&b)) = (links.get(a), links.get(b)) else { return true };
        choice == PairChoice::All
            || !(are_neighbours(robot, body_a, body_b) || description.disabled_collisions.contains(&(a, b)))
    };
    let all = solid.iter().flat_map(|&a| solid.iter().filter(move |&&b| b > a).map(move |&b| Pair { a, b }));
    all.filter(|pair| is_watched(pair.a, pair.b)).collect()
}

/// Whether one joint connects the two bodies.
fn are_neighbours(robot: &Robot, a: LinkIndex, b: LinkIndex) -> bool {
    // By bodies, so that fixed links between joint and shape (flanges, adapters) do not hide the neighbour.
    let hangs_on = |lower: LinkIndex, upper: LinkIndex| {
        robot.parent_joint(lower).is_some_and(|joint| robot.body(robot.joint(joint).parent) == upper)
    };
    hangs_on(a, b) || hangs_on(b, a)
}
