//! Single faults, and runs without one, in conditions that are hard for the diagnosis.

use super::*;

#[test]
fn actuators_at_their_limit_are_no_fault() {
    let (mut draw, mut saturated) = (Draw(ChaCha8Rng::seed_from_u64(6)), 0);
    for (path, mass_kg) in [(UR5E, 15.0), (UR5E, 40.0), (PANDA, 12.0), (PANDA, 40.0)] {
        let description = load_robot(Path::new(path)).unwrap();
        for encoders in [Encoders::Exact, Encoders::Noisy] {
            let mut scenario = scenario(None, &description, &mut draw);
            scenario.sensors = encoders.settings();
            scenario.payload =
                vec![PayloadSettings { name: "load".to_owned(), mass_kg, ..PayloadSettings::default() }];
            let setup = RunSetup::new(scenario, description.clone()).unwrap();
            let mut run = Run::new(&setup).unwrap();
            let (outcome, result) = run.finish(&mut setup.checks(), &mut NoRecorder, |_| ());
            result.unwrap();
            saturated += usize::from(outcome.actuators.iter().any(|joint| joint.at_effort_limit > 0.1));
            assert_eq!(diagnose_run(&mut run, &outcome), None, "{path} {encoders:?}, {mass_kg} kg");
        }
    }
    assert!(saturated >= 4, "{saturated} of 8");
}

/// What is found of these faults in a run of the sweep with `change`.
fn found(
    faults: Vec<FaultSettings>,
    seed: u64,
    change: impl Fn(&mut Scenario),
) -> (FaultVerdict, Vec<String>) {
    let description = load_robot(Path::new(UR5E)).unwrap();
    let mut draw = Draw(ChaCha8Rng::seed_from_u64(seed));
    let mut scenario = scenario(None, &description, &mut draw);
    scenario.fault = faults;
    change(&mut scenario);
    let (injected, found) = run(scenario, &description);
    let faults: Vec<RunFault> = found.iter().flat_map(RunDiagnosis::run_faults).collect();
    (judge(&injected, &faults), found.map(|found| found.sentences()).unwrap_or_default())
}

fn scaled_torque() -> FaultSettings {
    let joint = "shoulder_lift_joint".to_owned();
    FaultSettings::ScaledTorque(ScaledTorqueFault { joint, share: 0.7, at_s: 0.5, until_s: None })
}

#[test]
fn an_encoder_that_is_off_does_not_hide_a_fault_of_an_effort() {
    let joint = || "shoulder_lift_joint".to_owned();
    let offset = EncoderOffsetFault { joint: joint(), value_deg: Some(1.0), at_s: 0.3, ..Default::default() };
    let drift =
        EncoderDriftFault { joint: joint(), rate_deg_per_s: Some(1.0), at_s: 0.3, ..Default::default() };
    let dropped = DroppedSamplesFault { share: 0.3, at_s: 0.3, until_s: None };
    let encoders = [
        FaultSettings::EncoderOffset(offset),
        FaultSettings::EncoderDrift(drift),
        FaultSettings::DroppedSamples(dropped),
    ];
    for (seed, fault) in (20..).zip(encoders) {
        for encoders in [Encoders::Exact, Encoders::Noisy] {
            let (judgement, said) = found(vec![fault.clone(), scaled_torque()], seed, |scenario| {
                scenario.sensors = encoders.settings();
            });
            assert_eq!(judgement, FaultVerdict::Right, "{encoders:?}: {said:?}");
        }
    }
}

#[test]
fn an_obstacle_that_comes_late_does_not_hide_what_was_before() {
    let pose = |at_s, z| PathPoseSettings { at_s, xyz_m: Some([0.0, 0.0, z]), ..Default::default() };
    let (judgement, said) = found(vec![scaled_torque()], 30, |scenario| {
        // At the end of the run it is in the shoulder, from below.
        let path = vec![pose(0.0, -0.4), pose(2.0, -0.4), pose(2.4, 0.05)];
        let name = "late".to_owned();
        let late = ObstacleSettings { name, sphere_radius_m: Some(0.05), path, ..Default::default() };
        scenario.obstacle = vec![late];
    });
    assert_eq!(judgement, FaultVerdict::Right, "{said:?}");
}

#[test]
fn declared_friction_is_no_fault() {
    let controllers = [("passive", 5.0), ("torque", 4.0), ("pd", 3.0), ("gravity_compensation", 8.0)];
    for (seed, (kind, friction)) in (40..).zip(controllers) {
        for stiffness in [100.0, 400.0] {
            let (_, said) = found(Vec::new(), seed, |scenario| {
                scenario.joints.friction = Some(friction.into());
                scenario.controller = ControllerSettings {
                    kind: ControllerKind::find(kind).expect("a kind"),
                    ..Default::default()
                };
                match kind {
                    "passive" => {}
                    "torque" => scenario.controller.torque = 3.0.into(),
                    _ => {
                        scenario.controller.stiffness = stiffness.into();
                        scenario.controller.damping = (0.06 * stiffness).into();
                    }
                }
            });
            assert!(said.is_empty(), "{kind}, {stiffness}: {said:?}");
        }
    }
}

#[test]
fn a_payload_is_found_although_joints_have_friction() {
    let mut right = 0;
    for seed in 50..56 {
        let com_m = Some([0.02, -0.03, 0.1]);
        let payload = WrongPayloadFault { mass_kg: 2.0, com_m, at_s: 0.4, until_s: None };
        let (judgement, said) = found(vec![FaultSettings::WrongPayload(payload)], seed, |scenario| {
            scenario.joints.friction = Some(2.0.into());
        });
        assert_ne!(judgement, FaultVerdict::Wrong, "{said:?}");
        right += usize::from(judgement == FaultVerdict::Right);
        show(&format!("{judgement:?} {said:?}"));
    }
    assert!(right >= 5, "{right} of 6");
}

#[test]
fn axes_that_are_flipped_or_exchanged_for_a_while_are_found() {
    let name = |at: usize| ["shoulder_lift_joint", "elbow_joint", "wrist_1_joint"][at % 3].to_owned();
    for ((seed, index), (at_s, lasts_s)) in
        (60..).zip(0..).zip([(0.0, 0.8), (0.3, 0.1), (0.2, 1.1), (0.6, 0.9), (1.1, 0.05)])
    {
        let until_s = Some(at_s + lasts_s);
        let flipped = FaultSettings::FlippedAxis(JointFault { joint: name(index), at_s, until_s });
        let joints = [name(index), name(index + 1)];
        let swapped = FaultSettings::SwappedJoints(SwappedJointsFault { joints, at_s, until_s });
        for fault in [flipped, swapped] {
            let (judgement, said) = found(vec![fault.clone()], seed, |_| ());
            assert_eq!(judgement, FaultVerdict::Right, "{fault:?}: {said:?}");
        }
    }
}

#[test]
fn a_tool_that_is_turned_by_half_a_turn_is_found() {
    for rpy_deg in [[0.0, 0.0, 180.0], [180.0, 0.0, 0.0], [0.0, 0.0, 90.0], [0.0, 90.0, 0.0]] {
        let xyz_mm = Some([5.0, 0.0, 0.0]);
        let tool = ShiftedToolFault { xyz_mm, rpy_deg: Some(rpy_deg), at_s: 0.5, ..Default::default() };
        let (judgement, said) = found(vec![FaultSettings::ShiftedTool(tool)], 70, |_| ());
        assert_eq!(judgement, FaultVerdict::Right, "{rpy_deg:?}: {said:?}");
    }
}

#[test]
fn a_torque_that_is_scaled_to_the_end_of_the_run_has_no_end() {
    let description = load_robot(Path::new(UR5E)).unwrap();
    let joints = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint"];
    for (seed, joint) in (80..).zip(joints) {
        for until_s in [None, Some(1.2)] {
            let fault = ScaledTorqueFault { joint: joint.to_owned(), share: 0.7, at_s: 0.3, until_s };
            let mut draw = Draw(ChaCha8Rng::seed_from_u64(seed));
            let scenario = scenario(Some(FaultSettings::ScaledTorque(fault)), &description, &mut draw);
            let (injected, found) = run(scenario, &description);
            let faults: Vec<RunFault> = found.iter().flat_map(RunDiagnosis::run_faults).collect();
            assert_eq!(judge(&injected, &faults), FaultVerdict::Right, "{joint}: {faults:?}");
            // A joint whose torque is hardly asked for afterwards does not show the end.
            if until_s.is_none() || joint != "shoulder_pan_joint" {
                assert_eq!(faults[0].until_s.is_some(), until_s.is_some(), "{joint}: {faults:?}");
            }
        }
    }
}

/// A telescope: stage 2 follows stage 1 with half of its travel, and carries a wrist.
const TELESCOPE: &str = r#"<robot name="telescope">
  <link name="base"/>
  <link name="boom"><inertial><origin xyz="0.2 0 0"/><mass value="4"/>
    <inertia ixx="0.01" iyy="0.08" izz="0.08" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="stage1"><inertial><origin xyz="0.1 0 0"/><mass value="3"/>
    <inertia ixx="0.01" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="stage2"><inertial><origin xyz="0.1 0 0"/><mass value="2"/>
    <inertia ixx="0.01" iyy="0.03" izz="0.03" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="wrist"><inertial><origin xyz="0.05 0 0.02"/><mass value="1"/>
    <inertia ixx="0.002" iyy="0.003" izz="0.003" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="tilt" type="revolute"><parent link="base"/><child link="boom"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5" effort="300" velocity="3"/><dynamics damping="0.5"/></joint>
  <joint name="reach" type="prismatic"><parent link="boom"/><child link="stage1"/><origin xyz="0.3 0 0"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.5" effort="400" velocity="1"/><dynamics damping="5"/></joint>
  <joint name="reach2" type="prismatic"><parent link="stage1"/><child link="stage2"/><origin xyz="0.2 0 0"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.25" effort="400" velocity="1"/><mimic joint="reach" multiplier="0.5"/></joint>
  <joint name="spin" type="revolute"><parent link="stage2"/><child link="wrist"/><origin xyz="0.2 0 0"/><axis xyz="1 0 0"/>
    <limit lower="-2" upper="2" effort="20" velocity="3"/></joint>
</robot>"#;

#[test]
fn faults_of_a_joint_that_another_follows_are_found() {
    let source = SourceFile { path: "telescope.urdf".into(), text: TELESCOPE.to_owned(), is_foreign: false };
    let description = parse_robot(None, &source.into()).unwrap();
    let motion = |tilt: f64, reach: f64| {
        MotionSettings::Joints(JointMotion {
            move_joints_rad: [("tilt", tilt), ("spin", tilt)].map(|(name, q)| (name.to_owned(), q)).into(),
            move_joints_m: [("reach".to_owned(), reach)].into(),
            duration_s: Some(1.0),
            profile: Profile::Quintic,
            ..JointMotion::default()
        })
    };
    let diagnosed = |fault: Option<FaultSettings>| {
        let mut scenario = scenario(None, &description, &mut Draw(ChaCha8Rng::seed_from_u64(1)));
        scenario.start = StartSettings::default();
        scenario.start.joints_m = [("reach".to_owned(), 0.1)].into();
        scenario.start.joints_rad = [("tilt".to_owned(), -0.4)].into();
        scenario.motion = vec![motion(0.3, 0.4), motion(-0.4, 0.15)];
        scenario.fault = fault.into_iter().collect();
        let (injected, found) = run(scenario, &description);
        let faults: Vec<RunFault> = found.iter().flat_map(RunDiagnosis::run_faults).collect();
        (judge(&injected, &faults), found.map(|found| found.sentences()).unwrap_or_default())
    };
    let joint = || "reach".to_owned();
    let (at_s, until_s) = (0.3, None);
    let plain = || JointFault { joint: joint(), at_s, until_s };
    let load = WrongPayloadFault { mass_kg: 0.8, com_m: Some([0.05, 0.02, 0.0]), at_s, until_s };
    for fault in [
        None,
        Some(FaultSettings::ScaledTorque(ScaledTorqueFault { joint: joint(), share: 0.7, at_s, until_s })),
        Some(FaultSettings::ScaledTorque(ScaledTorqueFault { joint: joint(), share: 1.3, at_s, until_s })),
        Some(FaultSettings::LostTorque(plain())),
        Some(FaultSettings::StuckJoint(plain())),
        Some(FaultSettings::AddedFriction(AddedFrictionFault {
            joint: joint(),
            dry_n: Some(12.0),
            at_s,
            ..Default::default()
        })),
        Some(FaultSettings::WrongPayload(load)),
    ] {
        let (judgement, said) = diagnosed(fault.clone());
        assert_eq!(judgement, FaultVerdict::Right, "{fault:?}: {said:?}");
    }
}

/// Six joints read late, and one of them drifts: neither hides the other.
#[test]
fn a_latency_and_a_fault_of_an_encoder_are_found_together() {
    for (seed, (joint, rate, time_s)) in (80..).zip([
        ("wrist_3_joint", 0.4, 0.003),
        ("shoulder_pan_joint", -1.0, 0.008),
        ("elbow_joint", 0.2, 0.002),
        // A drift that is far larger than what the latency changes.
        ("shoulder_lift_joint", 3.0, 0.02),
    ]) {
        let drift = EncoderDriftFault {
            joint: joint.to_owned(),
            rate_deg_per_s: Some(rate),
            at_s: 0.3,
            ..Default::default()
        };
        let latency = LatencyFault { time_s, at_s: 0.6, until_s: None };
        let faults = vec![FaultSettings::EncoderDrift(drift), FaultSettings::Latency(latency)];
        let (judgement, said) = found(faults, seed, |scenario| {
            scenario.controller.kind = ControllerKind::ComputedTorque;
            (scenario.controller.stiffness, scenario.controller.damping) = (400.0.into(), 40.0.into());
        });
        assert_eq!((judgement, said.len()), (FaultVerdict::Right, 2), "{said:?}");
    }
}

/// Joints that settle move by less than what shows a loss: their lost readings are no faults of encoders.
#[test]
fn lost_readings_are_the_only_fault_while_joints_settle() {
    for (seed, share) in (100..).zip([0.05, 0.2, 0.5, 0.8]) {
        let dropped = DroppedSamplesFault { share, at_s: 0.5, until_s: None };
        let (judgement, said) = found(vec![FaultSettings::DroppedSamples(dropped)], seed, |scenario| {
            scenario.controller.kind = ControllerKind::ComputedTorque;
            (scenario.controller.stiffness, scenario.controller.damping) = (400.0.into(), 40.0.into());
            scenario.simulation.duration_s = Some(4.0);
        });
        assert_eq!((judgement, said.len()), (FaultVerdict::Right, 1), "{share}: {said:?}");
    }
}

/// Joints that dry friction holds at the end show no load: it has no end for that.
#[test]
fn a_payload_that_stays_has_no_end_although_friction_holds_the_joints() {
    for seed in 90..96 {
        let com_m = Some([0.03, -0.02, 0.06]);
        let payload = WrongPayloadFault { mass_kg: 1.3, com_m, at_s: 0.4, until_s: None };
        let (_, said) = found(vec![FaultSettings::WrongPayload(payload)], seed, |scenario| {
            scenario.joints.friction = Some(6.0.into());
            scenario.simulation.duration_s = Some(4.0);
        });
        assert!(
            said.iter().any(|said| said.contains("undeclared mass") && said.ends_with(" on")),
            "{said:?}"
        );
    }
}

/// A load on the tool shows at every joint, and each joint has a part of it that looks like a share of its effort: with a fault
/// of one joint beside it, both are found.
#[test]
fn a_payload_and_a_fault_of_one_joint_are_found_together() {
    let joint = || "elbow_joint".to_owned();
    let (at_s, until_s) = (0.8, None);
    let friction = |dry: f64, viscous: f64| {
        let (dry_n_m, viscous_n_m_s_per_rad) = (Some(dry), Some(viscous));
        let fault =
            AddedFrictionFault { joint: joint(), dry_n_m, viscous_n_m_s_per_rad, at_s, ..Default::default() };
        FaultSettings::AddedFriction(fault)
    };
    let faults = [
        friction(5.0, 3.0),
        friction(1.0, 1.0),
        FaultSettings::ScaledTorque(ScaledTorqueFault { joint: joint(), share: 0.8, at_s, until_s }),
        FaultSettings::StuckJoint(JointFault { joint: joint(), at_s, until_s }),
    ];
    for (seed, fault) in (110..).zip(faults) {
        let com_m = Some([0.02, 0.0, 0.06]);
        let load = WrongPayloadFault { mass_kg: 2.0, com_m, at_s: 0.4, until_s };
        let (judgement, said) = found(vec![FaultSettings::WrongPayload(load), fault.clone()], seed, |_| ());
        assert_eq!((judgement, said.len()), (FaultVerdict::Right, 2), "{fault:?}: {said:?}");
    }
}

#[test]
fn a_small_part_of_the_effort_is_missing_from_its_beginning_on() {
    for seed in 60..66 {
        let joint = "shoulder_lift_joint".to_owned();
        let small = ScaledTorqueFault { joint, share: 0.95, at_s: 0.3, until_s: Some(1.1) };
        let (judgement, said) = found(vec![FaultSettings::ScaledTorque(small)], seed, |_| ());
        assert_eq!(judgement, FaultVerdict::Right, "{said:?}");
        assert!(said[0].ends_with("from 0.3 s to 1.1 s"), "{said:?}");
    }
}

#[test]
fn two_faults_of_one_joint_are_said_to_be_possible() {
    let joint = "shoulder_lift_joint".to_owned();
    let friction = AddedFrictionFault { joint, dry_n_m: Some(30.0), at_s: 0.2, ..Default::default() };
    let (_, said) = found(vec![FaultSettings::AddedFriction(friction), scaled_torque()], 70, |_| ());
    // Commanded and delivered effort show the share, and the motion that there is more.
    let [share, rest] = &said[..] else { panic!("{said:?}") };
    assert!(share.contains("the actuator exerts 70 % of the commanded effort from 0.5 s on"), "{share}");
    assert!(rest.starts_with("joint shoulder_lift_joint: from 0.2"), "{rest}");
    assert!(rest.ends_with("there may be several at this joint"), "{rest}");
}
