//! Which joints a difference of torque depends on: those on the way to bodies that differ.

use super::{coupling::Coupling, function::trigonometric::Variable};
use crate::side::Frames;

/// The bodies that differ.
pub(super) struct Ways<'a> {
    pub(super) frames: &'a Frames,
    pub(super) coupling: Coupling,
    /// One for each moving joint.
    pub(super) differs: Vec<bool>,
}

impl<'a> Ways<'a> {
    pub(super) fn new(frames: &'a Frames, differs: Vec<bool>) -> Self {
        Self { frames, coupling: Coupling::new(frames), differs }
    }

    /// Whether a body that differs moves with a driven joint.
    pub(super) fn has_difference(&self, joint: usize) -> bool {
        let mut bodies = (0..self.frames.dof()).filter(|&body| self.differs[body]);
        bodies.any(|body| self.coupling.group(joint).iter().any(|(of, _)| self.carries(*of, body)))
    }

    /// The joints below one on the way to bodies that differ.
    pub(super) fn below(&self, joint: usize) -> Vec<usize> {
        let mut below: Vec<usize> = (0..self.frames.dof())
            .filter(|&body| self.differs[body] && self.carries(joint, body))
            .flat_map(|body| self.frames.way_up(body).take_while(|&up| up != joint).collect::<Vec<_>>())
            .collect();
        below.sort_unstable();
        below.dedup();
        below
    }

    /// Those and the joint itself with all above it, of a driven joint and its followers.
    pub(super) fn through(&self, joint: usize) -> Vec<usize> {
        let mut all = Vec::new();
        for (of, _) in self.coupling.group(joint) {
            all.extend(self.below(*of));
            all.extend(self.frames.way_up(*of));
        }
        if self.coupling.is_coupled(joint) {
            all.sort_unstable();
            all.dedup();
        }
        all
    }

    pub(super) fn carries(&self, joint: usize, body: usize) -> bool {
        self.frames.way_up(body).any(|up| up == joint)
    }

    /// The joints as variables, with their ranges.
    pub(super) fn variables(&self, joints: &[usize]) -> Vec<Variable> {
        let variable = |&joint: &usize| {
            let place = &self.frames.joints[joint];
            let new = if place.is_angular { Variable::turning } else { Variable::sliding };
            new(joint, place.range)
        };
        joints.iter().map(variable).collect()
    }
}
