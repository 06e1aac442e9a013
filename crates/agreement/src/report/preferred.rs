//! Values to write: of all values within the uncertainty of a fit, one that the files already have is the likelier one.

use crate::diagnosis::{Criterion, DhEntry, Explanation, ModelPair, ModelParameter, RowConstants};

/// The explanation with each fitted value of a row replaced by the value of the same kind, from the table or the URDF,
/// that is within the digits, if there is one and the models are still accepted.
pub(super) fn with_known_values(
    explanation: &Explanation,
    models: &ModelPair,
    criterion: &Criterion,
) -> Explanation {
    let mut preferred = explanation.clone();
    let free = explanation.faults.iter().flat_map(|fault| &fault.free);
    for parameter in free {
        let &ModelParameter::Row(row, entry) = parameter else { continue };
        let Some(fitted) = explanation.corrected.candidate.entry(row, entry) else { continue };
        // The values beside it are rounded, too, and the fit makes up for them.
        let within = criterion.digits.coarsest_half_place(entry);
        let distance = |value: &f64| (value.abs() - fitted.abs()).abs();
        let near = known_values(models, entry).into_iter().filter(|value| distance(value) <= within);
        let Some(known) = near.min_by(|one, other| distance(one).total_cmp(&distance(other))) else {
            continue;
        };
        let mut corrected = preferred.corrected.clone();
        corrected.candidate.set_entry(row, entry, known.abs().copysign(fitted));
        if corrected.is_accepted(criterion) {
            preferred.corrected = corrected;
        }
    }
    preferred
}

/// The values of the table and the URDF that a wrong entry may be meant to have: lengths for a length, angles for an
/// angle, zeros left out.
fn known_values(models: &ModelPair, entry: DhEntry) -> Vec<f64> {
    let of_row = |link: &RowConstants| match *link {
        RowConstants::Dh { a_m, alpha_rad, d_m, theta_rad, .. } => {
            if entry.is_angle() {
                [alpha_rad, theta_rad]
            } else {
                [a_m, d_m]
            }
        }
        RowConstants::Screw { .. } => [0.0; 2],
    };
    let rows = models.candidate.rows.iter().flat_map(|row| of_row(&row.link));
    let origins = models.reference.joints.iter().filter(|_| !entry.is_angle());
    let origins =
        origins.flat_map(|joint| joint.parent_from_joint.translation.iter().copied().collect::<Vec<_>>());
    rows.chain(origins).filter(|&value| value != 0.0).collect()
}
