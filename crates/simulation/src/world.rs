//! The world: one robot, fixed at its root, and its obstacles.

use congruent_description::{CarriedBody, Inertia, LinkIndex, Robot, RobotQ};
use nalgebra::{DMatrix, DVector, Isometry3};

use crate::{
    actuation::{Controller, connection},
    build,
    commands::{Commands, Motor},
    drive::Saturation,
    engine::Engine,
    error::SimulationError,
    joints_view::{JointsView, MeasuredState, Setpoint},
    lumping::{Bodies, LinkOnBody},
    sets::EngineSets,
    settings::WorldSettings,
};

/// Diagonal entries of the mass matrix below this part of the largest count as zero: rounding of
/// products and sums is about 1e-16. Dimensionless.
const NO_INERTIA_RATIO: f64 = 1e-15;

/// Numbers from here on count as infinite, whether they come in or out. Below, no product that rapier forms of them
/// overflows; above, one may, and rapier then continues with accelerations of zero without an error.
const LARGEST: f64 = 1e75;

/// A robot in physics.
///
/// The world frame is the frame of the root link, which is at rest. Vectors hold one entry for
/// each movable joint, mimic joints included, in the order of [`Robot::movable_joints`]; units are
/// rad and N m, or m and N for a prismatic joint.
///
/// # Examples
/// A bar of 1 kg on a hinge, released level, falls:
/// ```
/// use congruent_description::{Inertia, JointKind, JointParts, Link, Robot, RobotQ};
/// use congruent_simulation::{Passive, Setpoint, World, WorldSettings};
/// use nalgebra::{Isometry3, Matrix3, Vector3};
///
/// let inertia = Inertia {
///     mass_kg: 1.0,
///     link_from_inertial: Isometry3::translation(0.5, 0.0, 0.0),
///     tensor_kg_m2: Matrix3::identity() * 0.02,
/// };
/// let base = Link { name: "base".into(), ..Link::default() };
/// let bar = Link { name: "bar".into(), inertia: Some(inertia), ..Link::default() };
/// let mut hinge = JointParts::new("hinge", JointKind::Continuous, "base", "bar", Isometry3::identity());
/// hinge.joint.axis_in_joint = Vector3::y_axis();
/// let robot = Robot::new("pendulum", vec![base, bar], vec![hinge])?;
///
/// let mut world = World::new(&robot, &WorldSettings::default())?;
/// let level = RobotQ::zeros(1);
/// world.step(&mut Passive, &Setpoint { q: &level, qd: &[0.0], qdd: &[0.0] })?;
/// // Acceleration m g l / (I + m l^2) = 4.905 / 0.27 rad/s^2, for 1 ms.
/// assert!((world.qd()[0] - 4.905 / 0.27 * 1e-3).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct World {
    pub(crate) engine: Engine,
    pub(crate) joint_names: Vec<String>,
    pub(crate) links: Vec<LinkOnBody>,
    /// Of each body without what it carries.
    pub(crate) own_inertias: Vec<Inertia>,
    /// The first link without inertia, which cannot be moved by dynamics.
    massless: Option<String>,
    commands: Commands,
    /// The commands of the last step as they were before actuators delivered a share of them.
    asked: Commands,
    pub(crate) state: WorldState,
}

/// The state beside rapier's, which is [`EngineSets`].
#[derive(Debug, Clone)]
pub(crate) struct WorldState {
    q: RobotQ,
    qd: Vec<f64>,
    torque: Vec<f64>,
    saturations: Vec<Saturation>,
    /// The share of its commanded effort that each actuator delivers.
    pub(crate) delivered: Vec<f64>,
    /// The effort that each actuator would have exerted if it delivered all of it.
    asked: Vec<f64>,
    pub(crate) connections: connection::Connections,
    /// What links carry that controllers know of, and what they do not.
    pub(crate) carried: [Vec<CarriedBody>; 2],
    step_count: u64,
}

/// The whole state of a [`World`] at one moment.
#[derive(Clone)]
pub struct WorldSnapshot {
    state: WorldState,
    sets: EngineSets,
}

impl World {
    /// Builds the world; the robot is at zero positions, at rest, at time zero.
    ///
    /// A robot without mass is accepted: it can be placed, and stepped by a controller that places it.
    ///
    /// # Errors
    /// [`SimulationError`] if a setting is out of range, the robot has more than 300 movable joints, the limits of a joint exclude each other, or a
    /// shape with contacts has no volume.
    pub fn new(robot: &Robot, settings: &WorldSettings) -> Result<Self, SimulationError> {
        check(settings)?;
        let dof = robot.dof();
        if dof > build::MOST_JOINTS {
            return Err(SimulationError::TooManyJoints { joints: dof, most: build::MOST_JOINTS });
        }
        let bodies = Bodies::lumped(robot);
        let engine = Engine::new(build::build(robot, &bodies, settings)?, settings);
        let movable = || robot.movable_joints().iter().map(|&joint| robot.joint(joint));
        let carried = |row: usize| robot.link(robot.joint(robot.movable_joints()[row]).child).name.clone();
        Ok(Self {
            massless: first_without_inertia(&engine.mass_matrix()).map(carried),
            engine,
            joint_names: movable().map(|joint| joint.name.clone()).collect(),
            links: bodies.links,
            own_inertias: bodies.inertias,
            commands: Commands::new(dof),
            asked: Commands::new(dof),
            state: WorldState {
                q: RobotQ::zeros(dof),
                qd: vec![0.0; dof],
                torque: vec![0.0; dof],
                saturations: vec![Saturation::default(); dof],
                delivered: vec![1.0; dof],
                asked: vec![0.0; dof],
                connections: connection::Connections::new(dof),
                carried: [Vec::new(), Vec::new()],
                step_count: 0,
            },
        })
    }

    /// Puts the robot at `q` with velocities `qd`, inside the limits or outside; time goes on.
    ///
    /// # Errors
    /// [`SimulationError::Length`], and [`SimulationError::NotFinite`] for an entry that is not
    /// finite; the state is then as before.
    pub fn set_state(&mut self, q: &RobotQ, qd: &[f64]) -> Result<(), SimulationError> {
        self.check_vector("position", q)?;
        self.check_vector("velocity", qd)?;
        self.engine.place(q, qd);
        self.state.torque.fill(0.0);
        self.state.asked.fill(0.0);
        self.state.saturations.fill(Saturation::default());
        // Read back: rapier's coordinates are the state that every step starts from.
        self.engine.read(&mut self.state.q, &mut self.state.qd);
        Ok(())
    }

    /// Joint positions: rapier's own coordinates.
    pub fn q(&self) -> &RobotQ {
        &self.state.q
    }

    /// Joint velocities: rapier's own.
    pub fn qd(&self) -> &[f64] {
        &self.state.qd
    }

    /// Effort of each actuator in the last step; zero after a step that placed the robot.
    pub fn torque(&self) -> &[f64] {
        &self.state.torque
    }

    /// Effort that each actuator would have exerted in the last step if it delivered all that it is asked for: what a
    /// drive reports that knows its current, not its torque.
    pub fn asked_torque(&self) -> &[f64] {
        &self.state.asked
    }

    /// Which limits of each actuator held it back in the last step.
    pub fn saturations(&self) -> &[Saturation] {
        &self.state.saturations
    }

    /// Whether the last step placed the robot, without dynamics.
    pub fn was_placed(&self) -> bool {
        self.commands.placed
    }

    /// Simulated time, s: the number of steps times their length.
    #[expect(clippy::cast_precision_loss, reason = "2^53 steps of 1 ms are 285 thousand years")]
    pub fn time_s(&self) -> f64 {
        // A product, not a sum of steps, whose rounding would grow with the run.
        self.state.step_count as f64 * self.engine.step_s()
    }

    /// Number of steps since the world was built.
    pub fn step_count(&self) -> u64 {
        self.state.step_count
    }

    /// Poses of all links in the root link's frame, in the order of [`Robot::links`], from
    /// rapier's forward kinematics.
    ///
    /// # Panics
    /// When `out` does not hold one entry for each link.
    pub fn root_from_links_into(&self, out: &mut [Isometry3<f64>]) {
        assert_eq!(out.len(), self.links.len(), "one entry for each link");
        // Links of one body follow each other except at branches, so this converts most bodies once.
        let mut body = 0;
        let mut root_from_body = Isometry3::identity();
        for (out, link) in out.iter_mut().zip(&self.links) {
            if link.body != body {
                body = link.body;
                root_from_body = self.engine.world_from_body(body);
            }
            *out = if link.is_first { root_from_body } else { root_from_body * link.body_from_link };
        }
    }

    /// Pose of one link in the root link's frame, from rapier's forward kinematics.
    ///
    /// # Panics
    /// When the link is not one of this robot.
    pub fn root_from_link(&self, link: LinkIndex) -> Isometry3<f64> {
        let link = self.links[link.get()];
        let root_from_body = self.engine.world_from_body(link.body);
        if link.is_first { root_from_body } else { root_from_body * link.body_from_link }
    }

    /// Steps once under a controller, towards the setpoint for the end of the step; the controller knows the true
    /// state.
    ///
    /// # Errors
    /// As [`World::step_measured`].
    pub fn step(
        &mut self,
        controller: &mut dyn Controller,
        setpoint: &Setpoint<'_>,
    ) -> Result<(), SimulationError> {
        self.check_setpoint(setpoint)?;
        self.commands.clear();
        let (q, qd, time_s) = (&self.state.q, &self.state.qd, self.time_s());
        let joints = JointsView { q, qd, time_s, engine: &self.engine };
        controller.command(&joints, setpoint, &mut self.commands);
        self.apply(setpoint)
    }

    /// Steps once under a controller that knows the state by its sensors, `measured`. A servo, which acts on the state
    /// at the end of the step, gets its target shifted by the error of the sensors.
    ///
    /// # Errors
    /// [`SimulationError::Length`] for a setpoint of another length;
    /// [`SimulationError::Massless`] for dynamics of a robot without mass;
    /// [`SimulationError::NotFinite`] if a value of the setpoint, the controller or the physics is not
    /// finite. After the last, the world needs [`World::set_state`] or [`World::restore`].
    pub fn step_measured(
        &mut self,
        controller: &mut dyn Controller,
        setpoint: &Setpoint<'_>,
        measured: &MeasuredState<'_>,
    ) -> Result<(), SimulationError> {
        self.check_setpoint(setpoint)?;
        self.check_vector("measured position", measured.q)?;
        self.check_vector("measured velocity", measured.qd)?;
        // A joint that the controller does not command now must not keep its command of the step before.
        self.commands.clear();
        let (q, qd, time_s) = (measured.q, measured.qd, self.time_s());
        let joints = JointsView { q, qd, time_s, engine: &self.engine };
        controller.command(&joints, setpoint, &mut self.commands);
        let WorldState { q, qd, connections, .. } = &self.state;
        connections.connect(&mut self.commands, &mut self.asked, connection::TrueState { q, qd }, measured);
        self.apply(setpoint)
    }

    fn apply(&mut self, setpoint: &Setpoint<'_>) -> Result<(), SimulationError> {
        if self.commands.placed {
            self.state.step_count += 1;
            self.engine.end_step();
            return self.set_state(setpoint.q, setpoint.qd);
        }
        if let Some(link) = &self.massless {
            return Err(SimulationError::Massless { link: link.clone() });
        }
        self.check_commands()?;
        self.asked.copy_from(&self.commands);
        self.commands.deliver(&self.state.delivered);
        self.engine.step(&self.commands, &self.state.q, &self.state.qd);
        self.state.step_count += 1;
        self.finish_step()
    }

    /// The first link that, with all that it carries, has no mass: forces cannot move it.
    pub fn massless_link(&self) -> Option<&str> {
        self.massless.as_deref()
    }

    /// Joint-space inertia at the present configuration, dof x dof; mimic joints count as free.
    pub fn mass_matrix(&self) -> DMatrix<f64> {
        self.engine.mass_matrix()
    }

    /// Torques that hold the robot against gravity at the present configuration; mimic joints count as free.
    pub fn gravity_torque(&self) -> DVector<f64> {
        let mut torque = DVector::zeros(self.state.q.len());
        self.engine.add_gravity_torque(torque.as_mut_slice());
        torque
    }

    /// The whole state: after [`World::restore`], steps repeat bit by bit.
    pub fn snapshot(&self) -> WorldSnapshot {
        WorldSnapshot { state: self.state.clone(), sets: self.engine.sets().clone() }
    }

    /// Returns to a snapshot of this world.
    ///
    /// # Panics
    /// When the snapshot is of a robot with another number of joints.
    pub fn restore(&mut self, snapshot: &WorldSnapshot) {
        assert_eq!(snapshot.state.q.len(), self.state.q.len(), "the snapshot is of another robot");
        self.engine.restore(&snapshot.sets);
        self.state.clone_from(&snapshot.state);
    }

    fn finish_step(&mut self) -> Result<(), SimulationError> {
        let WorldState { q, qd, torque, asked, saturations, delivered, .. } = &mut self.state;
        self.engine.read(q, qd);
        self.engine.exerted(q, qd, torque, saturations);
        asked.copy_from_slice(torque);
        if delivered.iter().any(|share| (share - 1.0).abs() > 0.0) {
            self.engine.asked(&self.asked, q, qd, asked);
            // An actuator that delivers all is known exactly, at its limits, too.
            for ((asked, torque), share) in asked.iter_mut().zip(torque.iter()).zip(delivered.iter()) {
                if share.to_bits() == 1.0_f64.to_bits() {
                    *asked = *torque;
                }
            }
        }
        self.check_finite("position", &self.state.q)?;
        self.check_finite("velocity", &self.state.qd)?;
        match self.engine.first_unsolved() {
            Some(coordinate) => Err(self.not_finite("acceleration", coordinate)),
            None => Ok(()),
        }
    }

    fn check_setpoint(&self, setpoint: &Setpoint<'_>) -> Result<(), SimulationError> {
        self.check_vector("setpoint position", setpoint.q)?;
        self.check_vector("setpoint velocity", setpoint.qd)?;
        self.check_vector("setpoint acceleration", setpoint.qdd)
    }

    fn check_commands(&self) -> Result<(), SimulationError> {
        self.check_finite("commanded torque", &self.commands.torque)?;
        let is_sound = |motor: &Motor| {
            [motor.q, motor.qd, motor.gains.stiffness, motor.gains.damping].into_iter().all(is_number)
        };
        match self.commands.motors.iter().position(|motor| motor.as_ref().is_some_and(|m| !is_sound(m))) {
            Some(coordinate) => Err(self.not_finite("commanded servo", coordinate)),
            None => Ok(()),
        }
    }

    fn check_vector(&self, what: &'static str, vector: &[f64]) -> Result<(), SimulationError> {
        let (found, expected) = (vector.len(), self.state.q.len());
        if found != expected {
            return Err(SimulationError::Length { what, found, expected });
        }
        self.check_finite(what, vector)
    }

    fn check_finite(&self, what: &'static str, vector: &[f64]) -> Result<(), SimulationError> {
        match vector.iter().position(|value| !is_number(*value)) {
            Some(coordinate) => Err(self.not_finite(what, coordinate)),
            None => Ok(()),
        }
    }

    fn not_finite(&self, what: &'static str, coordinate: usize) -> SimulationError {
        let joint = self.joint_names[coordinate].clone();
        SimulationError::NotFinite { joint, time_s: self.time_s(), what }
    }
}

fn is_number(value: f64) -> bool {
    value.abs() < LARGEST
}

fn check(settings: &WorldSettings) -> Result<(), SimulationError> {
    let WorldSettings { step_s, gravity_in_world, .. } = settings;
    if !(step_s.is_finite() && *step_s > 0.0) {
        return Err(SimulationError::Step { step_s: *step_s });
    }
    if !gravity_in_world.iter().all(|entry| entry.is_finite()) {
        return Err(SimulationError::Gravity { gravity_in_world: (*gravity_in_world).into() });
    }
    Ok(())
}

/// The first joint that moves no inertia.
fn first_without_inertia(mass_matrix: &DMatrix<f64>) -> Option<usize> {
    let diagonal = mass_matrix.diagonal();
    let floor = diagonal.amax() * NO_INERTIA_RATIO;
    diagonal.iter().position(|&entry| entry <= floor)
}
