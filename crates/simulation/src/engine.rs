//! The robot in rapier: sets states and forces, steps, reads states. It has coordinates only; names of links
//! and joints are in `world.rs`.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, Isometry3, Vector3};
use rapier3d_f64::prelude::{
    IntegrationParameters, MotorModel, Multibody, MultibodyIndex, MultibodyJoint, PhysicsPipeline,
    RigidBodyHandle, Vector,
};

use crate::{
    adapter,
    build::Built,
    commands::Commands,
    contact::left_out::LeftOut,
    drive::{CoordinateState, JointDrive, Linear, Saturation},
    sets::{EngineSets, EngineSlot, ObstacleMove},
    settings::WorldSettings,
};

/// Sweeps of the constraint solver in a step. Dry friction that holds a six-joint arm creeps in 5 s
/// by 2.8e-4 rad with 20, 2.1e-6 with 40, 1.2e-8 with 80; a step with servos takes 7.6, 9.3 and
/// 12 us. Without servos, friction or couplings sweeps cost nothing.
const SWEEPS: usize = 40;

/// Further sweeps for each mimic joint: couplings to one master act on each other. A gripper with five has
/// an error of 1.1e-5 rad with 40 sweeps in all, 3.5e-8 with 80, 6.7e-12 with 140.
const SWEEPS_PER_MIMIC: usize = 25;

/// Further sweeps if a joint has dry friction: if several joints with strongly coupled inertias are held, 40 sweeps leave residual
/// speeds of 1e-3 rad/s. A sweep of a six-joint arm takes some 0.07 us.
const SWEEPS_WITH_FRICTION: usize = 200;

/// Largest speed at which a joint outside its limits returns, rad/s or m/s.
///
/// rapier by itself returns within one step: a robot placed 1 rad outside would get 1000 rad/s.
const RETURN_SPEED: f64 = 1.0;

/// The robot in rapier, and how it is stepped.
pub(crate) struct Engine {
    pub(crate) sets: EngineSets,
    pub(crate) handles: Vec<RigidBodyHandle>,
    pub(crate) slots: Vec<EngineSlot>,
    /// Bodies of obstacles that may move.
    pub(crate) moving: BTreeMap<usize, RigidBodyHandle>,
    pub(crate) multibody: Option<MultibodyIndex>,
    pub(crate) pipeline: PhysicsPipeline,
    pub(crate) parameters: IntegrationParameters,
    pub(crate) gravity: Vector,
    /// Drives of the joints in the present step.
    pub(crate) drives: Vec<JointDrive>,
    /// Whether some body carries a force of the step before: rapier's forces persist.
    pub(crate) is_forced: bool,
    /// Obstacles that move in the next step.
    pub(crate) moves: Vec<ObstacleMove>,
    /// Contacts that do not act in the present step.
    pub(crate) left_out: LeftOut,
    /// Whether a joint was beyond its limits at the beginning of the last step, which brings it back.
    pub(crate) is_beyond_limits: bool,
}

impl Engine {
    pub(crate) fn new(built: Built, settings: &WorldSettings) -> Self {
        let parameters = IntegrationParameters {
            dt: settings.step_s,
            // One substep: the servo of `drive.rs` is implicit in the whole step.
            num_solver_iterations: 1,
            max_ccd_substeps: 0,
            normalized_max_linear_velocity: f64::MAX,
            ..IntegrationParameters::default()
        };
        let Built { sets, handles, slots, moving, multibody } = built;
        let gravity = adapter::vector(&settings.gravity_in_world);
        let pipeline = new_pipeline();
        let drives = vec![JointDrive::default(); slots.len()];
        let mut engine = Self {
            sets,
            handles,
            slots,
            moving,
            multibody,
            pipeline,
            parameters,
            gravity,
            drives,
            is_forced: false,
            moves: Vec::new(),
            left_out: LeftOut::default(),
            is_beyond_limits: false,
        };
        engine.choose_sweeps();
        engine
    }

    /// Sets the number of sweeps by mimic joints and dry friction.
    pub(crate) fn choose_sweeps(&mut self) {
        let mimics = self.slots.iter().filter(|slot| slot.is_mimic).count();
        let has_friction = (0..self.slots.len()).any(|coordinate| self.dry_friction(coordinate) > 0.0);
        let with_friction = if has_friction { SWEEPS_WITH_FRICTION } else { 0 };
        self.parameters.num_internal_pgs_iterations = SWEEPS + SWEEPS_PER_MIMIC * mimics + with_friction;
    }

    pub(crate) fn step_s(&self) -> f64 {
        self.parameters.dt
    }

    pub(crate) fn gravity_in_world(&self) -> Vector3<f64> {
        adapter::vector3(self.gravity)
    }

    pub(crate) fn is_mimic(&self, coordinate: usize) -> bool {
        self.slots[coordinate].is_mimic
    }

    pub(crate) fn multibody(&self) -> Option<&Multibody> {
        self.sets.multibody_joints.get_multibody(self.multibody?)
    }

    pub(crate) fn multibody_mut(&mut self) -> Option<&mut Multibody> {
        self.sets.multibody_joints.get_multibody_mut(self.multibody?)
    }

    /// Copies positions and velocities out.
    pub(crate) fn read(&self, q: &mut [f64], qd: &mut [f64]) {
        let Some(multibody) = self.multibody() else { return };
        qd.copy_from_slice(multibody.generalized_velocity().as_slice());
        for ((q, link), slot) in q.iter_mut().zip(multibody.links().skip(1)).zip(&self.slots) {
            *q = link.joint().coords()[slot.axis as usize];
        }
    }

    /// Pose of a body in the world, from rapier's forward kinematics.
    pub(crate) fn world_from_body(&self, body: usize) -> Isometry3<f64> {
        let link = self.multibody().and_then(|multibody| multibody.link(body));
        link.map_or_else(Isometry3::identity, |link| adapter::isometry(link.local_to_world()))
    }

    /// Moves the joints to these positions, and all bodies with them.
    pub(crate) fn place(&mut self, q: &[f64], qd: &[f64]) {
        self.clear_forces();
        let Some(index) = self.multibody else { return };
        let sets = &mut self.sets;
        let multibody = sets.multibody_joints.get_multibody_mut(index).expect("the multibody exists");
        for link in multibody.links_mut().skip(1) {
            // Through a new joint at zero: 0 + q is q to the last bit, while a displacement from the old position is rounded.
            link.joint = MultibodyJoint::new(link.joint.data, false);
        }
        multibody.apply_displacements(q);
        multibody.generalized_velocity_mut().as_mut_slice().copy_from_slice(qd);
        multibody.forward_kinematics(&sets.bodies, true);
        multibody.update_rigid_bodies(&mut sets.bodies, true);
        if sets.colliders.is_empty() {
            return;
        }
        for link in multibody.links().skip(1) {
            let body = sets.bodies.get_mut(link.rigid_body_handle()).expect("the body exists");
            for &collider in body.colliders() {
                let collider = sets.colliders.get_mut(collider).expect("the collider exists");
                // rapier moves colliders only within a step: contacts of the next one would begin with the old
                // places.
                if let Some(&body_from_shape) = collider.position_wrt_parent() {
                    collider.set_position(*link.local_to_world() * body_from_shape);
                }
            }
        }
    }

    /// One step from `q`, `qd` under the commands, which hold finite numbers.
    pub(crate) fn step(&mut self, commands: &Commands, q: &[f64], qd: &[f64]) {
        self.step_within_limits(commands, q, qd);
        // Rare: a link cannot yield to an obstacle. Each round repeats the step without one more contact.
        while self.leave_out_contact(q, qd) {
            self.step_within_limits(commands, q, qd);
        }
        self.end_step();
    }

    /// One step under the commands within the limits of the actuators.
    fn step_within_limits(&mut self, commands: &Commands, q: &[f64], qd: &[f64]) {
        let step_s = self.step_s();
        for (coordinate, (drive, slot)) in self.drives.iter_mut().zip(&self.slots).enumerate() {
            let state = CoordinateState { q: q[coordinate], qd: qd[coordinate] };
            let (torque, servo) = (commands.torque[coordinate], commands.motors[coordinate]);
            let servo = servo.filter(|_| !slot.is_mimic);
            *drive = slot.capability.drive(torque, servo, state, step_s);
        }
        self.step_drives();
        // Rare: the impact of a contact, or a joint that reaches its largest speed in this step. Each correction may take
        // another joint beyond a limit, so there are at most as many rounds as joints; each repeats the step from its start.
        for _ in 0..=self.slots.len() {
            if !self.correct_drives() {
                break;
            }
            self.return_to(q, qd);
            self.step_drives();
        }
    }

    /// Corrects the drives that took their joints beyond a limit; returns whether there are any.
    fn correct_drives(&mut self) -> bool {
        let Some(index) = self.multibody else { return false };
        let multibody = self.sets.multibody_joints.get_multibody(index).expect("the multibody exists");
        let speeds = multibody.generalized_velocity();
        let mut is_corrected = false;
        for (row, (link, slot)) in multibody.links().skip(1).zip(&self.slots).enumerate() {
            let end = CoordinateState { q: link.joint().coords()[slot.axis as usize], qd: speeds[row] };
            is_corrected |= slot.capability.correct(&mut self.drives[row], end);
        }
        is_corrected
    }

    pub(crate) fn step_drives(&mut self) {
        self.clear_forces();
        self.set_servos_and_limits();
        self.apply_torques();
        let sets = &mut self.sets;
        sets.near.set_shapes(&mut sets.colliders, &sets.bodies);
        self.pipeline.step(
            self.gravity,
            &self.parameters,
            &mut sets.islands,
            &mut sets.broad_phase,
            &mut sets.narrow_phase,
            &mut sets.bodies,
            &mut sets.colliders,
            &mut sets.impulse_joints,
            &mut sets.multibody_joints,
            &mut sets.soft_bodies,
            &mut sets.ccd,
            &self.left_out,
            &(),
        );
    }

    fn set_servos_and_limits(&mut self) {
        let Some(index) = self.multibody else { return };
        let step_s = self.parameters.dt;
        let multibody = self.sets.multibody_joints.get_multibody_mut(index).expect("the multibody exists");
        self.is_beyond_limits = false;
        for (row, (link, slot)) in multibody.links_mut().skip(1).zip(&self.slots).enumerate() {
            let q = link.joint.coords()[slot.axis as usize];
            let data = &mut link.joint.data;
            data.limit_axes.remove(slot.axis.into());
            data.motor_axes.remove(slot.axis.into());
            if let Some(limits) = slot.passed_limits(q, step_s) {
                data.set_limits(slot.axis, limits);
                self.is_beyond_limits = true;
            }
            let drive = &self.drives[row];
            let linear = if drive.is_constrained { Linear::default() } else { drive.linear() };
            // The spring is in the mass matrix, so implicit and exact; the motor below is a constraint that sweeps
            // solve, but only it knows a largest force.
            link.joint.set_spring(slot.axis as usize, linear.stiffness, linear.rest);
            if let Some(motor) = drive.combined().filter(|_| drive.is_constrained) {
                // rapier's target is that at the beginning of the step and moves with its velocity; ours is that at its end.
                let (target, gains) = (motor.q - step_s * motor.qd, motor.gains);
                let data = &mut link.joint.data;
                data.set_motor(slot.axis, target, motor.qd, gains.stiffness, gains.damping);
                data.set_motor_model(slot.axis, MotorModel::ForceBased);
                data.set_motor_max_force(slot.axis, slot.capability.effort);
            }
        }
        // Damping of joint and servo goes into the mass matrix, implicitly: stable for any value.
        for (row, (drive, own)) in self.drives.iter().zip(&self.sets.damping).enumerate() {
            let servo = drive.servo.filter(|_| !drive.is_constrained);
            multibody.damping_mut()[row] = own + servo.map_or(0.0, |servo| servo.gains.damping);
        }
    }

    /// The first coordinate for which this step had no solution: rapier found no pivot in its mass
    /// matrix, or disabled a body whose pose was not finite.
    pub(crate) fn first_unsolved(&self) -> Option<usize> {
        let quarantine = self.pipeline.quarantine().bodies();
        if !quarantine.is_empty() {
            let bad = |handle: &RigidBodyHandle| quarantine.contains(handle);
            // The root has no coordinate, thus body `i + 1` is coordinate `i`.
            return self.handles.iter().skip(1).position(bad).or(Some(0));
        }
        let factors = self.multibody()?.inv_augmented_mass().lu_internal();
        let pivot = |row: usize| factors[(row, row)];
        (0..factors.nrows()).find(|&row| !pivot(row).is_finite() || pivot(row) == 0.0)
    }

    /// Effort of each actuator in the step that ended in `q`, `qd`, and which of its limits were active.
    pub(crate) fn exerted(&self, q: &[f64], qd: &[f64], torque: &mut [f64], saturations: &mut [Saturation]) {
        for (row, (slot, drive)) in self.slots.iter().zip(&self.drives).enumerate() {
            let (effort, is_largest) =
                slot.capability.exerted(drive, CoordinateState { q: q[row], qd: qd[row] });
            torque[row] = effort;
            saturations[row] =
                Saturation { effort: drive.saturation.effort || is_largest, ..drive.saturation };
        }
    }

    /// Effort that each actuator would have exerted under other commands in the step that ended in `q`, `qd`.
    pub(crate) fn asked(&self, commands: &Commands, q: &[f64], qd: &[f64], torque: &mut [f64]) {
        for (row, slot) in self.slots.iter().enumerate() {
            let servo = commands.motors[row].filter(|_| !slot.is_mimic);
            // Without the limit of speed, which belongs to the delivered motion and not to the command.
            let drive = JointDrive { torque: commands.torque[row], servo, ..JointDrive::default() };
            torque[row] = slot.capability.exerted(&drive, CoordinateState { q: q[row], qd: qd[row] }).0;
        }
    }

    /// Joint-space inertia, from rapier's own factorisation of it.
    pub(crate) fn mass_matrix(&self) -> DMatrix<f64> {
        let Some(multibody) = self.multibody() else { return DMatrix::zeros(0, 0) };
        let mut multibody = multibody.clone();
        // Called for what it assembles: the mass matrix without damping.
        multibody.dof_inverse_inertia(&self.sets.bodies);
        let factors = multibody.inv_augmented_mass();
        let mut matrix = factors.l() * factors.u();
        factors.p().inv_permute_rows(&mut matrix);
        matrix
    }

    pub(crate) fn sets(&self) -> &EngineSets {
        &self.sets
    }

    pub(crate) fn restore(&mut self, sets: &EngineSets) {
        self.sets.clone_from(sets);
        // A new pipeline: the old one keeps contacts and islands of the state before, and steps would not repeat bit by bit.
        self.pipeline = new_pipeline();
        self.is_forced = true;
        self.moves.clear();
    }
}

impl EngineSlot {
    /// The limits to enforce in a step that begins at `q`; `None` inside the range, in which a limit
    /// does nothing but costs a solve.
    fn passed_limits(&self, q: f64, step_s: f64) -> Option<[f64; 2]> {
        let distance = RETURN_SPEED * step_s;
        let is_inside = (self.lower..=self.upper).contains(&q);
        // Limits that lie one step's return away: the constraint then asks for `RETURN_SPEED`, no more.
        (!is_inside).then(|| [self.lower.min(q + distance), self.upper.max(q - distance)])
    }
}

fn new_pipeline() -> PhysicsPipeline {
    let mut pipeline = PhysicsPipeline::new();
    pipeline.counters.disable();
    pipeline
}
