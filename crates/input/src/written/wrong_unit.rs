//! Names of the unit that values seem to have, and of the one that they should have.

use crate::units::UnitSystem;

/// Values in a wrong unit.
#[derive(Debug, Clone, Copy)]
pub struct WrongUnit {
    /// Whether they are angles; the others are lengths.
    pub is_angle: bool,
    /// Whether they are too large for the unit that they should have.
    pub is_too_large: bool,
}

impl WrongUnit {
    /// The unit that the values seem to have.
    pub fn given(self) -> &'static str {
        self.unit(if self.is_too_large { UnitSystem::Engineering } else { UnitSystem::Si })
    }

    /// The unit that they should have.
    pub fn right(self) -> &'static str {
        self.unit(self.right_system())
    }

    fn right_system(self) -> UnitSystem {
        if self.is_too_large { UnitSystem::Si } else { UnitSystem::Engineering }
    }

    fn unit(self, system: UnitSystem) -> &'static str {
        match (self.is_angle, system) {
            (true, UnitSystem::Engineering) => "degrees",
            (true, UnitSystem::Si) => "radians",
            (false, UnitSystem::Engineering) => "millimetres",
            (false, UnitSystem::Si) => "metres",
        }
    }

    /// `in degrees, but their keys say radians`. If the keys already say the unit that the values seem to have, the values
    /// were converted once too often.
    pub fn under(self, key: Option<UnitSystem>, keys_say: &str) -> String {
        match key.filter(|&key| key != self.right_system()) {
            None => format!("in {}, but {keys_say} {}", self.given(), self.right()),
            Some(key) => {
                let factor = if self.is_angle { "57.3" } else { "1000" };
                let size = if self.is_too_large { "large" } else { "small" };
                format!("{factor} times too {size}, as if converted to {} twice", self.unit(key))
            }
        }
    }
}

/// What a number of a file has instead of the right one, both as `key = value`, if it is the right number in the other unit of its
/// kind; `None` if it is not.
///
/// # Examples
/// ```
/// use congruent_input::unit_hint;
/// let hint = "millimetres under a key in metres: write d_mm = 267";
/// assert_eq!(unit_hint("d_m = 267", "d_m = 0.267").as_deref(), Some(hint));
/// assert_eq!(unit_hint("alpha_deg = -1.5708", "alpha_deg = -90").as_deref(), Some("-1.5708 rad is -90 deg"));
/// assert_eq!(unit_hint("d_m = 26.7", "d_m = 0.267"), None);
/// ```
pub fn unit_hint(given: &str, right: &str) -> Option<String> {
    /// Of the right number. Kind: digits of files; 1.57 for a quarter turn has three.
    const NEAR: f64 = 1e-3;
    let ((key, given), (other_key, right)) = (given.split_once(" = ")?, right.split_once(" = ")?);
    let (stem, unit) = key.rsplit_once('_').filter(|_| key == other_key)?;
    let (typed, expected): (f64, f64) = (given.parse().ok()?, right.parse().ok()?);
    let is_factor = |factor: f64| (typed - factor * expected).abs() <= NEAR * (factor * expected).abs();
    match unit {
        _ if expected == 0.0 => None,
        "m" if is_factor(1e3) => {
            Some(format!("millimetres under a key in metres: write {stem}_mm = {given}"))
        }
        "mm" if is_factor(1e-3) => {
            Some(format!("metres under a key in millimetres: write {stem}_m = {given}"))
        }
        "deg" if is_factor(1.0_f64.to_radians()) => Some(format!("{given} rad is {right} deg")),
        "rad" if is_factor(1.0_f64.to_degrees()) => {
            Some(format!("degrees under a key in radians: write {stem}_deg = {given}"))
        }
        _ => None,
    }
}
