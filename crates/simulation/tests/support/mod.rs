//! Robots built in code, for tests and benchmarks that need no file.
#![allow(dead_code, reason = "each test binary uses a part")]
#![allow(clippy::unwrap_used, clippy::missing_panics_doc, reason = "helpers of tests")]
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "numbers of steps")]
#![allow(missing_docs, unreachable_pub, reason = "helpers of tests")]

use congruent_description::{
    Geometry, Inertia, JointKind, JointLimit, JointParts, Link, Robot, RobotQ, Shape,
};
use congruent_simulation::{
    Commands, Controller, Gains, JointsView, Kinematic, Motor, Passive, Pd, Setpoint, World, WorldSettings,
};
use nalgebra::{Isometry3, Matrix3, Translation3, Unit, UnitQuaternion, Vector3};

pub fn massless(name: &str) -> Link {
    Link { name: name.into(), ..Link::default() }
}

/// A link of `mass_kg` with its centre of mass at `com_m` and diagonal inertia.
pub fn link(name: &str, mass_kg: f64, com_m: [f64; 3], inertia_kg_m2: [f64; 3]) -> Link {
    let [x, y, z] = com_m;
    let inertia = Inertia {
        mass_kg,
        link_from_inertial: Isometry3::translation(x, y, z),
        tensor_kg_m2: Matrix3::from_diagonal(&Vector3::from(inertia_kg_m2)),
    };
    Link { inertia: Some(inertia), ..massless(name) }
}

/// A joint about or along `axis`, its frame at `xyz_m` turned by `rpy_rad` in the parent.
pub fn joint(kind: JointKind, ends: (&str, &str), xyz_m: [f64; 3], rpy_rad: [f64; 3]) -> JointParts {
    let [roll, pitch, yaw] = rpy_rad;
    let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    let parent_from_joint = Isometry3::from_parts(Translation3::from(Vector3::from(xyz_m)), rotation);
    JointParts::new(&format!("{}_joint", ends.1), kind, ends.0, ends.1, parent_from_joint)
}

pub fn about(mut parts: JointParts, axis: [f64; 3]) -> JointParts {
    parts.joint.axis_in_joint = Unit::new_normalize(Vector3::from(axis));
    parts
}

pub fn limited(mut parts: JointParts, range: (f64, f64), effort: f64) -> JointParts {
    parts.joint.limit = Some(JointLimit {
        lower: range.0,
        upper: range.1,
        velocity: Some(10.0),
        effort: Some(effort),
        ..JointLimit::default()
    });
    parts
}

/// A point of 1 kg on a massless rod of 1 m that swings about y; at zero it hangs down.
pub fn pendulum() -> Robot {
    let bob = link("bob", 1.0, [0.0, 0.0, -1.0], [0.0; 3]);
    let hinge = about(joint(JointKind::Continuous, ("base", "bob"), [0.0; 3], [0.0; 3]), [0.0, 1.0, 0.0]);
    Robot::new("pendulum", vec![massless("base"), bob], vec![hinge]).unwrap()
}

/// Six joints with the geometry, masses and effort limits of a `UR5e`, a flange and a tool.
pub fn arm() -> Robot {
    arm_with(|parts| parts)
}

/// The arm with each joint changed.
pub fn arm_with(change: impl Fn(JointParts) -> JointParts) -> Robot {
    arm_of(link("tool", 0.2, [0.01, 0.0, 0.05], [0.0002, 0.0003, 0.0001]), change)
}

/// The arm with a load that is a part of its tool.
pub fn arm_carrying(load: &Inertia) -> Robot {
    let mut tool = link("tool", 0.2, [0.01, 0.0, 0.05], [0.0002, 0.0003, 0.0001]);
    let both = [tool.inertia.unwrap(), *load].into_iter().map(|part| (Isometry3::identity(), part));
    tool.inertia = Some(Inertia::sum_of_parts(both));
    arm_of(tool, |parts| parts)
}

fn arm_of(tool: Link, change: impl Fn(JointParts) -> JointParts) -> Robot {
    use std::f64::consts::{FRAC_PI_2 as HALF, PI};
    let links = vec![
        massless("base"),
        link("shoulder", 3.761, [0.0, -0.0255, 0.0019], [0.0103, 0.0103, 0.0067]),
        link("upper_arm", 8.058, [-0.2125, 0.0, 0.1134], [0.0151, 0.1338, 0.1338]),
        link("forearm", 2.846, [-0.2422, 0.0, 0.0265], [0.0041, 0.0312, 0.0312]),
        link("wrist_1", 1.37, [0.0, -0.016, -0.0018], [0.0028, 0.0022, 0.0027]),
        link("wrist_2", 1.3, [0.0, 0.016, -0.0018], [0.0026, 0.0022, 0.0025]),
        link("wrist_3", 0.365, [0.0, 0.0, -0.0012], [0.0003, 0.0003, 0.0004]),
        massless("flange"),
        tool,
    ];
    let turn = |ends, xyz_m, rpy_rad, effort| {
        limited(joint(JointKind::Revolute, ends, xyz_m, rpy_rad), (-2.0 * PI, 2.0 * PI), effort)
    };
    let fixed = |ends, xyz_m, rpy_rad| joint(JointKind::Fixed, ends, xyz_m, rpy_rad);
    let joints = vec![
        turn(("base", "shoulder"), [0.0, 0.0, 0.1625], [0.0, 0.0, 0.0], 150.0),
        turn(("shoulder", "upper_arm"), [0.0, 0.0, 0.0], [HALF, 0.0, 0.0], 150.0),
        turn(("upper_arm", "forearm"), [-0.425, 0.0, 0.0], [0.0, 0.0, 0.0], 150.0),
        turn(("forearm", "wrist_1"), [-0.3922, 0.0, 0.1333], [0.0, 0.0, 0.0], 28.0),
        turn(("wrist_1", "wrist_2"), [0.0, -0.0997, 0.0], [HALF, 0.0, 0.0], 28.0),
        turn(("wrist_2", "wrist_3"), [0.0, 0.0996, 0.0], [HALF, PI, PI], 28.0),
        fixed(("wrist_3", "flange"), [0.0, 0.0, 0.0], [0.0, -HALF, -HALF]),
        fixed(("flange", "tool"), [0.02, 0.0, 0.1], [0.3, -0.2, 0.1]),
    ];
    Robot::new("arm", links, joints.into_iter().map(change).collect()).unwrap()
}

/// Start of the arm's tests, away from every symmetry: 0.3 + 0.1 i rad.
pub fn arm_q0() -> RobotQ {
    RobotQ::from([0.3, 0.4, 0.5, 0.6, 0.7, 0.8])
}

/// Two hinges and a slide: the second hinge follows the first by -1.5, the slide by 0.2 m/rad.
pub fn mimic_arm() -> Robot {
    let links = vec![
        massless("base"),
        link("lead", 1.0, [0.2, 0.0, 0.1], [0.02, 0.03, 0.01]),
        link("follower", 0.5, [0.1, 0.05, 0.0], [0.01, 0.02, 0.015]),
        link("slide", 0.3, [0.0, 0.0, 0.1], [0.001, 0.002, 0.003]),
    ];
    let lead =
        about(joint(JointKind::Continuous, ("base", "lead"), [0.0; 3], [0.2, 0.1, 0.0]), [0.0, 1.0, 0.3]);
    let mut follower = joint(JointKind::Continuous, ("lead", "follower"), [0.4, 0.0, 0.0], [1.2, 0.0, 0.3]);
    follower.mimic = Some(("lead_joint".into(), -1.5, 0.1));
    let mut slide = joint(JointKind::Prismatic, ("follower", "slide"), [0.2, 0.0, 0.0], [0.0, 0.4, 0.0]);
    slide.mimic = Some(("lead_joint".into(), 0.2, -0.05));
    Robot::new("mimic_arm", links, vec![lead, follower, slide]).unwrap()
}

/// A bar of 1 kg and 1 m along x on a hinge about y, with a collision box.
pub fn swinging_bar() -> Robot {
    let mut bar = link("bar", 1.0, [0.5, 0.0, 0.0], [0.001, 0.0834, 0.0834]);
    bar.collisions.push(Shape {
        link_from_shape: Isometry3::translation(0.5, 0.0, 0.0),
        geometry: Geometry::Box { size_m: Vector3::new(1.0, 0.05, 0.05) },
        color_rgba: None,
    });
    let hinge = about(joint(JointKind::Continuous, ("base", "bar"), [0.0; 3], [0.0; 3]), [0.0, 1.0, 0.0]);
    Robot::new("bar", vec![massless("base"), bar], vec![hinge]).unwrap()
}

/// A block of 2 kg and edges of 0.1 m that slides along x and along z, its faces 0.05 m from its origin.
pub fn sliding_block() -> Robot {
    sliding_block_of(Shape {
        link_from_shape: Isometry3::identity(),
        geometry: Geometry::Box { size_m: Vector3::new(0.1, 0.1, 0.1) },
        color_rgba: None,
    })
}

/// The same with another shape.
pub fn sliding_block_of(shape: Shape) -> Robot {
    let mut block = link("block", 2.0, [0.0; 3], [0.01; 3]);
    block.collisions.push(shape);
    let carriage = link("carriage", 1e-3, [0.0; 3], [1e-6; 3]);
    let slide = |ends, axis| about(joint(JointKind::Prismatic, ends, [0.0; 3], [0.0; 3]), axis);
    let joints =
        vec![slide(("base", "carriage"), [1.0, 0.0, 0.0]), slide(("carriage", "block"), [0.0, 0.0, 1.0])];
    let free = joints.into_iter().map(|parts| limited(parts, (-50.0, 50.0), 1e3)).collect();
    Robot::new("block", vec![massless("base"), carriage, block], free).unwrap()
}

/// Gravity torque of the present configuration by the engine's own masses, and servos if the gains are not zero.
pub struct EngineGravity(pub Gains);

impl Controller for EngineGravity {
    fn command(&mut self, joints: &JointsView<'_>, setpoint: &Setpoint<'_>, commands: &mut Commands) {
        joints.add_gravity_torque(commands.torque_mut());
        for (coordinate, (&q, &qd)) in setpoint.q.iter().zip(setpoint.qd).enumerate() {
            commands.drive(coordinate, Motor { gains: self.0, q, qd });
        }
    }
}

/// A controller without or with gains.
pub fn make(kind: &str, stiffness: f64, damping: f64) -> Box<dyn Controller> {
    let gains = Gains { stiffness, damping };
    match kind {
        "passive" => Box::new(Passive),
        "kinematic" => Box::new(Kinematic),
        "pd" => Box::new(Pd { gains: vec![gains; 40] }),
        "gravity_compensation" => Box::new(EngineGravity(gains)),
        unknown => panic!("{unknown}"),
    }
}

/// The usual settings with this step.
pub fn with_step(step_s: f64) -> WorldSettings {
    WorldSettings { step_s, ..WorldSettings::default() }
}

/// The robot's joints as parts, each changed; the name of a master makes a joint a mimic of it; no
/// other joint is one.
pub fn rebuilt(robot: &Robot, change: impl Fn(&mut JointParts)) -> Robot {
    let parts = robot.joints().iter().map(|joint| {
        let mut parts = JointParts {
            joint: joint.clone(),
            parent: robot.link(joint.parent).name.clone(),
            child: robot.link(joint.child).name.clone(),
            mimic: None,
        };
        change(&mut parts);
        parts
    });
    Robot::new(robot.name(), robot.links().to_vec(), parts.collect()).unwrap()
}

/// A world with the robot at `q`, at rest.
pub fn at(robot: &Robot, settings: &WorldSettings, q: &RobotQ) -> World {
    let mut world = World::new(robot, settings).unwrap();
    world.set_state(q, &vec![0.0; q.len()]).unwrap();
    world
}

/// Number of steps in a duration.
pub fn steps(duration_s: f64, step_s: f64) -> usize {
    (duration_s / step_s).round() as usize
}

/// Steps towards a setpoint at rest.
pub fn run(world: &mut World, controller: &mut dyn Controller, q: &RobotQ, steps: usize) {
    let qd = vec![0.0; q.len()];
    for _ in 0..steps {
        world.step(controller, &Setpoint { q, qd: &qd, qdd: &qd }).unwrap();
    }
}

/// Largest absolute difference.
pub fn worst(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Positions, velocities and torques, and the number of steps, for comparisons bit by bit.
pub fn bits(world: &World) -> (Vec<u64>, u64) {
    let numbers = world.q().iter().chain(world.qd()).chain(world.torque());
    (numbers.map(|number| number.to_bits()).collect(), world.step_count())
}
