//! `[sensors]` checked against its robot.

use congruent_description::{Diagnostic, Robot, units::Unit};

use super::joint_numbers::{NumberRule, Unnamed, resolve};
use crate::scenario::{FilePlace, JointNumbers, Range, SensorSettings, VelocitySensor};

/// The encoders of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SensorSetup {
    /// One for each movable joint.
    pub(crate) encoders: Vec<Encoder>,
    /// Whether velocities are differences of positions.
    pub(crate) differentiates: bool,
}

/// The encoder of one joint; zeros are exact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Encoder {
    /// rad or m.
    pub(crate) resolution: f64,
    /// Standard deviation, rad or m.
    pub(crate) noise: f64,
    /// Standard deviation, rad/s or m/s.
    pub(crate) velocity_noise: f64,
}

/// Which value of an encoder a key gives.
type Field = fn(&mut Encoder) -> &mut f64;

impl SensorSetup {
    pub(in crate::setup) fn new(
        settings: &SensorSettings,
        place: FilePlace<'_>,
        robot: &Robot,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut encoders = vec![Encoder::default(); robot.dof()];
        let mut errors = Vec::new();
        let resolution: Field = |encoder| &mut encoder.resolution;
        let noise: Field = |encoder| &mut encoder.noise;
        let velocity_noise: Field = |encoder| &mut encoder.velocity_noise;
        let angle = |value| Unit::Angle.convert(value);
        let length = |value| Unit::Length.convert(value);
        let si = |value| value;
        let of_turn = |counts: f64| if counts > 0.0 { std::f64::consts::TAU / counts } else { 0.0 };
        let keys: [(&Option<JointNumbers>, &str, bool, fn(f64) -> f64, Field); 11] = [
            (&settings.counts_per_turn, "counts_per_turn", true, of_turn, resolution),
            (&settings.resolution_deg, "resolution_deg", true, angle, resolution),
            (&settings.resolution_rad, "resolution_rad", true, si, resolution),
            (&settings.resolution_m, "resolution_m", false, si, resolution),
            (&settings.resolution_mm, "resolution_mm", false, length, resolution),
            (&settings.noise_deg, "noise_deg", true, angle, noise),
            (&settings.noise_rad, "noise_rad", true, si, noise),
            (&settings.noise_m, "noise_m", false, si, noise),
            (&settings.noise_mm, "noise_mm", false, length, noise),
            (&settings.velocity_noise_rad_s, "velocity_noise_rad_s", true, si, velocity_noise),
            (&settings.velocity_noise_m_s, "velocity_noise_m_s", false, si, velocity_noise),
        ];
        for (numbers, key, of_angles, to_si, field) in keys {
            let Some(numbers) = numbers else { continue };
            let rule = NumberRule {
                what: key,
                range: Range::NonNegative,
                unnamed: Unnamed::Zero,
                of_angles: Some(of_angles),
            };
            match resolve(numbers, rule, place.key(key), robot) {
                Ok(numbers) => {
                    let given = encoders.iter_mut().zip(numbers).filter(|(_, number)| *number > 0.0);
                    for (encoder, number) in given {
                        if *field(encoder) > 0.0 {
                            errors.push(twice(key, place));
                            break;
                        }
                        *field(encoder) = to_si(number);
                    }
                }
                Err(found) => errors.extend(found),
            }
        }
        let differentiates = settings.velocity == VelocitySensor::Differentiated;
        if differentiates && encoders.iter().any(|encoder| encoder.velocity_noise > 0.0) {
            let message = "velocities that are differences of positions have no noise of their own";
            let error = Diagnostic::error("scenario::sensors", message);
            errors.push(
                place.key("velocity").mark(error.with_help("leave out `velocity` or the velocity's noise")),
            );
        }
        if errors.is_empty() { Ok(Self { encoders, differentiates }) } else { Err(errors) }
    }
}

fn twice(key: &str, place: FilePlace<'_>) -> Diagnostic {
    let message = format!("`{key}` gives a value of a joint that another key gives as well");
    place.key(key).mark(Diagnostic::error("scenario::two_units", message).with_help("leave one of them out"))
}
