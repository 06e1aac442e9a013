//! The shapes of links, obstacles and zones, and the style of the tool's trail.

use congruent_description::{Link, Robot, Shape};
use congruent_simulation::Obstacle;
use congruent_twin::{RunSetup, recorder::RecordingError};
use nalgebra::Isometry3;
use re_log_types::{EntityPath, TimePoint};
use re_sdk_types::{
    archetypes::{LineStrips3D, ViewCoordinates},
    components::{Color, Radius},
};

use super::{
    palette,
    visual::{Coloring, VisualBody},
};
use crate::rrd::{paths, writer::RrdWriter};

/// Thickness of the tool's trail on the screen.
const TRAIL_UI_POINTS: f32 = 1.5;

/// Inset of the model's surfaces below the twin's: only the twin is visible if both agree, and the model
/// appears beside it if they do not.
const MODEL_INSET_M: f64 = 5e-4;

/// The bodies of the robot's links: visual shapes, or collision shapes for a link without visual ones.
pub(crate) fn bodies(robot: &Robot, inset_m: f64) -> Vec<VisualBody> {
    let body = |(index, link): (usize, &Link)| {
        let shapes = if link.visuals.is_empty() { &link.collisions } else { &link.visuals };
        VisualBody::new(shapes, palette::link(index), inset_m)
    };
    robot.links().iter().enumerate().map(body).collect()
}

/// Writes all shapes, those of the twin's links without colours, which follow the errors.
pub(crate) fn write(
    writer: &mut RrdWriter,
    setup: &RunSetup,
    twin: &[VisualBody],
) -> Result<(), RecordingError> {
    writer.log_static(&paths::world(), &ViewCoordinates::RIGHT_HAND_Z_UP())?;
    let robot = &setup.description.robot;
    for ((link, twin), model) in robot.links().iter().zip(twin).zip(bodies(robot, MODEL_INSET_M)) {
        write_body(writer, twin, &paths::twin(&link.name), None)?;
        write_body(writer, &model, &paths::model(&link.name), Some(Coloring::Uniform(palette::MODEL)))?;
    }
    for (index, obstacle) in setup.obstacles.iter().enumerate() {
        // The pose of one that moves is recorded over time.
        let moves = setup.bodies.iter().any(|body| body.obstacle == index);
        let at_origin = Obstacle { world_from_obstacle: Isometry3::identity(), ..obstacle.clone() };
        let obstacle = if moves { &at_origin } else { obstacle };
        write_obstacle(writer, obstacle, &paths::obstacle(&obstacle.name), palette::obstacle(index))?;
    }
    for zone in &setup.zones {
        write_obstacle(writer, &zone.space, &paths::zone(&zone.space.name), palette::ZONE)?;
    }
    let trail = LineStrips3D::update_fields()
        .with_colors([palette::TRAIL])
        .with_radii([Radius::new_ui_points(TRAIL_UI_POINTS)]);
    writer.log_static(&paths::trail(), &trail)
}

/// Writes an obstacle, or a zone, which has the same form.
fn write_obstacle(
    writer: &mut RrdWriter,
    obstacle: &Obstacle,
    path: &EntityPath,
    color: Color,
) -> Result<(), RecordingError> {
    let shape = Shape {
        link_from_shape: obstacle.world_from_obstacle,
        geometry: obstacle.geometry.clone(),
        color_rgba: None,
    };
    write_body(writer, &VisualBody::new(&[shape], color, 0.0), path, Some(Coloring::AsDescribed))
}

/// Writes shapes and colours in one row for each path.
fn write_body(
    writer: &mut RrdWriter,
    body: &VisualBody,
    path: &EntityPath,
    coloring: Option<Coloring>,
) -> Result<(), RecordingError> {
    let mut colors = coloring.map_or_else(Vec::new, |coloring| body.colors(path, coloring)).into_iter();
    for (path, mut parts) in body.shapes(path) {
        parts.extend(colors.next().into_iter().flat_map(|(_, colors)| colors));
        writer.row(&path, TimePoint::default(), parts)?;
    }
    Ok(())
}
