//! `[[obstacle]]` and `[[zone]]` as bodies around the robot, in the root link's frame.

use congruent_description::{Diagnostic, Geometry, Robot};
use congruent_simulation::Obstacle;
use nalgebra::Vector3;

use crate::scenario::{CylinderSettings, FilePlace, ObstacleSettings, PoseSettings, ScenarioFolder};

/// Largest size and coordinate of an obstacle or zone: beyond it, rounding is no longer small against the
/// accuracy of distances, and far beyond it products overflow.
pub(crate) const LARGEST_M: f64 = 1e5;

/// What a section describes: its word in messages, and the codes of its faults.
pub(super) struct SpaceKind {
    word: &'static str,
    twice: &'static str,
    is_link: &'static str,
    size: &'static str,
    name: &'static str,
    shape: &'static str,
    /// The help if there is not exactly one shape.
    shapes: &'static str,
}

/// `[[obstacle]]`.
pub(super) const OBSTACLE: SpaceKind = SpaceKind {
    word: "obstacle",
    twice: "scenario::obstacle_twice",
    is_link: "scenario::obstacle_is_link",
    size: "scenario::obstacle_size",
    name: "scenario::obstacle_name",
    shape: "scenario::obstacle_shape",
    shapes: "give one of `box_m`, `sphere_radius_m`, `cylinder`, `mesh`",
};

/// `[[zone]]`.
pub(super) const ZONE: SpaceKind = SpaceKind {
    word: "zone",
    twice: "scenario::zone_twice",
    is_link: "scenario::zone_is_link",
    size: "scenario::zone_size",
    name: "scenario::zone_name",
    shape: "scenario::zone_shape",
    shapes: "give one of `box_m`, `sphere_radius_m`, `cylinder`",
};

/// Builds all of one kind; no other of that kind and no link of the robot has its name.
pub(super) fn build(
    all: &[ObstacleSettings],
    places: FilePlace<'_>,
    (kind, folder): (&SpaceKind, ScenarioFolder<'_>),
    robot: &Robot,
) -> Result<Vec<Obstacle>, Vec<Diagnostic>> {
    let mut obstacles: Vec<Obstacle> = Vec::new();
    let mut errors = Vec::new();
    for (index, settings) in all.iter().enumerate() {
        let place = places.item(index);
        match obstacle(settings, place, (kind, folder)) {
            Ok(obstacle) if obstacles.iter().any(|known| known.name == obstacle.name) => {
                let message = format!("two {}s are named \"{}\"", kind.word, obstacle.name);
                errors.push(place.mark(Diagnostic::error(kind.twice, message)));
            }
            Ok(obstacle) if robot.find_link(&obstacle.name).is_some() => {
                let message = format!("{} \"{}\" is named as a link of the robot", kind.word, obstacle.name);
                errors.push(place.mark(Diagnostic::error(kind.is_link, message)));
            }
            Ok(obstacle) => obstacles.push(obstacle),
            Err(error) => errors.push(error),
        }
    }
    if errors.is_empty() { Ok(obstacles) } else { Err(errors) }
}

fn obstacle(
    settings: &ObstacleSettings,
    place: FilePlace<'_>,
    (kind, folder): (&SpaceKind, ScenarioFolder<'_>),
) -> Result<Obstacle, Diagnostic> {
    if settings.name.trim().is_empty() {
        return Err(place.key("name").mark(
            Diagnostic::error(kind.name, format!("the {}'s name is empty", kind.word))
                .with_help("reports name it if something comes too close"),
        ));
    }
    if settings.scale.is_some() && settings.mesh.is_none() {
        let message = format!("{} \"{}\" has a `scale`, but no mesh", kind.word, settings.name);
        return Err(place.key("scale").mark(Diagnostic::error(kind.shape, message)));
    }
    let geometry = match (settings.box_m, settings.sphere_radius_m, settings.cylinder, &settings.mesh) {
        (Some(size), None, None, None) => Geometry::Box { size_m: Vector3::from(size) },
        (None, Some(radius_m), None, None) => Geometry::Sphere { radius_m },
        (None, None, Some(CylinderSettings { radius_m, length_m }), None) => {
            Geometry::Cylinder { radius_m, length_m }
        }
        (None, None, None, Some(mesh)) => {
            let scale = Vector3::from(settings.scale.unwrap_or([1.0; 3]));
            let read = folder.read_mesh(mesh, scale);
            let mesh =
                read.map_err(
                    |fault| if fault.source.is_none() { place.key("mesh").mark(fault) } else { fault },
                )?;
            Geometry::Mesh(mesh)
        }
        _ => {
            let message = format!("{} \"{}\" has not exactly one shape", kind.word, settings.name);
            return Err(place.mark(Diagnostic::error(kind.shape, message).with_help(kind.shapes)));
        }
    };
    let ObstacleSettings { xyz_m, xyz_mm, rpy_deg, rpy_rad, .. } = *settings;
    let pose = PoseSettings { xyz_m, xyz_mm, rpy_rad, rpy_deg, ..PoseSettings::default() };
    let world_from_obstacle = pose.isometry(place)?;
    let furthest_m = world_from_obstacle.translation.vector.amax().max(largest_size_m(&geometry));
    if furthest_m > LARGEST_M {
        let message = format!("{} \"{}\" is {furthest_m:e} m large or far", kind.word, settings.name);
        return Err(place.mark(
            Diagnostic::error(kind.size, message)
                .with_help(format!("sizes and coordinates are at most {LARGEST_M} m")),
        ));
    }
    Ok(Obstacle { name: settings.name.clone(), world_from_obstacle, geometry })
}

fn largest_size_m(geometry: &Geometry) -> f64 {
    match geometry {
        Geometry::Box { size_m } => size_m.amax(),
        Geometry::Cylinder { radius_m, length_m } => radius_m.max(*length_m),
        Geometry::Sphere { radius_m } => *radius_m,
        Geometry::Mesh(mesh) => mesh.vertices_m.iter().map(|vertex| vertex.coords.amax()).fold(0.0, f64::max),
    }
}
