//! A motion of a scenario file: of which kind it is, by the key that has its target.

use congruent_input::{Diagnostic, Diagnostics, codes::toml::UNKNOWN_KEY};

use super::section::Section;
use crate::{
    ArcMotion, JointMotion, JointPathMotion, LineMotion, MotionSettings, PlaybackMotion, ServoMotion,
    TcpMotion, TcpPathMotion, codes,
    motions::{
        ARC_KEY, JOINT_KEYS, JOINT_PATH_KEYS, LINE_KEY, PLAYBACK_KEY, SERVO_KEY, TCP_KEY, TCP_PATH_KEY,
    },
};

pub(super) fn read_motion(section: Section<'_>, findings: &mut Diagnostics) -> Option<MotionSettings> {
    if JOINT_KEYS.iter().any(|key| section.has(key)) {
        section.read_into::<JointMotion>(findings).map(MotionSettings::Joints)
    } else if section.has(TCP_KEY) {
        section.read_into::<TcpMotion>(findings).map(MotionSettings::Tcp)
    } else if section.has(SERVO_KEY) {
        section.read_into::<ServoMotion>(findings).map(MotionSettings::Servo)
    } else if section.has(LINE_KEY) {
        section.read_into::<LineMotion>(findings).map(MotionSettings::Line)
    } else if section.has(ARC_KEY) {
        section.read_into::<ArcMotion>(findings).map(MotionSettings::Arc)
    } else if section.has(TCP_PATH_KEY) {
        section.read_into::<TcpPathMotion>(findings).map(MotionSettings::TcpPath)
    } else if JOINT_PATH_KEYS.iter().any(|key| section.has(key)) {
        section.read_into::<JointPathMotion>(findings).map(MotionSettings::JointPath)
    } else if section.has(PLAYBACK_KEY) {
        section.read_into::<PlaybackMotion>(findings).map(MotionSettings::Playback)
    } else {
        let one_key = [TCP_KEY, LINE_KEY, ARC_KEY, TCP_PATH_KEY, PLAYBACK_KEY, SERVO_KEY];
        let known: Vec<&str> = JOINT_KEYS.into_iter().chain(JOINT_PATH_KEYS).chain(one_key).collect();
        findings.push(match section.misspelt(&known) {
            Some((key, meant)) => {
                Diagnostic::error(UNKNOWN_KEY, format!("unknown key \"{}\"", key.get_ref()))
                    .with_help(format!("did you mean \"{meant}\"?"))
                    .at(key.span())
            }
            None => Diagnostic::error(codes::scenario::UNKNOWN_MOTION, "the motion has no target")
                .with_help(format!("give one of these keys: {}", known.join(", ")))
                .at(section.span()),
        });
        None
    }
}
