//! The difference at many positions of one joint after the other, base to tip: the products of the motions before a
//! joint and behind it are computed once in a round, so that each position costs the joint's own motions alone.

use nalgebra::{Matrix4, Vector4};

use super::difference_norm::{DifferenceNorm, FeatureSlot};

/// The motions of a configuration that changes joint by joint.
pub(super) struct SlotSweep<'a> {
    difference: &'a DifferenceNorm,
    /// Each joint that the difference depends on, with its first and its last slot, in the order of the first ones.
    joints: Vec<(usize, [usize; 2])>,
    /// The motion of each slot at the present position of its joint, in both chains.
    motions: Vec<[Matrix4<f64>; 2]>,
    /// The tips moved by all motions from a slot on, for each slot; one entry more for the tips themselves.
    rests: Vec<[Vector4<f64>; 2]>,
}

impl<'a> SlotSweep<'a> {
    /// The motions at joint positions `at`.
    pub(super) fn new(difference: &'a DifferenceNorm, at: &[f64]) -> Self {
        let mut joints: Vec<(usize, [usize; 2])> = Vec::new();
        let mut place = vec![None; at.len()];
        for (index, slot) in difference.slots.iter().enumerate() {
            // One entry for each joint, whose slots may be apart: its last one is updated.
            let place = place[slot.joint].get_or_insert(joints.len());
            match joints.get_mut(*place) {
                Some((_, [_, last])) => *last = index,
                None => joints.push((slot.joint, [index, index])),
            }
        }
        let motions = difference.slots.iter().map(|slot| slot_motions(slot, at[slot.joint])).collect();
        // Filled at the start of each round; only the last entry, the tips themselves, never changes.
        let rests = vec![difference.tips; difference.slots.len() + 1];
        Self { difference, joints, motions, rests }
    }

    /// One round over all joints. `choose` gets a joint, its position and the difference as a function of its position,
    /// and gives the position that the joint moves to, if it moves.
    pub(super) fn round(
        &mut self,
        at: &mut [f64],
        mut choose: impl FnMut(usize, f64, &dyn Fn(f64) -> f64) -> Option<f64>,
    ) {
        let slots = &self.difference.slots;
        // From the tip to the base once a round: behind a joint nothing has moved yet when its turn comes.
        for index in (0..slots.len()).rev() {
            self.rests[index] = moved(&self.motions[index], &self.rests[index + 1]);
        }
        let mut before = [Matrix4::identity(); 2];
        let mut next = 0;
        for (joint, [first, last]) in self.joints.clone() {
            // In front of a joint everything has its new position already.
            for [of_a, of_b] in &self.motions[next..first] {
                before = [before[0] * of_a, before[1] * of_b];
            }
            // Not behind `last`: between the slots of this joint there can be slots of later joints, which may
            // still move.
            next = first;
            let difference_at = |position: f64| {
                let motions = slots[first..=last].iter().zip(&self.motions[first..=last]).rev();
                let rest = motions.fold(self.rests[last + 1], |rest, (slot, motions)| {
                    moved(&motions_at(slot, motions, joint, position), &rest)
                });
                let [a, b] = moved(&before, &rest);
                (a - b).norm()
            };
            if let Some(position) = choose(joint, at[joint], &difference_at) {
                at[joint] = position;
                // A later joint may lie between the slots of this one, and needs what is behind it as it is now.
                for index in (first..=last).rev() {
                    self.motions[index] = motions_at(&slots[index], &self.motions[index], joint, position);
                    self.rests[index] = moved(&self.motions[index], &self.rests[index + 1]);
                }
            }
        }
    }
}

/// The motions of a slot at a joint position, in both chains.
fn slot_motions(slot: &FeatureSlot, position: f64) -> [Matrix4<f64>; 2] {
    let features = slot.corner(position).features;
    slot.motions.each_ref().map(|motion| motion.at(features))
}

/// The motions of a slot if one joint is at a position.
fn motions_at(
    slot: &FeatureSlot,
    motions: &[Matrix4<f64>; 2],
    joint: usize,
    position: f64,
) -> [Matrix4<f64>; 2] {
    if slot.joint == joint { slot_motions(slot, position) } else { *motions }
}

fn moved([by_a, by_b]: &[Matrix4<f64>; 2], [a, b]: &[Vector4<f64>; 2]) -> [Vector4<f64>; 2] {
    [by_a * a, by_b * b]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::difference_norm::AffineMotion;

    /// A turn about z of the point `(1, 0, 0)` shifted along x, as a slot of a joint.
    fn slot(joint: usize, rate: f64, lengths_m: [f64; 2]) -> FeatureSlot {
        let motion = |length_m: f64| {
            let mut motion = AffineMotion { constant: Matrix4::zeros(), ..AffineMotion::none() };
            motion.constant[(2, 2)] = 1.0;
            motion.constant[(3, 3)] = 1.0;
            motion.constant[(0, 3)] = length_m;
            motion.first[(0, 0)] = 1.0;
            motion.first[(1, 1)] = 1.0;
            motion.second[(0, 1)] = -1.0;
            motion.second[(1, 0)] = 1.0;
            motion
        };
        FeatureSlot::new(joint, Some(rate), lengths_m.map(motion))
    }

    /// Kind: rounding of products of a few matrices of size 1: some dozen units in the last place, times ten.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn a_sweep_gives_the_difference_at_each_position_also_if_a_joint_has_several_slots() {
        // Joint 1 drives the second and the fourth slot, joint 3 none.
        let slots = vec![
            slot(0, 1.0, [0.3, 0.31]),
            slot(1, 1.0, [0.2, 0.2]),
            slot(2, 0.5, [0.4, 0.39]),
            slot(1, 2.0, [0.1, 0.12]),
        ];
        let tip = Vector4::new(0.2, 0.1, 0.3, 1.0);
        let difference = DifferenceNorm::new(slots, [tip, tip]);
        let mut at = vec![0.1, -0.4, 0.8, 0.5];
        let mut sweep = SlotSweep::new(&difference, &at);
        for round in 0..3 {
            let mut expected = at.clone();
            let mut visited = Vec::new();
            sweep.round(&mut at, |joint, before, difference_at| {
                assert_eq!(before.to_bits(), expected[joint].to_bits());
                let to = before + 0.3 * (f64::from(round) + 1.0);
                for position in [to, before - 0.2] {
                    let mut other = expected.clone();
                    other[joint] = position;
                    assert!((difference_at(position) - difference.at(&other)).abs() < ROUNDING);
                }
                visited.push(joint);
                (joint != 2).then(|| {
                    expected[joint] = to;
                    to
                })
            });
            assert_eq!(visited, [0, 1, 2]);
            assert_eq!(at, expected);
        }
    }
}
