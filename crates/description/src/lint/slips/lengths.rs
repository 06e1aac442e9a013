//! Joint origins against the rest of the robot, and travels of sliding joints.

use super::{
    Judge, Kind,
    thresholds::{
        FARTHEST_JOINT, FASTEST_SLIDE_M_S, LEAST_ORIGIN_M, LEAST_TRAVEL_M, LONGEST_ORIGIN, LONGEST_TRACK_M,
        LONGEST_TRAVEL_M, TRACK_TO_SIZE, TRAVEL_TO_SHAPES, TRAVEL_TO_SIZE,
    },
};
use crate::{
    Elementary as _,
    display::{length, number, quantity},
    model::{Joint, JointKind},
    urdf::LARGEST_PLAUSIBLE_M,
};

const ORIGIN: Kind =
    Kind { code: "units::origin", words: "joints are far from everything that the rest of the robot has" };
const TRAVEL: Kind = Kind { code: "units::travel", words: "joints slide farther than the robot is large" };
const SLIDE: Kind = Kind { code: "units::slide_speed", words: "joints slide faster than any joint does" };

impl Judge<'_> {
    /// Whether a joint origin is told.
    pub(super) fn origins(&mut self) -> bool {
        let (robot, before) = (self.robot, self.found.len());
        for joint in robot.joints() {
            if let Some(what) = self.far_origin(joint) {
                let help = "the origin is in metres: is it in centimetres or millimetres?".to_owned();
                self.warn_joint(&ORIGIN, &joint.name, &what, ("origin", help));
            }
        }
        self.found.len() > before
    }

    fn far_origin(&self, joint: &Joint) -> Option<String> {
        let origin = joint.parent_from_joint.translation.vector;
        let length_m = origin.norm();
        let parent = self.robot.link(joint.parent);
        // A robot may stand anywhere in its world.
        let stands_there = joint.parent == self.robot.root()
            && joint.kind == JointKind::Fixed
            && self.sizes.shapes[joint.parent.get()].is_none();
        // Larger ones are told when they are read.
        if stands_there || length_m < LEAST_ORIGIN_M || origin.amax() > LARGEST_PLAUSIBLE_M {
            return None;
        }
        if let Some(shapes) = self.sizes.shapes[joint.parent.get()] {
            let (away_m, diagonal_m) = (shapes.distance_m(origin), shapes.diagonal_m());
            if away_m > FARTHEST_JOINT * diagonal_m && away_m > LEAST_ORIGIN_M {
                return Some(format!(
                    "it is {} away from the shapes of link \"{}\", which are {} large",
                    length(away_m),
                    parent.name,
                    length(diagonal_m)
                ));
            }
        }
        if self.sizes.shapes[joint.parent.get()].is_some_and(|shapes| shapes.diagonal_m() > length_m) {
            return None; // as long as the link itself
        }
        let others = self.robot.joints().iter().filter(|other| {
            other.name != joint.name
                && other.parent_from_joint.translation.vector != nalgebra::Vector3::zeros()
        });
        let rest_m = self.sizes.origins_m - length_m;
        (others.count() >= 3 && length_m > LONGEST_ORIGIN * rest_m).then(|| {
            format!(
                "its origin is {} long, {} times the sum of all others, {}",
                length(length_m),
                number((length_m / rest_m).round()),
                length(rest_m)
            )
        })
    }

    pub(super) fn travels(&mut self) {
        let robot = self.robot;
        for joint in robot.joints().iter().filter(|joint| joint.kind == JointKind::Prismatic) {
            if let Some(what) = self.far_travel(joint) {
                let help = "the range is in metres: is it in millimetres?".to_owned();
                self.warn_joint(&TRAVEL, &joint.name, &what, ("limit", help));
            }
            let velocity = joint.limit.and_then(|limit| limit.velocity);
            if let Some(speed) = velocity.filter(|speed| (FASTEST_SLIDE_M_S..PLACEHOLDER_M).contains(speed)) {
                let what = format!("it slides with {}", quantity(speed, "m/s"));
                let help = "the velocity is in m/s: is it in mm/s?".to_owned();
                self.warn_joint(&SLIDE, &joint.name, &what, ("limit", help));
            }
        }
    }

    fn far_travel(&self, joint: &Joint) -> Option<String> {
        let (lower, upper) = joint.position_range()?;
        let travel_m = lower.abs().max(upper.abs()).max(upper - lower);
        if travel_m > PLACEHOLDER_M {
            return None;
        }
        // Along a mast or under a jib.
        if travel_m < LARGE_TRAVEL_TO_SIZE * self.large.longest_m() {
            return None;
        }
        let what = |than: String| Some(format!("it slides over {}, {than}", length(travel_m)));
        let may_be_track = self.is_first_to_move(joint);
        if travel_m > if may_be_track { LONGEST_TRACK_M } else { LONGEST_TRAVEL_M } {
            return what("farther than any robot is long".to_owned());
        }
        if travel_m < LEAST_TRAVEL_M {
            return None;
        }
        // The shape of a track is often left out, or that of its carriage alone.
        if !may_be_track
            && let (Some(one), Some(other)) =
                (self.sizes.shapes[joint.parent.get()], self.sizes.shapes[joint.child.get()])
            && let shapes_m = one.diagonal_m() + other.diagonal_m()
            && travel_m > TRAVEL_TO_SHAPES * shapes_m
        {
            return what(format!("and the shapes of both links are {} large", length(shapes_m)));
        }
        let robot_m = self.sizes.robot_m();
        let most = if may_be_track { TRACK_TO_SIZE } else { TRAVEL_TO_SIZE };
        (travel_m > most * robot_m && robot_m > 0.0)
            .then(|| what(format!("and the robot is {} large", length(robot_m))))?
    }
}

impl Judge<'_> {
    /// Whether no moving joint carries a joint.
    fn is_first_to_move(&self, joint: &Joint) -> bool {
        self.robot.body(joint.parent) == self.robot.root()
    }
}

/// Travel against the largest link of a large machine.
const LARGE_TRAVEL_TO_SIZE: f64 = 1.2;
/// From here on a limit of a sliding joint is a way to write "none", m and m/s.
const PLACEHOLDER_M: f64 = 1e5;

/// Whether a limit is one: files write large powers of ten for "none".
pub(super) fn is_real(limit: f64) -> bool {
    let power = limit.abs().decimal_logarithm();
    limit.is_finite() && (limit.abs() < 100.0 || (limit.abs() <= 1e5 && (power - power.round()).abs() > 1e-9))
}
