//! Changes of a robot during a run: resistances of joints, exerted share of actuators, carried bodies.

use congruent_description::{CarriedBody, Inertia};
use nalgebra::Isometry3;

use crate::{
    actuation::DriveConnection,
    error::SimulationError,
    settings::{PairForce, Touches},
    world::World,
};

impl World {
    /// Whether a link and an obstacle pushed each other in the last step. Contacts act before the shapes touch if they
    /// would within the step.
    pub fn contact_acts(&self) -> bool {
        self.engine.contact_acts()
    }

    /// The links and obstacles that pushed each other in the last step; a pair of several shapes has several entries.
    pub fn contact_forces(&self) -> impl Iterator<Item = PairForce> + '_ {
        self.engine.contact_forces()
    }

    /// Whether forces may have acted in the last step that are neither efforts nor gravity nor what resists the joints: the
    /// stop of a joint, or contact with an obstacle that is near.
    pub fn constraints_may_act(&self) -> bool {
        self.engine.constraints_may_act()
    }

    /// Sets the viscous damping of a joint, N m s/rad or N s/m. It is integrated implicitly, so that any value is
    /// stable: a very large one stops the joint.
    ///
    /// # Errors
    /// [`SimulationError::Resistance`] for a value that is negative or not finite.
    ///
    /// # Panics
    /// If there is no such coordinate.
    pub fn set_damping(&mut self, coordinate: usize, damping: f64) -> Result<(), SimulationError> {
        self.check_resistance("damping", coordinate, damping)?;
        self.engine.set_damping(coordinate, damping);
        Ok(())
    }

    /// Sets the dry friction of a joint, N m or N; at rest it holds up to this value.
    ///
    /// # Errors
    /// As [`World::set_damping`].
    ///
    /// # Panics
    /// If there is no such coordinate.
    pub fn set_dry_friction(&mut self, coordinate: usize, friction: f64) -> Result<(), SimulationError> {
        self.check_resistance("dry friction", coordinate, friction)?;
        self.engine.set_dry_friction(coordinate, friction);
        Ok(())
    }

    /// Sets the inertia of motor and gear, reflected to the joint, kg m^2 or kg. A URDF has no such value: it is zero at first.
    ///
    /// # Errors
    /// As [`World::set_damping`].
    ///
    /// # Panics
    /// If there is no such coordinate.
    pub fn set_armature(&mut self, coordinate: usize, armature: f64) -> Result<(), SimulationError> {
        self.check_resistance("armature", coordinate, armature)?;
        self.engine.set_armature(coordinate, armature);
        Ok(())
    }

    /// Sets the share of the commanded effort, of torques and of servos, that the actuator of a joint delivers: 1 at
    /// first, 0 for none.
    ///
    /// # Errors
    /// As [`World::set_damping`].
    ///
    /// # Panics
    /// If there is no such coordinate.
    pub fn set_delivered_share(&mut self, coordinate: usize, share: f64) -> Result<(), SimulationError> {
        self.check_resistance("share of the effort", coordinate, share)?;
        self.state.delivered[coordinate] = share;
        Ok(())
    }

    /// The viscous damping of a joint now, N m s/rad or N s/m.
    pub fn damping(&self, coordinate: usize) -> f64 {
        self.engine.damping(coordinate)
    }

    /// The dry friction of a joint now, N m or N.
    pub fn dry_friction(&self, coordinate: usize) -> f64 {
        self.engine.dry_friction(coordinate)
    }

    /// Connects the drive of a joint to the controller by another connection. The drives of a robot without fault get the
    /// commands of their own joints.
    ///
    /// # Panics
    /// If there is no such coordinate.
    pub fn set_connection(&mut self, coordinate: usize, connection: DriveConnection) {
        self.state.connections.set(coordinate, connection);
    }

    /// Sets all bodies that links carry in addition to their own masses, in place of those carried before. The motion
    /// continues with the same velocities.
    ///
    /// # Panics
    /// If a link is not one of this robot.
    pub fn set_carried(&mut self, carried: &[CarriedBody]) {
        carried.clone_into(&mut self.state.carried[0]);
        self.load_links();
    }

    /// Sets all undeclared bodies that links carry, in addition to [`World::set_carried`].
    ///
    /// # Panics
    /// If a link is not one of this robot.
    pub fn set_carried_unknown(&mut self, carried: &[CarriedBody]) {
        carried.clone_into(&mut self.state.carried[1]);
        self.load_links();
    }

    fn load_links(&mut self) {
        let carried = self.state.carried.iter().flatten();
        // The root's body is fixed and needs no inertia.
        for (body, own) in self.own_inertias.iter().enumerate().skip(1) {
            let on_body = carried.clone().filter_map(|carried| {
                // A link on a fixed joint hands its load to the body it belongs to, at its place on that body.
                let place = self.links[carried.link.get()];
                (place.body == body).then_some((place.body_from_link, carried.inertia))
            });
            let own = std::iter::once((nalgebra::Isometry3::identity(), *own));
            let whole = Inertia::sum_of_parts(own.chain(on_body));
            self.engine.set_inertia(body, &whole);
        }
        // The centres of mass have moved; gravity torques of the next command would be those of the old ones.
        self.engine.update_jacobians();
    }

    /// Moves one of the moving obstacles of the settings: to this pose at the end of the next step if it touches links
    /// and did so before, at once otherwise.
    pub fn move_obstacle(&mut self, obstacle: usize, world_from_obstacle: &Isometry3<f64>, touches: Touches) {
        self.engine.move_obstacle(obstacle, world_from_obstacle, touches);
    }

    fn check_resistance(
        &self,
        what: &'static str,
        coordinate: usize,
        value: f64,
    ) -> Result<(), SimulationError> {
        if value.is_finite() && value >= 0.0 {
            return Ok(());
        }
        Err(SimulationError::Resistance { joint: self.joint_names[coordinate].clone(), what, value })
    }
}
