//! A diagnosis shows the lines that were loaded, whatever has become of the files since, and those of
//! texts that never were a file.

#![expect(clippy::unwrap_used, reason = "tests stop at what is missing")]

use std::{fs, path::Path, sync::Arc};

use congruent_agreement::compare::{CheckOptions, check};
use congruent_description::{RobotDescription, load_robot, parse_robot};
use congruent_input::SourceFile;
use congruent_kinematics::UrdfTree;

/// Two joints that turn about z, the second 0.4 m out, the tip 0.3 m further.
const URDF: &str = "<robot name='arm'>
<link name='base'/><link name='upper'/><link name='lower'/><link name='tip'/>
<joint name='a' type='revolute'><parent link='base'/><child link='upper'/><axis xyz='0 0 1'/>
<limit lower='-1' upper='1' effort='1' velocity='1'/></joint>
<joint name='b' type='revolute'><parent link='upper'/><child link='lower'/>
<origin xyz='0.4 0 0'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>
<joint name='flange' type='fixed'><parent link='lower'/><child link='tip'/><origin xyz='0.3 0 0'/></joint>
</robot>";

/// Its table, with 0.5 m in line 10 instead of 0.4 m.
const ROBOT_FILE: &str = "urdf = 'arm.urdf'
base = 'base'
tip = 'tip'

[dh]
convention = 'standard'
[[dh.row]]
joint = 'a'
kind = 'revolute'
a_m = 0.5
alpha_deg = 0
d_m = 0
[[dh.row]]
joint = 'b'
kind = 'revolute'
a_m = 0.3
alpha_deg = 0
d_m = 0
";

#[track_caller]
fn names_line_10(description: &RobotDescription, file: &Path) {
    let mut physics = UrdfTree::new(&description.robot);
    let options = CheckOptions::default();
    let report = check(description, Ok(&mut physics), &options).unwrap();
    let fault = &report.diagnosis[0].fault;
    assert_eq!((fault.joint.as_deref(), fault.line), (Some("a"), Some(10)), "{fault:?}");
    assert_eq!(fault.suggestion, "a_m = 0.4");
    let found = &report.diagnoses[0].findings[0];
    let source = found.source.as_ref().unwrap();
    assert_eq!((found.line_column(), source.path.as_path()), (Some((10, 7)), file));
    assert_eq!(&source.text[found.span.clone().unwrap()], "0.5");
}

#[test]
fn an_edit_after_loading_moves_no_line() {
    let folder = tempfile::tempdir().unwrap();
    let [urdf, robot_file] = ["arm.urdf", "robot.toml"].map(|name| folder.path().join(name));
    fs::write(&urdf, URDF).unwrap();
    fs::write(&robot_file, ROBOT_FILE).unwrap();
    let description = load_robot(folder.path()).unwrap();
    fs::write(&robot_file, format!("# a line more\n\n{}", ROBOT_FILE.replace("0.5", "7"))).unwrap();
    fs::remove_file(&urdf).unwrap();
    names_line_10(&description, &robot_file);
}

#[test]
fn a_robot_made_in_memory_has_lines() {
    let source = |name: &str, text: &str| {
        Arc::new(SourceFile { path: name.into(), text: text.to_owned(), is_foreign: false })
    };
    let (robot_file, urdf) = (source("robot.toml", ROBOT_FILE), source("arm.urdf", URDF));
    let description = parse_robot(Some(&robot_file), &urdf).unwrap();
    names_line_10(&description, Path::new("robot.toml"));
}
