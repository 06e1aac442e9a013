//! Time scaling of a path in least time, rest to rest: phases of constant jerk within limits of speed, acceleration and jerk
//! that may change along the path. Source: Biagiotti & Melchiorri, *Trajectory Planning for Automatic Machines and Robots*
//! (2008), sec. 3.4.

use congruent_scenario::Progress;

/// Bisections of a speed or a time: 2^-60 of an interval is below the rounding of its ends. Kind: rounding.
const BISECTIONS: usize = 60;

/// Limits along a path, in its unit of length: m for a tool path, 1 for a path that is parametrised by its share. Infinite
/// for no limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateLimits {
    /// Limit of the speed along the path, length per s.
    pub velocity: f64,
    /// Limit of the acceleration along the path, length per s^2.
    pub acceleration: f64,
    /// Limit of the jerk along the path, length per s^3.
    pub jerk: f64,
}

/// A part of a path with limits of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Length of the part, in the unit of the limits.
    pub length: f64,
    /// Limits on this part alone.
    pub limits: RateLimits,
    /// Whether the motion comes to rest at the end of the part.
    pub stops: bool,
}

/// A time interval with constant jerk; the values are those at its beginning.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Phase {
    starts_s: f64,
    position: f64,
    velocity: f64,
    acceleration: f64,
    jerk: f64,
}

/// The share of a path over time.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedProfile {
    phases: Vec<Phase>,
    duration_s: f64,
}

impl SpeedProfile {
    /// The profile of least time over these stretches, from rest to rest.
    pub fn over(stretches: &[Stretch]) -> Self {
        // Speeds between stretches first: with both ends fixed, each stretch is a problem of its own.
        let junctions = junction_speeds(stretches);
        let mut phases = Phases {
            list: Vec::with_capacity(7 * stretches.len()),
            time_s: 0.0,
            position: 0.0,
            velocity: 0.0,
        };
        let mut end = 0.0;
        for (stretch, ends) in stretches.iter().zip(junctions.windows(2)) {
            let (from, to) = (ends[0], ends[1]);
            let peak = stretch.peak(from, to);
            let ramps = stretch.limits.ramp_length(from, peak) + stretch.limits.ramp_length(to, peak);
            phases.ramp(peak, &stretch.limits);
            // At the peak speed over the rest of the length; rounding may make it negative if there is no such rest.
            phases.push(((stretch.length - ramps) / peak).max(0.0), 0.0, 0.0);
            phases.ramp(to, &stretch.limits);
            // Each stretch ends exactly at its length and speed: rounding errors would add up over thousands of them.
            end += stretch.length;
            (phases.position, phases.velocity) = (end, to);
        }
        let share = |phase: Phase| Phase {
            position: phase.position / end,
            velocity: phase.velocity / end,
            acceleration: phase.acceleration / end,
            jerk: phase.jerk / end,
            ..phase
        };
        Self { duration_s: phases.time_s, phases: phases.list.into_iter().map(share).collect() }
    }

    /// Time from rest to rest.
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Share of the path and its derivatives after a time; at rest before the start and after the end.
    pub fn at(&self, elapsed_s: f64) -> Progress {
        if elapsed_s <= 0.0 {
            return Progress::resting(0.0);
        }
        // The last phase that has begun: phases are in order of time.
        let next = self.phases.partition_point(|phase| phase.starts_s <= elapsed_s);
        if elapsed_s >= self.duration_s || next == 0 {
            return Progress::resting(1.0);
        }
        let Phase { starts_s, position, velocity, acceleration, jerk } = self.phases[next - 1];
        let t = elapsed_s - starts_s;
        Progress {
            share: position + t * (velocity + t * (acceleration / 2.0 + t * jerk / 6.0)),
            share_per_s: velocity + t * (acceleration + t * jerk / 2.0),
            share_per_s2: acceleration + t * jerk,
        }
    }

    /// Time at which this share of the path is reached.
    pub fn time_of(&self, share: f64) -> f64 {
        // Bisection: the share never decreases, and its inverse would be the root of a cubic in each phase.
        let (mut low, mut high) = (0.0, self.duration_s);
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(low, high);
            if self.at(middle).share < share { low = middle } else { high = middle }
        }
        high
    }

    /// The same profile, slower by this factor.
    #[must_use]
    pub fn slowed(&self, times: f64) -> Self {
        // s(t / k): the n-th derivative is divided by k^n, so that no limit that held is exceeded.
        let slow = |phase: &Phase| Phase {
            starts_s: phase.starts_s * times,
            position: phase.position,
            velocity: phase.velocity / times,
            acceleration: phase.acceleration / times.powi(2),
            jerk: phase.jerk / times.powi(3),
        };
        Self { phases: self.phases.iter().map(slow).collect(), duration_s: self.duration_s * times }
    }
}

impl RateLimits {
    /// Durations of a change of speed from and to zero acceleration: of each of the two phases in which acceleration
    /// changes, and of the phase between them in which it is constant.
    fn ramp_s(&self, change: f64) -> (f64, f64) {
        let change = change.abs();
        if change == 0.0 || self.acceleration.is_infinite() && self.jerk.is_infinite() {
            (0.0, 0.0)
        } else if self.jerk.is_infinite() {
            (0.0, change / self.acceleration)
        } else if change * self.jerk >= self.acceleration * self.acceleration {
            // The acceleration limit is reached: T_j = a / j, and dv = a (T_j + T_constant).
            let changing_s = self.acceleration / self.jerk;
            (changing_s, change / self.acceleration - changing_s)
        } else {
            // It is not: the acceleration peaks at j T_j, and dv = j T_j^2.
            ((change / self.jerk).sqrt(), 0.0)
        }
    }

    /// Length over which the speed changes: a ramp is symmetric about its middle, so its mean speed is that of its ends.
    fn ramp_length(&self, from: f64, to: f64) -> f64 {
        let (changing_s, constant_s) = self.ramp_s(to - from);
        f64::midpoint(from, to) * (2.0 * changing_s + constant_s)
    }

    /// The largest speed from `low` to `high` that fits; `low` if none does.
    fn largest(low: f64, high: f64, fits: impl Fn(f64) -> bool) -> f64 {
        // First, since on most stretches the limit fits, and so that the limit is met exactly and not to a bisection.
        if fits(high) {
            return high;
        }
        let (mut low, mut high) = (low, high);
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(low, high);
            if fits(middle) { low = middle } else { high = middle }
        }
        // The lower end fits for certain; the upper one would exceed the length by rounding.
        low
    }
}

impl Stretch {
    /// The largest speed on the stretch between given speeds at its ends.
    fn peak(&self, from: f64, to: f64) -> f64 {
        let limits = &self.limits;
        let fits = |peak: f64| limits.ramp_length(from, peak) + limits.ramp_length(to, peak) <= self.length;
        RateLimits::largest(from.max(to), limits.velocity, fits)
    }

    /// The largest speed at the other end, if the whole length is one ramp.
    fn reached(&self, from: f64, at_most: f64) -> f64 {
        RateLimits::largest(from, at_most.max(from), |to| self.limits.ramp_length(from, to) <= self.length)
    }
}

/// Speeds at the ends of all stretches: within the limits of both sides, and each reachable from its neighbours.
fn junction_speeds(stretches: &[Stretch]) -> Vec<f64> {
    let inner = stretches
        .windows(2)
        .map(|pair| if pair[0].stops { 0.0 } else { pair[0].limits.velocity.min(pair[1].limits.velocity) });
    let mut speeds: Vec<f64> = std::iter::once(0.0).chain(inner).chain(std::iter::once(0.0)).collect();
    // Forwards, what acceleration from the start allows; then backwards, what braking to the end needs. The second pass only
    // lowers speeds, which makes the ramps of the first shorter, so one pass in each direction is enough.
    for (at, stretch) in stretches.iter().enumerate() {
        speeds[at + 1] = speeds[at + 1].min(stretch.reached(speeds[at], speeds[at + 1]));
    }
    for (at, stretch) in stretches.iter().enumerate().rev() {
        speeds[at] = speeds[at].min(stretch.reached(speeds[at + 1], speeds[at]));
    }
    speeds
}

/// The phases so far, and time, path parameter and speed at their end.
struct Phases {
    list: Vec<Phase>,
    time_s: f64,
    position: f64,
    velocity: f64,
}

impl Phases {
    fn ramp(&mut self, to: f64, limits: &RateLimits) {
        let (changing_s, constant_s) = limits.ramp_s(to - self.velocity);
        let sign = (to - self.velocity).signum();
        if changing_s == 0.0 {
            // No jerk limit: one phase of a trapezoidal profile.
            self.push(constant_s, sign * limits.acceleration, 0.0);
        } else {
            let (jerk, acceleration) = (sign * limits.jerk, sign * limits.jerk * changing_s);
            self.push(changing_s, 0.0, jerk);
            self.push(constant_s, acceleration, 0.0);
            self.push(changing_s, acceleration, -jerk);
        }
        // Exactly, also if neither acceleration nor jerk is limited: the speed then jumps, in no time.
        self.velocity = to;
    }

    fn push(&mut self, duration_s: f64, acceleration: f64, jerk: f64) {
        if duration_s <= 0.0 {
            return;
        }
        let (t, velocity) = (duration_s, self.velocity);
        self.list.push(Phase {
            starts_s: self.time_s,
            position: self.position,
            velocity,
            acceleration,
            jerk,
        });
        self.time_s += t;
        self.position += t * (velocity + t * (acceleration / 2.0 + t * jerk / 6.0));
        self.velocity += t * (acceleration + t * jerk / 2.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: RateLimits = RateLimits { velocity: 1.5, acceleration: 4.0, jerk: 20.0 };
    /// Rounding of sums of some products; worst seen 4e-16.
    const ROUNDING: f64 = 1e-12;

    fn stretch(length: f64, velocity: f64) -> Stretch {
        Stretch { length, limits: RateLimits { velocity, ..LIMITS }, stops: false }
    }

    /// Limits hold at every instant, by differences too, and nothing jumps.
    #[track_caller]
    fn assert_within(profile: &SpeedProfile, length: f64, limits: &RateLimits) {
        let h_s = 1e-4;
        let steps = (profile.duration_s() / h_s).ceil();
        let mut before = profile.at(0.0);
        let mut step = 1.0;
        while step <= steps {
            let now = profile.at(step * h_s);
            let speed = (now.share - before.share) * length / h_s;
            let acceleration = (now.share_per_s - before.share_per_s) * length / h_s;
            let jerk = (now.share_per_s2 - before.share_per_s2) * length / h_s;
            assert!(speed <= limits.velocity + 1e-9 && speed >= -1e-9, "{speed}");
            assert!(acceleration.abs() <= limits.acceleration + 1e-9, "{acceleration}");
            assert!(jerk.abs() <= limits.jerk + 1e-6, "{jerk} at {}", step * h_s);
            before = now;
            step += 1.0;
        }
        assert!((profile.at(profile.duration_s() - 1e-12).share - 1.0).abs() < ROUNDING);
    }

    #[test]
    fn a_long_path_has_seven_phases_and_the_least_time() {
        let profile = SpeedProfile::over(&[stretch(3.0, 1.5)]);
        // L/v + v/a + a/j.
        assert!((profile.duration_s() - (2.0 + 0.375 + 0.2)).abs() < ROUNDING);
        assert_eq!(profile.phases.len(), 7);
        assert_within(&profile, 3.0, &LIMITS);
    }

    #[test]
    fn a_short_path_reaches_neither_speed_nor_acceleration() {
        let profile = SpeedProfile::over(&[stretch(0.01, 1.5)]);
        // Four phases of jerk: L = 2 j t^3.
        let expected_s = 4.0 * (0.01_f64 / (2.0 * 20.0)).cbrt();
        assert!((profile.duration_s() - expected_s).abs() < 1e-9, "{}", profile.duration_s());
        assert_within(&profile, 0.01, &LIMITS);
    }

    #[test]
    fn speeds_change_on_the_faster_side_and_short_stretches_bind_their_neighbours() {
        let lengths = [stretch(0.5, 1.0), stretch(0.02, 0.3), stretch(0.001, 1.5), stretch(0.6, 1.5)];
        let profile = SpeedProfile::over(&lengths);
        assert_within(&profile, 1.121, &LIMITS);
        for (at, limit) in [(0.5, 0.3), (0.51, 0.3), (0.52, 0.3)] {
            let speed = profile.at(profile.time_of(at / 1.121)).share_per_s * 1.121;
            assert!(speed <= limit + ROUNDING && speed > 0.29, "{speed} at {at}");
        }
    }

    #[test]
    fn a_stop_between_is_at_rest_and_slowing_changes_nothing_but_time() {
        let profile = SpeedProfile::over(&[Stretch { stops: true, ..stretch(0.5, 1.5) }, stretch(0.5, 1.5)]);
        let half_s = profile.duration_s() / 2.0;
        assert!(
            (profile.at(half_s).share - 0.5).abs() < ROUNDING && profile.at(half_s).share_per_s.abs() < 1e-6
        );
        let slow = profile.slowed(3.0);
        let (fast, slow) = (profile.at(0.3), slow.at(0.9));
        assert!((fast.share - slow.share).abs() < ROUNDING);
        assert!((fast.share_per_s - 3.0 * slow.share_per_s).abs() < ROUNDING);
        assert!((fast.share_per_s2 - 9.0 * slow.share_per_s2).abs() < ROUNDING);
    }

    #[test]
    fn without_a_limit_of_jerk_it_is_a_trapezoid() {
        let limits = RateLimits { jerk: f64::INFINITY, ..LIMITS };
        let profile = SpeedProfile::over(&[Stretch { length: 3.0, limits, stops: false }]);
        assert!((profile.duration_s() - (2.0 + 0.375)).abs() < ROUNDING);
        assert_eq!(profile.phases.len(), 3);
    }
}
