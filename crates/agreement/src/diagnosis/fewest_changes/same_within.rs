//! When values of two tables are the same.

use congruent_kinematics::{Pose, rotation_log};

use crate::diagnosis::{candidate::DhEntry, digits::WrittenDigits, thresholds::SAME_PLACES};

/// Values that differ by less are the same: several half places, since the errors of several values add up in one.
#[derive(Debug, Clone, Copy)]
pub(in crate::diagnosis) struct SameWithin {
    pub(super) length_m: f64,
    pub(super) angle_rad: f64,
    pub(super) parallel_rad: f64,
}

impl SameWithin {
    /// For files with these digits, of an arm of this size: by the coarsest half place, since the rounding of any value may
    /// have to be made up for by any other, and by the finest, since a mistake in a fine value may be smaller than that.
    pub(in crate::diagnosis) fn by_digits(digits: &WrittenDigits, length_m: f64) -> Vec<Self> {
        let finest = WrittenDigits { values: digits.finest_of_candidate(), ..digits.clone() };
        let [coarse, fine] = [digits, &finest].map(|digits| Self::new(digits, length_m));
        let is_finer = fine.length_m < coarse.length_m || fine.angle_rad < coarse.angle_rad;
        if is_finer { vec![coarse, fine] } else { vec![coarse] }
    }

    fn new(digits: &WrittenDigits, length_m: f64) -> Self {
        /// Without digits. Unit: rad; kind: rounding of a file with six digits.
        const EXACT_RAD: f64 = 1e-6;
        /// Unit: m, rad; kind: choice, as for derived tables.
        const MEETING_M: f64 = 5e-5;
        const PARALLEL_RAD: f64 = 2e-4;
        let several = |entry| SAME_PLACES * digits.coarsest_effect(entry, length_m);
        Self {
            length_m: several(DhEntry::A).max(MEETING_M),
            angle_rad: several(DhEntry::Alpha).max(EXACT_RAD),
            parallel_rad: (SAME_PLACES * digits.coarsest_half_place(DhEntry::Alpha)).max(PARALLEL_RAD),
        }
    }

    /// Whether two values of a row are the same; angles modulo a turn.
    pub(in crate::diagnosis) fn is_same(&self, entry: DhEntry, one: f64, other: f64) -> bool {
        self.change(entry, one, other).is_none()
    }

    /// The change from one value to another, if they differ.
    pub(super) fn change(&self, entry: DhEntry, from: f64, to: f64) -> Option<f64> {
        let by = to - from;
        let by = if entry.is_angle() { libm::atan2(libm::sin(by), libm::cos(by)) } else { by };
        (by.abs() > if entry.is_angle() { self.angle_rad } else { self.length_m }).then_some(by)
    }

    /// The number of numbers in which two transforms differ.
    pub(super) fn changed_numbers(&self, from: &Pose, to: &Pose) -> usize {
        let shift = to.translation - from.translation;
        let turn = rotation_log(&(from.rotation.transpose() * to.rotation));
        shift.iter().filter(|by| by.abs() > self.length_m).count()
            + turn.iter().filter(|by| by.abs() > self.angle_rad).count()
    }
}
