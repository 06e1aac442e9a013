//! The physics as a source of joint states: world, controller, and the setpoints that the motions give.

use congruent_description::{Diagnostic, Robot, RobotQ, Use};
use congruent_simulation::{Controller, Setpoint, World, WorldSettings, controller};
use nalgebra::Isometry3;

use super::{
    braking::{Braking, stop_accelerations},
    carried::CarriedPayloads,
    joint_states::{JointSample, JointStateSource, JointStateView, SetpointView, SourceError, StepForces},
    sensors::JointSensors,
};
use crate::{
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
    robot: &'a Robot,
    /// Takes the place of the motions if a check stops the run.
    braking: Option<Braking>,
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
        };
        let mut world = World::new(robot, &settings).map_err(SourceError::new)?;
        world.set_state(&setup.start, &vec![0.0; robot.dof()]).map_err(SourceError::new)?;
        let kind = &setup.scenario.controller.kind;
        let mut sensors = JointSensors::new(robot.dof());
        sensors.read(world.q(), world.qd());
        let mut payloads = CarriedPayloads::new(&setup.payloads);
        payloads.update(0.0, &mut world);
        Ok(Self {
            sensors,
            payloads,
            robot,
            braking: None,
            world,
            controller: controller(kind, setup.gains()).map_err(SourceError::new)?,
            reference: ReferenceGenerator::new(&setup.trajectory, description).map_err(SourceError::new)?,
        })
    }
}

impl SimulationSource<'_> {
    /// The commanded positions and velocities.
    fn commanded(&self) -> (&RobotQ, &[f64]) {
        match &self.braking {
            Some(braking) => (braking.q(), braking.qd()),
            None => (self.reference.q(), self.reference.qd()),
        }
    }
}

impl JointStateSource for SimulationSource<'_> {
    fn joints(&self) -> JointSample<'_> {
        let (qd, effort) = (self.world.qd(), self.world.torque());
        let measured = self.sensors.measured();
        let (commanded_q, commanded_qd) = self.commanded();
        JointSample {
            truth: JointStateView { q: self.world.q(), qd, effort },
            measured: JointStateView { q: measured.q, qd: measured.qd, effort },
            setpoint: Some(SetpointView { q: commanded_q, qd: commanded_qd }),
        }
    }

    fn step_count(&self) -> u64 {
        self.world.step_count()
    }

    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool {
        self.world.root_from_links_into(root_from_links);
        true
    }

    fn step_forces(&self) -> StepForces {
        if self.world.was_placed() {
            StepForces::Unknown
        } else if self.world.constraint_forces_act() {
            StepForces::Constrained
        } else {
            StepForces::Declared
        }
    }

    fn advance(&mut self, time_s: f64) -> Result<(), SourceError> {
        let measured = self.sensors.measured();
        match &mut self.braking {
            Some(braking) => braking.advance(time_s),
            None => self.reference.advance(time_s, measured.q).map_err(SourceError::new)?,
        }
        let (commanded_q, commanded_qd) = match &self.braking {
            Some(braking) => (braking.q(), braking.qd()),
            None => (self.reference.q(), self.reference.qd()),
        };
        let setpoint = Setpoint { q: commanded_q, qd: commanded_qd };
        // A payload that comes at the start of the step acts in the whole of it.
        self.payloads.update(self.world.time_s(), &mut self.world);
        let stepped = self.world.step_measured(&mut *self.controller, &setpoint, &measured);
        self.sensors.read(self.world.q(), self.world.qd());
        stepped.map_err(SourceError::new)
    }

    fn begin_stop(&mut self) -> bool {
        let accelerations = stop_accelerations(self.robot);
        let commanded = (self.reference.q(), self.reference.qd());
        self.braking = Some(Braking::new(commanded, self.world.time_s(), self.robot, &accelerations));
        true
    }

    fn finish(&mut self) -> Result<Vec<ServoResult>, SourceError> {
        self.reference.finish(self.sensors.measured().q).map_err(SourceError::new)
    }
}
