//! What the bodies of two descriptions say where their axes leave a choice: a wrist moves its tip alike with one joint turned
//! round and half turns at its neighbours, but then a body is turned round as well.

use congruent_description::{JointIndex, LinkIndex, RobotDescription};
use congruent_kinematics::ScrewTree;
use nalgebra::{Isometry3, Point3};

use crate::{
    axis::Axis,
    names::JointPairs,
    variables::{ChainSolution, JointVariable},
};

/// Differences of centres of mass below this share of the reach say nothing. Kind: choice; two sets of inertials of one arm
/// differ by some centimetres.
const SAME_BODY: f64 = 0.01;
/// The lever with which a turned frame counts. Unit: m; kind: choice, a hand.
const HAND_M: f64 = 0.1;

/// The solutions in the order of their choice: those whose bodies lie where those of the robot are before those that turn some
/// round, and else as they were.
pub(crate) fn by_bodies(
    solutions: Vec<ChainSolution>,
    descriptions: [&RobotDescription; 2],
    screws: &[ScrewTree; 2],
    pairs: &JointPairs,
    reach_m: f64,
) -> Vec<ChainSolution> {
    if solutions.len() < 2 {
        return solutions;
    }
    let apart = |solution: &ChainSolution| apart_m(solution, descriptions, screws, pairs);
    let apart_m: Vec<f64> = solutions.iter().map(apart).collect();
    let least = apart_m.iter().copied().fold(f64::INFINITY, f64::min);
    let is_other = |apart_m: f64| apart_m > 2.0 * least + SAME_BODY * reach_m;
    let mut ordered: Vec<(bool, ChainSolution)> = apart_m.into_iter().map(is_other).zip(solutions).collect();
    // Stable: the simplest solution stays first.
    ordered.sort_by_key(|(is_other, _)| *is_other);
    ordered.into_iter().map(|(_, solution)| solution).collect()
}

/// The sum of the distances between the centres of mass of the links that matched joints carry, between frames of one name, and
/// between limits, at zero.
fn apart_m(
    solution: &ChainSolution,
    [a, b]: [&RobotDescription; 2],
    screws: &[ScrewTree; 2],
    pairs: &JointPairs,
) -> f64 {
    let mut moved = solution.a_from_b;
    let mut apart_m = of_links(a, [a.robot.root(), b.robot.root()], b, screws, &moved);
    for ([of_a, of_b], variable) in pairs.iter().zip(&solution.variables) {
        if let Some(screw) = screws[1].screw(*of_b) {
            moved *= Axis::from_screw(screw).motion(variable.offset);
        }
        let bodies = [a.robot.joint(*of_a).child, b.robot.joint(*of_b).child];
        apart_m += of_links(a, bodies, b, screws, &moved) + of_limits(a, [*of_a, *of_b], b, *variable);
    }
    apart_m
}

/// The same of one body: of its first link and the links that are fixed to it.
fn of_links(
    a: &RobotDescription,
    bodies: [LinkIndex; 2],
    b: &RobotDescription,
    screws: &[ScrewTree; 2],
    moved: &Isometry3<f64>,
) -> f64 {
    let com = |description: &RobotDescription, of: usize| {
        let inertia = description.robot.link(bodies[of]).inertia.filter(|inertia| inertia.mass_kg > 0.0)?;
        let com = Point3::from(inertia.link_from_inertial.translation.vector);
        Some(screws[of].home(bodies[of]).to_isometry() * com)
    };
    let of_com = com(a, 0).zip(com(b, 1)).map_or(0.0, |(here, there)| (here - moved * there).norm());
    let of_body = a.robot.link_indices().filter(|&link| a.robot.body(link) == bodies[0]);
    let of_named = of_body.filter_map(|link| {
        let there = b.robot.find_link(&a.robot.link(link).name)?;
        let off = screws[0].home(link).to_isometry().inverse() * moved * screws[1].home(there).to_isometry();
        let apart_m = off.translation.vector.norm() + HAND_M * off.rotation.angle();
        (b.robot.body(there) == bodies[1]).then_some(apart_m)
    });
    of_com + of_named.sum::<f64>()
}

/// How far the limits of a joint are apart, as a distance; a whole turn changes nothing.
fn of_limits(
    a: &RobotDescription,
    [of_a, of_b]: [JointIndex; 2],
    b: &RobotDescription,
    variable: JointVariable,
) -> f64 {
    let (Some(here), Some(there)) =
        (a.robot.joint(of_a).position_range(), b.robot.joint(of_b).position_range())
    else {
        return 0.0;
    };
    let sign = if variable.is_flipped { -1.0 } else { 1.0 };
    let ends = [there.0, there.1].map(|end| sign * (end - variable.offset));
    let apart = [here.0 - ends[0].min(ends[1]), here.1 - ends[0].max(ends[1])];
    if !a.robot.joint(of_a).kind.is_angular() {
        return apart[0].abs() + apart[1].abs();
    }
    let turns = [-1.0, 0.0, 1.0].map(|turn| {
        let by = turn * std::f64::consts::TAU;
        (apart[0] - by).abs() + (apart[1] - by).abs()
    });
    HAND_M * turns.into_iter().fold(f64::INFINITY, f64::min)
}
