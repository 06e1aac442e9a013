//! A tool at another pose on the flange.

use nalgebra::Isometry3;

use super::planned::FaultAction;

/// Moves the links of the tool, if the fault is one of the tool: `tip` and what hangs below it.
pub(super) fn shift(action: &FaultAction, root_from_links: &mut [Isometry3<f64>]) {
    let FaultAction::ShiftedTool { tip, tip_from_shifted, links } = action else { return };
    let root_from_tip = root_from_links[*tip];
    let shift_in_root = root_from_tip * tip_from_shifted * root_from_tip.inverse();
    for &link in links {
        root_from_links[link] = shift_in_root * root_from_links[link];
    }
}
