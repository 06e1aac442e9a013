//! Which positions, speeds and accelerations the torque of a joint depends on. Joints with the same variables are sampled
//! together.

use std::ops::Range;

use congruent_dynamics::DynamicsError;

use super::{
    function::{
        measure::MotionCoefficients,
        speeds::{MAX_SPEEDS, entries},
    },
    gravity::GravityTorques,
    rows::{DifferenceRows, TorquePart, WantedTorques},
};
use crate::thresholds::MAX_COEFFICIENTS;

/// Joints whose torques depend on the same variables, with these variables.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct VariableGroup {
    pub(super) joints: Vec<usize>,
    /// Joints whose speeds and accelerations matter.
    pub(super) moving: Vec<usize>,
    /// Joints whose positions matter, each with the degree in its sine and cosine, or in its stroke.
    pub(super) positions: Vec<(usize, usize)>,
    /// Whether the function has few enough coefficients to be computed.
    pub(super) is_tractable: bool,
}

impl VariableGroup {
    /// The groups of all driven joints with the same variables.
    pub(super) fn all(
        rows: &DifferenceRows<'_>,
        gravity: &GravityTorques<'_>,
    ) -> Result<Vec<Self>, DynamicsError> {
        let mut all: Vec<Self> = Vec::new();
        for joint in (0..rows.covered.len()).filter(|&joint| rows.dependency.coupling.is_driven(joint)) {
            let mut one = Self::for_joint(rows, joint);
            // Gravity before the comparison with other joints: it decides which positions matter, too.
            one.with_gravity(gravity.joints(joint)?.unwrap_or_default());
            one.is_tractable = one.count(rows) <= MAX_COEFFICIENTS && one.moving.len() <= MAX_SPEEDS;
            let same =
                // Joints with the same variables share their samples: inverse dynamics gives the torques of all
                // joints at once, so the second joint costs nothing.
                all.iter_mut().find(|other| other.moving == one.moving && other.positions == one.positions);
            match same {
                Some(same) => same.joints.push(joint),
                None => all.push(one),
            }
        }
        Ok(all)
    }

    fn for_joint(rows: &DifferenceRows<'_>, joint: usize) -> Self {
        let (dependency, frames) = (&rows.dependency, rows.dependency.frames);
        let carries = dependency.has_difference(joint);
        // A joint without a body that differs can still differ by armature, damping or friction: then only its
        // own motion counts.
        let mut moved = if carries { dependency.through(joint) } else { vec![joint] };
        moved.sort_unstable();
        // Neither the mass matrix nor its derivatives depend on how the whole robot is turned.
        // Degree 2, because an entry of the mass matrix is J^T M J: a product of two Jacobians, each affine in
        // cos q and sin q.
        let inner = moved.iter().filter(|joint| carries && frames.joints[**joint].parent.is_some());
        let positions = inner.map(|joint| (*joint, 2)).collect();
        let mut moving: Vec<usize> = moved.iter().map(|&joint| dependency.coupling.driver(joint)).collect();
        moving.sort_unstable();
        moving.dedup();
        Self { joints: vec![joint], moving, positions, is_tractable: false }
    }

    fn with_gravity(&mut self, joints: Vec<usize>) {
        for joint in joints {
            if self.positions.iter().all(|(known, _)| *known != joint) {
                self.positions.push((joint, 1));
            }
        }
        self.positions.sort_unstable();
    }

    fn count(&self, rows: &DifferenceRows<'_>) -> usize {
        // Coefficients of one variable: 1 and a cosine and a sine for each degree; 1 and a power for each degree
        // if it slides.
        let size = |(joint, degree): &(usize, usize)| {
            if rows.dependency.frames.joints[*joint].is_angular { 1 + 2 * degree } else { 1 + degree }
        };
        self.positions.iter().map(size).fold(self.values(), usize::saturating_mul)
    }

    /// Number of values of one joint: gravity, one for each acceleration, one for each product of speeds.
    pub(super) fn values(&self) -> usize {
        1 + self.moving.len() + entries(self.moving.len())
    }

    /// What is computed for a part of the torques of its joints.
    pub(super) fn wanted(&self, part: TorquePart) -> WantedTorques<'_> {
        WantedTorques { joints: &self.joints, moving: &self.moving, part }
    }

    /// The range of values that a part of the torque of one joint uses.
    pub(super) fn values_of(&self, part: TorquePart, at: usize) -> Range<usize> {
        // Layout of one joint: [gravity | one value for each acceleration | products of speeds by rows].
        let (from, inner) = (at * self.values(), 1 + self.moving.len());
        match part {
            TorquePart::Inertia => from + 1..from + inner,
            TorquePart::Velocity => from + inner..from + self.values(),
            TorquePart::Together => from..from + self.values(),
        }
    }

    /// How the values of this part combine to a torque.
    pub(super) fn motion(&self, part: TorquePart, resistance: f64) -> MotionCoefficients {
        let moving = self.moving.len();
        MotionCoefficients {
            gravity: part == TorquePart::Together,
            accelerations: if part == TorquePart::Velocity { 0 } else { moving },
            speeds: if part == TorquePart::Inertia { 0 } else { moving },
            resistance: if part == TorquePart::Together { resistance } else { 0.0 },
        }
    }
}
