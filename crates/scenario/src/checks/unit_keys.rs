//! Values of a check that a file gives in one of two units.

use congruent_input::{Diagnostic, units::Unit};

use crate::FilePlace;

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

/// A length, in m or mm.
pub(crate) fn length(keys: [&'static str; 2], written: [Option<f64>; 2]) -> UnitKeys {
    UnitKeys { keys, written, unit: Unit::Length }
}

/// An angle, in rad or deg.
pub(crate) fn angle(keys: [&'static str; 2], written: [Option<f64>; 2]) -> UnitKeys {
    UnitKeys { keys, written, unit: Unit::Angle }
}

/// A speed, in m/s or mm/s: seconds have one unit, so that it converts as a length does.
pub(crate) fn linear_speed(keys: [&'static str; 2], written: [Option<f64>; 2]) -> UnitKeys {
    length(keys, written)
}

/// An angular speed, in rad/s or deg/s, likewise.
pub(crate) fn angular_speed(keys: [&'static str; 2], written: [Option<f64>; 2]) -> UnitKeys {
    angle(keys, written)
}

impl UnitKeys {
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
        let error = Diagnostic::error("scenario::no_limit", message);
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
        let [si, engineering] = self.keys;
        let (quantity, _) = si.split_once('_').unwrap_or((si, ""));
        let message = format!("the {quantity} is given twice, as {si} and as {engineering}");
        let error = Diagnostic::error("scenario::two_units", message).with_help("remove one of them");
        Err(place.key(engineering).mark(error))
    }
}
