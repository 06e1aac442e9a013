//! Distances between links, from links to obstacles, and from links to forbidden zones, as they
//! change along a run.
//!
//! An exact distance costs more than a physics step, so each pair keeps a lower bound, and is measured again only if
//! that does not decide the question. The bound shrinks by how far the two bodies have moved: first by the way that
//! each has gone, which costs nothing for each pair, and if that does not suffice by how far they have moved against
//! each other since the last exact distance.

use congruent_description::{Link, RobotDescription, Shape};
use congruent_simulation::Obstacle;
use nalgebra::{Isometry3, Vector3};

use super::{
    hulls::{Hulls, ProximityError},
    pairs::{Pair, PairChoice, pairs},
    waiting::WaitingPairs,
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
    /// Relative pose at the last exact distance.
    a_from_b: Isometry3<f64>,
    /// NaN before the first.
    exact_m: f64,
    /// The instant of the last exact distance.
    measured_at: u64,
    /// The distance is at least this less what the two have travelled in total.
    reach_m: f64,
}

impl WatchedPair {
    /// A pair that was not measured yet.
    fn new(pair: Pair) -> Self {
        let a_from_b = Isometry3::identity();
        Self { pair, a_from_b, exact_m: f64::NAN, measured_at: 0, reach_m: f64::NEG_INFINITY }
    }
}

/// A pair that may be near, with a lower bound of its distance at this instant.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    bound_m: f64,
    pair: usize,
}

/// Distances of all pairs.
#[derive(Debug, Clone)]
pub struct Clearance {
    subjects: Vec<String>,
    hulls: Vec<Hulls>,
    /// Links come first, in the robot's order, then obstacles or zones with their constant pose.
    root_from_subjects: Vec<Isometry3<f64>>,
    links: usize,
    watches: Vec<WatchedPair>,
    /// Pairs of two links, both of which move.
    of_links: Vec<usize>,
    /// For each link, its pairs with bodies that stand still, but for the present candidates.
    waiting: Vec<WaitingPairs>,
    /// The way that the points of each link have gone so far, at most.
    travelled_m: Vec<f64>,
    /// Number of the present instant, from 1.
    instant: u64,
    candidates: Vec<Candidate>,
    /// The nearest pair of the last time.
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
        let robot = &description.robot;
        let hulls = |link: &Link| Hulls::new(&format!("link \"{}\"", link.name), &link.collisions);
        let mut clearance = Self::of_links(
            robot.links().iter().map(|link| link.name.clone()).collect(),
            robot.links().iter().map(hulls).collect::<Result<_, _>>()?,
        );
        for obstacle in obstacles {
            clearance.add(obstacle)?;
        }
        let is_solid = |subject: usize| !clearance.hulls[subject].is_empty();
        let pairs = pairs(description, (clearance.hulls.len(), is_solid), choice);
        clearance.watch(pairs);
        Ok(clearance)
    }

    /// The same links before forbidden zones: the pairs are each zone with the links that it names.
    /// Hulls are shared.
    ///
    /// # Errors
    /// [`ProximityError`] never comes from boxes, spheres and cylinders.
    pub fn before_zones(&self, zones: &[Zone]) -> Result<Self, ProximityError> {
        let mut clearance =
            Self::of_links(self.subjects[..self.links].to_vec(), self.hulls[..self.links].to_vec());
        for zone in zones {
            let a = clearance.add(&zone.space)?;
            // Links are second: what a bound loses by a turn is proportional to the second's size,
            // and zones are large.
            let pairs = zone.links.iter().map(|link| Pair { a, b: link.get() });
            clearance.watch(pairs);
        }
        Ok(clearance)
    }

    /// Links without pairs.
    fn of_links(subjects: Vec<String>, hulls: Vec<Hulls>) -> Self {
        let links = subjects.len();
        Self {
            subjects,
            hulls,
            root_from_subjects: vec![Isometry3::identity(); links],
            links,
            watches: Vec::new(),
            of_links: Vec::new(),
            waiting: vec![WaitingPairs::default(); links],
            travelled_m: vec![0.0; links],
            instant: 1,
            candidates: Vec::new(),
            nearest: None,
        }
    }

    /// Watches more pairs.
    fn watch(&mut self, pairs: impl IntoIterator<Item = Pair>) {
        for pair in pairs {
            let index = self.watches.len();
            self.watches.push(WatchedPair::new(pair));
            match self.only_mover(pair) {
                Some(link) => self.waiting[link].push(f64::NEG_INFINITY, index),
                None => self.of_links.push(index),
            }
        }
        // Room for all, so that no later sample allocates.
        self.candidates.reserve(self.watches.len());
    }

    /// The one link of a pair whose other body stands still; `None` of two links.
    fn only_mover(&self, Pair { a, b }: Pair) -> Option<usize> {
        match (a < self.links, b < self.links) {
            (true, true) => None,
            (true, false) => Some(a),
            _ => Some(b),
        }
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
        (watch.measured_at == self.instant).then_some(watch.exact_m)
    }

    /// Moves the links to new poses (root link's frame, the robot's order).
    pub fn move_links(&mut self, root_from_links: &[Isometry3<f64>]) {
        self.instant += 1;
        for (link, after) in root_from_links.iter().enumerate() {
            let before = std::mem::replace(&mut self.root_from_subjects[link], *after);
            if before != *after {
                let travelled_m = &mut self.travelled_m[link];
                *travelled_m += largest_shift_m(&before, after, self.hulls[link].radius_m());
                // A sum of many small steps may be rounded, but not down.
                *travelled_m += *travelled_m * f64::EPSILON;
            }
        }
    }

    /// Passes every pair that is nearer than `threshold_m` to `found`, with its distance, in the order of the pairs;
    /// less than that, and none of no interest, if `limit_m` of a pair is lower.
    pub fn below(
        &mut self,
        threshold_m: f64,
        limit_m: impl Fn(usize) -> f64,
        mut found: impl FnMut(usize, f64),
    ) {
        self.gather(threshold_m);
        self.candidates.sort_unstable_by_key(|candidate| candidate.pair);
        for at in 0..self.candidates.len() {
            let Candidate { bound_m, pair } = self.candidates[at];
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
        // With the pair that was nearest last time for a start, the fewest pairs need measuring.
        let first_m = self.nearest.map_or(f64::INFINITY, |pair| self.measure(pair));
        // That pair itself is found again, or one before it at the same distance.
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
            let Candidate { bound_m, pair } = self.candidates[at];
            if bound_m > nearest.map_or(threshold_m, |nearest| nearest.distance_m) {
                break; // and so are all that follow
            }
            if !is_chosen(pair, self.watches[pair].pair) {
                continue;
            }
            let distance_m = self.measure(pair);
            // Of two at one distance the first counts, whatever their bounds were.
            let is_nearer = |known: Nearest| (distance_m, pair) < (known.distance_m, known.pair);
            if distance_m < threshold_m && nearest.is_none_or(is_nearer) {
                nearest = Some(Nearest { distance_m, pair });
            }
        }
        self.let_wait();
        nearest
    }

    /// Makes candidates of all pairs that can be nearer than `threshold_m`.
    fn gather(&mut self, threshold_m: f64) {
        self.candidates.clear();
        for at in 0..self.of_links.len() {
            let pair = self.of_links[at];
            let WatchedPair { pair: Pair { a, b }, reach_m, .. } = self.watches[pair];
            if reach_m - self.travelled_m[a] - self.travelled_m[b] < threshold_m {
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
        self.candidates.push(Candidate { bound_m, pair });
    }

    /// A lower bound of a distance at this instant.
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
        let approach_m = largest_shift_m(&watch.a_from_b, &root_from_a.inv_mul(root_from_b), radius_m);
        watch.exact_m - approach_m - DISTANCE_SLACK_M
    }

    /// Lets the candidates wait again, each by what is known of it now.
    fn let_wait(&mut self) {
        for at in 0..self.candidates.len() {
            let Candidate { bound_m, pair } = self.candidates[at];
            let known_m = self.current_m(pair).map_or(bound_m, |exact_m| exact_m - DISTANCE_SLACK_M);
            let watched = self.watches[pair].pair;
            let travelled_m = |subject: usize| self.travelled_m.get(subject).copied().unwrap_or_default();
            let reach_m = known_m + travelled_m(watched.a) + travelled_m(watched.b);
            match self.only_mover(watched) {
                Some(link) => self.waiting[link].push(reach_m, pair),
                None => self.watches[pair].reach_m = reach_m,
            }
        }
        self.candidates.clear();
    }

    /// Measures one pair, unless it is measured already at this instant.
    pub fn measure(&mut self, pair: usize) -> f64 {
        let watch = &mut self.watches[pair];
        if watch.measured_at != self.instant {
            let Pair { a, b } = watch.pair;
            watch.a_from_b = self.root_from_subjects[a].inv_mul(&self.root_from_subjects[b]);
            watch.exact_m = self.hulls[a].distance_m(&self.hulls[b], &watch.a_from_b);
            watch.measured_at = self.instant;
        }
        watch.exact_m
    }

    /// The distance of one pair if it is below `threshold_m`; it is measured only if its bound does not decide that.
    pub fn measure_below(&mut self, pair: usize, threshold_m: f64) -> Option<f64> {
        if self.bound_m(&self.watches[pair]) >= threshold_m {
            return None;
        }
        Some(self.measure(pair)).filter(|&distance_m| distance_m < threshold_m)
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

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
