//! Contact of links with obstacles in the step that was made.

use rapier3d_f64::prelude::{ActiveHooks, ColliderHandle, ContactPair, RigidBody};

use crate::{contact::shapes, engine::Engine, settings::PairForce};

/// Largest change of a joint's speed in a step in which contact acts, rad/s or m/s. An obstacle on a path has no mass and no
/// largest force: where no joint lets a link yield, rapier finds tiny levers over which a joint would have to turn at an
/// immense speed, and computes with it. Kind: choice; the speed over a lever of 20 mm at 1 m/s.
const LARGEST_KICK: f64 = 50.0;
/// Largest impulse of a contact in a step, as the speed that it would give all of the robot's mass, m/s. Contacts at both ends
/// of a face push against each other without an end where the link cannot yield. Kind: choice; 200 kN in 1 ms for 20 kg.
const LARGEST_IMPULSE_M_S: f64 = 10.0;

impl Engine {
    /// Whether a link and an obstacle push each other: contacts act before the shapes touch, if they would in the step.
    pub(crate) fn contact_acts(&self) -> bool {
        self.sets.narrow_phase.contact_pairs().any(|pair| pair.total_impulse_magnitude() > 0.0)
    }

    /// Leaves a contact out of a step that began at `q`, `qd`, and returns to its start, if the link cannot yield to the
    /// obstacle; returns whether it did. The step after asks anew: a link that cannot yield in one place can in another.
    pub(crate) fn leave_out_contact(&mut self, q: &[f64], qd: &[f64]) -> bool {
        let pairs = self.sets.narrow_phase.contact_pairs();
        let impulses = pairs.map(|pair| (pair.total_impulse_magnitude(), [pair.collider1, pair.collider2]));
        // Not a number is the largest of all.
        let acting = impulses.filter(|(impulse, _)| impulse.is_nan() || *impulse > 0.0);
        let Some((impulse, strongest)) = acting.max_by(|a, b| a.0.total_cmp(&b.0)) else { return false };
        if self.is_bounded(q, qd) && impulse <= LARGEST_IMPULSE_M_S * self.mass_kg() {
            return false;
        }
        self.left_out.pairs.push(strongest);
        for (_, collider) in self.sets.colliders.iter_mut() {
            if shapes::is_obstacle(collider) {
                collider.set_active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS);
            }
        }
        // rapier begins with the impulses of the step before, of all contacts: a step without any contact forgets them.
        self.return_to(q, qd);
        self.left_out.are_all = true;
        self.step_drives();
        self.left_out.are_all = false;
        self.return_to(q, qd);
        true
    }

    /// Whether no joint was thrown in a step that began at `q`, `qd`. Positions count, too: rapier moves bodies apart without
    /// giving them that speed.
    fn is_bounded(&self, q: &[f64], qd: &[f64]) -> bool {
        let Some(multibody) = self.multibody() else { return true };
        let speeds = multibody.generalized_velocity();
        let joints = multibody.links().skip(1).zip(&self.slots).enumerate();
        let mut moved = joints.map(|(row, (link, slot))| {
            let displacement = link.joint().coords()[slot.axis as usize] - q[row];
            [speeds[row] - qd[row], displacement / self.step_s() - qd[row]]
        });
        moved.all(|kicks| kicks.into_iter().all(|kick| kick.abs() <= LARGEST_KICK))
    }

    /// The mass of all bodies that move.
    fn mass_kg(&self) -> f64 {
        self.handles.iter().filter_map(|&handle| self.sets.bodies.get(handle)).map(RigidBody::mass).sum()
    }

    /// Lets all contacts act again.
    pub(crate) fn let_contacts_act(&mut self) {
        if self.left_out.pairs.is_empty() {
            return;
        }
        self.left_out.pairs.clear();
        for (_, collider) in self.sets.colliders.iter_mut() {
            collider.set_active_hooks(ActiveHooks::empty());
        }
    }

    /// The links and obstacles that push each other.
    pub(crate) fn contact_forces(&self) -> impl Iterator<Item = PairForce> + '_ {
        let number = |handle: ColliderHandle| {
            let data = self.sets.colliders.get(handle).expect("the collider exists").user_data;
            usize::try_from(data).expect("the number of a link or an obstacle")
        };
        let is_obstacle = |handle: ColliderHandle| {
            let collider = self.sets.colliders.get(handle).expect("the collider exists");
            shapes::is_obstacle(collider)
        };
        self.sets.narrow_phase.contact_pairs().filter_map(move |pair| {
            let force_n = pair.total_impulse_magnitude() / self.parameters.dt;
            let (link, obstacle) = if is_obstacle(pair.collider1) {
                (pair.collider2, pair.collider1)
            } else {
                (pair.collider1, pair.collider2)
            };
            let pushes = force_n > 0.0;
            pushes.then(|| PairForce { link: number(link), obstacle: number(obstacle), force_n })
        })
    }

    /// Whether contact or the stop of a joint may have acted in the last step.
    pub(crate) fn constraints_may_act(&self) -> bool {
        let mut pairs = self.sets.narrow_phase.contact_pairs();
        self.is_beyond_limits || pairs.any(ContactPair::has_any_active_contact)
    }
}
