//! Poses of all links at seeded configurations, and screws of all joints at zero.

use congruent_description::{JointIndex, Robot, RobotQ};
use congruent_kinematics::{Pose, Proof, UrdfTree, sample_configurations};
use nalgebra::Vector3;

use super::matched::Matched;

/// Random configurations, in addition to zero, single axes and limits.
const RANDOM_CONFIGURATIONS: usize = 100;

/// The largest differences, and the largest distance of a link from the root, m.
pub(super) fn compare(matched: &Matched<'_>, seed: u64) -> (Proof, f64) {
    let Matched { written, found, joints, .. } = matched;
    let trees = [UrdfTree::new(written), UrdfTree::new(found)];
    let mut poses = [written, found].map(|robot| vec![Pose::identity(); robot.links().len()]);
    let mut found_q = RobotQ::zeros(found.dof());
    let (mut proof, mut reach_m) = (Proof::default(), 0.0);
    let sampled = sample_configurations(written, seed, RANDOM_CONFIGURATIONS);
    proof.configurations = sampled.len();
    for (number, q) in sampled.iter().enumerate() {
        for &(ours, theirs) in joints {
            if let (Some(from), Some(to)) = (written.coordinate(ours), found.coordinate(theirs)) {
                found_q[to] = q[from];
            }
        }
        let [ours, theirs] = &mut poses;
        let are_computed = trees[0].root_from_links_into(q, ours).is_ok()
            && trees[1].root_from_links_into(&found_q, theirs).is_ok();
        let (apart_m, angle_rad) =
            if are_computed { apart(matched, ours, theirs) } else { (f64::NAN, f64::NAN) };
        reach_m = ours.iter().map(|pose| pose.translation.norm()).fold(reach_m, f64::max);
        proof.position_m = larger(proof.position_m, apart_m);
        proof.orientation_rad = larger(proof.orientation_rad, angle_rad);
        // The first configuration is zero.
        if number == 0 {
            (proof.home_m, proof.home_rad) = (apart_m, angle_rad);
            for &(ours_of, theirs_of) in joints {
                let [a, b] = [screw(written, ours_of, ours), screw(found, theirs_of, theirs)];
                proof.screw_rad = larger(proof.screw_rad, (a.0 - b.0).norm());
                proof.screw_m = larger(proof.screw_m, (a.1 - b.1).norm());
            }
        }
    }
    (proof, reach_m)
}

/// The larger number; NaN if one is: `f64::max` would hide it.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// The largest distance, m, and angle, rad, of a link from itself.
fn apart(matched: &Matched<'_>, ours: &[Pose], theirs: &[Pose]) -> (f64, f64) {
    let pairs = ours.iter().zip(&matched.links).zip(&matched.is_compared).filter(|(_, is)| **is);
    pairs.fold((0.0, 0.0), |(apart_m, angle_rad), ((pose, link), _)| {
        let other = &theirs[link.get()];
        (larger(apart_m, pose.distance_m(other)), larger(angle_rad, pose.angle_rad(other)))
    })
}

/// The screw of a joint in the root: direction and moment, by Lynch & Park, *Modern Robotics* (2017), definition 3.24.
fn screw(robot: &Robot, joint: JointIndex, root_from_links: &[Pose]) -> (Vector3<f64>, Vector3<f64>) {
    let joint = robot.joint(joint);
    let root_from_child = &root_from_links[joint.child.get()];
    let axis = root_from_child.rotation * joint.axis_in_joint.into_inner();
    if joint.kind.is_angular() {
        (axis, root_from_child.translation.cross(&axis))
    } else {
        (Vector3::zeros(), axis)
    }
}
