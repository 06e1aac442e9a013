//! The application and the recording that a file belongs to. Viewers keep one layout for each application and
//! merge recordings with the same identifier, so both follow from the scenario.

use std::fmt::Write;

use congruent_twin::RunSetup;
use re_log_types::{ApplicationId, StoreId, StoreKind};
use sha2::{Digest, Sha256};

/// The most characters of a scenario's name in an application id: rerun limits the length.
const MAX_NAME_CHARACTERS: usize = 160;
/// Hexadecimal digits of the hash in a recording's id.
const HASH_DIGITS: usize = 16;

/// The store of a scenario's recording, or of its layout.
pub(crate) fn store(setup: &RunSetup, kind: StoreKind) -> StoreId {
    let name = application(&setup.scenario.name);
    let application = ApplicationId::new_or_unknown(name.as_str());
    let recording = format!("{name} {}", fingerprint(setup));
    StoreId::new(kind, application, recording)
}

/// The application id of a scenario, in the characters that rerun allows.
fn application(scenario: &str) -> String {
    let is_allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | ' ');
    let safe = scenario.chars().take(MAX_NAME_CHARACTERS).map(|c| if is_allowed(c) { c } else { '_' });
    format!("congruent {}", safe.collect::<String>().trim())
}

/// Whether an application id is of a scenario that this program recorded.
pub(crate) fn is_application(id: &ApplicationId) -> bool {
    id.as_str().starts_with("congruent ")
}

/// Hash of the scenario and of the robot without its meshes: runs that can differ have different hashes.
fn fingerprint(setup: &RunSetup) -> String {
    let description = &setup.description;
    let robot = &description.robot;
    let mut hash = Sha256::new();
    hash.update(setup.scenario.to_toml());
    // Debug text is stable within one version of the program, and so is the file. Meshes are large and move
    // nothing.
    hash.update(format!("{:?}", robot.joints()));
    for link in robot.links() {
        hash.update(format!("{:?} {:?}", link.name, link.inertia));
    }
    hash.update(format!("{:?} {:?} {:?}", description.dh, description.tip_from_tcp, description.tolerance));
    let mut digits = String::new();
    for byte in hash.finalize().iter().take(HASH_DIGITS / 2) {
        let _ = write!(digits, "{byte:02x}");
    }
    digits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scenario_name_makes_an_application() {
        for name in ["ur5e_pick", "", "../x", "a]]>\"\n\0b", "\u{fc}ber", &"x".repeat(1000)] {
            let id = application(name);
            assert!(ApplicationId::try_new(id.as_str()).is_ok(), "{id:?}");
        }
    }
}
