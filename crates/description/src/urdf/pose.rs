//! `<origin>`: a pose, by fixed-axis angles or (from version 1.1) by a quaternion.

use std::f64::consts::TAU;

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::node::{element, label, place, tag};
use crate::{
    diagnostic::{Diagnostic, Diagnostics, Use},
    display,
    written::rpy::rotation_from_rpy_fixed_xyz,
};

/// Longer offsets between the parts of one robot are taken for millimetres.
pub(crate) const LARGEST_PLAUSIBLE_M: f64 = 10.0;

/// The code of lengths beyond that, and of centres of mass.
pub(crate) const TOO_FAR: &str = "urdf::millimetres";
pub(crate) const CENTER_OF_MASS: &str = "urdf::center_of_mass";

/// Where an `<origin>` is.
#[derive(Clone, Copy)]
pub(super) struct Place<'a, 'i> {
    /// The element that it is in.
    pub(super) parent: Node<'a, 'i>,
    /// The link or joint that warnings name.
    pub(super) owner: Node<'a, 'i>,
    /// The use that cannot go on without the pose.
    pub(super) needed_by: Option<Use>,
}

/// The pose that an `<origin>` gives; the identity if there is none.
pub(super) fn read(
    pose: &urdf_rs::Pose,
    Place { parent, owner, needed_by }: Place<'_, '_>,
    diagnostics: &mut Diagnostics,
) -> Isometry3<f64> {
    let (xyz, rpy) = (pose.xyz.0, pose.rpy.0);
    far_away(Vector3::from(xyz), Place { parent, owner, needed_by }, diagnostics);
    let translation = Translation3::from(xyz);
    let origin = element(parent, "origin");
    if let Some(quaternion) = origin.and_then(|origin| origin.attribute("quat_xyzw")) {
        let rotation = from_quaternion(quaternion).unwrap_or_else(|| {
            let message = format!("{}: quat_xyzw = \"{quaternion}\" is zero", label(owner));
            let fault = Diagnostic::error("urdf::quaternion", message).needed_by(needed_by);
            diagnostics.push(fault.at(origin.map_or(0..0, tag)));
            UnitQuaternion::identity()
        });
        return Isometry3::from_parts(translation, rotation);
    }
    if let Some(angle) = rpy.into_iter().find(|angle| angle.abs() > TAU) {
        let message = format!("{}: rpy {angle} is more than a full turn in radians", label(owner));
        diagnostics.push(
            Diagnostic::warning("urdf::degrees", message)
                .one_of("origins have an rpy of more than a full turn in radians, of", label(owner))
                .at(place(parent, "origin"))
                .with_help("degrees instead of radians?"),
        );
    }
    Isometry3::from_parts(translation, rotation_from_rpy_fixed_xyz(rpy))
}

/// Tells of an offset that no robot has.
fn far_away(xyz: Vector3<f64>, place: Place<'_, '_>, diagnostics: &mut Diagnostics) {
    let largest = xyz.amax();
    if largest <= LARGEST_PLAUSIBLE_M {
        return;
    }
    // The squares of entries beyond 1e154 overflow, so the largest entry goes first.
    let far_m = largest * (xyz / largest).norm();
    let far = display::length(far_m);
    let is_com = place.parent.has_tag_name("inertial");
    let (code, what, kind) = if is_com {
        let what = format!("its centre of mass is {far} away from it");
        (CENTER_OF_MASS, what, "links have a centre of mass that is far away, of")
    } else {
        let what = format!("origin {} is more than {LARGEST_PLAUSIBLE_M} m away", display::number(largest));
        (TOO_FAR, what, "origins are more than 10 m away, of")
    };
    let owner = label(place.owner);
    let found = if (far_m * far_m).is_finite() {
        Diagnostic::warning(code, format!("{owner}: {what}")).one_of(kind, owner)
    } else {
        let why = if is_com { "its inertia about the joint" } else { "its squared distance" };
        let message = format!("{owner}: {what}, so far that {why} is no finite number");
        Diagnostic::error(code, message).needed_by(place.needed_by)
    };
    diagnostics
        .push(found.at(self::place(place.parent, "origin")).with_help("millimetres instead of metres?"));
}

/// Normalised as urdfdom does; the pass against the grammar has checked the numbers.
fn from_quaternion(text: &str) -> Option<UnitQuaternion<f64>> {
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|token| token.parse().ok()).collect();
    let [x, y, z, w] = numbers[..] else { return None };
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), f64::MIN_POSITIVE)
}
