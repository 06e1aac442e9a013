//! How the joints of another description are called and counted, as `check` prints it.

use std::fmt::Write;

use crate::{
    ReportedJoint, ReportedMapping,
    input::display::{angle, counted, length, position},
    kinematics::ReportedPose,
    mapping::MatchedBy,
    text::layout::column_width,
};

/// The table of joints, what is fixed or fitted, and the lines that declare it.
pub(super) fn mapped(text: &mut String, mapping: &ReportedMapping, other: &str) {
    let found = match mapping.matched_by {
        MatchedBy::Declared => "as [mapping] declares",
        MatchedBy::Names => "found by their names",
        MatchedBy::SimilarNames => "found by similar names",
        MatchedBy::Links => "found by the names of the links that they carry",
        MatchedBy::Order => "found by their order along the chain",
    };
    let is_other = |of: &&ReportedJoint| !of.has_same_variable() || of.joint != of.other;
    let others: Vec<&ReportedJoint> = mapping.joints.iter().filter(is_other).collect();
    let _ = writeln!(text, "  joints of {other}, {found}:");
    if !others.is_empty() {
        table(text, &others);
    }
    let same = mapping.joints.len() - others.len();
    if same > 0 {
        let _ = writeln!(text, "    {} with the same name, direction and zero", counted(same, "joint"));
    }
    for (joints, whose) in [(&mapping.left_out, "this file"), (&mapping.other_left_out, other)] {
        if !joints.is_empty() {
            let _ = writeln!(
                text,
                "    moving only in {whose}, not compared with what they carry: {}",
                joints.join(", ")
            );
        }
    }
    if let Some(root) = &mapping.root_from_other_root {
        let _ = writeln!(text, "    its root frame is at {} in that of this file (fitted)", pose(root));
    }
    if mapping.equivalent > 0 {
        let others = counted(mapping.equivalent, "other choice");
        let _ =
            writeln!(text, "    the same motion as with {others} of directions and zeros, as wrists have it");
    }
    let mut differing = mapping.joints.iter().filter(|of| !of.has_same_variable());
    if let (Some(only), None) = (differing.next(), differing.next())
        && mapping.joints.first() == Some(only)
        && only.offset != 0.0
        && !mapping.is_declared
    {
        let _ = writeln!(
            text,
            "    the same motion as with a base that is turned about the first axis: base = \"fitted\" under [mapping] declares that"
        );
    }
    if !mapping.is_declared {
        let _ = writeln!(text, "    if this is meant, declare it in robot.toml:\n");
        for line in &mapping.lines {
            let _ = writeln!(text, "      {line}");
        }
    }
}

fn table(text: &mut String, joints: &[&ReportedJoint]) {
    let [here, there] = ["this file", "other file"];
    let names = column_width(joints.iter().map(|of| of.joint.len()).chain([here.len()]));
    let others = column_width(joints.iter().map(|of| of.other.len()).chain([there.len()]));
    let _ = writeln!(text, "    {here:names$}  {there:others$}  direction  at 0 here it is at");
    for of in joints {
        let direction = if of.sign < 0 { "opposite" } else { "same" };
        let zero = position(of.offset, of.unit);
        let _ = writeln!(text, "    {:names$}  {:others$}  {direction:9}  {zero}", of.joint, of.other);
    }
}

/// A pose in lengths and angles for people.
fn pose(pose: &ReportedPose) -> String {
    let [x, y, z] = pose.translation_m.map(length);
    let [roll, pitch, yaw] = pose.rpy_rad().map(angle);
    format!("x {x}, y {y}, z {z}, roll {roll}, pitch {pitch}, yaw {yaw}")
}
