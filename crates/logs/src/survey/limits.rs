//! Recorded positions against the limits of the joints of a robot, as written and as if they were degrees or mm.

use congruent_robot::{Joint, Robot};

use super::report::{JointLimitsSurvey, PositionUnit, RobotOfLog};
use crate::event::float;

/// A position may exceed a limit by the digits with which it is written: rad, m. Kind: rounding; encoders step by 1e-5.
const SLACK: f64 = 1e-3;
/// Share of positions beyond the limits from which they are no mistake of single samples. Kind: choice.
const LEAST_SHARE: f64 = 0.1;
/// Share up to which positions fit. Kind: choice; a glitch is no unit.
const MOST_FITTING: f64 = 0.01;

/// A joint of the robot, and the positions of it that were recorded.
#[derive(Debug, Clone)]
pub(super) struct LimitsTrack {
    range: [f64; 2],
    is_angular: bool,
    positions: u64,
    beyond: u64,
    /// Of these, by more than half of the range.
    far_beyond: u64,
    /// As degrees if the joint turns, as mm if it slides.
    beyond_in_other_unit: u64,
}

impl LimitsTrack {
    /// `None` for a joint without limits.
    pub(super) fn new(joint: &Joint) -> Option<Self> {
        let (lower, upper) = joint.position_range()?;
        let range = [lower, upper];
        Some(Self {
            range,
            is_angular: joint.kind.is_angular(),
            positions: 0,
            beyond: 0,
            far_beyond: 0,
            beyond_in_other_unit: 0,
        })
    }

    pub(super) fn take(&mut self, position: f64) {
        let is_beyond = |value: f64| value < self.range[0] - SLACK || value > self.range[1] + SLACK;
        self.positions += 1;
        self.beyond += u64::from(is_beyond(position));
        let half_range = (self.range[1] - self.range[0]) / 2.0;
        let is_far = position < self.range[0] - half_range || position > self.range[1] + half_range;
        self.far_beyond += u64::from(is_far);
        let in_other_unit = if self.is_angular { position.to_radians() } else { position / 1e3 };
        self.beyond_in_other_unit += u64::from(is_beyond(in_other_unit));
    }

    fn add(&mut self, other: &Self) {
        self.positions += other.positions;
        self.beyond += other.beyond;
        self.far_beyond += other.far_beyond;
        self.beyond_in_other_unit += other.beyond_in_other_unit;
    }
}

/// The positions of each joint of a robot that has limits and positions.
pub(super) struct RobotLimits {
    joints: Vec<(String, LimitsTrack)>,
}

impl RobotLimits {
    pub(super) fn new() -> Self {
        Self { joints: Vec::new() }
    }

    /// Adds the positions of a joint on a topic.
    pub(super) fn add(&mut self, joint: &str, track: &LimitsTrack) {
        match self.joints.iter_mut().find(|(known, _)| known == joint) {
            Some((_, known)) => known.add(track),
            None => self.joints.push((joint.to_owned(), track.clone())),
        }
    }

    /// The unit in which the angles fit.
    pub(super) fn unit(&self) -> PositionUnit {
        let angles = self.joints.iter().map(|(_, track)| track).filter(|track| track.is_angular);
        let count = |of: fn(&LimitsTrack) -> u64| float(angles.clone().map(of).sum());
        let positions = count(|track| track.positions);
        if positions == 0.0 {
            return PositionUnit::Unknown;
        }
        let beyond = count(|track| track.beyond) / positions;
        let far_beyond = count(|track| track.far_beyond) / positions;
        let as_degrees = count(|track| track.beyond_in_other_unit) / positions;
        match beyond {
            beyond if beyond < LEAST_SHARE => PositionUnit::Radian,
            // A joint that is a little beyond its limit is that, in whatever unit.
            beyond if as_degrees <= MOST_FITTING && far_beyond >= beyond / 2.0 => PositionUnit::Degree,
            _ => PositionUnit::Neither,
        }
    }

    /// The shares of each joint.
    pub(super) fn report(self) -> Vec<JointLimitsSurvey> {
        let with_positions = self.joints.into_iter().filter(|(_, track)| track.positions > 0);
        let share = |count: u64, track: &LimitsTrack| float(count) / float(track.positions);
        with_positions
            .map(|(joint, track)| {
                let in_other_unit = share(track.beyond_in_other_unit, &track);
                JointLimitsSurvey {
                    joint,
                    positions: track.positions,
                    beyond: share(track.beyond, &track),
                    beyond_as_degrees: track.is_angular.then_some(in_other_unit),
                    beyond_as_millimetres: (!track.is_angular).then_some(in_other_unit),
                }
            })
            .collect()
    }
}

impl JointLimitsSurvey {
    fn is_beyond(&self) -> bool {
        self.beyond >= LEAST_SHARE
    }

    /// Whether the positions of a joint that slides lie beyond its limits, and within them as mm.
    pub(super) fn is_in_millimetres(&self) -> bool {
        self.is_beyond() && self.beyond_as_millimetres.is_some_and(|share| share <= MOST_FITTING)
    }
}

impl RobotOfLog {
    /// The joints whose positions lie beyond their limits, without those that another unit explains.
    pub(super) fn joints_beyond_limits(&self) -> impl Iterator<Item = &JointLimitsSurvey> {
        let is_in_degrees = self.position_unit == PositionUnit::Degree;
        self.limits.iter().filter(move |joint| {
            let is_explained =
                joint.is_in_millimetres() || (is_in_degrees && joint.beyond_as_degrees.is_some());
            joint.is_beyond() && !is_explained
        })
    }
}

/// The names of the joints of a robot that move, in its order.
pub(super) fn moving_names(robot: &Robot) -> Vec<String> {
    robot.movable_joint_names().map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_robot(joints: &[(&str, bool, [f64; 2])]) -> RobotOfLog {
        let mut limits = RobotLimits::new();
        for (name, is_angular, positions) in joints {
            let mut track = LimitsTrack {
                range: [-1.0, 1.0],
                is_angular: *is_angular,
                positions: 0,
                beyond: 0,
                far_beyond: 0,
                beyond_in_other_unit: 0,
            };
            for position in positions {
                track.take(*position);
            }
            limits.add(name, &track);
        }
        RobotOfLog {
            robot: String::new(),
            sources: Vec::new(),
            missing: Vec::new(),
            unknown: Vec::new(),
            position_unit: limits.unit(),
            limits: limits.report(),
        }
    }

    fn beyond(of: &RobotOfLog) -> Vec<&str> {
        of.joints_beyond_limits().map(|joint| joint.joint.as_str()).collect()
    }

    #[test]
    fn one_joint_of_many_beyond_its_limits_is_found() {
        let mut joints = [("a", true, [0.0, 0.5]); 14];
        joints[3] = ("b", true, [2.0, 2.0]);
        let found = of_robot(&joints);
        assert_eq!((found.position_unit, beyond(&found)), (PositionUnit::Radian, vec!["b"]));
    }

    #[test]
    fn joints_that_slide_are_a_question_of_their_own() {
        let found = of_robot(&[
            ("a", true, [50.0, 45.0]),
            ("finger", false, [40.0, 80.0]),
            ("rail", false, [0.0, 3e3]),
        ]);
        assert_eq!((found.position_unit, beyond(&found)), (PositionUnit::Degree, vec!["rail"]));
        let in_mm: Vec<bool> = found.limits.iter().map(JointLimitsSurvey::is_in_millimetres).collect();
        assert_eq!(in_mm, [false, true, false]);
    }
}
