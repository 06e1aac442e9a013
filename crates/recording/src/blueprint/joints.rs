//! Plots of the joints: positions beside the commanded ones, what lies between both, speeds and efforts beside their
//! limits. Many joints are shown in groups, without those that do not move.

use PlottedQuantity::{Deviation, Effort, Position, Velocity};
use congruent_description::Robot;
use congruent_input::SiUnit;
use congruent_monitors::Names;

use super::{
    plots::PlotFrame,
    tree::{LayoutNode, View},
};
use crate::{
    outcome::joint_limits::NearLimit,
    rrd::paths,
    series::extents::{JointExtents, ValueRange},
};

/// From this number of joints on, those that do not move are left out.
const MANY: usize = 12;
/// The most joints of one plot.
const MAX_GROUP: usize = 7;
/// A joint whose positions differ by no more does not move. Unit: rad or m. Kind: choice.
const AT_REST: f64 = 1e-3;
/// Differences below this are rounding, in SI units.
const ROUNDING: f64 = 1e-9;
/// The joints of a run with what they did.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointPlots<'a> {
    pub(super) robot: &'a Robot,
    pub(super) names: &'a Names,
    pub(super) extents: &'a [JointExtents],
    pub(super) limits: &'a [NearLimit],
    pub(super) frame: PlotFrame,
}

/// A kind of plot.
#[derive(Debug, Clone, Copy, PartialEq)]
enum PlottedQuantity {
    /// Beside the commanded ones.
    Position,
    /// True minus commanded positions.
    Deviation,
    /// Velocities (rad/s or m/s) beside their limits.
    Velocity,
    /// Efforts (N m or N) beside their limits.
    Effort,
}

impl JointPlots<'_> {
    /// All plots, positions first.
    pub(super) fn all(&self) -> Vec<LayoutNode> {
        let groups = [SiUnit::Radian, SiUnit::Metre].map(|unit| self.groups(unit));
        let groups: Vec<&Vec<usize>> = groups.iter().flatten().collect();
        let mut plots = Vec::new();
        for quantity in [Position, Deviation, Velocity, Effort] {
            for group in &groups {
                if group.iter().any(|&joint| is_worth_a_plot(quantity, &self.extents[joint])) {
                    plots.push(self.plot(quantity, group, groups.len()));
                }
            }
        }
        plots
    }

    fn unit(&self, joint: usize) -> SiUnit {
        self.robot.joint(self.robot.movable_joints()[joint]).kind.si_unit()
    }

    /// The joints of one unit, in the order of the tree: those that move, of an arm after those of another.
    fn groups(&self, unit: SiUnit) -> Vec<Vec<usize>> {
        let is_shown =
            |joint: &usize| self.names.joints.len() < MANY || self.extents[*joint].position.width() > AT_REST;
        let of_unit = (0..self.names.joints.len()).filter(|&joint| self.unit(joint) == unit);
        let shown: Vec<usize> = of_unit.filter(is_shown).collect();
        // Groups of nearly equal size: 8 joints are 4 and 4, not 7 and 1.
        let count = shown.len().div_ceil(MAX_GROUP).max(1);
        shown.chunks(shown.len().div_ceil(count).max(1)).map(<[usize]>::to_vec).collect()
    }

    fn plot(&self, quantity: PlottedQuantity, group: &[usize], groups: usize) -> LayoutNode {
        let unit = group.first().map_or(SiUnit::Radian, |&joint| self.unit(joint));
        let title = match (quantity, unit) {
            (Position, _) => format!("Positions and commands (thin) [{unit}]"),
            (Deviation, _) => format!("Deviations from commands [{unit}]"),
            (Velocity, _) => format!("Velocities [{unit}/s]"),
            (Effort, SiUnit::Metre) => "Forces [N]".to_owned(),
            (Effort, _) => "Torques [N m]".to_owned(),
        };
        let title = match (group, groups > 1) {
            ([only], true) => format!("{title}: {}", self.names.joints[*only]),
            ([first, .., last], true) => {
                format!("{title}: {} to {}", self.names.joints[*first], self.names.joints[*last])
            }
            _ => title,
        };
        let entities = |word: &str, joints: &mut dyn Iterator<Item = usize>| {
            joints.map(|joint| paths::joint_value(word, &self.names.joints[joint])).collect::<Vec<_>>()
        };
        let mut shown = entities(word(quantity), &mut group.iter().copied());
        // Positions go where they go; other values are held against 0 and against their limits.
        let mut range = ValueRange { low: -ROUNDING, high: ROUNDING };
        if quantity == Position {
            let is_commanded = |joint: &usize| self.extents[*joint].deviation.low.is_finite();
            shown.extend(entities("reference_position", &mut group.iter().copied().filter(is_commanded)));
            let is_misread = |joint: &usize| self.extents[*joint].is_misread;
            shown.extend(entities("measured_position", &mut group.iter().copied().filter(is_misread)));
        }
        for &joint in group {
            range = range.union(extent_of(quantity, &self.extents[joint]));
        }
        for limit in self.limits(quantity, group) {
            range = range.union(ValueRange { low: limit.value, high: limit.value });
            shown.push(paths::joint_limit(limit.quantity, &self.names.joints[limit.joint], limit.side));
        }
        let view = View::new("TimeSeries", title, paths::path(&[])).only(shown);
        self.frame.plot(view, (quantity != Position).then_some((range.low, range.high)))
    }

    /// The limits that are in the picture, each value once.
    fn limits(&self, quantity: PlottedQuantity, group: &[usize]) -> Vec<NearLimit> {
        let mut limits: Vec<NearLimit> = Vec::new();
        for limit in self.limits.iter().filter(|limit| limit.quantity == word(quantity)) {
            #[expect(clippy::float_cmp, reason = "one value of a file")]
            let is_known = limits.iter().any(|known| known.value == limit.value);
            if group.contains(&limit.joint) && !is_known {
                limits.push(*limit);
            }
        }
        limits
    }
}

/// The word of a quantity in paths.
fn word(quantity: PlottedQuantity) -> &'static str {
    match quantity {
        Position => "position",
        Deviation => "deviation",
        Velocity => "velocity",
        Effort => "effort",
    }
}

fn extent_of(quantity: PlottedQuantity, extents: &JointExtents) -> ValueRange {
    match quantity {
        Position => extents.position,
        Deviation => extents.deviation,
        Velocity => extents.velocity,
        Effort => extents.effort,
    }
}

/// Positions always; of the others what is more than rounding.
fn is_worth_a_plot(quantity: PlottedQuantity, extents: &JointExtents) -> bool {
    let ValueRange { low, high } = extent_of(quantity, extents);
    quantity == Position || high.max(-low) > ROUNDING
}
