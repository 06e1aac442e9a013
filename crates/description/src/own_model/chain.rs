//! The chain of a table or of screws as twists at zero in the base.

use std::sync::Arc;

use congruent_input::{
    Diagnostic, Diagnostics, SourceFile, WrittenTransform, codes::toml::UNKNOWN_KEY,
    rotation_from_rpy_fixed_xyz, units::Unit,
};
use congruent_robot::{DhConvention, DhRowKind, JointForm, JointRounding, motions_of_pose};
use nalgebra::{Isometry3, Translation3, Vector3};
use toml::Spanned;

use super::rounding::{ScrewDigits, along_x, along_z};
use crate::{
    codes,
    robot_file::{
        RobotFilePlaces, ScrewFrame, WrittenDh, WrittenPoe, WrittenRow, WrittenScrew, base_from_twist,
        screw_twist, space_twist,
    },
};

/// A chain of joints from base to tip, at zero.
pub(super) struct OwnChain {
    pub(super) joints: Vec<OwnJoint>,
    pub(super) base_from_tip_at_zero: Isometry3<f64>,
    /// What the digits leave open of the tip alone, in the base.
    pub(super) rounding_of_tip: JointRounding,
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
    /// What the digits leave open, in the base.
    pub(super) rounding: JointRounding,
}

impl OwnChain {
    /// The chain of a table. A value that is missing or wrong counts as 0 here: the check of the rows, which follows, reports it.
    pub(super) fn of_table(
        dh: &Spanned<WrittenDh>,
        robot_file: &Arc<SourceFile>,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let table = dh.get_ref();
        if table.row.is_empty() {
            if !diagnostics.has_misspelt("row") {
                diagnostics.push(no_joint("[dh] has no [[dh.row]]", dh.span().start, &robot_file.text));
            }
            return None;
        }
        let constant = |written: &Option<Spanned<WrittenTransform>>| {
            let isometry = written.as_ref().map(|written| written.get_ref().isometry());
            isometry.and_then(Result::ok).unwrap_or_else(Isometry3::identity)
        };
        let is_modified = table.convention.as_ref().is_some_and(|of| *of.get_ref() == DhConvention::Modified);
        let form = if is_modified { JointForm::ModifiedRow } else { JointForm::StandardRow };
        let digits = RobotFilePlaces::new(Arc::clone(robot_file), dh.clone(), None).digits();
        let mut base_from_here = constant(&table.base_from_dh0);
        // What moves the next axis and all behind it.
        let mut open = motions_of_pose(digits.base, &base_from_here);
        let mut joints = Vec::with_capacity(table.row.len());
        for (row, [a, alpha, d, theta]) in table.row.iter().map(Spanned::get_ref).zip(digits.rows) {
            let [motion, link] = transforms(row);
            if is_modified {
                open.extend(along_x([a, alpha], &base_from_here));
            }
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
            let rounding =
                JointRounding { origin: std::mem::take(&mut open), form, ..JointRounding::default() };
            let name = row.joint.clone();
            joints.push(OwnJoint { name, kind, range, angular_in_base, linear_in_base, rounding });
            open.extend(along_z([d, theta], &base_from_axis));
            if !is_modified {
                open.extend(along_x([a, alpha], &(base_from_here * motion)));
            }
            base_from_here *= if is_modified { link * motion } else { motion * link };
        }
        let dhn_from_tip = constant(&table.dhn_from_tip);
        let of_tip = motions_of_pose(digits.tool, &dhn_from_tip).into_iter();
        open.extend(of_tip.map(|motion| motion.expressed_in(&base_from_here)));
        let rounding_of_tip = JointRounding { origin: open, form, ..JointRounding::default() };
        Some(Self { joints, base_from_tip_at_zero: base_from_here * dhn_from_tip, rounding_of_tip })
    }

    /// The chain of screws; `None` if one of them is wrong.
    pub(super) fn of_screws(
        poe: &Spanned<WrittenPoe>,
        text: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
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
        let digits = ScrewDigits::new(written, text);
        let joint = |(index, screw)| {
            // A part under an unknown key is reported already: that it is missing would say it twice.
            let has_unknown_key = diagnostics.any(|found| found.code == UNKNOWN_KEY);
            let twist = match screw_twist(screw, digits.of_joint(index)) {
                Err(_) if has_unknown_key => None,
                read => diagnostics.keep(read),
            };
            let screw = screw.get_ref();
            let kind = *screw.kind.get_ref();
            let range = diagnostics.keep(screw.range().read(screw.joint.get_ref(), kind));
            let (twist, home, name) = (twist?, home?, screw.joint.clone());
            let [angular_in_base, linear_in_base] = space_twist(twist, *written.frame.get_ref(), &home);
            let base_from_twist = base_from_twist(*written.frame.get_ref(), &home);
            let axis = digits.of_axis(index, screw, twist).into_iter();
            let axis = axis.map(|motion| motion.expressed_in(&base_from_twist)).collect();
            let rounding = JointRounding {
                axis,
                form: form(*written.frame.get_ref(), screw),
                ..JointRounding::default()
            };
            Some(OwnJoint { name, kind, range: range?, angular_in_base, linear_in_base, rounding })
        };
        // All are read before the first that is wrong ends the check, so that each fault is reported.
        let joints: Vec<Option<OwnJoint>> = written.joint.iter().enumerate().map(joint).collect();
        let mut joints: Vec<OwnJoint> = joints.into_iter().collect::<Option<_>>()?;
        let mut of_home = digits.of_home(&home?);
        // In the tip's frame, all axes move with it.
        if let (ScrewFrame::Body, Some(first)) = (written.frame.get_ref(), joints.first_mut()) {
            first.rounding.origin = std::mem::take(&mut of_home);
        }
        // The pose of the tip is the same number, however the axes are written.
        let form = JointForm::TwistInBase;
        let rounding_of_tip = JointRounding { origin: of_home, form, ..JointRounding::default() };
        Some(Self { joints, base_from_tip_at_zero: home?, rounding_of_tip })
    }
}

/// What the numbers of a screw are.
fn form(frame: ScrewFrame, screw: &WrittenScrew) -> JointForm {
    let has_point = screw.point_m.is_some() || screw.point_mm.is_some();
    match (frame, has_point) {
        (ScrewFrame::Space, false) => JointForm::TwistInBase,
        (ScrewFrame::Space, true) => JointForm::PointInBase,
        (ScrewFrame::Body, false) => JointForm::TwistInTip,
        (ScrewFrame::Body, true) => JointForm::PointInTip,
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
