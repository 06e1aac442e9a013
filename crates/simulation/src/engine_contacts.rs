//! Contact of links with obstacles in the step that was made.

use rapier3d_f64::prelude::{ColliderHandle, ContactPair};

use crate::{contact::shapes, engine::Engine, settings::PairForce};

impl Engine {
    /// Whether a link and an obstacle push each other: contacts act before the shapes touch, if they would in the step.
    pub(crate) fn contact_acts(&self) -> bool {
        self.sets.narrow_phase.contact_pairs().any(|pair| pair.total_impulse_magnitude() > 0.0)
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
