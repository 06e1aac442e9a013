//! `[[obstacle]]`: what stands around the robot, in the root link's frame. A `[[zone]]` is placed and
//! shaped by the same keys, so its reader calls this one.

use congruent_description::{Diagnostic, Geometry, Robot, WrittenTransform, fixed_array};
use congruent_simulation::Obstacle;
use nalgebra::{Isometry3, Vector3};
use serde::Deserialize;
use toml::Spanned;

use super::{number::Positive, section::Section};

/// Largest size and coordinate of an obstacle or zone: beyond it, rounding is no longer small against the
/// accuracy of distances, and far beyond it products overflow.
const LARGEST_M: f64 = 1e5;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Cylinder {
    radius_m: Positive,
    length_m: Positive,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    name: Spanned<String>,
    #[serde(default, deserialize_with = "fixed_array")]
    box_m: Option<Spanned<[Positive; 3]>>,
    sphere_radius_m: Option<Positive>,
    cylinder: Option<Cylinder>,
    #[serde(default, deserialize_with = "fixed_array")]
    xyz_m: Option<Spanned<[f64; 3]>>,
    #[serde(default, deserialize_with = "fixed_array")]
    xyz_mm: Option<Spanned<[f64; 3]>>,
    #[serde(default, deserialize_with = "fixed_array")]
    rpy_deg: Option<Spanned<[f64; 3]>>,
    #[serde(default, deserialize_with = "fixed_array")]
    rpy_rad: Option<Spanned<[f64; 3]>>,
}

/// What a section describes: the word for it, and the codes of what may be wrong with one.
pub(super) struct Kind {
    word: &'static str,
    twice: &'static str,
    is_link: &'static str,
    size: &'static str,
    name: &'static str,
    shape: &'static str,
}

/// `[[obstacle]]`.
pub(super) const OBSTACLE: Kind = Kind {
    word: "obstacle",
    twice: "scenario::obstacle_twice",
    is_link: "scenario::obstacle_is_link",
    size: "scenario::obstacle_size",
    name: "scenario::obstacle_name",
    shape: "scenario::obstacle_shape",
};

/// `[[zone]]`.
pub(super) const ZONE: Kind = Kind {
    word: "zone",
    twice: "scenario::zone_twice",
    is_link: "scenario::zone_is_link",
    size: "scenario::zone_size",
    name: "scenario::zone_name",
    shape: "scenario::zone_shape",
};

/// Reads all of one kind; no other of that kind and no link of the robot has its name.
pub(super) fn read(
    sections: Vec<Section<'_>>,
    kind: &Kind,
    robot: &Robot,
) -> Result<Vec<Obstacle>, Vec<Diagnostic>> {
    let mut obstacles: Vec<Obstacle> = Vec::new();
    let mut errors = Vec::new();
    for section in sections {
        let span = section.span();
        match read_one(section, kind) {
            Ok(obstacle) if obstacles.iter().any(|known| known.name == obstacle.name) => {
                let message = format!("two {}s are named \"{}\"", kind.word, obstacle.name);
                errors.push(Diagnostic::error(kind.twice, message).at(span));
            }
            Ok(obstacle) if robot.find_link(&obstacle.name).is_some() => {
                let message = format!("{} \"{}\" is named as a link of the robot", kind.word, obstacle.name);
                errors.push(Diagnostic::error(kind.is_link, message).at(span));
            }
            Ok(obstacle) => obstacles.push(obstacle),
            Err(found) => errors.extend(found),
        }
    }
    if errors.is_empty() { Ok(obstacles) } else { Err(errors) }
}

fn read_one(section: Section<'_>, kind: &Kind) -> Result<Obstacle, Vec<Diagnostic>> {
    section.require_table("cylinder")?;
    let span = section.span();
    let obstacle = check(section.read()?, kind, span.clone())?;
    let furthest_m = obstacle.world_from_obstacle.translation.vector.amax().max(largest_size_m(&obstacle));
    if furthest_m > LARGEST_M {
        let message = format!("{} \"{}\" is {furthest_m:e} m large or far", kind.word, obstacle.name);
        return Err(Diagnostic::error(kind.size, message)
            .with_help(format!("sizes and coordinates are at most {LARGEST_M} m"))
            .at(span)
            .into());
    }
    Ok(obstacle)
}

fn largest_size_m(obstacle: &Obstacle) -> f64 {
    match &obstacle.geometry {
        Geometry::Box { size_m } => size_m.amax(),
        Geometry::Cylinder { radius_m, length_m } => radius_m.max(*length_m),
        Geometry::Sphere { radius_m } => *radius_m,
        Geometry::Mesh(_) => unreachable!("scenarios have no meshes of their own"),
    }
}

fn check(written: Written, kind: &Kind, span: std::ops::Range<usize>) -> Result<Obstacle, Diagnostic> {
    if written.name.get_ref().trim().is_empty() {
        return Err(Diagnostic::error(kind.name, format!("the {}'s name is empty", kind.word))
            .with_help("reports name it when something comes too close")
            .at(written.name.span()));
    }
    let geometry = match (written.box_m, written.sphere_radius_m, written.cylinder) {
        (Some(size), None, None) => {
            Geometry::Box { size_m: Vector3::from(size.into_inner().map(Positive::get)) }
        }
        (None, Some(radius), None) => Geometry::Sphere { radius_m: radius.get() },
        (None, None, Some(Cylinder { radius_m, length_m })) => {
            Geometry::Cylinder { radius_m: radius_m.get(), length_m: length_m.get() }
        }
        _ => {
            let message = format!("{} \"{}\" has not exactly one shape", kind.word, written.name.get_ref());
            return Err(Diagnostic::error(kind.shape, message)
                .with_help("give one of `box_m`, `sphere_radius_m`, `cylinder`")
                .at(span));
        }
    };
    let pose = WrittenTransform {
        xyz_m: written.xyz_m,
        xyz_mm: written.xyz_mm,
        rpy_deg: written.rpy_deg,
        rpy_rad: written.rpy_rad,
        ..WrittenTransform::default()
    };
    let world_from_obstacle: Isometry3<f64> = pose.isometry()?;
    Ok(Obstacle { name: written.name.into_inner(), world_from_obstacle, geometry })
}
