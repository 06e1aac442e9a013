//! Entity paths of a recording. Names come from robot files, so each is one part of a path and is never
//! parsed as a path: a link `a/b` is one entity.

use re_log_types::{EntityPath, EntityPathPart};

/// The path with these parts.
pub(crate) fn path(parts: &[&str]) -> EntityPath {
    EntityPath::new(parts.iter().map(|&part| EntityPathPart::new(part)).collect())
}

/// Everything that is drawn in three dimensions, in the frame of the root link.
pub(crate) fn world() -> EntityPath {
    path(&["world"])
}

/// A link at its pose in the physics twin.
pub(crate) fn twin(link: &str) -> EntityPath {
    path(&["world", "twin", link])
}

/// A link at its pose in the analytical model.
pub(crate) fn model(link: &str) -> EntityPath {
    path(&["world", "model", link])
}

/// An obstacle at its pose in the root link's frame.
pub(crate) fn obstacle(name: &str) -> EntityPath {
    path(&["world", "obstacle", name])
}

/// A zone that links may not enter.
pub(crate) fn zone(name: &str) -> EntityPath {
    path(&["world", "zone", name])
}

/// The name of an obstacle or of a zone, below it.
pub(crate) fn name_of(body: &EntityPath) -> EntityPath {
    body / EntityPathPart::new("name")
}

/// The parent of all frames, which the layout hides at first.
pub(crate) fn frames() -> EntityPath {
    path(&["world", "frame"])
}

/// A frame of a kind: of a link, of the table, or the tool's.
pub(crate) fn frame(kind: &str, name: &str) -> EntityPath {
    path(&["world", "frame", kind, name])
}

/// Lines between the nearest points of bodies that are too close, or near.
pub(crate) fn nearest() -> EntityPath {
    path(&["world", "nearest"])
}

/// The path of the tool.
pub(crate) fn trail() -> EntityPath {
    path(&["world", "trail"])
}

/// Arrows from the twin's links to the model's links outside the limits.
pub(crate) fn error_arrows() -> EntityPath {
    path(&["world", "error"])
}

/// The link with the largest error.
pub(crate) fn worst_error() -> EntityPath {
    path(&["world", "error", "worst"])
}

/// Distance between the origins of model and twin at a link, m.
pub(crate) fn position_error(link: &str) -> EntityPath {
    path(&["agreement", "position", link])
}

/// Angle between the orientations of model and twin at a link, rad.
pub(crate) fn orientation_error(link: &str) -> EntityPath {
    path(&["agreement", "orientation", link])
}

/// The largest error of all links at each recorded time, as a power of ten.
pub(crate) fn worst_of_links(quantity: &str) -> EntityPath {
    path(&["agreement", "worst", quantity])
}

/// Position of a joint, rad or m.
pub(crate) fn joint_position(joint: &str) -> EntityPath {
    joint_value("position", joint)
}

/// A value of a joint: `velocity`, `effort`, or what is commanded or measured.
pub(crate) fn joint_value(quantity: &str, joint: &str) -> EntityPath {
    path(&["joint", quantity, joint])
}

/// A coordinate of the TCP by `twin` or by `model`: `x_m`, ..., `quaternion_w`, ...
pub(crate) fn tcp(source: &str, coordinate: &str) -> EntityPath {
    path(&["tcp", source, coordinate])
}

/// A distance, m: `minimum`, `limit`, or the distance of a named pair.
pub(crate) fn clearance(name: &str) -> EntityPath {
    path(&["clearance", name])
}

/// The distance of the nearest link from a zone, m.
pub(crate) fn zone_distance(zone: &str) -> EntityPath {
    path(&["zone", "distance", zone])
}

/// The limit of those distances.
pub(crate) fn zone_limit(name: &str) -> EntityPath {
    path(&["zone", name])
}

/// The `upper` or the `lower` limit of a quantity of a joint.
pub(crate) fn joint_limit(quantity: &str, joint: &str, side: &str) -> EntityPath {
    path(&["joint_limit", quantity, joint, side])
}

/// The limit of a quantity of a check.
pub(crate) fn check_limit(check: &str, quantity: &str) -> EntityPath {
    path(&["limit", check, quantity])
}

/// A quantity of a check; the number of the check and the unit make both names unique.
pub(crate) fn check(check: &str, quantity: &str) -> EntityPath {
    path(&["check", check, quantity])
}

/// The status of a check over time, below its last one: the viewer orders the lanes by path, and of the statuses `error`
/// and `fail` come before `pass` and `skipped`.
pub(crate) fn status(last: &str, check: &str) -> EntityPath {
    path(&["status", last, check])
}

/// The events of the run.
pub(crate) fn log() -> EntityPath {
    path(&["log"])
}

/// The document with the results of the run.
pub(crate) fn summary() -> EntityPath {
    path(&["summary"])
}

/// The properties that this program adds to the recording.
pub(crate) fn properties() -> EntityPath {
    EntityPath::properties().join(&path(&["congruent"]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_name_is_one_part_of_a_path() {
        for name in ["a/b", "../x", "<", "a b", "$origin", "+ /**"] {
            let path = twin(name);
            assert_eq!(path.len(), 3, "{path}");
            assert_eq!(path.last().unwrap().unescaped_str(), name);
            assert_eq!(EntityPath::parse_strict(&path.to_string()).unwrap(), path, "{path}");
        }
    }
}
