//! `[sensors]` checked against its robot.

use congruent_description::Robot;
use congruent_input::{
    Diagnostic, Findings,
    units::{Unit, WrittenUnit},
};
use congruent_scenario::{FilePlace, JointNumbers, Range, SensorSettings, VelocitySensor};

use super::joint_numbers::{NumberRule, Unnamed, resolve};
use crate::codes;

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
    /// Step of the readings, rad or m.
    pub(crate) resolution: f64,
    /// Standard deviation of the position noise, rad or m.
    pub(crate) noise: f64,
    /// Standard deviation of the velocity noise, rad/s or m/s.
    pub(crate) velocity_noise: f64,
}

/// A key of `[sensors]` that gives one value of the encoders.
struct EncoderKey<'a> {
    numbers: Option<&'a JointNumbers>,
    name: &'static str,
    /// `None` if it counts the steps of a turn.
    unit: Option<WrittenUnit>,
    field: fn(&mut Encoder) -> &mut f64,
}

/// The key that counts the steps of a turn.
const COUNTS: &str = "counts_per_turn";

fn keys(settings: &SensorSettings) -> [EncoderKey<'_>; 11] {
    let resolution: fn(&mut Encoder) -> &mut f64 = |encoder| &mut encoder.resolution;
    let noise: fn(&mut Encoder) -> &mut f64 = |encoder| &mut encoder.noise;
    let velocity_noise: fn(&mut Encoder) -> &mut f64 = |encoder| &mut encoder.velocity_noise;
    let all = [
        (&settings.counts_per_turn, COUNTS, resolution),
        (&settings.resolution_deg, "resolution_deg", resolution),
        (&settings.resolution_rad, "resolution_rad", resolution),
        (&settings.resolution_m, "resolution_m", resolution),
        (&settings.resolution_mm, "resolution_mm", resolution),
        (&settings.noise_deg, "noise_deg", noise),
        (&settings.noise_rad, "noise_rad", noise),
        (&settings.noise_m, "noise_m", noise),
        (&settings.noise_mm, "noise_mm", noise),
        (&settings.velocity_noise_rad_s, "velocity_noise_rad_s", velocity_noise),
        (&settings.velocity_noise_m_s, "velocity_noise_m_s", velocity_noise),
    ];
    all.map(|(numbers, name, field)| EncoderKey {
        numbers: numbers.as_ref(),
        name,
        unit: (name != COUNTS).then(|| WrittenUnit::of_key(name)),
        field,
    })
}

impl EncoderKey<'_> {
    fn rule(&self) -> NumberRule<'static> {
        let (range, unnamed) = (Range::NonNegative, Unnamed::Zero);
        let of_angles = self.unit.is_none_or(|unit| unit.unit == Unit::Angle);
        NumberRule { what: self.name, range, unnamed, of_angles: Some(of_angles) }
    }

    /// Puts the values into the encoders; returns whether each of them had none before.
    fn put(&self, numbers: &[f64], encoders: &mut [Encoder]) -> bool {
        let given = encoders.iter_mut().zip(numbers).filter(|(_, number)| **number > 0.0);
        let mut is_first = true;
        for (encoder, &number) in given {
            let value = (self.field)(encoder);
            // Zero means none: two keys conflict only at a joint to which both give something.
            is_first &= *value <= 0.0;
            *value = self.unit.map_or(std::f64::consts::TAU / number, |unit| unit.to_si(number));
        }
        is_first
    }
}

impl SensorSetup {
    pub(in crate::setup) fn new(
        settings: &SensorSettings,
        place: FilePlace<'_>,
        robot: &Robot,
    ) -> Result<Self, Findings> {
        let mut encoders = vec![Encoder::default(); robot.dof()];
        let mut errors = Vec::new();
        for key in keys(settings) {
            let Some(numbers) = key.numbers else { continue };
            match resolve(numbers, key.rule(), place.key(key.name), robot) {
                Ok(numbers) if !key.put(&numbers, &mut encoders) => errors.push(twice(key.name, place)),
                Ok(_) => {}
                Err(found) => errors.extend(found),
            }
        }
        let differentiates = settings.velocity == VelocitySensor::Differentiated;
        if differentiates && encoders.iter().any(|encoder| encoder.velocity_noise > 0.0) {
            let message = "velocity = \"differentiated\" cannot have a `velocity_noise`: the noise follows from the positions";
            let error = Diagnostic::error(codes::scenario::SENSORS, message);
            errors
                .push(place.key("velocity").mark(error.with_help("remove `velocity` or the velocity noise")));
        }
        if errors.is_empty() { Ok(Self { encoders, differentiates }) } else { Err(errors.into()) }
    }
}

fn twice(key: &str, place: FilePlace<'_>) -> Diagnostic {
    let message = format!("`{key}` and another key both give this value for the same joint");
    place
        .key(key)
        .mark(Diagnostic::error(codes::scenario::TWO_UNITS, message).with_help("remove one of them"))
}
