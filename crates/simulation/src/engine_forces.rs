//! Torques of the joints as forces on bodies, and the weight of the bodies as torques of the joints.

use rapier3d_f64::prelude::{JointAxis, Multibody, MultibodyLink, Vector};

use crate::engine::Engine;

impl Engine {
    pub(crate) fn clear_forces(&mut self) {
        if !std::mem::take(&mut self.is_forced) {
            return;
        }
        for &handle in &self.handles {
            let body = self.sets.bodies.get_mut(handle).expect("the body exists");
            body.reset_forces(false);
            body.reset_torques(false);
        }
    }

    /// Each torque acts on the child and, with the opposite sign, on the parent. The torque of a constrained servo is part of it.
    pub(crate) fn apply_torques(&mut self) {
        let Some(index) = self.multibody else { return };
        let multibody = self.sets.multibody_joints.get_multibody(index).expect("the multibody exists");
        for (coordinate, (slot, drive)) in self.slots.iter().zip(&self.drives).enumerate() {
            // A constrained servo has the torque in its target (`combined`), within one common limit.
            let torque = if drive.is_constrained { 0.0 } else { drive.linear().torque };
            if torque == 0.0 {
                continue;
            }
            self.is_forced = true;
            let (parent, child) = parent_and_child(multibody, coordinate);
            let force = axis_in_world(parent, child) * torque;
            let point = child.local_to_world().translation;
            for (link, force) in [(child, force), (parent, -force)] {
                let body = self.sets.bodies.get_mut(link.rigid_body_handle()).expect("the body exists");
                match slot.axis {
                    JointAxis::AngX => body.add_torque(force, false),
                    _ => body.add_force_at_point(force, point, false),
                }
            }
        }
    }

    /// Adds the torques that hold the robot: minus the sum of `J' m g` over the bodies.
    pub(crate) fn add_gravity_torque(&self, torque: &mut [f64]) {
        assert_eq!(torque.len(), self.slots.len(), "one entry for each movable joint");
        let Some(multibody) = self.multibody() else { return };
        for link in multibody.links().skip(1) {
            let body = self.sets.bodies.get(link.rigid_body_handle()).expect("the body exists");
            let weight = self.gravity * body.mass();
            let jacobian = multibody.body_jacobian(link.link_id());
            // Rows 0 to 2 are linear in rapier, opposite to this project's order.
            for (torque, column) in torque.iter_mut().zip(jacobian.column_iter()) {
                *torque -= column[0] * weight.x + column[1] * weight.y + column[2] * weight.z;
            }
        }
    }
}

fn parent_and_child(multibody: &Multibody, coordinate: usize) -> (&MultibodyLink, &MultibodyLink) {
    let child = multibody.link(coordinate + 1).expect("one link for each coordinate");
    let parent = child.parent_id().and_then(|parent| multibody.link(parent));
    (parent.expect("only the root has no parent"), child)
}

fn axis_in_world(parent: &MultibodyLink, child: &MultibodyLink) -> Vector {
    let joint_in_world = parent.local_to_world().rotation * child.joint().data.local_frame1.rotation;
    joint_in_world * Vector::X
}
