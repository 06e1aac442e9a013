//! A fault of a run in names and units: an injected one, or one that the diagnosis has found.

use congruent_description::display::{number, position, quantity};
use nalgebra::{Isometry3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    scenario::FaultKind,
    words::{Word, known_word},
};

/// One fault.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunFault {
    /// What is wrong.
    pub kind: FaultKind,
    /// The joints that it is about.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<String>,
    /// The link that it is about.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// How large it is.
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
    /// What it is.
    #[serde(deserialize_with = "known_word")]
    pub quantity: Word,
    /// The value.
    pub value: f64,
    /// Its unit; empty for a share.
    #[serde(deserialize_with = "known_word")]
    pub unit: Word,
}

impl FaultQuantity {
    pub(crate) fn offset(value: f64, unit: &'static str) -> Self {
        Self { quantity: "offset", value, unit }
    }

    pub(crate) fn rate(value: f64, unit_of_joint: &'static str) -> Self {
        Self { quantity: "rate", value, unit: if unit_of_joint == "m" { "m/s" } else { "rad/s" } }
    }

    pub(crate) fn share(value: f64) -> Self {
        Self { quantity: "share", value, unit: "" }
    }

    pub(crate) fn latency(value: f64) -> Self {
        Self { quantity: "time", value, unit: "s" }
    }

    /// Dry and viscous friction, those that are not zero.
    pub(crate) fn friction([dry, viscous]: [f64; 2], unit_of_joint: &'static str) -> Vec<Self> {
        let units = if unit_of_joint == "m" { ["N", "N s/m"] } else { ["N m", "N m s/rad"] };
        let both = [("dry", dry, units[0]), ("viscous", viscous, units[1])];
        let present = both.into_iter().filter(|(_, value, _)| *value > 0.0);
        present.map(|(quantity, value, unit)| Self { quantity, value, unit }).collect()
    }

    /// Mass and place of a payload, the latter in the frame of link `tip`: the coordinates that are known.
    pub(crate) fn payload(mass_kg: f64, com_in_tip: Vector3<f64>, is_known: [bool; 3]) -> Vec<Self> {
        let mass = Self { quantity: "mass", value: mass_kg, unit: "kg" };
        let place = ["x", "y", "z"].into_iter().zip(com_in_tip.iter()).zip(is_known);
        let known = place.filter(|(_, is_known)| *is_known);
        std::iter::once(mass)
            .chain(known.map(|((quantity, &value), _)| Self { quantity, value, unit: "m" }))
            .collect()
    }

    /// A pose as shift and roll, pitch, yaw.
    pub(crate) fn shift(pose: &Isometry3<f64>) -> Vec<Self> {
        let (roll, pitch, yaw) = pose.rotation.euler_angles();
        let lengths = ["x", "y", "z"].into_iter().zip(pose.translation.vector.iter().copied());
        let angles = [("roll", roll), ("pitch", pitch), ("yaw", yaw)];
        let lengths = lengths.map(|(quantity, value)| Self { quantity, value, unit: "m" });
        lengths.chain(angles.map(|(quantity, value)| Self { quantity, value, unit: "rad" })).collect()
    }
}

impl RunFault {
    /// What is wrong in one sentence: `joint elbow_joint: encoder offset of 1 deg from 2 s on`.
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
        let value = |name: &str| self.values.iter().find(|value| value.quantity == name);
        let shown = |name: &str| value(name).map(FaultQuantity::shown).unwrap_or_default();
        let percent =
            || value("share").map_or(String::new(), |share| format!("{} %", number(100.0 * share.value)));
        let what = match self.kind {
            FaultKind::EncoderOffset => format!("encoder offset of {}", shown("offset")),
            FaultKind::EncoderDrift => format!("encoder drift of {}", shown("rate")),
            FaultKind::FlippedAxis => "encoder and drive count the other way round".to_owned(),
            FaultKind::StuckJoint => "does not move".to_owned(),
            FaultKind::LostTorque => "the actuator exerts nothing".to_owned(),
            FaultKind::ScaledTorque => {
                format!("the actuator exerts {} of what it is asked for", percent())
            }
            FaultKind::AddedFriction => format!("added friction, {}", self.listed()),
            FaultKind::WrongPayload => {
                let place = ["x", "y", "z"].map(|name| {
                    let known = value(name).map(|value| position(value.value, value.unit));
                    known.unwrap_or_else(|| format!("{name} not shown by this motion"))
                });
                format!("carries {} that nobody knows of, at ({})", shown("mass"), place.join(", "))
            }
            FaultKind::ShiftedTool => format!("stands elsewhere, by {}", self.listed()),
            FaultKind::SwappedJoints => "encoders and drives are exchanged".to_owned(),
            FaultKind::Latency => format!("the measured state arrives {} late", shown("time")),
            FaultKind::DroppedSamples => format!("{} of the measured states do not arrive", percent()),
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
        quantity(self.value, self.unit)
    }
}
