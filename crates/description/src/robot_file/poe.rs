//! `[poe]` of a robot file: the chain as a product of exponentials, one twist for each joint and the pose of the tip at zero.

use congruent_input::{
    Diagnostic, WrittenTransform,
    display::length,
    fixed_array,
    number::significant_components,
    units::{Unit, check_finite},
};
use congruent_robot::DhRowKind;
use nalgebra::{Isometry3, Vector3};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use super::range::WrittenRange;
use crate::codes;

/// How far the length of a written direction may be from 1, and a written pitch from 0 m/rad. Kind: six digits in the file; a
/// larger deviation is an error that normalising would hide.
const WRITTEN_UNIT: f64 = 1e-6;

/// The frame of the twists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ScrewFrame {
    /// `T(q) = exp([S_1] q_1) ... exp([S_n] q_n) M`: twists in the base (Lynch and Park 2017, eq. 4.14).
    Space,
    /// `T(q) = M exp([B_1] q_1) ... exp([B_n] q_n)`: twists in the tip at zero (Lynch and Park 2017, eq. 4.16).
    Body,
}

/// The chain from base to tip as screws, which are the robot: all joints at zero.
#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "PoeScrews")]
pub(crate) struct WrittenPoe {
    /// The frame of the twists: the base (`space`) or the tip (`body`).
    #[schemars(with = "ScrewFrame")]
    pub(crate) frame: Spanned<ScrewFrame>,
    /// The publication that the values are from.
    #[serde(default, rename = "source")]
    #[schemars(with = "String")]
    pub(crate) _source: Option<String>,
    /// The pose of the tip in the base if all joints are at zero.
    #[schemars(with = "WrittenTransform")]
    pub(crate) home: Spanned<WrittenTransform>,
    /// One entry for each joint, from base to tip.
    #[serde(default)]
    #[schemars(with = "Vec<WrittenScrew>")]
    pub(crate) joint: Vec<Spanned<WrittenScrew>>,
}

/// The screw of a joint: its twist (`omega` and `v_m`), or its axis and a point on it.
#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "PoeJoint")]
pub(crate) struct WrittenScrew {
    /// The name that the joint is given.
    #[schemars(with = "String")]
    pub(crate) joint: Spanned<String>,
    /// Whether the joint turns about its axis or slides along it.
    #[schemars(with = "DhRowKind")]
    pub(crate) kind: Spanned<DhRowKind>,
    /// Angular part of the twist: the direction of the axis, of length 1; of a prismatic joint 0 or left out.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub(crate) omega: Option<Spanned<[f64; 3]>>,
    /// Linear part of the twist: `-omega x q` for a point q of the axis, in metres per radian; of a prismatic joint its direction.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub(crate) v_m: Option<Spanned<[f64; 3]>>,
    /// Direction of the axis, of length 1, in the place of `omega` and `v_m`.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub(crate) axis: Option<Spanned<[f64; 3]>>,
    /// A point on the axis in metres, with `axis`, of a joint that turns.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub(crate) point_m: Option<Spanned<[f64; 3]>>,
    /// A point on the axis in millimetres, with `axis`, of a joint that turns.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub(crate) point_mm: Option<Spanned<[f64; 3]>>,
    /// Lowest and highest position in radians, of a joint that turns; without it the joint turns freely.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 2]")]
    pub(crate) range_rad: Option<Spanned<[f64; 2]>>,
    /// Lowest and highest position in degrees, of a joint that turns.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 2]")]
    pub(crate) range_deg: Option<Spanned<[f64; 2]>>,
    /// Lowest and highest position in metres, of a joint that slides.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 2]")]
    pub(crate) range_m: Option<Spanned<[f64; 2]>>,
    /// Lowest and highest position in millimetres, of a joint that slides.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 2]")]
    pub(crate) range_mm: Option<Spanned<[f64; 2]>>,
}

impl WrittenScrew {
    /// The range of the joint as it is written.
    pub(crate) fn range(&self) -> WrittenRange<'_> {
        let Self { range_rad, range_deg, range_m, range_mm, .. } = self;
        let [rad, deg, m, mm] = [range_rad, range_deg, range_m, range_mm].map(Option::as_ref);
        WrittenRange { rad, deg, m, mm }
    }
}

/// Angular and linear part of a twist: rad and m per unit of the joint.
pub(crate) type WrittenTwist = [Vector3<f64>; 2];

/// The twist of a joint in the frame in which it is written; `halves` are half of the last place of the components of its direction,
/// and of `v_m` or of its point, in m.
pub(crate) fn screw_twist(
    written: &Spanned<WrittenScrew>,
    halves: &[Vector3<f64>; 2],
) -> Result<WrittenTwist, Diagnostic> {
    let screw = written.get_ref();
    let name = screw.joint.get_ref();
    let refused = |message: String, help: &str| {
        let message = format!("joint \"{name}\" {message}");
        Err(Diagnostic::error(codes::robot_file::SCREW, message).at(screw.joint.span()).with_help(help))
    };
    let is_revolute = *screw.kind.get_ref() == DhRowKind::Revolute;
    let point = Unit::Length.vector("point", screw.point_m.as_ref(), screw.point_mm.as_ref())?;
    match (&screw.axis, &screw.omega, &screw.v_m) {
        (Some(_), Some(_), _) | (Some(_), _, Some(_)) => refused(
            "has both an axis and a twist".to_owned(),
            "keep `axis` with a point on it, or `omega` and `v_m`",
        ),
        (Some(axis), None, None) => {
            let axis = unit_vector("axis", axis, name, &halves[0])?;
            match (is_revolute, point) {
                (true, Some(point)) => Ok([axis, Vector3::from(point).cross(&axis)]),
                (true, None) => {
                    refused("has an axis without a point on it".to_owned(), "for example point_m = [0, 0, 0]")
                }
                (false, None) => Ok([Vector3::zeros(), axis]),
                (false, Some(_)) => {
                    refused("slides, so a point on its axis has no meaning".to_owned(), "remove the point")
                }
            }
        }
        _ if point.is_some() => {
            refused("has a point without an axis".to_owned(), "for example axis = [0, 0, 1]")
        }
        (None, omega, Some(linear)) if is_revolute => match omega {
            Some(omega) => turning(omega, linear, name, halves),
            None => refused(
                "is revolute, but has no omega".to_owned(),
                "omega is the direction of its axis, for example omega = [0, 0, 1]",
            ),
        },
        (None, omega, Some(linear)) => sliding(omega.as_ref(), linear, name, &halves[0]),
        (None, _, None) => refused(
            "has no screw: v_m is missing".to_owned(),
            "write omega = [0, 0, 1] and v_m = [0, 0, 0], or axis = [0, 0, 1] and point_m = [0, 0, 0]",
        ),
    }
}

/// The twist of a joint that turns; one that advances as it turns is no joint of a robot here.
fn turning(
    omega: &Spanned<[f64; 3]>,
    linear: &Spanned<[f64; 3]>,
    joint: &str,
    [of_omega, of_linear]: &[Vector3<f64>; 2],
) -> Result<WrittenTwist, Diagnostic> {
    if omega.get_ref().iter().all(|component| *component == 0.0) {
        let message = format!("joint \"{joint}\" is revolute, but its omega is 0");
        return Err(Diagnostic::error(codes::robot_file::SCREW, message)
            .at(omega.span())
            .with_help("omega is the direction of the axis; a joint that slides has kind = \"prismatic\""));
    }
    let axis = unit_vector("omega", omega, joint, of_omega)?;
    let moment = Vector3::from(Unit::Length.vector("v", Some(linear), None)?.unwrap_or_default());
    let pitch = axis.dot(&moment);
    let by_digits = axis.abs().dot(of_linear) + moment.abs().dot(of_omega);
    if pitch.abs() <= WRITTEN_UNIT + by_digits {
        return Ok([axis, moment - axis * pitch]);
    }
    let without = significant_components((moment - axis * pitch).into()).join(", ");
    let message = format!(
        "joint \"{joint}\" advances by {} per radian as it turns: a screw with a pitch is not supported",
        length(pitch)
    );
    Err(Diagnostic::error(codes::robot_file::SCREW, message)
        .at(linear.span())
        .with_help(format!("v_m = -omega x q is perpendicular to omega; did you mean v_m = [{without}]?")))
}

fn sliding(
    omega: Option<&Spanned<[f64; 3]>>,
    linear: &Spanned<[f64; 3]>,
    joint: &str,
    of_direction: &Vector3<f64>,
) -> Result<WrittenTwist, Diagnostic> {
    if let Some(omega) = omega.filter(|omega| omega.get_ref().iter().any(|part| *part != 0.0)) {
        let message = format!("joint \"{joint}\" is prismatic, but its omega is not 0");
        return Err(Diagnostic::error(codes::robot_file::SCREW, message)
            .at(omega.span())
            .with_help("a joint that slides has omega = [0, 0, 0] and its direction in v_m; one that turns has kind = \"revolute\""));
    }
    Ok([Vector3::zeros(), unit_vector("v_m", linear, joint, of_direction)?])
}

/// A written direction; one that is not of length 1 within its digits is refused.
fn unit_vector(
    key: &str,
    written: &Spanned<[f64; 3]>,
    joint: &str,
    halves: &Vector3<f64>,
) -> Result<Vector3<f64>, Diagnostic> {
    written.get_ref().iter().try_for_each(|value| check_finite(key, *value, written.span()))?;
    let vector = Vector3::from(*written.get_ref());
    let norm = vector.norm();
    if (norm - 1.0).abs() <= WRITTEN_UNIT + vector.abs().dot(halves) {
        return Ok(vector / norm);
    }
    let message = format!("joint \"{joint}\": {key} has length {norm:.6}, expected a unit vector");
    let fault = Diagnostic::error(codes::robot_file::SCREW, message).at(written.span());
    let direction = (norm > 0.0 && norm.is_finite()).then(|| (vector / norm).into());
    Err(match direction {
        Some(direction) => fault
            .with_help(format!("did you mean {key} = [{}]?", significant_components(direction).join(", "))),
        None => fault.with_help(format!("for example {key} = [0, 0, 1]")),
    })
}

/// A twist in the base: one in the tip is moved there by the pose of the tip at zero.
///
/// Source: Lynch & Park, *Modern Robotics* (2017), eq. 3.83: `S = Ad(M) B`.
pub(crate) fn space_twist(
    [angular, linear]: WrittenTwist,
    frame: ScrewFrame,
    base_from_tip_at_zero: &Isometry3<f64>,
) -> WrittenTwist {
    let base_from_twist = base_from_twist(frame, base_from_tip_at_zero);
    let angular = base_from_twist.rotation * angular;
    let at = base_from_twist.translation.vector;
    [angular, base_from_twist.rotation * linear + at.cross(&angular)]
}

/// The frame of the twists in the base.
pub(crate) fn base_from_twist(frame: ScrewFrame, base_from_tip_at_zero: &Isometry3<f64>) -> Isometry3<f64> {
    match frame {
        ScrewFrame::Space => Isometry3::identity(),
        ScrewFrame::Body => *base_from_tip_at_zero,
    }
}
