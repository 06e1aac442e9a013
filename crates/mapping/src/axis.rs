//! The axis of a joint as a line in space, and the turn or shift about one axis that brings another line nearest to its
//! place.

use congruent_kinematics::Screw;
use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

/// Sine of an angle below which two axes count as parallel: calibrated parallel axes are up to a few milliradians off. Kind:
/// choice.
const PARALLEL: f64 = 5e-3;
/// A turn or a shift is determined by a line whose weight is above this: a millimetre of lever. Kind: choice.
const LEAST_LEVER_M: f64 = 1e-3;

/// The axis of a joint in some frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Axis {
    /// Direction of positive motion, of length 1.
    pub(crate) direction: Vector3<f64>,
    /// A point of the axis, m; of no meaning for a slide.
    pub(crate) through: Vector3<f64>,
    /// Whether the joint slides.
    pub(crate) slides: bool,
}

impl Axis {
    pub(crate) fn from_screw(screw: &Screw) -> Self {
        let twist = screw.twist();
        if screw.is_revolute() {
            // w x v, the point nearest to the origin.
            Self { direction: twist.angular, through: twist.angular.cross(&twist.linear), slides: false }
        } else {
            Self { direction: twist.linear, through: Vector3::zeros(), slides: true }
        }
    }

    /// The same axis, moved.
    pub(crate) fn moved(&self, by: &Isometry3<f64>) -> Self {
        Self {
            direction: by.rotation * self.direction,
            through: (by * Point3::from(self.through)).coords,
            ..*self
        }
    }

    /// The motion of a joint about this axis by a position, rad or m.
    pub(crate) fn motion(&self, position: f64) -> Isometry3<f64> {
        if self.slides {
            return Translation3::from(self.direction * position).into();
        }
        let turn = UnitQuaternion::from_axis_angle(&Unit::new_unchecked(self.direction), position);
        Isometry3::from_parts(Translation3::from(self.through - turn * self.through), turn)
    }

    /// How far the axis is from another one with the same direction: the angle, rad, and the distance at the point of this
    /// axis, m.
    pub(crate) fn difference(&self, other: &Self) -> (f64, f64) {
        let angle =
            libm::atan2(self.direction.cross(&other.direction).norm(), self.direction.dot(&other.direction));
        let distance = if self.slides { 0.0 } else { other.across(self.through - other.through).norm() };
        (angle, distance)
    }

    /// The part of a vector across the axis.
    fn across(&self, vector: Vector3<f64>) -> Vector3<f64> {
        vector - self.direction * self.direction.dot(&vector)
    }

    /// The shortest vector from this axis to another line.
    fn normal_to(&self, line: &Self) -> Vector3<f64> {
        let across = self.direction.cross(&line.direction);
        let between = line.through - self.through;
        if across.norm() < PARALLEL {
            self.across(between)
        } else {
            across * (between.dot(&across) / across.norm_squared())
        }
    }

    /// Coordinate along this axis of the point that is nearest to another line; `None` if the two are parallel.
    fn foot_of(&self, line: &Self) -> Option<f64> {
        let across = self.direction.cross(&line.direction);
        let between = line.through - self.through;
        (across.norm() >= PARALLEL)
            .then(|| between.cross(&line.direction).dot(&across) / across.norm_squared())
    }
}

/// The turn about `axis` that brings `line` nearest to `place`; `None` if no turn does, since both are parallel to the axis
/// and on it. A radian of direction counts as `reach_m`.
pub(crate) fn turn_towards(axis: &Axis, line: &Axis, place: &Axis, reach_m: f64) -> Option<f64> {
    let mut pairs = vec![(axis.across(line.direction) * reach_m, axis.across(place.direction) * reach_m)];
    if !line.slides {
        pairs.push((axis.normal_to(line), axis.normal_to(place)));
    }
    turn_of_vectors(&axis.direction, &pairs)
}

/// The turn about a direction that brings each first vector nearest to the second; `None` if they have no part across it.
pub(crate) fn turn_of_vectors(
    direction: &Vector3<f64>,
    pairs: &[(Vector3<f64>, Vector3<f64>)],
) -> Option<f64> {
    let (mut sine, mut cosine, mut lever) = (0.0, 0.0, 0.0_f64);
    for (from, to) in pairs {
        sine += direction.dot(&from.cross(to));
        cosine += from.dot(to) - from.dot(direction) * to.dot(direction);
        lever = lever.max(from.cross(direction).norm().min(to.cross(direction).norm()));
    }
    (lever > LEAST_LEVER_M).then(|| libm::atan2(sine, cosine))
}

/// The shift along `direction` that brings `line` nearest to `place`, along the line in that direction through
/// `through`; `None` if both are parallel to the direction, or are directions alone.
pub(crate) fn shift_towards(
    direction: &Vector3<f64>,
    through: &Vector3<f64>,
    line: &Axis,
    place: &Axis,
) -> Option<f64> {
    if line.slides {
        return None;
    }
    let along = Axis { direction: *direction, through: *through, slides: false };
    Some(along.foot_of(place)? - along.foot_of(line)?)
}
