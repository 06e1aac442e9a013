//! Mimic joints follow their masters rigidly: what the certificates bound are the torques of the joints that are driven,
//! at positions that the robot can take.
//!
//! The torque of a driven joint is its own and, times their ratio, that of each follower (virtual work). The bound from
//! above lets the positions of followers vary by themselves, which contains what they can be; what is attained does not.

use congruent_description::RobotQ;

use super::bracket::AttainedAt;
use crate::side::Frames;

/// Which joints move together.
#[derive(Debug, Clone)]
pub(super) struct Coupling {
    /// For each driven joint itself and its followers with their ratios; empty for a follower.
    groups: Vec<Vec<(usize, f64)>>,
    /// Master, ratio, offset of each follower.
    followers: Vec<(usize, Follower)>,
    ranges: Vec<(f64, f64)>,
}

#[derive(Debug, Clone, Copy)]
struct Follower {
    master: usize,
    ratio: f64,
    offset: f64,
}

impl Coupling {
    pub(super) fn new(frames: &Frames) -> Self {
        let mut groups: Vec<Vec<(usize, f64)>> = (0..frames.dof()).map(|joint| vec![(joint, 1.0)]).collect();
        let mut followers = Vec::new();
        for (joint, place) in frames.joints.iter().enumerate() {
            if let Some((master, ratio, offset)) = place.follows {
                groups[joint].clear();
                groups[master].push((joint, ratio));
                followers.push((joint, Follower { master, ratio, offset }));
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
        self.groups[joint].iter().map(|(joint, ratio)| ratio * tau[*joint]).sum()
    }

    /// Puts followers where their masters have them.
    pub(super) fn place(&self, q: &mut RobotQ) {
        for (joint, of) in &self.followers {
            q[*joint] = of.ratio * q[of.master] + of.offset;
        }
    }

    /// Puts the masters of some joints where these want them.
    pub(super) fn lead(&self, q: &mut RobotQ, joints: &[usize]) {
        for (joint, of) in
            self.followers.iter().filter(|(joint, of)| joints.contains(joint) && of.ratio != 0.0)
        {
            q[of.master] = (q[*joint] - of.offset) / of.ratio;
        }
    }

    /// Gives followers the speeds or accelerations of their masters.
    pub(super) fn spread(&self, values: &mut [f64]) {
        for (joint, of) in &self.followers {
            values[*joint] = of.ratio * values[of.master];
        }
    }

    /// A motion that the robot can make.
    pub(super) fn follow(&self, at: &mut AttainedAt) {
        self.place(&mut at.q);
        self.spread(&mut at.qd);
        self.spread(&mut at.qdd);
    }

    /// Climbs to a larger value, one driven joint of these at a time; followers go with them.
    pub(super) fn climb<E>(
        &self,
        q: &mut RobotQ,
        joints: &[usize],
        mut value: impl FnMut(&RobotQ) -> Result<f64, E>,
    ) -> Result<f64, E> {
        self.lead(q, joints);
        self.place(q);
        let mut driven: Vec<usize> = joints.iter().map(|&joint| self.driver(joint)).collect();
        driven.sort_unstable();
        driven.dedup();
        let mut best = value(q)?;
        for _ in 0..ROUNDS {
            let before = best;
            for &joint in &driven {
                self.climb_one(joint, (q, &mut best), &mut value)?;
            }
            if best <= before * (1.0 + LEAST_GAIN) {
                break;
            }
        }
        Ok(best)
    }

    fn climb_one<E>(
        &self,
        joint: usize,
        (q, best): (&mut RobotQ, &mut f64),
        value: &mut impl FnMut(&RobotQ) -> Result<f64, E>,
    ) -> Result<(), E> {
        let (lower, upper) = self.ranges[joint];
        let mut step = (upper - lower) / f64::from(POSITIONS);
        for index in 0..=POSITIONS {
            self.try_at((joint, lower + step * f64::from(index)), (q, best), value)?;
        }
        for _ in 0..HALVINGS {
            for by in [-step, step] {
                let position = (q[joint] + by).clamp(lower, upper);
                self.try_at((joint, position), (q, best), value)?;
            }
            step /= 2.0;
        }
        Ok(())
    }

    fn try_at<E>(
        &self,
        (joint, position): (usize, f64),
        (q, best): (&mut RobotQ, &mut f64),
        value: &mut impl FnMut(&RobotQ) -> Result<f64, E>,
    ) -> Result<(), E> {
        let before = q[joint];
        q[joint] = position;
        self.place(q);
        let found = value(q)?;
        if found > *best {
            *best = found;
        } else {
            q[joint] = before;
            self.place(q);
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
        let best = coupling.climb(&mut q, &[1], value).unwrap();
        assert!((q[0] - 0.54).abs() < 1e-4 && (q[1] + 0.58).abs() < 2e-4, "{q:?} {best}");
    }
}
