//! Equalities of joints to followers (`mimic`), where they are linear.

use congruent_input::{Capability, Diagnostic, Diagnostics};
use congruent_mjcf::{MjEquality, MjEqualityKind, MjModel};

use super::{placed::placed, tree::RobotParts};
use crate::codes;

/// Makes followers of the linear equalities that hold; what else holds is reported. Loops were reported by the reader.
pub(super) fn add(model: &MjModel, parts: &mut RobotParts, diagnostics: &mut Diagnostics) {
    for equality in model.equalities.iter().filter(|equality| equality.is_active) {
        if let Err(found) = follow(model, equality, parts) {
            let found = found.needed_by(Some(Capability::Physics));
            diagnostics.push(placed(found, &equality.place));
        }
    }
}

fn follow(model: &MjModel, equality: &MjEquality, parts: &mut RobotParts) -> Result<(), Diagnostic> {
    let refused = |message: String| {
        let help = "the joint is read as one that moves by itself";
        Err(Diagnostic::warning(codes::mjcf::COUPLING, message).with_help(help))
    };
    let (follower, leader, coefficients) = match &equality.kind {
        MjEqualityKind::Joint { follower, leader, coefficients } => (*follower, *leader, coefficients.value),
        MjEqualityKind::Tendon { .. } => {
            return refused("an equality of tendons couples joints, which is not read".to_owned());
        }
        MjEqualityKind::Connect { .. } | MjEqualityKind::Weld { .. } => return Ok(()),
    };
    let [constant, factor, higher @ ..] = coefficients;
    let name = &model.joints[follower].name;
    let Some(leader) = leader.filter(|_| is_any(&coefficients[1..])) else {
        return refused(format!("an equality locks joint \"{name}\", which is not read"));
    };
    if is_any(&higher) {
        let message = format!(
            "joint \"{name}\" follows joint \"{}\" by a polynomial of degree 2 or more, which is not read",
            model.joints[leader].name
        );
        return refused(message);
    }
    let (Some(at), Some(of)) = (parts.joint_positions[follower], parts.joint_positions[leader]) else {
        return refused(format!("an equality couples joint \"{name}\" with one that is fixed here"));
    };
    if parts.joints[at].mimic.is_some() {
        return refused(format!("joint \"{name}\" follows two joints, of which only the first is read"));
    }
    // q1 - ref1 = c0 + c1 (q2 - ref2)
    let [own, other] = [follower, leader].map(|joint| model.joints[joint].reference.value);
    let offset = own + constant - factor * other;
    let master = parts.joints[of].joint.name.clone();
    parts.joints[at].mimic = Some((master, factor, offset));
    Ok(())
}

/// Whether one of the numbers is not zero.
fn is_any(numbers: &[f64]) -> bool {
    numbers.iter().any(|&number| number != 0.0)
}
