//! Time scaling of a planned move: a profile over a given duration, or the phases of least time.

use std::sync::Arc;

use congruent_scenario::{Profile, Progress};

use super::{
    limits::MotionLimits,
    speed_profile::{RateLimits, SpeedProfile, Stretch},
};

/// Time scaling of a planned move: the share of its path over time.
#[derive(Debug, Clone, PartialEq)]
pub enum TimeScaling {
    /// A profile over a given duration.
    Shape {
        /// Shape of the progress from 0 to 1.
        profile: Profile,
        /// Duration of the move.
        duration_s: f64,
    },
    /// Phases of constant jerk.
    Phases(Arc<SpeedProfile>),
}

impl TimeScaling {
    /// Share of the path and its derivatives after a time.
    pub fn at(&self, elapsed_s: f64) -> Progress {
        match self {
            Self::Shape { profile, duration_s } => profile.at(elapsed_s, *duration_s),
            Self::Phases(phases) => phases.at(elapsed_s),
        }
    }

    /// Duration of the move.
    pub fn duration_s(&self) -> f64 {
        match self {
            Self::Shape { duration_s, .. } => *duration_s,
            Self::Phases(phases) => phases.duration_s(),
        }
    }

    /// The same time scaling, slower by this factor.
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
pub(crate) fn least_time(
    profile: Profile,
    change: &[f64],
    limits: &MotionLimits,
) -> Result<Option<TimeScaling>, usize> {
    let moving = || change.iter().enumerate().filter(|(_, change)| **change != 0.0);
    if let Some((unlimited, _)) = moving().find(|(joint, _)| limits.velocity[*joint].is_infinite()) {
        return Err(unlimited);
    }
    if moving().next().is_none() {
        return Ok(None);
    }
    // All joints move in proportion to one share s: |dq_i/dt| = |change_i| ds/dt, so each joint limits ds/dt by limit / change,
    // and the smallest of these quotients holds for all joints. Likewise for acceleration and jerk.
    let tightest = |limit: &[f64]| {
        moving().map(|(joint, change)| limit[joint] / change.abs()).fold(f64::INFINITY, f64::min)
    };
    let limits = RateLimits {
        velocity: tightest(&limits.velocity),
        acceleration: tightest(&limits.acceleration),
        jerk: tightest(&limits.jerk),
    };
    let phases = |limits| {
        TimeScaling::Phases(Arc::new(SpeedProfile::over(&[Stretch { length: 1.0, limits, stops: false }])))
    };
    Ok(Some(match profile {
        Profile::JerkLimited => phases(limits),
        Profile::Trapezoidal => phases(RateLimits { jerk: f64::INFINITY, ..limits }),
        Profile::Quintic | Profile::Cubic | Profile::Linear => {
            // The n-th derivative of a profile over T is its peak over T = 1, divided by T^n.
            let [velocity, acceleration, jerk] = profile.peaks();
            // A profile that jumps has no finite peak, and no duration would keep that limit.
            let needed = |peak: f64, limit: f64| if peak.is_finite() { peak / limit } else { 0.0 };
            let duration_s = needed(velocity, limits.velocity)
                .max(needed(acceleration, limits.acceleration).sqrt())
                .max(libm::cbrt(needed(jerk, limits.jerk)));
            TimeScaling::Shape { profile, duration_s }
        }
    }))
}
