//! `[[obstacle]]`: what stands around the robot, in the root link's frame.

use congruent_description::{Diagnostic, Geometry, WrittenTransform};
use congruent_simulation::Obstacle;
use nalgebra::{Isometry3, Vector3};
use serde::Deserialize;
use toml::Spanned;

use super::{number::Positive, section::Section};

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
    box_m: Option<[Positive; 3]>,
    sphere_radius_m: Option<Positive>,
    cylinder: Option<Cylinder>,
    xyz_m: Option<Spanned<[f64; 3]>>,
    xyz_mm: Option<Spanned<[f64; 3]>>,
    rpy_deg: Option<Spanned<[f64; 3]>>,
    rpy_rad: Option<Spanned<[f64; 3]>>,
}

/// Reads all obstacles; names are unique.
pub(super) fn read(sections: Vec<Section<'_>>) -> Result<Vec<Obstacle>, Vec<Diagnostic>> {
    let mut obstacles: Vec<Obstacle> = Vec::new();
    let mut errors = Vec::new();
    for section in sections {
        let span = section.span();
        match section.read::<Written>().and_then(|written| check(written, span.clone())) {
            Ok(obstacle) if obstacles.iter().any(|known| known.name == obstacle.name) => {
                let message = format!("two obstacles are named \"{}\"", obstacle.name);
                errors.push(Diagnostic::error("scenario::obstacle_twice", message).at(span));
            }
            Ok(obstacle) => obstacles.push(obstacle),
            Err(error) => errors.push(error),
        }
    }
    if errors.is_empty() { Ok(obstacles) } else { Err(errors) }
}

fn check(written: Written, span: std::ops::Range<usize>) -> Result<Obstacle, Diagnostic> {
    let geometry = match (written.box_m, written.sphere_radius_m, written.cylinder) {
        (Some(size), None, None) => Geometry::Box { size_m: Vector3::from(size.map(Positive::get)) },
        (None, Some(radius), None) => Geometry::Sphere { radius_m: radius.get() },
        (None, None, Some(Cylinder { radius_m, length_m })) => {
            Geometry::Cylinder { radius_m: radius_m.get(), length_m: length_m.get() }
        }
        _ => {
            let message = format!("obstacle \"{}\" has not exactly one shape", written.name.get_ref());
            return Err(Diagnostic::error("scenario::obstacle_shape", message)
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
