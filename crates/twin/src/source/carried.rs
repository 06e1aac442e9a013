//! Puts the payloads of a run onto the links of the physics, and takes them off again, at their times.

use congruent_description::CarriedBody;
use congruent_monitors::RunPayload;
use congruent_simulation::World;

/// The payloads of a run, and which of them the physics has now.
#[derive(Debug, Clone)]
pub(super) struct CarriedPayloads<'a> {
    payloads: &'a [RunPayload],
    is_carried: Vec<bool>,
    carried: Vec<CarriedBody>,
}

impl<'a> CarriedPayloads<'a> {
    pub(super) fn new(payloads: &'a [RunPayload]) -> Self {
        let carried = Vec::with_capacity(payloads.len());
        Self { payloads, is_carried: vec![false; payloads.len()], carried }
    }

    /// Changes the physics if a payload comes or goes at `time_s`.
    pub(super) fn update(&mut self, time_s: f64, world: &mut World) {
        let mut has_changed = false;
        for (payload, is_carried) in self.payloads.iter().zip(&mut self.is_carried) {
            let now = payload.is_carried_at(time_s);
            has_changed |= std::mem::replace(is_carried, now) != now;
        }
        // Only at a change: the physics then lumps the inertias of all links again.
        if has_changed {
            let now = self.payloads.iter().filter(|payload| payload.is_carried_at(time_s));
            self.carried.clear();
            self.carried.extend(now.map(|payload| payload.carried));
            world.set_carried(&self.carried);
        }
    }
}
