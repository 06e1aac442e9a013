//! Changes of the robot in rapier while it runs.

use congruent_description::Inertia;
use nalgebra::Isometry3;

use crate::{adapter, engine::Engine, sets::ObstacleMove, settings::Touches};

impl Engine {
    pub(crate) fn set_damping(&mut self, coordinate: usize, damping: f64) {
        // Applied with the next step, together with the damping of its servo.
        self.sets.damping[coordinate] = damping;
    }

    pub(crate) fn set_dry_friction(&mut self, coordinate: usize, friction: f64) {
        if let Some(multibody) = self.multibody_mut() {
            multibody.frictions_mut()[coordinate] = friction;
        }
        // Friction that holds needs more sweeps than motion does.
        self.choose_sweeps();
    }

    pub(crate) fn damping(&self, coordinate: usize) -> f64 {
        self.sets.damping[coordinate]
    }

    pub(crate) fn dry_friction(&self, coordinate: usize) -> f64 {
        self.multibody().map_or(0.0, |multibody| multibody.frictions()[coordinate])
    }

    pub(crate) fn set_armature(&mut self, coordinate: usize, armature: f64) {
        if let Some(multibody) = self.multibody_mut() {
            multibody.armature_mut()[coordinate] = armature;
        }
    }

    pub(crate) fn set_inertia(&mut self, body: usize, inertia: &Inertia) {
        let sets = &mut self.sets;
        let body = sets.bodies.get_mut(self.handles[body]).expect("the body exists");
        body.set_additional_mass_properties(adapter::mass_properties(inertia), false);
        body.recompute_mass_properties_from_colliders(&sets.colliders);
    }

    /// Moves an obstacle to a pose at the end of the next step, or puts it there; without contacts nothing is moved.
    pub(crate) fn move_obstacle(&mut self, obstacle: usize, pose: &Isometry3<f64>, touches: Touches) {
        let Some(&handle) = self.moving.get(&obstacle) else { return };
        let sets = &mut self.sets;
        let body = sets.bodies.get_mut(handle).expect("the body exists");
        let pose = adapter::pose(pose);
        let was_enabled = body.is_enabled();
        self.moves.retain(|before| before.body != handle);
        match touches {
            Touches::Links => {
                body.set_enabled(true);
                // By its next position rapier knows a velocity, with which it pushes links; put there at once, it
                // would appear inside them.
                if was_enabled {
                    self.moves.push(ObstacleMove { body: handle, before: *body.position(), after: pose });
                    body.set_next_kinematic_position(pose);
                } else {
                    // Released: the jump from where it was carried is no motion.
                    body.set_position(pose, true);
                }
            }
            Touches::Nothing => {
                body.set_enabled(false);
                body.set_position(pose, true);
            }
        }
    }

    /// Returns to the start of a step: joints and obstacles are where they were, and the obstacles move again.
    pub(crate) fn return_to(&mut self, q: &[f64], qd: &[f64]) {
        self.place(q, qd);
        for step in &self.moves {
            let body = self.sets.bodies.get_mut(step.body).expect("the body exists");
            body.set_position(step.before, true);
            body.set_next_kinematic_position(step.after);
        }
    }

    /// To be called after a step that is not repeated.
    pub(crate) fn end_step(&mut self) {
        self.moves.clear();
        self.let_contacts_act();
    }

    /// To be called after inertias have changed: Jacobians are those of the centres of mass.
    pub(crate) fn update_jacobians(&mut self) {
        let Some(index) = self.multibody else { return };
        let sets = &mut self.sets;
        let multibody = sets.multibody_joints.get_multibody_mut(index).expect("the multibody exists");
        multibody.forward_kinematics(&sets.bodies, true);
        multibody.update_rigid_bodies(&mut sets.bodies, true);
    }
}
