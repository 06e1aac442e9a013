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
    if let Some(length) = xyz.into_iter().find(|length| length.abs() > LARGEST_PLAUSIBLE_M) {
        let (code, what, kind) = if parent.has_tag_name("inertial") {
            let far = display::length(Vector3::from(xyz).norm());
            let what = format!("its centre of mass is {far} away from it");
            (CENTER_OF_MASS, what, "links have a centre of mass that is far away, of")
        } else {
            let what = format!("origin {length} is more than {LARGEST_PLAUSIBLE_M} m away");
            (TOO_FAR, what, "origins are more than 10 m away, of")
        };
        diagnostics.push(
            Diagnostic::warning(code, format!("{}: {what}", label(owner)))
                .one_of(kind, label(owner))
                .at(place(parent, "origin"))
                .with_help("millimetres instead of metres?"),
        );
    }
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

/// Normalised as urdfdom does; the pass against the grammar has checked the numbers.
fn from_quaternion(text: &str) -> Option<UnitQuaternion<f64>> {
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|token| token.parse().ok()).collect();
    let [x, y, z, w] = numbers[..] else { return None };
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), f64::MIN_POSITIVE)
}
