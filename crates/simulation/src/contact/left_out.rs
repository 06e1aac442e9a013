//! Contacts that are left out of a step.

use rapier3d_f64::prelude::{ColliderHandle, PairFilterContext, PhysicsHooks, SolverFlags};

/// Contacts that do not act.
#[derive(Debug, Default)]
pub(crate) struct LeftOut {
    pub(crate) pairs: Vec<[ColliderHandle; 2]>,
    pub(crate) are_all: bool,
}

impl PhysicsHooks for LeftOut {
    fn filter_contact_pair(&self, context: &PairFilterContext<'_>) -> Option<SolverFlags> {
        let is_left_out = self.are_all || self.pairs.contains(&[context.collider1, context.collider2]);
        (!is_left_out).then(SolverFlags::default)
    }
}
