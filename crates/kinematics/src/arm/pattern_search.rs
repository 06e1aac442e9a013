//! Local search for the largest value of a function over an arm's ranges.

use congruent_description::ArmQ;

use super::model::ArmJoint;

/// First step of each joint as a share of its range.
const FIRST_SHARE: f64 = 0.1;
/// Last step as a share of the range: near a maximum a smooth value is off by the square of the step.
const LAST_SHARE: f64 = 1e-7;
/// Most sweeps over the joints, so that the search ends for any function.
const MOST_SWEEPS: usize = 400;

/// Raises `value` by moving one joint at a time, with halved steps if none helps; `q` is then the best
/// configuration, and the result its value.
///
/// Source: Hooke & Jeeves, *Direct Search* (1961), without the pattern moves.
pub fn maximize(joints: &[ArmJoint], q: &mut ArmQ, mut value: impl FnMut(&ArmQ) -> f64) -> f64 {
    let mut best = value(q);
    let mut share = FIRST_SHARE;
    for _ in 0..MOST_SWEEPS {
        // Coordinate by coordinate, without derivatives: the functions (distances, coordinates of the tool) have kinks at limits
        // and singular configurations, where gradients mislead.
        let mut rose = false;
        for (at, joint) in joints.iter().enumerate() {
            let (lower, upper) = joint.sampled_range();
            let here = q[at];
            for step in [share, -share] {
                // From `here`, not from the failed try of the other direction.
                q[at] = (here + step * (upper - lower)).clamp(lower, upper);
                let found = value(q);
                if found > best {
                    // The opposite direction cannot help as well, unless the function has a minimum here.
                    (best, rose) = (found, true);
                    break;
                }
                q[at] = here;
            }
        }
        // Only after a sweep without gain: a step that still helps one joint is worth keeping for all.
        if !rose {
            share /= 2.0;
            if share < LAST_SHARE {
                break;
            }
        }
    }
    best
}
