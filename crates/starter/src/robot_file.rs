//! `congruent new robot`: a commented robot file for a URDF, with a derived table.

use std::{fmt::Write, path::Path};

use congruent_agreement::compare::{Agreement, WorstDifference};
use congruent_analysis::conversion::{
    Conversion, ConversionReport, ConversionSource, ConversionTarget, DEFAULT_ACCURACY, RoundedAxes, convert,
};
use congruent_description::{ChainEnd, ReportedChain, RobotDescription, Tolerance};
use congruent_input::{Diagnostic, Finding, display::length_and_angle};
use congruent_writers::robot_file_values;
use schemars::JsonSchema;
use serde::Serialize;

use crate::written::{absolute, comment};

/// A table that is off by rounded axes is given this multiple of what was found at random configurations as tolerance:
/// others may be somewhat worse.
const TOLERANCE_MARGIN: f64 = 3.0;

/// The text of a robot file, and what is in it.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotFileDraft {
    /// Text of the file, TOML with comments.
    pub text: String,
    /// Why it has no table; `None` if it has one.
    pub no_table: Option<Diagnostic>,
    /// Tolerance that the file declares: rounding, or wider if axes were rounded. Unit: m and rad.
    pub tolerance: Tolerance,
}

/// The answer of `congruent new robot`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NewRobot {
    /// The robot file that was written.
    pub file: String,
    /// The URDF that it refers to; nothing is copied.
    pub urdf: String,
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// Whether the file has a table.
    pub has_table: bool,
    /// Why it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_table: Option<Finding>,
    /// Tolerance of the written file, by which table and URDF may differ.
    pub tolerance: Tolerance,
    /// What `check` says of the written file.
    pub verdict: Agreement,
    /// The worst difference there.
    pub worst: WorstDifference,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// A robot file for the chain of `description`, a URDF, to be written into `folder`, an absolute path. A robot whose chain
/// has no table gets a file without one.
pub fn robot_file(description: &RobotDescription, to: ConversionTarget, folder: &Path) -> RobotFileDraft {
    let conversion = Conversion {
        from: Some(ConversionSource::Urdf),
        to,
        accuracy: DEFAULT_ACCURACY,
        seed: 0,
        rounded_axes: RoundedAxes::Corrected,
    };
    let mut from_root = description.clone();
    from_root.urdf_path = absolute(&description.urdf_path);
    let mut tolerance = description.tolerance;
    let derived = convert(description, &conversion);
    if let Ok(report) = &derived
        && !report.rounded_axes.is_empty()
    {
        tolerance = wider(tolerance, report);
    }
    let mut text = head(description);
    // A declared tolerance decides alone. The table will be replaced by one of a data sheet, whose digits must then decide.
    let is_default = tolerance == Tolerance::default();
    let values = robot_file_values(&from_root, folder, tolerance);
    for (key, value) in values.into_iter().filter(|(key, _)| !(is_default && *key == "tolerance")) {
        text += &comment(&about(key, description, derived.as_ref().ok()));
        let _ = writeln!(text, "{key} = {value}");
    }
    text += &comment(OPTIONAL);
    text.push('\n');
    text += &match &derived {
        Ok(report) => {
            comment(&table_comment(report, description.format_name()))
                + report.robot_toml.as_deref().unwrap_or_default()
        }
        Err(why) => {
            comment(&format!("No [dh] table: {why}\nA robot with one has the sections [dh] and [[dh.row]]."))
        }
    };
    RobotFileDraft { text, no_table: derived.err(), tolerance }
}

/// Keys whose values no URDF has.
const OPTIONAL: &str = "To be completed, if the robot has them:
tolerance = { position_mm = 0.5, orientation_deg = 0.1 } # without it the digits of the table decide
tcp = { xyz_m = [0, 0, 0.1], rpy_deg = [0, 0, 0] } # the tool centre point in link tip
srdf = \"robot.srdf\" # pairs of links that cannot collide: congruent clearance --write-srdf
packages = { my_description = \"../my_description\" } # folders of package:// meshes";

fn head(description: &RobotDescription) -> String {
    comment(&format!(
        "Robot file of {}, made by `congruent new robot`; `congruent schema robot` has all keys.\n\
         Lengths end in _m or _mm, angles in _deg or _rad.",
        description.name
    ))
}

/// What a key means here, and why it has its value.
fn about(key: &str, description: &RobotDescription, report: Option<&ConversionReport>) -> String {
    let named = |end: ChainEnd, why: &str, option: &str| match end {
        ChainEnd::Chosen => format!("chosen automatically: {why}"),
        ChainEnd::Given => format!("given by {option}"),
        ChainEnd::Declared => "declared".to_owned(),
    };
    let format = description.format_name();
    match key {
        "urdf" => format!("Relative to this file. The {format} and its meshes are referred to, not copied."),
        "base" => {
            let root = format!("the root link of the {format}");
            let why = named(description.chain_ends.base, &root, "--base");
            format!("Link in which the table's base frame is given; {why}.")
        }
        "tip" => {
            let why =
                "the frame for tools at the end of the longest chain of moving joints, before a gripper";
            let why = named(description.chain_ends.tip, why, "--tip");
            let name = |link| description.robot.link(link).name.as_str();
            let likely = description.likely_tips().into_iter().filter(|&link| link != description.tip);
            let others: Vec<&str> = likely.map(name).collect();
            let mut about = format!("The link that the model's last frame is declared in:\n{why}.");
            if !others.is_empty() {
                let _ = write!(about, "\nOthers that might be meant: {}.", others.join(", "));
            }
            about
        }
        "tolerance" => match report {
            Some(report) if !report.rounded_axes.is_empty() => {
                format!(
                    "Largest difference of table and {format} that is accepted: {TOLERANCE_MARGIN} times the {} that rounded axes cause.\n\
                     Remove it with the derived table: the digits of a data sheet then decide.",
                    found(report)
                )
            }
            _ => "Largest difference of poses that is accepted; without it the digits of the table decide."
                .to_owned(),
        },
        _ => String::new(),
    }
}

/// What the proof of a table found.
fn found(report: &ConversionReport) -> String {
    length_and_angle(report.proof.position_m, report.proof.orientation_rad)
}

/// `format` is that of the file that the axes are from.
fn table_comment(report: &ConversionReport, format: &str) -> String {
    let mut text = format!("Derived from the axes of the {format}");
    if let Some(table) = &report.table {
        let _ = write!(text, "; each row is {}", table.equation);
    }
    let _ = writeln!(
        text,
        ".\nLargest difference from the {format}: {}, at {} configurations.",
        found(report),
        report.proof.configurations
    );
    for warning in &report.findings {
        let _ = writeln!(text, "Warning: {warning}.");
    }
    for pair in &report.rounded_axes {
        let [a, b] = &pair.joints;
        let _ = writeln!(
            text,
            "Axes of {a} and {b} are taken as exact; in the {format} they are {} off by rounding.",
            length_and_angle(pair.distance_m, pair.angle_rad)
        );
    }
    for free in &report.free_choices {
        let _ = writeln!(text, "Free choice at {}: {}.", free.joint, free.text);
    }
    text
}

/// A tolerance that holds for a table with corrected axes.
fn wider(declared: Tolerance, report: &ConversionReport) -> Tolerance {
    let enough = |declared: f64, found: f64| declared.max(one_digit(TOLERANCE_MARGIN * found));
    Tolerance {
        position_m: enough(declared.position_m, report.proof.position_m),
        orientation_rad: enough(declared.orientation_rad, report.proof.orientation_rad),
    }
}

fn one_digit(value: f64) -> f64 {
    format!("{value:.0e}").parse().unwrap_or(value)
}
