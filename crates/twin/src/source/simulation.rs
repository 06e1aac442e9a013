//! The physics as a source of joint states: world, controller, and the setpoints that the motions give.

use congruent_description::{Diagnostic, Use};
use congruent_dynamics::JointResistance;
use congruent_simulation::{Setpoint, SimulationError, World, WorldSettings};
use nalgebra::Isometry3;

use super::{
    actuators::{ActuatorCounts, ActuatorUse},
    carried::CarriedPayloads,
    joint_states::{JointSample, JointStateSource, JointStateView, SetpointView, SourceError},
    sensors::JointSensors,
};
use crate::{
    control::JointController,
    motion::{ReferenceGenerator, ServoResult},
    setup::RunSetup,
};

/// A robot in a simulated world, driven by its controller along the motions of a scenario.
pub struct SimulationSource<'a> {
    world: World,
    controller: JointController<'a>,
    reference: ReferenceGenerator<'a>,
    sensors: JointSensors,
    payloads: CarriedPayloads<'a>,
    actuators: ActuatorCounts,
    setup: &'a RunSetup,
}

impl std::fmt::Debug for SimulationSource<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SimulationSource").field("steps", &self.world.step_count()).finish_non_exhaustive()
    }
}

impl<'a> SimulationSource<'a> {
    /// Builds the world and places the robot at the start.
    ///
    /// # Errors
    /// [`SourceError`] if the robot cannot be simulated as the scenario asks.
    pub fn new(setup: &'a RunSetup) -> Result<Self, SourceError> {
        let description = &setup.description;
        let refused = |mut found: Vec<Diagnostic>| SourceError::new(found.swap_remove(0));
        description.for_use(Use::Physics).map_err(refused)?;
        let robot = &description.robot;
        let settings = WorldSettings {
            step_s: setup.clock.step_s,
            gravity_in_world: setup.clock.gravity_in_world,
            obstacles: setup.obstacles.clone(),
            contacts: true,
            actuator_limits: setup.scenario.joints.enforce_limits,
        };
        let mut world = World::new(robot, &settings).map_err(SourceError::new)?;
        world.set_state(&setup.start, &vec![0.0; robot.dof()]).map_err(SourceError::new)?;
        let mut sensors = JointSensors::new(setup);
        sensors.read(world.q(), world.qd());
        resist(&mut world, &setup.resistances).map_err(SourceError::new)?;
        let mut payloads = CarriedPayloads::new(&setup.payloads);
        payloads.update(0.0, &mut world);
        Ok(Self {
            sensors,
            payloads,
            actuators: ActuatorCounts::new(robot.dof()),
            setup,
            world,
            controller: JointController::new(setup),
            reference: ReferenceGenerator::new(&setup.trajectory, description).map_err(SourceError::new)?,
        })
    }
}

/// Puts what resists the joints into the physics.
fn resist(world: &mut World, resistances: &[JointResistance]) -> Result<(), SimulationError> {
    for (coordinate, resistance) in resistances.iter().enumerate() {
        world.set_damping(coordinate, resistance.damping)?;
        world.set_dry_friction(coordinate, resistance.friction)?;
        world.set_armature(coordinate, resistance.armature)?;
    }
    Ok(())
}

impl JointStateSource for SimulationSource<'_> {
    fn joints(&self) -> JointSample<'_> {
        let (qd, effort) = (self.world.qd(), self.world.torque());
        let measured = self.sensors.measured();
        JointSample {
            truth: JointStateView { q: self.world.q(), qd, effort },
            measured: JointStateView { q: measured.q, qd: measured.qd, effort },
            setpoint: Some(SetpointView {
                q: self.reference.q(),
                qd: self.reference.qd(),
                qdd: self.reference.qdd(),
            }),
        }
    }

    fn step_count(&self) -> u64 {
        self.world.step_count()
    }

    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool {
        self.world.root_from_links_into(root_from_links);
        true
    }

    fn advance(&mut self, time_s: f64) -> Result<(), SourceError> {
        let measured = self.sensors.measured();
        self.reference.advance(time_s, measured.q).map_err(SourceError::new)?;
        let setpoint = Setpoint { q: self.reference.q(), qd: self.reference.qd(), qdd: self.reference.qdd() };
        // A payload that comes at the start of the step acts in the whole of it.
        self.payloads.update(self.world.time_s(), &mut self.world);
        let stepped = self.world.step_measured(&mut self.controller, &setpoint, &measured);
        self.sensors.read(self.world.q(), self.world.qd());
        self.actuators.observe(&self.world);
        stepped.map_err(SourceError::new)
    }

    fn actuators(&self) -> Vec<ActuatorUse> {
        if !self.setup.controller.has_actuators() {
            return Vec::new();
        }
        self.actuators.report(&self.setup.description.robot, &self.setup.largest_efforts())
    }

    fn finish(&mut self) -> Result<Vec<ServoResult>, SourceError> {
        self.reference.finish(self.sensors.measured().q).map_err(SourceError::new)
    }
}
