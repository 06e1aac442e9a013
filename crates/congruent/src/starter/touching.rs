//! How near links come to each other along a motion.

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::{Pose, UrdfTree};
use congruent_twin::proximity::{Clearance, PairChoice, ProximityError};
use nalgebra::Isometry3;

use super::joint_move::JointMove;

/// Configurations along a motion at which distances are measured.
const ON_THE_WAY: u32 = 10;
/// Links that are nearer count as touching: shapes that only just do not.
const TOUCH_M: f64 = 1e-3;
/// A pair that touches at this share of the starts is one whose shapes always overlap.
const ALWAYS: f64 = 0.95;
/// No other start is looked for if links stay this far apart.
const FAR_M: f64 = 0.02;

/// The distances of all pairs that a scenario would measure.
pub(super) struct Distances {
    clearance: Clearance,
    tree: UrdfTree,
    by_tree: Vec<Pose>,
    root_from_links: Vec<Isometry3<f64>>,
}

/// The motion whose links stay farthest apart, of those that were looked at.
pub(super) struct FarthestMove {
    pub(super) motion: JointMove,
    /// Smallest distance of the pairs that are not ignored; `None` without such pairs.
    pub(super) least_m: Option<f64>,
    /// Pairs that touch on the way whatever the start is, or wherever one looked.
    pub(super) ignored: Vec<[String; 2]>,
}

impl Distances {
    pub(super) fn new(description: &RobotDescription) -> Result<Self, ProximityError> {
        let links = description.robot.links().len();
        Ok(Self {
            clearance: Clearance::new(description, &[], PairChoice::Usual)?,
            tree: UrdfTree::new(&description.robot),
            by_tree: vec![Pose::identity(); links],
            root_from_links: vec![Isometry3::identity(); links],
        })
    }

    /// The first motion with all links far apart, or the one with the largest distance.
    pub(super) fn farthest(
        &mut self,
        description: &RobotDescription,
        moves: &[JointMove],
    ) -> Option<FarthestMove> {
        let always = self.always_touching(moves);
        let mut best: Option<(f64, &JointMove, Vec<f64>)> = None;
        for motion in moves {
            let distances = self.along(description, motion);
            let others = distances.iter().zip(&always).filter(|(_, always)| !**always);
            let least_m = others.map(|(&distance_m, _)| distance_m).fold(f64::INFINITY, f64::min);
            if best.as_ref().is_none_or(|(known_m, ..)| least_m > *known_m) {
                best = Some((least_m, motion, distances));
            }
            if least_m >= FAR_M {
                break;
            }
        }
        let (_, motion, distances) = best?;
        let touches = |pair: &usize| distances[*pair] < TOUCH_M;
        let names = |pair: usize| {
            let (a, b) = self.clearance.names(pair);
            [a.to_owned(), b.to_owned()]
        };
        let apart = distances.iter().copied().filter(|&distance_m| distance_m >= TOUCH_M);
        Some(FarthestMove {
            motion: motion.clone(),
            least_m: apart.min_by(f64::total_cmp),
            ignored: (0..distances.len()).filter(touches).map(names).collect(),
        })
    }

    /// For each pair, whether its shapes overlap at nearly all starts.
    fn always_touching(&mut self, moves: &[JointMove]) -> Vec<bool> {
        let mut counts = vec![0_u32; self.clearance.pairs().len()];
        for motion in moves {
            let distances = self.at(&motion.start);
            counts.iter_mut().zip(distances).for_each(|(count, m)| *count += u32::from(m < TOUCH_M));
        }
        let most = ALWAYS * f64::from(u32::try_from(moves.len()).unwrap_or(u32::MAX));
        counts.into_iter().map(|count| f64::from(count) >= most).collect()
    }

    /// The least distance of each pair along a motion.
    fn along(&mut self, description: &RobotDescription, motion: &JointMove) -> Vec<f64> {
        let mut least = vec![f64::INFINITY; self.clearance.pairs().len()];
        for at in 0..=ON_THE_WAY {
            let q = motion.at(&description.robot, f64::from(at) / f64::from(ON_THE_WAY));
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
