//! How near links come to each other along a motion.

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::{Pose, UrdfTree, move_inside_limits};
use congruent_proximity::{Clearance, PairChoice, ProximityError};
use nalgebra::Isometry3;

use super::joint_move::JointMove;

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
    /// Pairs that touch, without those that usually do; then all pairs that touch.
    touching: (usize, usize),
    /// The smallest distance of the others.
    least_m: f64,
    /// Smallest distance along the motion, for each pair. Unit: m.
    distances_m: Vec<f64>,
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
            let distances_m = self.along(description, motion);
            let others = || distances_m.iter().zip(&usual).filter(|(_, usual)| !**usual).map(|(&m, _)| m);
            // Pairs that usually touch do so because of their hulls: they do not count against a motion, but decide
            // between equal ones.
            let touching = others().filter(|&distance_m| distance_m < TOUCH_M).count();
            let all = distances_m.iter().filter(|&&distance_m| distance_m < TOUCH_M).count();
            let touching = (touching, all);
            // Pairs that touch are ignored by the scenario, so that the smallest distance is that of the other
            // pairs.
            let least_m = others().filter(|&m| m >= TOUCH_M).fold(f64::INFINITY, f64::min);
            let is_better = |known: &CandidateMove<'_>| {
                touching < known.touching || (touching == known.touching && least_m > known.least_m)
            };
            if best.as_ref().is_none_or(is_better) {
                best = Some(CandidateMove { motion, touching, least_m, distances_m });
            }
            if touching.0 == 0 && touching.1 <= always && least_m >= FAR_M {
                break;
            }
        }
        let CandidateMove { motion, distances_m, .. } = best?;
        let touches = |pair: &usize| distances_m[*pair] < TOUCH_M;
        let names = |pair: usize| self.clearance.names(pair).map(str::to_owned);
        let apart = distances_m.iter().copied().filter(|&distance_m| distance_m >= TOUCH_M);
        let all = 0..distances_m.len();
        Some(FarthestMove {
            motion: motion.clone(),
            least_m: apart.min_by(f64::total_cmp),
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
            let distances = self.at(&motion.start);
            counts.iter_mut().zip(distances).for_each(|(count, m)| *count += usize::from(m < TOUCH_M));
        }
        // Zero is the pose in which descriptions are drawn: shapes that overlap there do so by design.
        let mut zero = RobotQ::zeros(description.robot.dof());
        move_inside_limits(&mut zero, &description.robot);
        let at_zero = self.at(&zero);
        // All but one in twenty.
        let looked_at = moves.iter().step_by(stride).len();
        let is_always = |count: usize| 20 * count >= 19 * looked_at;
        let always = counts.iter().filter(|&&count| is_always(count)).count();
        (counts.into_iter().zip(at_zero).map(|(count, m)| m < TOUCH_M || is_always(count)).collect(), always)
    }

    /// The least distance of each pair along a motion.
    fn along(&mut self, description: &RobotDescription, motion: &JointMove) -> Vec<f64> {
        let mut least = vec![f64::INFINITY; self.clearance.pairs().len()];
        for at in 0..=SAMPLES_OF_PATH {
            let q = motion.at(&description.robot, f64::from(at) / f64::from(SAMPLES_OF_PATH));
            least.iter_mut().zip(self.at(&q)).for_each(|(least, m)| *least = least.min(m));
        }
        least
    }

    fn at(&mut self, q: &RobotQ) -> Vec<f64> {
        self.tree.root_from_links_into(q, &mut self.by_tree).expect("a configuration of this robot");
        for (pose, by_tree) in self.root_from_links.iter_mut().zip(&self.by_tree) {
            *pose = by_tree.to_isometry();
        }
        self.clearance.move_links(&self.root_from_links);
        let pairs = self.clearance.pairs().len();
        (0..pairs).map(|pair| self.clearance.measure(pair)).collect()
    }
}
