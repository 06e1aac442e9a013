//! Profiles: how a motion proceeds from 0 to 1 over its duration.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Position, rate and acceleration of a motion at one instant, each as a share of the whole way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// 0 at the start, 1 at the end.
    pub share: f64,
    /// Change of `share` per second.
    pub share_per_s: f64,
    /// Change of `share_per_s` per second.
    pub share_per_s2: f64,
}

/// The profile of a motion.
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
}

impl Profile {
    /// Progress of a motion of `duration_s` after `elapsed_s`; it rests before its start and after its end.
    ///
    /// ```
    /// use congruent_twin::scenario::Profile;
    /// let half_way = Profile::Quintic.at(1.0, 2.0);
    /// assert_eq!((half_way.share, half_way.share_per_s), (0.5, 1.875 / 2.0));
    /// ```
    pub fn at(self, elapsed_s: f64, duration_s: f64) -> Progress {
        let s = elapsed_s / duration_s;
        if s <= 0.0 {
            return Progress { share: 0.0, share_per_s: 0.0, share_per_s2: 0.0 };
        }
        if s >= 1.0 {
            return Progress { share: 1.0, share_per_s: 0.0, share_per_s2: 0.0 };
        }
        let (share, rate, acceleration) = match self {
            Self::Quintic => (
                s * s * s * (10.0 + s * (6.0 * s - 15.0)),
                30.0 * s * s * (1.0 - s) * (1.0 - s),
                60.0 * s * (1.0 - s) * (1.0 - 2.0 * s),
            ),
            Self::Cubic => (s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s), 6.0 - 12.0 * s),
            Self::Linear => (s, 1.0, 0.0),
        };
        Progress {
            share,
            share_per_s: rate / duration_s,
            share_per_s2: acceleration / (duration_s * duration_s),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Profile; 3] = [Profile::Quintic, Profile::Cubic, Profile::Linear];

    /// Central difference with h = 1e-5 of the way: h^2/6 times a third derivative of at most 60,
    /// and rounding of 1e-16 / h; worst seen 1.7e-9 of the way per second; x3.
    const RATE_PER_S: f64 = 5e-9;

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
                let difference = (after.share_per_s - before.share_per_s) / (2.0 * h_s);
                assert!((now.share_per_s2 - difference).abs() < RATE_PER_S, "{profile:?} at {at_s}");
                assert!(after.share > before.share, "{profile:?} turns back at {at_s}");
            }
        }
    }

    #[test]
    fn before_and_after_it_rests() {
        for profile in ALL {
            for (at_s, share) in [(-1.0, 0.0), (0.0, 0.0), (2.5, 1.0), (9.0, 1.0)] {
                assert_eq!(
                    profile.at(at_s, 2.5),
                    Progress { share, share_per_s: 0.0, share_per_s2: 0.0 },
                    "{profile:?}"
                );
            }
        }
    }
}
