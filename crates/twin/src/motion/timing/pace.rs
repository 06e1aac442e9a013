//! The progress of a planned move over time: a profile over a duration, or phases of least time.

use std::sync::Arc;

use congruent_description::Elementary as _;

use super::{
    limits::MotionLimits,
    speed_profile::{RateLimits, SpeedProfile, Stretch},
};
use crate::scenario::{Profile, Progress};

/// The progress of a planned move over time.
#[derive(Debug, Clone, PartialEq)]
pub enum Pace {
    /// A profile over a given duration.
    Shape {
        /// The profile.
        profile: Profile,
        /// Its duration.
        duration_s: f64,
    },
    /// Phases of constant jerk.
    Phases(Arc<SpeedProfile>),
}

impl Pace {
    /// The progress after a time.
    pub fn at(&self, elapsed_s: f64) -> Progress {
        match self {
            Self::Shape { profile, duration_s } => profile.at(elapsed_s, *duration_s),
            Self::Phases(phases) => phases.at(elapsed_s),
        }
    }

    /// How long it takes.
    pub fn duration_s(&self) -> f64 {
        match self {
            Self::Shape { duration_s, .. } => *duration_s,
            Self::Phases(phases) => phases.duration_s(),
        }
    }

    /// The same, so many times slower.
    #[must_use]
    pub fn slowed(&self, times: f64) -> Self {
        match self {
            Self::Shape { profile, duration_s } => {
                Self::Shape { profile: *profile, duration_s: duration_s * times }
            }
            Self::Phases(phases) => Self::Phases(Arc::new(phases.slowed(times))),
        }
    }
}

/// The least time of a profile in which all joints move by `change` together; `Err` with the coordinate of a joint that
/// has no limit of velocity. `None` if nothing moves.
pub(in crate::motion) fn least_time(
    profile: Profile,
    change: &[f64],
    limits: &MotionLimits,
) -> Result<Option<Pace>, usize> {
    let moving = || change.iter().enumerate().filter(|(_, change)| **change != 0.0);
    if let Some((unlimited, _)) = moving().find(|(joint, _)| limits.velocity[*joint].is_infinite()) {
        return Err(unlimited);
    }
    if moving().next().is_none() {
        return Ok(None);
    }
    let tightest = |limit: &[f64]| {
        moving().map(|(joint, change)| limit[joint] / change.abs()).fold(f64::INFINITY, f64::min)
    };
    let limits = RateLimits {
        velocity: tightest(&limits.velocity),
        acceleration: tightest(&limits.acceleration),
        jerk: tightest(&limits.jerk),
    };
    let phases =
        |limits| Pace::Phases(Arc::new(SpeedProfile::over(&[Stretch { length: 1.0, limits, stops: false }])));
    Ok(Some(match profile {
        Profile::JerkLimited => phases(limits),
        Profile::Trapezoidal => phases(RateLimits { jerk: f64::INFINITY, ..limits }),
        Profile::Quintic | Profile::Cubic | Profile::Linear => {
            let [velocity, acceleration, jerk] = profile.peaks();
            // A profile that jumps has no finite peak, and no duration would keep that limit.
            let needed = |peak: f64, limit: f64| if peak.is_finite() { peak / limit } else { 0.0 };
            let duration_s = needed(velocity, limits.velocity)
                .max(needed(acceleration, limits.acceleration).sqrt())
                .max(needed(jerk, limits.jerk).cube_root());
            Pace::Shape { profile, duration_s }
        }
    }))
}
