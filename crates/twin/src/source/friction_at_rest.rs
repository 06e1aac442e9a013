//! Dry friction of joints at rest: any torque up to its largest, whichever keeps the joint at rest. An engine's constraint creeps
//! in the short steps that accelerations are measured with, so the torque is computed from the accelerations without it.

use congruent_description::Robot;
use nalgebra::DMatrix;

/// Most rounds over the joints. Kind: bound of a loop; coupled joints of arms need some dozen.
const MOST_ROUNDS: usize = 10_000;
/// The rounds end if none changes an acceleration by a larger share of the largest. No unit; kind: rounding.
const UNCHANGED: f64 = 1e-15;

/// Adds to `qdd`, which has no friction of the joints `at_rest`, what that friction changes. `inverse` is that of the mass matrix.
///
/// The torques `f` solve `qdd = qdd_free + M^-1 f` with `|f| <= largest`, and `qdd = 0` wherever `|f| < largest`: a linear
/// complementarity problem with a positive semidefinite matrix, by projected Gauss-Seidel (Murty, *Linear Complementarity*, 1988, 9.2).
pub(super) fn hold(qdd: &mut [f64], at_rest: &[usize], largest: &[f64], inverse: &DMatrix<f64>) {
    let mut torques = vec![0.0; at_rest.len()];
    let scale = qdd.iter().fold(0.0, |most: f64, qdd| most.max(qdd.abs()));
    for _ in 0..MOST_ROUNDS {
        let mut changed: f64 = 0.0;
        for (torque, &joint) in torques.iter_mut().zip(at_rest) {
            let lightness = inverse[(joint, joint)];
            // Rounding of a singular matrix: nothing moves this joint.
            if lightness <= 0.0 {
                continue;
            }
            let stopping = (*torque - qdd[joint] / lightness).clamp(-largest[joint], largest[joint]);
            let added = stopping - *torque;
            *torque = stopping;
            for (other, qdd) in qdd.iter_mut().enumerate() {
                *qdd += inverse[(other, joint)] * added;
            }
            changed = changed.max((added * lightness).abs());
        }
        if changed <= UNCHANGED * scale {
            break;
        }
    }
    for (torque, &joint) in torques.iter().zip(at_rest) {
        // What is held is at rest exactly, without the rounding of the sums.
        if torque.abs() < largest[joint] {
            qdd[joint] = 0.0;
        }
    }
}

/// The inverse of the mass matrix of a robot whose joints follow others: `G (G' M G)^-1 G'` with the ratios `G` of all joints to the
/// independent ones. `None` if it has none.
pub(super) fn coupled_inverse(robot: &Robot, mass_matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let joints = robot.movable_joints();
    let independent: Vec<usize> =
        (0..joints.len()).filter(|&row| robot.joint(joints[row]).mimic.is_none()).collect();
    let mut ratios = DMatrix::zeros(joints.len(), independent.len());
    for (row, &joint) in joints.iter().enumerate() {
        let (driver, ratio) = match robot.joint(joint).mimic {
            Some(mimic) => (robot.coordinate(mimic.master)?, mimic.multiplier),
            None => (row, 1.0),
        };
        let column = independent.iter().position(|&of| of == driver)?;
        ratios[(row, column)] = ratio;
    }
    let reduced = (ratios.transpose() * mass_matrix * &ratios).try_inverse()?;
    Some(&ratios * reduced * ratios.transpose())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Accelerations of two joints at rest under these torques, with frictions of 5 and 2.
    fn accelerations(torques: [f64; 2]) -> Vec<f64> {
        let inverse = DMatrix::from_row_slice(2, 2, &[4.0, 1.0, 1.0, 2.0]).try_inverse().unwrap();
        let mut qdd: Vec<f64> =
            (&inverse * nalgebra::DVector::from_row_slice(&torques)).iter().copied().collect();
        hold(&mut qdd, &[0, 1], &[5.0, 2.0], &inverse);
        qdd
    }

    #[test]
    fn friction_holds_up_to_its_largest_torque() {
        assert_eq!(accelerations([4.9, 0.0]), [0.0, 0.0]);
        assert_eq!(accelerations([-4.9, 1.9]), [0.0, 0.0]);
    }

    #[test]
    fn a_joint_that_moves_accelerates_against_all_of_its_friction() {
        // 5 of 9 N m are left for the first joint; the second is held, with 1 N m of its 2.
        let found = accelerations([9.0, 0.0]);
        assert!((found[0] - 1.0).abs() < 1e-14 && found[1] == 0.0, "{found:?}");
        // Both move: M qdd = [3, 1].
        let found = accelerations([8.0, 3.0]);
        assert!((found[0] - 5.0 / 7.0).abs() < 1e-14 && (found[1] - 1.0 / 7.0).abs() < 1e-14, "{found:?}");
    }
}
