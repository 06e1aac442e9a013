//! Actuators, and the effort that they can have at a joint.

use super::written::{MjPlace, MjWritten};

/// What an actuator acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MjTarget {
    /// A joint.
    Joint(usize),
    /// A tendon.
    Tendon(usize),
    /// A site, the contacts of a body, or a slider and crank.
    Other,
}

/// An actuator.
#[derive(Debug, Clone, PartialEq)]
pub struct MjActuator {
    /// Name; empty if the file has none.
    pub name: String,
    /// Its element: `motor`, `position`, `general`, ...
    pub kind: String,
    /// What it acts on.
    pub target: MjTarget,
    /// `gear`, the first number: effort at the joint per force of the actuator.
    pub gear: MjWritten<f64>,
    /// Limits of its force, before the gear; `None` without limits.
    pub force_range: Option<MjWritten<[f64; 2]>>,
    /// Limits of its control; `None` without limits.
    pub control_range: Option<MjWritten<[f64; 2]>>,
    /// Force per control, if the force is the control times this; `None` for servos and others.
    pub gain: Option<f64>,
    /// Inertia that it adds to its target, gear included, kg m^2 or kg.
    pub armature: f64,
    /// Linear damping that it adds to its target, gear included.
    pub damping: f64,
    /// The opening of its tag.
    pub place: MjPlace,
}

impl MjActuator {
    /// Limits of the effort at its target, the gear included; `None` without limits. The limits of the force hold, or
    /// those of the control if the force is proportional to it.
    pub fn effort_range(&self) -> Option<MjWritten<[f64; 2]>> {
        let (range, factor) = match (&self.force_range, &self.control_range, self.gain) {
            (Some(force), _, _) => (force, self.gear.value),
            (None, Some(control), Some(gain)) => (control, gain * self.gear.value),
            _ => return None,
        };
        let [low, high] = range.value.map(|limit| limit * factor);
        Some(MjWritten { value: [low.min(high), low.max(high)], place: range.place.clone() })
    }
}

/// What the actuators of a joint can do together.
#[derive(Debug, Clone, PartialEq)]
pub enum MjEffort {
    /// No actuator acts on the joint itself, and the joint states no limits for one.
    Unactuated,
    /// Limits of the effort, N m or N: the sum over its actuators, within `actuatorfrcrange`.
    Within {
        /// Lower and upper limit.
        range: [f64; 2],
        /// Where the limits are written.
        places: Vec<MjPlace>,
    },
    /// An actuator has no limits.
    Unlimited,
    /// A tendon acts on the joint, so its effort depends on other joints.
    ThroughTendon,
}
