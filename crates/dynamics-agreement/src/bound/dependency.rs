//! Which joints a torque difference depends on: those between the root and bodies that differ.

use super::{coupling::Coupling, function::trigonometric::Variable};
use crate::model::Frames;

/// The joints and the bodies that differ, for questions about which joint carries which difference.
pub(super) struct JointDependency<'a> {
    pub(super) frames: &'a Frames,
    pub(super) coupling: Coupling,
    /// Whether the body of each moving joint differs.
    pub(super) differs: Vec<bool>,
}

impl<'a> JointDependency<'a> {
    pub(super) fn new(frames: &'a Frames, differs: Vec<bool>) -> Self {
        Self { frames, coupling: Coupling::new(frames), differs }
    }

    /// Whether a body that differs moves with a driven joint.
    pub(super) fn has_difference(&self, joint: usize) -> bool {
        let mut bodies = (0..self.frames.dof()).filter(|&body| self.differs[body]);
        bodies.any(|body| self.coupling.group(joint).iter().any(|(of, _)| self.carries(*of, body)))
    }

    /// The joints between one and the bodies that differ, towards the tip.
    pub(super) fn below(&self, joint: usize) -> Vec<usize> {
        let mut below: Vec<usize> = (0..self.frames.dof())
            .filter(|&body| self.differs[body] && self.carries(joint, body))
            .flat_map(|body| self.frames.ancestors(body).take_while(|&up| up != joint).collect::<Vec<_>>())
            .collect();
        below.sort_unstable();
        below.dedup();
        below
    }

    /// All joints from the root to the bodies that differ, through a driven joint or its followers.
    pub(super) fn through(&self, joint: usize) -> Vec<usize> {
        let mut all = Vec::new();
        for (of, _) in self.coupling.group(joint) {
            all.extend(self.below(*of));
            all.extend(self.frames.ancestors(*of));
        }
        // Master and followers share the joints above them; without this a variable would count twice.
        if self.coupling.is_coupled(joint) {
            all.sort_unstable();
            all.dedup();
        }
        all
    }

    pub(super) fn carries(&self, joint: usize, body: usize) -> bool {
        self.frames.ancestors(body).any(|up| up == joint)
    }

    /// The joints as variables, with their ranges.
    pub(super) fn variables(&self, joints: &[usize]) -> Vec<Variable> {
        let variable = |&joint: &usize| {
            let place = &self.frames.joints[joint];
            let new = if place.is_angular { Variable::turning } else { Variable::sliding };
            new(joint, place.range.0, place.range.1)
        };
        joints.iter().map(variable).collect()
    }
}
