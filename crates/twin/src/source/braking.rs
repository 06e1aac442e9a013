//! Brings the setpoint to rest: it continues on a straight line in joint space from the present commanded velocity, all joints
//! slowing down in proportion, so that none exceeds its acceleration limit; then it stays.

use congruent_description::{Joint, Robot, RobotQ};
use congruent_monitors::verdict::StopLimit;

/// Duration of a stop from the velocity limit of a joint. Kind: engineering; a URDF has velocity limits, but no acceleration
/// limits.
const FROM_VELOCITY_S: f64 = 0.25;
/// Acceleration limit of a joint without a velocity limit, rad/s^2 or m/s^2. Kind: engineering; the lowest limit of a joint of a
/// Panda is 7.5 rad/s^2 (Franka Robotics).
const ACCELERATION: f64 = 7.5;

/// Acceleration limit of each movable joint in a stop, with its origin; `declared` is infinite for joints without a declared
/// limit.
pub(crate) fn stop_accelerations(robot: &Robot, declared: &[f64]) -> Vec<(f64, StopLimit)> {
    let velocity = |joint: &Joint| joint.limit.and_then(|limit| limit.velocity).filter(|&limit| limit > 0.0);
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let acceleration = |(joint, &declared): (&Joint, &f64)| match velocity(joint) {
        _ if declared.is_finite() => (declared, StopLimit::Declared),
        Some(limit) => (limit / FROM_VELOCITY_S, StopLimit::FromVelocity),
        None => (ACCELERATION, StopLimit::Assumed),
    };
    joints.zip(declared).map(acceleration).collect()
}

/// A setpoint that slows down and stays.
#[derive(Debug, Clone)]
pub(super) struct Braking {
    began_s: f64,
    /// Time from the beginning to rest, the same for all joints.
    lasts_s: f64,
    from: RobotQ,
    speed: Vec<f64>,
    /// For each joint, the positions between which the setpoint stays.
    ranges: Vec<(f64, f64)>,
    /// For each joint the speed with which its setpoint came to the end of its range, where it stays at once; `None` if it
    /// came to rest before.
    at_end_of_range: Vec<Option<f64>>,
    q: RobotQ,
    qd: Vec<f64>,
    qdd: Vec<f64>,
}

impl Braking {
    /// From a setpoint and its velocities at `began_s`.
    pub(super) fn new(
        q: &RobotQ,
        qd: &[f64],
        began_s: f64,
        robot: &Robot,
        accelerations: &[(f64, StopLimit)],
    ) -> Self {
        let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
        // The joint that needs the longest time sets it for all: the path stays straight, and no limit is exceeded.
        let slowing = qd.iter().zip(accelerations).map(|(qd, (acceleration, _))| qd.abs() / acceleration);
        let unlimited = (f64::NEG_INFINITY, f64::INFINITY);
        let range = |(joint, &q): (&Joint, &f64)| {
            let (lower, upper) = joint.position_range().unwrap_or(unlimited);
            // A setpoint that is already outside stays where it is: clamping it to the range would make it jump.
            (lower.min(q), upper.max(q))
        };
        Self {
            began_s,
            lasts_s: slowing.fold(0.0, f64::max),
            from: q.clone(),
            speed: qd.to_vec(),
            ranges: joints.zip(q).map(range).collect(),
            at_end_of_range: vec![None; qd.len()],
            q: q.clone(),
            qd: qd.to_vec(),
            qdd: vec![0.0; qd.len()],
        }
    }

    /// Moves the setpoint to its place at `time_s`.
    pub(super) fn advance(&mut self, time_s: f64) {
        let elapsed_s = (time_s - self.began_s).min(self.lasts_s);
        let remaining = if self.lasts_s > 0.0 { 1.0 - elapsed_s / self.lasts_s } else { 0.0 };
        // At constant deceleration the mean speed is the mean of the first and the present one: with s = 1 - t / T the
        // displacement is v t (1 + s) / 2.
        let mean_s = elapsed_s * 0.5 * (1.0 + remaining);
        for (joint, (from, speed)) in self.from.iter().zip(&self.speed).enumerate() {
            let (lower, upper) = self.ranges[joint];
            let q = from + speed * mean_s;
            self.q[joint] = q.clamp(lower, upper);
            let is_free = (lower..=upper).contains(&q);
            if !is_free {
                // The first time only; within the step before it the speed changes by less than the printed digits.
                self.at_end_of_range[joint].get_or_insert((speed * remaining).abs());
            }
            self.qd[joint] = if is_free { speed * remaining } else { 0.0 };
            self.qdd[joint] = if is_free && remaining > 0.0 { -speed / self.lasts_s } else { 0.0 };
        }
    }

    /// For each joint the speed, rad/s or m/s, that its setpoint lost at once at the end of its range; `None` if it slowed down
    /// within its limit.
    pub(super) fn at_end_of_range(&self) -> &[Option<f64>] {
        &self.at_end_of_range
    }

    pub(super) fn q(&self) -> &RobotQ {
        &self.q
    }

    pub(super) fn qd(&self) -> &[f64] {
        &self.qd
    }

    pub(super) fn qdd(&self) -> &[f64] {
        &self.qdd
    }
}

#[cfg(test)]
mod tests {
    use congruent_description::parse_urdf;

    use super::*;

    fn robot() -> Robot {
        let joint = |name: &str, kind: &str, parent: &str, child: &str| {
            format!(
                r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/>
                   <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>"#
            )
        };
        let text = format!(
            r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/>{}{}</robot>"#,
            joint("turn", "revolute", "a", "b"),
            joint("slide", "prismatic", "b", "c")
        );
        parse_urdf(&text).unwrap()
    }

    const LIMITS: [(f64, StopLimit); 2] = [(4.0, StopLimit::FromVelocity), (1.0, StopLimit::Declared)];

    #[test]
    fn all_joints_slow_down_alike_and_none_faster_than_its_limit() {
        // Alone the first would need 0.125 s, the second 0.5 s.
        let mut braking = Braking::new(&[0.0, 0.25].into(), &[0.5, -0.5], 3.0, &robot(), &LIMITS);
        braking.advance(3.25);
        assert_eq!((&braking.q()[..], braking.qd()), (&[0.09375, 0.15625][..], &[0.25, -0.25][..]));
        // v^2 / 2 a of the second, and as far of the first.
        for time_s in [3.5, 9.0] {
            braking.advance(time_s);
            assert_eq!((&braking.q()[..], braking.qd()), (&[0.125, 0.125][..], &[0.0, 0.0][..]));
        }
    }

    #[test]
    fn a_setpoint_stays_within_the_range_of_its_joint() {
        let mut braking = Braking::new(&[0.95, 1.25].into(), &[0.5, 0.5], 0.0, &robot(), &LIMITS);
        braking.advance(0.25);
        assert_eq!((&braking.q()[..], braking.qd()), (&[1.0, 1.25][..], &[0.0, 0.0][..]));
        // Half of the stop is over: both lost 0.25 of 0.5 at once.
        assert_eq!(braking.at_end_of_range(), [Some(0.25), Some(0.25)]);
        braking.advance(0.3);
        assert_eq!(braking.at_end_of_range(), [Some(0.25), Some(0.25)], "the first time counts");
    }

    #[test]
    fn a_joint_without_a_declared_acceleration_stops_from_its_velocity_limit_in_a_quarter_of_a_second() {
        let declared = [f64::INFINITY, 1.0];
        let limits = stop_accelerations(&robot(), &declared);
        assert_eq!(limits, LIMITS);
        let unlimited = robot().with_joints(|joint| joint.limit = None);
        let limits = stop_accelerations(&unlimited, &declared);
        assert_eq!(limits, [(ACCELERATION, StopLimit::Assumed), (1.0, StopLimit::Declared)]);
    }

    #[test]
    fn a_setpoint_at_rest_stays() {
        let mut braking = Braking::new(&[0.5, 0.25].into(), &[0.0, 0.0], 1.0, &robot(), &LIMITS);
        braking.advance(1.001);
        assert_eq!((&braking.q()[..], braking.qd()), (&[0.5, 0.25][..], &[0.0, 0.0][..]));
    }
}
