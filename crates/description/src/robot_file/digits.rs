//! The digits with which a table is typed.

use congruent_input::{
    TypedNumber, WrittenTransform, half_places,
    units::{Unit, UnitSystem},
};
use toml::Spanned;

use super::places::{ConstantKey, RobotFilePlaces, RowKey};

/// Half of the last place of the typed values of a table: how far each true value may be from the typed one. A value
/// that is not written is exact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TableDigits {
    /// For each row those of a, alpha, d and theta, in m and rad.
    pub rows: Vec<[f64; 4]>,
    /// Those of `base_from_dh0`: x, y, z in m, then roll, pitch, yaw in rad.
    pub base: [f64; 6],
    /// Those of `dhn_from_tip`, likewise.
    pub tool: [f64; 6],
}

/// Where a half place goes.
enum Place {
    Row(usize, usize),
    Base(usize),
    Tool(usize),
}

impl RobotFilePlaces {
    /// The digits of all values of the table.
    pub fn digits(&self) -> TableDigits {
        let mut digits =
            TableDigits { rows: vec![[0.0; 4]; self.row_count()], base: [0.0; 6], tool: [0.0; 6] };
        for unit in [Unit::Length, Unit::Angle] {
            let halves = halves_at(self.typed(unit), |numbers| half_places(unit, numbers));
            for (place, half) in halves {
                match place {
                    Place::Row(row, entry) => digits.rows[row][entry] = half,
                    Place::Base(component) => digits.base[component] = half,
                    Place::Tool(component) => digits.tool[component] = half,
                }
            }
        }
        digits
    }

    /// All lengths, or all angles, as they are typed.
    fn typed(&self, unit: Unit) -> Vec<(Place, TypedNumber<'_>)> {
        let keys: &[(usize, RowKey)] = match unit {
            Unit::Length => &[(0, RowKey::A), (2, RowKey::D)],
            Unit::Angle => &[(1, RowKey::Alpha), (3, RowKey::Theta)],
        };
        let text = &self.source().text;
        let cells = (0..self.row_count()).flat_map(|row| keys.iter().map(move |key| (row, *key)));
        let cells = cells.filter_map(|(row, (entry, key))| {
            let place = self.value(row, key).filter(|place| place.is_written)?;
            Some((Place::Row(row, entry), TypedNumber { text: &text[place.span], units: place.units }))
        });
        let base = self.typed_constant(ConstantKey::BaseFromDh0, unit);
        let tool = self.typed_constant(ConstantKey::DhnFromTip, unit);
        let base = base.into_iter().map(|(component, number)| (Place::Base(component), number));
        let tool = tool.into_iter().map(|(component, number)| (Place::Tool(component), number));
        cells.chain(base).chain(tool).collect()
    }

    /// The lengths, or the roll, pitch and yaw, of a declared transform.
    fn typed_constant(&self, key: ConstantKey, unit: Unit) -> Vec<(usize, TypedNumber<'_>)> {
        let written = self.written(key).map(Spanned::get_ref);
        written.map_or_else(Vec::new, |written| typed_transform(written, unit, &self.source().text))
    }
}

/// Half of the last place of typed numbers that are judged together, each with the place of its number.
pub(crate) fn halves_at<P>(
    typed: Vec<(P, TypedNumber<'_>)>,
    halves: impl FnOnce(&[TypedNumber<'_>]) -> Vec<f64>,
) -> impl Iterator<Item = (P, f64)> {
    let (places, numbers): (Vec<P>, Vec<TypedNumber<'_>>) = typed.into_iter().unzip();
    places.into_iter().zip(halves(&numbers))
}

/// The lengths, or the roll, pitch and yaw, of a transform, with their place among the six. Quaternions and the rotations of
/// matrices are exact.
pub(crate) fn typed_transform<'a>(
    written: &WrittenTransform,
    unit: Unit,
    text: &'a str,
) -> Vec<(usize, TypedNumber<'a>)> {
    if let (Unit::Length, Some(matrix)) = (unit, &written.matrix) {
        return translation_of_matrix(&text[matrix.span()]);
    }
    let (si, engineering, first) = match unit {
        Unit::Length => (&written.xyz_m, &written.xyz_mm, 0),
        Unit::Angle => (&written.rpy_rad, &written.rpy_deg, 3),
    };
    let numbers = typed_vector([si.as_ref(), engineering.as_ref()], text);
    numbers.into_iter().map(|(at, number)| (first + at, number)).collect()
}

/// x, y and z of a homogeneous matrix as it is typed, in m; none if there is a comment between its numbers.
fn translation_of_matrix(text: &str) -> Vec<(usize, TypedNumber<'_>)> {
    let is_around = |character: char| character.is_whitespace() || "[],".contains(character);
    let numbers: Vec<&str> = text.split(is_around).filter(|number| !number.is_empty()).collect();
    if numbers.len() != 16 {
        return Vec::new();
    }
    let last_column = [numbers[3], numbers[7], numbers[11]];
    last_column.map(|text| TypedNumber { text, units: UnitSystem::Si }).into_iter().enumerate().collect()
}

/// The components of a vector that has one of two keys, that of SI units or that of engineering units, as they are typed.
pub(crate) fn typed_vector<'a>(
    [si, engineering]: [Option<&Spanned<[f64; 3]>>; 2],
    text: &'a str,
) -> Vec<(usize, TypedNumber<'a>)> {
    let units = UnitSystem::from_given_key(si, engineering, UnitSystem::Si);
    let Some(vector) = si.or(engineering) else { return Vec::new() };
    let components = text[vector.span()].trim_matches(['[', ']']).split(',').take(3);
    components.map(|text| TypedNumber { text: text.trim(), units }).enumerate().collect()
}
