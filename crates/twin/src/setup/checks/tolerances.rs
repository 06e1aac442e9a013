//! Tolerances that allow any pose: a check with one of these would pass whatever happens.

use congruent_description::{
    Diagnostic, Robot, Severity, ToleranceScale,
    display::{number, quantity},
};

use crate::scenario::{Check, FilePlace, UnitKeys};

/// The largest share that tells anything: a difference as large as what it is a share of.
const WHOLE: f64 = 1.0;
/// Above this part of what tells nothing a share or a velocity is told of. The default of `dynamics` at the longest step is 0.3.
const WIDE: f64 = 0.31;
/// Largest limit of a velocity if the joints have none: rad/s and m/s. Kind: judgement; no arm is a hundredth as fast.
const FASTEST: f64 = 1000.0;

/// What is wrong with the tolerances of a check: errors, and warnings.
pub(super) fn tolerances(
    check: &Check,
    place: FilePlace<'_>,
    (robot, scale): (&Robot, ToleranceScale),
) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let examined = check.unit_keys().into_iter().filter(|keys| is_tolerance(check, keys));
    examined
        .filter_map(|keys| keys.examine_tolerance(place, scale))
        .chain(beyond_meaning(check, place, (robot, scale)))
        .partition(|found| found.severity == Severity::Error)
}

/// An error if a check would pass whatever happens since its share or its velocity is that large, a warning if it is almost so.
fn beyond_meaning(
    check: &Check,
    place: FilePlace<'_>,
    (robot, scale): (&Robot, ToleranceScale),
) -> Vec<Diagnostic> {
    let share = |key: &'static str, value: Option<f64>, of: &str| {
        let value = value.filter(|&value| value > WIDE * WHOLE)?;
        let told = if value > WHOLE {
            let message =
                format!("`{key}` = {} is above 1, {of}: the check would always pass", number(value));
            Diagnostic::error("tolerance::meaningless", message)
        } else {
            let message = format!("`{key}` = {} is a large part of 1, {of}", number(value));
            Diagnostic::warning("tolerance::wide", message)
        };
        Some(place.key(key).mark(told.with_help("give far less than 1, or leave it out for the default")))
    };
    match check {
        Check::Dynamics(check) => share("relative", check.relative, "as much as the torques themselves"),
        Check::Power(check) => share("relative", check.relative, "as much as the energy itself"),
        Check::Invariants(check) => share("rotation", check.rotation, "the size of a rotation's columns"),
        Check::Twist(check) => {
            let most = fastest(robot, scale);
            let limits = check.unit_keys().into_iter().zip(most.into_iter().zip(["m/s", "rad/s"]));
            return limits.filter_map(|(keys, (most, unit))| too_fast(&keys, place, (most, unit))).collect();
        }
        _ => None,
    }
    .into_iter()
    .collect()
}

fn too_fast(keys: &UnitKeys, place: FilePlace<'_>, (most, unit): (f64, &str)) -> Option<Diagnostic> {
    let value = keys.value().filter(|&value| value > WIDE * most)?;
    let is_meaningless = value > most;
    let key = keys.written_key();
    let [value, most] = [value, most].map(|value| quantity(value, unit));
    let told = if is_meaningless {
        let message =
            format!("`{key}` = {value} is above what the joints can do, {most}: the check would always pass");
        Diagnostic::error("tolerance::meaningless", message)
    } else {
        let message = format!("`{key}` = {value} is a large part of what the joints can do, {most}");
        Diagnostic::warning("tolerance::wide", message)
    };
    Some(place.key(key).mark(told.with_help("give far less, or leave it out for the default")))
}

/// No frame of the robot is faster, m/s and rad/s: all joints at their limits, at the reach.
fn fastest(robot: &Robot, scale: ToleranceScale) -> [f64; 2] {
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let (mut slides, mut turns) = (0.0, 0.0);
    for joint in joints {
        let speed = joint.limit.and_then(|limit| limit.velocity).unwrap_or(f64::INFINITY);
        *(if joint.kind.is_angular() { &mut turns } else { &mut slides }) += speed;
    }
    let linear = if turns > 0.0 { slides + turns * scale.reach_m().unwrap_or(f64::INFINITY) } else { slides };
    // A joint that does not move either way leaves nothing that a limit could be above.
    [linear, turns].map(|most: f64| if most > 0.0 { most.min(FASTEST) } else { FASTEST })
}

/// Whether these keys say how far from each other two things may be that should be at one place.
fn is_tolerance(check: &Check, keys: &UnitKeys) -> bool {
    match check {
        Check::Agreement(_)
        | Check::Contact(_)
        | Check::CycleTime(_)
        | Check::Goal(_)
        | Check::Tracking(_) => true,
        // The others of these keys are margins.
        Check::Limits(_) => keys.keys[0].starts_with("tolerance"),
        // A distance that is kept, velocities, or no keys in two units.
        Check::Clearance(_)
        | Check::Dynamics(_)
        | Check::Invariants(_)
        | Check::Power(_)
        | Check::Twist(_)
        | Check::Zone(_) => false,
    }
}
