//! The range of positions of a joint in a robot file without a URDF.

use congruent_input::{
    Diagnostic,
    units::{Unit, both_given},
};
use congruent_robot::DhRowKind;
use toml::Spanned;

use crate::codes;

/// The range of a joint under its four keys.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WrittenRange<'a> {
    pub(crate) rad: Option<&'a Spanned<[f64; 2]>>,
    pub(crate) deg: Option<&'a Spanned<[f64; 2]>>,
    pub(crate) m: Option<&'a Spanned<[f64; 2]>>,
    pub(crate) mm: Option<&'a Spanned<[f64; 2]>>,
}

impl<'a> WrittenRange<'a> {
    /// The first key that is written, with its value.
    pub(crate) fn first(&self) -> Option<(&'static str, &'a Spanned<[f64; 2]>)> {
        let keys =
            [("range_rad", self.rad), ("range_deg", self.deg), ("range_m", self.m), ("range_mm", self.mm)];
        keys.into_iter().find_map(|(key, range)| Some((key, range?)))
    }

    /// Lowest and highest position, rad or m; `None` if none is written.
    pub(crate) fn read(&self, joint: &str, kind: DhRowKind) -> Result<Option<[f64; 2]>, Diagnostic> {
        let (unit, [si, engineering], other) = match kind {
            DhRowKind::Revolute => (Unit::Angle, [self.rad, self.deg], self.m.or(self.mm)),
            DhRowKind::Prismatic => (Unit::Length, [self.m, self.mm], self.rad.or(self.deg)),
        };
        let [first, second] = unit.keys("range");
        if let Some(other) = other {
            let moves = if unit == Unit::Angle { "turns" } else { "slides" };
            let key = self.first().map_or("range", |(key, _)| key);
            let message = format!("{key}: joint \"{joint}\" {moves}");
            return Err(Diagnostic::error(codes::robot_file::RANGE, message)
                .at(other.span())
                .with_help(format!("its range is given by {first} or {second}")));
        }
        if let (Some(_), Some(second_range)) = (si, engineering) {
            return Err(both_given([&first, &second]).at(second_range.span()));
        }
        let Some([lower, upper]) = unit.vector("range", si, engineering)? else { return Ok(None) };
        if lower < upper {
            return Ok(Some([lower, upper]));
        }
        let written = si.or(engineering).map_or(0..0, Spanned::span);
        let message = format!(
            "joint \"{joint}\": the range from {lower} to {upper} {} has no positions",
            unit.names()[0]
        );
        Err(Diagnostic::error(codes::robot_file::RANGE, message)
            .at(written)
            .with_help("the lowest position comes first; without a range a joint that turns has no limits"))
    }
}
