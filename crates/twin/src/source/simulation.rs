//! The physics as a source of joint states: world, controller, and the setpoints of the motions.

use congruent_dynamics::JointResistance;
use congruent_input::Findings;
use congruent_monitors::{ContactForce, JointSample, JointStateView, SetpointView, StepForces};
use congruent_motion::{ReferenceGenerator, ServoResult, SlowedMotion};
use congruent_proximity::MovingBodies;
use congruent_scenario::ControllerKind;
use congruent_simulation::{Setpoint, SimulationError, Touches, World, WorldSettings};
use nalgebra::Isometry3;

use super::{
    actuators::{ActuatorCounts, ActuatorUse},
    braking::{Braking, stop_accelerations},
    carried::CarriedPayloads,
    joint_states::{Advance, JointStateSource, SimulatedRobot, SourceError, longer_s},
    sensors::JointSensors,
};
use crate::{control::JointController, fault::InjectedFaults, setup::RunSetup};

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
    contact_forces: Vec<ContactForce>,
    bodies: MovingBodies<'a>,
    /// Takes the place of the motions if a check stops the run.
    braking: Option<Braking>,
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
        let refused = |found: Findings| SourceError::new(found.into_first());
        setup.examine_for_simulation().map_err(refused)?;
        let robot = &description.robot;
        let settings = WorldSettings {
            step_s: setup.clock.step_s,
            gravity_in_world: setup.clock.gravity_in_world,
            obstacles: setup.obstacles.clone(),
            moving_obstacles: setup.bodies.iter().map(|body| body.obstacle).collect(),
            contacts: true,
            contact_friction: setup.scenario.simulation.contact_friction,
            contact_restitution: setup.scenario.simulation.contact_restitution,
            actuator_limits: setup.scenario.joints.enforce_limits,
        };
        let mut world = World::new(robot, &settings).map_err(SourceError::new)?;
        let is_placed = setup.scenario.controller.kind == ControllerKind::Kinematic;
        if let Some(link) = world.massless_link().filter(|_| !is_placed) {
            return Err(SourceError::new(SimulationError::Massless { link: link.to_owned() }));
        }
        world.set_state(&setup.start, &vec![0.0; robot.dof()]).map_err(SourceError::new)?;
        resist(&mut world, &setup.resistances).map_err(SourceError::new)?;
        // After state and resistances, which faults may change; before the first reading, which they falsify.
        let mut faults = InjectedFaults::new(setup, &mut world).map_err(SourceError::new)?;
        let mut sensors = JointSensors::new(setup);
        // Also at time 0, so that the first command is computed from a reading, not from zeros.
        measure(&mut faults, &mut sensors);
        let mut payloads = CarriedPayloads::new(&setup.payloads);
        payloads.update(0.0, &mut world);
        Ok(Self {
            bodies: MovingBodies::new(&setup.bodies, &setup.obstacles),
            sensors,
            faults,
            is_placed,
            payloads,
            actuators: ActuatorCounts::new(robot.dof()),
            contact_forces: Vec::new(),
            braking: None,
            setup,
            world,
            controller: JointController::new(setup),
            reference: ReferenceGenerator::new(&setup.trajectory, setup.known_description())
                .map_err(SourceError::new)?,
        })
    }

    /// The same after this number of steps: simulations repeat to the last bit.
    pub(crate) fn at_step(setup: &'a RunSetup, steps: u64) -> Result<Self, SourceError> {
        let mut source = Self::new(setup)?;
        while source.step_count() < steps {
            source.advance(source.next_s())?;
        }
        Ok(source)
    }

    /// When the next step ends. From the number of the step, not by addition: sums of steps would drift from the times of
    /// the plan.
    pub(crate) fn next_s(&self) -> f64 {
        self.setup.clock.time_s(self.step_count() + 1)
    }

    /// Number of steps so far.
    pub fn step_count(&self) -> u64 {
        self.world.step_count()
    }
}

/// Sets damping, dry friction and armature of the joints in the physics.
fn resist(world: &mut World, resistances: &[JointResistance]) -> Result<(), SimulationError> {
    for (coordinate, resistance) in resistances.iter().enumerate() {
        world.set_damping(coordinate, resistance.damping)?;
        world.set_dry_friction(coordinate, resistance.friction)?;
        world.set_armature(coordinate, resistance.armature)?;
    }
    Ok(())
}

impl SimulationSource<'_> {
    /// Moves obstacles to their poses at the end of the step. A carried body touches nothing; it is released at the pose of the
    /// link at the beginning of the step, since the link's pose at its end is not known yet.
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

/// What the joints are commanded to do: by the motions, or on the path to rest.
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
            truth: Some(JointStateView { q: self.world.q(), qd, effort }),
            measured: JointStateView {
                q: measured.q,
                qd: measured.qd,
                effort: self.faults.reported_effort(),
            },
            setpoint: Some(SetpointView {
                q: setpoint.q,
                qd: setpoint.qd,
                qdd: setpoint.qdd,
                effort: self.world.asked_torque(),
            }),
            recorded_effort: &[],
        }
    }

    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool {
        self.world.root_from_links_into(root_from_links);
        // The physics does not know of a tool at another pose: only what is seen of it is moved.
        self.faults.move_tool(root_from_links);
        true
    }

    fn advance(&mut self, time_s: f64) -> Result<Advance, SourceError> {
        // Obstacles first: the step moves them to their poses at its end.
        self.move_bodies(time_s);
        match &mut self.braking {
            Some(braking) => braking.advance(time_s),
            // With what arrived, not with the truth: a servo is controlled through the same sensors as the drives.
            None => self.reference.advance(time_s, self.faults.measured().q).map_err(SourceError::new)?,
        }
        let mut setpoint = commanded(&self.reference, self.braking.as_ref());
        if self.is_placed {
            self.faults.place(&setpoint);
            setpoint = self.faults.placed(setpoint);
        }
        // By the time at the start of the step: a payload that is taken then acts in the whole step.
        self.payloads.update(self.world.time_s(), &mut self.world);
        let measured = self.faults.measured();
        let stepped = self.world.step_measured(&mut self.controller, &setpoint, &measured);
        stepped.map_err(SourceError::new)?;
        self.actuators.observe(&self.world);
        let forces = self.world.contact_forces();
        self.contact_forces.clear();
        self.contact_forces.extend(forces.map(|force| ContactForce {
            link: force.link,
            obstacle: force.obstacle,
            force_n: force.force_n,
        }));
        // Faults by the new step, then the reading: a fault acts from the first sample at its time on.
        self.faults.advance(self.world.step_count(), &mut self.world).map_err(SourceError::new)?;
        measure(&mut self.faults, &mut self.sensors);
        Ok(Advance::At(time_s))
    }

    fn is_last(&self) -> bool {
        // A stop ends when the arm is at rest, which may be later or earlier than the motions would.
        let last = self.setup.clock.steps_with(longer_s(self.reference.slowed()));
        self.braking.is_none() && last.is_some_and(|last| self.step_count() >= last)
    }

    fn simulated(&self) -> Option<&dyn SimulatedRobot> {
        Some(self)
    }

    fn simulated_mut(&mut self) -> Option<&mut dyn SimulatedRobot> {
        Some(self)
    }
}

impl SimulatedRobot for SimulationSource<'_> {
    fn step_forces(&self) -> StepForces {
        // From the least to the most that is known of the forces.
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

    fn contact_forces(&self) -> &[ContactForce] {
        &self.contact_forces
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
        let (q, qd) = (self.reference.q(), self.reference.qd());
        self.braking = Some(Braking::new(q, qd, self.world.time_s(), robot, &accelerations));
        true
    }

    fn stopped_at_end_of_range(&self) -> &[Option<f64>] {
        self.braking.as_ref().map_or(&[], Braking::at_end_of_range)
    }

    fn finish(&mut self) -> Result<Vec<ServoResult>, SourceError> {
        self.reference.finish(self.faults.measured().q).map_err(SourceError::new)
    }
}
