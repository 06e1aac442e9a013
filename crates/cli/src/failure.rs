//! Failures of commands and their exit codes.

use congruent::{
    input::{Diagnostic, Findings},
    results::files::OutputError,
};

use crate::codes;

/// Exit code: the input could be read and compared, and a check failed.
pub(crate) const FAILED: u8 = 1;
/// The input is wrong: a file, an argument, or a place where nothing may be written.
pub(crate) const BAD_INPUT: u8 = 2;
/// The simulation or the machine failed.
pub(crate) const BROKEN: u8 = 3;

/// Nothing was checked, which is never success.
pub(crate) const NOTHING: u8 = 4;

/// Of two exit codes the one that is returned: a broken run before bad input before a failed check before nothing checked,
/// which must not hide that something else has failed.
pub fn worse(a: u8, b: u8) -> u8 {
    const FROM_BEST: [u8; 5] = [0, NOTHING, FAILED, BAD_INPUT, BROKEN];
    let rank = |code: u8| FROM_BEST.iter().position(|&known| known == code);
    if rank(b) > rank(a) { b } else { a }
}

/// A path that cannot be written is bad input, a full disk is a failure of the machine.
pub(crate) fn unwritable(error: &OutputError, help: &str) -> Failure {
    if error.is_full() {
        return Failure::Machine(error.to_string());
    }
    Diagnostic::error(codes::run::OUTPUT, error.to_string()).with_help(help).into()
}

/// Why a command has no result.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The input is wrong: every finding.
    Input(Findings),
    /// The machine failed: a full disk, a closed pipe.
    Machine(String),
}

impl Failure {
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Input(_) => BAD_INPUT,
            Self::Machine(_) => BROKEN,
        }
    }
}

impl From<Diagnostic> for Failure {
    fn from(finding: Diagnostic) -> Self {
        Self::Input(finding.into())
    }
}

impl From<Findings> for Failure {
    fn from(findings: Findings) -> Self {
        Self::Input(findings)
    }
}
