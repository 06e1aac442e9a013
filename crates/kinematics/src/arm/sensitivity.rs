//! The displacement of the tool by a small error of one parameter, over the whole joint range.

use congruent_description::ArmQ;

use super::{model::ArmJoint, pattern_search::maximize};
use crate::{spatial::pose::Pose, uniform::Uniform};

/// How the joint range is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sampling {
    /// Number of random configurations within the limits.
    pub samples: usize,
    /// Seed of the random configurations.
    pub seed: u64,
}

/// How far a tool is displaced over the joint range.
#[derive(Debug, Clone, PartialEq)]
pub struct Displacement {
    /// Largest distance, m: by local search from the worst samples, so attained, but not proved.
    pub worst_m: f64,
    /// Mean distance over the samples, m.
    pub mean_m: f64,
    /// Largest angle over the samples, rad.
    pub worst_rad: f64,
    /// The configuration of the largest distance, one entry for each joint.
    pub worst_at: ArmQ,
}

/// Number of worst samples from which a local search starts.
const SEARCHES: usize = 4;

/// The displacement of the tool between a nominal arm and the arm as built.
///
/// # Examples
/// A turning arm of 0.5 m, off by one degree: 2 sin(0.5 deg) times its length, everywhere.
/// ```
/// # use congruent_description::{JointKind, JointParts, Link, Robot};
/// # use nalgebra::{Isometry3, Vector3};
/// use congruent_description::ArmQ;
/// use congruent_kinematics::{Arm, Pose, Sampling, displacement};
/// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
/// # let parts = JointParts::new("turn", JointKind::Continuous, "base", "arm", Isometry3::identity());
/// # let robot = Robot::new("r", vec![link("base"), link("arm")], vec![parts]).unwrap();
/// let tool = Pose { translation: Vector3::new(0.5, 0., 0.), ..Pose::identity() };
/// let arm = Arm::new(&robot, robot.root(), robot.find_link("arm").unwrap(), tool)?;
/// let (mut meant, mut built) = (arm.clone(), arm.clone());
/// let degree = 1_f64.to_radians();
/// let found = displacement(
///     arm.joints(),
///     |q| (meant.base_from_tcp(q).unwrap(), built.base_from_tcp(&ArmQ::from([q[0] + degree])).unwrap()),
///     Sampling { samples: 100, seed: 0 },
/// );
/// assert!((found.worst_m - (degree / 2.0).sin()).abs() < 1e-15);
/// assert!((found.mean_m - found.worst_m).abs() < 1e-15 && (found.worst_rad - degree).abs() < 1e-15);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
pub fn displacement(
    joints: &[ArmJoint],
    mut meant_and_built: impl FnMut(&ArmQ) -> (Pose, Pose),
    sampling: Sampling,
) -> Displacement {
    let mut random = Uniform::seeded(sampling.seed);
    let mut q = ArmQ::zeros(joints.len());
    let (mut sum_m, mut worst_rad) = (0.0, 0.0_f64);
    let mut worst: Vec<(f64, ArmQ)> = Vec::with_capacity(SEARCHES + 1);
    for _ in 0..sampling.samples {
        for (q, joint) in q.iter_mut().zip(joints) {
            let (lower, upper) = joint.sampled_range();
            *q = random.between(lower, upper);
        }
        let (meant, built) = meant_and_built(&q);
        let distance_m = meant.distance_m(&built);
        sum_m += distance_m;
        worst_rad = worst_rad.max(meant.angle_rad(&built));
        // A sorted list of the few worst samples: several starts, since the worst sample may lie on a side peak.
        if worst.len() < SEARCHES || worst.last().is_some_and(|last| distance_m > last.0) {
            let at = worst.partition_point(|known| known.0 >= distance_m);
            worst.insert(at, (distance_m, q.clone()));
            worst.truncate(SEARCHES);
        }
    }
    let mut distance_m = |q: &ArmQ| {
        let (meant, built) = meant_and_built(q);
        meant.distance_m(&built)
    };
    for (worst_m, q) in &mut worst {
        *worst_m = maximize(joints, q, &mut distance_m);
    }
    let found = worst.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    let (worst_m, worst_at) = found.unwrap_or((0.0, q));
    #[expect(clippy::cast_precision_loss, reason = "samples are far fewer than 2^52")]
    let mean_m = sum_m / sampling.samples.max(1) as f64;
    Displacement { worst_m, mean_m, worst_rad, worst_at }
}
