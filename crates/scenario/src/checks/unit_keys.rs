//! Values of a check that a file gives in one of two units.

use congruent_input::{
    Diagnostic,
    units::{Unit, WrittenUnit, both_given},
};

use crate::{FilePlace, codes};

/// One value under two keys: in SI units, and in engineering units.
#[derive(Debug, Clone, Copy)]
pub struct UnitKeys {
    /// The key of the SI unit, then that of the engineering unit.
    pub keys: [&'static str; 2],
    /// The values that are written under the two keys.
    pub written: [Option<f64>; 2],
    /// The quantity of both keys, which decides how the engineering unit converts.
    pub unit: Unit,
}

/// Two fields of a check that give one value.
macro_rules! in_two_units {
    ($check:expr, $si:ident, $engineering:ident) => {
        UnitKeys::new([stringify!($si), stringify!($engineering)], [$check.$si, $check.$engineering])
    };
}
pub(crate) use in_two_units;

impl UnitKeys {
    pub(crate) fn new(keys: [&'static str; 2], written: [Option<f64>; 2]) -> Self {
        Self { keys, written, unit: WrittenUnit::of_key(keys[0]).unit }
    }

    /// The value in SI units.
    pub fn value(&self) -> Option<f64> {
        let [si, engineering] = self.written;
        si.or(engineering.map(|value| self.unit.convert(value)))
    }

    /// Refuses a check without this value.
    ///
    /// # Errors
    /// The value is written under neither key.
    pub fn required(&self, place: FilePlace<'_>) -> Result<(), Diagnostic> {
        if self.value().is_some() {
            return Ok(());
        }
        let [si, engineering] = self.keys;
        let message = format!("the check has no `{si}`");
        let error = Diagnostic::error(codes::scenario::NO_LIMIT, message);
        Err(place.mark(error.with_help(format!("give `{si}` or `{engineering}`"))))
    }

    /// The key that the file has.
    pub fn written_key(&self) -> &'static str {
        let [si, engineering] = self.keys;
        if self.written[0].is_some() { si } else { engineering }
    }

    /// Refuses a value that is given in both units.
    ///
    /// # Errors
    /// Both keys have a value.
    pub fn examine(&self, place: FilePlace<'_>) -> Result<(), Diagnostic> {
        let [Some(_), Some(_)] = self.written else { return Ok(()) };
        Err(place.key(self.keys[1]).mark(both_given(self.keys)))
    }
}
