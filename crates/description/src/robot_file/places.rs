//! Where the figures of a robot file stand, and under which keys: for messages that blame one.

use std::{ops::Range, path::Path, sync::Arc};

use toml::Spanned;

use super::{
    ROBOT_FILE_BYTES,
    written::{WrittenDh, WrittenRobot, WrittenRow},
};
use crate::{
    diagnostic::SourceFile, file::read_text, findings::Findings, toml_text::parse_toml, units::Unit,
    written_transform::WrittenTransform,
};

/// A figure of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowKey {
    /// The joint's name.
    Joint,
    /// The direction.
    Sign,
    /// Link length.
    A,
    /// Link twist.
    Alpha,
    /// Link offset.
    D,
    /// Joint angle at position zero.
    Theta,
}

/// One of the two declared transforms of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConstantKey {
    /// `base_from_dh0`.
    BaseFromDh0,
    /// `dhn_from_tip`.
    DhnFromTip,
}

/// A part of a declared transform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConstantPart {
    /// The translation.
    Shift,
    /// The rotation.
    Turn,
}

/// A figure where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FigurePlace {
    /// The key under which it stands, or would: `alpha_deg`.
    pub key: String,
    /// Whether the file writes degrees or millimetres there.
    pub is_handy: bool,
    /// Byte range of the value, or of the row's joint where the figure is left out.
    pub span: Range<usize>,
}

/// A robot file, read once more for its places.
#[derive(Debug)]
pub struct RobotFilePlaces {
    source: Arc<SourceFile>,
    dh: Spanned<WrittenDh>,
}

impl RobotFilePlaces {
    /// Reads the file again; `None` where it cannot be read any more or has no table.
    pub fn read(path: &Path) -> Option<Self> {
        let source = read_text(path, ROBOT_FILE_BYTES).ok()?;
        let written: WrittenRobot = parse_toml(&source.text, &mut Findings::default())?;
        Some(Self { dh: written.dh?, source })
    }

    /// The file.
    pub fn source(&self) -> &Arc<SourceFile> {
        &self.source
    }

    /// The value of `convention`.
    pub fn convention(&self) -> Option<Range<usize>> {
        self.dh.get_ref().convention.as_ref().map(Spanned::span)
    }

    /// A figure of a row, by the row's number from 0.
    pub fn figure(&self, row: usize, key: RowKey) -> Option<FigurePlace> {
        let row = self.dh.get_ref().row.get(row)?.get_ref();
        let WrittenRow {
            joint, sign, a_m, a_mm, alpha_rad, alpha_deg, d_m, d_mm, theta_rad, theta_deg, ..
        } = row;
        let place = |key: String, is_handy, span: Option<Range<usize>>| FigurePlace {
            key,
            is_handy,
            span: span.unwrap_or_else(|| joint.span()),
        };
        let (quantity, unit, plain, handy) = match key {
            RowKey::Joint => return Some(place("joint".to_owned(), false, None)),
            RowKey::Sign => return Some(place("sign".to_owned(), false, sign.as_ref().map(Spanned::span))),
            RowKey::A => ("a", Unit::Length, a_m, a_mm),
            RowKey::Alpha => ("alpha", Unit::Angle, alpha_rad, alpha_deg),
            RowKey::D => ("d", Unit::Length, d_m, d_mm),
            RowKey::Theta => ("theta", Unit::Angle, theta_rad, theta_deg),
        };
        let [plain_key, handy_key] = unit.keys(quantity);
        let is_handy = handy.is_some();
        let span = plain.as_ref().or(handy.as_ref()).map(Spanned::span);
        Some(place(if is_handy { handy_key } else { plain_key }, is_handy, span))
    }

    /// Where a declared transform stands: the part that is asked for, or what is given of it; the
    /// table's first line where it is left out.
    pub fn constant(&self, key: ConstantKey, part: ConstantPart) -> Range<usize> {
        let written = self.written(key);
        let WrittenTransform { xyz_m, xyz_mm, rpy_rad, rpy_deg, quaternion_wxyz, matrix } = written;
        let shift = xyz_m.as_ref().or(xyz_mm.as_ref()).map(Spanned::span);
        let turn = rpy_rad.as_ref().or(rpy_deg.as_ref()).map(Spanned::span);
        let turn = turn.or(quaternion_wxyz.as_ref().map(Spanned::span));
        let [first, second] = match part {
            ConstantPart::Shift => [shift, turn],
            ConstantPart::Turn => [turn, shift],
        };
        let start = self.dh.span().start;
        let header = self.source.text[start..].find('\n').map_or(self.dh.span().end, |length| start + length);
        first.or(second).or(matrix.as_ref().map(Spanned::span)).unwrap_or(start..header)
    }

    /// Roll, pitch and yaw of a declared transform, where the file writes them.
    pub fn rpy_rad(&self, key: ConstantKey) -> Option<[f64; 3]> {
        let WrittenTransform { rpy_rad, rpy_deg, .. } = self.written(key);
        Unit::Angle.vector("rpy", rpy_rad.as_ref(), rpy_deg.as_ref()).ok().flatten()
    }

    fn written(&self, key: ConstantKey) -> &WrittenTransform {
        match key {
            ConstantKey::BaseFromDh0 => &self.dh.get_ref().base_from_dh0,
            ConstantKey::DhnFromTip => &self.dh.get_ref().dhn_from_tip,
        }
    }
}
