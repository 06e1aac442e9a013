//! Where things stand in a recording. Names come from robot files, so they are parts of a path
//! and never parsed as one: a link `a/b` is one entity.

use re_log_types::{EntityPath, EntityPathPart};

/// The path with these parts.
pub(super) fn path(parts: &[&str]) -> EntityPath {
    EntityPath::new(parts.iter().map(|&part| EntityPathPart::new(part)).collect())
}

/// Everything in three dimensions; its frame is the root link's.
pub(super) fn world() -> EntityPath {
    path(&["world"])
}

/// A link as the physics places it.
pub(super) fn twin(link: &str) -> EntityPath {
    path(&["world", "twin", link])
}

/// A link as the analysis places it.
pub(super) fn model(link: &str) -> EntityPath {
    path(&["world", "model", link])
}

/// What stands around.
pub(super) fn obstacle(name: &str) -> EntityPath {
    path(&["world", "obstacle", name])
}

/// Where links may not be.
pub(super) fn zone(name: &str) -> EntityPath {
    path(&["world", "zone", name])
}

/// Where the tool has been.
pub(super) fn trail() -> EntityPath {
    path(&["world", "trail"])
}

/// From the twin's links to the model's, where they disagree.
pub(super) fn error_arrows() -> EntityPath {
    path(&["world", "error"])
}

/// The link that disagrees most.
pub(super) fn worst_error() -> EntityPath {
    path(&["world", "error", "worst"])
}

/// Distance between model and twin at a link, m.
pub(super) fn position_error(link: &str) -> EntityPath {
    path(&["agreement", "position", link])
}

/// Angle between model and twin at a link, rad.
pub(super) fn orientation_error(link: &str) -> EntityPath {
    path(&["agreement", "orientation", link])
}

/// The largest error of all links at an instant, as a power of ten.
pub(super) fn worst_of_links(quantity: &str) -> EntityPath {
    path(&["agreement", "worst", quantity])
}

/// Position of a joint, rad or m.
pub(super) fn joint_position(joint: &str) -> EntityPath {
    path(&["joint", "position", joint])
}

/// A distance, m: `minimum`, `limit`, or a pair.
pub(super) fn clearance(name: &str) -> EntityPath {
    path(&["clearance", name])
}

/// The verdict of a check as it changes.
pub(super) fn status(check: &str) -> EntityPath {
    path(&["status", check])
}

/// What happened.
pub(super) fn log() -> EntityPath {
    path(&["log"])
}

/// What came out.
pub(super) fn summary() -> EntityPath {
    path(&["summary"])
}

/// The recording's properties of this program.
pub(super) fn properties() -> EntityPath {
    EntityPath::properties().join(&path(&["congruent"]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hostile_name_is_one_part() {
        for name in ["a/b", "../x", "<", "a b", "$origin", "+ /**"] {
            let path = twin(name);
            assert_eq!(path.len(), 3, "{path}");
            assert_eq!(path.last().unwrap().unescaped_str(), name);
            assert_eq!(EntityPath::parse_strict(&path.to_string()).unwrap(), path, "{path}");
        }
    }
}
