//! Given positions outside the limits of their joints: one finding for all of them.

use std::collections::BTreeMap;

use congruent_description::Robot;
use congruent_input::{
    Diagnostic,
    display::{compared_quantities, quantity},
};

use crate::codes;

/// Values that one finding lists.
const MOST_LISTED: usize = 10;

/// One sentence for each of these positions (rad or m) that is outside the limits of its joint.
pub fn outside_limits(values: &BTreeMap<String, f64>, robot: &Robot) -> Vec<String> {
    let sentence = |(name, &value): (&String, &f64)| {
        let joint = robot.joint(robot.find_joint(name)?);
        let (lower, upper) = joint.position_range()?;
        // Formatted only if it is outside: of a million configurations nearly all are inside.
        (value < lower || value > upper).then(|| {
            let unit = joint.kind.unit();
            // With digits enough to see on which side of the limit it is.
            let (shown, [lower, upper]) = if value < lower {
                let [shown, near] = compared_quantities([value, lower], unit);
                (shown, [near, quantity(upper, unit)])
            } else {
                let [shown, near] = compared_quantities([value, upper], unit);
                (shown, [quantity(lower, unit), near])
            };
            format!("{name} at {shown} (limits {lower} to {upper})")
        })
    };
    values.iter().filter_map(sentence).collect()
}

/// The warning that lists such sentences; `None` if there are none.
pub fn outside_limits_warning(found: &[String]) -> Option<Diagnostic> {
    let mut outside = OutsideLimits::default();
    for what in found {
        outside.add(|| what.clone());
    }
    outside.warning()
}

/// Such sentences, of which as many are kept as the warning lists.
#[derive(Debug, Default)]
pub(super) struct OutsideLimits {
    listed: Vec<String>,
    count: usize,
}

impl OutsideLimits {
    pub(super) fn add(&mut self, what: impl FnOnce() -> String) {
        self.count += 1;
        if self.listed.len() < MOST_LISTED {
            self.listed.push(what());
        }
    }

    pub(super) fn warning(&self) -> Option<Diagnostic> {
        let more = match self.count - self.listed.len() {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let message = format!("outside the joint limits: {}{more}", self.listed.join(", "));
        (self.count > 0).then(|| {
            Diagnostic::warning(codes::configurations::OUTSIDE_LIMITS, message)
                .with_help("the result is computed, but the robot cannot reach these positions; JSON has values in rad and m")
        })
    }
}
