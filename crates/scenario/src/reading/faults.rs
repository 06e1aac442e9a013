//! One `[[fault]]` of a scenario file.

use congruent_input::{Diagnostic, Diagnostics};

use super::section::Section;
use crate::{FaultKind, FaultSettings as Settings};

/// Reads a section by its kind; the help on an unknown key names the keys that every kind has beside its own.
pub(super) fn read_fault(mut section: Section<'_>, findings: &mut Diagnostics) -> Option<Settings> {
    let kind = *findings.keep(section.select("kind", "fault", &FaultKind::ALL, |kind| kind.word()))?;
    let found = &mut Diagnostics::default();
    let fault = match kind {
        FaultKind::EncoderOffset => section.read_into(found).map(Settings::EncoderOffset),
        FaultKind::EncoderDrift => section.read_into(found).map(Settings::EncoderDrift),
        FaultKind::FlippedAxis => section.read_into(found).map(Settings::FlippedAxis),
        FaultKind::StuckJoint => section.read_into(found).map(Settings::StuckJoint),
        FaultKind::LostTorque => section.read_into(found).map(Settings::LostTorque),
        FaultKind::ScaledTorque => section.read_into(found).map(Settings::ScaledTorque),
        FaultKind::AddedFriction => section.read_into(found).map(Settings::AddedFriction),
        FaultKind::WrongPayload => section.read_into(found).map(Settings::WrongPayload),
        FaultKind::ShiftedTool => section.read_into(found).map(Settings::ShiftedTool),
        FaultKind::SwappedJoints => section.read_into(found).map(Settings::SwappedJoints),
        FaultKind::Latency => section.read_into(found).map(Settings::Latency),
        FaultKind::DroppedSamples => section.read_into(found).map(Settings::DroppedSamples),
    };
    findings.extend(std::mem::take(found).map(|finding| with_kind(finding, kind)).into_vec());
    fault
}

fn with_kind(finding: Diagnostic, kind: FaultKind) -> Diagnostic {
    if finding.code != congruent_input::codes::toml::UNKNOWN_KEY {
        return finding;
    }
    let help = finding.help.clone().unwrap_or_default();
    finding.with_help(format!("{help}; this fault is of kind \"{kind}\""))
}
