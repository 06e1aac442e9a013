//! What a recording says once: shapes, names and colours.

use congruent_agreement::compare::model::PoseSource;
use congruent_description::{Link, Robot, Shape};
use congruent_simulation::Obstacle;
use congruent_twin::{monitor::Names, recorder::RecordingError, scenario::Scenario};
use re_log_types::{EntityPath, TimePoint};
use re_sdk_types::{
    archetypes::{LineStrips3D, SeriesLines, ViewCoordinates},
    components::{Color, Radius},
};

use crate::{
    body::{Body, Paint},
    disagreement::Disagreement,
    palette, paths,
    writer::RrdWriter,
};

/// Thickness of the tool's trail on the screen.
const TRAIL_UI_POINTS: f32 = 1.5;

/// How far the ghost lies below the twin's surface: where they agree, only the twin is seen, and
/// the ghost comes out where they do not.
const GHOST_INSET_M: f64 = 5e-4;

/// The robot's links with their shapes; a link without visuals shows what touches.
pub(super) fn bodies(robot: &Robot, inset_m: f64) -> Vec<Body> {
    let body = |(index, link): (usize, &Link)| {
        let shapes = if link.visuals.is_empty() { &link.collisions } else { &link.visuals };
        Body::new(shapes, palette::link(index), inset_m)
    };
    robot.links().iter().enumerate().map(body).collect()
}

/// Writes shapes. The twin's links have no colour yet: it follows their error.
pub(super) fn write(
    writer: &mut RrdWriter,
    scenario: &Scenario,
    bodies: &[Body],
) -> Result<(), RecordingError> {
    writer.log_static(&paths::world(), &ViewCoordinates::RIGHT_HAND_Z_UP())?;
    let robot = &scenario.description.robot;
    for ((link, twin), ghost) in robot.links().iter().zip(bodies).zip(self::bodies(robot, GHOST_INSET_M)) {
        write_body(writer, twin, &paths::twin(&link.name), None)?;
        write_body(writer, &ghost, &paths::model(&link.name), Some(Paint::Plain(palette::GHOST)))?;
    }
    for (index, obstacle) in scenario.obstacles.iter().enumerate() {
        write_standing(writer, obstacle, &paths::obstacle(&obstacle.name), palette::obstacle(index))?;
    }
    for zone in &scenario.zones {
        write_standing(writer, &zone.space, &paths::zone(&zone.space.name), palette::ZONE)?;
    }
    let trail = LineStrips3D::update_fields()
        .with_colors([palette::TRAIL])
        .with_radii([Radius::new_ui_points(TRAIL_UI_POINTS)]);
    writer.log_static(&paths::trail(), &trail)?;
    Disagreement::write_static(writer)
}

/// Writes what stands still.
fn write_standing(
    writer: &mut RrdWriter,
    standing: &Obstacle,
    path: &EntityPath,
    color: Color,
) -> Result<(), RecordingError> {
    let shape = Shape {
        link_from_shape: standing.world_from_obstacle,
        geometry: standing.geometry.clone(),
        color_rgba: None,
    };
    write_body(writer, &Body::new(&[shape], color, 0.0), path, Some(Paint::Own))
}

/// Shapes and paint share a path, so that each path is one row.
fn write_body(
    writer: &mut RrdWriter,
    body: &Body,
    path: &EntityPath,
    paint: Option<Paint>,
) -> Result<(), RecordingError> {
    let mut colors = paint.map_or_else(Vec::new, |paint| body.colors(path, paint)).into_iter();
    for (path, mut parts) in body.shapes(path) {
        parts.extend(colors.next().into_iter().flat_map(|(_, colors)| colors));
        writer.row(&path, TimePoint::default(), parts)?;
    }
    Ok(())
}

/// Writes names and colours of all lines. Links that only the URDF places are hidden at first
/// where a table places others: there, model and URDF are the same thing.
pub(super) fn write_styles(
    writer: &mut RrdWriter,
    robot: &Robot,
    names: &Names,
    sources: &[PoseSource],
) -> Result<(), RecordingError> {
    let has_table = sources.iter().any(|source| *source != PoseSource::Urdf);
    for (index, (link, source)) in names.links.iter().zip(sources).enumerate() {
        let is_shown = !has_table || *source != PoseSource::Urdf;
        let style = style(link, palette::link(index)).with_visible_series([is_shown]);
        writer.log_static(&paths::position_error(link), &style)?;
        writer.log_static(&paths::orientation_error(link), &style)?;
    }
    for (name, &joint) in names.joints.iter().zip(robot.movable_joints()) {
        // A joint has the colour of the link that it carries.
        let color = palette::link(robot.joint(joint).child.get());
        writer.log_static(&paths::joint_position(name), &style(name, color))?;
    }
    for (quantity, index) in [("position", 0), ("orientation", 1)] {
        let style = style(quantity, palette::link(index));
        writer.log_static(&paths::worst_of_links(quantity), &style)?;
    }
    Ok(())
}

fn style(name: &str, color: Color) -> SeriesLines {
    SeriesLines::new().with_names([name]).with_colors([color]).with_widths([1.5])
}
