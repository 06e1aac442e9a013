//! The corrected table, if its entries can express the corrections.

use congruent_description::{DhRowKind, DhTable};

use crate::estimation::{CorrectionEntry, CorrectionParameter};

/// A correction and its value, rad or m.
pub(super) type Valued<'a> = (&'a CorrectionParameter, f64);

/// The names of the corrections of the arm that no entry of a table has: a turn about y between nearly parallel axes, tilts and
/// shifts of axes. One of value 0 changes nothing.
pub(super) fn beyond_the_table(corrections: &[Valued<'_>]) -> Vec<String> {
    let is_beyond = |entry: CorrectionEntry| {
        matches!(entry, CorrectionEntry::Beta | CorrectionEntry::AxisShift | CorrectionEntry::AxisTilt)
    };
    let beyond = corrections.iter().filter(|(of, value)| is_beyond(of.entry) && *value != 0.0);
    beyond.map(|(of, _)| of.name.clone()).collect()
}

/// The table with its entries corrected; base and tool are no part of its rows.
pub(super) fn corrected(table: &DhTable, corrections: &[Valued<'_>]) -> DhTable {
    let mut corrected = table.clone();
    corrected.source = table.source.as_ref().map(|source| format!("{source}; corrected by calibration"));
    for (parameter, value) in corrections {
        let Some(row) = parameter.joint.map(|joint| &mut corrected.rows[joint]) else { continue };
        let entry = match (parameter.entry, row.kind) {
            (CorrectionEntry::Zero | CorrectionEntry::JointEntry, DhRowKind::Revolute)
            | (CorrectionEntry::ConstantEntry, DhRowKind::Prismatic) => &mut row.theta_rad,
            (CorrectionEntry::Zero | CorrectionEntry::JointEntry, DhRowKind::Prismatic)
            | (CorrectionEntry::ConstantEntry, DhRowKind::Revolute) => &mut row.d_m,
            (CorrectionEntry::A, _) => &mut row.a_m,
            (CorrectionEntry::Alpha, _) => &mut row.alpha_rad,
            _ => continue,
        };
        // A zero is in the direction of the joint, which the sign of the row may reverse; entries of the table have none.
        let sign = if parameter.entry == CorrectionEntry::Zero { row.sign } else { 1.0 };
        *entry += sign * value;
    }
    corrected
}
