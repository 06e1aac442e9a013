//! Each controller on the UR5e and the Panda against what theory predicts.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::{collections::BTreeMap, path::Path};

use congruent_description::{RobotDescription, RobotQ, load_robot};
use congruent_dynamics::BodyTree;
use congruent_scenario::{
    ControllerKind, ControllerSettings, JointMotion, JointNumbers, JointSettings, MotionSettings,
    PayloadSettings, Scenario, SensorSettings, SimulationSettings, StartSettings, VelocitySensor,
};
use congruent_simulation::{Setpoint, World, WorldSettings};
use congruent_twin::{
    JointController, RunSetup,
    source::{JointStateSource, SimulationSource},
};

const ARM: [&str; 2] = ["ur5e", "panda"];

fn robot(name: &str) -> RobotDescription {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots").join(name);
    load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}"))
}

/// Positions away from every symmetry and limit.
fn start(description: &RobotDescription) -> BTreeMap<String, f64> {
    let robot = &description.robot;
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let actuated = joints.filter(|joint| joint.kind.is_angular() && joint.mimic.is_none());
    actuated
        .enumerate()
        .map(|(at, joint)| {
            let (lower, upper) = joint.position_range().unwrap();
            let at = 0.1 * f64::from(u8::try_from(at).unwrap());
            (joint.name.clone(), 0.5 * (lower.max(-2.0) + upper.min(2.0)) + 0.2 + at)
        })
        .collect()
}

fn still(description: &RobotDescription, controller: ControllerSettings) -> Scenario {
    Scenario {
        name: "control".to_owned(),
        seed: 5,
        start: StartSettings { joints_rad: start(description), ..StartSettings::default() },
        simulation: SimulationSettings { duration_s: Some(1000.0), ..SimulationSettings::default() },
        controller,
        ..Scenario::default()
    }
}

fn gains(kind: &str, stiffness: f64, damping: f64) -> ControllerSettings {
    let (stiffness, damping) = (stiffness.into(), damping.into());
    ControllerSettings {
        kind: ControllerKind::find(kind).expect("a kind"),
        stiffness,
        damping,
        ..ControllerSettings::default()
    }
}

fn setup(description: &RobotDescription, scenario: Scenario) -> RunSetup {
    RunSetup::new(scenario, description.clone()).unwrap_or_else(|findings| panic!("{findings:#?}"))
}

fn after(setup: &RunSetup, duration_s: f64) -> SimulationSource<'_> {
    let mut source = SimulationSource::new(setup).unwrap();
    while setup.clock.time_s(source.step_count()) < duration_s - setup.clock.step_s / 2.0 {
        let time_s = setup.clock.time_s(source.step_count() + 1);
        source.advance(time_s).unwrap();
    }
    source
}

fn errors(setup: &RunSetup, source: &SimulationSource<'_>) -> Vec<f64> {
    source.joints().state().q.iter().zip(&setup.start).map(|(q, wanted)| q - wanted).collect()
}

fn gravity(description: &RobotDescription, q: &RobotQ) -> Vec<f64> {
    let tree = BodyTree::new(&description.robot);
    let mut tau = vec![0.0; tree.dof()];
    tree.gravity_into(q, &mut tree.buffer(), &mut tau).unwrap();
    tau
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}

/// Sag of a servo against gravity torque / stiffness, rad; settling of 6 s.
const SAG_RAD: f64 = 1e-8;

#[test]
fn pd_sags_by_gravity_torque_over_its_joints_stiffness() {
    for name in ARM {
        let description = robot(name);
        let mut controller = gains("pd", 0.0, 200.0);
        let first = description.robot.joint(description.robot.movable_joints()[1]).name.clone();
        controller.stiffness = JointNumbers::from([(first.as_str(), 4000.0), ("others", 1000.0)]);
        let setup = setup(&description, still(&description, controller));
        let source = after(&setup, 12.0);
        let tau = gravity(&description, source.joints().state().q);
        let arm = description.robot.movable_joints().iter().take(6).enumerate();
        for (row, _) in arm {
            let stiffness = if row == 1 { 4000.0 } else { 1000.0 };
            let off = errors(&setup, &source)[row] + tau[row] / stiffness;
            assert!(off.abs() < SAG_RAD, "{name} {row}: {off:e}");
        }
        assert!(largest(&errors(&setup, &source)) > 1e-3, "{name} sags");
    }
}

#[test]
fn an_integral_removes_the_sag() {
    for name in ARM {
        let description = robot(name);
        let mut controller = gains("pid", 2000.0, 200.0);
        controller.integral = JointNumbers::from(4000.0);
        let setup = setup(&description, still(&description, controller));
        let sagging = after(&setup, 0.3);
        assert!(largest(&errors(&setup, &sagging)) > 1e-3, "{name}");
        let source = after(&setup, 10.0);
        // The slowest time constant is stiffness / integral, 0.5 s: exp(-20) of the sag is left.
        assert!(largest(&errors(&setup, &source)) < 1e-8, "{name}: {:?}", errors(&setup, &source));
    }
}

#[test]
fn gravity_compensation_holds_with_the_payload_that_is_declared() {
    for name in ARM {
        let description = robot(name);
        let load = PayloadSettings {
            name: "box".to_owned(),
            mass_kg: 1.5,
            com_m: Some([0.02, -0.03, 0.08]),
            from_s: 0.5,
            until_s: Some(1.5),
            ..PayloadSettings::default()
        };
        let scenario = still(&description, gains("gravity_compensation", 500.0, 50.0));
        let mut loaded = scenario.clone();
        loaded.payload = vec![load];
        let mut setup = setup(&description, loaded);
        for at_s in [0.4, 1.0, 3.0] {
            let off = largest(&errors(&setup, &after(&setup, at_s)));
            // Rounding of two computations of the same torque.
            assert!(off < 1e-11, "{name} at {at_s} s: {off:e}");
        }
        // What is carried but not declared is not compensated: the controller does not know the engine's masses.
        let undeclared = std::mem::take(&mut setup.payloads).remove(0);
        let mut world = World::new(&description.robot, &WorldSettings::default()).unwrap();
        let zeros = vec![0.0; description.robot.dof()];
        world.set_state(&setup.start, &zeros).unwrap();
        world.set_carried(&[undeclared.carried]);
        let mut controller = JointController::new(&setup);
        for _ in 0..1000 {
            let setpoint = Setpoint { q: &setup.start, qd: &zeros, qdd: &zeros };
            world.step(&mut controller, &setpoint).unwrap();
        }
        let sag: Vec<f64> = world.q().iter().zip(&setup.start).map(|(q, start)| q - start).collect();
        assert!(largest(&sag) > 1e-3, "{name}: {sag:?}");
    }
}

fn moving(description: &RobotDescription, controller: ControllerSettings, step_s: f64) -> Scenario {
    let to = start(description).into_iter().map(|(joint, q)| (joint, q - 0.4)).collect();
    let motion = JointMotion { move_joints_rad: to, duration_s: Some(1.0), ..JointMotion::default() };
    let simulation = SimulationSettings { duration_s: Some(1.0), step_s, ..SimulationSettings::default() };
    Scenario { motion: vec![MotionSettings::Joints(motion)], simulation, ..still(description, controller) }
}

fn worst_tracking(description: &RobotDescription, scenario: Scenario) -> f64 {
    let setup = setup(description, scenario);
    let mut source = SimulationSource::new(&setup).unwrap();
    let mut worst = 0.0_f64;
    for step in 1..=setup.clock.steps.unwrap() {
        source.advance(setup.clock.time_s(step)).unwrap();
        let joints = source.joints();
        let wanted = joints.setpoint.unwrap().q;
        worst =
            joints.state().q.iter().zip(wanted).map(|(q, wanted)| (q - wanted).abs()).fold(worst, f64::max);
    }
    worst
}

#[test]
fn computed_torque_tracks_to_the_order_of_the_step() {
    for name in ARM {
        let description = robot(name);
        let mut resisted = JointSettings { armature: Some(0.05.into()), ..JointSettings::default() };
        resisted.damping = Some(0.5.into());
        let error = |step_s| {
            let mut scenario = moving(&description, gains("computed_torque", 400.0, 40.0), step_s);
            scenario.joints = resisted.clone();
            worst_tracking(&description, scenario)
        };
        let errors = [1e-3, 5e-4, 2.5e-4].map(error);
        for pair in errors.windows(2) {
            assert!((1.9..2.1).contains(&(pair[0] / pair[1])), "{name}: first order, {errors:?}");
        }
        assert!(errors[0] < 2e-3, "{name}: {errors:?}");
        let pd = worst_tracking(&description, moving(&description, gains("pd", 400.0, 40.0), 1e-3));
        assert!(pd > 10.0 * errors[0], "{name}: a servo without the model is off by {pd:e}");
    }
}

#[test]
fn a_velocity_servo_moves_at_its_setpoint_less_what_gravity_takes() {
    let description = robot("ur5e");
    let mut scenario = still(&description, gains("velocity", 0.0, 1e5));
    scenario.joints.enforce_limits = false;
    let setup = setup(&description, scenario);
    let source = after(&setup, 0.2);
    let (qd, tau) = (source.joints().state().qd, gravity(&description, source.joints().state().q));
    for (qd, tau) in qd.iter().zip(tau) {
        assert!((qd + tau / 1e5).abs() < 1e-6, "{qd} for {tau} N m");
    }
}

#[test]
fn constant_torques_and_those_of_a_file_add_up() {
    let description = robot("ur5e");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("torques.csv");
    std::fs::write(&path, "time_s,elbow_joint\n0,0\n1,20\n").unwrap();
    let mut controller = gains("torque", 0.0, 0.0);
    controller.torque = JointNumbers::from([("wrist_3_joint", 0.25), ("elbow_joint", 1.0)]);
    controller.torque_file = Some(path.display().to_string());
    let mut scenario = still(&description, controller);
    scenario.joints.enforce_limits = false;
    let setup = setup(&description, scenario);
    let source = after(&setup, 0.1);
    // The last step began at 0.099 s.
    let expected = [0.0, 0.0, 1.0 + 20.0 * 0.099, 0.0, 0.0, 0.25];
    for (found, expected) in source.joints().state().effort.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
    }
}

/// Largest position error in the last second of four, after a move of one second.
fn late_error(description: &RobotDescription, delay_s: Option<f64>) -> f64 {
    let mut controller = gains("computed_torque", 900.0, 60.0);
    (controller.rate_hz, controller.delay_s) = (Some(1000.0), delay_s);
    let mut scenario = moving(description, controller, 1e-3);
    scenario.joints.enforce_limits = false;
    let mut setup = setup(description, scenario);
    // A plan beyond the limits is refused: the limits fall to a tenth after it is made.
    setup.description.robot = setup.description.robot.with_joints(|joint| {
        if let Some(limit) = &mut joint.limit {
            limit.velocity = limit.velocity.map(|velocity| 0.1 * velocity);
        }
    });
    let mut source = SimulationSource::new(&setup).unwrap();
    let mut worst = 0.0_f64;
    for step in 1..=4000 {
        if source.advance(setup.clock.time_s(step)).is_err() {
            return f64::INFINITY;
        }
        let joints = source.joints();
        if step > 3000 {
            let wanted = joints.setpoint.unwrap().q;
            let off: Vec<f64> = joints.state().q.iter().zip(wanted).map(|(q, wanted)| q - wanted).collect();
            worst = worst.max(largest(&off));
        }
    }
    worst
}

/// Of `e'' + 60 e'(t - T) + 900 e(t - T) = 0` the phase margin of `L = (60 s + 900) / s^2` is used up at
/// `T = atan(60 w / 900) / w`, `w = 61.7 rad/s` where `|L| = 1`: 21.6 ms.
#[test]
fn a_delay_destabilises_where_the_phase_margin_ends() {
    let description = robot("ur5e");
    let [stable, unstable] = [0.017, 0.026].map(|delay_s| late_error(&description, Some(delay_s)));
    assert!(stable < 1e-4 && late_error(&description, None) < 1e-9, "{stable:e}");
    assert!(unstable > 0.05, "{unstable:e}");
}

#[test]
fn a_reading_is_off_by_at_most_half_a_count() {
    let description = robot("panda");
    let resolution_rad = std::f64::consts::TAU / 4096.0;
    let mut scenario = moving(&description, gains("gravity_compensation", 600.0, 60.0), 1e-3);
    scenario.sensors = SensorSettings {
        counts_per_turn: Some(4096.0.into()),
        resolution_mm: Some(0.5.into()),
        velocity: VelocitySensor::Differentiated,
        ..SensorSettings::default()
    };
    let setup = setup(&description, scenario);
    let mut source = SimulationSource::new(&setup).unwrap();
    let (mut worst, mut before) = (0.0_f64, source.joints().measured.q.to_vec());
    for step in 1..=setup.clock.steps.unwrap() {
        source.advance(setup.clock.time_s(step)).unwrap();
        let joints = source.joints();
        for (joint, before) in before.iter().enumerate().take(7) {
            let measured = joints.measured.q[joint];
            worst = worst.max((measured - joints.state().q[joint]).abs());
            assert!((measured / resolution_rad - (measured / resolution_rad).round()).abs() < 1e-9);
            assert!((joints.measured.qd[joint] - (measured - before) / 1e-3).abs() < 1e-9);
        }
        before.copy_from_slice(joints.measured.q);
    }
    assert!(worst <= resolution_rad / 2.0 * (1.0 + 1e-12) && worst > 0.49 * resolution_rad, "{worst:e}");
}

#[test]
fn noise_has_its_standard_deviation_and_follows_from_the_seed() {
    let description = robot("ur5e");
    let readings = |seed| {
        let mut scenario = still(&description, gains("kinematic", 0.0, 0.0));
        scenario.seed = seed;
        scenario.sensors.noise_deg = Some(JointNumbers::from([("elbow_joint", 0.1)]));
        let setup = setup(&description, scenario);
        let mut source = SimulationSource::new(&setup).unwrap();
        let reading = |step| {
            source.advance(setup.clock.time_s(step)).unwrap();
            let joints = source.joints();
            assert_eq!(
                joints.measured.q[0].to_bits(),
                joints.state().q[0].to_bits(),
                "only the elbow is noisy"
            );
            joints.measured.q[2] - joints.state().q[2]
        };
        (1..=4000).map(reading).collect::<Vec<f64>>()
    };
    let first = readings(1);
    assert_eq!(first, readings(1));
    assert_ne!(first, readings(2));
    let deviation = (first.iter().map(|e| e * e).sum::<f64>() / 4000.0).sqrt();
    // Five standard errors of 4000 values: 5 / sqrt(8000).
    assert!((deviation / 0.1_f64.to_radians() - 1.0).abs() < 0.056, "{deviation}");
}

#[test]
fn actuators_keep_their_limits_and_the_source_says_how_long() {
    for name in ARM {
        let description = robot(name);
        let mut scenario = moving(&description, gains("gravity_compensation", 3e4, 300.0), 1e-3);
        let limited = worst_speed(&description, scenario.clone());
        scenario.joints.enforce_limits = false;
        let unlimited = worst_speed(&description, scenario);
        // What the other joints do to a joint may take it beyond; its own actuator does not.
        assert!(
            limited < 0.6 * unlimited && unlimited > 2.0,
            "{name}: {limited} and {unlimited} of the limit"
        );
    }
}

/// Largest speed as a part of the joint's limit; with limits, that saturation is reported.
fn worst_speed(description: &RobotDescription, scenario: Scenario) -> f64 {
    let enforce_limits = scenario.joints.enforce_limits;
    let mut setup = setup(description, scenario);
    // A plan beyond the limits is refused: the limits fall to a tenth after it is made.
    setup.description.robot = setup.description.robot.with_joints(|joint| {
        if let Some(limit) = &mut joint.limit {
            limit.velocity = limit.velocity.map(|velocity| 0.1 * velocity);
        }
    });
    let mut source = SimulationSource::new(&setup).unwrap();
    let mut worst = 0.0_f64;
    for step in 1..=500 {
        source.advance(setup.clock.time_s(step)).unwrap();
        let truth = source.joints().state();
        for (row, &joint) in setup.description.robot.movable_joints().iter().take(6).enumerate() {
            let limit = setup.description.robot.joint(joint).limit.unwrap();
            let speed = truth.qd[row].abs() / limit.velocity.unwrap();
            worst = worst.max(speed);
            let is_pushed = speed > 1.001 * (1.0 + 1e-9) && truth.effort[row] * truth.qd[row] > 0.0;
            assert!(!(enforce_limits && is_pushed), "{row} at {speed} of the limit");
            let effort = limit.effort.unwrap() * (1.0 + 1e-12);
            assert!(!enforce_limits || truth.effort[row].abs() <= effort, "{row}: {}", truth.effort[row]);
        }
    }
    let uses = source.simulated().unwrap().actuators();
    let is_saturated = uses.iter().any(|joint| joint.at_velocity_limit > 0.0);
    assert_eq!(is_saturated, enforce_limits, "{uses:?}");
    worst
}
