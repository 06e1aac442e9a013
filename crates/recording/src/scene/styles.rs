//! Names and colours of the lines in the plots.

use congruent_agreement::compare::PoseSource;
use congruent_description::Robot;
use congruent_monitors::{Names, RecordingError};
use re_sdk_types::{archetypes::SeriesLines, components::Color};

use super::palette;
use crate::rrd::{paths, writer::RrdWriter};

/// Width of a line on the screen.
const WIDTH_UI_POINTS: f32 = 1.5;
/// Width of a line that lies behind another, and of the other.
const WIDE_UI_POINTS: f32 = 3.0;
const THIN_UI_POINTS: f32 = 1.0;

/// Writes names and colours of all lines. If a table gives the poses of some links, those of links whose poses
/// come from the URDF alone are not in the plots: model and URDF are identical there.
pub(crate) fn write(
    writer: &mut RrdWriter,
    robot: &Robot,
    names: &Names,
    sources: &[PoseSource],
) -> Result<(), RecordingError> {
    let has_table = sources.iter().any(|source| *source != PoseSource::Urdf);
    let links = names.links.iter().zip(sources).enumerate();
    for (index, (link, _)) in links.filter(|(_, (_, source))| !has_table || **source != PoseSource::Urdf) {
        let style = line(link, palette::link(index), WIDTH_UI_POINTS);
        writer.log_static(&paths::position_error(link), &style)?;
        writer.log_static(&paths::orientation_error(link), &style)?;
    }
    for (name, &joint) in names.joints.iter().zip(robot.movable_joints()) {
        // A joint has the colour of its child link.
        let index = robot.joint(joint).child.get();
        for (quantity, width) in [
            ("position", WIDE_UI_POINTS),
            ("velocity", WIDTH_UI_POINTS),
            ("effort", WIDTH_UI_POINTS),
            ("deviation", WIDTH_UI_POINTS),
        ] {
            let style = line(name, palette::link(index), width);
            writer.log_static(&paths::joint_value(quantity, name), &style)?;
        }
        // A name of its own would make the legend twice as long.
        let style = line(name, palette::pale(index), THIN_UI_POINTS);
        writer.log_static(&paths::joint_value("reference_position", name), &style)?;
    }
    for (quantity, index) in [("position", 0), ("orientation", 1)] {
        let style = line(quantity, palette::link(index), WIDTH_UI_POINTS);
        writer.log_static(&paths::worst_of_links(quantity), &style)?;
    }
    Ok(())
}

/// Writes the style of a measured position, which is plotted only if it is not the true one.
pub(crate) fn write_measured(
    writer: &mut RrdWriter,
    robot: &Robot,
    number: usize,
    name: &str,
) -> Result<(), RecordingError> {
    let index = robot.joint(robot.movable_joints()[number]).child.get();
    let style = line(&format!("{name}, measured"), palette::dim(index), WIDTH_UI_POINTS);
    writer.log_static(&paths::joint_value("measured_position", name), &style)
}

/// The style of a line of a plot, `width` in points of the screen.
pub(crate) fn line(name: &str, color: Color, width: f32) -> SeriesLines {
    SeriesLines::new().with_names([name]).with_colors([color]).with_widths([width])
}
