//! Recorded positions against the limits of the joints of a robot, as written and as if they were degrees.

use congruent_robot::{Joint, Robot};

use super::{clock::float, report::JointLimitsSurvey, report::PositionUnit};

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
    beyond_as_degrees: u64,
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
            beyond_as_degrees: 0,
        })
    }

    pub(super) fn take(&mut self, position: f64) {
        let is_beyond = |value: f64| value < self.range[0] - SLACK || value > self.range[1] + SLACK;
        self.positions += 1;
        self.beyond += u64::from(is_beyond(position));
        self.beyond_as_degrees += u64::from(is_beyond(position.to_radians()));
    }

    fn add(&mut self, other: &Self) {
        self.positions += other.positions;
        self.beyond += other.beyond;
        self.beyond_as_degrees += other.beyond_as_degrees;
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
        let as_degrees = count(|track| track.beyond_as_degrees) / positions;
        match beyond {
            beyond if beyond < LEAST_SHARE => PositionUnit::Radian,
            _ if as_degrees <= MOST_FITTING => PositionUnit::Degree,
            _ => PositionUnit::Neither,
        }
    }

    /// The shares of each joint.
    pub(super) fn report(self) -> Vec<JointLimitsSurvey> {
        let with_positions = self.joints.into_iter().filter(|(_, track)| track.positions > 0);
        let share = |count: u64, track: &LimitsTrack| float(count) / float(track.positions);
        with_positions
            .map(|(joint, track)| JointLimitsSurvey {
                joint,
                positions: track.positions,
                beyond: share(track.beyond, &track),
                beyond_as_degrees: track.is_angular.then(|| share(track.beyond_as_degrees, &track)),
            })
            .collect()
    }
}

/// The names of the joints of a robot that move, in its order.
pub(super) fn moving_names(robot: &Robot) -> Vec<String> {
    robot.movable_joint_names().map(str::to_owned).collect()
}
