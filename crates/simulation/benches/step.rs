//! Steps per second of a lumped six-joint arm under each controller, and of rapier alone with the same multibody:
//! `cargo bench -p congruent-simulation`. One item is one step of 1 ms.

#[path = "../tests/support/mod.rs"]
mod support;

use congruent_description::{Inertia, LinkIndex, Robot};
use congruent_simulation::{Setpoint, World, WorldSettings};
use divan::{Bencher, counter::ItemsCount};
use nalgebra::Isometry3;
use rapier3d_f64::prelude::{
    BroadPhaseBvh, CCDSolver, ColliderSet, GenericJoint, ImpulseJointSet, IntegrationParameters,
    IslandManager, JointAxesMask, JointAxis, MassProperties, MotorModel, MultibodyIndex, MultibodyJointSet,
    NarrowPhase, PhysicsPipeline, Pose, RigidBodyBuilder, RigidBodySet, Rotation, SoftBodySet, Vector,
};
use support::{arm, arm_q0, make};

/// Steps in one sample: enough that the clock does not count, few enough to stay near the start.
const STEPS: usize = 500;

fn main() {
    divan::main();
}

#[divan::bench(args = ["passive", "kinematic", "pd", "gravity_compensation"])]
fn step(bencher: Bencher<'_, '_>, kind: &str) {
    let mut world = World::new(&arm(), &WorldSettings::default()).expect("the arm is a robot");
    let mut controller = make(kind, 400.0, 40.0);
    let q0 = arm_q0();
    let setpoint = Setpoint { q: &q0, qd: &[0.0; 6], qdd: &[0.0; 6] };
    world.set_state(&q0, &[0.0; 6]).expect("the state fits");
    let start = world.snapshot();
    bencher.counter(ItemsCount::new(STEPS)).bench_local(|| {
        world.restore(&start);
        for _ in 0..STEPS {
            world.step(controller.as_mut(), &setpoint).expect("the arm steps");
        }
    });
}

/// rapier alone: the same bodies, joints and parameters, motors as rapier has them.
#[divan::bench(args = ["passive", "pd"])]
fn bare_rapier(bencher: Bencher<'_, '_>, kind: &str) {
    let start = Bare::new(&arm(), kind);
    let parameters = IntegrationParameters {
        dt: 1e-3,
        num_solver_iterations: 1,
        num_internal_pgs_iterations: 40,
        max_ccd_substeps: 0,
        normalized_max_linear_velocity: f64::MAX,
        ..IntegrationParameters::default()
    };
    bencher.counter(ItemsCount::new(STEPS)).bench_local(|| {
        let mut bare = start.clone();
        let mut pipeline = PhysicsPipeline::new();
        pipeline.counters.disable();
        for _ in 0..STEPS {
            bare.step(&mut pipeline, &parameters);
        }
        bare.multibody().generalized_velocity().as_slice().to_vec()
    });
}

#[divan::bench]
fn poses(bencher: Bencher<'_, '_>) {
    let robot = arm();
    let world = World::new(&robot, &WorldSettings::default()).expect("the arm is a robot");
    let mut poses = vec![Isometry3::identity(); robot.links().len()];
    bencher.bench_local(|| world.root_from_links_into(divan::black_box(&mut poses)));
}

/// The arm in rapier's sets.
#[derive(Clone, Default)]
struct Bare {
    bodies: RigidBodySet,
    colliders: ColliderSet,
    joints: MultibodyJointSet,
    impulse_joints: ImpulseJointSet,
    soft_bodies: SoftBodySet,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    ccd: CCDSolver,
    multibody: Option<MultibodyIndex>,
}

impl Bare {
    /// Every joint of the arm turns about the z axis of its frame.
    fn new(robot: &Robot, kind: &str) -> Self {
        let mut bare = Self::default();
        let mut parent = bare.bodies.insert(RigidBodyBuilder::fixed());
        let turn = Pose::from_rotation(Rotation::from_rotation_y(-std::f64::consts::FRAC_PI_2));
        for (&joint, &q) in robot.movable_joints().iter().zip(&arm_q0()) {
            let joint = robot.joint(joint);
            let mass = mass_properties(&body_inertia(robot, joint.child));
            let body = RigidBodyBuilder::dynamic().additional_mass_properties(mass).can_sleep(false);
            let body = bare.bodies.insert(body);
            let mut data = GenericJoint::new(JointAxesMask::LOCKED_REVOLUTE_AXES);
            data.set_local_frame1(pose(&joint.parent_from_joint) * turn).set_local_frame2(turn);
            data.set_contacts_enabled(false);
            if kind == "pd" {
                data.set_motor(JointAxis::AngX, q, 0.0, 400.0, 40.0);
                data.set_motor_model(JointAxis::AngX, MotorModel::ForceBased);
            }
            bare.joints.insert(parent, body, data, true).expect("a chain");
            parent = body;
        }
        let bodies = &mut bare.bodies;
        let handles: Vec<_> = bodies.iter().map(|(handle, _)| handle).collect();
        for handle in handles {
            bodies[handle].recompute_mass_properties_from_colliders(&bare.colliders);
        }
        let index = bare.joints.rigid_body_link(parent).expect("it hangs on a joint").multibody;
        bare.multibody = Some(index);
        let multibody = bare.joints.get_multibody_mut(index).expect("the multibody");
        multibody.forward_kinematics(bodies, true);
        multibody.damping_mut().fill(0.0);
        multibody.apply_displacements(&arm_q0());
        multibody.forward_kinematics(bodies, true);
        multibody.update_rigid_bodies(bodies, true);
        bare
    }

    fn multibody(&self) -> &rapier3d_f64::prelude::Multibody {
        self.multibody.and_then(|index| self.joints.get_multibody(index)).expect("the multibody")
    }

    fn step(&mut self, pipeline: &mut PhysicsPipeline, parameters: &IntegrationParameters) {
        pipeline.step(
            Vector::new(0.0, 0.0, -9.81),
            parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.impulse_joints,
            &mut self.joints,
            &mut self.soft_bodies,
            &mut self.ccd,
            &(),
            &(),
        );
    }
}

/// The inertia of a link and of all that is fixed to it.
fn body_inertia(robot: &Robot, body: LinkIndex) -> Inertia {
    let parts: Vec<(Isometry3<f64>, Inertia)> = robot
        .link_indices()
        .filter(|&link| robot.body(link) == body)
        .filter_map(|link| {
            let (mut at, mut body_from_link) = (link, Isometry3::identity());
            while at != body {
                let joint = robot.joint(robot.parent_joint(at)?);
                (at, body_from_link) = (joint.parent, joint.parent_from_joint * body_from_link);
            }
            Some((body_from_link, robot.link(link).inertia?))
        })
        .collect();
    Inertia::sum_of_parts(parts.into_iter())
}

fn mass_properties(inertia: &Inertia) -> MassProperties {
    let tensor = inertia.tensor_kg_m2.symmetric_eigen();
    let mut axes = tensor.eigenvectors;
    if axes.determinant() < 0.0 {
        axes.column_mut(2).neg_mut();
    }
    let turn = nalgebra::Rotation3::from_matrix_unchecked(axes);
    let turn = nalgebra::UnitQuaternion::from_rotation_matrix(&turn);
    let principal = Vector::new(tensor.eigenvalues.x, tensor.eigenvalues.y, tensor.eigenvalues.z);
    let com = inertia.link_from_inertial.translation.vector;
    let com = Vector::new(com.x, com.y, com.z);
    let frame = Rotation::from_xyzw(turn.i, turn.j, turn.k, turn.w);
    MassProperties::with_principal_inertia_frame(com, inertia.mass_kg, principal, frame)
}

fn pose(isometry: &Isometry3<f64>) -> Pose {
    let (t, r) = (isometry.translation.vector, isometry.rotation);
    Pose::from_parts(Vector::new(t.x, t.y, t.z), Rotation::from_xyzw(r.i, r.j, r.k, r.w))
}
