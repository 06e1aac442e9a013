//! Distances between links, from links to obstacles, and from links to forbidden zones, as they
//! change along a run.
//!
//! An exact distance costs more than a physics step, so each pair keeps a lower bound that shrinks
//! by how far its two bodies have moved against each other since the last exact distance. A pair
//! is measured again only if that bound does not decide the question.

use congruent_description::{Geometry, Link, LinkIndex, Robot, RobotDescription, Shape};
use congruent_simulation::Obstacle;
use nalgebra::{Isometry3, Vector3};

use super::hulls::{Hulls, ProximityError};
use crate::setup::Zone;

/// Subtracted from every bound: the largest error of an exact distance, with a margin.
/// Kind: solver stop. Bound: 1e-7 m (worst of 1,950 mesh hull pairs of four arms: 2.5e-8 m).
const DISTANCE_SLACK_M: f64 = 1e-7;

/// Two subjects whose distance is watched: indices into [`Clearance::subjects`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pair {
    /// The first link, or a zone.
    pub a: usize,
    /// The second link, or an obstacle; of a zone, the link.
    pub b: usize,
}

/// The smallest distance of one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Distance; 0 if the pair touches or overlaps.
    pub distance_m: f64,
    /// Index into [`Clearance::pairs`].
    pub pair: usize,
}

/// Which link pairs are left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PairChoice {
    /// Pairs on the same or on neighbouring moving bodies, and pairs that an SRDF disables.
    Usual,
    /// Only pairs on the same body.
    All,
}

/// How an obstacle moves, as far as that decides which pairs are measured.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum ObstacleMobility {
    /// Not at all: with links that can move.
    #[default]
    Still,
    /// Along a path: with all links.
    Moves,
    /// These links carry it at times: with links that can move, but for these and their neighbours; while it is carried
    /// with all other links and with the other obstacles as well.
    Carried(Vec<LinkIndex>),
}

#[derive(Debug, Clone, Copy)]
struct WatchedPair {
    pair: Pair,
    /// Whether it counts only while one of the two is carried.
    while_carried: bool,
    /// Relative pose at the last exact distance.
    a_from_b: Isometry3<f64>,
    exact_m: f64,
    lower_bound_m: f64,
    /// Whether `exact_m` is of this instant.
    is_current: bool,
}

impl WatchedPair {
    /// A pair that was not measured yet.
    fn new(pair: Pair) -> Self {
        Self {
            pair,
            while_carried: false,
            a_from_b: Isometry3::identity(),
            exact_m: f64::NAN,
            lower_bound_m: f64::NEG_INFINITY,
            is_current: false,
        }
    }
}

/// Distances of all pairs.
#[derive(Debug, Clone)]
pub struct Clearance {
    subjects: Vec<String>,
    hulls: Vec<Hulls>,
    /// Links come first, in the robot's order, then obstacles or zones.
    root_from_subjects: Vec<Isometry3<f64>>,
    /// Whether a link carries the subject now.
    is_carried: Vec<bool>,
    links: usize,
    watches: Vec<WatchedPair>,
}

impl Clearance {
    /// Builds hulls and pairs for a robot among obstacles.
    ///
    /// # Errors
    /// [`ProximityError`] if a collision mesh has no extent.
    pub fn new(
        description: &RobotDescription,
        obstacles: &[Obstacle],
        choice: PairChoice,
    ) -> Result<Self, ProximityError> {
        Self::with_moving(description, (obstacles, &vec![ObstacleMobility::Still; obstacles.len()]), choice)
    }

    /// The same if some of the obstacles move; each has an entry.
    ///
    /// # Errors
    /// As [`Clearance::new`].
    pub fn with_moving(
        description: &RobotDescription,
        (obstacles, mobility): (&[Obstacle], &[ObstacleMobility]),
        choice: PairChoice,
    ) -> Result<Self, ProximityError> {
        let robot = &description.robot;
        let links = robot.links().len();
        let hulls = |link: &Link| Hulls::new(&format!("link \"{}\"", link.name), &link.collisions);
        let mut clearance = Self {
            subjects: robot.links().iter().map(|link| link.name.clone()).collect(),
            hulls: robot.links().iter().map(hulls).collect::<Result<_, _>>()?,
            root_from_subjects: vec![Isometry3::identity(); links],
            is_carried: vec![false; links],
            links,
            watches: Vec::new(),
        };
        for obstacle in obstacles {
            clearance.add(obstacle)?;
        }
        let is_solid = |subject: usize| !clearance.hulls[subject].is_empty();
        let pairs = pairs(description, (mobility, is_solid), choice);
        let only_if_carried = |pair: &Pair| while_carried(robot, mobility, pair);
        let watched =
            |pair: Pair| WatchedPair { while_carried: only_if_carried(&pair), ..WatchedPair::new(pair) };
        clearance.watches = pairs.into_iter().map(watched).collect();
        Ok(clearance)
    }

    /// The same links before forbidden zones: the pairs are each zone with the links that it names.
    /// Hulls are shared.
    ///
    /// # Errors
    /// [`ProximityError`] never comes from boxes, spheres and cylinders.
    pub fn before_zones(&self, zones: &[Zone]) -> Result<Self, ProximityError> {
        let mut clearance = Self {
            subjects: self.subjects[..self.links].to_vec(),
            hulls: self.hulls[..self.links].to_vec(),
            root_from_subjects: self.root_from_subjects[..self.links].to_vec(),
            is_carried: vec![false; self.links],
            links: self.links,
            watches: Vec::new(),
        };
        for zone in zones {
            let a = clearance.add(&zone.space)?;
            // Links are second: what a bound loses by a turn is proportional to the second's size,
            // and zones are large.
            let pairs = zone.links.iter().map(|link| Pair { a, b: link.get() });
            clearance.watches.extend(pairs.map(WatchedPair::new));
        }
        Ok(clearance)
    }

    /// Adds a body that stands still; returns its index among the subjects.
    fn add(&mut self, standing: &Obstacle) -> Result<usize, ProximityError> {
        let shape = Shape {
            link_from_shape: Isometry3::identity(),
            geometry: standing.geometry.clone(),
            color_rgba: None,
        };
        self.hulls.push(Hulls::new(&format!("\"{}\"", standing.name), &[shape])?);
        self.subjects.push(standing.name.clone());
        self.root_from_subjects.push(standing.world_from_obstacle);
        self.is_carried.push(false);
        Ok(self.subjects.len() - 1)
    }

    /// Names of links, then of obstacles or zones.
    pub fn subjects(&self) -> &[String] {
        &self.subjects
    }

    /// The watched pairs.
    pub fn pairs(&self) -> impl ExactSizeIterator<Item = Pair> + '_ {
        self.watches.iter().map(|watch| watch.pair)
    }

    /// Names of the two of one pair.
    pub fn names(&self, pair: usize) -> (&str, &str) {
        let Pair { a, b } = self.watches[pair].pair;
        (&self.subjects[a], &self.subjects[b])
    }

    /// The exact distance of one pair if it was measured at this instant.
    pub fn current_m(&self, pair: usize) -> Option<f64> {
        let watch = &self.watches[pair];
        watch.is_current.then_some(watch.exact_m)
    }

    /// Moves an obstacle, by its number; takes effect with [`Clearance::move_links`].
    pub fn move_obstacle(
        &mut self,
        obstacle: usize,
        root_from_obstacle: &Isometry3<f64>,
        is_carried: Carried,
    ) {
        let subject = self.links + obstacle;
        self.root_from_subjects[subject] = *root_from_obstacle;
        self.is_carried[subject] = is_carried == Carried::Yes;
    }

    /// Moves the links to new poses (root link's frame, the robot's order) and lowers the bounds
    /// by how far each pair can have come closer.
    pub fn move_links(&mut self, root_from_links: &[Isometry3<f64>]) {
        self.root_from_subjects[..self.links].copy_from_slice(root_from_links);
        for watch in &mut self.watches {
            watch.is_current = false;
            let Pair { a, b } = watch.pair;
            if watch.while_carried && !self.is_carried[a] && !self.is_carried[b] {
                (watch.lower_bound_m, watch.exact_m) = (f64::INFINITY, f64::NAN);
                continue;
            }
            if watch.exact_m.is_nan() {
                watch.lower_bound_m = f64::NEG_INFINITY;
                continue;
            }
            let a_from_b = self.root_from_subjects[a].inv_mul(&self.root_from_subjects[b]);
            let approach_m = largest_shift_m(&watch.a_from_b, &a_from_b, self.hulls[b].radius_m());
            watch.lower_bound_m = watch.exact_m - approach_m - DISTANCE_SLACK_M;
        }
    }

    /// Measures every pair that may be closer than `threshold_m` and gives the nearest of them.
    pub fn nearest_below(&mut self, threshold_m: f64) -> Option<Nearest> {
        let mut nearest: Option<Nearest> = None;
        for pair in 0..self.watches.len() {
            if let Some(distance_m) = self.measure_below(pair, threshold_m)
                && nearest.is_none_or(|known| distance_m < known.distance_m)
            {
                nearest = Some(Nearest { distance_m, pair });
            }
        }
        nearest
    }

    /// The distance of one pair if it is below `threshold_m`; it is measured only if its bound does not decide
    /// that.
    pub fn measure_below(&mut self, pair: usize, threshold_m: f64) -> Option<f64> {
        if self.watches[pair].lower_bound_m >= threshold_m {
            return None;
        }
        Some(self.measure(pair)).filter(|&distance_m| distance_m < threshold_m)
    }

    /// The smallest distance of this instant; `None` if there is no pair.
    pub fn nearest(&mut self) -> Option<Nearest> {
        // Starting with the pair that was closest last time, the fewest pairs need measuring.
        let first = (0..self.watches.len())
            .min_by(|&a, &b| self.watches[a].lower_bound_m.total_cmp(&self.watches[b].lower_bound_m))
            .filter(|&first| self.watches[first].lower_bound_m < f64::INFINITY)?;
        let mut nearest = Nearest { distance_m: self.measure(first), pair: first };
        while let Some(closer) = self.nearest_unmeasured_below(nearest.distance_m) {
            let distance_m = self.measure(closer);
            if distance_m < nearest.distance_m {
                nearest = Nearest { distance_m, pair: closer };
            }
        }
        Some(nearest)
    }

    fn nearest_unmeasured_below(&self, threshold_m: f64) -> Option<usize> {
        self.watches.iter().position(|watch| !watch.is_current && watch.lower_bound_m < threshold_m)
    }

    /// Measures one pair, unless it is measured already at this instant.
    pub fn measure(&mut self, pair: usize) -> f64 {
        let watch = &mut self.watches[pair];
        if !watch.is_current {
            let Pair { a, b } = watch.pair;
            watch.a_from_b = self.root_from_subjects[a].inv_mul(&self.root_from_subjects[b]);
            watch.exact_m = self.hulls[a].distance_m(&self.hulls[b], &watch.a_from_b);
            watch.lower_bound_m = watch.exact_m;
            watch.is_current = true;
        }
        watch.exact_m
    }

    /// Measures one pair with negative depths for overlaps.
    pub fn measure_signed(&self, pair: usize) -> f64 {
        let Pair { a, b } = self.watches[pair].pair;
        let a_from_b = self.root_from_subjects[a].inv_mul(&self.root_from_subjects[b]);
        self.hulls[a].signed_distance_m(&self.hulls[b], &a_from_b)
    }
}

/// How far a point within `radius_m` of b's origin has moved in a's frame, at most.
fn largest_shift_m(before: &Isometry3<f64>, after: &Isometry3<f64>, radius_m: f64) -> f64 {
    let shift_m = (after.translation.vector - before.translation.vector).norm();
    // A turn by an angle t moves a point at radius r along a chord of 2 r sin(t / 2), and the
    // vector part of the turn's unit quaternion has length sin(t / 2).
    let half_turn: Vector3<f64> = before.rotation.rotation_to(&after.rotation).imag();
    shift_m + 2.0 * radius_m * half_turn.norm()
}

/// Whether a link carries an obstacle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carried {
    /// A link carries it.
    Yes,
    /// It stands, or moves along its path.
    No,
}

/// The pairs that [`Clearance::with_moving`] watches among these obstacles, without their hulls.
pub fn measured_pairs(
    description: &RobotDescription,
    mobility: &[ObstacleMobility],
    choice: PairChoice,
) -> Vec<Pair> {
    let links = description.robot.links();
    let is_empty =
        |geometry: &Geometry| matches!(geometry, Geometry::Mesh(mesh) if mesh.triangles.is_empty());
    let has_shape = |link: &Link| link.collisions.iter().any(|shape| !is_empty(&shape.geometry));
    let is_solid = |subject: usize| links.get(subject).is_none_or(has_shape);
    pairs(description, (mobility, is_solid), choice)
}

/// Whether a pair that is watched counts only while one of the two is carried: both stand still otherwise.
fn while_carried(robot: &Robot, mobility: &[ObstacleMobility], pair: &Pair) -> bool {
    let links = robot.links().len();
    let is_held_at_times = |subject: usize| {
        subject >= links && matches!(mobility[subject - links], ObstacleMobility::Carried(_))
    };
    match robot.link_indices().nth(pair.a) {
        Some(link) => robot.body(link) == robot.root() && is_held_at_times(pair.b),
        None => true,
    }
}

/// Pairs among links and obstacles, links first, of which some are solid.
fn pairs(
    description: &RobotDescription,
    (mobility, is_solid): (&[ObstacleMobility], impl Fn(usize) -> bool),
    choice: PairChoice,
) -> Vec<Pair> {
    let robot = &description.robot;
    let links: Vec<LinkIndex> = robot.link_indices().collect();
    let body = |subject: usize| links.get(subject).map_or(robot.root(), |&link| robot.body(link));
    let solid: Vec<usize> = (0..links.len() + mobility.len()).filter(|&subject| is_solid(subject)).collect();
    let is_watched = |a: usize, b: usize| {
        let (body_a, body_b) = (body(a), body(b));
        let moves = |subject: usize| subject.checked_sub(links.len()).map(|obstacle| &mobility[obstacle]);
        match (moves(a), moves(b)) {
            (None, Some(ObstacleMobility::Moves)) => return true,
            (None, Some(ObstacleMobility::Carried(by))) => {
                let near = |link: &LinkIndex| {
                    let body = robot.body(*link);
                    body == body_a || are_neighbours(robot, body, body_a)
                };
                return !by.iter().any(near);
            }
            (Some(a), Some(b)) => {
                return [a, b].iter().any(|each| matches!(each, ObstacleMobility::Carried(_)));
            }
            _ => {}
        }
        // Obstacles stand still, as the root body does.
        if body_a == body_b {
            return false;
        }
        let (Some(&a), Some(&b)) = (links.get(a), links.get(b)) else { return true };
        choice == PairChoice::All
            || !(are_neighbours(robot, body_a, body_b) || description.disabled_collisions.contains(&(a, b)))
    };
    let all = solid.iter().flat_map(|&a| solid.iter().filter(move |&&b| b > a).map(move |&b| Pair { a, b }));
    all.filter(|pair| is_watched(pair.a, pair.b)).collect()
}

/// Whether one joint connects the two bodies.
fn are_neighbours(robot: &Robot, a: LinkIndex, b: LinkIndex) -> bool {
    let hangs_on = |lower: LinkIndex, upper: LinkIndex| {
        robot.parent_joint(lower).is_some_and(|joint| robot.body(robot.joint(joint).parent) == upper)
    };
    hangs_on(a, b) || hangs_on(b, a)
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
