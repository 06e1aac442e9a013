//! How far the poses of bodies and the axes of joints may be from the truth because of the digits that they are written with.

use congruent_input::{
    TypedNumber, half_places, half_places_of_point, half_places_of_values,
    units::{Unit, UnitSystem},
};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use crate::{
    model::{MjInertial, MjJoint, MjJointKind, MjModel, MjNotation, MjWritten},
    read::orientation_of,
};

/// Step of the central differences of an orientation, in the unit of the file: truncation and rounding are 1e-10 of a turn.
const STEP: f64 = 1e-5;

/// The most that a whole component is off, as a zero of an angle. Kind: choice.
const MOST_OF_WHOLE: f64 = 5e-5;
/// Turns by a smaller share of the change of a component are rounding of the differences.
const NO_TURN: f64 = 1e-3;

/// What half of the last place of each written number of a body, or of a frame, changes in its pose, in the frame around it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MjBodyRounding {
    /// Shift of `pos` along x, y, z, m.
    pub pos_m: [f64; 3],
    /// Turns, rad, about the origin of the body: one for each number of its orientation.
    pub turns_rad: Vec<Vector3<f64>>,
}

/// The same of a joint.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MjJointRounding {
    /// Shift of `pos` along x, y, z, m.
    pub pos_m: [f64; 3],
    /// Change of the components of `axis`.
    pub axis: [f64; 3],
}

/// The same of an `<inertial>`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MjInertialRounding {
    /// Half of the last place of the mass, kg.
    pub mass_kg: f64,
    /// Shift of `pos` along x, y, z, m.
    pub pos_m: Vector3<f64>,
    /// Half of the last place of the entries of the tensor, kg m^2.
    pub inertia_kg_m2: Matrix3<f64>,
    /// Turns of the inertial frame, rad, one for each number of its orientation.
    pub turns_rad: Vec<Vector3<f64>>,
}

/// Half of the last place of the values of a joint that are neither of its pose nor of its axis.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MjValueRounding {
    /// Those of `range`, rad or m.
    pub range: [f64; 2],
    /// The larger of those of the efforts, N m or N.
    pub effort: f64,
    /// Those of `damping`, `frictionloss` and `armature`.
    pub terms: [f64; 3],
}

impl MjInertial {
    /// What half of the last place of each of its numbers changes.
    pub fn rounding(&self) -> MjInertialRounding {
        let pos_m = three(&half_places_of_point(&numbers(text(&self.pos))));
        let moments: Vec<&str> = text(&self.inertia).split_whitespace().collect();
        let halves = half_places_of_values(&moments);
        let inertia_kg_m2 = match halves[..] {
            [xx, yy, zz] => Matrix3::from_diagonal(&Vector3::new(xx, yy, zz)),
            [xx, yy, zz, xy, xz, yz] => Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
            _ => Matrix3::zeros(),
        };
        MjInertialRounding {
            mass_kg: half_places_of_values(&[text(&self.mass)])[0],
            pos_m: pos_m.into(),
            inertia_kg_m2,
            turns_rad: turns(&self.orientation, &self.notation, 0.0),
        }
    }
}

impl MjJoint {
    /// Half of the last place of its values.
    pub fn value_rounding(&self) -> MjValueRounding {
        let is_slide = self.kind == MjJointKind::Slide;
        let (unit, units) =
            if is_slide { (Unit::Length, UnitSystem::Si) } else { (Unit::Angle, self.notation.angle_unit()) };
        let range = self.range.as_ref().map_or_else(Vec::new, |range| numbers(text(range)));
        let range: Vec<TypedNumber<'_>> = range.iter().map(|of| TypedNumber { units, ..*of }).collect();
        // As 2.9 for 2.90, whatever the other end has; of degrees whole ones are exact.
        let least = |of: &TypedNumber<'_>| match of.units {
            UnitSystem::Si => half_places_of_values(&[of.text])[0],
            UnitSystem::Engineering => 0.0,
        };
        let halves = half_places(unit, &range).into_iter().zip(&range);
        let range: Vec<f64> = halves.map(|(half, of)| half.max(least(of))).collect();
        let first = |text: &str| half_places_of_values(&[text.split_whitespace().next().unwrap_or("")])[0];
        // With a gear or several actuators the limit is no written number.
        let effort = self.actuator_force_range.as_ref().map_or(0.0, |of| {
            let typed: Vec<&str> = text(of).split_whitespace().collect();
            half_places_of_values(&typed).into_iter().fold(0.0, f64::max)
        });
        MjValueRounding {
            range: std::array::from_fn(|at| range.get(at).copied().unwrap_or_default()),
            effort,
            terms: [
                first(text(&self.damping)),
                first(text(&self.friction_loss)),
                first(text(&self.armature)),
            ],
        }
    }
}

impl MjModel {
    /// The rounding of each body.
    pub fn body_roundings(&self) -> Vec<MjBodyRounding> {
        let mut all = self.pose_roundings();
        all.truncate(self.bodies.len());
        all
    }

    /// The rounding of each frame.
    pub fn frame_roundings(&self) -> Vec<MjBodyRounding> {
        self.pose_roundings().split_off(self.bodies.len())
    }

    /// The rounding of each body, then of each frame: their lengths are those of one file.
    fn pose_roundings(&self) -> Vec<MjBodyRounding> {
        let bodies = self.bodies.iter().map(|of| (&of.pos, &of.orientation, &of.notation));
        let frames = self.frames.iter().map(|of| (&of.pos, &of.orientation, &of.notation));
        let all: Vec<_> = bodies.chain(frames).collect();
        let positions = of_lengths(&all.iter().map(|(pos, ..)| text(pos)).collect::<Vec<_>>());
        let of_whole = self.half_of_whole_directions();
        let turns = all.iter().map(|(_, orientation, notation)| turns(orientation, notation, of_whole));
        let both = positions.into_iter().zip(turns);
        both.map(|(pos_m, turns_rad)| MjBodyRounding { pos_m, turns_rad }).collect()
    }

    /// Half of the last place of whole components of quaternions, as `0 0 1 0`: they are as fine as those of the others, and exact if
    /// all are whole.
    fn half_of_whole_directions(&self) -> f64 {
        let bodies = self.bodies.iter().map(|body| &body.orientation);
        let orientations = bodies.chain(self.frames.iter().map(|frame| &frame.orientation));
        let places = orientations.filter_map(|of| of.place.as_ref()).filter(|place| place.key == "quat");
        let halves = places.flat_map(|place| of_direction(&numbers(place.text()), 0.0));
        let finest = halves.filter(|half| *half > 0.0).fold(f64::INFINITY, f64::min);
        if finest.is_finite() { finest.min(MOST_OF_WHOLE) } else { 0.0 }
    }

    /// The rounding of each joint.
    pub fn joint_roundings(&self) -> Vec<MjJointRounding> {
        let positions =
            of_lengths(&self.joints.iter().map(|joint| text(&joint.pos_in_body)).collect::<Vec<_>>());
        let axis = |joint: &MjJoint| three(&of_direction(&numbers(text(&joint.axis_in_body)), 0.0));
        positions
            .into_iter()
            .zip(&self.joints)
            .map(|(pos_m, of)| MjJointRounding { pos_m, axis: axis(of) })
            .collect()
    }
}

/// The text of a value; empty if no file states it.
fn text<T>(value: &MjWritten<T>) -> &str {
    value.place.as_ref().map_or("", |place| place.text())
}

fn numbers(text: &str) -> Vec<TypedNumber<'_>> {
    text.split_whitespace().map(|text| TypedNumber { text, units: UnitSystem::Si }).collect()
}

/// The half places of three numbers; 0 for those that are missing.
fn three(halves: &[f64]) -> [f64; 3] {
    std::array::from_fn(|at| halves.get(at).copied().unwrap_or_default())
}

/// Half places of x, y, z of all positions: zeros are as fine as the others of the file.
fn of_lengths(texts: &[&str]) -> Vec<[f64; 3]> {
    let numbers_of: Vec<Vec<TypedNumber<'_>>> = texts.iter().map(|text| numbers(text)).collect();
    let mut halves = half_places(Unit::Length, &numbers_of.concat()).into_iter();
    let of = |numbers: &Vec<TypedNumber<'_>>| {
        let halves: Vec<f64> = halves.by_ref().take(numbers.len()).collect();
        three(&halves)
    };
    numbers_of.iter().map(of).collect()
}

/// Half places of the components of a direction or a quaternion; `of_whole` if all are whole, as `0 0 1`.
fn of_direction(numbers: &[TypedNumber<'_>], of_whole: f64) -> Vec<f64> {
    let is_whole =
        |number: &TypedNumber<'_>| number.text.parse::<f64>().is_ok_and(|component| component.fract() == 0.0);
    if numbers.iter().all(is_whole) {
        vec![of_whole; numbers.len()]
    } else {
        half_places(Unit::Angle, numbers)
    }
}

/// The turns that half of the last place of each number of an orientation makes.
fn turns(
    orientation: &MjWritten<UnitQuaternion<f64>>,
    notation: &MjNotation,
    of_whole: f64,
) -> Vec<Vector3<f64>> {
    let Some(place) = &orientation.place else { return Vec::new() };
    let written = numbers(place.text());
    let mut values = [0.0; 6];
    for (value, number) in values.iter_mut().zip(&written) {
        *value = number.text.parse().unwrap_or_default();
    }
    let rotation = |at: usize, by: f64| {
        let mut values = values;
        values[at] += by;
        orientation_of(&place.key, values, notation).ok()
    };
    let turn = |(at, half): (usize, f64)| {
        let [up, down] = [STEP, -STEP].map(|by| rotation(at, by));
        let turn = (up? * down?.inverse()).scaled_axis() * (half / (2.0 * STEP));
        // A component of a quaternion that is all of it turns nothing.
        (turn.norm() > NO_TURN * half).then_some(turn)
    };
    let halves = halves_of_orientation(&place.key, &written, notation, of_whole).into_iter().enumerate();
    halves.filter(|(_, half)| *half > 0.0).filter_map(turn).collect()
}

/// Half places of the numbers of an orientation, in the unit of the file: first components of directions, then angles.
fn halves_of_orientation(
    key: &str,
    written: &[TypedNumber<'_>],
    notation: &MjNotation,
    of_whole: f64,
) -> Vec<f64> {
    let components = match key {
        "euler" => 0,
        "axisangle" => 3,
        _ => written.len(),
    };
    let (directions, angles) = written.split_at(components.min(written.len()));
    let units = notation.angle_unit();
    let angles: Vec<TypedNumber<'_>> = angles.iter().map(|of| TypedNumber { units, ..*of }).collect();
    let of_angles = half_places(Unit::Angle, &angles).into_iter().map(|half| half / notation.angle_rad(1.0));
    // Only of quaternions: another direction is one by design.
    let of_whole = if key == "quat" { of_whole } else { 0.0 };
    of_direction(directions, of_whole).into_iter().chain(of_angles).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use congruent_input::{Diagnostics, SourceFile};

    use super::*;

    /// The half places of the second body of a model.
    fn rounding(compiler: &str, body: &str) -> MjBodyRounding {
        let text = format!(
            "<mujoco><compiler {compiler}/><worldbody><body name='a' pos='0.1234 0 1'/><body name='b' {body}/></worldbody></mujoco>"
        );
        let main = SourceFile { path: "a.xml".into(), text, is_foreign: false };
        let mut diagnostics = Diagnostics::default();
        let model = crate::parse(&Arc::new(main), &mut |_| unreachable!(), &mut diagnostics).unwrap();
        model.body_roundings().swap_remove(2)
    }

    #[test]
    fn each_number_turns_by_half_of_its_last_place() {
        // By hand: a quaternion (c, s, 0, 0) with c = s turns about x by twice the change of one of its parts times c, and about
        // y and z likewise.
        let quat = rounding("", "quat='0.707107 0.707107 0 0'");
        let half = std::f64::consts::SQRT_2 * 5e-7;
        assert_eq!(Vector3::from(quat.pos_m), Vector3::zeros());
        assert_eq!(quat.turns_rad.len(), 4);
        for turn in &quat.turns_rad[..2] {
            assert!((turn.x.abs() / half - 1.0).abs() < 1e-5 && turn.yz().norm() < 1e-12, "{turn}");
        }
        assert!((quat.turns_rad[2].norm() / (2.0 * 5e-7) - 1.0).abs() < 1e-5, "{}", quat.turns_rad[2]);
        assert!(rounding("", "quat='1 0 0 0'").turns_rad.is_empty());
        assert!(rounding("", "euler='90 0 -45'").turns_rad.is_empty(), "whole degrees are design angles");
        let degrees = rounding("", "euler='12.5 0 0' pos='0 0 0.52'");
        assert!(
            (degrees.turns_rad[0].x / 0.05_f64.to_radians() - 1.0).abs() < 1e-6,
            "{:?}",
            degrees.turns_rad
        );
        assert_eq!(
            Vector3::from(degrees.pos_m),
            Vector3::repeat(5e-5),
            "zeros and short values are as fine as 0.1234"
        );
        let radians = rounding("angle='radian'", "euler='0 1.5708 0'");
        assert!((radians.turns_rad[1].y / 5e-5 - 1.0).abs() < 1e-6, "{:?}", radians.turns_rad);
        let axis = rounding("", "axisangle='0 0 1 33.25'");
        assert!(
            (axis.turns_rad[0].z / 0.005_f64.to_radians() - 1.0).abs() < 1e-6 && axis.turns_rad.len() == 1
        );
    }

    #[test]
    fn frames_and_whole_quaternions_are_as_fine_as_the_others() {
        let text = "<mujoco><worldbody><body name='a' quat='0 0 1 0'/><frame quat='0.9239 0 0 0.3827' pos='0.123 0 0.34'>\
                    <frame pos='0 0 0.5'><body name='b'/></frame></frame></worldbody></mujoco>";
        let main = SourceFile { path: "a.xml".into(), text: text.to_owned(), is_foreign: false };
        let mut diagnostics = Diagnostics::default();
        let model = crate::parse(&Arc::new(main), &mut |_| unreachable!(), &mut diagnostics).unwrap();
        // By hand: a quaternion along y is turned about x and z, and not along itself, by twice the change of another component.
        let of_whole = &model.body_roundings()[1].turns_rad;
        assert_eq!(of_whole.len(), 3);
        assert!(of_whole.iter().all(|turn| (turn.norm() / 1e-4 - 1.0).abs() < 1e-5), "{of_whole:?}");
        let [outer, inner] = [0, 1].map(|at| model.frame_roundings().swap_remove(at));
        assert_eq!((outer.turns_rad.len(), inner.turns_rad.len()), (4, 0));
        assert_eq!(
            Vector3::from(outer.pos_m),
            Vector3::new(5e-4, 5e-5, 5e-4),
            "0.34 as fine as 0.123, and zeros less open"
        );
        let body = &model.bodies[2];
        assert_eq!((body.frame, model.frames[1].outer, model.frames[0].outer), (Some(1), Some(0), None));
    }
}
