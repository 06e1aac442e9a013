//! Pairs whose distance no motion changes, of links and of a link with an obstacle at rest: they are near because arm and cell
//! are built that way, and a plot of the smallest distance must not show them instead of what comes near.

use congruent_description::RobotDescription;
use congruent_kinematics::{Pose, UrdfTree, random_configurations};
use nalgebra::Isometry3;

use super::{clearance::Clearance, pairs::Pair};

/// Configurations that are compared with the first. Kind: choice; a pair that moves differs in the second already, nearly
/// always.
const CONFIGURATIONS: usize = 12;
/// A distance that varies by no more is constant. Kind: rounding and tolerance of the distance query, which was seen to vary
/// by 1e-9 m; joints move links by millimetres. Unit: m.
const CONSTANT_M: f64 = 1e-6;

impl Clearance {
    /// For each pair whether it keeps its distance in all configurations, as links beside each other do, or the first link above
    /// its table. The instant of `self` stays.
    pub fn constant_pairs(&self, description: &RobotDescription) -> Vec<bool> {
        let robot = &description.robot;
        let links = robot.links().len();
        // A copy: the bounds of the run follow the motion of the run.
        let mut copy = self.clone();
        let pairs: Vec<Pair> = self.pairs().collect();
        let may_be = |pair: &Pair| pair.a < links && (pair.b < links || !self.can_move[pair.b]);
        let mut is_constant: Vec<bool> = pairs.iter().map(may_be).collect();
        let mut first_m = vec![f64::NAN; pairs.len()];
        let (tree, mut poses) = (UrdfTree::new(robot), vec![Pose::identity(); links]);
        for q in random_configurations(robot, 0, CONFIGURATIONS) {
            if tree.root_from_links_into(&q, &mut poses).is_err() {
                return vec![false; pairs.len()];
            }
            copy.move_links(&poses.iter().map(Pose::to_isometry).collect::<Vec<Isometry3<f64>>>());
            for (pair, is_constant) in is_constant.iter_mut().enumerate().filter(|(_, constant)| **constant) {
                let distance_m = copy.measure(pair);
                if first_m[pair].is_nan() {
                    first_m[pair] = distance_m;
                }
                // Only pairs that were constant so far are measured again: two configurations for nearly all.
                *is_constant = (distance_m - first_m[pair]).abs() <= CONSTANT_M;
            }
        }
        is_constant
    }
}
