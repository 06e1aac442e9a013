//! Tolerances that are so wide that a check would always pass.

use congruent_description::{Robot, ToleranceScale};
use congruent_input::{
    Diagnostic, Severity,
    display::{number, quantity},
};
use congruent_scenario::{Check, FilePlace, UnitKeys};

/// Relative limit from which a check can never fail: a difference as large as the quantity itself.
const WHOLE: f64 = 1.0;
/// Part of such a limit above which a warning is given. The default of `dynamics` at the longest step is 0.3.
const WIDE: f64 = 0.31;
/// Largest limit of a velocity if the joints have none: rad/s and m/s. Kind: judgement; no arm is a hundredth as fast.
const FASTEST: f64 = 1000.0;

/// Errors, and warnings, about the tolerances of a check.
pub(super) fn tolerances(
    check: &Check,
    place: FilePlace<'_>,
    robot: &Robot,
    scale: ToleranceScale,
) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let examined = check.unit_keys().into_iter().filter(|keys| is_tolerance(check, keys));
    examined
        .filter_map(|keys| {
            let key = keys.written_key();
            Some(place.key(key).mark(scale.examine(keys.unit, key, keys.value()?)?))
        })
        .chain(beyond_meaning(check, place, robot, scale))
        .partition(|found| found.severity == Severity::Error)
}

/// An error if the relative limit or the velocity limit of a check is so large that it always passes, a warning if nearly.
fn beyond_meaning(
    check: &Check,
    place: FilePlace<'_>,
    robot: &Robot,
    scale: ToleranceScale,
) -> Vec<Diagnostic> {
    let share = |key: &'static str, value: Option<f64>, of: &str| {
        let value = value.filter(|&value| value > WIDE * WHOLE)?;
        let finding = if value > WHOLE {
            let message =
                format!("the check would always pass: `{key}` = {} is above 1, {of}", number(value));
            Diagnostic::error(congruent_description::codes::tolerance::MEANINGLESS, message)
        } else {
            let message = format!("a wide tolerance: `{key}` = {} is a large part of 1, {of}", number(value));
            Diagnostic::warning(congruent_description::codes::tolerance::WIDE, message)
        };
        Some(
            place.key(key).mark(finding.with_help("give far less than 1, or remove the key for the default")),
        )
    };
    match check {
        Check::Dynamics(check) => share("relative", check.relative, "as much as the torques themselves"),
        Check::Effort(check) => share("relative", check.relative, "as much as the commanded effort itself"),
        Check::Power(check) => share("relative", check.relative, "as much as the energy itself"),
        Check::Invariants(check) => share("rotation", check.rotation, "the size of a rotation's columns"),
        Check::Twist(check) => {
            let most = fastest(robot, scale);
            let limits = check.unit_keys().into_iter().zip(most.into_iter().zip(["m/s", "rad/s"]));
            return limits.filter_map(|(keys, (most, unit))| too_fast(&keys, place, most, unit)).collect();
        }
        _ => None,
    }
    .into_iter()
    .collect()
}

fn too_fast(keys: &UnitKeys, place: FilePlace<'_>, most: f64, unit: &str) -> Option<Diagnostic> {
    let value = keys.value().filter(|&value| value > WIDE * most)?;
    let is_meaningless = value > most;
    let key = keys.written_key();
    let [value, most] = [value, most].map(|value| quantity(value, unit));
    let finding = if is_meaningless {
        let message = format!(
            "the check would always pass: `{key}` = {value} is above {most}, the largest possible speed"
        );
        Diagnostic::error(congruent_description::codes::tolerance::MEANINGLESS, message)
    } else {
        let message = format!(
            "a wide tolerance: `{key}` = {value} is a large part of {most}, the largest possible speed"
        );
        Diagnostic::warning(congruent_description::codes::tolerance::WIDE, message)
    };
    Some(place.key(key).mark(finding.with_help("give far less, or remove the key for the default")))
}

/// Upper bound of the speed of any frame of the robot, m/s and rad/s: all joints at their limits, at the reach.
fn fastest(robot: &Robot, scale: ToleranceScale) -> [f64; 2] {
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let (mut slides, mut turns) = (0.0, 0.0);
    for joint in joints {
        let speed = joint.limit.and_then(|limit| limit.velocity).unwrap_or(f64::INFINITY);
        // A sum over all joints, as if each moved the frame at the same time in the same direction.
        *(if joint.kind.is_angular() { &mut turns } else { &mut slides }) += speed;
    }
    let linear = if turns > 0.0 { slides + turns * scale.reach_m().unwrap_or(f64::INFINITY) } else { slides };
    // A robot without turning (or sliding) joints has a bound of 0, above which every limit would be refused.
    [linear, turns].map(|most: f64| if most > 0.0 { most.min(FASTEST) } else { FASTEST })
}

/// Whether these keys are a tolerance: a largest distance between poses that should be equal.
fn is_tolerance(check: &Check, keys: &UnitKeys) -> bool {
    match check {
        Check::Agreement(_)
        | Check::Contact(_)
        | Check::CycleTime(_)
        | Check::Goal(_)
        | Check::Pose(_)
        | Check::SamePoint(_)
        | Check::Step(_)
        | Check::Tracking(_) => true,
        // The others of these keys are margins.
        Check::Limits(_) => keys.keys[0].starts_with("tolerance"),
        // A distance that is kept, velocities, or no keys in two units.
        Check::Clearance(_)
        | Check::Dynamics(_)
        | Check::Effort(_)
        | Check::Invariants(_)
        | Check::Power(_)
        | Check::Recording(_)
        | Check::Twist(_)
        | Check::Velocity(_)
        | Check::Zone(_) => false,
    }
}
