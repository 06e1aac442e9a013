//! The physics as a source of joint states: world, controller, and the setpoints that the motions give.

use congruent_description::{Diagnostic, Use};
use congruent_simulation::{Controller, Setpoint, Touches, World, WorldSettings, controller};
use nalgebra::Isometry3;

use super::{
    carried::CarriedPayloads,
    joint_states::{JointSample, JointStateSource, JointStateView, SetpointView, SourceError},
    sensors::JointSensors,
};
use crate::{
    bodies::MovingBodies,
    motion::{ReferenceGenerator, ServoResult},
    setup::RunSetup,
};

/// A robot in a simulated world, driven by its controller along the motions of a scenario.
pub struct SimulationSource<'a> {
    world: World,
    controller: Box<dyn Controller>,
    reference: ReferenceGenerator<'a>,
    sensors: JointSensors,
    payloads: CarriedPayloads<'a>,
    bodies: MovingBodies<'a>,
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
            moving_obstacles: setup.bodies.iter().map(|body| body.obstacle).collect(),
            contacts: true,
        };
        let mut world = World::new(robot, &settings).map_err(SourceError::new)?;
        world.set_state(&setup.start, &vec![0.0; robot.dof()]).map_err(SourceError::new)?;
        let kind = &setup.scenario.controller.kind;
        let mut sensors = JointSensors::new(robot.dof());
        sensors.read(world.q(), world.qd());
        let mut payloads = CarriedPayloads::new(&setup.payloads);
        payloads.update(0.0, &mut world);
        Ok(Self {
            bodies: MovingBodies::new(&setup.bodies, &setup.obstacles),
            sensors,
            payloads,
            world,
            controller: controller(kind, setup.gains()).map_err(SourceError::new)?,
            reference: ReferenceGenerator::new(&setup.trajectory, description).map_err(SourceError::new)?,
        })
    }
}

impl SimulationSource<'_> {
    /// Moves obstacles to where they are at the end of the step. What a link carries touches nothing; it is left where the
    /// link is at the beginning of the step.
    fn move_bodies(&mut self, time_s: f64) {
        let world = &mut self.world;
        self.bodies.advance(time_s, |link| world.root_from_link(link));
        for (obstacle, pose, is_carried) in self.bodies.poses() {
            let touches = if is_carried { Touches::Nothing } else { Touches::Links };
            world.move_obstacle(obstacle, pose, touches);
        }
    }
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
        self.move_bodies(time_s);
        let measured = self.sensors.measured();
        self.reference.advance(time_s, measured.q).map_err(SourceError::new)?;
        let (q, qd, qdd) = (self.reference.q(), self.reference.qd(), self.reference.qdd());
        let setpoint = Setpoint { q, qd, qdd };
        // A payload that comes at the start of the step acts in the whole of it.
        self.payloads.update(self.world.time_s(), &mut self.world);
        let stepped = self.world.step_measured(&mut *self.controller, &setpoint, &measured);
        self.sensors.read(self.world.q(), self.world.qd());
        stepped.map_err(SourceError::new)
    }

    fn finish(&mut self) -> Result<Vec<ServoResult>, SourceError> {
        self.reference.finish(self.sensors.measured().q).map_err(SourceError::new)
    }
}
