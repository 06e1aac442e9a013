//! What a change does to the Denavit-Hartenberg table of a robot.

use congruent_description::{DhRow, DhTable, Robot, RobotDescription};
use congruent_input::SiUnit;
use congruent_mapping::{ChangedValue, is_same_value};

/// The values of rows that differ, as `table a`; empty if one of the two has no table, or the rows are others.
pub(super) fn changed_table(descriptions: [&RobotDescription; 2]) -> Vec<ChangedValue> {
    let [Some(table), Some(before)] = descriptions.map(|of| of.dh.as_ref()) else { return Vec::new() };
    if has_other_table(descriptions) {
        return Vec::new();
    }
    let rows = table.rows.iter().zip(&before.rows);
    let of_row = |(row, before): (&DhRow, &DhRow)| {
        let values = [
            ("table a", row.a_m, before.a_m, SiUnit::Metre),
            ("table alpha", row.alpha_rad, before.alpha_rad, SiUnit::Radian),
            ("table d", row.d_m, before.d_m, SiUnit::Metre),
            ("table theta", row.theta_rad, before.theta_rad, SiUnit::Radian),
        ];
        let joint = descriptions[0].robot.joint(row.joint).name.clone();
        let differing = values.into_iter().filter(|(_, found, before, _)| !is_same_value(*found, *before));
        let changed = differing.map(move |(parameter, found, before, unit)| ChangedValue {
            joint: joint.clone(),
            parameter,
            found: Some(found),
            before: Some(before),
            unit,
        });
        changed.collect::<Vec<_>>()
    };
    rows.flat_map(of_row).collect()
}

/// Whether only one of the two has a table, or its convention, its rows or the frames at its ends are others.
pub(super) fn has_other_table([description, before]: [&RobotDescription; 2]) -> bool {
    let (table, table_before) = match (&description.dh, &before.dh) {
        (None, None) => return false,
        (Some(table), Some(before)) => (table, before),
        _ => return true,
    };
    let rows = |table: &DhTable, robot: &Robot| -> Vec<_> {
        table
            .rows
            .iter()
            .map(|row| (robot.joint(row.joint).name.clone(), row.kind, row.sign.to_bits()))
            .collect()
    };
    table.convention != table_before.convention
        || table.base_from_dh0 != table_before.base_from_dh0
        || table.dhn_from_tip != table_before.dhn_from_tip
        || rows(table, &description.robot) != rows(table_before, &before.robot)
}
