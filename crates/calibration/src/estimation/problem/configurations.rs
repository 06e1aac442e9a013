//! Rows that were measured at one configuration: repetitions, which show the noise of the measurement but
//! not whether the corrections hold at other configurations.

use super::measurement::Measurement;

/// Configurations that differ by no more in any joint, in rad or m, are one. Kind: judgement; ten
/// times the repeatability of arms, and a tenth of the spread that would distinguish corrections.
const ALIKE: f64 = 1e-3;

/// For each row the number of its configuration, from 0 in the order in which they first appear.
///
/// # Examples
/// ```
/// use congruent_calibration::estimation::{Measurement, configurations};
/// let at = |q: f64| Measurement {
///     q: [q].into(),
///     tip_in_base_m: [Some(0.0); 3],
///     base_from_tip: None,
///     camera_from_target: None,
/// };
/// assert_eq!(configurations(&[at(0.5), at(0.1), at(0.5001), at(0.1)]), [0, 1, 0, 1]);
/// ```
pub fn configurations(measurements: &[Measurement]) -> Vec<usize> {
    // Rows that are alike have nearly equal sums, so only neighbours in that order are compared.
    let sum = |row: usize| measurements[row].q.iter().sum::<f64>();
    let mut order: Vec<usize> = (0..measurements.len()).collect();
    order.sort_by(|&a, &b| sum(a).total_cmp(&sum(b)));
    let mut leaders: Vec<usize> = Vec::new();
    let mut leader_of = vec![0; measurements.len()];
    for row in order {
        let q = &measurements[row].q;
        // If every joint differs by at most ALIKE, the sums differ by at most n times as much: rows further apart
        // need no comparison.
        let reach = ALIKE * f64::from(u32::try_from(q.len()).unwrap_or(u32::MAX));
        let near = leaders.iter().rev().take_while(|&&leader| sum(row) - sum(leader) <= reach);
        let is_alike =
            |leader: usize| q.iter().zip(&measurements[leader].q).all(|(a, b)| (a - b).abs() <= ALIKE);
        let found = near.copied().find(|&leader| is_alike(leader));
        leader_of[row] = found.unwrap_or(row);
        if found.is_none() {
            leaders.push(row);
        }
    }
    let mut number_of = vec![None; measurements.len()];
    let mut count = 0;
    // Numbers are given in the order of the file, not in that of the sums.
    let number = |leader: usize| {
        *number_of[leader].get_or_insert_with(|| {
            count += 1;
            count - 1
        })
    };
    leader_of.into_iter().map(number).collect()
}
