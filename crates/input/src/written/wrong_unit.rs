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
