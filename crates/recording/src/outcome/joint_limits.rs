//! Lines at the limits of the joints' velocities and efforts.

use congruent_description::{Joint, Robot};
use congruent_input::{SiUnit, display::quantity};
use congruent_monitors::{Names, RecordingError};

use super::limit_lines::{LimitLines, style};
use crate::{
    rrd::{paths, writer::RrdWriter},
    scene::palette,
    series::extents::{JointExtents, ValueRange},
};

/// A limit is in the picture if the values reach this part of it: a far one would press the curves flat.
const NEAR: f64 = 0.3;

/// A limit of a joint that its values came near to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NearLimit {
    /// The number of the joint among those that move.
    pub(crate) joint: usize,
    /// Quantity that is limited: `velocity` or `effort`.
    pub(crate) quantity: &'static str,
    /// Side of the limit: `upper` or `lower`.
    pub(crate) side: &'static str,
    /// The limit, in the unit of the quantity.
    pub(crate) value: f64,
}

/// The limits that values came near to.
pub(crate) fn near_limits(robot: &Robot, extents: &[JointExtents]) -> Vec<NearLimit> {
    let mut near = Vec::new();
    for (joint, (&index, extents)) in robot.movable_joints().iter().zip(extents).enumerate() {
        for (quantity, ValueRange { low, high }) in
            [("velocity", extents.velocity), ("effort", extents.effort)]
        {
            let Some(limit) = limit_of(robot.joint(index), quantity) else { continue };
            // `low` is negative if the joint goes in the other direction: its distance from 0 is compared with the same
            // limit.
            for (side, value, reached) in [("upper", limit, high), ("lower", -limit, -low)] {
                if reached >= NEAR * limit {
                    near.push(NearLimit { joint, quantity, side, value });
                }
            }
        }
    }
    near
}

/// The largest velocity or effort of a joint; `None` if the description gives none, or 0, which means none.
fn limit_of(joint: &Joint, quantity: &str) -> Option<f64> {
    let limit = joint.limit?;
    let value = if quantity == "velocity" { limit.velocity? } else { limit.effort? };
    (value > 0.0 && value.is_finite()).then_some(value)
}

/// Writes a line at each limit.
pub(crate) fn write(
    writer: &mut RrdWriter,
    lines: &LimitLines,
    robot: &Robot,
    names: &Names,
    limits: &[NearLimit],
) -> Result<(), RecordingError> {
    for limit in limits {
        let is_length = robot.joint(robot.movable_joints()[limit.joint]).kind.si_unit() == SiUnit::Metre;
        let unit = match (limit.quantity, is_length) {
            ("velocity", true) => SiUnit::MetrePerSecond,
            ("velocity", false) => SiUnit::RadianPerSecond,
            (_, true) => SiUnit::Newton,
            (_, false) => SiUnit::NewtonMetre,
        };
        let path = paths::joint_limit(limit.quantity, &names.joints[limit.joint], limit.side);
        let label = format!("limit {}", quantity(limit.value, unit.symbol()));
        lines.write(writer, &path, &style(&label, palette::LIMIT), limit.value)?;
    }
    Ok(())
}
