//! Paths of many points, playback, and motions after a servo.

use std::collections::BTreeMap;

use congruent_motion::ReferenceGenerator;
use congruent_scenario::{
    Between, JointPathMotion, LimitSettings, LineMotion, MotionSettings, OverLimit, PlaybackMotion, Profile,
    ServoMethod, ServoMotion,
};
use nalgebra::Vector3;

use super::{assert_derivatives, instants, move_to, planned, pose, refused, setup, start, tcp};

fn joint_path(points: &[f64]) -> JointPathMotion {
    let point = |deg: &f64| BTreeMap::from([("shoulder_pan_joint".to_owned(), *deg)]);
    JointPathMotion { path_joints_deg: points.iter().map(point).collect(), ..JointPathMotion::default() }
}

#[test]
fn a_joint_path_goes_through_its_points_at_its_times() {
    let path = JointPathMotion { at_s: vec![0.5, 1.0, 2.5], ..joint_path(&[20.0, -10.0, 60.0]) };
    let found = instants(&planned(vec![MotionSettings::JointPath(path)]));
    for (at, deg) in [(0, 0.0), (500, 20.0), (1000, -10.0), (2500, 60.0)] {
        assert!((found[at].q[0].to_degrees() - deg).abs() < 1e-9, "{}", found[at].q[0].to_degrees());
    }
    assert!(found[500].qd[0].abs() > 0.01, "it does not stop at its points");
    assert!(found[1].qdd[0].abs() < 0.2 && found[2500].qd[0].abs() < 1e-9);
    assert_derivatives(&found, 0.2);
    let path = JointPathMotion { at_s: vec![0.5, 0.5], ..joint_path(&[20.0, -10.0]) };
    refused(
        vec![MotionSettings::JointPath(path)],
        "scenario::path_times",
        &["time 2", "later than the one before"],
    );
    let path = JointPathMotion { at_s: vec![0.5], ..joint_path(&[20.0, -10.0]) };
    refused(vec![MotionSettings::JointPath(path)], "scenario::path_times", &["1 times for 2 points"]);
}

#[test]
fn a_joint_path_without_times_takes_its_least_time() {
    let found = instants(&planned(vec![MotionSettings::JointPath(joint_path(&[20.0, -10.0, 60.0]))]));
    // The UR5e's 180 deg/s in 0.25 s, and that in 0.1 s.
    let (velocity, acceleration, jerk) = (180.0, 720.0, 7200.0);
    let mut peaks = [0.0_f64; 3];
    for pair in found.windows(2) {
        let third = (pair[1].qdd[0] - pair[0].qdd[0]) * 1e3;
        let shares = [pair[1].qd[0] / velocity, pair[1].qdd[0] / acceleration, third / jerk];
        for (peak, share) in peaks.iter_mut().zip(shares) {
            *peak = peak.max(share.to_degrees().abs());
        }
    }
    assert!(peaks.iter().all(|peak| *peak < 1.0 + 1e-6), "{peaks:?}");
    assert!(peaks.iter().any(|peak| *peak > 0.98), "{peaks:?}");
}

fn playback(text: &str, between: Between) -> (tempfile::TempDir, Vec<MotionSettings>) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("moves.csv");
    std::fs::write(&file, text).unwrap();
    let play_csv = file.display().to_string();
    (folder, vec![MotionSettings::Playback(PlaybackMotion { play_csv, between })])
}

#[test]
fn a_table_is_played_back() {
    let head = "# from a log\ntime_s,elbow_joint_deg,shoulder_pan_joint.q_rad,shoulder_pan_joint.qd_rad_s\n";
    let wave = |time_s: f64| (90.0 + 20.0 * (1.0 - (2.0 * time_s).cos()), 0.3 * time_s.sin().powi(2));
    let row = |step| {
        let time_s = f64::from(step) * 0.05;
        let (elbow_deg, pan) = wave(time_s);
        format!("{},{elbow_deg},{pan},7\n", time_s + 5.0)
    };
    let rows: Vec<String> = (0..=40).map(row).collect();
    let text = format!("{head}{}", rows.concat());
    let (_folder, motion) = playback(&text, Between::Spline);
    let found = instants(&planned(motion));
    for now in &found {
        let (elbow_deg, pan) = wave(now.time_s);
        // A cubic spline: 5/384 h^4 times the fourth derivative of 320 deg/s^4. Near the ends the slope of the parabola
        // counts: 4/81 h^3 times the third derivative of 160 deg/s^3.
        let is_near_end = !(0.5..1.5).contains(&now.time_s);
        let most_deg = if is_near_end { 1.2e-3 } else { 4e-5 };
        let off_deg = (now.q[2].to_degrees() - elbow_deg).abs();
        assert!(off_deg < most_deg, "{off_deg} at {}", now.time_s);
        assert!((now.q[0] - pan).abs() < 2e-5);
    }
    let (_folder, motion) = playback(&text, Between::Linear);
    let found = instants(&planned(motion));
    let between = f64::midpoint(wave(0.5).0, wave(0.55).0);
    assert!((found[525].q[2].to_degrees() - between).abs() < 1e-9);
}

#[test]
fn tables_that_cannot_be_played_are_refused_with_their_line() {
    let head = "time_s,elbow_joint_deg\n0,90\n";
    for (text, code, words) in [
        ("elbow_joint_deg\n90\n".to_owned(), "scenario::playback", vec!["no column time_s"]),
        ("time_s,elbow\n0,90\n".to_owned(), "scenario::playback", vec!["column \"elbow\"", "elbow_joint"]),
        ("time_s,elbow_joint_m\n0,90\n".to_owned(), "scenario::playback", vec!["_deg or _rad"]),
        (format!("{head}1,x\n"), "scenario::playback", vec!["line 3", "\"x\" is not a finite number"]),
        (format!("{head}1,91\n1,92\n"), "scenario::playback", vec!["line 4", "not after 1 s"]),
        (format!("{head}1,91,5\n"), "scenario::playback", vec!["line 3", "3 cells, the header has 2"]),
        (
            format!("{head}0.01,100\n"),
            "scenario::playback_jump",
            vec!["line 3", "elbow_joint", "10 deg in 0.01 s", "1000 deg/s", "180 deg/s"],
        ),
        (
            format!("{head}5,400\n"),
            "scenario::playback_range",
            vec!["line 3", "elbow_joint", "400 deg", "outside its range"],
        ),
        (
            "time_s,elbow_joint_deg\n0,80\n1,81\n".to_owned(),
            "scenario::playback_start",
            vec!["80 deg", "90 deg"],
        ),
        (head.to_owned(), "scenario::playback", vec!["fewer than two rows"]),
    ] {
        let (_folder, motion) = playback(&text, Between::Spline);
        refused(motion, code, &words);
    }
}

/// From row to row the joint goes at 156 deg/s, in between the spline is faster than the limit of 180 deg/s.
#[test]
fn a_spline_that_is_faster_than_the_limits_between_its_rows_is_refused_slowed_or_warned_of() {
    let text = "time_s,elbow_joint_deg\n0,90\n0.25,91\n0.5,130\n0.75,91\n1,90\n";
    let (_folder, motion) = playback(text, Between::Spline);
    refused(motion.clone(), "scenario::over_limit", &["between lines 3 and 4", "column \"elbow_joint_deg\""]);
    let over = |over_limit| LimitSettings { over_limit, ..LimitSettings::default() };
    let slowed = setup(motion.clone(), over(OverLimit::Slow)).unwrap();
    let found = instants(&slowed);
    let largest = found.iter().fold(0.0_f64, |largest, now| largest.max(now.qd[2].abs())).to_degrees();
    assert!(largest > 178.0 && largest < 180.2 && slowed.clock.duration_s() > 1.03, "{largest}");
    let setup = setup(motion, over(OverLimit::Warn)).unwrap();
    let warning = setup.warnings.iter().find(|warning| warning.code.name == "scenario::over_limit").unwrap();
    let said = warning.message.strip_prefix("joint \"elbow_joint\" would move at ").unwrap();
    assert!(said.ends_with(", its limit is 180 deg/s"), "{said}");
    // The setpoints of the run are as fast, up to three digits and the instants that are looked at.
    let found = instants(&setup);
    let largest = found.iter().fold(0.0_f64, |largest, now| largest.max(now.qd[2].abs())).to_degrees();
    let value: f64 = said.split(' ').next().unwrap().parse().unwrap();
    assert!(largest > 185.0 && (value - largest).abs() < 1.0, "{largest}: {said}");
    let (_folder, motion) = playback(text, Between::Linear);
    assert!(planned(motion).warnings.iter().all(|warning| warning.code.name != "scenario::over_limit"));
}

/// A servo keeps the velocities that the scenario declares, all joints slower alike.
#[test]
fn a_servo_keeps_declared_velocities() {
    let servo = ServoMotion {
        servo_tcp: pose((start() + Vector3::new(0.1, 0.2, 0.1)).into()),
        method: ServoMethod::default(),
        gain_per_s: Some(20.0),
        duration_s: 1.0,
    };
    let velocity_deg_s = BTreeMap::from([("*".to_owned(), 20.0)]);
    let limits = LimitSettings { velocity_deg_s, ..LimitSettings::default() };
    let setup = setup(vec![MotionSettings::Servo(servo)], limits).unwrap();
    let speeds = instants(&setup).into_iter().flat_map(|now| now.qd);
    let largest = speeds.fold(0.0_f64, |largest, qd| largest.max(qd.abs())).to_degrees();
    assert!((largest - 20.0).abs() < 1e-6, "{largest}");
}

/// So it does with declared accelerations, from rest on; only at its end does it stand at once.
#[test]
fn a_servo_keeps_declared_accelerations() {
    let servo = ServoMotion {
        servo_tcp: pose((start() + Vector3::new(0.1, 0.2, 0.1)).into()),
        method: ServoMethod::default(),
        gain_per_s: Some(20.0),
        duration_s: 1.0,
    };
    let acceleration_deg_s2 = BTreeMap::from([("*".to_owned(), 300.0)]);
    let limits = LimitSettings { acceleration_deg_s2, ..LimitSettings::default() };
    let found = instants(&setup(vec![MotionSettings::Servo(servo)], limits).unwrap());
    let mut largest = 0.0_f64;
    for pair in found.windows(2).filter(|pair| pair[1].time_s < 0.9995) {
        let step_s = pair[1].time_s - pair[0].time_s;
        let changes =
            pair[1].qd.iter().zip(&pair[0].qd).map(|(after, before)| (after - before).abs() / step_s);
        largest = changes.fold(largest, f64::max);
    }
    assert!(largest.to_degrees() > 290.0 && largest.to_degrees() < 300.0 + 1e-3, "{}", largest.to_degrees());
}

#[test]
fn motions_after_a_servo_start_where_it_ended() {
    let from = start();
    let (servo, down) = (from + Vector3::new(0.05, 0.05, 0.0), Vector3::new(0.0, 0.0, -0.1));
    let servo_tcp = pose(servo.into());
    let drive =
        ServoMotion { servo_tcp, method: ServoMethod::default(), gain_per_s: Some(20.0), duration_s: 1.0 };
    let away =
        LineMotion { line_tcp: pose((servo + down).into()), duration_s: Some(0.5), ..LineMotion::default() };
    let back = move_to("shoulder_pan_joint", 0.0, Some(0.5), Profile::Quintic);
    let setup = planned(vec![MotionSettings::Servo(drive.clone()), MotionSettings::Line(away), back]);
    let found = instants(&setup);
    assert!((tcp(&found, 1000) - servo).norm() < 1e-6);
    assert!((tcp(&found, 1250) - (servo + down / 2.0)).norm() < 1e-5, "{}", tcp(&found, 1250));
    assert!((tcp(&found, 1500) - (servo + down)).norm() < 1e-5);
    assert!(found[2000].q[0].abs() < 1e-12);
    for pair in found.windows(2) {
        assert!(pair[0].q.iter().zip(&pair[1].q).all(|(before, after)| (before - after).abs() < 5e-3));
    }
    let timeless = move_to("shoulder_pan_joint", 0.0, None, Profile::Quintic);
    refused(vec![MotionSettings::Servo(drive.clone()), timeless], "scenario::after_servo", &["duration_s"]);
    // What cannot be planned is known only in the run.
    let far = LineMotion { line_tcp: pose([3.0, 0.0, 0.0]), duration_s: Some(0.5), ..LineMotion::default() };
    let setup = planned(vec![MotionSettings::Servo(drive), MotionSettings::Line(far)]);
    let mut reference = ReferenceGenerator::new(&setup.trajectory, &setup.description).unwrap();
    let mut failed = None;
    for step in 1..=setup.clock.steps.unwrap() {
        let measured = reference.q().clone();
        if let Err(error) = reference.advance(setup.clock.time_s(step), &measured) {
            failed = Some((step, error.to_string()));
            break;
        }
    }
    let (step, said) = failed.unwrap();
    assert_eq!(step, 1000);
    assert!(
        said.starts_with("motion 2 cannot be planned from the end of the servo_tcp")
            && said.contains("out of reach"),
        "{said}"
    );
}

/// The duration of a motion after a servo is too short wherever the servo ends: it takes longer, and what follows is later.
#[test]
fn a_motion_after_a_servo_is_slowed() {
    let servo_tcp = pose((start() + Vector3::new(0.05, 0.05, 0.0)).into());
    let (method, gain_per_s) = (ServoMethod::default(), Some(20.0));
    let motions = || {
        vec![
            MotionSettings::Servo(ServoMotion {
                servo_tcp: servo_tcp.clone(),
                method,
                gain_per_s,
                duration_s: 1.0,
            }),
            move_to("shoulder_pan_joint", 120.0, Some(0.5), Profile::Quintic),
            move_to("wrist_3_joint", 30.0, Some(0.4), Profile::Quintic),
        ]
    };
    let slow = LimitSettings { over_limit: OverLimit::Slow, ..LimitSettings::default() };
    let setup = setup(motions(), slow).unwrap();
    let mut reference = ReferenceGenerator::new(&setup.trajectory, &setup.description).unwrap();
    let (mut largest, mut before, mut ends) = (0.0_f64, reference.q().clone(), None);
    for step in 1..=4000_u64 {
        let time_s = setup.clock.time_s(step);
        reference.advance(time_s, &before).unwrap();
        if time_s > 1.0 {
            largest = reference.qd().iter().fold(largest, |largest, qd| largest.max(qd.abs()));
            let jump = reference.q().iter().zip(&before).map(|(now, before)| (now - before).abs());
            assert!(jump.fold(0.0, f64::max) < 180.0_f64.to_radians() * 1.01e-3, "{time_s}");
        }
        before = reference.q().clone();
        if ends.is_none() && (reference.q()[5] - 30.0_f64.to_radians()).abs() < 1e-12 {
            ends = Some(time_s);
        }
    }
    let [slowed] = reference.slowed() else { panic!("{:#?}", reference.slowed()) };
    assert_eq!((slowed.motion, slowed.warning.code.name), (1, "scenario::slowed"));
    // 1.875 of the angle by the duration is 180 deg/s; the angle is some degrees from 120, by where the servo ends.
    let from = 120.0_f64 - largest.to_degrees() * (0.5 + slowed.longer_s) / 1.875;
    assert!((largest.to_degrees() - 180.0).abs() < 2.0 && largest.to_degrees() <= 180.0, "{largest}");
    assert!(from.abs() < 15.0 && slowed.longer_s > 0.5, "{from} {slowed:?}");
    assert!((ends.unwrap() - (1.9 + slowed.longer_s)).abs() < 2e-3, "{ends:?}");
    assert!((reference.q()[0].to_degrees() - 120.0).abs() < 1e-9);
    // Without "slow" it ends the run.
    let setup = planned(motions());
    let mut reference = ReferenceGenerator::new(&setup.trajectory, &setup.description).unwrap();
    let failed = (1..=1100).find_map(|step| {
        let measured = reference.q().clone();
        reference.advance(setup.clock.time_s(step), &measured).err()
    });
    assert!(failed.unwrap().to_string().contains("shoulder_pan_joint"));
}

#[test]
fn the_accelerations_of_the_robot_file_are_kept_too() {
    let mut description = super::ur5e();
    description.accelerations[2] = Some(300.0_f64.to_radians());
    let scenario =
        super::elbow((1.25, Profile::Quintic), (Some(400.0), None, OverLimit::Slow)).unwrap().scenario;
    let slow = congruent_twin::RunSetup::new(scenario, description).unwrap();
    assert!((slow.trajectory.duration_s() - 1.52).abs() < 1e-9, "{}", slow.trajectory.duration_s());
    let declared = slow.trajectory.declared_accelerations();
    assert!(
        (declared[2].to_degrees() - 300.0).abs() < 1e-9 && (declared[0].to_degrees() - 400.0).abs() < 1e-9
    );
}
