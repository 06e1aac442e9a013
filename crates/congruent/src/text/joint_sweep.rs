//! What `congruent view` prints of a robot whose joints move over their ranges.

use std::fmt::Write;

use congruent_text::{TextOptions, layout::Table};

use crate::{JointSweep, SweptJoint, input::display::position};

/// What `congruent view` prints of a robot: when each joint moves over which range, and whether model and URDF agree meanwhile.
pub fn joint_sweep_text(sweep: &JointSweep, options: &TextOptions) -> String {
    let mut text = format!("{}: each joint over its range\n", sweep.robot);
    let mut table = Table::headed(["joint", "from", "to", "at", ""]);
    for joint in &sweep.joints {
        let SweptJoint { joint, unit, range: [lower, upper], from_s, until_s, note, .. } = joint;
        let at = if until_s > from_s { format!("{from_s} s to {until_s} s") } else { "-".to_owned() };
        let note = note.clone().unwrap_or_default();
        table.row([joint.clone(), position(*lower, unit), position(*upper, unit), at, note]);
    }
    table.write(&mut text, options.columns);
    if !sweep.follow.is_empty() {
        let _ = writeln!(text, "  joints that follow others: {}", sweep.follow.join(", "));
    }
    let agreement = if sweep.agrees { "agree" } else { "do NOT agree" };
    let _ = writeln!(
        text,
        "  model and URDF {agreement} in all of it\n  recording {}",
        sweep.recording.display()
    );
    text
}
