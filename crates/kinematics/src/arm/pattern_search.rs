//! Local search for the largest value of a function over an arm's ranges.

use congruent_description::ArmQ;

use super::model::ArmJoint;

/// First step of each joint as a share of its range.
const FIRST_SHARE: f64 = 0.1;
/// Last step as a share of the range: a value that is smooth in the joints is off by its square.
const LAST_SHARE: f64 = 1e-7;
/// Steps in all, so that the search ends on any function.
const MOST_SWEEPS: usize = 400;

/// Raises `value` by moving one joint at a time, with halved steps if none helps; `q` is then the best
/// configuration, and the result its value.
///
/// Source: Hooke & Jeeves, *Direct Search* (1961), without the pattern moves.
pub(crate) fn maximize(joints: &[ArmJoint], q: &mut ArmQ, mut value: impl FnMut(&ArmQ) -> f64) -> f64 {
    let mut best = value(q);
    let mut share = FIRST_SHARE;
    for _ in 0..MOST_SWEEPS {
        let mut rose = false;
        for (at, joint) in joints.iter().enumerate() {
            let (lower, upper) = joint.sampled_range();
            let here = q[at];
            for step in [share, -share] {
                q[at] = (here + step * (upper - lower)).clamp(lower, upper);
                let found = value(q);
                if found > best {
                    (best, rose) = (found, true);
                    break;
                }
                q[at] = here;
            }
        }
        if !rose {
            share /= 2.0;
            if share < LAST_SHARE {
                break;
            }
        }
    }
    best
}
