//! `[[obstacle]]` and `[[zone]]` as bodies around the robot, in the root link's frame.

use congruent_description::{Geometry, Obstacle, Robot, read_mesh};
use congruent_input::{Code, Diagnostic, Findings};
use congruent_scenario::{CylinderSettings, FilePlace, ObstacleSettings, PoseSettings, ScenarioFolder};
use nalgebra::Vector3;

use crate::codes;

/// Largest size and coordinate of an obstacle or zone: beyond it, rounding is no longer small against the
/// accuracy of distances, and far beyond it products overflow.
pub(crate) const LARGEST_M: f64 = 1e5;

/// Texts of a section: its name in messages, and the codes of its errors.
pub(super) struct SpaceKind {
    word: &'static str,
    twice: &'static Code,
    is_link: &'static Code,
    size: &'static Code,
    name: &'static Code,
    shape: &'static Code,
    /// The help if there is not exactly one shape.
    shapes: &'static str,
}

/// Texts and codes of `[[obstacle]]` sections.
pub(super) const OBSTACLE: SpaceKind = SpaceKind {
    word: "obstacle",
    twice: codes::scenario::OBSTACLE_TWICE,
    is_link: codes::scenario::OBSTACLE_IS_LINK,
    size: codes::scenario::OBSTACLE_SIZE,
    name: codes::scenario::OBSTACLE_NAME,
    shape: codes::scenario::OBSTACLE_SHAPE,
    shapes: "give one of `box_m`, `sphere_radius_m`, `cylinder`, `mesh`",
};

/// Texts and codes of `[[zone]]` sections.
pub(super) const ZONE: SpaceKind = SpaceKind {
    word: "zone",
    twice: codes::scenario::ZONE_TWICE,
    is_link: codes::scenario::ZONE_IS_LINK,
    size: codes::scenario::ZONE_SIZE,
    name: codes::scenario::ZONE_NAME,
    shape: codes::scenario::ZONE_SHAPE,
    shapes: "give one of `box_m`, `sphere_radius_m`, `cylinder`",
};

/// Builds all obstacles, or all zones; names must be unique, also among the links of the robot.
pub(super) fn build(
    all: &[ObstacleSettings],
    places: FilePlace<'_>,
    kind: &SpaceKind,
    folder: ScenarioFolder<'_>,
    robot: &Robot,
) -> Result<Vec<Obstacle>, Findings> {
    let mut obstacles: Vec<Obstacle> = Vec::new();
    let mut errors = Vec::new();
    for (index, settings) in all.iter().enumerate() {
        let place = places.item(index);
        match obstacle(settings, place, kind, folder) {
            Ok(obstacle) if obstacles.iter().any(|known| known.name == obstacle.name) => {
                let message = format!("two {}s are named \"{}\"", kind.word, obstacle.name);
                errors.push(place.mark(Diagnostic::error(kind.twice, message)));
            }
            // Checks and reports name both kinds in one list: the same name twice would be ambiguous.
            Ok(obstacle) if robot.find_link(&obstacle.name).is_some() => {
                let message =
                    format!("{} \"{}\" has the name of a link of the robot", kind.word, obstacle.name);
                errors.push(place.mark(Diagnostic::error(kind.is_link, message)));
            }
            Ok(obstacle) => obstacles.push(obstacle),
            Err(error) => errors.push(error),
        }
    }
    if errors.is_empty() { Ok(obstacles) } else { Err(errors.into()) }
}

fn obstacle(
    settings: &ObstacleSettings,
    place: FilePlace<'_>,
    kind: &SpaceKind,
    folder: ScenarioFolder<'_>,
) -> Result<Obstacle, Diagnostic> {
    if settings.name.trim().is_empty() {
        return Err(place.key("name").mark(
            Diagnostic::error(kind.name, format!("the {}'s name is empty", kind.word))
                .with_help("give a name: reports use it"),
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
            // A fault inside the mesh has its place in that file; one of its path belongs to the key.
            let read = read_mesh(folder.path, mesh, scale, folder.access);
            let mesh =
                read.map_err(
                    |fault| if fault.source.is_none() { place.key("mesh").mark(fault) } else { fault },
                )?;
            Geometry::Mesh(mesh)
        }
        _ => {
            let message = format!("{} \"{}\" must have exactly one shape", kind.word, settings.name);
            return Err(place.mark(Diagnostic::error(kind.shape, message).with_help(kind.shapes)));
        }
    };
    let ObstacleSettings { xyz_m, xyz_mm, rpy_deg, rpy_rad, .. } = *settings;
    let pose = PoseSettings { xyz_m, xyz_mm, rpy_rad, rpy_deg, ..PoseSettings::default() };
    let world_from_obstacle = pose.isometry(place)?;
    // Written lengths were checked to be finite before, so that `max` drops no NaN.
    let furthest_m = world_from_obstacle.translation.vector.amax().max(largest_size_m(&geometry));
    if furthest_m > LARGEST_M {
        let message = format!(
            "{} \"{}\": a size or coordinate is {furthest_m:e} m, limit <= {LARGEST_M} m",
            kind.word, settings.name
        );
        return Err(place.mark(
            Diagnostic::error(kind.size, message)
                .with_help("give lengths in metres, or coordinates in millimetres under `xyz_mm`"),
        ));
    }
    Ok(Obstacle { name: settings.name.clone(), world_from_obstacle, geometry })
}

fn largest_size_m(geometry: &Geometry) -> f64 {
    match geometry {
        Geometry::Box { size_m } => size_m.amax(),
        Geometry::Cylinder { radius_m, length_m } => radius_m.max(*length_m),
        Geometry::Sphere { radius_m } => *radius_m,
        Geometry::Ellipsoid { semi_axes_m } => semi_axes_m.amax(),
        Geometry::Mesh(mesh) => mesh.vertices_m.iter().map(|vertex| vertex.coords.amax()).fold(0.0, f64::max),
    }
}
