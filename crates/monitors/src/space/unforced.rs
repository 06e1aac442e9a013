//! Overlaps of a link with an obstacle for which the physics has no force: the link cannot yield in the direction of the push, it
//! is fixed, or carried, or the two overlapped before they could push each other. There "no force" is not a force of 0 N.

/// An overlap that is deeper by this needs a force, m. Kind: solver margin; the physics lets two shapes in contact overlap by up
/// to 1 mm before it pushes them apart.
const NEEDS_FORCE_M: f64 = 1e-3;

/// How far one pair overlaps without a force.
#[derive(Debug, Clone, Copy, Default)]
#[expect(clippy::struct_field_names, reason = "all are depths in m, and names end in their unit")]
pub(super) struct UnforcedOverlap {
    /// The depth at which a force last acted in this contact, m: a pair that separates after an impact overlaps by less without a force.
    borne_m: f64,
    /// An overlap without a force in the latest sample, m. The next one decides: contact acts from the step after the touch on.
    undecided_m: Option<f64>,
    /// The deepest overlap without a force in the run, m.
    deepest_m: Option<f64>,
}

/// One pair in one sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct PairOverlap {
    pub(super) depth_m: f64,
    /// Of the step to the sample.
    pub(super) force_n: f64,
    /// Whether the run ends with it.
    pub(super) is_last: bool,
}

impl UnforcedOverlap {
    /// Takes a sample; returns the depth for which there is no force.
    pub(super) fn take(&mut self, PairOverlap { depth_m, force_n, is_last }: PairOverlap) -> Option<f64> {
        if force_n > 0.0 {
            (self.borne_m, self.undecided_m) = (depth_m, None);
            return None;
        }
        if depth_m <= self.borne_m + NEEDS_FORCE_M {
            return self.decide_undecided();
        }
        let before_m = self.undecided_m.replace(depth_m);
        let decided_m = before_m.map(|before_m| depth_m.max(before_m)).or(is_last.then_some(depth_m))?;
        Some(self.decide(decided_m))
    }

    /// Ends the contact: an overlap of a single sample, as of what is shot through a link, had no force.
    pub(super) fn end(&mut self) -> Option<f64> {
        self.borne_m = 0.0;
        self.decide_undecided()
    }

    /// The deepest overlap without a force.
    pub(super) fn deepest_m(&self) -> Option<f64> {
        self.deepest_m
    }

    fn decide_undecided(&mut self) -> Option<f64> {
        let depth_m = self.undecided_m.take()?;
        Some(self.decide(depth_m))
    }

    fn decide(&mut self, depth_m: f64) -> f64 {
        self.deepest_m = Some(self.deepest_m.map_or(depth_m, |known_m| known_m.max(depth_m)));
        depth_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The deepest overlap without a force of a contact with these depths in millimetres and forces.
    fn deepest_mm(samples: &[(f64, f64)]) -> Option<f64> {
        let mut overlap = UnforcedOverlap::default();
        for &(depth_mm, force_n) in samples {
            overlap.take(PairOverlap { depth_m: depth_mm * 1e-3, force_n, is_last: false });
        }
        overlap.end();
        overlap.deepest_m().map(|depth_m| (depth_m * 1e3).round())
    }

    #[test]
    fn an_overlap_without_a_force_is_found() {
        assert_eq!(deepest_mm(&[(2.0, 0.0), (3.0, 0.0), (150.0, 0.0)]), Some(150.0));
        assert_eq!(deepest_mm(&[(60.0, 0.0)]), Some(60.0), "shot through");
        assert_eq!(
            deepest_mm(&[(0.0, 20.0), (0.5, 20.0), (4.0, 0.0), (9.0, 0.0)]),
            Some(9.0),
            "pushed first"
        );
    }

    #[test]
    fn what_the_physics_pushes_apart_has_a_force() {
        assert_eq!(deepest_mm(&[(0.0, 0.0), (0.9, 0.0), (0.4, 0.0)]), None, "the margin of the solver");
        assert_eq!(deepest_mm(&[(5.0, 0.0), (5.1, 300.0), (3.0, 0.0), (1.0, 0.0)]), None, "an impact");
        assert_eq!(deepest_mm(&[(4.0, 0.0), (2.0, 50.0), (2.5, 0.0), (2.9, 0.0)]), None, "a rebound");
    }
}
