//! Where the figures of a robot file stand, and under which keys: for messages that blame one.

use std::{ops::Range, path::Path, sync::Arc};

use nalgebra::Isometry3;
use serde::Serialize;
use toml::Spanned;

use super::{
    ROBOT_FILE_BYTES,
    written::{WrittenDh, WrittenRobot, WrittenRow},
};
use crate::{
    diagnostic::SourceFile,
    diagnostics::Diagnostics,
    file::read_text,
    units::{Unit, UnitSystem},
    written::{name::serde_name, toml_text::parse_toml, transform::WrittenTransform},
};

/// A figure of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
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
    /// What the joint drives.
    Kind,
}

/// One of the two declared transforms of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
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

impl ConstantKey {
    /// The key as files write it.
    pub fn name(self) -> &'static str {
        serde_name(&self)
    }
}

/// A figure where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FigurePlace {
    /// The key under which it stands, or would: `alpha_deg`.
    pub key: String,
    /// In which of its units.
    pub scale: UnitSystem,
    /// Whether the file writes the figure; one that it leaves out is zero.
    pub is_written: bool,
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
        let written: WrittenRobot = parse_toml(&source.text, &mut Diagnostics::default())?;
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
        let place = |key: String, scale, span: Option<Range<usize>>| FigurePlace {
            key,
            scale,
            is_written: span.is_some(),
            span: span.unwrap_or_else(|| row.joint.span()),
        };
        let (quantity, unit) = match key {
            RowKey::Joint => return Some(place("joint".to_owned(), UnitSystem::Si, Some(row.joint.span()))),
            RowKey::Kind => return Some(place("kind".to_owned(), UnitSystem::Si, Some(row.kind.span()))),
            RowKey::Sign => {
                return Some(place("sign".to_owned(), UnitSystem::Si, row.sign.as_ref().map(Spanned::span)));
            }
            RowKey::A => ("a", Unit::Length),
            RowKey::Alpha => ("alpha", Unit::Angle),
            RowKey::D => ("d", Unit::Length),
            RowKey::Theta => ("theta", Unit::Angle),
        };
        let [plain, handy] = figures(row, key);
        let [plain_key, handy_key] = unit.keys(quantity);
        let scale = UnitSystem::of(plain, handy, self.scale(unit));
        let span = plain.or(handy).map(Spanned::span);
        Some(place(if scale == UnitSystem::Engineering { handy_key } else { plain_key }, scale, span))
    }

    /// How the rows write a unit, and a new figure should be written.
    fn scale(&self, unit: Unit) -> UnitSystem {
        let keys = match unit {
            Unit::Length => [RowKey::A, RowKey::D],
            Unit::Angle => [RowKey::Alpha, RowKey::Theta],
        };
        let rows = self.dh.get_ref().row.iter().map(Spanned::get_ref);
        let mut all = rows.flat_map(|row| keys.map(|key| figures(row, key)));
        if all.any(|[_, handy]| handy.is_some()) { UnitSystem::Engineering } else { UnitSystem::Si }
    }

    /// How the file would write another value of a declared transform, to be put at
    /// [`RobotFilePlaces::constant`]: in its units, its kind of rotation and its form.
    pub fn constant_as(&self, key: ConstantKey, pose: &Isometry3<f64>) -> String {
        let name = key.name();
        let (written, default) = (self.written(key), WrittenTransform::default());
        let scales = [Unit::Length, Unit::Angle].map(|unit| self.scale(unit));
        let keys = written.map_or(&default, Spanned::get_ref).with_keys(pose, scales);
        match written.map(|written| self.source.text[written.span()].trim_start()) {
            Some(text) if text.starts_with('{') => format!("write {name} = {{ {} }}", keys.join(", ")),
            Some(text) if text.starts_with('[') => {
                format!("write under [dh.{name}]: {}", keys.join(" and "))
            }
            Some(_) => {
                let dotted: Vec<String> = keys.iter().map(|line| format!("{name}.{line}")).collect();
                format!("write {}", dotted.join(" and "))
            }
            None => format!("write under [dh]: {name} = {{ {} }}", keys.join(", ")),
        }
    }

    /// Where a declared transform stands: the part that is asked for, or what is given of it; the
    /// table's first line where it is left out.
    pub fn constant(&self, key: ConstantKey, part: ConstantPart) -> Range<usize> {
        let start = self.dh.span().start;
        let header = self.source.text[start..].find('\n').map_or(self.dh.span().end, |length| start + length);
        let Some(written) = self.written(key) else { return start..header };
        let WrittenTransform { xyz_m, xyz_mm, rpy_rad, rpy_deg, quaternion_wxyz, matrix } = written.get_ref();
        let shift = xyz_m.as_ref().or(xyz_mm.as_ref()).map(Spanned::span);
        let turn = rpy_rad.as_ref().or(rpy_deg.as_ref()).map(Spanned::span);
        let turn = turn.or(quaternion_wxyz.as_ref().map(Spanned::span));
        let [first, second] = match part {
            ConstantPart::Shift => [shift, turn],
            ConstantPart::Turn => [turn, shift],
        };
        first.or(second).or(matrix.as_ref().map(Spanned::span)).unwrap_or(written.span())
    }

    /// Roll, pitch and yaw of a declared transform, where the file writes them.
    pub fn rpy_rad(&self, key: ConstantKey) -> Option<[f64; 3]> {
        let WrittenTransform { rpy_rad, rpy_deg, .. } = self.written(key)?.get_ref();
        Unit::Angle.vector("rpy", rpy_rad.as_ref(), rpy_deg.as_ref()).ok().flatten()
    }

    fn written(&self, key: ConstantKey) -> Option<&Spanned<WrittenTransform>> {
        match key {
            ConstantKey::BaseFromDh0 => self.dh.get_ref().base_from_dh0.as_ref(),
            ConstantKey::DhnFromTip => self.dh.get_ref().dhn_from_tip.as_ref(),
        }
    }
}

/// A figure of a row under its two keys: in the unit of the program, then in the handier one.
fn figures(row: &WrittenRow, key: RowKey) -> [Option<&Spanned<f64>>; 2] {
    let [plain, handy] = match key {
        RowKey::A => [&row.a_m, &row.a_mm],
        RowKey::Alpha => [&row.alpha_rad, &row.alpha_deg],
        RowKey::D => [&row.d_m, &row.d_mm],
        RowKey::Theta => [&row.theta_rad, &row.theta_deg],
        RowKey::Joint | RowKey::Sign | RowKey::Kind => return [None, None],
    };
    [plain.as_ref(), handy.as_ref()]
}
