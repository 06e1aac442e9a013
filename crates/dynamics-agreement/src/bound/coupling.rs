//! Mimic joints follow their masters rigidly: the certificates bound the torques of the driven joints at positions that the
//! robot can reach.
//!
//! The torque of a driven joint is its own plus that of each follower times its ratio (virtual work). For the upper bound the
//! positions of followers vary independently, which contains all positions that they can have; attained values follow.

use congruent_description::RobotQ;

use super::bracket::AttainedAt;
use crate::model::Frames;

/// Which joints move together: driven joints, their followers, and the ranges of all.
#[derive(Debug, Clone)]
pub(super) struct Coupling {
    /// For each driven joint itself and its followers with their ratios; empty for a follower.
    groups: Vec<Vec<(usize, f64)>>,
    /// Master, ratio, offset of each follower.
    followers: Vec<(usize, CoupledFollower)>,
    ranges: Vec<(f64, f64)>,
}

#[derive(Debug, Clone, Copy)]
struct CoupledFollower {
    master: usize,
    ratio: f64,
    offset: f64,
}

/// The best position that a search has found so far, and its value.
struct BestPosition<'a> {
    q: &'a mut RobotQ,
    value: f64,
}

impl Coupling {
    pub(super) fn new(frames: &Frames) -> Self {
        let mut groups: Vec<Vec<(usize, f64)>> = (0..frames.dof()).map(|joint| vec![(joint, 1.0)]).collect();
        let mut followers = Vec::new();
        for (joint, place) in frames.joints.iter().enumerate() {
            if let Some((master, ratio, offset)) = place.follows {
                // A follower has no torque of its own to bound: it is part of the torque of its master. The empty
                // group marks it.
                groups[joint].clear();
                groups[master].push((joint, ratio));
                followers.push((joint, CoupledFollower { master, ratio, offset }));
            }
        }
        let ranges = frames.joints.iter().map(|joint| joint.range).collect();
        Self { groups, followers, ranges }
    }

    /// A driven joint and its followers, each with its ratio; nothing for a follower.
    pub(super) fn group(&self, joint: usize) -> &[(usize, f64)] {
        &self.groups[joint]
    }

    pub(super) fn is_driven(&self, joint: usize) -> bool {
        !self.groups[joint].is_empty()
    }

    /// The driven joint that a joint moves with.
    pub(super) fn driver(&self, joint: usize) -> usize {
        let follower = self.followers.iter().find(|(follower, _)| *follower == joint);
        follower.map_or(joint, |(_, of)| of.master)
    }

    /// Whether a joint follows another or is followed.
    pub(super) fn is_coupled(&self, joint: usize) -> bool {
        self.groups[joint].len() != 1
    }

    /// The torque at a driven joint.
    pub(super) fn torque(&self, joint: usize, tau: &[f64]) -> f64 {
        // Virtual work: tau_master * dq_master + tau_follower * dq_follower with dq_follower = ratio * dq_master.
        self.groups[joint].iter().map(|(joint, ratio)| ratio * tau[*joint]).sum()
    }

    /// Sets the positions of followers from their masters: `q = ratio * q_master + offset`.
    pub(super) fn place(&self, q: &mut RobotQ) {
        for (joint, of) in &self.followers {
            q[*joint] = of.ratio * q[of.master] + of.offset;
        }
    }

    /// Sets the masters of some followers so that these keep their positions, the inverse of [`Coupling::place`].
    pub(super) fn place_masters(&self, q: &mut RobotQ, joints: &[usize]) {
        for (joint, of) in
            self.followers.iter().filter(|(joint, of)| joints.contains(joint) && of.ratio != 0.0)
        {
            q[of.master] = (q[*joint] - of.offset) / of.ratio;
        }
    }

    /// Sets the speeds or accelerations of followers from their masters.
    pub(super) fn set_follower_rates(&self, values: &mut [f64]) {
        for (joint, of) in &self.followers {
            values[*joint] = of.ratio * values[of.master];
        }
    }

    /// Changes a motion into one that the robot can make: followers move with their masters.
    pub(super) fn follow(&self, at: &mut AttainedAt) {
        self.place(&mut at.q);
        self.set_follower_rates(&mut at.qd);
        self.set_follower_rates(&mut at.qdd);
    }

    /// Coordinate search for a larger value over the driven joints of `joints`, one at a time; followers move with them.
    pub(super) fn search<E>(
        &self,
        q: &mut RobotQ,
        joints: &[usize],
        mut value: impl FnMut(&RobotQ) -> Result<f64, E>,
    ) -> Result<f64, E> {
        // The start may come from a function in which followers are free: first the masters go where the
        // followers were, then all followers go with their masters, so that every value below is attainable.
        self.place_masters(q, joints);
        // The value is read with the followers where the robot would have them.
        self.place(q);
        // One variable for each driven joint: stepping a follower by itself would leave the configurations of the
        // robot.
        let mut driven: Vec<usize> = joints.iter().map(|&joint| self.driver(joint)).collect();
        driven.sort_unstable();
        driven.dedup();
        let mut best = BestPosition { value: value(q)?, q };
        for _ in 0..ROUNDS {
            let before = best.value;
            for &joint in &driven {
                self.search_one(joint, &mut best, &mut value)?;
            }
            // A round that gains nothing cannot be followed by one that does: the next would try the same
            // positions.
            if best.value <= before * (1.0 + LEAST_GAIN) {
                break;
            }
        }
        Ok(best.value)
    }

    fn search_one<E>(
        &self,
        joint: usize,
        best: &mut BestPosition<'_>,
        value: &mut impl FnMut(&RobotQ) -> Result<f64, E>,
    ) -> Result<(), E> {
        let (lower, upper) = self.ranges[joint];
        let mut step = (upper - lower) / f64::from(POSITIONS);
        // A grid before the halving: along one joint the torque has several maxima, and halving alone would stay
        // at the nearest.
        for index in 0..=POSITIONS {
            self.try_at(joint, lower + step * f64::from(index), best, value)?;
        }
        for _ in 0..HALVINGS {
            for by in [-step, step] {
                // Clamped instead of skipped, because the largest torque is often at a limit.
                let position = (best.q[joint] + by).clamp(lower, upper);
                self.try_at(joint, position, best, value)?;
            }
            step /= 2.0;
        }
        Ok(())
    }

    fn try_at<E>(
        &self,
        joint: usize,
        position: f64,
        best: &mut BestPosition<'_>,
        value: &mut impl FnMut(&RobotQ) -> Result<f64, E>,
    ) -> Result<(), E> {
        let before = best.q[joint];
        best.q[joint] = position;
        self.place(best.q);
        let found = value(best.q)?;
        if found > best.value {
            best.value = found;
        } else {
            best.q[joint] = before;
            self.place(best.q);
        }
        Ok(())
    }
}

/// Positions of a joint that are tried before the best is refined. Kind: choice.
const POSITIONS: u32 = 24;
/// Halvings of the interval around the best one. Kind: choice, to 1e-7 of the range.
const HALVINGS: usize = 20;
/// Most rounds over all joints. Kind: loop bound; two or three suffice.
const ROUNDS: usize = 6;
/// A round that gains less than this share is the last. No unit; kind: solver stop.
const LEAST_GAIN: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use congruent_description::parse_urdf;

    use super::*;

    #[test]
    fn a_follower_goes_with_its_master_within_both_ranges() {
        let robot = parse_urdf(
            "<robot name='r'><link name='base'/>
            <link name='a'/><joint name='one' type='revolute'><parent link='base'/><child link='a'/>
            <limit lower='-1' upper='2' effort='1' velocity='1'/></joint>
            <link name='b'/><joint name='two' type='revolute'><parent link='base'/><child link='b'/>
            <mimic joint='one' multiplier='-2' offset='0.5'/><limit lower='-2.5' upper='9' effort='1' velocity='1'/></joint>
            </robot>",
        )
        .unwrap();
        let coupling = Coupling::new(&Frames::new(&robot));
        assert_eq!(coupling.ranges, [(-1.0, 1.5), (-2.5, 2.5)]);
        assert!(coupling.is_driven(0) && !coupling.is_driven(1) && coupling.driver(1) == 0);
        assert!((coupling.torque(0, &[1.0, 10.0]) + 19.0).abs() < 1e-15);
        let mut q = RobotQ::zeros(2);
        let value = |q: &RobotQ| Ok::<f64, ()>(5.0 - (q[0] - 0.3).powi(2) - (q[1] + 0.7).powi(2));
        // q1 = 0.5 - 2 q0: the least of (q0 - 0.3)^2 + (1.2 - 2 q0)^2 is at 0.54.
        let best = coupling.search(&mut q, &[1], value).unwrap();
        assert!((q[0] - 0.54).abs() < 1e-4 && (q[1] + 0.58).abs() < 2e-4, "{q:?} {best}");
    }
}
