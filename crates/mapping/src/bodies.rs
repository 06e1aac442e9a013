//! What the bodies of two descriptions say where their axes leave a choice: a wrist moves its tip alike with one joint turned
//! round and half turns at its neighbours, but then a body is turned round as well.

use congruent_description::{JointIndex, RobotDescription};
use congruent_kinematics::ScrewTree;
use nalgebra::{Isometry3, Point3};

use crate::{axis::isometry, names::JointPairs, variables::Way};

/// Differences of centres of mass below this share of the reach say nothing. Kind: choice; two sets of inertials of one arm
/// differ by some centimetres.
const SAME_BODY: f64 = 0.01;

/// The ways in the order of their choice: those whose bodies lie where those of the robot are before those that turn some
/// round, and else as they were.
pub(crate) fn by_bodies(
    ways: Vec<Way>,
    descriptions: [&RobotDescription; 2],
    screws: &[ScrewTree; 2],
    (pairs, reach_m): (&JointPairs, f64),
) -> Vec<Way> {
    if ways.len() < 2 {
        return ways;
    }
    let apart = |way: &Way| apart_m(way, descriptions, screws, pairs);
    let apart_m: Vec<f64> = ways.iter().map(apart).collect();
    let least = apart_m.iter().copied().fold(f64::INFINITY, f64::min);
    let is_other = |apart_m: f64| apart_m > 2.0 * least + SAME_BODY * reach_m;
    let mut ordered: Vec<(bool, Way)> = apart_m.into_iter().map(is_other).zip(ways).collect();
    // Stable: the simplest way stays first.
    ordered.sort_by_key(|(is_other, _)| *is_other);
    ordered.into_iter().map(|(_, way)| way).collect()
}

/// The sum of the distances between the centres of mass of the links that matched joints carry, and between links of one name,
/// at zero.
fn apart_m(way: &Way, [a, b]: [&RobotDescription; 2], screws: &[ScrewTree; 2], pairs: &JointPairs) -> f64 {
    let mut moved = way.a_from_b;
    let mut apart_m = 0.0;
    for ([of_a, of_b], variable) in pairs.iter().zip(&way.variables) {
        if let Some(screw) = screws[1].screw(*of_b) {
            moved *= crate::axis::Axis::from_screw(screw).motion(variable.offset);
        }
        apart_m += of_body(a, [*of_a, *of_b], b, screws, &moved);
    }
    apart_m
}

/// The same of one joint: its link, and the links that are fixed to it.
fn of_body(
    a: &RobotDescription,
    [of_a, of_b]: [JointIndex; 2],
    b: &RobotDescription,
    screws: &[ScrewTree; 2],
    moved: &Isometry3<f64>,
) -> f64 {
    let bodies = [a.robot.joint(of_a).child, b.robot.joint(of_b).child];
    let com = |description: &RobotDescription, of: usize| {
        let inertia = description.robot.link(bodies[of]).inertia.filter(|inertia| inertia.mass_kg > 0.0)?;
        let com = Point3::from(inertia.link_from_inertial.translation.vector);
        Some(isometry(screws[of].home(bodies[of])) * com)
    };
    let of_com = com(a, 0).zip(com(b, 1)).map_or(0.0, |(here, there)| (here - moved * there).norm());
    let named = a.robot.link_indices().filter(|&link| a.robot.body(link) == bodies[0] && link != bodies[0]);
    let of_named = named.filter_map(|link| {
        let there = b.robot.find_link(&a.robot.link(link).name)?;
        // A frame that is turned round is as far away as the reach of a hand.
        let off = isometry(screws[0].home(link)).inverse() * moved * isometry(screws[1].home(there));
        (b.robot.body(there) == bodies[1]).then(|| off.translation.vector.norm() + 0.1 * off.rotation.angle())
    });
    of_com + of_named.sum::<f64>()
}
