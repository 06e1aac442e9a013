//! Entries with one fault each, and the edits that correct one.

use std::sync::Arc;

use congruent_input::{Findings, SourceFile, changed_lines, line_column};
use nalgebra::{Matrix3, Vector3};

use super::*;
use crate::{RobotDescription, parse_robot};

const URDF: &str = "<robot name='r'><link name='base'/>\
    <link name='one'/><joint name='turn' type='continuous'><parent link='base'/><child link='one'/></joint>\
    <link name='two'/><joint name='slide' type='prismatic'><parent link='one'/><child link='two'/>\
    <limit lower='-1' upper='1' effort='1' velocity='1'/></joint>\
    <link name='tip'/><joint name='flange' type='fixed'><parent link='two'/><child link='tip'/></joint></robot>";

const GOOD: &str = "tip = 'tip'
[dh]
convention = 'standard'
row = [
  { joint = 'turn', kind = 'revolute', a_m = 0, alpha_deg = 0, d_m = 0 },
  { joint = 'slide', kind = 'prismatic', a_m = 0, alpha_deg = 0, d_m = 0 },
]
[dynamics]
source = 'a table'
gravity_m_s2 = [0, 0, -9.81]
[[inertial]]
joint = 'turn'
frame = 'dh1'
about = 'com'
mass_kg = 3.5
com_mm = [1, -20, 300]
damping_n_m_s_rad = 0.5
[[inertial]]
joint = 'slide'
frame = 'link'
about = 'frame'
mass_kg = 2
com_m = [0, 0, 0.5]
inertia_kg_m2 = { xx = 3, yy = 2, zz = 1, xy = 0.1, xz = 0.2, yz = 0.3 }
friction_n = 0.25
";

fn source(name: &str, text: &str) -> Arc<SourceFile> {
    Arc::new(SourceFile { path: name.into(), text: text.to_owned(), is_foreign: false })
}

fn parsed(text: &str) -> Result<RobotDescription, Findings> {
    parse_robot(Some(&source("robot.toml", text)), &source("r.urdf", URDF))
}

#[test]
fn a_good_file_is_read() {
    let description = parsed(GOOD).unwrap_or_else(|found| panic!("{found:#?}"));
    let dynamics = description.dynamics.unwrap();
    assert_eq!(dynamics.source.as_deref(), Some("a table"));
    assert_eq!(dynamics.gravity_in_base_m_s2, Some(Vector3::new(0.0, 0.0, -9.81)));
    let [turn, slide] = &dynamics.inertials[..] else { panic!("{dynamics:?}") };
    assert_eq!((turn.frame, turn.about), (InertialFrame::Dh(1), InertialPoint::Com));
    assert_eq!((turn.mass_kg, turn.com_m), (3.5, Some(Vector3::new(0.001, -0.02, 0.3))));
    assert_eq!((turn.damping, turn.friction, turn.tensor_kg_m2), (Some(0.5), None, None));
    assert_eq!((slide.frame, slide.about), (InertialFrame::Link, InertialPoint::Frame));
    assert_eq!(slide.friction, Some(0.25));
    let expected = Matrix3::new(3.0, 0.1, 0.2, 0.1, 2.0, 0.3, 0.2, 0.3, 1.0);
    assert_eq!(slide.tensor_kg_m2, Some(expected));
}

#[track_caller]
fn refused(old: &str, new: &str, message: &str, help: &str, at: &str) {
    let text = GOOD.replacen(old, new, 1);
    assert_ne!(text, GOOD, "{old}");
    let found = parsed(&text).unwrap_err();
    let fault = found.iter().find(|fault| fault.message.contains(message));
    let fault = fault.unwrap_or_else(|| panic!("{found:#?}"));
    assert!(fault.help.as_deref().unwrap_or_default().contains(help), "{fault:#?}");
    let start = fault.span.as_ref().unwrap().start;
    let line = text.lines().nth(line_column(&text, start).0 - 1).unwrap();
    assert!(line.contains(at), "{line}");
}

#[test]
fn frame_and_point_are_never_defaulted() {
    refused("frame = 'dh1'\n", "", "joint \"turn\" has no frame", "there is no default", "[[inertial]]");
    refused("about = 'com'\n", "", "joint \"turn\" has no about", "there is no default", "[[inertial]]");
}

#[test]
fn wrong_names_have_the_nearest_one() {
    refused("'dh1'", "'lnk'", "unknown frame \"lnk\"", "link", "lnk");
    refused(
        "joint = 'turn'\nframe",
        "joint = 'trun'\nframe",
        "joint \"trun\" is not in the robot",
        "turn",
        "trun",
    );
    refused(
        "joint = 'turn'\nframe",
        "joint = 'flange'\nframe",
        "is fixed and carries no body",
        "turn",
        "flange",
    );
    refused("about = 'com'", "about = 'origin'", "unknown value \"origin\"", "com", "origin");
    refused(
        "mass_kg = 3.5",
        "mass_kg = 3.5\ncom_cm = [1, 2, 3]",
        "unknown key \"com_cm\"",
        "com_m",
        "com_cm",
    );
    refused("zz = 1,", "", "missing key \"zz\"", "", "inertia_kg_m2");
}

#[test]
fn a_mass_may_stand_alone() {
    let description = parsed(&GOOD.replacen("com_mm = [1, -20, 300]\n", "", 1)).unwrap();
    let [turn, slide] = &description.dynamics.unwrap().inertials[..] else { panic!("two entries") };
    assert_eq!((turn.mass_kg, turn.com_m), (3.5, None));
    assert!(slide.com_m.is_some());
}

#[test]
fn the_geometry_is_checked_with_a_frame_of_another_joint() {
    let description = parsed(&GOOD.replacen("'dh1'", "'dh2'", 1)).unwrap();
    assert!(description.dynamics.is_none());
    let warning =
        description.warnings.iter().find(|warning| warning.code.name == "robot_file::inertial").unwrap();
    assert!(
        warning.message.contains("frame \"dh2\" is not fixed to the link that joint \"turn\" moves"),
        "{warning:?}"
    );
    assert!(warning.help.as_deref().unwrap_or_default().contains("frame = \"dh1\""), "{warning:?}");
}

#[test]
fn wrong_values_are_refused() {
    refused("mass_kg = 3.5", "mass_kg = 0", "mass_kg must be greater than 0", "", "mass_kg");
    refused("mass_kg = 3.5", "mass_kg = nan", "mass_kg is NaN", "", "mass_kg");
    refused("com_m = [0, 0, 0.5]\n", "", "has no com_m or com_mm", "needs the centre of mass", "'frame'");
    refused(
        "com_mm = [1,",
        "com_m = [0, 0, 0]\ncom_mm = [1,",
        "com_m and com_mm are both given",
        "",
        "com_mm",
    );
    refused("damping_n_m_s_rad = 0.5", "damping_n_m_s_rad = -1", "must not be negative", "", "damping");
    refused(
        "friction_n = ",
        "friction_n_m = ",
        "joint \"slide\", which slides",
        "the key for this joint is friction_n",
        "friction_n_m",
    );
    refused(
        "joint = 'slide'\nframe",
        "joint = 'turn'\nframe",
        "already has an [[inertial]] entry, at line 11",
        "",
        "turn",
    );
    refused("-9.81]", "inf]", "gravity_m_s2 is inf", "", "gravity");
}

#[test]
fn corrections_are_written_in_the_files_units() {
    let description = parsed(GOOD).unwrap();
    let places = description.places.inertials.unwrap();
    let mut edits = places.set_mass(0, 4.25);
    edits.extend(places.set_com(0, &Vector3::new(0.001, -0.02, 0.25)));
    edits.extend(places.set_terms(0, [0.0, 0.75, 1.0]));
    edits.extend(places.set_tensor(1, &Matrix3::new(3.0, 0.1, -0.2, 0.1, 2.0, 0.3, -0.2, 0.3, 1.0)));
    let mut lines: Vec<String> = GOOD.lines().map(str::to_owned).collect();
    for change in changed_lines(GOOD, &edits).into_iter().rev() {
        lines.splice(change.from_line - 1..change.to_line, [change.text]);
    }
    let text = lines.join("\n");
    assert!(text.contains("com_mm = [1.0, -20.0, 250.0]") && text.contains("xz = -0.2,"), "{text}");
    let corrected = parsed(&text).unwrap().dynamics.unwrap();
    assert_eq!((corrected.inertials[0].mass_kg, corrected.inertials[0].damping), (4.25, Some(0.75)));
    assert_eq!(corrected.inertials[0].friction, None, "what is not declared stays out");
}

#[test]
fn parameters_have_their_places() {
    let description = parsed(GOOD).unwrap();
    let places = description.places.inertials.unwrap();
    let at = |entry, parameter| &GOOD[places.parameter(entry, parameter).unwrap()];
    assert_eq!([at(0, "mass"), at(0, "com_y"), at(0, "friction")], ["3.5", "[1, -20, 300]", "'turn'"]);
    assert_eq!([at(1, "ixz"), at(1, "friction")], ["0.2", "0.25"]);
    assert_eq!(places.gravity().map(|at| &GOOD[at]), Some("[0, 0, -9.81]"));
    assert_eq!(places.parameter(2, "mass"), None);
}
