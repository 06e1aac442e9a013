//! Distances between links, from links to obstacles, and from links to forbidden zones, as they
//! change along a run.
//!
//! An exact distance costs more than a physics step, so each pair keeps a lower bound that shrinks
//! by how far its two bodies have moved against each other since the last exact distance. A pair
//! is measured again only if that bound does not decide the question.

use congruent_description::{Link, RobotDescription, Shape};
use congruent_simulation::Obstacle;
use nalgebra::Isometry3;

use super::{
    hulls::{Hulls, ProximityError},
    pairs::{Carried, ObstacleMobility, Pair, PairChoice, pairs, while_carried},
    travel::largest_shift_m,
};
use crate::setup::Zone;

/// Subtracted from every bound: the largest error of an exact distance, with a margin.
/// Kind: solver stop. Bound: 1e-7 m (worst of 1,950 mesh hull pairs of four arms: 2.5e-8 m).
const DISTANCE_SLACK_M: f64 = 1e-7;

/// The smallest distance of one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Distance; 0 if the pair touches or overlaps.
    pub distance_m: f64,
    /// Index into [`Clearance::pairs`].
    pub pair: usize,
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

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
