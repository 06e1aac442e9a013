//! Distances between links, from links to obstacles, and from links to forbidden zones, as they change along a run.
//!
//! An exact distance costs more than a physics step, so each pair keeps a lower bound, and is measured again only if the
//! bound does not decide the question. The bound shrinks as the two bodies move: first by the path length of each body, which
//! is one sum for all of its pairs, and if that is too coarse by their relative motion since the last exact distance.

use congruent_description::{Link, Obstacle, RobotDescription, Shape};
use nalgebra::Isometry3;

use super::{
    error::ProximityError,
    hulls::Hulls,
    pairs::{Carried, ObstacleMobility, Pair, PairChoice, WatchedPair, pairs, while_carried},
    travel::largest_shift_m,
    waiting::WaitingPairs,
};
use crate::Zone;

/// Subtracted from every bound: the largest error of an exact distance, with a margin.
/// Kind: solver stop. Bound: 1e-7 m (worst of 1,950 mesh hull pairs of four arms: 2.5e-8 m).
const DISTANCE_SLACK_M: f64 = 1e-7;

/// The smallest distance over all pairs at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Distance of the two hulls; 0 if they touch or overlap.
    pub distance_m: f64,
    /// Index of the pair in [`Clearance::pairs`].
    pub pair: usize,
}

/// A pair that may be near, with a lower bound of its distance at this instant.
#[derive(Debug, Clone, Copy)]
struct NearPair {
    bound_m: f64,
    pair: usize,
}

/// Distances of all watched pairs: links with each other, with obstacles, or with forbidden zones.
#[derive(Debug, Clone)]
pub struct Clearance {
    subjects: Vec<String>,
    pub(super) hulls: Vec<Hulls>,
    /// Links come first, in the robot's order, then obstacles or zones.
    pub(super) root_from_subjects: Vec<Isometry3<f64>>,
    /// Whether a link carries the subject now.
    is_carried: Vec<bool>,
    /// Whether the subject can move; true for every link.
    pub(super) can_move: Vec<bool>,
    links: usize,
    pub(super) watches: Vec<WatchedPair>,
    /// Pairs in which both subjects can move: one path length does not order them, so each is examined every time.
    of_movers: Vec<usize>,
    /// For each link, its pairs with bodies at rest, except those that are candidates now.
    waiting: Vec<WaitingPairs>,
    /// Upper bound of the path length of any point of each subject since the start.
    travelled_m: Vec<f64>,
    /// Number of the present instant, from 1.
    instant: u64,
    candidates: Vec<NearPair>,
    /// The nearest pair of the last instant: the first guess at the next one.
    nearest: Option<usize>,
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
        Self::with_moving(description, obstacles, &vec![ObstacleMobility::Still; obstacles.len()], choice)
    }

    /// The same if some of the obstacles move; each has an entry.
    ///
    /// # Errors
    /// As [`Clearance::new`].
    pub fn with_moving(
        description: &RobotDescription,
        obstacles: &[Obstacle],
        mobility: &[ObstacleMobility],
        choice: PairChoice,
    ) -> Result<Self, ProximityError> {
        let robot = &description.robot;
        let hulls = |link: &Link| Hulls::new(&format!("link \"{}\"", link.name), &link.collisions);
        let mut clearance = Self::of_links(
            robot.links().iter().map(|link| link.name.clone()).collect(),
            robot.links().iter().map(hulls).collect::<Result<_, _>>()?,
        );
        for (obstacle, mobility) in obstacles.iter().zip(mobility) {
            let subject = clearance.add(obstacle)?;
            clearance.can_move[subject] = *mobility != ObstacleMobility::Still;
        }
        let is_solid = |subject: usize| !clearance.hulls[subject].is_empty();
        let watched = |pair: Pair| WatchedPair {
            while_carried: while_carried(robot, mobility, &pair),
            ..WatchedPair::new(pair)
        };
        clearance.watch(pairs(description, mobility, is_solid, choice).into_iter().map(watched));
        Ok(clearance)
    }

    /// The same links with the same hulls against forbidden zones: the pairs are each zone with the links that it names.
    ///
    /// # Errors
    /// [`ProximityError`] never comes from boxes, spheres and cylinders.
    pub fn before_zones(&self, zones: &[Zone]) -> Result<Self, ProximityError> {
        let mut clearance =
            Self::of_links(self.subjects[..self.links].to_vec(), self.hulls[..self.links].to_vec());
        for zone in zones {
            let a = clearance.add(&zone.space)?;
            // Links are second: rotations lower the bound by the size of the second subject, and zones are large.
            let pairs = zone.links.iter().map(|link| Pair { a, b: link.get() });
            clearance.watch(pairs.map(WatchedPair::new));
        }
        Ok(clearance)
    }

    /// Subjects for the links alone, without pairs.
    fn of_links(subjects: Vec<String>, hulls: Vec<Hulls>) -> Self {
        let links = subjects.len();
        Self {
            subjects,
            hulls,
            root_from_subjects: vec![Isometry3::identity(); links],
            is_carried: vec![false; links],
            can_move: vec![true; links],
            links,
            watches: Vec::new(),
            of_movers: Vec::new(),
            waiting: vec![WaitingPairs::default(); links],
            travelled_m: vec![0.0; links],
            instant: 1,
            candidates: Vec::new(),
            nearest: None,
        }
    }

    /// Watches more pairs; each is measured at the first query, since nothing is known of it yet.
    fn watch(&mut self, watches: impl IntoIterator<Item = WatchedPair>) {
        for watch in watches {
            let index = self.watches.len();
            self.watches.push(watch);
            // Bounds of one link against bodies at rest shrink alike, so a heap keeps their order.
            match self.only_mover(watch.pair) {
                Some(link) => self.waiting[link].push(f64::NEG_INFINITY, index),
                None => self.of_movers.push(index),
            }
        }
        // Room for all pairs at once, so that no step of the run allocates.
        self.candidates.reserve(self.watches.len());
    }

    /// The one link of a pair whose other body is at rest; `None` if both can move, or neither is a link.
    fn only_mover(&self, Pair { a, b }: Pair) -> Option<usize> {
        match (self.can_move[a], self.can_move[b]) {
            (true, false) if a < self.links => Some(a),
            (false, true) if b < self.links => Some(b),
            _ => None,
        }
    }

    /// Whether a pair is evaluated now: some pairs are evaluated only while a link carries one of the two.
    fn counts(&self, watch: &WatchedPair) -> bool {
        let Pair { a, b } = watch.pair;
        !watch.while_carried || self.is_carried[a] || self.is_carried[b]
    }

    /// Adds a body at rest; returns its index among the subjects.
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
        self.can_move.push(false);
        self.travelled_m.push(0.0);
        Ok(self.subjects.len() - 1)
    }

    /// Names of links, then of obstacles or zones.
    pub fn subjects(&self) -> &[String] {
        &self.subjects
    }

    /// The watched pairs, in the order of their indices.
    pub fn pairs(&self) -> impl ExactSizeIterator<Item = Pair> + '_ {
        self.watches.iter().map(|watch| watch.pair)
    }

    /// Names of the two subjects of one pair.
    pub fn names(&self, pair: usize) -> [&str; 2] {
        let Pair { a, b } = self.watches[pair].pair;
        [&self.subjects[a], &self.subjects[b]]
    }

    /// The exact distance of one pair if it was measured at this instant.
    pub fn current_m(&self, pair: usize) -> Option<f64> {
        let watch = &self.watches[pair];
        (watch.measured_at == self.instant).then_some(watch.exact_m)
    }

    /// Moves an obstacle, by its number; takes effect with [`Clearance::move_links`].
    pub fn move_obstacle(
        &mut self,
        obstacle: usize,
        root_from_obstacle: &Isometry3<f64>,
        is_carried: Carried,
    ) {
        let subject = self.links + obstacle;
        self.move_subject(subject, root_from_obstacle);
        self.is_carried[subject] = is_carried == Carried::Yes;
    }

    /// Moves the links to new poses (root link's frame, the robot's order).
    pub fn move_links(&mut self, root_from_links: &[Isometry3<f64>]) {
        self.instant += 1;
        for (link, after) in root_from_links.iter().enumerate() {
            self.move_subject(link, after);
        }
    }

    fn move_subject(&mut self, subject: usize, after: &Isometry3<f64>) {
        let before = std::mem::replace(&mut self.root_from_subjects[subject], *after);
        if before != *after {
            let travelled_m = &mut self.travelled_m[subject];
            *travelled_m += largest_shift_m(&before, after, self.hulls[subject].radius_m());
            // Rounded up at each step: a sum rounded down would make the lower bound of a distance too large.
            *travelled_m += *travelled_m * f64::EPSILON;
        }
    }

    /// Passes every pair that is nearer than `threshold_m` to `found`, with its distance, in the order of the pairs; a pair
    /// with a lower `limit_m` is passed only if it is nearer than its own limit.
    pub fn below(
        &mut self,
        threshold_m: f64,
        limit_m: impl Fn(usize) -> f64,
        mut found: impl FnMut(usize, f64),
    ) {
        self.gather(threshold_m);
        self.candidates.sort_unstable_by_key(|candidate| candidate.pair);
        for at in 0..self.candidates.len() {
            let NearPair { bound_m, pair } = self.candidates[at];
            let limit_m = limit_m(pair).min(threshold_m);
            if bound_m < limit_m {
                let distance_m = self.measure(pair);
                if distance_m < limit_m {
                    found(pair, distance_m);
                }
            }
        }
        self.let_wait();
    }

    /// The smallest distance of this instant; `None` if there is no pair.
    pub fn nearest(&mut self) -> Option<Nearest> {
        // The last nearest pair is measured first: it is nearly always still the nearest, and then prunes all others.
        let first = self.nearest.filter(|&pair| self.counts(&self.watches[pair]));
        let first_m = first.map_or(f64::INFINITY, |pair| self.measure(pair));
        // `next_up`, so that this pair is found again, or one with a lower index at the same distance.
        let nearest = self.nearest_below(first_m.next_up());
        self.nearest = nearest.map(|nearest| nearest.pair);
        nearest
    }

    /// The nearest pair if it is nearer than `threshold_m`.
    pub fn nearest_below(&mut self, threshold_m: f64) -> Option<Nearest> {
        self.nearest_of(threshold_m, |_, _| true)
    }

    /// The nearest of some pairs, given by index and subjects, if it is nearer than `threshold_m`.
    pub fn nearest_of(
        &mut self,
        threshold_m: f64,
        is_chosen: impl Fn(usize, Pair) -> bool,
    ) -> Option<Nearest> {
        self.gather(threshold_m);
        self.candidates.sort_unstable_by(|a, b| a.bound_m.total_cmp(&b.bound_m).then(a.pair.cmp(&b.pair)));
        let mut nearest: Option<Nearest> = None;
        for at in 0..self.candidates.len() {
            let NearPair { bound_m, pair } = self.candidates[at];
            if bound_m > nearest.map_or(threshold_m, |nearest| nearest.distance_m) {
                break; // candidates are in order of their bounds: no later one can be nearer
            }
            if !is_chosen(pair, self.watches[pair].pair) {
                continue;
            }
            let distance_m = self.measure(pair);
            // The lower index wins at equal distances, so that the answer does not depend on the history of bounds.
            let is_nearer = |known: Nearest| (distance_m, pair) < (known.distance_m, known.pair);
            if distance_m < threshold_m && nearest.is_none_or(is_nearer) {
                nearest = Some(Nearest { distance_m, pair });
            }
        }
        self.let_wait();
        nearest
    }

    /// Makes candidates of all pairs whose bound by path lengths is below `threshold_m`.
    fn gather(&mut self, threshold_m: f64) {
        self.candidates.clear();
        for at in 0..self.of_movers.len() {
            let pair = self.of_movers[at];
            let watch = &self.watches[pair];
            let Pair { a, b } = watch.pair;
            let bound_m = watch.reach_m - self.travelled_m[a] - self.travelled_m[b];
            if bound_m < threshold_m && self.counts(watch) {
                self.make_candidate(pair);
            }
        }
        for link in 0..self.links {
            while let Some(pair) = self.waiting[link].pop_below(threshold_m, self.travelled_m[link]) {
                self.make_candidate(pair);
            }
        }
    }

    fn make_candidate(&mut self, pair: usize) {
        let bound_m = self.bound_m(&self.watches[pair]);
        self.candidates.push(NearPair { bound_m, pair });
    }

    /// A lower bound of the distance of a pair at this instant: exact, by bounding balls, or by relative motion.
    fn bound_m(&self, watch: &WatchedPair) -> f64 {
        if watch.measured_at == self.instant {
            return watch.exact_m;
        }
        let Pair { a, b } = watch.pair;
        let [root_from_a, root_from_b] = [a, b].map(|subject| &self.root_from_subjects[subject]);
        let radius_m = self.hulls[b].radius_m();
        if watch.exact_m.is_nan() {
            let origins_m = (root_from_a.translation.vector - root_from_b.translation.vector).norm();
            return origins_m - radius_m - self.hulls[a].radius_m() - DISTANCE_SLACK_M;
        }
        // By the relative pose, since two links that move together have long paths but do not come nearer.
        let approach_m = largest_shift_m(&watch.a_from_b, &root_from_a.inv_mul(root_from_b), radius_m);
        watch.exact_m - approach_m - DISTANCE_SLACK_M
    }

    /// Puts the candidates back, each with the best lower bound that is known of it now.
    fn let_wait(&mut self) {
        for at in 0..self.candidates.len() {
            let NearPair { bound_m, pair } = self.candidates[at];
            let known_m = self.current_m(pair).map_or(bound_m, |exact_m| exact_m - DISTANCE_SLACK_M);
            let watched = self.watches[pair].pair;
            let reach_m = known_m + self.travelled_m[watched.a] + self.travelled_m[watched.b];
            match self.only_mover(watched) {
                Some(link) => self.waiting[link].push(reach_m, pair),
                None => self.watches[pair].reach_m = reach_m,
            }
        }
        self.candidates.clear();
    }

    /// The exact distance of one pair, m; computed once for each relative pose.
    pub fn measure(&mut self, pair: usize) -> f64 {
        let watch = &mut self.watches[pair];
        let Pair { a, b } = watch.pair;
        if watch.measured_at != self.instant {
            let a_from_b = self.root_from_subjects[a].inv_mul(&self.root_from_subjects[b]);
            if watch.exact_m.is_nan() || a_from_b != watch.a_from_b {
                watch.exact_m = self.hulls[a].distance_m(&self.hulls[b], &a_from_b);
                watch.a_from_b = a_from_b;
            }
            watch.measured_at = self.instant;
            watch.reach_m = watch.exact_m - DISTANCE_SLACK_M + self.travelled_m[a] + self.travelled_m[b];
        }
        watch.exact_m
    }

    /// The distance of one pair if it is below `threshold_m`; it is measured only if its bound does not decide that.
    pub fn measure_below(&mut self, pair: usize, threshold_m: f64) -> Option<f64> {
        let watch = &self.watches[pair];
        let travelled_m = self.travelled_m[watch.pair.a] + self.travelled_m[watch.pair.b];
        // By path lengths first: two numbers decide that of most pairs, while the relative motion takes two poses.
        if watch.reach_m - travelled_m >= threshold_m || !self.counts(watch) {
            return None;
        }
        let bound_m = self.bound_m(watch);
        if bound_m >= threshold_m {
            // Less the slack, since the bound is the distance itself if that was measured at this instant.
            self.watches[pair].reach_m = bound_m - DISTANCE_SLACK_M + travelled_m;
            return None;
        }
        Some(self.measure(pair)).filter(|&distance_m| distance_m < threshold_m)
    }
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
