//! Compares joint origins with the rest of the robot, and the ranges of prismatic joints with its size.

use congruent_description::{Extent, Geometry, Joint, JointKind, Shape};
use congruent_input::{
    display::{length, number, quantity},
    units::LARGEST_PLAUSIBLE_M,
};

use super::{
    UnitCheck, UnitMistake,
    thresholds::{
        FARTHEST_JOINT, FASTEST_SLIDE_M_S, JOINT_AT_SHAPE, LEAST_ORIGIN_M, LEAST_TRAVEL_M, LONGEST_ORIGIN,
        LONGEST_TRACK_M, LONGEST_TRAVEL_M, TRACK_TO_SIZE, TRAVEL_TO_SHAPES, TRAVEL_TO_SIZE,
    },
};
use crate::codes;

const ORIGIN: UnitMistake = UnitMistake {
    code: codes::units::ORIGIN,
    words: "joints have an origin far from the rest of the robot",
    element: "origin",
};
const TRAVEL: UnitMistake = UnitMistake {
    code: codes::units::TRAVEL,
    words: "prismatic joints have a range far larger than the robot",
    element: "limit",
};
const SLIDE: UnitMistake = UnitMistake {
    code: codes::units::SLIDE_SPEED,
    words: "prismatic joints have an implausible velocity limit",
    element: "limit",
};

impl UnitCheck<'_> {
    /// Reports joint origins that are too far away. Returns whether any was reported.
    pub(super) fn origins(&mut self) -> bool {
        let (robot, before) = (self.robot, self.found.len());
        for joint in robot.joints() {
            if let Some(what) = self.far_origin(joint) {
                let help =
                    "the origin is read in metres: is the value in centimetres or millimetres?".to_owned();
                self.warn_joint(&ORIGIN, &joint.name, &what, help);
            }
        }
        self.found.len() > before
    }

    fn far_origin(&self, joint: &Joint) -> Option<String> {
        let origin = joint.parent_from_joint.translation.vector;
        let length_m = origin.norm();
        let parent = self.robot.link(joint.parent);
        // A fixed joint from an empty root link places the robot in its world, at any distance; so does one from a footprint, which
        // has a small box or ball to be seen, and no mass.
        let is_mesh = |shape: &Shape| matches!(shape.geometry, Geometry::Mesh(_));
        let is_footprint =
            parent.inertia.is_none() && !parent.visuals.iter().chain(&parent.collisions).any(is_mesh);
        let places_robot =
            joint.parent == self.robot.root() && joint.kind == JointKind::Fixed && is_footprint;
        // Larger ones were reported by `urdf/pose.rs` when the file was read.
        if places_robot || length_m < LEAST_ORIGIN_M || origin.amax() > LARGEST_PLAUSIBLE_M {
            return None;
        }
        if let Some(shapes) = self.sizes.shapes[joint.parent.get()] {
            let (away_m, diagonal_m) = (shapes.distance_m(origin), shapes.diagonal_m());
            if away_m > FARTHEST_JOINT * diagonal_m && away_m > LEAST_ORIGIN_M {
                return Some(format!(
                    "its origin is {} away from the shapes of link \"{}\", whose diagonal is {}",
                    length(away_m),
                    parent.name,
                    length(diagonal_m)
                ));
            }
        }
        // The origin lies within the extent of a large link, or at its end.
        let is_confirmed = |shapes: Extent| {
            let diagonal_m = shapes.diagonal_m();
            diagonal_m > length_m || shapes.distance_m(origin) <= JOINT_AT_SHAPE * diagonal_m
        };
        if self.sizes.shapes[joint.parent.get()].is_some_and(is_confirmed) {
            return None;
        }
        let others = self.robot.joints().iter().filter(|other| {
            other.name != joint.name
                && other.parent_from_joint.translation.vector != nalgebra::Vector3::zeros()
        });
        let rest_m = self.sizes.origins_m - length_m;
        (others.count() >= 3 && length_m > LONGEST_ORIGIN * rest_m).then(|| {
            format!(
                "its origin is {} long, {} times the sum of all other joint origins ({})",
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
                let help = "the range is read in metres: is the value in millimetres?".to_owned();
                self.warn_joint(&TRAVEL, &joint.name, &what, help);
            }
            let velocity = joint.limit.and_then(|limit| limit.velocity);
            if let Some(speed) = velocity.filter(|speed| (FASTEST_SLIDE_M_S..PLACEHOLDER_M).contains(speed)) {
                let what = format!("its velocity limit is {}", quantity(speed, "m/s"));
                let help = "the velocity is read in m/s: is the value in mm/s?".to_owned();
                self.warn_joint(&SLIDE, &joint.name, &what, help);
            }
        }
    }

    fn far_travel(&self, joint: &Joint) -> Option<String> {
        let (lower, upper) = joint.position_range()?;
        // A range far from zero is as suspicious as a wide one.
        let travel_m = lower.abs().max(upper.abs()).max(upper - lower);
        if travel_m > PLACEHOLDER_M {
            return None;
        }
        // Travels along a mast or under a jib are as long as a link of the machine.
        if travel_m < LARGE_TRAVEL_TO_SIZE * self.large.longest_m() {
            return None;
        }
        let what = |than: String| Some(format!("it slides over {}, {than}", length(travel_m)));
        let may_be_track = self.is_first_to_move(joint);
        if travel_m > if may_be_track { LONGEST_TRACK_M } else { LONGEST_TRAVEL_M } {
            return what("more than any robot".to_owned());
        }
        if travel_m < LEAST_TRAVEL_M {
            return None;
        }
        // The shape of a track is often left out or only that of its carriage, so that its travel is compared with the robot alone.
        if !may_be_track
            && let (Some(one), Some(other)) =
                (self.sizes.shapes[joint.parent.get()], self.sizes.shapes[joint.child.get()])
            && let shapes_m = one.diagonal_m() + other.diagonal_m()
            && travel_m > TRAVEL_TO_SHAPES * shapes_m
        {
            return what(format!("but the shapes of its two links measure {} together", length(shapes_m)));
        }
        let robot_m = self.sizes.robot_m();
        let most = if may_be_track { TRACK_TO_SIZE } else { TRAVEL_TO_SIZE };
        (travel_m > most * robot_m && robot_m > 0.0)
            .then(|| what(format!("but the robot measures {}", length(robot_m))))?
    }
}

impl UnitCheck<'_> {
    /// Whether a joint is the first moving joint above the root, such as that of a track.
    fn is_first_to_move(&self, joint: &Joint) -> bool {
        self.robot.body(joint.parent) == self.robot.root()
    }
}

/// Largest travel over the diagonal of the largest link of a large machine (no unit); shorter travels are not reported.
const LARGE_TRAVEL_TO_SIZE: f64 = 1.2;
/// From this value on a limit of a prismatic joint means "no limit", m and m/s.
const PLACEHOLDER_M: f64 = 1e5;

/// Whether a limit is meant as a limit: files write large powers of ten for "no limit".
pub(super) fn is_real(limit: f64) -> bool {
    let power = libm::log10(limit.abs());
    // Powers of ten from 100 on are placeholders for "no limit".
    limit.is_finite() && (limit.abs() < 100.0 || (limit.abs() <= 1e5 && (power - power.round()).abs() > 1e-9))
}
