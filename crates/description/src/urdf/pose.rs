//! `<origin>`: a pose, by fixed-axis angles or (from version 1.1) by a quaternion.

use std::f64::consts::TAU;

use congruent_input::{
    Capability, Diagnostic, Diagnostics, display, rotation_from_rpy_fixed_xyz,
    units::{LARGEST, LARGEST_PLAUSIBLE_M},
};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::node::{element, label, place, tag};
use crate::codes;

/// The place of an `<origin>` in the document.
#[derive(Clone, Copy)]
pub(super) struct OriginPlace<'a, 'i> {
    /// The element that it is in.
    pub(super) parent: Node<'a, 'i>,
    /// The link or joint that warnings name.
    pub(super) owner: Node<'a, 'i>,
    /// The use that cannot go on without the pose.
    pub(super) needed_by: Option<Capability>,
}

/// The pose that an `<origin>` gives; the identity if there is none.
pub(super) fn read(
    pose: &urdf_rs::Pose,
    OriginPlace { parent, owner, needed_by }: OriginPlace<'_, '_>,
    diagnostics: &mut Diagnostics,
) -> Isometry3<f64> {
    let (xyz, rpy) = (pose.xyz.0, pose.rpy.0);
    far_away(Vector3::from(xyz), OriginPlace { parent, owner, needed_by }, diagnostics);
    let translation = Translation3::from(xyz);
    let origin = element(parent, "origin");
    if let Some(quaternion) = origin.and_then(|origin| origin.attribute("quat_xyzw")) {
        let rotation = from_quaternion(quaternion).unwrap_or_else(|| {
            let message = format!("{}: quat_xyzw = \"{quaternion}\" is zero", label(owner));
            let fault = Diagnostic::error(codes::urdf::QUATERNION, message).needed_by(needed_by);
            diagnostics.push(fault.at(origin.map_or(0..0, tag)));
            UnitQuaternion::identity()
        });
        return Isometry3::from_parts(translation, rotation);
    }
    if let Some(angle) = rpy.into_iter().find(|angle| angle.abs() > TAU) {
        let message = format!("{}: rpy {angle} is more than a full turn in radians", label(owner));
        diagnostics.push(
            Diagnostic::warning(codes::urdf::DEGREES, message)
                .one_of("origins have an rpy of more than a full turn in radians", label(owner))
                .at(place(parent, "origin"))
                .with_help("degrees instead of radians?"),
        );
    }
    Isometry3::from_parts(translation, rotation_from_rpy_fixed_xyz(rpy))
}

/// Reports an offset that is implausible for a robot: a warning, or an error if poses would lose the digits that matter.
fn far_away(xyz: Vector3<f64>, place: OriginPlace<'_, '_>, diagnostics: &mut Diagnostics) {
    let largest = xyz.amax();
    if largest <= LARGEST_PLAUSIBLE_M {
        return;
    }
    // The squares of entries beyond 1e154 overflow, so the offset is divided by its largest entry first.
    let far_m = largest * (xyz / largest).norm();
    let far = display::length(far_m);
    let is_com = place.parent.has_tag_name("inertial");
    let (code, what, kind) = if is_com {
        let what = format!("its centre of mass is {far} away from its origin");
        (codes::urdf::CENTER_OF_MASS, what, "links have a centre of mass far from their origin")
    } else {
        let what = format!("origin {} m is more than {LARGEST_PLAUSIBLE_M} m away", display::number(largest));
        (codes::urdf::MILLIMETRES, what, "origins are more than 10 m away")
    };
    let owner = label(place.owner);
    let found = if far_m <= LARGEST {
        Diagnostic::warning(code, format!("{owner}: {what}")).one_of(kind, owner)
    } else {
        let message = format!("{owner}: {what}, limit <= {LARGEST:e} m");
        Diagnostic::error(code, message).needed_by(place.needed_by)
    };
    diagnostics
        .push(found.at(self::place(place.parent, "origin")).with_help("millimetres instead of metres?"));
}

/// The normalised quaternion, as urdfdom reads it; `None` if its norm is zero. The grammar pass has checked the numbers.
fn from_quaternion(text: &str) -> Option<UnitQuaternion<f64>> {
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|token| token.parse().ok()).collect();
    let [x, y, z, w] = numbers[..] else { return None };
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), f64::MIN_POSITIVE)
}
