//! How near links come to each other along a motion.

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::{Pose, UrdfTree, move_inside_limits};
use congruent_proximity::{Clearance, PairChoice, ProximityError};
use nalgebra::Isometry3;

use crate::joint_move::JointMove;

/// Configurations along a motion at which distances are measured.
const SAMPLES_OF_PATH: u32 = 6;
/// Links that are nearer count as touching, though their shapes do not quite. Unit: m. Kind: choice.
const TOUCH_M: f64 = 1e-3;
/// Motions that are tried after one without contact is found, and starts that are sampled for pairs that always
/// touch. Kind: choice, time.
const MOST: usize = 40;
/// No other start is tried if links stay this far apart. Kind: choice.
const FAR_M: f64 = 0.02;

/// The distances of all pairs that a scenario would measure.
pub(super) struct PairDistances {
    clearance: Clearance,
    tree: UrdfTree,
    by_tree: Vec<Pose>,
    root_from_links: Vec<Isometry3<f64>>,
}

/// The motion whose links stay farthest apart, among those that were tried.
pub(super) struct FarthestMove {
    pub(super) motion: JointMove,
    /// Smallest distance of the pairs that are not ignored; `None` without such pairs.
    pub(super) least_m: Option<f64>,
    /// Pairs that touch along the motion.
    pub(super) ignored: Vec<[String; 2]>,
    /// Touching pairs that do not overlap at 0 or at nearly all starts; not empty only if no motion without contact
    /// was found.
    pub(super) touching: Vec<[String; 2]>,
}

/// A motion that was tried, with its distances.
struct CandidateMove<'a> {
    motion: &'a JointMove,
    /// Number of pairs that touch, without those that usually do; then of all pairs that touch.
    touching: (usize, usize),
    distances: PathDistances,
}

/// What the pairs do along a motion.
struct PathDistances {
    /// For each pair, whether it touches somewhere.
    touches: Vec<bool>,
    /// Smallest distance of the pairs that touch nowhere and do not usually touch; infinite without such pairs. Unit: m.
    least_m: f64,
    /// The same of all pairs that touch nowhere.
    least_of_all_m: f64,
}

impl PairDistances {
    pub(super) fn new(description: &RobotDescription) -> Result<Self, ProximityError> {
        let links = description.robot.links().len();
        Ok(Self {
            clearance: Clearance::new(description, &[], PairChoice::Usual)?,
            tree: UrdfTree::new(&description.robot),
            by_tree: vec![Pose::identity(); links],
            root_from_links: vec![Isometry3::identity(); links],
        })
    }

    /// The first motion with all links far apart, or that with the fewest links touching, and of these with the largest
    /// distance. One that the actuators can hold comes before others, as in `moves`, unless links touch on it.
    pub(super) fn farthest(
        &mut self,
        description: &RobotDescription,
        moves: &[JointMove],
    ) -> Option<FarthestMove> {
        let (usual, always) = self.usually_touching(description, moves);
        let held = moves.iter().filter(|motion| motion.is_held).count();
        let mut best: Option<CandidateMove<'_>> = None;
        for (at, motion) in moves.iter().enumerate() {
            let is_apart = best.as_ref().is_some_and(|best| best.touching.0 == 0);
            // Motions that the actuators hold come first in `moves`. Others are tried only if links touch on all of
            // those, and a few of each are enough.
            let is_enough = is_apart && (at >= MOST || at >= held);
            if is_enough || at >= held + MOST {
                break;
            }
            let distances = self.along(description, motion, &usual);
            // Pairs that usually touch do so because of their hulls: they do not count against a motion, but decide
            // between equal ones.
            let unusual =
                distances.touches.iter().zip(&usual).filter(|(touches, usual)| **touches && !**usual);
            let all = distances.touches.iter().filter(|touches| **touches).count();
            let touching = (unusual.count(), all);
            // Pairs that touch are ignored by the scenario, so that the smallest distance is that of the other
            // pairs.
            let least_m = distances.least_m;
            let is_better = |known: &CandidateMove<'_>| {
                touching < known.touching || (touching == known.touching && least_m > known.distances.least_m)
            };
            if best.as_ref().is_none_or(is_better) {
                best = Some(CandidateMove { motion, touching, distances });
            }
            if touching.0 == 0 && touching.1 <= always && least_m >= FAR_M {
                break;
            }
        }
        let CandidateMove { motion, distances, .. } = best?;
        let touches = |pair: &usize| distances.touches[*pair];
        let names = |pair: usize| self.clearance.names(pair).map(str::to_owned);
        let all = 0..usual.len();
        Some(FarthestMove {
            motion: motion.clone(),
            least_m: Some(distances.least_of_all_m).filter(|least_m| least_m.is_finite()),
            ignored: all.clone().filter(touches).map(names).collect(),
            touching: all.filter(|pair| touches(pair) && !usual[*pair]).map(names).collect(),
        })
    }

    /// For each pair, whether its shapes overlap with all joints at 0, or at nearly all starts: convex hulls do where
    /// the links themselves do not. And how many do so at nearly all starts.
    fn usually_touching(
        &mut self,
        description: &RobotDescription,
        moves: &[JointMove],
    ) -> (Vec<bool>, usize) {
        let stride = moves.len().div_ceil(MOST).max(1);
        let mut counts = vec![0_usize; self.clearance.pairs().len()];
        for motion in moves.iter().step_by(stride) {
            self.place(&motion.start);
            self.touching_now(|pair| counts[pair] += 1);
        }
        // Zero is the pose in which descriptions are drawn: shapes that overlap there do so by design.
        let mut zero = RobotQ::zeros(description.robot.dof());
        move_inside_limits(&mut zero, &description.robot);
        let mut touches_at_zero = vec![false; counts.len()];
        self.place(&zero);
        self.touching_now(|pair| touches_at_zero[pair] = true);
        // All but one in twenty.
        let looked_at = moves.iter().step_by(stride).len();
        let is_always = |count: usize| 20 * count >= 19 * looked_at;
        let always = counts.iter().filter(|&&count| is_always(count)).count();
        let usual = counts.into_iter().zip(touches_at_zero);
        (usual.map(|(count, at_zero)| at_zero || is_always(count)).collect(), always)
    }

    /// Which pairs touch along a motion, and how near the others come. Twice along it: the smallest distance is of the pairs that
    /// touch nowhere, and only pairs whose bound is below the smallest so far are measured.
    fn along(&mut self, description: &RobotDescription, motion: &JointMove, usual: &[bool]) -> PathDistances {
        let path: Vec<RobotQ> = (0..=SAMPLES_OF_PATH)
            .map(|at| motion.at(&description.robot, f64::from(at) / f64::from(SAMPLES_OF_PATH)))
            .collect();
        let mut touches = vec![false; usual.len()];
        for q in &path {
            self.place(q);
            self.touching_now(|pair| touches[pair] = true);
        }
        let (mut least_m, mut least_of_all_m) = (f64::INFINITY, f64::INFINITY);
        for q in path.iter().rev() {
            self.place(q);
            let unusual = self.clearance.nearest_of(least_m, |pair, _| !touches[pair] && !usual[pair]);
            least_m = unusual.map_or(least_m, |nearest| nearest.distance_m);
            least_of_all_m = least_of_all_m.min(least_m);
            let any = self.clearance.nearest_of(least_of_all_m, |pair, _| !touches[pair]);
            least_of_all_m = any.map_or(least_of_all_m, |nearest| nearest.distance_m);
        }
        PathDistances { touches, least_m, least_of_all_m }
    }

    /// Passes each pair that touches where the links are.
    fn touching_now(&mut self, mut touching: impl FnMut(usize)) {
        self.clearance.below(TOUCH_M, |_| f64::INFINITY, |pair, _| touching(pair));
    }

    fn place(&mut self, q: &RobotQ) {
        self.tree.root_from_links_into(q, &mut self.by_tree).expect("a configuration of this robot");
        for (pose, by_tree) in self.root_from_links.iter_mut().zip(&self.by_tree) {
            *pose = by_tree.to_isometry();
        }
        self.clearance.move_links(&self.root_from_links);
    }
}
