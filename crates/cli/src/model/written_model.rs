//! A converted model as text, printed or written to a file.

use std::{fmt::Write, path::PathBuf};

use congruent::{
    analysis::conversion::{Conversion, ConversionReport, ConversionSource, PoeReport, ScrewReport, convert},
    description::{RobotDescription, Tolerance, load_robot_with, robot_file_text},
    input::{
        Diagnostic, FileAccess,
        display::{angle, length, length_and_angle},
        is_standard_input, serde_name,
    },
};

use crate::{
    failure::Failure,
    input::{allowing_inputs, files_of},
    output::file::{OutputArgument, folder_of},
    terminal::{layout::column_width, print::Printer},
};

/// The tolerance of a written robot file whose table is off by rounded axes, as a multiple of what was found at
/// random configurations: others may be somewhat worse.
const TOLERANCE_MARGIN: f64 = 3.0;

/// Converts a model; prints it, or writes it and says so.
pub(super) fn answer(
    description: &RobotDescription,
    conversion: &Conversion,
    output: &OutputArgument,
    printer: &Printer,
) -> Result<u8, Failure> {
    let report = convert(description, conversion)?;
    printer.warnings(None, &report.findings);
    let Some(path) = &output.out else {
        printer.verbatim(&report, text)?;
        return Ok(0);
    };
    let inputs = files_of(description);
    if let Some(section) = &report.robot_toml {
        if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("toml")) {
            let message = format!("--out {}: the name of a robot file must end in .toml", path.display());
            return Err(Diagnostic::error("output::name", message).into());
        }
        let text = comments(&report) + &robot_file(description, &report, section, &folder_of(path)?)?;
        output.write(path, &text, &inputs, |written| {
            let access = allowing_inputs(FileAccess::default(), description);
            Ok(load_robot_with(written, &access).map(drop)?)
        })?;
    } else {
        folder_of(path)?;
        output.write(path, &text(&report), &inputs, |_| Ok(()))?;
    }
    printer.result(&report, |report| format!("{}written to {}\n", remarks(report), path.display()))?;
    Ok(0)
}

/// A whole robot file, with paths relative to its folder.
fn robot_file(
    description: &RobotDescription,
    report: &ConversionReport,
    section: &str,
    folder: &std::path::Path,
) -> Result<String, Diagnostic> {
    if is_standard_input(&description.urdf_path) {
        let message = "the URDF came from standard input, but a robot file must name its URDF by a path";
        return Err(Diagnostic::error("output::urdf", message).with_help("give the URDF as a file"));
    }
    let absolute = |path: &PathBuf| path.canonicalize().unwrap_or_else(|_| path.clone());
    let mut from_root = description.clone();
    from_root.urdf_path = absolute(&description.urdf_path);
    from_root.named_files.srdf = description.named_files.srdf.as_ref().map(absolute);
    let mut tolerance = description.tolerance;
    // The table differs from the URDF by the rounding of its axes: with the declared tolerance the written file
    // would fail its own check.
    if !report.rounded_axes.is_empty() {
        let enough = |declared: f64, found: f64| declared.max(one_digit(TOLERANCE_MARGIN * found));
        tolerance = Tolerance {
            position_m: enough(tolerance.position_m, report.proof.position_m),
            orientation_rad: enough(tolerance.orientation_rad, report.proof.orientation_rad),
        };
    }
    Ok(robot_file_text(&from_root, section, folder, tolerance))
}

fn one_digit(value: f64) -> f64 {
    format!("{value:.0e}").parse().unwrap_or(value)
}

/// Text that can be pasted or saved as it is: everything but the model itself is a comment.
fn text(report: &ConversionReport) -> String {
    if let Some(urdf) = &report.urdf {
        // Two hyphens end a comment in XML.
        let remarks = remarks(report).replace("--", "- -");
        return urdf.replacen('\n', &format!("\n<!--\n{remarks}-->\n"), 1);
    }
    let mut text = comments(report);
    if let Some(section) = &report.robot_toml {
        text += section;
    }
    if let Some(poe) = &report.poe {
        screws(&mut text, poe);
    }
    text
}

fn comments(report: &ConversionReport) -> String {
    remarks(report).lines().fold(String::new(), |text, line| text + "# " + line + "\n")
}

fn remarks(report: &ConversionReport) -> String {
    let mut text = String::new();
    let from = match report.from {
        ConversionSource::Dh => "its [dh] table",
        ConversionSource::Urdf => "its URDF",
    };
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

fn screws(text: &mut String, poe: &PoeReport) {
    let mut list = |title: &str, screws: &[ScrewReport]| {
        let _ = writeln!(text, "{title}: angular, linear");
        let width = column_width(screws.iter().map(|screw| screw.joint.len()));
        for ScrewReport { joint, angular: [a, b, c], linear: [x, y, z] } in screws {
            let _ =
                writeln!(text, "  {joint:width$}  {a:13.9} {b:13.9} {c:13.9}   {x:13.9} {y:13.9} {z:13.9}");
        }
    };
    list("space screws", &poe.space_screws);
    list("body screws", &poe.body_screws);
    let [x, y, z] = poe.base_from_tip_at_zero.translation_m;
    let [qw, qx, qy, qz] = poe.base_from_tip_at_zero.quaternion_wxyz;
    let _ = writeln!(text, "tip at zero: translation in m, quaternion w x y z");
    let _ = writeln!(text, "  {x:13.9} {y:13.9} {z:13.9}   {qw:12.9} {qx:12.9} {qy:12.9} {qz:12.9}");
}
