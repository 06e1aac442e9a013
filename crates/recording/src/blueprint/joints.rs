//! Plots of the joints: positions beside the commanded ones, what lies between both, speeds and efforts beside their
//! limits. Many joints are shown in groups, without those that stand still.

use congruent_description::{JointKind, Robot};
use congruent_twin::monitor::Names;

use super::{
    plots::PlotFrame,
    tree::{LayoutNode, View},
};
use crate::{
    outcome::joint_limits::limit_of,
    rrd::paths,
    series::extents::{JointExtents, width},
};

/// From so many joints on, those that stand still are left out.
const MANY: usize = 12;
/// The most joints of one plot.
const MAX_GROUP: usize = 8;
/// A joint that goes no further stands still, rad or m.
const STANDS_STILL: f64 = 1e-3;
/// Differences below this are rounding, in SI units.
const ROUNDING: f64 = 1e-9;
/// A limit is in the picture if the values reach this part of it: a far one would press the curves flat.
const NEAR_LIMIT: f64 = 0.3;

/// The joints of a run with what they did.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointPlots<'a> {
    pub(super) robot: &'a Robot,
    pub(super) names: &'a Names,
    pub(super) extents: &'a [JointExtents],
    pub(super) frame: PlotFrame,
}

/// A kind of plot.
#[derive(Debug, Clone, Copy, PartialEq)]
enum JointQuantity {
    /// Beside the commanded ones.
    Position,
    /// True minus commanded positions.
    Deviation,
    /// Beside their limits.
    Velocity,
    /// Likewise.
    Effort,
}

use JointQuantity::{Deviation, Effort, Position, Velocity};

impl JointPlots<'_> {
    /// All plots, positions first.
    pub(super) fn all(&self) -> Vec<LayoutNode> {
        let groups = [false, true].map(|is_length| self.groups(is_length));
        let groups: Vec<&Vec<usize>> = groups.iter().flatten().collect();
        let mut plots = Vec::new();
        for quantity in [Position, Deviation, Velocity, Effort] {
            for group in &groups {
                if group.iter().any(|&joint| is_worth_a_plot(quantity, &self.extents[joint])) {
                    plots.push(self.plot(quantity, group, groups.len() > 1));
                }
            }
        }
        plots
    }

    fn is_length(&self, joint: usize) -> bool {
        self.robot.joint(self.robot.movable_joints()[joint]).kind == JointKind::Prismatic
    }

    /// The joints of one unit, in the order of the tree: those that move, of an arm after those of another.
    fn groups(&self, is_length: bool) -> Vec<Vec<usize>> {
        let is_shown = |joint: &usize| {
            self.names.joints.len() < MANY || width(self.extents[*joint].position) > STANDS_STILL
        };
        let of_unit = (0..self.names.joints.len()).filter(|&joint| self.is_length(joint) == is_length);
        let shown: Vec<usize> = of_unit.filter(is_shown).collect();
        let count = shown.len().div_ceil(MAX_GROUP).max(1);
        shown.chunks(shown.len().div_ceil(count).max(1)).map(<[usize]>::to_vec).collect()
    }

    fn plot(&self, quantity: JointQuantity, group: &[usize], is_one_of_many: bool) -> LayoutNode {
        let unit = if group.iter().any(|&joint| self.is_length(joint)) { "m" } else { "rad" };
        let names = || group.iter().map(|&joint| self.names.joints[joint].as_str());
        let title = match (quantity, unit) {
            (Position, _) => format!("Joint positions [{unit}], wide: commanded"),
            (Deviation, _) => format!("Deviations from the command [{unit}]"),
            (Velocity, _) => format!("Joint velocities [{unit}/s]"),
            (Effort, "m") => "Joint forces [N]".to_owned(),
            (Effort, _) => "Joint torques [N m]".to_owned(),
        };
        let title = match (group, is_one_of_many) {
            ([only], true) => format!("{title}: {}", self.names.joints[*only]),
            ([first, .., last], true) => {
                format!("{title}: {} to {}", self.names.joints[*first], self.names.joints[*last])
            }
            _ => title,
        };
        let mut entities: Vec<_> = names().map(|name| paths::joint_value(word(quantity), name)).collect();
        let extent = |joint: usize| extent_of(quantity, &self.extents[joint]);
        let mut range = group.iter().map(|&joint| extent(joint)).reduce(union);
        if quantity == Position {
            let has_command = |&&joint: &&usize| {
                width(self.extents[joint].deviation) >= 0.0 && self.extents[joint].deviation.0.is_finite()
            };
            let commanded = group.iter().filter(has_command);
            entities.extend(
                commanded.map(|&joint| paths::joint_value("reference_position", &self.names.joints[joint])),
            );
            let misread = group.iter().filter(|&&joint| self.extents[joint].is_misread);
            entities.extend(
                misread.map(|&joint| paths::joint_value("measured_position", &self.names.joints[joint])),
            );
        }
        for (joint, side, limit) in self.limits(quantity, group) {
            range = range.map(|range| union(range, (limit, limit)));
            entities.push(paths::joint_limit(word(quantity), &self.names.joints[joint], side));
        }
        let view = View::new("TimeSeries", title, paths::path(&["joint"])).only(entities);
        self.frame.plot(
            view,
            range.map(|range| union(range, (-ROUNDING, ROUNDING))).filter(|_| quantity != Position),
        )
    }

    /// The limits that are in the picture, each value once.
    fn limits(&self, quantity: JointQuantity, group: &[usize]) -> Vec<(usize, &'static str, f64)> {
        let mut limits: Vec<(usize, &'static str, f64)> = Vec::new();
        for &joint in group {
            let index = self.robot.movable_joints()[joint];
            let Some(limit) = limit_of(self.robot.joint(index), word(quantity)) else { continue };
            let (low, high) = extent_of(quantity, &self.extents[joint]);
            for (side, limit, reached) in [("upper", limit, high), ("lower", -limit, -low)] {
                let is_near = reached >= NEAR_LIMIT * limit.abs() && reached > 0.0;
                #[expect(clippy::float_cmp, reason = "one value of a file")]
                if is_near && !limits.iter().any(|&(.., known)| known == limit) {
                    limits.push((joint, side, limit));
                }
            }
        }
        limits
    }
}

/// The word of a quantity in paths.
fn word(quantity: JointQuantity) -> &'static str {
    match quantity {
        Position => "position",
        Deviation => "deviation",
        Velocity => "velocity",
        Effort => "effort",
    }
}

fn extent_of(quantity: JointQuantity, extents: &JointExtents) -> (f64, f64) {
    match quantity {
        Position => extents.position,
        Deviation => extents.deviation,
        Velocity => extents.velocity,
        Effort => extents.effort,
    }
}

/// Positions always; of the others what is more than rounding.
fn is_worth_a_plot(quantity: JointQuantity, extents: &JointExtents) -> bool {
    let (low, high) = extent_of(quantity, extents);
    quantity == Position || high.max(-low) > ROUNDING
}

fn union((low, high): (f64, f64), (other_low, other_high): (f64, f64)) -> (f64, f64) {
    (low.min(other_low), high.max(other_high))
}
