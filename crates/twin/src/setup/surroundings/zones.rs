//! `[[zone]]`: space that links are forbidden to enter, in the root link's frame. A zone is not a body:
//! only the check `zone` uses it, not the physics.

use std::path::Path;

use congruent_description::{Geometry, Link, LinkIndex, Robot};
use congruent_input::{Diagnostic, FileAccess, Findings, known_names};
use congruent_proximity::{Zone, matches};
use congruent_scenario::{Check, CheckKind, FilePlace, ObstacleSettings, ScenarioFolder, ZoneSettings};

use super::spaces;
use crate::codes;

/// Builds all zones; the rules for names are those of obstacles.
///
/// `links` holds names of links, in which `*` matches any characters. A name with `*` means the
/// links that can move and have a collision shape, not those that are fixed to the root. A link
/// that is named in full is always included.
pub(in crate::setup) fn build(
    all: &[ZoneSettings],
    places: FilePlace<'_>,
    robot: &Robot,
) -> Result<Vec<Zone>, Findings> {
    let mut errors = Vec::new();
    let mut links = Vec::new();
    for (index, zone) in all.iter().enumerate() {
        match forbidden_links(&zone.links, places.item(index), robot) {
            Ok(found) => links.push(found),
            Err(found) => errors.extend(found),
        }
    }
    let spaces: Vec<ObstacleSettings> = all.iter().map(ZoneSettings::space).collect();
    // No zone has a mesh.
    let folder = ScenarioFolder { path: Path::new(""), access: &FileAccess::default() };
    let spaces =
        spaces::build(&spaces, places, &spaces::ZONE, folder, robot).map_err(|found| errors.extend(found));
    // With an error in either list the two differ in length, and links would go to the wrong zones.
    match spaces {
        Ok(spaces) if errors.is_empty() => {
            Ok(spaces.into_iter().zip(links).map(|(space, links)| Zone { space, links }).collect())
        }
        _ => Err(errors.into()),
    }
}

/// A scenario has zones if and only if it has the check `zone`: either alone would have no effect.
pub(in crate::setup) fn paired_with_checks(
    zones: &[ZoneSettings],
    checks: &[Check],
    place: FilePlace<'_>,
) -> Result<(), Diagnostic> {
    let word = CheckKind::Zone.word();
    let check = checks.iter().position(|check| check.kind() == CheckKind::Zone);
    match (zones.is_empty(), check) {
        (false, None) => Err(place.key("zone").item(0).mark(
            Diagnostic::error(codes::scenario::ZONE_UNCHECKED, "no check covers the zones of this scenario")
                .with_help(format!("add a [[check]] with kind = \"{word}\"")),
        )),
        (true, Some(check)) => {
            let message = format!("check \"{word}\" has nothing to check: the scenario has no zone");
            Err(place.key("check").item(check).mark(
                Diagnostic::error(codes::scenario::NO_ZONE, message)
                    .with_help("add a [[zone]] with a name, links, a shape and a position"),
            ))
        }
        _ => Ok(()),
    }
}

fn forbidden_links(
    names: &[String],
    place: FilePlace<'_>,
    robot: &Robot,
) -> Result<Vec<LinkIndex>, Findings> {
    if names.is_empty() {
        return Err(place
            .mark(
                Diagnostic::error(
                    codes::scenario::ZONE_LINKS,
                    "the zone has no `links`: no link is forbidden to enter",
                )
                .with_help("give links = [\"*\"] for all moving links, or names of links"),
            )
            .into());
    }
    let mut links = Vec::new();
    let mut errors = Vec::new();
    for (index, name) in names.iter().enumerate() {
        match links_named(name, robot) {
            Ok(found) => links.extend(found),
            Err(error) => errors.push(place.key("links").item(index).mark(error)),
        }
    }
    // Patterns may overlap; a link twice would be two pairs with one zone.
    links.sort_unstable();
    links.dedup();
    if errors.is_empty() { Ok(links) } else { Err(errors.into()) }
}

fn links_named(name: &str, robot: &Robot) -> Result<Vec<LinkIndex>, Diagnostic> {
    let can_enter = |link: LinkIndex| has_shape(robot.link(link));
    if name.contains('*') {
        let links = robot.link_indices().filter(|&link| {
            can_enter(link) && robot.body(link) != robot.root() && matches(name, &robot.link(link).name)
        });
        let links: Vec<LinkIndex> = links.collect();
        return if links.is_empty() { Err(no_link(name, robot)) } else { Ok(links) };
    }
    match robot.find_link(name) {
        None => Err(no_link(name, robot)),
        Some(link) if can_enter(link) => Ok(vec![link]),
        Some(_) => {
            let message = format!("link \"{name}\" has no collision shape, so it cannot enter a zone");
            Err(Diagnostic::error(codes::scenario::ZONE_LINKS, message).with_help(known_names(
                "",
                "links with a collision shape",
                links_with_shape(robot),
            )))
        }
    }
}

fn no_link(name: &str, robot: &Robot) -> Diagnostic {
    let what = if name.contains('*') { "moving link with a collision shape" } else { "link" };
    Diagnostic::error(
        codes::scenario::UNKNOWN_LINK,
        format!("robot \"{}\" has no {what} \"{name}\"", robot.name()),
    )
    .with_help(known_names(name, "links", links_with_shape(robot)))
}

fn links_with_shape(robot: &Robot) -> impl Iterator<Item = &str> + Clone {
    robot.links().iter().filter(|link| has_shape(link)).map(|link| link.name.as_str())
}

/// Whether the link has a collision shape; a mesh without triangles does not count.
fn has_shape(link: &Link) -> bool {
    let is_empty =
        |geometry: &Geometry| matches!(geometry, Geometry::Mesh(mesh) if mesh.triangles.is_empty());
    link.collisions.iter().any(|shape| !is_empty(&shape.geometry))
}
