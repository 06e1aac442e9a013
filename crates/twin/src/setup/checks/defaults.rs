//! The checks that a run has by default, if the scenario has no check of that kind.

use congruent_description::{Joint, Robot};
use congruent_scenario::{
    Check, CheckKind, EffortCheck, JointRole, LimitsCheck, PoseCheck, PoseOrigin, RecordingCheck, Scenario,
    SourceSettings, StepCheck, TrackingCheck, VelocityCheck,
};

/// Largest error of a turning joint at any instant. The scenarios of this project reach 0.43 deg under stiff servos and
/// 4.2 deg under soft ones; an arm that falls, or that a setpoint turns by 180 deg in 5 ms, exceeds it at once.
pub(crate) const PATH_DEG: f64 = 5.0;
/// Largest error of a sliding joint at any instant.
pub(crate) const PATH_MM: f64 = 20.0;

/// Smallest share of its commanded travel that a joint makes: whatever the size of a motion, an arm that makes less of it does
/// not follow. Kind: judgement; the scenarios of this project make all of it, to 1e-3.
pub(crate) const TRAVEL_SHARE: f64 = 0.8;

/// The checks that are added to those of the scenario: `tracking` if it has motions, `limits` if its robot declares some, and
/// `effort` if actuators drive it. A check of the scenario replaces the default check of the same kind; one that limits only the
/// overshoot does not, since an arm that never arrives has none.
pub(in crate::setup) fn default_checks(scenario: &Scenario, robot: &Robot) -> Vec<Check> {
    let has = |kind: CheckKind| scenario.check.iter().any(|check| check.kind() == kind);
    let joints = || robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let turns = joints().any(|joint| joint.kind.is_angular());
    let slides = joints().any(|joint| !joint.kind.is_angular());
    // Without motions the arm has nothing to follow; a scenario that drops an arm is legitimate.
    let is_followed = scenario.check.iter().any(limits_following);
    let has_setpoint =
        |source: &SourceSettings| source.joints.iter().any(|topic| topic.role == JointRole::Setpoint);
    let is_commanded = !scenario.motion.is_empty() || scenario.source.as_ref().is_some_and(has_setpoint);
    let follows = is_commanded && (turns || slides) && !is_followed;
    let tracking = follows.then(|| {
        Check::Tracking(TrackingCheck {
            path_deg: turns.then_some(PATH_DEG),
            path_mm: slides.then_some(PATH_MM),
            travel_share: Some(TRAVEL_SHARE),
            ..TrackingCheck::default()
        })
    });
    let is_limited = joints().any(has_limits) && !has(CheckKind::Limits);
    let limits = is_limited.then(|| Check::Limits(LimitsCheck::default()));
    let is_driven = scenario.controller.kind.has_actuators();
    let effort = (is_driven && !has(CheckKind::Effort)).then(|| Check::Effort(EffortCheck::default()));
    let mut checks: Vec<Check> = tracking.into_iter().chain(limits).chain(effort).collect();
    if let Some(source) = &scenario.source {
        let has_measured = source.pose.iter().any(|pose| pose.origin == PoseOrigin::Measured);
        let of_log = [
            (true, Check::Recording(RecordingCheck::default())),
            (true, Check::Velocity(VelocityCheck::default())),
            (!source.pose.is_empty(), Check::Pose(PoseCheck::default())),
            (has_measured, Check::Step(StepCheck::default())),
        ];
        checks.extend(
            of_log
                .into_iter()
                .filter(|(is_wanted, check)| *is_wanted && !has(check.kind()))
                .map(|(_, check)| check),
        );
    }
    checks
}

/// Whether a check limits how far the arm may be from its setpoint, on the path, at the end or in its travel.
fn limits_following(check: &Check) -> bool {
    let Check::Tracking(check) = check else { return false };
    let [path_rad, path_m, path_tcp_m, goal_rad, goal_m, goal_tcp_m, ..] = check.unit_keys();
    let errors = [path_rad, path_m, path_tcp_m, goal_rad, goal_m, goal_tcp_m];
    check.travel_share.is_some() || errors.iter().any(|keys| keys.value().is_some())
}

/// Whether a joint has a limit; a velocity or an effort of zero means unknown.
fn has_limits(joint: &Joint) -> bool {
    let stated = |limit: Option<f64>| limit.is_some_and(|limit| limit > 0.0);
    let of_motion = joint.limit.is_some_and(|limit| stated(limit.velocity) || stated(limit.effort));
    of_motion || joint.position_range().is_some()
}
