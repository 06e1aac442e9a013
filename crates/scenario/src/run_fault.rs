//! A fault of a run in names and units: an injected one, or one that the diagnosis has found.

use congruent_input::{
    Quantity, SiUnit,
    display::{number, position, quantity},
};
use nalgebra::{Isometry3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::FaultKind;

/// One fault, injected or found: kind, joints or link, values and times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunFault {
    /// Kind of the fault.
    pub kind: FaultKind,
    /// Names of the joints with the fault.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<String>,
    /// Name of the link with the fault.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// Size of the fault.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<FaultQuantity>,
    /// The time of the first sample that has it.
    pub from_s: f64,
    /// The time of the first sample that no longer has it; `None` if it lasts to the end of the run.
    pub until_s: Option<f64>,
}

/// A value of a fault.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FaultQuantity {
    /// Name of the quantity: `offset`, `rate`, `share`, `mass`.
    #[schemars(with = "String")]
    pub quantity: Quantity,
    /// The value, in that unit.
    pub value: f64,
    /// Unit of the value; empty for a share.
    #[schemars(with = "String")]
    pub unit: SiUnit,
}

impl FaultQuantity {
    /// A constant error, in `unit`.
    pub fn offset(value: f64, unit: SiUnit) -> Self {
        Self { quantity: Quantity::Offset, value, unit }
    }

    /// An error that grows with time, in units of the joint per second.
    pub fn rate(value: f64, unit_of_joint: SiUnit) -> Self {
        let is_length = unit_of_joint == SiUnit::Metre;
        let unit = if is_length { SiUnit::MetrePerSecond } else { SiUnit::RadianPerSecond };
        Self { quantity: Quantity::Rate, value, unit }
    }

    /// A factor or a probability, without a unit.
    pub fn share(value: f64) -> Self {
        Self { quantity: Quantity::Share, value, unit: SiUnit::Ratio }
    }

    /// A delay in seconds.
    pub fn latency(value: f64) -> Self {
        Self { quantity: Quantity::Time, value, unit: SiUnit::Second }
    }

    /// Dry and viscous friction, those that are not zero.
    pub fn friction([dry, viscous]: [f64; 2], unit_of_joint: SiUnit) -> Vec<Self> {
        let units = if unit_of_joint == SiUnit::Metre {
            [SiUnit::Newton, SiUnit::NewtonSecondPerMetre]
        } else {
            [SiUnit::NewtonMetre, SiUnit::NewtonMetreSecondPerRadian]
        };
        let both = [(Quantity::Dry, dry, units[0]), (Quantity::Viscous, viscous, units[1])];
        let present = both.into_iter().filter(|(_, value, _)| *value > 0.0);
        present.map(|(quantity, value, unit)| Self { quantity, value, unit }).collect()
    }

    /// Mass and place of a payload, the latter in the frame of link `tip`: the coordinates that are known.
    pub fn payload(mass_kg: f64, com_in_tip: Vector3<f64>, is_known: [bool; 3]) -> Vec<Self> {
        let mass = Self { quantity: Quantity::Mass, value: mass_kg, unit: SiUnit::Kilogram };
        let place = [Quantity::X, Quantity::Y, Quantity::Z].into_iter().zip(com_in_tip.iter()).zip(is_known);
        let known = place.filter(|(_, is_known)| *is_known);
        std::iter::once(mass)
            .chain(known.map(|((quantity, &value), _)| Self { quantity, value, unit: SiUnit::Metre }))
            .collect()
    }

    /// A pose as shift and roll, pitch, yaw.
    pub fn shift(pose: &Isometry3<f64>) -> Vec<Self> {
        let (roll, pitch, yaw) = pose.rotation.euler_angles();
        let lengths =
            [Quantity::X, Quantity::Y, Quantity::Z].into_iter().zip(pose.translation.vector.iter().copied());
        let angles = [(Quantity::Roll, roll), (Quantity::Pitch, pitch), (Quantity::Yaw, yaw)];
        let lengths = lengths.map(|(quantity, value)| Self { quantity, value, unit: SiUnit::Metre });
        lengths
            .chain(angles.map(|(quantity, value)| Self { quantity, value, unit: SiUnit::Radian }))
            .collect()
    }
}

impl RunFault {
    /// The fault in one sentence: `joint elbow_joint: encoder offset of 1 deg from 2 s on`.
    pub fn sentence(&self) -> String {
        let from = quantity(self.from_s, "s");
        let time = match self.until_s {
            Some(until_s) => format!("from {from} to {}", quantity(until_s, "s")),
            None => format!("from {from} on"),
        };
        format!("{} {time}", self.words())
    }

    /// The same without the time.
    pub fn words(&self) -> String {
        let value = |name: Quantity| self.values.iter().find(|value| value.quantity == name);
        let shown = |name: Quantity| value(name).map(FaultQuantity::shown).unwrap_or_default();
        let percent = || {
            value(Quantity::Share).map_or(String::new(), |share| format!("{} %", number(100.0 * share.value)))
        };
        let what = match self.kind {
            FaultKind::EncoderOffset => format!("encoder offset of {}", shown(Quantity::Offset)),
            FaultKind::EncoderDrift => format!("encoder drift of {}", shown(Quantity::Rate)),
            FaultKind::FlippedAxis => "encoder and drive count the other way round".to_owned(),
            FaultKind::StuckJoint => "does not move".to_owned(),
            FaultKind::LostTorque => "the actuator exerts no effort".to_owned(),
            FaultKind::ScaledTorque => {
                format!("the actuator exerts {} of the commanded effort", percent())
            }
            FaultKind::AddedFriction => format!("added friction, {}", self.listed()),
            FaultKind::WrongPayload => {
                let place = [Quantity::X, Quantity::Y, Quantity::Z].map(|name| {
                    let known = value(name).map(|value| position(value.value, value.unit.symbol()));
                    known.unwrap_or_else(|| format!("{name} not identifiable from this motion"))
                });
                format!("carries an undeclared mass of {}, at ({})", shown(Quantity::Mass), place.join(", "))
            }
            FaultKind::ShiftedTool => format!("mounted at another pose, shifted by {}", self.listed()),
            FaultKind::SwappedJoints => "encoders and drives are exchanged".to_owned(),
            FaultKind::Latency => format!("the measured state arrives {} late", shown(Quantity::Time)),
            FaultKind::DroppedSamples => format!("{} of the measured states are lost", percent()),
        };
        match (self.joints.as_slice(), &self.link) {
            ([], None) => what,
            ([], Some(link)) => format!("link {link}: {what}"),
            ([joint], _) => format!("joint {joint}: {what}"),
            (joints, _) => format!("joints {}: {what}", joints.join(" and ")),
        }
    }

    /// The values that are not negligible.
    fn listed(&self) -> String {
        /// Rounding of a mean over the samples, m and rad.
        const NEGLIGIBLE: f64 = 1e-7;
        let values = self.values.iter().filter(|value| value.value.abs() > NEGLIGIBLE);
        let listed: Vec<String> =
            values.map(|value| format!("{} {}", value.quantity, value.shown())).collect();
        listed.join(", ")
    }
}

impl FaultQuantity {
    /// The value with its unit.
    pub fn shown(&self) -> String {
        quantity(self.value, self.unit.symbol())
    }
}
