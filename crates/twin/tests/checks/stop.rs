//! `on_violation = "stop"`: the arm is brought to rest, and the report says how.

use congruent_monitors::{
    JointSample,
    verdict::{Status, StopLimit},
};
use congruent_scenario::{Between, Check, LimitsCheck, MotionSettings, OnViolation, PlaybackMotion};
use congruent_twin::{
    Outcome, RunSetup,
    source::{Advance, JointStateSource, SimulationSource, SourceError},
};
use nalgebra::Isometry3;

use crate::support::{arm, controlled, outcome, scenario, servo, setup};

/// The elbow goes faster than a third of its velocity limit, 1 rad/s, in the first half of its move.
fn stopped(controller: congruent_scenario::ControllerSettings) -> RunSetup {
    let check = LimitsCheck {
        velocity_share: Some(1.0 / 3.0),
        on_violation: OnViolation::Stop,
        ..LimitsCheck::default()
    };
    setup(scenario(controller, Check::Limits(check)), &arm(&[]))
}

fn values(values: &congruent_description::JointValues) -> Vec<f64> {
    values.iter().map(|(_, value)| value).collect()
}

#[test]
fn in_playback_the_arm_slows_down_straight_on_within_its_accelerations() {
    let outcome = outcome(&stopped(controlled("kinematic", 0.0, 0.0)), None);
    let stop = outcome.stopped.as_ref().unwrap();
    let rest = stop.rest.as_ref().unwrap();
    assert!(rest.is_at_rest && outcome.steps > stop.step, "{stop:#?}");
    // 3 rad/s in 0.25 s are 12 rad/s^2: from v to rest in v / 12, v^2 / 24 further. v is just above 1 rad/s.
    let moved = values(&rest.joints);
    let speed = (24.0 * moved[1]).sqrt();
    assert!((1.0..1.02).contains(&speed), "{speed}");
    assert!((rest.duration_s - speed / 12.0).abs() < 1.5e-3, "{rest:#?}");
    // The others slow down alike: 0.7 rad of the shoulder for 0.8 rad of the elbow.
    assert!((moved[0] / moved[1] - 0.875).abs() < 1e-9, "{moved:?}");
    assert!(rest.tcp_path_m > 0.0);
}

/// The elbow may slow down with 7.5 rad/s^2, which is declared, and stops from v in v / 7.5.
#[test]
fn a_stop_keeps_the_declared_accelerations() {
    let playback = stopped(controlled("kinematic", 0.0, 0.0));
    let mut declared = playback.scenario.clone();
    // The motion itself is as fast as it was: 5.77 of its path by the square of 0.8 s is 7.2 rad/s^2.
    declared.limits.acceleration_rad_s2 = [("elbow".to_owned(), 7.5)].into();
    let setup = setup(declared, &arm(&[]));
    let outcome = outcome(&setup, None);
    let stop = outcome.stopped.as_ref().unwrap();
    let rest = stop.rest.as_ref().unwrap();
    let speed = (2.0 * 7.5 * values(&rest.joints)[1]).sqrt();
    assert!((1.0..1.02).contains(&speed), "{speed}");
    assert!((rest.duration_s - speed / 7.5).abs() < 1.5e-3, "{rest:#?}");
    let used: Vec<_> =
        rest.accelerations.iter().map(|used| (used.joint.as_str(), used.limit, used.source)).collect();
    let [from_velocity, declared] = [StopLimit::FromVelocity, StopLimit::Declared];
    assert_eq!(used[..2], [("shoulder", 12.0, from_velocity), ("elbow", 7.5, declared)]);
    let note = outcome.checks[0].notes.last().unwrap();
    assert!(note.ends_with("(accelerations: as declared for 1 of 4 joints)"), "{note}");
}

/// The elbow's range ends on its path: there it cannot slow down as slowly as is declared, and the report says so.
#[test]
fn a_stop_at_the_end_of_a_range_is_said() {
    let end = ("lower=\"-2\" upper=\"2\" effort=\"200\"", "lower=\"-2\" upper=\"0.8\" effort=\"200\"");
    let mut late = stopped(controlled("kinematic", 0.0, 0.0)).scenario;
    let table = std::env::temp_dir().join(format!("congruent_stop_{}.csv", std::process::id()));
    std::fs::write(&table, "time_s,elbow_rad\n0,0\n0.4,0.8\n0.8,0\n").unwrap();
    let play_csv = table.display().to_string();
    late.motion = vec![MotionSettings::Playback(PlaybackMotion { play_csv, between: Between::Linear })];
    late.limits.acceleration_rad_s2 = [("*".to_owned(), 0.8)].into();
    let check = Check::Limits(LimitsCheck {
        on_violation: OnViolation::Stop,
        velocity_share: Some(0.5),
        ..LimitsCheck::default()
    });
    late.check = vec![check];
    let setup = setup(late, &arm(&[end]));
    std::fs::remove_file(&table).unwrap();
    let outcome = outcome(&setup, None);
    let rest = outcome.stopped.as_ref().unwrap().rest.as_ref().unwrap();
    // From 2 rad/s at once, 0.8 rad on: sqrt(4 - 2 * 0.8 * 0.8) rad/s are left.
    let lost: Vec<_> = rest.accelerations.iter().map(|used| used.lost_at_end_of_range).collect();
    let speed = lost[1].unwrap();
    assert!((speed - (4.0_f64 - 1.28).sqrt()).abs() < 5e-3, "{speed}");
    assert!([0, 2, 3].iter().all(|&joint| lost[joint].is_none()), "{lost:?}");
    let note = outcome.checks[0].notes.last().unwrap();
    let said = "but elbow reached the end of its range at 94";
    assert!(note.contains(said) && note.contains("its setpoint stopped at once"), "{note}");
}

#[test]
fn servos_bring_the_arm_to_rest_and_hold_it() {
    let outcome = outcome(&stopped(servo()), None);
    let stop = outcome.stopped.as_ref().unwrap();
    let rest = stop.rest.as_ref().unwrap();
    assert!(rest.is_at_rest, "{stop:#?}");
    assert!((0.08..0.6).contains(&rest.duration_s), "{rest:#?}");
    assert!(values(&rest.joints)[1] > 0.04, "{rest:#?}");
    let result = &outcome.checks[0];
    assert_eq!(result.status, Status::Fail);
    assert_eq!(result.samples, outcome.steps + 1, "it is observed until the arm is at rest");
    let note = result.notes.last().unwrap();
    assert!(note.starts_with("stopped the run at ") && note.contains("; the arm is at rest "), "{note}");
}

/// Nothing holds the arm: the run does not wait for ever.
#[test]
fn an_arm_that_does_not_come_to_rest_is_reported() {
    let Outcome { stopped, .. } = outcome(&stopped(controlled("passive", 0.0, 0.0)), None);
    let rest = stopped.unwrap().rest.unwrap();
    assert!(!rest.is_at_rest && (rest.duration_s - 5.0).abs() < 2e-3, "{rest:#?}");
}

/// A log of a robot: it cannot be stopped.
struct Log<'a>(SimulationSource<'a>);

impl JointStateSource for Log<'_> {
    fn joints(&self) -> JointSample<'_> {
        self.0.joints()
    }

    fn is_last(&self) -> bool {
        self.0.is_last()
    }

    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool {
        self.0.root_from_links_into(root_from_links)
    }

    fn advance(&mut self, time_s: f64) -> Result<Advance, SourceError> {
        self.0.advance(time_s)
    }
}

#[test]
fn a_source_that_cannot_be_stopped_ends_the_run_at_once() {
    let setup = stopped(servo());
    let source = Box::new(Log(SimulationSource::new(&setup).unwrap()));
    let outcome = outcome(&setup, Some(source));
    let stop = outcome.stopped.unwrap();
    assert_eq!((stop.rest, stop.step), (None, outcome.steps));
}
