//! Keys of a plan: those of --set, and what is wrong with one.

use congruent_input::{Diagnostic, Override};

use crate::codes;

/// A finding about a value that was set for a key, by the key alone and without a place: nobody wrote `--set`, or that value.
pub(super) fn about_key(keys: &[String], finding: Diagnostic) -> Diagnostic {
    let of_key = |key: &String| {
        let of = finding.message.strip_prefix("--set ")?;
        let of = of.strip_prefix(key.as_str()).or_else(|| of.strip_prefix(key.strip_prefix("robot.")?))?;
        let (_, rest) = of.strip_prefix('=')?.split_once(": ")?;
        Some(format!("key \"{key}\": {rest}"))
    };
    let message = keys.iter().find_map(of_key).unwrap_or_else(|| finding.message.clone());
    let help = finding.help.clone().filter(|help| !help.contains("--set") && !help.starts_with("KEY "));
    Diagnostic { message, help, span: None, source: None, ..finding }
}

/// A key with a value, as of --set.
pub(super) fn key_of(key: &str, value: &str) -> Result<Override, Diagnostic> {
    format!("{key}={value}").parse().map_err(|fault: Diagnostic| {
        let message = format!("\"{key}\" is no key of a scenario: {}", fault.message);
        Diagnostic::error(codes::sweep::KEY, message).with_help(
            "join the keys of the file by dots; an entry of a list has its number, from 1: payload.1.mass_kg",
        )
    })
}

/// Refuses a key that cannot vary.
pub(super) fn refuse_fixed(key: &str, fixed: &[(&str, &str)]) -> Result<(), Diagnostic> {
    match fixed.iter().find(|(fixed, _)| key == *fixed || is_inside(key, fixed)) {
        None => Ok(()),
        Some((fixed, why)) => {
            Err(Diagnostic::error(codes::sweep::KEY, format!("\"{fixed}\" cannot vary: {why}")))
        }
    }
}

/// Whether a key is one of the values under another: `start.joints_deg.elbow_joint` of `start.joints_deg`.
pub(super) fn is_inside(key: &str, outer: &str) -> bool {
    key.strip_prefix(outer).is_some_and(|rest| rest.starts_with('.'))
}
