//! The physics as a source of joint states: world, controller, and the setpoints that the motions give.

use congruent_description::Diagnostic;
use congruent_dynamics::JointResistance;
use congruent_simulation::{Setpoint, SimulationError, Touches, World, WorldSettings, WorldSnapshot};
use nalgebra::Isometry3;

use super::{
    actuators::{ActuatorCounts, ActuatorUse},
    braking::{Braking, stop_accelerations},
    carried::CarriedPayloads,
    joint_states::{JointSample, JointStateSource, JointStateView, SetpointView, SourceError, StepForces},
    sensors::JointSensors,
};
use crate::{
    bodies::MovingBodies,
    control::JointController,
    fault::InjectedFaults,
    motion::{ReferenceGenerator, ServoResult, SlowedMotion},
    setup::RunSetup,
};

/// A robot in a simulated world, driven by its controller along the motions of a scenario.
pub struct SimulationSource<'a> {
    world: World,
    controller: JointController<'a>,
    reference: ReferenceGenerator<'a>,
    faults: InjectedFaults<'a>,
    /// Whether the controller places the robot at its setpoints.
    is_placed: bool,
    sensors: JointSensors,
    payloads: CarriedPayloads<'a>,
    actuators: ActuatorCounts,
    bodies: MovingBodies<'a>,
    /// Takes the place of the motions if a check stops the run.
    braking: Option<Braking>,
    setup: &'a RunSetup,
}

/// The whole state of a [`SimulationSource`] at one moment.
pub struct SimulationSnapshot<'a> {
    world: WorldSnapshot,
    controller: JointController<'a>,
    reference: ReferenceGenerator<'a>,
    faults: InjectedFaults<'a>,
    sensors: JointSensors,
    payloads: CarriedPayloads<'a>,
    actuators: ActuatorCounts,
    bodies: MovingBodies<'a>,
    braking: Option<Braking>,
}

impl std::fmt::Debug for SimulationSnapshot<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SimulationSnapshot").finish_non_exhaustive()
    }
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
        setup.examine_for_simulation().map_err(refused)?;
        let robot = &description.robot;
        let settings = WorldSettings {
            step_s: setup.clock.step_s,
            gravity_in_world: setup.clock.gravity_in_world,
            obstacles: setup.obstacles.clone(),
            moving_obstacles: setup.bodies.iter().map(|body| body.obstacle).collect(),
            contacts: true,
            actuator_limits: setup.scenario.joints.enforce_limits,
        };
        let mut world = World::new(robot, &settings).map_err(SourceError::new)?;
        let kind = &setup.scenario.controller.kind;
        if let Some(link) = world.massless_link().filter(|_| kind != "kinematic") {
            return Err(SourceError::new(SimulationError::Massless { link: link.to_owned() }));
        }
        world.set_state(&setup.start, &vec![0.0; robot.dof()]).map_err(SourceError::new)?;
        resist(&mut world, &setup.resistances).map_err(SourceError::new)?;
        let mut faults = InjectedFaults::new(setup, &mut world).map_err(SourceError::new)?;
        let mut sensors = JointSensors::new(setup);
        measure(&mut faults, &mut sensors);
        let mut payloads = CarriedPayloads::new(&setup.payloads);
        payloads.update(0.0, &mut world);
        Ok(Self {
            bodies: MovingBodies::new(&setup.bodies, &setup.obstacles),
            sensors,
            faults,
            is_placed: kind == "kinematic",
            payloads,
            actuators: ActuatorCounts::new(robot.dof()),
            braking: None,
            setup,
            world,
            controller: JointController::new(setup),
            reference: ReferenceGenerator::new(&setup.trajectory, description).map_err(SourceError::new)?,
        })
    }

    /// The whole state: after [`SimulationSource::restore`], in this source or in another of the same setup, steps
    /// repeat bit by bit.
    pub fn snapshot(&self) -> SimulationSnapshot<'a> {
        SimulationSnapshot {
            world: self.world.snapshot(),
            controller: self.controller.clone(),
            reference: self.reference.clone(),
            faults: self.faults.clone(),
            sensors: self.sensors.clone(),
            payloads: self.payloads.clone(),
            actuators: self.actuators.clone(),
            bodies: self.bodies.clone(),
            braking: self.braking.clone(),
        }
    }

    /// Returns to a snapshot of the same setup.
    ///
    /// # Panics
    /// When the snapshot is of a robot with another number of joints.
    pub fn restore(&mut self, snapshot: &SimulationSnapshot<'a>) {
        self.world.restore(&snapshot.world);
        self.controller.clone_from(&snapshot.controller);
        self.reference.clone_from(&snapshot.reference);
        self.faults.clone_from(&snapshot.faults);
        self.sensors.clone_from(&snapshot.sensors);
        self.payloads.clone_from(&snapshot.payloads);
        self.actuators.clone_from(&snapshot.actuators);
        self.bodies.clone_from(&snapshot.bodies);
        self.braking.clone_from(&snapshot.braking);
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

/// From encoders over sensors to the controller.
fn measure(faults: &mut InjectedFaults<'_>, sensors: &mut JointSensors) {
    sensors.read(faults.encoders().q, faults.encoders().qd);
    faults.send(&sensors.measured());
}

/// What the joints are commanded to do: by the motions, or on the way to rest.
fn commanded<'s>(reference: &'s ReferenceGenerator<'_>, braking: Option<&'s Braking>) -> Setpoint<'s> {
    match braking {
        Some(braking) => Setpoint { q: braking.q(), qd: braking.qd(), qdd: braking.qdd() },
        None => Setpoint { q: reference.q(), qd: reference.qd(), qdd: reference.qdd() },
    }
}

impl JointStateSource for SimulationSource<'_> {
    fn joints(&self) -> JointSample<'_> {
        let (qd, effort) = (self.world.qd(), self.world.torque());
        let measured = self.faults.measured();
        let setpoint = commanded(&self.reference, self.braking.as_ref());
        JointSample {
            truth: JointStateView { q: self.world.q(), qd, effort },
            measured: JointStateView {
                q: measured.q,
                qd: measured.qd,
                effort: self.faults.reported_effort(),
            },
            setpoint: Some(SetpointView { q: setpoint.q, qd: setpoint.qd, qdd: setpoint.qdd }),
        }
    }

    fn step_count(&self) -> u64 {
        self.world.step_count()
    }

    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool {
        self.world.root_from_links_into(root_from_links);
        self.faults.move_tool(root_from_links);
        true
    }

    fn step_forces(&self) -> StepForces {
        if self.world.was_placed() {
            StepForces::Unknown
        } else if self.world.contact_acts() {
            StepForces::Contact
        } else if self.world.constraints_may_act() {
            StepForces::Constrained
        } else {
            StepForces::Declared
        }
    }

    fn advance(&mut self, time_s: f64) -> Result<(), SourceError> {
        self.move_bodies(time_s);
        match &mut self.braking {
            Some(braking) => braking.advance(time_s),
            None => self.reference.advance(time_s, self.faults.measured().q).map_err(SourceError::new)?,
        }
        let mut setpoint = commanded(&self.reference, self.braking.as_ref());
        if self.is_placed {
            self.faults.place(&setpoint);
            setpoint = self.faults.placed(setpoint);
        }
        // A payload that comes at the start of the step acts in the whole of it.
        self.payloads.update(self.world.time_s(), &mut self.world);
        let measured = self.faults.measured();
        let stepped = self.world.step_measured(&mut self.controller, &setpoint, &measured);
        stepped.map_err(SourceError::new)?;
        self.actuators.observe(&self.world);
        self.faults.advance(self.world.step_count(), &mut self.world).map_err(SourceError::new)?;
        measure(&mut self.faults, &mut self.sensors);
        Ok(())
    }

    fn actuators(&self) -> Vec<ActuatorUse> {
        if !self.setup.controller.has_actuators() {
            return Vec::new();
        }
        self.actuators.report(&self.setup.description.robot, &self.setup.actuator_limits())
    }

    fn slowed(&self) -> &[SlowedMotion] {
        self.reference.slowed()
    }

    fn begin_stop(&mut self) -> bool {
        let robot = &self.setup.description.robot;
        let accelerations = stop_accelerations(robot, self.setup.trajectory.declared_accelerations());
        let commanded = (self.reference.q(), self.reference.qd());
        self.braking = Some(Braking::new(commanded, self.world.time_s(), robot, &accelerations));
        true
    }

    fn stopped_at_end_of_range(&self) -> &[Option<f64>] {
        self.braking.as_ref().map_or(&[], Braking::at_end_of_range)
    }

    fn finish(&mut self) -> Result<Vec<ServoResult>, SourceError> {
        self.reference.finish(self.faults.measured().q).map_err(SourceError::new)
    }
}
