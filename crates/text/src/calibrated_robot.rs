//! What a calibrated robot file says about itself, and what `calibrate --out` prints of the files that it wrote.

use std::fmt::Write;

use congruent_calibration::report::{
    CalibratedFiles, CalibrationReport, EstimatedFrames, Recommendation, WrittenModel,
};
use congruent_calibration::same_point::{SamePointReport, SamePointSpread};
use congruent_calibration::{CameraFrames, FrameOnLink};
use congruent_description::ReportedChain;
use congruent_input::{
    InputFile,
    display::{counted, length, length_and_angle},
    visible,
};
use congruent_kinematics::ReportedPose;

/// The comments at the beginning of a calibrated robot file: measurements, estimate, residual and corrections. They have no date, so
/// that the same measurements give the same file.
pub fn calibrated_robot_comments(
    report: &CalibrationReport,
    measurements: Option<&InputFile>,
    left_out: &[String],
) -> String {
    let mut text = String::new();
    let source = measurements.map_or_else(|| "standard input".to_owned(), with_digest);
    let rows = counted(report.rows, "measurement");
    let _ = writeln!(text, "# Robot \"{}\", corrected by `congruent calibrate`", visible(&report.robot));
    let _ = writeln!(text, "# from {rows} of {} in {source}.", visible(&report.measured_frame));
    let (estimate, residuals) = match report.recommended {
        Recommendation::Robust => ("the robust estimate", &report.robust.residuals),
        _ => ("least squares", &report.least_squares.residuals),
    };
    let all = length_and_angle(residuals.rms_m, residuals.rms_rad);
    let nominal = length_and_angle(report.nominal.rms_m, report.nominal.rms_rad);
    let _ = writeln!(
        text,
        "# Estimate: {estimate}. Residual, root mean square: {all}, {nominal} with the nominal model;"
    );
    if let Some(error) = &report.held_out {
        let _ = writeln!(
            text,
            "# {} on held-out rows ({} folds), {} there with the nominal model.",
            length_and_angle(error.rms_m, error.rms_rad),
            error.folds,
            length_and_angle(error.nominal_rms_m, error.nominal_rms_rad)
        );
    }
    text += "# Corrections:\n";
    for each in &report.parameters {
        let value = match report.recommended {
            Recommendation::Robust => each.robust_correction,
            _ => each.correction,
        };
        let (value, unit) = (each.unit.for_people(value), each.unit.name_for_people());
        let _ = writeln!(text, "#   {} {value:+.4} {unit}", visible(&each.name));
    }
    for each in report.fixed.iter().filter(|each| each.held_at != 0.0) {
        let (value, unit) = (each.unit.for_people(each.held_at), each.unit.name_for_people());
        let _ = writeln!(text, "#   {} {value:+.4} {unit}, not identified", visible(&each.name));
    }
    not_taken_over(&mut text, left_out);
    text
}

/// The same of a calibration by touched points.
pub fn same_point_robot_comments(
    report: &SamePointReport,
    files: &[InputFile],
    left_out: &[String],
) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "# Robot \"{}\", corrected by `congruent calibrate --same-point`\n# from {} with {} at one point in each of:",
        visible(&report.robot),
        counted(report.rows, "configuration"),
        visible(&report.tool_frame)
    );
    for file in files {
        let _ = writeln!(text, "#   {}", with_digest(file));
    }
    let spread =
        |of: &SamePointSpread| format!("{} in the mean, {} at most", length(of.mean_m), length(of.worst_m));
    let _ = writeln!(text, "# Distance from the points: {};", spread(&report.corrected));
    if let Some(held_out) = &report.held_out {
        let _ = writeln!(text, "# {} of held-out rows;", spread(held_out));
    }
    let _ = writeln!(text, "# {} with the nominal model.\n# Corrections:", spread(&report.nominal));
    for each in &report.parameters {
        let (value, unit) = (each.unit.for_people(each.correction), each.unit.name_for_people());
        let _ = writeln!(text, "#   {} {value:+.4} {unit}", visible(&each.name));
    }
    not_taken_over(&mut text, left_out);
    text
}

fn with_digest(file: &InputFile) -> String {
    format!("{} (SHA-256 {})", visible(&file.file), file.sha256)
}

fn not_taken_over(text: &mut String, left_out: &[String]) {
    if !left_out.is_empty() {
        let _ = writeln!(text, "# Not taken over from the nominal robot file: {}.", left_out.join(", "));
    }
}

/// Base and tool with which the corrections of the arm are right.
pub(crate) fn frames_text(text: &mut String, report: &CalibrationReport) {
    if let Some(camera) = &report.camera {
        camera_text(text, camera, "camera and target as estimated");
        if report.recommended != Recommendation::Nominal {
            camera_origin(text, &camera.camera);
        }
    }
    let Some(EstimatedFrames { measured_from_base, tip_from_measured }) = &report.frames else { return };
    let _ = writeln!(text, "\n  frames with which the corrections of the arm are right");
    let (base, tip) = (&report.chain.base, &report.chain.tip);
    if let Some(pose) = measured_from_base {
        let _ = writeln!(text, "  {base} in the frame of the measurements  {}", pose_in_words(pose));
    }
    if let Some(pose) = tip_from_measured {
        let _ = writeln!(text, "  measured frame in {tip}  {}", pose_in_words(pose));
    }
}

/// Below the title, where camera and target are, and the camera as a fixed joint of a URDF.
pub fn camera_text(text: &mut String, frames: &CameraFrames, title: &str) {
    let _ = writeln!(text, "\n  {title}");
    frame_text(text, "camera", &frames.camera, &pose_in_words(&frames.camera.link_from_frame));
    let pose = pose_in_words(&frames.target.link_from_frame);
    // Points place a target without turning it.
    let placed = pose.split(", rpy_deg").next().unwrap_or(&pose);
    frame_text(text, "target", &frames.target, if frames.has_orientation { &pose } else { placed });
    if !frames.undetermined.is_empty() {
        let _ = writeln!(text, "  not determined: {}", frames.undetermined_in_words());
    }
}

/// Where a frame is, and how well that is known.
fn frame_text(text: &mut String, what: &str, frame: &FrameOnLink, pose: &str) {
    let _ = writeln!(text, "  {what} in {}  {pose}", frame.link);
    let list =
        |values: [f64; 3], factor: f64| values.map(|value| format!("{:.4}", value * factor)).join(", ");
    let position = frame.position_deviation_m.map(|of| format!("[{}] mm", list(of, 1e3)));
    let turn = frame.orientation_deviation_rad.map(|of| format!("[{}] deg", list(of, 1_f64.to_degrees())));
    let deviations: Vec<String> = position.into_iter().chain(turn).collect();
    if !deviations.is_empty() {
        let _ = writeln!(
            text,
            "    standard deviations along and about the axes of {}: {}",
            frame.link,
            deviations.join(", ")
        );
    }
}

/// The camera as the origin of a fixed joint.
fn camera_origin(text: &mut String, camera: &FrameOnLink) {
    let pose = &camera.link_from_frame;
    let list = |values: [f64; 3]| values.map(|value| format!("{value:.6}")).join(" ");
    let (xyz, rpy) = (list(pose.translation_m), list(pose.rpy_rad()));
    let _ = writeln!(text, "  camera in {} as in a URDF  <origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>", camera.link);
}

/// As a robot file may have it.
fn pose_in_words(pose: &ReportedPose) -> String {
    let list =
        |values: [f64; 3], factor: f64| values.map(|value| format!("{:.4}", value * factor)).join(", ");
    let rpy_deg = list(pose.rpy_rad(), 1_f64.to_degrees());
    format!("xyz_mm = [{}], rpy_deg = [{rpy_deg}]", list(pose.translation_m, 1e3))
}

/// The files that were written, and where the corrections are in them.
pub(crate) fn written_text(text: &mut String, written: Option<&CalibratedFiles>, chain: &ReportedChain) {
    let Some(written) = written else { return };
    let CalibratedFiles { robot_file, urdf, beyond_the_table, .. } = written;
    let model = match written.model {
        WrittenModel::Dh => "the corrected table",
        WrittenModel::Poe => "the corrected chain as screws, [poe]",
    };
    let error = length_and_angle(written.position_m, written.orientation_rad);
    let _ = writeln!(text, "\n  written to {robot_file}: {model}");
    if !beyond_the_table.is_empty() {
        let beyond = beyond_the_table.join(", ");
        let _ = writeln!(
            text,
            "  no table has an entry for {beyond}: --hold {} estimates without, and keeps the table",
            beyond_the_table.join(",")
        );
    }
    let _ = writeln!(text, "  written to {urdf}: the tree with corrected origins of its joints");
    let _ = writeln!(text, "  both differ from the calibrated chain by {error}");
    if let Some(base) = &written.base_link {
        let _ =
            writeln!(text, "  base: link \"{base}\", the frame of the measurements, fixed to {}", chain.base);
    }
    if let Some(camera) = &written.camera_link {
        let _ = writeln!(text, "  camera: link \"{camera}\" of the URDF");
    }
    if written.has_corrected_tcp {
        let _ = writeln!(text, "  tool: key tcp of the robot file, in {}", chain.tip);
    }
    if !written.left_out.is_empty() {
        let _ = writeln!(text, "  not taken over from the robot file: {}", written.left_out.join(", "));
    }
}
