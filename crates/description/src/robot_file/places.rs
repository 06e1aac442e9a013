//! Byte ranges and keys of the values in a robot file, for messages and corrections that point at one of them.

use std::{ops::Range, sync::Arc};

use congruent_input::{
    Slack, SourceFile, WrittenTransform, line_column, serde_name,
    units::{Unit, UnitSystem},
};
use nalgebra::Isometry3;
use serde::Serialize;
use toml::Spanned;

use super::written::{WrittenDh, WrittenRow};

/// A key of a row of the table; those of lengths and angles without their unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RowKey {
    /// Name of the joint that drives the row.
    Joint,
    /// Sign, 1 or -1, of the joint position in the row.
    Sign,
    /// Link length a.
    A,
    /// Link twist alpha.
    Alpha,
    /// Link offset d.
    D,
    /// Joint angle theta at position zero.
    Theta,
    /// Whether the joint position is added to theta (revolute) or to d (prismatic).
    Kind,
}

impl RowKey {
    /// The key as files write it, without a unit.
    pub fn name(self) -> &'static str {
        serde_name(&self)
    }

    /// What the key measures; `None` if its value has no unit.
    fn unit(self) -> Option<Unit> {
        match self {
            Self::A | Self::D => Some(Unit::Length),
            Self::Alpha | Self::Theta => Some(Unit::Angle),
            Self::Joint | Self::Sign | Self::Kind => None,
        }
    }
}

/// One of the two declared transforms of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ConstantKey {
    /// `base_from_dh0`: pose of frame 0 of the table in the base link.
    BaseFromDh0,
    /// `dhn_from_tip`: pose of the tip link in the last frame of the table.
    DhnFromTip,
}

/// A part of a declared transform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConstantPart {
    /// The translation: `xyz_m` or `xyz_mm`.
    Translation,
    /// The rotation: `rpy_rad`, `rpy_deg` or `quaternion_wxyz`.
    Rotation,
}

impl ConstantKey {
    /// The key as files write it.
    pub fn name(self) -> &'static str {
        serde_name(&self)
    }
}

/// A value of a row and its place in the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ValuePlace {
    /// The key of the value in the file, or the key that it would get: `alpha_deg`.
    pub key: String,
    /// The unit system of that key.
    pub units: UnitSystem,
    /// Whether the file has the value; a missing one is zero.
    pub is_written: bool,
    /// Byte range of the value, or of the row's joint if the value is left out.
    pub span: Range<usize>,
}

/// The table of a robot file as it is written, with the text that it was parsed from.
#[derive(Debug, PartialEq)]
pub struct RobotFilePlaces {
    source: Arc<SourceFile>,
    dh: Spanned<WrittenDh>,
    tolerance: Option<Range<usize>>,
}

impl RobotFilePlaces {
    /// `dh`, and the byte range of the tolerance, have been parsed from the text of `source`.
    pub(crate) fn new(
        source: Arc<SourceFile>,
        dh: Spanned<WrittenDh>,
        tolerance: Option<Range<usize>>,
    ) -> Self {
        Self { source, dh, tolerance }
    }

    /// Line of the first value of the tolerance, from 1; `None` if the file declares none.
    pub fn tolerance_line(&self) -> Option<usize> {
        let span = self.tolerance.as_ref()?;
        Some(line_column(&self.source.text, span.start).0)
    }

    /// The robot file that the places are in.
    pub fn source(&self) -> &Arc<SourceFile> {
        &self.source
    }

    /// The same, to name its file in another form.
    pub(crate) fn source_mut(&mut self) -> &mut Arc<SourceFile> {
        &mut self.source
    }

    pub(super) fn row_count(&self) -> usize {
        self.dh.get_ref().row.len()
    }

    /// Byte range of the value of `convention`; `None` if the key is missing.
    pub fn convention(&self) -> Option<Range<usize>> {
        self.dh.get_ref().convention.as_ref().map(Spanned::span)
    }

    /// The place of a value of a row; `row` counts from 0.
    pub fn value(&self, row: usize, key: RowKey) -> Option<ValuePlace> {
        let row = self.dh.get_ref().row.get(row)?.get_ref();
        let place = |key: String, units, span: Option<Range<usize>>| ValuePlace {
            key,
            units,
            is_written: span.is_some(),
            span: span.unwrap_or_else(|| row.joint.span()),
        };
        let Some(unit) = key.unit() else {
            let span = match key {
                RowKey::Kind => Some(row.kind.span()),
                RowKey::Sign => row.sign.as_ref().map(Spanned::span),
                _ => Some(row.joint.span()),
            };
            return Some(place(key.name().to_owned(), UnitSystem::Si, span));
        };
        let [si, engineering] = row_values(row, key);
        let [si_key, engineering_key] = unit.keys(key.name());
        let units = UnitSystem::from_given_key(si, engineering, self.units(unit));
        let span = si.or(engineering).map(Spanned::span);
        Some(place(if units == UnitSystem::Engineering { engineering_key } else { si_key }, units, span))
    }

    /// The last value that a row has: a new one belongs behind it, where a reader expects it.
    pub(super) fn last_of_row(&self, row: usize) -> Option<Range<usize>> {
        let row = self.dh.get_ref().row.get(row)?.get_ref();
        let values = [RowKey::A, RowKey::Alpha, RowKey::D, RowKey::Theta].into_iter();
        let values =
            values.flat_map(|key| row_values(row, key)).flatten().chain(&row.sign).map(Spanned::span);
        values.chain([row.joint.span(), row.kind.span()]).max_by_key(|span| span.end)
    }

    /// The units in which the rows write lengths or angles, and a new value should be written.
    fn units(&self, unit: Unit) -> UnitSystem {
        let keys = match unit {
            Unit::Length => [RowKey::A, RowKey::D],
            Unit::Angle => [RowKey::Alpha, RowKey::Theta],
        };
        let rows = self.dh.get_ref().row.iter().map(Spanned::get_ref);
        let mut all = rows.flat_map(|row| keys.map(|key| row_values(row, key)));
        if all.any(|[_, engineering]| engineering.is_some()) {
            UnitSystem::Engineering
        } else {
            UnitSystem::Si
        }
    }

    /// The keys of another value of a declared transform, as the file writes it: in its units and by its kind
    /// of rotation.
    pub fn constant_keys(&self, key: ConstantKey, pose: &Isometry3<f64>, slack: Slack) -> Vec<String> {
        let units = [Unit::Length, Unit::Angle].map(|unit| self.units(unit));
        let default = WrittenTransform::default();
        self.written(key).map_or(&default, Spanned::get_ref).with_keys(pose, units, slack)
    }

    /// Place of a part of a declared transform; if the part is missing, of the rest of the transform; if the transform is
    /// missing, the first line of the table.
    pub fn constant(&self, key: ConstantKey, part: ConstantPart) -> Range<usize> {
        let start = self.dh.span().start;
        let header = self.source.text[start..].find('\n').map_or(self.dh.span().end, |length| start + length);
        let Some(written) = self.written(key) else { return start..header };
        let WrittenTransform { xyz_m, xyz_mm, rpy_rad, rpy_deg, quaternion_wxyz, matrix } = written.get_ref();
        let translation = xyz_m.as_ref().or(xyz_mm.as_ref()).map(Spanned::span);
        let rotation = rpy_rad.as_ref().or(rpy_deg.as_ref()).map(Spanned::span);
        let rotation = rotation.or(quaternion_wxyz.as_ref().map(Spanned::span));
        let [first, second] = match part {
            ConstantPart::Translation => [translation, rotation],
            ConstantPart::Rotation => [rotation, translation],
        };
        first.or(second).or(matrix.as_ref().map(Spanned::span)).unwrap_or(written.span())
    }

    /// Whether the file writes a transform at all.
    pub fn has_constant(&self, key: ConstantKey) -> bool {
        self.written(key).is_some()
    }

    /// The unit system of the key under which a declared transform has its lengths or angles.
    pub fn constant_units(&self, key: ConstantKey, unit: Unit) -> UnitSystem {
        let default = self.units(unit);
        let Some(written) = self.written(key).map(Spanned::get_ref) else { return default };
        match unit {
            Unit::Length => {
                UnitSystem::from_given_key(written.xyz_m.as_ref(), written.xyz_mm.as_ref(), default)
            }
            Unit::Angle => {
                UnitSystem::from_given_key(written.rpy_rad.as_ref(), written.rpy_deg.as_ref(), default)
            }
        }
    }

    /// Roll, pitch and yaw of a declared transform, if the file writes them.
    pub fn rpy_rad(&self, key: ConstantKey) -> Option<[f64; 3]> {
        let WrittenTransform { rpy_rad, rpy_deg, .. } = self.written(key)?.get_ref();
        Unit::Angle.vector("rpy", rpy_rad.as_ref(), rpy_deg.as_ref()).ok().flatten()
    }

    pub(super) fn written(&self, key: ConstantKey) -> Option<&Spanned<WrittenTransform>> {
        match key {
            ConstantKey::BaseFromDh0 => self.dh.get_ref().base_from_dh0.as_ref(),
            ConstantKey::DhnFromTip => self.dh.get_ref().dhn_from_tip.as_ref(),
        }
    }
}

/// A value of a row under its two keys: in SI units, then in engineering units.
fn row_values(row: &WrittenRow, key: RowKey) -> [Option<&Spanned<f64>>; 2] {
    let [si, engineering] = match key {
        RowKey::A => [&row.a_m, &row.a_mm],
        RowKey::Alpha => [&row.alpha_rad, &row.alpha_deg],
        RowKey::D => [&row.d_m, &row.d_mm],
        RowKey::Theta => [&row.theta_rad, &row.theta_deg],
        RowKey::Joint | RowKey::Sign | RowKey::Kind => return [None, None],
    };
    [si.as_ref(), engineering.as_ref()]
}
