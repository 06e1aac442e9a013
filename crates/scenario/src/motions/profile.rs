//! Profiles: the share of a motion, from 0 to 1, over its duration.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Share of a motion at one instant, with its first and second derivative by time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// 0 at the start, 1 at the end.
    pub share: f64,
    /// Change of `share` per second.
    pub share_per_s: f64,
    /// Change of `share_per_s` per second.
    pub share_per_s2: f64,
}

impl Progress {
    /// At rest at a share of the motion.
    pub fn resting(share: f64) -> Self {
        Self { share, share_per_s: 0.0, share_per_s2: 0.0 }
    }
}

/// The profile of a motion. Over a given duration it has the shape that is described here; without one, `trapezoidal`
/// and `jerk_limited` take the least time within the limits, the others the least time of their shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
    /// Rest to rest without a jump in acceleration: `10 s^3 - 15 s^4 + 6 s^5`
    /// (Lynch & Park, *Modern Robotics* (2017), sec. 9.2.2.1).
    #[default]
    Quintic,
    /// Rest to rest: `3 s^2 - 2 s^3` (eq. 9.11).
    Cubic,
    /// Constant velocity, with a jump of velocity at both ends.
    Linear,
    /// Constant acceleration, constant velocity, constant deceleration: a third of the duration each.
    Trapezoidal,
    /// As trapezoidal, but acceleration rises and falls at constant jerk (seven phases of constant jerk; over a given
    /// duration five, each ramp of velocity without a part of constant acceleration).
    JerkLimited,
}

/// Part of a given duration in which `trapezoidal` and `jerk_limited` accelerate, and in which they decelerate.
const RAMP: f64 = 1.0 / 3.0;

impl Profile {
    /// Progress of a motion of `duration_s` after `elapsed_s`; it rests before its start and after its end.
    ///
    /// ```
    /// use congruent_scenario::Profile;
    /// let half_way = Profile::Quintic.at(1.0, 2.0);
    /// assert_eq!((half_way.share, half_way.share_per_s), (0.5, 1.875 / 2.0));
    /// ```
    pub fn at(self, elapsed_s: f64, duration_s: f64) -> Progress {
        let s = elapsed_s / duration_s;
        if s <= 0.0 {
            return Progress::resting(0.0);
        }
        if s >= 1.0 {
            return Progress::resting(1.0);
        }
        let (share, rate, change) = match self {
            Self::Quintic => (
                s * s * s * (10.0 + s * (6.0 * s - 15.0)),
                30.0 * s * s * (1.0 - s) * (1.0 - s),
                60.0 * s * (1.0 - s) * (1.0 - 2.0 * s),
            ),
            Self::Cubic => (s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s), 6.0 - 12.0 * s),
            Self::Linear => (s, 1.0, 0.0),
            Self::Trapezoidal => ramped(s, |x| (x * x / 2.0, x, 1.0)),
            Self::JerkLimited => ramped(s, |x| {
                let left = 1.0 - x;
                if x < 0.5 {
                    (2.0 / 3.0 * x * x * x, 2.0 * x * x, 4.0 * x)
                } else {
                    (x - 0.5 + 2.0 / 3.0 * left * left * left, 1.0 - 2.0 * left * left, 4.0 * left)
                }
            }),
        };
        Progress { share, share_per_s: rate / duration_s, share_per_s2: change / (duration_s * duration_s) }
    }

    /// Largest first, second and third derivative of the share of a motion of 1 s; infinity if the derivative before it jumps.
    pub fn peaks(self) -> [f64; 3] {
        match self {
            Self::Quintic => [1.875, 10.0 / 3.0_f64.sqrt(), 60.0],
            Self::Cubic => [1.5, 6.0, f64::INFINITY],
            Self::Linear => [1.0, f64::INFINITY, f64::INFINITY],
            Self::Trapezoidal => [1.5, 4.5, f64::INFINITY],
            Self::JerkLimited => [1.5, 9.0, 54.0],
        }
    }
}

/// A symmetric shape of which `ramp` is the first part, from 0 to 1: the area, the height and the slope of a ramp.
fn ramped(s: f64, ramp: impl Fn(f64) -> (f64, f64, f64)) -> (f64, f64, f64) {
    // The area under the trapezoid is 1: rate (1 - 2 RAMP) + 2 (rate RAMP / 2) = rate (1 - RAMP).
    let rate = 1.0 / (1.0 - RAMP);
    if s > 1.0 - RAMP {
        let (area, height, slope) = ramp((1.0 - s) / RAMP);
        return (1.0 - area * rate * RAMP, height * rate, -slope * rate / RAMP);
    }
    if s < RAMP {
        let (area, height, slope) = ramp(s / RAMP);
        return (area * rate * RAMP, height * rate, slope * rate / RAMP);
    }
    (rate * (s - RAMP / 2.0), rate, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Profile; 5] =
        [Profile::Quintic, Profile::Cubic, Profile::Linear, Profile::Trapezoidal, Profile::JerkLimited];

    /// Central difference with h = 1e-5 of the path: h^2/6 times a third derivative of at most 60,
    /// and rounding of 1e-16 / h; worst seen 1.7e-9 of the path per second; x3.
    const RATE_PER_S: f64 = 5e-9;

    /// The same of the rate: h^2/6 times a third derivative of at most 360; of `jerk_limited`, whose jerk jumps, up to
    /// h/4 of the jump of 108. Of the path per second squared; worst seen 4.4e-5; x3.
    const CHANGE_PER_S2: f64 = 1.5e-4;

    #[test]
    fn the_rate_is_the_change_of_the_share() {
        let (duration_s, h_s) = (2.5, 2.5e-5);
        for profile in ALL {
            for step in 1..100 {
                let at_s = duration_s * f64::from(step) / 100.0;
                let [before, now, after] =
                    [at_s - h_s, at_s, at_s + h_s].map(|at_s| profile.at(at_s, duration_s));
                let difference = (after.share - before.share) / (2.0 * h_s);
                assert!((now.share_per_s - difference).abs() < RATE_PER_S, "{profile:?} at {at_s}");
                let change = (after.share_per_s - before.share_per_s) / (2.0 * h_s);
                // Between the corners of `trapezoidal`, which are at thirds.
                assert!((now.share_per_s2 - change).abs() < CHANGE_PER_S2, "{profile:?} at {at_s}: {change}");
                assert!(after.share > before.share, "{profile:?} turns back at {at_s}");
            }
        }
    }

    #[test]
    fn peaks_are_reached_and_not_exceeded() {
        for profile in ALL {
            let [rate, change, _] = profile.peaks();
            let found = (1..1800).map(|step| profile.at(f64::from(step) / 1800.0, 1.0));
            let largest = found.fold([0.0_f64; 2], |[rate, change], now| {
                [rate.max(now.share_per_s), change.max(now.share_per_s2.abs())]
            });
            let share =
                |found: f64, peak: f64| peak.is_infinite() || (0.995..1.0 + 1e-12).contains(&(found / peak));
            assert!(share(largest[0], rate) && share(largest[1], change), "{profile:?}: {largest:?}");
        }
    }

    #[test]
    fn before_and_after_it_rests() {
        for profile in ALL {
            for (at_s, share) in [(-1.0, 0.0), (0.0, 0.0), (2.5, 1.0), (9.0, 1.0)] {
                assert_eq!(profile.at(at_s, 2.5), Progress::resting(share), "{profile:?}");
            }
        }
    }
}
