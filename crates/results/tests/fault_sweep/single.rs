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
