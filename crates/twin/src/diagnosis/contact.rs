//! When the robot first touches an obstacle: from then on efforts are not those of its motion alone.

use super::observed::Observed;
use crate::proximity::Clearance;

/// Nearer than this counts as touching: a link at 2 m/s goes so far in a step of 1 ms.
const TOUCHING_M: f64 = 2e-3;

/// The first kept sample in which a link touches an obstacle.
pub(super) fn first(observed: &Observed<'_>, clearance: &mut Clearance) -> Option<usize> {
    let links = observed.robot.links().len();
    let with_obstacle: Vec<usize> = clearance
        .pairs()
        .enumerate()
        .filter(|(_, pair)| pair.a.max(pair.b) >= links)
        .map(|(index, _)| index)
        .collect();
    if with_obstacle.is_empty() {
        return None;
    }
    (0..observed.samples()).find(|&sample| {
        clearance.move_links(observed.store.sample(sample).root_from_links);
        with_obstacle.iter().any(|&pair| clearance.measure_below(pair, TOUCHING_M).is_some())
    })
}
