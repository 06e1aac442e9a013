//! Names for the indices in a sample.

use congruent_description::Robot;
use congruent_proximity::Clearance;
use congruent_scenario::CheckKind;

use crate::verdict::InstantValue;

/// The subject of a value that belongs to all joints together.
pub(super) const ALL_JOINTS: &str = "all joints";

/// Names for the indices in a sample.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Names {
    /// Links, in the robot's order.
    pub links: Vec<String>,
    /// Movable joints, in the order of configuration vectors.
    pub joints: Vec<String>,
    /// Watched pairs, as `a--b`.
    pub pairs: Vec<String>,
    /// Links with the zones that are forbidden to them, as `link--zone`.
    pub zones: Vec<String>,
}

impl Names {
    /// The names of a robot, of the pairs that are watched around it, and of its zones.
    pub fn new(robot: &Robot, clearance: &Clearance, zones: &Clearance) -> Self {
        let pair = |index| clearance.names(index).join("--");
        let in_zone = |index| {
            let [zone, link] = zones.names(index);
            format!("{link}--{zone}")
        };
        Self {
            pairs: (0..clearance.pairs().len()).map(pair).collect(),
            zones: (0..zones.pairs().len()).map(in_zone).collect(),
            ..Self::of_robot(robot)
        }
    }

    /// The names of a robot, without pairs and zones.
    pub(super) fn of_robot(robot: &Robot) -> Self {
        Self {
            links: robot.links().iter().map(|link| link.name.clone()).collect(),
            joints: robot.movable_joint_names().map(str::to_owned).collect(),
            pairs: Vec::new(),
            zones: Vec::new(),
        }
    }

    /// The joint or link of a value of a check; `None` where the index is of something else.
    pub fn subject(&self, kind: CheckKind, value: &InstantValue) -> Option<&str> {
        let of_links = match kind {
            CheckKind::Agreement | CheckKind::Twist => true,
            CheckKind::Tracking => value.quantity.is_of_tcp(),
            CheckKind::Dynamics | CheckKind::Effort | CheckKind::Limits => false,
            _ => return None,
        };
        let names = if of_links { &self.links } else { &self.joints };
        Some(names.get(value.subject).map_or(ALL_JOINTS, String::as_str))
    }

    /// A joint by its index; all joints by the index after the last.
    pub(super) fn joint_or_all(&self, joint: usize) -> String {
        self.joints.get(joint).cloned().unwrap_or_else(|| ALL_JOINTS.to_owned())
    }
}
