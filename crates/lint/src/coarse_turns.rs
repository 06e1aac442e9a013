//! Quarter turns of joint origins that are typed with so few digits that the robot is visibly another.

use std::f64::consts::FRAC_PI_2;

use congruent_description::{
    RobotDescription,
    node::{elements, tag},
};
use congruent_input::{Diagnostic, Diagnostics, display::angle, xml};

use crate::codes;

/// Errors below are those of `1.5708`, which is in half of all published files: 4 um at 1 m. Unit: rad.
const COARSE_RAD: f64 = 2e-5;

/// Warnings of roll, pitch and yaw that are the first digits of a quarter turn, such as 1.57 or 3.1415.
pub fn coarse_quarter_turns(description: &RobotDescription) -> Vec<Diagnostic> {
    let Some(places) = &description.places.urdf else { return Vec::new() };
    let Ok(document) = xml::parse(&places.source().text) else { return Vec::new() };
    let mut found = Diagnostics::default();
    for joint in elements(document.root_element(), "joint") {
        let Some(name) = joint.attribute("name") else { continue };
        for origin in elements(joint, "origin") {
            let mut typed = origin.attribute("rpy").unwrap_or_default().split_whitespace();
            // One finding for a joint: its values are corrected together.
            let Some((text, turn_rad)) = typed.find_map(|text| Some((text, cut_quarter_turn(text)?))) else {
                continue;
            };
            let error = angle((text.parse::<f64>().unwrap_or(turn_rad) - turn_rad).abs());
            let message = format!(
                "joint \"{name}\": rpy has {text}, a quarter turn with too few digits: it is off by {error}"
            );
            let warning = Diagnostic::warning(codes::urdf::COARSE_TURN, message)
                .one_of("joints have quarter turns with too few digits in their rpy", name)
                .with_help(format!(
                    "write {turn_rad}; a table of whole degrees then agrees to the last digit"
                ));
            found.push(warning.at(tag(origin)));
        }
    }
    found.in_file(places.source())
}

/// The quarter turn of which a number has the first digits, rounded or cut off, if they are too few.
fn cut_quarter_turn(text: &str) -> Option<f64> {
    let value: f64 = text.parse().ok()?;
    let turn_rad = (value / FRAC_PI_2).round() * FRAC_PI_2;
    let decimals = text.split_once('.')?.1.len();
    let half_place = 0.5 * libm::pow(10.0, -f64::from(u32::try_from(decimals).ok()?));
    let off = (value - turn_rad).abs();
    // 1.571 is a rounded quarter turn, 1.570 one that is cut off; 1.5712 is another angle.
    let is_cut_off = value.abs() < turn_rad.abs() && off < 2.0 * half_place;
    let has_its_digits = decimals > 1 && (off <= half_place || is_cut_off);
    (turn_rad != 0.0 && off > COARSE_RAD && has_its_digits).then_some(turn_rad)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_digits_of_a_quarter_turn_are_recognised() {
        for coarse in ["1.57", "-1.57", "1.571", "3.14", "3.1415", "-3.142", "1.5707"] {
            assert!(cut_quarter_turn(coarse).is_some(), "{coarse}");
        }
        for other in [
            "0", "1.5708", "1.570796", "1.5712", "1.6", "0.00001", "3.2", "2", "1.56", "1.58", "-1.5665",
            "nan", "1e-3",
        ] {
            assert_eq!(cut_quarter_turn(other), None, "{other}");
        }
    }
}
