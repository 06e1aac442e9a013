//! Motions that are refused, with what would do.

use super::*;

#[test]
fn a_path_beyond_reach_says_where() {
    let from = start();
    let away = from + Vector3::new(0.9, 0.0, 0.0);
    refused(
        vec![line(away.into(), 0.1, 0.0)],
        "scenario::path_reach",
        &["out of reach", "along the path of 900 mm", "smallest error"],
    );
}

#[test]
fn paths_that_cannot_be_driven_are_refused() {
    let from = start();
    let at = |x: f64| (from + Vector3::new(x, 0.0, 0.0)).into();
    refused(vec![line(at(0.05), 0.1, 0.01)], "scenario::path", &["no line or arc follows"]);
    refused(
        vec![line(at(0.05), 0.1, 0.03), line(at(0.1), 0.1, 0.0)],
        "scenario::path",
        &["30 mm does not fit", "25 mm"],
    );
    refused(vec![line(at(0.0), 0.1, 0.0)], "scenario::path", &["ends where it starts"]);
    let timeless = LineMotion { line_tcp: pose(at(0.1)), ..LineMotion::default() };
    refused(vec![MotionSettings::Line(timeless)], "scenario::path_speed", &["speed_m_s", "duration_s"]);
    let arc_tcp = Box::new(ArcSettings { via: pose(at(0.1)), to: pose(at(0.2)) });
    let arc = ArcMotion { arc_tcp, speed_m_s: Some(0.1), ..ArcMotion::default() };
    refused(vec![MotionSettings::Arc(arc)], "scenario::arc", &["straight line"]);
}

/// What would have no effect is refused.
#[test]
fn keys_of_a_speed_and_keys_of_a_duration_exclude_each_other() {
    let to = || pose((start() + Vector3::new(0.05, 0.0, 0.0)).into());
    let line = |speed_m_s: Option<f64>| LineMotion {
        line_tcp: to(),
        speed_m_s,
        duration_s: if speed_m_s.is_none() { Some(1.0) } else { None },
        ..LineMotion::default()
    };
    let profiled = LineMotion { profile: Some(Profile::Quintic), ..line(Some(0.1)) };
    let accelerated = LineMotion { acceleration_m_s2: Some(0.1), ..line(None) };
    let jerked = LineMotion { jerk_m_s3: Some(0.1), ..line(None) };
    let refusals = [
        (profiled, "`profile` needs `duration_s`"),
        (accelerated, "`acceleration_m_s2` needs `speed_m_s`"),
        (jerked, "`jerk_m_s3` needs `speed_m_s`"),
    ];
    for (line, words) in refusals {
        refused(vec![MotionSettings::Line(line)], "scenario::path_speed", &[words, "remove"]);
    }
    // The resolved scenario says only what has an effect, and can be run again.
    let written = planned(vec![MotionSettings::Line(line(None))]);
    let MotionSettings::Line(resolved) = &written.scenario.motion[0] else { panic!("{written:#?}") };
    assert_eq!((resolved.profile, resolved.acceleration_m_s2), (Some(Profile::Quintic), None));
    let written = planned(vec![MotionSettings::Line(line(Some(0.1)))]);
    let MotionSettings::Line(resolved) = &written.scenario.motion[0] else { panic!("{written:#?}") };
    assert_eq!((resolved.profile, resolved.acceleration_m_s2), (None, Some(1.2)));
    RunSetup::new(written.scenario, ur5e()).unwrap();
}

/// A rotation alone does not mean the origin of the world.
#[test]
fn a_target_without_a_position_is_refused() {
    let at = |x: f64| (start() + Vector3::new(x, 0.0, 0.0)).into();
    let turned = || PoseSettings { rpy_deg: Some([180.0, 0.0, 30.0]), ..PoseSettings::default() };
    let arc = |via: PoseSettings, to: PoseSettings| {
        let arc_tcp = Box::new(ArcSettings { via, to });
        MotionSettings::Arc(ArcMotion { arc_tcp, speed_m_s: Some(0.1), ..ArcMotion::default() })
    };
    let targets = [
        MotionSettings::Line(LineMotion {
            line_tcp: turned(),
            duration_s: Some(1.0),
            ..LineMotion::default()
        }),
        MotionSettings::Tcp(TcpMotion {
            move_tcp: turned(),
            duration_s: Some(1.0),
            profile: Profile::Quintic,
        }),
        MotionSettings::Servo(ServoMotion {
            servo_tcp: turned(),
            method: ServoMethod::PseudoInverse,
            gain_per_s: None,
            duration_s: 1.0,
        }),
        MotionSettings::TcpPath(TcpPathMotion {
            path_tcp: vec![turned()],
            speed_m_s: 0.1,
            ..TcpPathMotion::default()
        }),
        arc(pose(at(0.1)), turned()),
        arc(PoseSettings::default(), pose(at(0.1))),
    ];
    for target in targets {
        refused(vec![target], "scenario::target_position", &["`xyz_m` (or `xyz_mm`) is missing"]);
    }
}

#[test]
fn a_limit_in_two_units_is_refused() {
    let every = |value: f64| BTreeMap::from([("*".to_owned(), value)]);
    let elbow = |value: f64| BTreeMap::from([("elbow_joint".to_owned(), value)]);
    let motion =
        || vec![MotionSettings::Joints(JointMotion { duration_s: Some(1.0), ..JointMotion::default() })];
    let twice = [
        LimitSettings { velocity_deg_s: elbow(60.0), velocity_rad_s: elbow(1.0), ..LimitSettings::default() },
        LimitSettings {
            acceleration_deg_s2: every(60.0),
            acceleration_rad_s2: every(1.0),
            ..LimitSettings::default()
        },
    ];
    let said = twice.map(|limits| setup(motion(), limits).map(|_| ()).unwrap_err());
    for found in &said {
        assert_eq!((found.len(), found[0].code.name), (1, "scenario::limit_twice"), "{found:#?}");
    }
    assert_eq!(said[0][0].message, "the limit of \"elbow_joint\" is given twice, first by velocity_deg_s");
    // A named joint and all others, each in its own unit, are two different limits.
    let both =
        LimitSettings { velocity_deg_s: every(60.0), velocity_rad_s: elbow(1.0), ..LimitSettings::default() };
    let elbow_rad_s = setup(motion(), both).unwrap().trajectory.limits.velocity[2];
    assert!((elbow_rad_s - 1.0).abs() < 1e-12, "{elbow_rad_s}");
}
