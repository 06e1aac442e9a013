//! Planned motions of real robots, evaluated as a run evaluates them: paths, speeds and limits by independent means.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

mod few_joints;
mod joint_paths;
mod refusals;

use std::{collections::BTreeMap, path::Path};

use congruent_description::{RobotDescription, RobotQ, load_robot};
use congruent_input::Findings;
use congruent_kinematics::UrdfTree;
use congruent_motion::ReferenceGenerator;
use congruent_scenario::{
    ArcMotion, ArcSettings, ControllerSettings, JointMotion, LimitSettings, LineMotion, MotionSettings,
    OverLimit, PoseSettings, Profile, Scenario, ServoMethod, ServoMotion, StartSettings, TcpMotion,
    TcpPathMotion,
};
use congruent_twin::setup::RunSetup;
use nalgebra::{Isometry3, Vector3};

fn ur5e() -> RobotDescription {
    load_robot(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/ur5e")).unwrap()
}

/// The UR5e with its elbow up and its tool down.
fn setup(motion: Vec<MotionSettings>, limits: LimitSettings) -> Result<RunSetup, Findings> {
    let start = [
        ("shoulder_lift_joint", -90.0),
        ("elbow_joint", 90.0),
        ("wrist_1_joint", -90.0),
        ("wrist_2_joint", -90.0),
    ];
    let scenario = Scenario {
        name: "planned".to_owned(),
        controller: ControllerSettings::default(),
        start: StartSettings {
            joints_deg: start.map(|(name, deg)| (name.to_owned(), deg)).into(),
            ..StartSettings::default()
        },
        motion,
        limits,
        ..Scenario::default()
    };
    RunSetup::new(scenario, ur5e())
}

fn planned(motion: Vec<MotionSettings>) -> RunSetup {
    setup(motion, LimitSettings::default()).unwrap_or_else(|found| panic!("{found:#?}"))
}

#[track_caller]
fn refused(motion: Vec<MotionSettings>, code: &str, words: &[&str]) {
    let found = setup(motion, LimitSettings::default()).map(|_| ()).unwrap_err();
    assert_eq!(found[0].code.name, code, "{found:#?}");
    let said = format!("{}; {}", found[0].message, found[0].help.clone().unwrap_or_default());
    for word in words {
        assert!(said.contains(word), "\"{word}\" is not in: {said}");
    }
}

struct Instant {
    time_s: f64,
    q: RobotQ,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    world_from_tcp: Isometry3<f64>,
}

/// All instants of a setup's motions, each millisecond.
fn instants(setup: &RunSetup) -> Vec<Instant> {
    let description = &setup.description;
    let mut reference = ReferenceGenerator::new(&setup.trajectory, description).unwrap();
    let tree = UrdfTree::new(&description.robot);
    let tip_from_tcp = description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
    let mut found = Vec::new();
    for step in 0..=setup.clock.steps.unwrap() {
        let time_s = setup.clock.time_s(step);
        // A perfect arm: it is where it is commanded to be.
        let measured = reference.q().clone();
        if step > 0 {
            reference.advance(time_s, &measured).unwrap();
        }
        let world_from_tip = tree.root_from_link(reference.q(), description.tip).unwrap().to_isometry();
        found.push(Instant {
            time_s,
            q: reference.q().clone(),
            qd: reference.qd().to_vec(),
            qdd: reference.qdd().to_vec(),
            world_from_tcp: world_from_tip * tip_from_tcp,
        });
    }
    found
}

/// Velocities and accelerations are the derivatives of positions: central differences over 1 ms. `jump` is the largest
/// third derivative times half a step, with which the difference of an acceleration that bends is off.
#[track_caller]
fn assert_derivatives(instants: &[Instant], jump: f64) {
    let h_s = instants[1].time_s - instants[0].time_s;
    for three in instants.windows(3) {
        let [before, now, after] = three else { panic!("three instants") };
        for joint in 0..now.q.len() {
            let qd = (after.q[joint] - before.q[joint]) / (2.0 * h_s);
            let qdd = (after.qd[joint] - before.qd[joint]) / (2.0 * h_s);
            assert!((qd - now.qd[joint]).abs() < jump * h_s + 1e-8, "joint {joint} at {}: {qd}", now.time_s);
            assert!(
                (qdd - now.qdd[joint]).abs() < jump,
                "joint {joint} at {}: {qdd} for {}",
                now.time_s,
                now.qdd[joint]
            );
        }
    }
}

fn pose(xyz: [f64; 3]) -> PoseSettings {
    PoseSettings { xyz_m: Some(xyz), ..PoseSettings::default() }
}

fn line(xyz: [f64; 3], speed_m_s: f64, blend_m: f64) -> MotionSettings {
    let speed_m_s = Some(speed_m_s);
    MotionSettings::Line(LineMotion { line_tcp: pose(xyz), speed_m_s, blend_m, ..LineMotion::default() })
}

fn tcp(instants: &[Instant], at: usize) -> Vector3<f64> {
    instants[at].world_from_tcp.translation.vector
}

/// Where the tool is at the start.
fn start() -> Vector3<f64> {
    let still = JointMotion {
        move_joints_deg: BTreeMap::from([("elbow_joint".to_owned(), 90.0)]),
        duration_s: Some(0.01),
        ..JointMotion::default()
    };
    tcp(&instants(&planned(vec![MotionSettings::Joints(still)])), 0)
}

fn move_to(joint: &str, deg: f64, duration_s: Option<f64>, profile: Profile) -> MotionSettings {
    let move_joints_deg = BTreeMap::from([(joint.to_owned(), deg)]);
    MotionSettings::Joints(JointMotion { move_joints_deg, duration_s, profile, ..JointMotion::default() })
}

/// Promised between knots; in fact 2e-9 m at most.
const PATH_M: f64 = 1e-6;

#[test]
fn a_line_is_straight_at_its_speed_and_keeps_the_orientation() {
    let from = start();
    let to = from + Vector3::new(0.1, 0.25, -0.15);
    let setup = planned(vec![line(to.into(), 0.2, 0.0)]);
    let instants = instants(&setup);
    let direction = (to - from).normalize();
    let mut at_speed = 0_u32;
    for (at, pair) in instants.windows(2).enumerate() {
        let moved = tcp(&instants, at) - from;
        assert!((moved - direction * moved.dot(&direction)).norm() < PATH_M, "at {}", pair[0].time_s);
        let turned = pair[0].world_from_tcp.rotation.angle_to(&instants[0].world_from_tcp.rotation);
        assert!(turned < 1e-6, "{turned}");
        let speed = (tcp(&instants, at + 1) - tcp(&instants, at)).norm() * 1e3;
        assert!(speed < 0.2 + 1e-6, "{speed}");
        at_speed += u32::from((speed - 0.2).abs() < 1e-6);
    }
    let last = instants.len() - 1;
    assert!((tcp(&instants, last) - to).norm() < PATH_M);
    assert!(instants[last].qd.iter().all(|qd| qd.abs() < 1e-9));
    // L/v + v/a + a/j with 1.2 m/s2 and 12 m/s3, of which the ramps take twice v/a + a/j.
    let (length, ramp_s) = ((to - from).norm(), 0.2 / 1.2 + 0.1);
    assert!((setup.trajectory.duration_s() - (length / 0.2 + ramp_s)).abs() < 1e-9);
    let expected = (length / 0.2 - ramp_s) * 1e3;
    assert!((f64::from(at_speed) - expected).abs() < 4.0, "{at_speed} ms at speed, expected {expected}");
    assert_derivatives(&instants, 0.1);
}

#[test]
fn an_arc_keeps_its_radius() {
    let from = start();
    let centre = from + Vector3::new(0.0, 0.1, 0.0);
    let (via, to) = (centre + Vector3::new(0.1, 0.0, 0.0), centre + Vector3::new(0.0, 0.1, 0.0));
    let arc_tcp = Box::new(ArcSettings { via: pose(via.into()), to: pose(to.into()) });
    let arc = ArcMotion { arc_tcp, speed_m_s: Some(0.15), ..ArcMotion::default() };
    let setup = planned(vec![MotionSettings::Arc(arc)]);
    let instants = instants(&setup);
    let mut nearest = f64::INFINITY;
    for at in 0..instants.len() {
        let from_centre = tcp(&instants, at) - centre;
        assert!((from_centre.norm() - 0.1).abs() < PATH_M && from_centre.z.abs() < PATH_M);
        nearest = nearest.min((tcp(&instants, at) - via).norm());
    }
    assert!(nearest < 1e-3 && (tcp(&instants, instants.len() - 1) - to).norm() < PATH_M);
    assert_derivatives(&instants, 0.1);
}

#[test]
fn a_narrow_arc_is_slower_and_says_so() {
    let from = start();
    let (via, to) = (from + Vector3::new(0.01, 0.01, 0.0), from + Vector3::new(0.0, 0.02, 0.0));
    let arc_tcp = Box::new(ArcSettings { via: pose(via.into()), to: pose(to.into()) });
    let arc = ArcMotion { arc_tcp, speed_m_s: Some(0.5), ..ArcMotion::default() };
    let setup = planned(vec![MotionSettings::Arc(arc)]);
    let warning = setup.warnings.iter().find(|warning| warning.code.name == "scenario::arc_speed").unwrap();
    // sqrt(1.2 m/s2 x 10 mm).
    assert!(warning.message.contains("110 mm/s instead of 500 mm/s"), "{}", warning.message);
}

#[test]
fn blends_do_not_stop_and_stay_in_their_zone() {
    let from = start();
    let corner = from + Vector3::new(0.0, 0.2, 0.0);
    let to = corner + Vector3::new(0.15, 0.0, -0.1);
    let setup = planned(vec![line(corner.into(), 0.1, 0.03), line(to.into(), 0.2, 0.0)]);
    let instants = instants(&setup);
    let (mut slowest, mut nearest) = (f64::INFINITY, f64::INFINITY);
    for at in 1..instants.len() - 1 {
        let here = tcp(&instants, at);
        let to_corner = (here - corner).norm();
        nearest = nearest.min(to_corner);
        let speed = (tcp(&instants, at + 1) - here).norm() * 1e3;
        if to_corner < 0.03 {
            slowest = slowest.min(speed);
        } else {
            // Outside of the zone it is on one of the lines.
            let off = |a: &Vector3<f64>, b: &Vector3<f64>| (here - a).cross(&(b - a).normalize()).norm();
            assert!(off(&from, &corner).min(off(&corner, &to)) < PATH_M);
        }
    }
    // At right angles cos(45 deg) of the speed, and 3/16 of the radius times the corner's sqrt(2).
    assert!((slowest - 0.1 * 0.5_f64.sqrt()).abs() < 1e-3, "{slowest}");
    assert!((nearest - 0.03 * 3.0 / 16.0 * 2.0_f64.sqrt()).abs() < 1e-4, "{nearest}");
    assert_derivatives(&instants, 0.5);
    assert_eq!(setup.trajectory.motions().len(), 2);
}

#[test]
fn a_path_of_points_with_blends_is_one_motion_and_without_them_it_stops() {
    let from = start();
    let square = [[0.1, 0.0, 0.0], [0.1, 0.1, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.0]];
    let path_tcp: Vec<PoseSettings> = square.map(|xyz| pose((from + Vector3::from(xyz)).into())).into();
    let slowest_between = |blend_m: f64| {
        let path_tcp = path_tcp.clone();
        let path = TcpPathMotion { path_tcp, speed_m_s: 0.1, blend_m, ..TcpPathMotion::default() };
        let instants = instants(&planned(vec![MotionSettings::TcpPath(path)]));
        assert!((tcp(&instants, instants.len() - 1) - from).norm() < PATH_M);
        let half = 300..instants.len() - 300;
        half.map(|at| (tcp(&instants, at + 1) - tcp(&instants, at)).norm() * 1e3)
            .fold(f64::INFINITY, f64::min)
    };
    assert!(slowest_between(0.02) > 0.06);
    assert!(slowest_between(0.0) < 1e-4);
}

#[test]
fn moves_without_a_duration_take_the_least_time_within_all_limits() {
    let every = |value: f64| BTreeMap::from([("*".to_owned(), value)]);
    for (profile, acceleration, jerk) in [
        (Profile::JerkLimited, 200.0, 900.0),
        (Profile::Trapezoidal, 200.0, f64::INFINITY),
        (Profile::Quintic, 300.0, 2000.0),
    ] {
        let limits = LimitSettings {
            velocity_deg_s: BTreeMap::from([("*".to_owned(), 120.0), ("elbow_joint".to_owned(), 60.0)]),
            acceleration_deg_s2: every(acceleration),
            jerk_deg_s3: every(if jerk.is_finite() { jerk } else { 1e6 }),
            ..LimitSettings::default()
        };
        let move_joints_deg =
            BTreeMap::from([("shoulder_pan_joint".to_owned(), 80.0), ("elbow_joint".to_owned(), 30.0)]);
        let motion = JointMotion { move_joints_deg, profile, ..JointMotion::default() };
        let setup = setup(vec![MotionSettings::Joints(motion)], limits).unwrap();
        let instants = instants(&setup);
        let mut peaks = [0.0_f64; 3];
        for (at, now) in instants.iter().enumerate().skip(1) {
            let third = (now.qdd[0] - instants[at - 1].qdd[0]) * 1e3;
            let share = [now.qd[0] / 120.0, now.qdd[0] / acceleration, third / jerk];
            let elbow = (now.qd[2] / 60.0).to_degrees().abs();
            assert!(elbow < 1.0 + 1e-9, "{profile:?}: {elbow}");
            for (peak, share) in peaks.iter_mut().zip(share) {
                *peak = peak.max(share.to_degrees().abs());
            }
        }
        assert!(peaks.iter().all(|peak| *peak < 1.0 + 1e-6), "{profile:?}: {peaks:?}");
        // One of them is what takes the time: the elbow's 60 deg/s allows the pan 80.
        let elbow_bound = peaks[0] * 120.0 / 80.0;
        assert!(elbow_bound.max(peaks[1]).max(peaks[2]) > 0.99, "{profile:?}: {peaks:?}");
    }
}

#[test]
fn a_move_above_a_velocity_limit_is_refused_or_slowed() {
    let fast = |duration_s| vec![move_to("elbow_joint", -30.0, Some(duration_s), Profile::Quintic)];
    // 120 deg by 1.875 in 0.5 s is 450 deg/s, the limit 180 deg/s.
    refused(
        fast(0.5),
        "scenario::over_limit",
        &["elbow_joint", "450 deg/s", "0.25 s", "180 deg/s", "1.25 s"],
    );
    let slow = LimitSettings { over_limit: OverLimit::Slow, ..LimitSettings::default() };
    let setup = setup(fast(0.5), slow).unwrap();
    assert!(setup.warnings.iter().any(|warning| warning.code.name == "scenario::slowed"));
    assert!((setup.trajectory.duration_s() - 1.25).abs() < 1e-9);
    planned(fast(1.25));
}

/// The elbow by 120 deg over a duration, under limits in degrees.
fn elbow(
    (duration_s, profile): (f64, Profile),
    (acceleration, jerk, over_limit): (Option<f64>, Option<f64>, OverLimit),
) -> Result<RunSetup, Findings> {
    let every = |value: Option<f64>| value.map(|value| ("*".to_owned(), value)).into_iter().collect();
    let limits = LimitSettings {
        over_limit,
        acceleration_deg_s2: every(acceleration),
        jerk_deg_s3: every(jerk),
        ..LimitSettings::default()
    };
    setup(vec![move_to("elbow_joint", -30.0, Some(duration_s), profile)], limits)
}

#[test]
fn a_move_above_a_declared_acceleration_or_jerk_is_refused_or_slowed() {
    // Peaks of a quintic: 10 / sqrt 3 of the angle by the square of the duration, 60 by its cube; of a cubic 6 by the square.
    for (profile, acceleration, jerk, said, least_s) in [
        (Profile::Quintic, Some(300.0), None, "would accelerate at 443 deg/s^2 at ", 1.52),
        (Profile::Quintic, None, Some(2000.0), "would have a jerk of 3686 deg/s^3", 1.533),
        // Both are broken: what needs longer is reported.
        (Profile::Quintic, Some(300.0), Some(2000.0), "would have a jerk of 3686 deg/s^3", 1.533),
        (Profile::Cubic, Some(300.0), None, "would accelerate at 461 deg/s^2 at", 1.55),
        (Profile::JerkLimited, None, Some(2000.0), "would have a jerk of 3318 deg/s^3", 1.48),
    ] {
        let found = elbow((1.25, profile), (acceleration, jerk, OverLimit::Refuse)).map(|_| ()).unwrap_err();
        assert_eq!(found[0].code.name, "scenario::over_limit");
        assert!(found[0].message.contains(said), "{profile:?}: {found:#?}");
        let help = found[0].help.clone().unwrap();
        assert!(help.contains(&format!("is {least_s} s instead of 1.25 s")), "{profile:?}: {help}");
        let setup = elbow((1.25, profile), (acceleration, jerk, OverLimit::Slow)).unwrap();
        assert!((setup.trajectory.duration_s() - least_s).abs() < 1e-9, "{profile:?}");
        let largest = instants(&setup).iter().fold(0.0_f64, |largest, now| largest.max(now.qdd[2].abs()));
        assert!(largest.to_degrees() < acceleration.unwrap_or(f64::INFINITY) + 1e-9, "{profile:?}");
        elbow((least_s, profile), (acceleration, jerk, OverLimit::Refuse)).unwrap();
    }
    // No duration would keep a limit of what jumps.
    elbow((1.25, Profile::Trapezoidal), (Some(400.0), Some(500.0), OverLimit::Refuse)).unwrap();
    // Accelerations that nobody has declared are those of moves of least time alone.
    elbow((1.25, Profile::Quintic), (None, None, OverLimit::Refuse)).unwrap();
}

/// The tool accelerates within its own limit, a joint beyond its declared one.
#[test]
fn a_line_keeps_the_declared_accelerations_of_joints() {
    let to = start() + Vector3::new(0.1, 0.0, 0.0);
    let fastest = |limit: f64| {
        let every = BTreeMap::from([("*".to_owned(), limit)]);
        setup(
            vec![line(to.into(), 0.2, 0.0)],
            LimitSettings { acceleration_deg_s2: every, ..LimitSettings::default() },
        )
    };
    let free = fastest(1e4).unwrap();
    let peak = |setup: &RunSetup| {
        let qdd = instants(setup).into_iter().flat_map(|now| now.qdd);
        qdd.fold(0.0_f64, |peak, qdd| peak.max(qdd.abs())).to_degrees()
    };
    let found = fastest(0.9 * peak(&free)).map(|_| ()).unwrap_err();
    assert!(found[0].message.contains("would accelerate at") && found[0].message.contains("along the path"));
    fastest(1.02 * peak(&free)).unwrap();
}
