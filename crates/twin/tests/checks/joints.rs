//! `limits`, `tracking` and `cycle_time`.

use std::collections::BTreeMap;

use congruent_monitors::verdict::{CheckResult, Status};
use congruent_scenario::{
    Check, CycleTimeCheck, LimitsCheck, MotionSettings, OnViolation, Scenario, TrackingCheck,
};
use congruent_twin::RunSetup;

use crate::support::{
    arm, controlled, fails, measure, notes, passes, refused, result, result_distorted, scenario, servo,
    setup, worst,
};

fn limits() -> Check {
    Check::Limits(LimitsCheck::default())
}

/// The elbow, whose range ends at 2 rad, is led to `target_rad` from 1.7 rad.
#[track_caller]
fn led_to(target_rad: f64, controller: congruent_scenario::ControllerSettings) -> CheckResult {
    let mut scenario = scenario(controller, limits());
    scenario.start.joints_rad =
        [("shoulder", -1.5), ("elbow", 1.7)].map(|(name, q)| (name.to_owned(), q)).into();
    if let MotionSettings::Joints(motion) = &mut scenario.motion[0] {
        motion.move_joints_rad = BTreeMap::from([("elbow".to_owned(), target_rad)]);
    }
    result(&setup(scenario, &arm(&[])))
}

#[test]
fn a_joint_that_is_commanded_to_its_limit_is_at_it() {
    passes(&led_to(2.0, servo()));
    passes(&led_to(2.0, controlled("kinematic", 0.0, 0.0)));
}

#[test]
fn a_joint_that_sags_onto_its_stop_is_no_violation() {
    // Servos without gravity compensation: 6 N m of gravity at the elbow, which is level, by 60 N m/rad.
    let result = led_to(1.95, controlled("pd", 60.0, 20.0));
    passes(&result);
    notes(&result, "elbow rests on its stop from ");
    notes(&result, "it sags by ");
    let depth_rad = worst(&result, "angle_into_stop");
    assert!(depth_rad > 1e-6 && depth_rad < 1e-3, "{depth_rad}");
}

#[test]
fn a_joint_that_is_driven_beyond_its_limit_is_distinguished() {
    let by_physics = led_to(2.1, servo());
    fails(&by_physics, "angle_beyond_limit", "elbow");
    notes(&by_physics, "elbow is driven beyond its limit from ");
    notes(&by_physics, "outside");
    let in_playback = led_to(2.1, controlled("kinematic", 0.0, 0.0));
    fails(&in_playback, "angle_beyond_limit", "elbow");
    let error_rad = (worst(&in_playback, "angle_beyond_limit") - 0.1).abs();
    assert!(error_rad < 1e-12, "{in_playback:#?}");
}

/// A stop that is reached gently holds the joint exactly at its limit, while its setpoint goes on: not a joint at rest.
#[test]
fn a_joint_that_its_stop_holds_back_is_driven_beyond() {
    let mut scenario = scenario(controlled("kinematic", 0.0, 0.0), limits());
    scenario.start.joints_rad =
        [("shoulder", -1.5), ("elbow", 1.7)].map(|(name, q)| (name.to_owned(), q)).into();
    if let MotionSettings::Joints(motion) = &mut scenario.motion[0] {
        motion.move_joints_rad = BTreeMap::from([("elbow".to_owned(), 2.3)]);
    }
    let setup = setup(scenario, &arm(&[]));
    let result = result_distorted(&setup, |said| said.true_q[1] = said.true_q[1].min(2.0));
    fails(&result, "angle_of_setpoint_beyond_limit", "elbow");
    notes(&result, "elbow is driven beyond its limit from ");
    notes(&result, "outside the range");
    assert!((worst(&result, "angle_of_setpoint_beyond_limit") - 0.3).abs() < 1e-9, "{result:#?}");
}

/// The setpoint is inside, but the state goes on outwards through where the stop should be.
#[test]
fn a_stop_that_does_not_hold_is_a_violation() {
    let setup = setup(scenario(servo(), limits()), &arm(&[]));
    let result = result_distorted(&setup, |said| {
        if said.time_s > 0.5 {
            said.true_q[1] = 2.0 + 1e-4 * (said.time_s - 0.5);
        }
    });
    fails(&result, "angle_beyond_limit", "elbow");
    notes(&result, "its setpoint is inside the range, but it moves outwards");
}

#[test]
fn a_margin_moves_the_limits_inwards() {
    let check = LimitsCheck { margin_deg: Some(90.0), ..LimitsCheck::default() };
    let result = result(&setup(scenario(servo(), Check::Limits(check)), &arm(&[])));
    // The elbow ends at 0.8 rad, 1.2 rad from its limit.
    fails(&result, "angle_beyond_limit", "elbow");
    let beyond_rad = worst(&result, "angle_beyond_limit") + 1.2;
    assert!(beyond_rad.abs() < 0.01, "it is inside its range: {result:#?}");
}

#[test]
fn velocity_and_effort_are_shares_of_their_limits() {
    let within = result(&setup(scenario(servo(), limits()), &arm(&[])));
    passes(&within);
    // 0.8 rad in 0.8 s by a quintic: 1.875 of 3 rad/s.
    let share = worst(&within, "share_of_velocity_limit");
    assert!((share - 0.625).abs() < 0.02, "{share}");
    let check = LimitsCheck { velocity_share: Some(0.5), ..LimitsCheck::default() };
    let fast = result(&setup(scenario(servo(), Check::Limits(check)), &arm(&[])));
    fails(&fast, "share_of_velocity_limit", "elbow");
    let check = LimitsCheck { effort_share: Some(0.05), ..LimitsCheck::default() };
    let strong = result(&setup(scenario(servo(), Check::Limits(check)), &arm(&[])));
    fails(&strong, "share_of_effort_limit", "shoulder");
}

#[test]
fn an_actuator_at_its_limit_and_limits_that_are_not_stated_are_said() {
    let weak = arm(&[("effort=\"300\" velocity=\"3\"", "effort=\"20\" velocity=\"0\"")]);
    let result = result(&setup(scenario(servo(), limits()), &weak));
    notes(&result, "the actuator of shoulder is at its effort limit in ");
    notes(&result, "not checked (no velocity limit in the description): shoulder");
    assert_eq!(worst(&result, "share_of_effort_limit"), 1.0);
}

#[test]
fn a_share_is_at_most_the_whole() {
    let check = LimitsCheck { velocity_share: Some(1.5), ..LimitsCheck::default() };
    assert_eq!(refused(Check::Limits(check)), "scenario::share: `velocity_share` = 1.5, limit <= 1.001");
    let check = LimitsCheck { margin_m: Some(f64::NAN), ..LimitsCheck::default() };
    assert!(refused(Check::Limits(check)).starts_with("scenario::number: check.margin_m: expected a finite"));
}

/// Without a duration the move goes up to the velocity limit, and the servo that follows it a little beyond.
#[test]
fn a_move_of_least_time_keeps_the_limits_that_it_is_planned_with() {
    let mut scenario = scenario(servo(), limits());
    scenario.start.joints_rad.insert("shoulder".to_owned(), -1.5);
    scenario.start.joints_rad.insert("elbow".to_owned(), -1.9);
    scenario.simulation.duration_s = None;
    let long = [("shoulder", 1.5), ("elbow", 1.9)].map(|(name, target)| (name.to_owned(), target));
    let MotionSettings::Joints(motion) = &mut scenario.motion[0] else { panic!("{scenario:#?}") };
    (motion.move_joints_rad, motion.duration_s) = (long.into(), None);
    let least = result(&setup(scenario.clone(), &arm(&[])));
    passes(&least);
    let share = worst(&least, "share_of_velocity_limit");
    assert!(share > 1.0 && share <= 1.001, "the test is of a joint at its limit: {share}");
    // What the resolved scenario has is what was checked.
    let written = setup(scenario, &arm(&[])).scenario.check.swap_remove(0);
    let Check::Limits(written) = written else { panic!("{written:#?}") };
    assert_eq!((written.velocity_share, written.effort_share), (Some(1.001), Some(1.0)));
}

fn tracked(tracking: &TrackingCheck, controller: congruent_scenario::ControllerSettings) -> RunSetup {
    setup(scenario(controller, Check::Tracking(*tracking)), &arm(&[]))
}

#[test]
fn a_stiff_servo_follows_and_a_soft_one_does_not() {
    let tracking = TrackingCheck {
        path_deg: Some(2.0),
        path_mm: Some(2.0),
        path_tcp_mm: Some(20.0),
        goal_deg: Some(0.1),
        settling_s: Some(0.2),
        overshoot_deg: Some(0.5),
        ..TrackingCheck::default()
    };
    let stiff = result(&tracked(&tracking, servo()));
    passes(&stiff);
    let soft = result(&tracked(&tracking, controlled("pd", 300.0, 30.0)));
    assert_eq!(soft.status, Status::Fail);
    // The shoulder carries the whole arm: it sags by gravity over stiffness, 3 deg or more.
    let goal = measure(&soft, "goal_error_of_angle").worst.as_ref().unwrap();
    assert_eq!((goal.subject.as_str(), goal.time_s), ("shoulder", 1.2));
    let tcp = measure(&soft, "path_error_of_tcp").first_violation.as_ref().unwrap();
    assert_eq!(tcp.subject, "finger");
    let settling = measure(&soft, "settling_time").first_violation.as_ref().unwrap();
    assert!((settling.value - 0.2).abs() < 2e-3, "it is late as soon as the time is over: {settling:?}");
}

#[test]
fn playback_follows_exactly() {
    let tracking = TrackingCheck {
        path_rad: Some(0.0),
        goal_rad: Some(0.0),
        overshoot_rad: Some(0.0),
        ..TrackingCheck::default()
    };
    passes(&result(&tracked(&tracking, controlled("kinematic", 0.0, 0.0))));
}

/// A servo with little damping swings beyond the end of the motion.
#[test]
fn an_overshoot_is_measured_beyond_the_setpoint_at_rest() {
    let tracking = TrackingCheck { overshoot_deg: Some(0.05), ..TrackingCheck::default() };
    let result = result(&tracked(&tracking, controlled("gravity_compensation", 1000.0, 5.0)));
    assert_eq!(result.status, Status::Fail, "{result:#?}");
    let violation = measure(&result, "overshoot_of_angle").first_violation.as_ref().unwrap();
    assert!(violation.time_s >= 0.8, "the setpoint is at rest from 0.8 s on: {violation:?}");
}

/// The soft arm sags by degrees, and nothing settles before the setpoint is at rest, 0.8 s after the start.
#[test]
fn settling_is_judged_by_what_was_measured() {
    let tracking = TrackingCheck { goal_deg: Some(0.1), settling_s: Some(0.2), ..TrackingCheck::default() };
    let ended = |duration_s: f64| {
        let mut scenario = scenario(controlled("pd", 300.0, 30.0), Check::Tracking(tracking));
        scenario.simulation.duration_s = Some(duration_s);
        result(&setup(scenario, &arm(&[])))
    };
    let early = ended(0.8);
    assert_eq!((early.status, worst(&early, "settling_time")), (Status::Fail, f64::INFINITY), "{early:#?}");
    notes(&early, "the setpoint was never at rest");
    let unsettled = ended(0.85);
    let settling = measure(&unsettled, "settling_time").first_violation.as_ref().unwrap();
    assert!(settling.value.is_infinite(), "0.05 s are within the limit, but it is not there: {settling:?}");
}

#[test]
fn tracking_needs_limits_that_mean_something() {
    let refused = |tracking| refused(Check::Tracking(tracking));
    assert_eq!(refused(TrackingCheck::default()), "scenario::tracking: the check `tracking` has no limit");
    let settling = TrackingCheck { path_deg: Some(1.0), settling_s: Some(0.1), ..TrackingCheck::default() };
    assert!(refused(settling).contains("`settling_s` needs a limit `goal_*` for joints"));
    let twice = TrackingCheck { path_deg: Some(1.0), path_rad: Some(0.1), ..TrackingCheck::default() };
    assert!(refused(twice).contains("are both given"));
}

/// Servos without stiffness under compensated gravity: nothing moves, and the error is that of a small motion.
#[test]
fn a_small_motion_that_nobody_follows_fails() {
    let by_default = |controller, targets: [(&str, f64); 2]| {
        let mut scenario = scenario(controller, limits());
        scenario.start.joints_rad.clear();
        if let MotionSettings::Joints(motion) = &mut scenario.motion[0] {
            motion.move_joints_rad = targets.map(|(name, target)| (name.to_owned(), target)).into();
        }
        let setup = setup(scenario, &arm(&[]));
        let mut checks = crate::support::outcome(&setup, None).checks;
        checks.retain(|check| check.check == congruent_scenario::CheckKind::Tracking && check.is_default);
        checks.remove(0)
    };
    let slack = || controlled("gravity_compensation", 0.0, 0.0);
    for target in [0.002, 0.02, 0.08] {
        let not_followed = by_default(slack(), [("shoulder", target), ("elbow", 0.0)]);
        fails(&not_followed, "share_of_travel", "shoulder");
        passes(&by_default(servo(), [("shoulder", target), ("elbow", 0.0)]));
    }
    // Not judged: within it an arm is at its goal. Nor is a joint that is not commanded to move.
    passes(&by_default(slack(), [("shoulder", 0.0005), ("elbow", 0.0)]));
}

/// Overshoot of an arm that never arrives is none: the default check of the motion stays beside one that limits only that.
#[test]
fn a_check_of_overshoot_alone_keeps_the_default_tracking() {
    let tracked = |controller, tracking| {
        let outcome = crate::support::outcome(&tracked(&tracking, controller), None);
        let mut found = outcome.checks;
        found.retain(|check| check.check == congruent_scenario::CheckKind::Tracking);
        found
    };
    let overshoot = TrackingCheck { overshoot_deg: Some(5.0), ..TrackingCheck::default() };
    let slack = tracked(controlled("gravity_compensation", 0.0, 0.0), overshoot);
    let failing: Vec<_> = slack.iter().filter(|check| check.status == Status::Fail).collect();
    assert!(slack.len() == 2 && failing.len() == 1 && failing[0].is_default, "{slack:#?}");
    tracked(servo(), overshoot).iter().for_each(passes);
    // Its own limit of the travel, or of an error, replaces the default check as before.
    let of_travel = TrackingCheck { travel_share: Some(0.9), ..overshoot };
    assert_eq!(tracked(servo(), of_travel).len(), 1);
}

#[test]
fn a_motion_that_is_cut_short_is_not_judged_by_its_travel() {
    let tracking = TrackingCheck { travel_share: Some(0.9), ..TrackingCheck::default() };
    let ended = |duration_s: f64| {
        let mut scenario = scenario(servo(), Check::Tracking(tracking));
        scenario.simulation.duration_s = Some(duration_s);
        result(&setup(scenario, &arm(&[])))
    };
    assert_eq!(ended(0.1).status, Status::Skipped);
    passes(&ended(1.2));
}

fn cycle(limit_s: f64, edit: impl FnOnce(&mut Scenario)) -> CheckResult {
    let check = CycleTimeCheck {
        limit_s,
        tolerance_rad: None,
        tolerance_deg: None,
        tolerance_m: None,
        tolerance_mm: None,
        passing: None,
        on_violation: congruent_scenario::OnViolation::Continue,
    };
    let mut scenario = scenario(servo(), Check::CycleTime(check));
    edit(&mut scenario);
    result(&setup(scenario, &arm(&[])))
}

#[test]
fn the_motions_end_in_time() {
    let result = cycle(1.0, |_| {});
    passes(&result);
    let time_s = worst(&result, "cycle_time");
    assert!((0.8..1.0).contains(&time_s), "{time_s}");
    assert_eq!(measure(&result, "cycle_time").worst.as_ref().unwrap().subject, "all joints");
    let late = cycle(0.8, |_| {});
    assert_eq!(late.status, Status::Fail, "{late:#?}");
    assert_eq!(measure(&late, "cycle_time").first_violation.as_ref().unwrap().time_s, 0.801);
}

/// The path to rest is no end of the motions.
#[test]
fn a_run_without_motions_has_no_cycle_time() {
    let still = cycle(1.0, |scenario| {
        scenario.motion.clear();
        scenario.simulation.duration_s = Some(0.1);
    });
    assert_eq!(still.status, Status::Skipped, "{still:#?}");
    notes(&still, "the scenario has no motions");
}

#[test]
fn a_run_that_is_stopped_before_its_end_has_no_cycle_time() {
    let stopped = cycle(0.5, |scenario| {
        if let Check::CycleTime(check) = &mut scenario.check[0] {
            check.on_violation = OnViolation::Stop;
        }
    });
    assert_eq!(stopped.status, Status::Fail, "{stopped:#?}");
    assert_eq!(worst(&stopped, "cycle_time"), f64::INFINITY);
    assert_eq!(measure(&stopped, "cycle_time").first_violation.as_ref().unwrap().time_s, 0.501);
    notes(&stopped, "no cycle time: the run was stopped before the end of its motions");
    // Another check stops the run before the limit: nothing is known.
    let fast =
        LimitsCheck { velocity_share: Some(0.1), on_violation: OnViolation::Stop, ..LimitsCheck::default() };
    let by_another = cycle(9.0, |scenario| scenario.check.push(Check::Limits(fast)));
    assert!(measure(&by_another, "cycle_time").worst.is_none(), "{by_another:#?}");
}

#[test]
fn an_arm_that_does_not_arrive_has_no_cycle_time() {
    let result = cycle(9.0, |scenario| scenario.controller = controlled("pd", 300.0, 30.0));
    assert_eq!(result.status, Status::Fail, "{result:#?}");
    assert_eq!(worst(&result, "cycle_time"), f64::INFINITY);
}
