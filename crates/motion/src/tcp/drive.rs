//! Timing of a line or an arc: a speed with acceleration and jerk, or a profile over a duration.

use congruent_input::Diagnostic;
use congruent_scenario::{ArcMotion, FilePlace, LineMotion, Profile, TcpPathMotion};

use crate::{RateLimits, codes};

/// Default acceleration of the tool, as industrial arms have it.
pub const ACCELERATION_M_S2: f64 = 1.2;
/// Time in which the acceleration is reached if no jerk is given.
const TO_ACCELERATION_S: f64 = 0.1;

/// Timing of a line or an arc.
#[derive(Clone, Copy)]
pub(super) enum LegTiming {
    Speed(RateLimits),
    Duration { duration_s: f64, profile: Profile },
}

/// The keys of a line or an arc that are about its timing.
#[derive(Debug, Clone, Copy)]
struct WrittenTiming {
    speed_m_s: Option<f64>,
    duration_s: Option<f64>,
    profile: Option<Profile>,
    acceleration_m_s2: Option<f64>,
    jerk_m_s3: Option<f64>,
}

/// The timing of a line.
pub(super) fn line_drive(line: &LineMotion, place: FilePlace<'_>) -> Result<LegTiming, Diagnostic> {
    let LineMotion { speed_m_s, duration_s, profile, acceleration_m_s2, jerk_m_s3, .. } = *line;
    drive(WrittenTiming { speed_m_s, duration_s, profile, acceleration_m_s2, jerk_m_s3 }, place)
}

/// The timing of an arc.
pub(super) fn arc_drive(arc: &ArcMotion, place: FilePlace<'_>) -> Result<LegTiming, Diagnostic> {
    let ArcMotion { speed_m_s, duration_s, profile, acceleration_m_s2, jerk_m_s3, .. } = *arc;
    drive(WrittenTiming { speed_m_s, duration_s, profile, acceleration_m_s2, jerk_m_s3 }, place)
}

/// The timing of the lines of a path.
pub(super) fn path_drive(path: &TcpPathMotion) -> LegTiming {
    LegTiming::Speed(rates(path.speed_m_s, path.acceleration_m_s2, path.jerk_m_s3))
}

/// The timing by the speed or by the duration, whichever is given, with the keys that belong to it.
fn drive(written: WrittenTiming, place: FilePlace<'_>) -> Result<LegTiming, Diagnostic> {
    let WrittenTiming { speed_m_s, duration_s, profile, acceleration_m_s2, jerk_m_s3 } = written;
    let refused = |key: &str, message: &str, help: &str| {
        let error = Diagnostic::error(codes::scenario::PATH_SPEED, message).with_help(help);
        Err(place.key(key).mark(error))
    };
    match (speed_m_s, duration_s) {
        (Some(_), None) if profile.is_some() => {
            let message =
                "`profile` needs `duration_s`; with `speed_m_s` the tool starts and stops with constant jerk";
            refused("profile", message, "remove `profile`, or give `duration_s` instead of `speed_m_s`")
        }
        (None, Some(_)) if acceleration_m_s2.is_some() => {
            let message =
                "`acceleration_m_s2` needs `speed_m_s`; with `duration_s` the profile sets the acceleration";
            refused("acceleration_m_s2", message, "remove it, or give `speed_m_s` instead of `duration_s`")
        }
        (None, Some(_)) if jerk_m_s3.is_some() => {
            let message = "`jerk_m_s3` needs `speed_m_s`; with `duration_s` the profile sets the jerk";
            refused("jerk_m_s3", message, "remove it, or give `speed_m_s` instead of `duration_s`")
        }
        (Some(speed_m_s), None) => Ok(LegTiming::Speed(rates(speed_m_s, acceleration_m_s2, jerk_m_s3))),
        (None, Some(duration_s)) => {
            Ok(LegTiming::Duration { duration_s, profile: profile.unwrap_or_default() })
        }
        (None, None) => refused("", "the motion has no speed", "give `speed_m_s`, or `duration_s`"),
        (Some(_), Some(_)) => {
            let message = "`speed_m_s` and `duration_s` cannot be given together";
            refused("duration_s", message, "remove one of them")
        }
    }
}

/// The limits along the path for a speed, with defaults for acceleration and jerk.
fn rates(velocity: f64, acceleration: Option<f64>, jerk: Option<f64>) -> RateLimits {
    let acceleration = acceleration.unwrap_or(ACCELERATION_M_S2);
    RateLimits { velocity, acceleration, jerk: jerk.unwrap_or_else(|| default_jerk_m_s3(acceleration)) }
}

/// Default jerk of the tool: the acceleration is reached in `TO_ACCELERATION_S`.
pub fn default_jerk_m_s3(acceleration_m_s2: f64) -> f64 {
    acceleration_m_s2 / TO_ACCELERATION_S
}

/// Limits in a blend: the lower ones of both sides, and a speed at which the acceleration across the path, at most
/// `3/4 v^2 |t2 - t1| / r`, keeps its limit. `corner_per_m` is `|t2 - t1| / r` with the unit directions before and after.
pub(super) fn blend_rates(before: &RateLimits, after: &RateLimits, corner_per_m: f64) -> RateLimits {
    // The blend is p'' = a''(u) (t2 - t1) with u = s / (2 r) and a'' = 12 r (u - u^2), which is largest, 3 r, in the middle:
    // 3 r / (2 r)^2 = 3 / (4 r).
    let acceleration = before.acceleration.min(after.acceleration);
    // Infinite for a straight junction.
    let fastest = (acceleration / (0.75 * corner_per_m)).sqrt();
    RateLimits {
        velocity: before.velocity.min(after.velocity).min(fastest),
        acceleration,
        jerk: before.jerk.min(after.jerk),
    }
}
