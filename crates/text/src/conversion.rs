//! What `congruent convert` and `derive` print of a converted model.

use std::fmt::Write;

use congruent_analysis::conversion::{ConversionReport, ConversionSource, PoeReport, ScrewReport};
use congruent_input::{
    display::{angle, counted, length, length_and_angle},
    serde_name,
};
use congruent_writers::ReadBackReport;

use crate::layout::column_width;

/// What `congruent convert` and `derive` print: a text that can be pasted or saved as it is. Everything but the model itself is
/// a comment.
pub fn conversion_text(report: &ConversionReport) -> String {
    if let Some(xml) = report.urdf.as_ref().or(report.mjcf.as_ref()) {
        // Two hyphens end a comment in XML.
        let remarks = conversion_remarks(report).replace("--", "- -");
        return xml.replacen('\n', &format!("\n<!--\n{remarks}-->\n"), 1);
    }
    let mut text = conversion_comments(report);
    if let Some(poe) = &report.poe {
        screws(&mut text, poe);
    }
    if let Some(section) = &report.robot_toml {
        text += section;
    }
    text
}

/// The remarks as comments of a TOML file.
pub fn conversion_comments(report: &ConversionReport) -> String {
    conversion_remarks(report).lines().fold(String::new(), |text, line| text + "# " + line + "\n")
}

/// What was converted, how exact it is, and which choices were free: a line each.
pub fn conversion_remarks(report: &ConversionReport) -> String {
    let mut text = String::new();
    let from = match report.from {
        ConversionSource::Dh => "its [dh] table",
        ConversionSource::Urdf => "its joint axes",
    };
    if let Some(found) = &report.read_back {
        whole_robot(&mut text, report, found);
        return text;
    }
    let _ = writeln!(text, "{}: {}, from {from}", report.robot, report.chain);
    if let Some(table) = &report.table {
        let _ = writeln!(text, "each row is {}", table.equation);
    }
    let proof = &report.proof;
    let _ = writeln!(
        text,
        "proof: screws agree within {} and {}, home pose within {}, poses at {} configurations within {}; limit {:e} rad and m",
        angle(proof.screw_rad),
        length(proof.screw_m),
        length_and_angle(proof.home_m, proof.home_rad),
        proof.configurations,
        length_and_angle(proof.position_m, proof.orientation_rad),
        proof.limit
    );
    for warning in &report.findings {
        let _ = writeln!(text, "warning: {warning}");
    }
    for note in &report.notes {
        let _ = writeln!(text, "note: {note}");
    }
    for pair in &report.axes {
        let [a, b] = &pair.joints;
        let relation = serde_name(&pair.relation).replace('_', "-");
        let _ = writeln!(
            text,
            "axes of {a} and {b}: {relation}, {}, {} apart",
            angle(pair.angle_rad),
            length(pair.distance_m)
        );
    }
    for free in &report.free_choices {
        let _ = writeln!(text, "free choice at {}: {}", free.joint, free.text);
    }
    text
}

/// The remarks on a whole robot.
fn whole_robot(text: &mut String, report: &ConversionReport, found: &ReadBackReport) {
    let ReadBackReport { links, joints, shapes, .. } = found;
    let _ = writeln!(
        text,
        "{}: the whole robot, {}, {}, {}",
        report.robot,
        counted(*links, "link"),
        counted(*joints, "moving joint"),
        counted(*shapes, "shape")
    );
    let _ = writeln!(
        text,
        "read back: poses of all links at {} configurations agree within {}, {}; limit {:e}",
        report.proof.configurations,
        length_and_angle(found.position_m, found.orientation_rad),
        found.values_in_words(),
        found.limit
    );
    for warning in &report.findings {
        let _ = writeln!(text, "warning: {warning}");
    }
    for note in &report.notes {
        let _ = writeln!(text, "note: {note}");
    }
}

/// Screws as comments, so that the whole text is a robot file.
fn screws(text: &mut String, poe: &PoeReport) {
    let mut list = |title: &str, screws: &[ScrewReport]| {
        let _ = writeln!(text, "# {title}: angular, linear");
        let width = column_width(screws.iter().map(|screw| screw.joint.len()));
        for ScrewReport { joint, angular: [a, b, c], linear: [x, y, z] } in screws {
            let _ =
                writeln!(text, "#   {joint:width$}  {a:13.9} {b:13.9} {c:13.9}   {x:13.9} {y:13.9} {z:13.9}");
        }
    };
    list("space screws", &poe.space_screws);
    list("body screws", &poe.body_screws);
    let [x, y, z] = poe.base_from_tip_at_zero.translation_m;
    let [qw, qx, qy, qz] = poe.base_from_tip_at_zero.quaternion_wxyz;
    let _ = writeln!(text, "# tip at zero: translation in m, quaternion w x y z");
    let _ = writeln!(text, "#   {x:13.9} {y:13.9} {z:13.9}   {qw:12.9} {qx:12.9} {qy:12.9} {qz:12.9}");
}
