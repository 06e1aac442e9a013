//! What the torque of a joint depends on. Joints on the way to the same bodies depend on the same, and are sampled
//! together.

use std::ops::Range;

use congruent_dynamics::DynamicsError;

use super::{
    function::{
        measure::Motion,
        speeds::{MAX_SPEEDS, entries},
    },
    gravity::GravityTorques,
    rows::Rows,
};
use crate::thresholds::MAX_COEFFICIENTS;

/// A part of the torque.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Of accelerations, armature included.
    Inertia,
    /// Of products of speeds.
    Velocity,
    /// All of it, with damping and dry friction.
    Together,
}

/// Joints that depend on the same.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Dependence {
    pub(super) joints: Vec<usize>,
    /// Joints whose speeds and accelerations matter.
    pub(super) moving: Vec<usize>,
    /// Joints whose positions matter, each with the degree of its waves.
    pub(super) positions: Vec<(usize, usize)>,
    /// Whether there are few enough coefficients.
    pub(super) is_tractable: bool,
}

impl Dependence {
    /// Of all joints.
    pub(super) fn all(rows: &Rows<'_>, gravity: &GravityTorques<'_>) -> Result<Vec<Self>, DynamicsError> {
        let mut all: Vec<Self> = Vec::new();
        for joint in (0..rows.covered.len()).filter(|&joint| rows.ways.coupling.is_driven(joint)) {
            let mut one = Self::of(rows, joint);
            one.with_gravity(gravity.joints(joint)?.unwrap_or_default());
            one.is_tractable = one.count(rows) <= MAX_COEFFICIENTS && one.moving.len() <= MAX_SPEEDS;
            let same =
                all.iter_mut().find(|other| other.moving == one.moving && other.positions == one.positions);
            match same {
                Some(same) => same.joints.push(joint),
                None => all.push(one),
            }
        }
        Ok(all)
    }

    fn of(rows: &Rows<'_>, joint: usize) -> Self {
        let (ways, frames) = (&rows.ways, rows.ways.frames);
        let carries = ways.has_difference(joint);
        let mut moved = if carries { ways.through(joint) } else { vec![joint] };
        moved.sort_unstable();
        // Neither the mass matrix nor its derivatives depend on how the whole robot is turned.
        let inner = moved.iter().filter(|joint| carries && frames.joints[**joint].parent.is_some());
        let positions = inner.map(|joint| (*joint, 2)).collect();
        let mut moving: Vec<usize> = moved.iter().map(|&joint| ways.coupling.driver(joint)).collect();
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

    fn count(&self, rows: &Rows<'_>) -> usize {
        let size = |(joint, degree): &(usize, usize)| {
            if rows.ways.frames.joints[*joint].is_angular { 1 + 2 * degree } else { 1 + degree }
        };
        self.positions.iter().map(size).fold(self.values(), usize::saturating_mul)
    }

    /// Values of one joint: gravity, accelerations, products of speeds.
    pub(super) fn values(&self) -> usize {
        1 + self.moving.len() + entries(self.moving.len())
    }

    /// The values of one joint that a part is of.
    pub(super) fn values_of(&self, part: Part, at: usize) -> Range<usize> {
        let (from, inner) = (at * self.values(), 1 + self.moving.len());
        match part {
            Part::Inertia => from + 1..from + inner,
            Part::Velocity => from + inner..from + self.values(),
            Part::Together => from..from + self.values(),
        }
    }

    /// How these values make a torque.
    pub(super) fn motion(&self, part: Part, resistance: f64) -> Motion {
        let moving = self.moving.len();
        Motion {
            gravity: part == Part::Together,
            accelerations: if part == Part::Velocity { 0 } else { moving },
            speeds: if part == Part::Inertia { 0 } else { moving },
            resistance: if part == Part::Together { resistance } else { 0.0 },
        }
    }
}
