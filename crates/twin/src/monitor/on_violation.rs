//! `on_violation`, a key of every check: what a run does when the check is violated first.

use congruent_description::{Diagnostic, toml_text};

use crate::scenario::Section;

/// The keys that every check has, whatever its kind.
const COMMON_KEYS: &str = "kind, on_violation";
const KEY: &str = "on_violation";

/// What follows the first violation of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OnViolation {
    /// The run goes on to its end, and the report tells the worst.
    #[default]
    Continue,
    /// The run ends with the sample that shows the violation: the robot is driven no further.
    ///
    /// It ends, and does not hold its position, because holding would be a claim about brakes that no
    /// scenario declares: how far an arm travels until it stands is a property of the machine.
    /// What is reported is what was seen up to the violation, and nothing after it.
    Stop,
}

const NAMES: [(&str, OnViolation); 2] = [("continue", OnViolation::Continue), ("stop", OnViolation::Stop)];

impl OnViolation {
    /// The name in scenario files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Continue => "continue",
            Self::Stop => "stop",
        }
    }

    /// Takes the key out of a check's section.
    pub(super) fn take(section: &mut Section<'_>) -> Result<Self, Diagnostic> {
        if !section.has(KEY) {
            return Ok(Self::default());
        }
        section.select(KEY, "answer to a violation", &NAMES, |(name, _)| name).map(|&(_, answer)| answer)
    }
}

/// An unknown key may be one of those that every check has, misspelt.
pub(super) fn name_common_keys(error: Diagnostic) -> Diagnostic {
    if error.code != toml_text::UNKNOWN_KEY_CODE {
        return error;
    }
    let help = error.help.clone().unwrap_or_default();
    error.with_help(format!("{help}; of every check: {COMMON_KEYS}").trim_start_matches("; ").to_owned())
}
