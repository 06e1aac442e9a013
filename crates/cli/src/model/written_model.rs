//! A converted model as text, printed or written to a file.

use std::path::{Path, PathBuf};

use congruent::{
    analysis::conversion::{
        Conversion, ConversionReport, ConversionTarget, Destination, convert, convert_robot,
    },
    description::{Geometry, Robot, RobotDescription, Tolerance, load_robot_with},
    input::{Diagnostic, FileAccess, RevisionName, is_standard_input},
    text::{conversion_comments, conversion_remarks, conversion_text},
    writers::{own_robot_file_text, robot_file_text},
};

use crate::{
    codes,
    failure::Failure,
    input::{allowing_inputs, files_of},
    output::file::{NewFile, folder_of},
    terminal::print::Printer,
};

/// The tolerance of a written robot file whose table is off by rounded axes, as a multiple of what was found at
/// random configurations: others may be somewhat worse.
const TOLERANCE_MARGIN: f64 = 3.0;

/// Converts a model; prints it, or writes it and says so.
pub(super) fn answer(
    description: &RobotDescription,
    conversion: &Conversion,
    file: Option<NewFile<'_>>,
    printer: &Printer,
) -> Result<u8, Failure> {
    let report = if conversion.is_whole(description)? {
        whole_robot(description, conversion, file.as_ref())?
    } else {
        convert(description, conversion)?
    };
    printer.warnings(None, &report.findings);
    let Some(file) = file else {
        printer.verbatim(&report, conversion_text)?;
        return Ok(0);
    };
    let path = file.path;
    let inputs = files_of(description);
    // Screws are also written as text, under any other name.
    let is_toml = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    let is_robot_file = |_: &&String| is_toml || conversion.to != ConversionTarget::Poe;
    if let Some(section) = report.robot_toml.as_ref().filter(is_robot_file) {
        if !is_toml {
            let message = format!("--to {}: the name of a robot file must end in .toml", path.display());
            return Err(Diagnostic::error(codes::output::NAME, message).into());
        }
        let is_own = conversion.to == ConversionTarget::Poe || description.own_model().is_some();
        let robot_file = if is_own {
            folder_of(path)?;
            own_robot_file_text(description, section)
        } else {
            robot_file(description, &report, section, &folder_of(path)?)?
        };
        let text = conversion_comments(&report) + &robot_file;
        file.write(&text, &inputs, |written| {
            let access = allowing_inputs(FileAccess::default(), description);
            Ok(load_robot_with(written, &access).map(drop)?)
        })?;
    } else {
        folder_of(path)?;
        file.write(&conversion_text(&report), &inputs, |_| Ok(()))?;
    }
    printer.result(&report, |report| {
        // The warnings, which the file has as well, were printed above.
        let remarks = conversion_remarks(&ConversionReport { findings: Vec::new(), ..report.clone() });
        format!("{remarks}written to {}\n", path.display())
    })?;
    Ok(0)
}

/// The whole robot, for the file that is asked for, or, if it is printed, for one beside the source.
fn whole_robot(
    description: &RobotDescription,
    conversion: &Conversion,
    file: Option<&NewFile<'_>>,
) -> Result<ConversionReport, Diagnostic> {
    let has_no_folder =
        is_standard_input(&description.urdf_path) || RevisionName::of(&description.urdf_path).is_some();
    let source = if has_no_folder { Path::new("") } else { &description.urdf_path };
    if RevisionName::of(&description.urdf_path).is_some() && has_meshes(&description.robot) {
        let message = format!(
            "{}: its meshes are files of a revision, which a file cannot name",
            description.urdf_path.display()
        );
        return Err(Diagnostic::error(codes::convert::TO, message)
            .with_help("check the revision out, and convert the robot there"));
    }
    let beside = source.with_file_name("converted.xml");
    if let Some(file) = file {
        file.may_be_written(&files_of(description))?;
        folder_of(file.path)?;
    }
    let access = allowing_inputs(FileAccess::default(), description);
    let path = file.map_or(beside.as_path(), |file| file.path);
    convert_robot(description, conversion, Destination { path, access: &access })
}

fn has_meshes(robot: &Robot) -> bool {
    let shapes = robot.links().iter().flat_map(|link| link.visuals.iter().chain(&link.collisions));
    shapes.into_iter().any(|shape| matches!(shape.geometry, Geometry::Mesh(_)))
}

/// A whole robot file, with paths relative to its folder.
fn robot_file(
    description: &RobotDescription,
    report: &ConversionReport,
    section: &str,
    folder: &Path,
) -> Result<String, Diagnostic> {
    if is_standard_input(&description.urdf_path) {
        let message = "the URDF came from standard input, but a robot file must name its URDF by a path";
        return Err(Diagnostic::error(codes::output::URDF, message).with_help("give the URDF as a file"));
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
