//! The chain of a table or of screws as twists at zero in the base.

use congruent_input::{
    Diagnostic, Diagnostics, WrittenTransform, codes::toml::UNKNOWN_KEY, rotation_from_rpy_fixed_xyz,
    units::Unit,
};
use congruent_robot::{DhConvention, DhRowKind};
use nalgebra::{Isometry3, Translation3, Vector3};
use toml::Spanned;

use crate::{
    codes,
    robot_file::{WrittenDh, WrittenPoe, WrittenRow, screw_twist, space_twist},
};

/// A chain of joints from base to tip, at zero.
pub(super) struct OwnChain {
    pub(super) joints: Vec<OwnJoint>,
    pub(super) base_from_tip_at_zero: Isometry3<f64>,
}

/// A joint with its twist.
pub(super) struct OwnJoint {
    pub(super) name: Spanned<String>,
    pub(super) kind: DhRowKind,
    /// Lowest and highest position, rad or m.
    pub(super) range: Option<[f64; 2]>,
    /// Direction of the axis; 0 of a joint that slides.
    pub(super) angular_in_base: Vector3<f64>,
    /// Velocity of the point at the base's origin, m per unit of the joint.
    pub(super) linear_in_base: Vector3<f64>,
}

impl OwnChain {
    /// The chain of a table. A value that is missing or wrong counts as 0 here: the check of the rows, which follows, reports it.
    pub(super) fn of_table(
        dh: &Spanned<WrittenDh>,
        text: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let table = dh.get_ref();
        if table.row.is_empty() {
            if !diagnostics.has_misspelt("row") {
                diagnostics.push(no_joint("[dh] has no [[dh.row]]", dh.span().start, text));
            }
            return None;
        }
        let constant = |written: &Option<Spanned<WrittenTransform>>| {
            let isometry = written.as_ref().map(|written| written.get_ref().isometry());
            isometry.and_then(Result::ok).unwrap_or_else(Isometry3::identity)
        };
        let is_modified = table.convention.as_ref().is_some_and(|of| *of.get_ref() == DhConvention::Modified);
        let mut base_from_here = constant(&table.base_from_dh0);
        let mut joints = Vec::with_capacity(table.row.len());
        for row in table.row.iter().map(Spanned::get_ref) {
            let [motion, link] = transforms(row);
            // The axis is z of the frame before the motion, in the modified convention behind Tx(a) Rx(alpha).
            let base_from_axis = if is_modified { base_from_here * link } else { base_from_here };
            let along = base_from_axis.rotation * Vector3::z() * sign(row);
            let at = base_from_axis.translation.vector;
            let kind = *row.kind.get_ref();
            let [angular_in_base, linear_in_base] = match kind {
                DhRowKind::Revolute => [along, at.cross(&along)],
                DhRowKind::Prismatic => [Vector3::zeros(), along],
            };
            let range = diagnostics.keep(row.range().read(row.joint.get_ref(), kind)).flatten();
            joints.push(OwnJoint { name: row.joint.clone(), kind, range, angular_in_base, linear_in_base });
            base_from_here *= if is_modified { link * motion } else { motion * link };
        }
        Some(Self { joints, base_from_tip_at_zero: base_from_here * constant(&table.dhn_from_tip) })
    }

    /// The chain of screws; `None` if one of them is wrong.
    pub(super) fn of_screws(poe: &Spanned<WrittenPoe>, diagnostics: &mut Diagnostics) -> Option<Self> {
        let written = poe.get_ref();
        if written.joint.is_empty() {
            if !diagnostics.has_misspelt("joint") {
                let fault = Diagnostic::error(codes::robot_file::MISSING_ROW, "[poe] has no [[poe.joint]]");
                diagnostics.push(
                    fault.at(written.frame.span()).with_help("add an entry for each joint, from base to tip"),
                );
            }
            return None;
        }
        let home = diagnostics.keep(written.home.get_ref().isometry());
        let joint = |screw| {
            // A part under an unknown key is reported already: that it is missing would say it twice.
            let has_unknown_key = diagnostics.any(|found| found.code == UNKNOWN_KEY);
            let twist = match screw_twist(screw) {
                Err(_) if has_unknown_key => None,
                read => diagnostics.keep(read),
            };
            let screw = screw.get_ref();
            let kind = *screw.kind.get_ref();
            let range = diagnostics.keep(screw.range().read(screw.joint.get_ref(), kind));
            let [angular_in_base, linear_in_base] = space_twist(twist?, *written.frame.get_ref(), &home?);
            Some(OwnJoint { name: screw.joint.clone(), kind, range: range?, angular_in_base, linear_in_base })
        };
        // All are read before the first that is wrong ends the check, so that each fault is reported.
        let joints: Vec<Option<OwnJoint>> = written.joint.iter().map(joint).collect();
        let joints = joints.into_iter().collect::<Option<_>>()?;
        Some(Self { joints, base_from_tip_at_zero: home? })
    }
}

fn no_joint(message: &str, start: usize, text: &str) -> Diagnostic {
    let end = text[start..].find('\n').map_or(text.len(), |length| start + length);
    Diagnostic::error(codes::robot_file::MISSING_ROW, message)
        .at(start..end)
        .with_help("add a row for each joint, from base to tip")
}

/// `Rz(theta) Tz(d)` and `Tx(a) Rx(alpha)` of a row at position 0.
fn transforms(row: &WrittenRow) -> [Isometry3<f64>; 2] {
    let value = |unit: Unit, si: &Option<Spanned<f64>>, engineering: &Option<Spanned<f64>>| {
        unit.value("", si.as_ref(), engineering.as_ref()).ok().flatten().unwrap_or_default()
    };
    let (a, alpha) =
        (value(Unit::Length, &row.a_m, &row.a_mm), value(Unit::Angle, &row.alpha_rad, &row.alpha_deg));
    let (d, theta) =
        (value(Unit::Length, &row.d_m, &row.d_mm), value(Unit::Angle, &row.theta_rad, &row.theta_deg));
    let transform =
        |xyz: [f64; 3], rpy| Isometry3::from_parts(Translation3::from(xyz), rotation_from_rpy_fixed_xyz(rpy));
    // A turn and a shift about and along one axis commute.
    [transform([0.0, 0.0, d], [0.0, 0.0, theta]), transform([a, 0.0, 0.0], [alpha, 0.0, 0.0])]
}

/// The sign of the joint's position in the row.
fn sign(row: &WrittenRow) -> f64 {
    row.sign.as_ref().map_or(1.0, |sign| sign.get_ref().signum())
}
