//! How the joints of another description are called and counted, as `check` prints it.

use std::fmt::Write;

use congruent_text::layout::column_width;

use crate::{
    ReportedJoint, ReportedMapping,
    input::display::{angle, counted, length, position},
    kinematics::ReportedPose,
    mapping::MatchedBy,
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
    not_compared(text, mapping, other);
    if let Some(root) = &mapping.root_from_other_root {
        let _ = writeln!(text, "    its root frame is at {} in that of this file (fitted)", pose(root));
    }
    // With equal variables there was nothing to choose.
    if mapping.equivalent > 0 && mapping.joints.iter().any(|of| !of.has_same_variable()) {
        let (others, give) = if mapping.equivalent == 1 { ("set", "gives") } else { ("sets", "give") };
        let _ = writeln!(
            text,
            "    {} other {others} of directions and zeros {give} the tip the same motion, as at a wrist; only with the set above do the \
             bodies of both files move alike, too",
            mapping.equivalent
        );
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

/// Joints of one file alone, and last links with other frames in the two files.
fn not_compared(text: &mut String, mapping: &ReportedMapping, other: &str) {
    let [here, there] = mapping.alone();
    let only = |whose: &str| format!("moving only in {whose}");
    let elsewhere = match mapping.matched_by {
        MatchedBy::Declared => "left out by [mapping], although they move in both files",
        _ => "placed elsewhere in one of the files",
    };
    for (joints, what) in
        [(here, only("this file")), (there, only(other)), (mapping.elsewhere(), elsewhere.to_owned())]
    {
        let held = |joint: &&str| mapping.held_at_zero.iter().any(|of| of == joint);
        let (held, joints): (Vec<&str>, Vec<&str>) = joints.into_iter().partition(held);
        if !held.is_empty() {
            let _ =
                writeln!(text, "    {what}, what they carry is compared with them at 0: {}", held.join(", "));
        }
        if !joints.is_empty() {
            let _ = writeln!(text, "    {what}, not compared with what they carry: {}", joints.join(", "));
        }
    }
    for end in &mapping.ends_in_other_frames {
        let _ = writeln!(
            text,
            "    {}, not compared: the files write this axis in other coordinates, and may count from another place",
            end.sentence()
        );
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
