//! How the tool goes along a line or an arc: at a speed, or over a duration.

use congruent_description::Diagnostic;

use crate::{
    motion::timing::RateLimits,
    scenario::{FilePlace, Profile},
};

/// Acceleration if none is given, as arms in industry have it by default.
pub(crate) const ACCELERATION_M_S2: f64 = 1.2;
/// In which the acceleration is reached if no jerk is given.
const TO_ACCELERATION_S: f64 = 0.1;

/// How the tool goes along a leg.
#[derive(Clone, Copy)]
pub(super) enum Drive {
    Speed(RateLimits),
    Duration { duration_s: f64, profile: Profile },
}

/// The one of both that is given, with what belongs to it alone.
pub(super) fn drive(
    (speed_m_s, duration_s, profile): (Option<f64>, Option<f64>, Option<Profile>),
    (acceleration_m_s2, jerk_m_s3): (Option<f64>, Option<f64>),
    place: FilePlace<'_>,
) -> Result<Drive, Diagnostic> {
    let refused = |key: &str, message: &str, help: &str| {
        let error = Diagnostic::error("scenario::path_speed", message).with_help(help);
        Err(place.key(key).mark(error))
    };
    match (speed_m_s, duration_s) {
        (Some(_), None) if profile.is_some() => {
            let message =
                "`profile` is over a duration; with `speed_m_s` the tool starts and stops at constant jerk";
            refused("profile", message, "leave `profile` out, or give `duration_s` instead of the speed")
        }
        (None, Some(_)) if acceleration_m_s2.is_some() => {
            let message = "`acceleration_m_s2` belongs to a speed; over `duration_s` the profile tells the acceleration";
            refused("acceleration_m_s2", message, "leave it out, or give `speed_m_s` instead of the duration")
        }
        (None, Some(_)) if jerk_m_s3.is_some() => {
            let message = "`jerk_m_s3` belongs to a speed; over `duration_s` the profile tells the jerk";
            refused("jerk_m_s3", message, "leave it out, or give `speed_m_s` instead of the duration")
        }
        (Some(speed_m_s), None) => Ok(Drive::Speed(rates(speed_m_s, acceleration_m_s2, jerk_m_s3))),
        (None, Some(duration_s)) => Ok(Drive::Duration { duration_s, profile: profile.unwrap_or_default() }),
        (None, None) => refused("", "the motion has no speed", "give `speed_m_s`, or `duration_s`"),
        (Some(_), Some(_)) => {
            let message = "`speed_m_s` and `duration_s` both say how fast the tool is";
            refused("duration_s", message, "give one of them")
        }
    }
}

/// The rates of a speed.
pub(super) fn rates(velocity: f64, acceleration: Option<f64>, jerk: Option<f64>) -> RateLimits {
    let acceleration = acceleration.unwrap_or(ACCELERATION_M_S2);
    RateLimits { velocity, acceleration, jerk: jerk.unwrap_or_else(|| default_jerk_m_s3(acceleration)) }
}

/// The jerk if none is given.
pub(crate) fn default_jerk_m_s3(acceleration_m_s2: f64) -> f64 {
    acceleration_m_s2 / TO_ACCELERATION_S
}

/// The lower of both sides, and slower if the blend's acceleration would exceed the limit: at most
/// `3/4 v^2 |t2 - t1| / r`.
pub(super) fn blend_rates(before: &RateLimits, after: &RateLimits, corner_per_m: f64) -> RateLimits {
    let acceleration = before.acceleration.min(after.acceleration);
    let fastest = (acceleration / (0.75 * corner_per_m)).sqrt();
    RateLimits {
        velocity: before.velocity.min(after.velocity).min(fastest),
        acceleration,
        jerk: before.jerk.min(after.jerk),
    }
}
