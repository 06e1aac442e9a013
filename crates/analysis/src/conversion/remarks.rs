//! Warnings about a converted model: axes that were made parallel or intersecting, and huge values.

use congruent_input::{
    Diagnostic,
    display::{angle, length, length_and_angle},
    serde_name,
};
use congruent_kinematics::Proof;

use super::report::{AxisReport, ConversionReport, RoundedReport};
use crate::codes;

/// A length of a table above this multiple of the reach gives a warning. No unit; kind: plausibility.
const FAR_REACHES: f64 = 100.0;

/// The warning that rounded axes were made parallel or intersecting, with its effect.
pub(super) fn rounded(pairs: &[RoundedReport], against_source: &Proof) -> Option<Diagnostic> {
    let sentence = |pair: &RoundedReport| {
        let [a, b] = &pair.joints;
        let off = match (pair.angle_rad > 0.0, pair.distance_m > 0.0) {
            (true, true) => length_and_angle(pair.distance_m, pair.angle_rad),
            (true, false) => angle(pair.angle_rad),
            _ => length(pair.distance_m),
        };
        format!("{a} and {b} {} (off by {off})", serde_name(&pair.relation).replace('_', "-"))
    };
    let listed: Vec<String> = pairs.iter().map(sentence).collect();
    let Proof { position_m, orientation_rad, configurations, .. } = *against_source;
    let message = format!(
        "the numbers of the source are rounded, so these axes were made exactly parallel or intersecting: {}; the table differs from the source by up \
         to {} at {configurations} configurations",
        listed.join(", "),
        length_and_angle(position_m, orientation_rad)
    );
    (!pairs.is_empty()).then(|| {
        Diagnostic::warning(codes::convert::ROUNDED_AXES, message).with_help(
            "write quarter turns with all digits (1.5707963267948966), or keep the axes with --exact",
        )
    })
}

/// The warning that rows have lengths far beyond the reach of the arm.
pub(super) fn far(report: &ConversionReport, reach_m: f64) -> Option<Diagnostic> {
    let rows = report.table.iter().flat_map(|table| &table.rows);
    let values =
        rows.flat_map(|row| [("a", row.a_m), ("d", row.d_m)].map(|(entry, value)| (row, entry, value)));
    let is_far = |value: f64| value.abs() > FAR_REACHES * reach_m;
    let far: Vec<String> = values
        .filter(|(.., value)| is_far(*value))
        .map(|(row, entry, value)| format!("{entry} of {} is {}", row.joint, length(value)))
        .collect();
    // The position of a common normal is relative to the one before: if one is far away, the next is, too.
    let is_cause = |pair: &&AxisReport| {
        is_far(pair.normal_at_m) && pair.off_parallel_rad() * pair.normal_at_m.abs() <= FAR_REACHES * reach_m
    };
    let pairs = report.axes.iter().filter(is_cause).map(|pair| {
        format!(
            "; the axes of {} and {} are {} from parallel",
            pair.joints[0],
            pair.joints[1],
            angle(pair.off_parallel_rad())
        )
    });
    let message = format!(
        "the table has lengths far beyond the reach of {}: {}{}",
        length(reach_m),
        far.join(", "),
        pairs.collect::<String>()
    );
    (!far.is_empty()).then(|| {
        Diagnostic::warning(codes::convert::FAR_NORMAL, message).with_help(
            "two nearly parallel axes have a common normal that is far away. The table is correct; a coarser --accuracy, such as 1e-9, treats such axes as parallel",
        )
    })
}
