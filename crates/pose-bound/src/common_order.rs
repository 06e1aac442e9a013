//! Two chains brought to one order of joints. If a chain lacks a joint, or has it in another place, it gets a
//! joint there that does not move.

use congruent_kinematics::{ScrewChain, Twist};
use nalgebra::Vector3;

/// A chain with the positions that drive it.
#[derive(Debug, Clone)]
pub struct DrivenScrews {
    /// The chain.
    pub chain: ScrewChain,
    /// For each joint the index of the position that moves it; of a mimic joint that of the joint that it mimics.
    pub drivers: Vec<usize>,
}

/// Two chains with the same joints in the same order.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct AlignedChains {
    pub(super) chains: [ScrewChain; 2],
    /// For each joint the index of the position that drives it.
    pub(super) drivers: Vec<usize>,
}

/// A joint of the common order, and which of the two chains have it.
#[derive(Debug, Clone, Copy)]
struct CommonJoint {
    driver: usize,
    is_in: [bool; 2],
}

impl AlignedChains {
    pub(super) fn new(a: &DrivenScrews, b: &DrivenScrews) -> Self {
        let places = common_order(&a.drivers, &b.drivers);
        let still = Twist { angular: Vector3::zeros(), linear: Vector3::zeros() };
        let spread = |which: usize, chain: &ScrewChain| {
            let mut twists = chain.twists_in_base.iter();
            let twist = |place: &CommonJoint| {
                if place.is_in[which] {
                    *twists.next().expect("each joint of the chain has a place in the common order")
                } else {
                    still
                }
            };
            ScrewChain { twists_in_base: places.iter().map(twist).collect(), ..chain.clone() }
        };
        Self {
            chains: [spread(0, &a.chain), spread(1, &b.chain)],
            drivers: places.iter().map(|place| place.driver).collect(),
        }
    }
}

/// The joints of both chains, base to tip: those of the second, and between them those of the first that
/// the second lacks or has in another place.
fn common_order(first: &[usize], second: &[usize]) -> Vec<CommonJoint> {
    let mut places: Vec<CommonJoint> =
        second.iter().map(|&driver| CommonJoint { driver, is_in: [false, true] }).collect();
    let mut next = 0;
    for &driver in first {
        // Only places behind the last match count, so that the first chain keeps its own order as well.
        match places[next..].iter().position(|place| place.driver == driver) {
            // The places that are skipped belong to the second chain alone.
            Some(ahead) => next += ahead,
            // The second chain has this joint further towards its base, or not at all. In the first case one position
            // drives two places, in each of which one chain does not move.
            None => places.insert(next, CommonJoint { driver, is_in: [false, false] }),
        }
        places[next].is_in[0] = true;
        next += 1;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn assert_order(first: &[usize], second: &[usize], expected: &[usize]) {
        let places = common_order(first, second);
        let of = |has: fn(&&CommonJoint) -> bool| -> Vec<usize> {
            places.iter().filter(has).map(|place| place.driver).collect()
        };
        assert_eq!(of(|_| true), expected);
        assert_eq!(of(|place| place.is_in[0]), first);
        assert_eq!(of(|place| place.is_in[1]), second);
    }

    #[test]
    fn both_keep_their_order() {
        assert_order(&[0, 1, 2], &[0, 1, 2], &[0, 1, 2]);
        assert_order(&[0, 2], &[0, 1, 2], &[0, 1, 2]);
        assert_order(&[0, 1, 2], &[0, 2], &[0, 1, 2]);
        assert_order(&[0, 2, 1], &[0, 1, 2], &[0, 1, 2, 1]);
        assert_order(&[3, 0], &[0], &[3, 0]);
        assert_order(&[0, 1, 0], &[0, 1, 0], &[0, 1, 0]);
    }
}
