//! What the digits of a table or of screws leave open: small motions in the base, at zero.

use congruent_input::{TypedNumber, half_places, half_places_of_point, units::Unit};
use congruent_robot::{DhRowKind, SmallMotion, motions_of_pose};
use nalgebra::{Isometry3, Vector3};
use toml::Spanned;

use crate::robot_file::{WrittenPoe, WrittenScrew, WrittenTwist, halves_at, typed_transform, typed_vector};

/// A small motion along z of a frame, and one about it.
pub(super) fn along_z([shift_m, turn_rad]: [f64; 2], base_from_frame: &Isometry3<f64>) -> Vec<SmallMotion> {
    along(Vector3::z(), [shift_m, turn_rad], base_from_frame)
}

/// A small motion along x of a frame, and one about it.
pub(super) fn along_x([shift_m, turn_rad]: [f64; 2], base_from_frame: &Isometry3<f64>) -> Vec<SmallMotion> {
    along(Vector3::x(), [shift_m, turn_rad], base_from_frame)
}

fn along(
    axis: Vector3<f64>,
    [shift_m, turn_rad]: [f64; 2],
    base_from_frame: &Isometry3<f64>,
) -> Vec<SmallMotion> {
    let shift = (shift_m > 0.0).then(|| SmallMotion::shift(axis * shift_m));
    let turn = (turn_rad > 0.0).then(|| SmallMotion::turn(axis * turn_rad, &Vector3::zeros()));
    shift.into_iter().chain(turn).map(|motion| motion.expressed_in(base_from_frame)).collect()
}

/// Half of the last place of the numbers of `[poe]`.
pub(super) struct ScrewDigits {
    /// x, y, z in m, then roll, pitch, yaw in rad of the pose of the tip.
    home: [f64; 6],
    /// Of each joint those of its direction, and those of `v_m` or of the point, in m.
    joints: Vec<[Vector3<f64>; 2]>,
}

/// Where a half place goes.
enum Place {
    Home(usize),
    Joint { joint: usize, part: usize, component: usize },
}

impl ScrewDigits {
    pub(super) fn new(poe: &WrittenPoe, text: &str) -> Self {
        let joints = vec![[Vector3::zeros(); 2]; poe.joint.len()];
        let mut digits = Self { home: [0.0; 6], joints };
        for unit in [Unit::Length, Unit::Angle] {
            let halves = halves_at(typed(poe, unit, text), |numbers| match unit {
                // The zeros of a computed vector are rounded, too.
                Unit::Length => half_places_of_point(numbers),
                Unit::Angle => half_places(unit, numbers),
            });
            for (place, half) in halves {
                match place {
                    Place::Home(component) => digits.home[component] = half,
                    Place::Joint { joint, part, component } => digits.joints[joint][part][component] = half,
                }
            }
        }
        digits
    }

    /// Half of the last place of the components of the direction of a joint, and of its `v_m` or point, in m.
    pub(super) fn of_joint(&self, joint: usize) -> &[Vector3<f64>; 2] {
        &self.joints[joint]
    }

    /// The motions of the tip, and in the form `body` of all axes with it.
    pub(super) fn of_home(&self, base_from_tip_at_zero: &Isometry3<f64>) -> Vec<SmallMotion> {
        motions_of_pose(self.home, base_from_tip_at_zero)
    }

    /// The motions of the axis of a joint in the frame of its twist.
    pub(super) fn of_axis(
        &self,
        joint: usize,
        screw: &WrittenScrew,
        [angular, linear]: WrittenTwist,
    ) -> Vec<SmallMotion> {
        let [of_direction, of_linear] = self.joints[joint];
        let is_revolute = *screw.kind.get_ref() == DhRowKind::Revolute;
        let direction = if is_revolute { angular } else { linear };
        let point = Unit::Length.vector("point", screw.point_m.as_ref(), screw.point_mm.as_ref());
        let point = point.ok().flatten().map(Vector3::from);
        let tilt = |tilt_rad: Vector3<f64>| match &point {
            Some(point) => SmallMotion::turn(tilt_rad, point),
            // `v` stays: the axis moves so that a turn about the origin does not change it.
            None => SmallMotion { angular_rad: tilt_rad, linear_m: -angular.cross(&tilt_rad.cross(&linear)) },
        };
        let shift = |moved: Vector3<f64>| match &point {
            Some(_) => SmallMotion::shift(moved),
            // `v = -omega x q`.
            None => SmallMotion::shift(angular.cross(&moved)),
        };
        let tilts = components(of_direction).map(|part| tilt(direction.cross(&part)));
        let shifts = components(of_linear).filter(|_| is_revolute).map(shift);
        tilts.chain(shifts).filter(|motion| *motion != SmallMotion::shift(Vector3::zeros())).collect()
    }
}

/// The components that are not 0, each as a vector.
fn components(of: Vector3<f64>) -> impl Iterator<Item = Vector3<f64>> {
    (0..3).filter(move |&at| of[at] > 0.0).map(move |at| Vector3::ith(at, of[at]))
}

/// All lengths, or all directions and angles, as they are typed.
fn typed<'a>(poe: &WrittenPoe, unit: Unit, text: &'a str) -> Vec<(Place, TypedNumber<'a>)> {
    let home = typed_transform(poe.home.get_ref(), unit, text).into_iter();
    let home = home.map(|(at, number)| (Place::Home(at), number));
    let of_joint = |(joint, screw): (usize, &Spanned<WrittenScrew>)| {
        let screw = screw.get_ref();
        let slides = *screw.kind.get_ref() == DhRowKind::Prismatic;
        let (part, vector) = match (unit, slides) {
            (Unit::Length, true) => return Vec::new(),
            (Unit::Length, false) => {
                (1, [screw.v_m.as_ref().or(screw.point_m.as_ref()), screw.point_mm.as_ref()])
            }
            (Unit::Angle, true) => (0, [screw.axis.as_ref().or(screw.v_m.as_ref()), None]),
            (Unit::Angle, false) => (0, [screw.axis.as_ref().or(screw.omega.as_ref()), None]),
        };
        let numbers = typed_vector(vector, text).into_iter();
        // `[0, 0, 1]` is a direction by design.
        let is_open = |number: &TypedNumber<'_>| {
            unit == Unit::Length || number.text.parse::<f64>().is_ok_and(|component| component.fract() != 0.0)
        };
        let numbers = numbers.filter(|(_, number)| is_open(number));
        numbers.map(|(component, number)| (Place::Joint { joint, part, component }, number)).collect()
    };
    home.chain(poe.joint.iter().enumerate().flat_map(of_joint)).collect()
}
