//! The shapes of links, obstacles and zones with their names, and the style of the tool's trail.

use congruent_description::{Geometry, Link, Obstacle, Robot, Shape};
use congruent_monitors::RecordingError;
use congruent_twin::RunSetup;
use nalgebra::{Isometry3, Point3};
use re_log_types::{EntityPath, TimePoint};
use re_sdk_types::{
    archetypes::{LineStrips3D, Points3D, ViewCoordinates},
    components::{Color, Radius},
};

use super::{
    camera::BoundingBox,
    palette,
    visual::{Coloring, VisualBody},
};
use crate::rrd::{convert::vector, paths, writer::RrdWriter};

/// Thickness of the tool's trail on the screen.
const TRAIL_UI_POINTS: f32 = 1.5;

/// Inset of the model's surfaces below the twin's: only the twin is visible if both agree, and the model
/// appears beside it if they do not.
const MODEL_INSET_M: f64 = 5e-4;

/// A link of the twin, an obstacle or a zone.
#[derive(Debug)]
pub(crate) struct SceneBody {
    /// Entity of the body, which its pose and its colour over time are logged to.
    pub(crate) path: EntityPath,
    /// Its shapes in the colours of its description.
    pub(crate) visual: VisualBody,
    /// Its colour while it violates a limit.
    pub(crate) violating: Color,
}

/// The twin's links, then the obstacles, then the zones.
pub(crate) fn bodies(setup: &RunSetup) -> Vec<SceneBody> {
    let robot = &setup.description.robot;
    let links = robot.links().iter().zip(link_visuals(robot, 0.0));
    let links = links.map(|(link, visual)| SceneBody {
        path: paths::twin(&link.name),
        visual,
        violating: palette::OUTSIDE,
    });
    let obstacles = setup.obstacles.iter().enumerate().map(|(index, obstacle)| SceneBody {
        path: paths::obstacle(&obstacle.name),
        visual: space_visual(&placed(setup, index), palette::obstacle(index)),
        violating: palette::OUTSIDE_OBSTACLE,
    });
    let zones = setup.zones.iter().map(|zone| SceneBody {
        path: paths::zone(&zone.space.name),
        visual: space_visual(&zone.space, palette::ZONE),
        violating: palette::OUTSIDE_ZONE,
    });
    links.chain(obstacles).chain(zones).collect()
}

/// The links: visual shapes, or collision shapes for a link without visual ones.
fn link_visuals(robot: &Robot, inset_m: f64) -> impl Iterator<Item = VisualBody> {
    robot.links().iter().map(move |link: &Link| {
        let shapes = if link.visuals.is_empty() { &link.collisions } else { &link.visuals };
        VisualBody::new(shapes, palette::UNPAINTED, inset_m)
    })
}

/// An obstacle at its pose; at the origin if it moves, since its pose is recorded over time.
fn placed(setup: &RunSetup, index: usize) -> Obstacle {
    let obstacle = setup.obstacles[index].clone();
    // Its recorded poses place it, so that the shape is given in its own frame.
    if setup.bodies.iter().any(|body| body.obstacle == index) {
        return Obstacle { world_from_obstacle: Isometry3::identity(), ..obstacle };
    }
    obstacle
}

/// Writes all shapes, those of `bodies` without colours, which change over time.
pub(crate) fn write(
    writer: &mut RrdWriter,
    setup: &RunSetup,
    bodies: &[SceneBody],
) -> Result<(), RecordingError> {
    writer.log_static(&paths::world(), &ViewCoordinates::RIGHT_HAND_Z_UP())?;
    for body in bodies {
        write_body(writer, &body.visual, &body.path, None)?;
    }
    let robot = &setup.description.robot;
    for (link, model) in robot.links().iter().zip(link_visuals(robot, MODEL_INSET_M)) {
        write_body(writer, &model, &paths::model(&link.name), Some(Coloring::Uniform(palette::MODEL)))?;
    }
    let trail = LineStrips3D::update_fields()
        .with_colors([palette::TRAIL])
        .with_radii([Radius::new_ui_points(TRAIL_UI_POINTS)]);
    writer.log_static(&paths::trail(), &trail)
}

/// An obstacle, or a zone, which has the same form.
fn space_visual(space: &Obstacle, color: Color) -> VisualBody {
    let shape = Shape {
        link_from_shape: space.world_from_obstacle,
        geometry: space.geometry.clone(),
        color_rgba: None,
    };
    VisualBody::new(&[shape], color, 0.0)
}

/// Writes the names of obstacles and zones into the picture, each on top of the part that is in view.
pub(crate) fn write_names(
    writer: &mut RrdWriter,
    obstacles: &[Obstacle],
    moving: &[String],
    zones: &[Obstacle],
    robot: BoundingBox,
) -> Result<(), RecordingError> {
    let framed = robot.with_obstacles(obstacles);
    for obstacle in obstacles {
        let path = paths::obstacle(&obstacle.name);
        let top = if moving.contains(&obstacle.name) {
            Point3::origin() // of its own frame, which moves
        } else {
            framed.top_of(obstacle)
        };
        write_name(writer, &path, &obstacle.name, top)?;
    }
    for zone in zones {
        write_name(writer, &paths::zone(&zone.name), &zone.name, framed.top_of(zone))?;
    }
    Ok(())
}

fn write_name(
    writer: &mut RrdWriter,
    path: &EntityPath,
    name: &str,
    at: Point3<f64>,
) -> Result<(), RecordingError> {
    let label = Points3D::new([vector(&at.coords)])
        .with_radii([Radius::new_ui_points(0.0)])
        .with_colors([palette::NEUTRAL])
        .with_labels([name])
        .with_show_labels(true);
    writer.log_static(&paths::name_of(path), &label)
}

/// The box around the shapes of a link, in its own frame; its origin if it has none.
pub(crate) fn link_box(link: &Link) -> BoundingBox {
    let shapes = if link.visuals.is_empty() { &link.collisions } else { &link.visuals };
    let mut all = BoundingBox::empty();
    all.include(&Point3::origin());
    for shape in shapes {
        match &shape.geometry {
            Geometry::Mesh(mesh) => {
                mesh.vertices_m.iter().for_each(|vertex| all.include(&(shape.link_from_shape * vertex)));
            }
            geometry => all.include_box(&BoundingBox::around(geometry), &shape.link_from_shape),
        }
    }
    all
}

/// Writes shapes and colours in one row for each path.
fn write_body(
    writer: &mut RrdWriter,
    body: &VisualBody,
    path: &EntityPath,
    coloring: Option<Coloring>,
) -> Result<(), RecordingError> {
    // Shapes and colours have the same parts in the same order.
    let mut colors = coloring.map_or_else(Vec::new, |coloring| body.colors(path, coloring)).into_iter();
    for (path, mut parts) in body.shapes(path) {
        parts.extend(colors.next().into_iter().flat_map(|(_, colors)| colors));
        writer.row(&path, TimePoint::default(), parts)?;
    }
    Ok(())
}
