//! Lines at the limits of the joints' velocities and efforts.

use congruent_description::{Joint, RobotDescription, display::quantity};
use congruent_twin::{monitor::Names, recorder::RecordingError};

use super::limit_lines::LimitLines;
use crate::{
    rrd::{paths, writer::RrdWriter},
    scene::palette,
};

/// The largest `velocity` or `effort` of a joint; `None` if the description gives none, or 0, which stands for none.
pub(crate) fn limit_of(joint: &Joint, quantity: &str) -> Option<f64> {
    let limit = joint.limit?;
    let value = match quantity {
        "velocity" => limit.velocity?,
        "effort" => limit.effort?,
        _ => return None,
    };
    (value > 0.0 && value.is_finite()).then_some(value)
}

/// Writes a line at each limit, in both directions.
pub(crate) fn write(
    writer: &mut RrdWriter,
    lines: &LimitLines,
    (description, names): (&RobotDescription, &Names),
) -> Result<(), RecordingError> {
    let robot = &description.robot;
    for (name, &index) in names.joints.iter().zip(robot.movable_joints()) {
        let joint = robot.joint(index);
        let units = match joint.kind.unit() {
            "m" => [("velocity", "m/s"), ("effort", "N")],
            _ => [("velocity", "rad/s"), ("effort", "N m")],
        };
        for (of, unit) in units {
            let Some(limit) = limit_of(joint, of) else { continue };
            for (side, limit) in [("upper", limit), ("lower", -limit)] {
                let label = format!("limit {}", quantity(limit, unit));
                let path = paths::joint_limit(of, name, side);
                lines.write(writer, &path, (&label, palette::LIMIT, limit))?;
            }
        }
    }
    Ok(())
}
