//! Lines of arms that cannot turn the tool in every direction.

use std::collections::BTreeMap;

use congruent_description::parse_robot;
use congruent_input::SourceFile;
use congruent_kinematics::UrdfTree;
use congruent_scenario::{
    ControllerSettings, LineMotion, MotionSettings, PoseSettings, Scenario, StartSettings, ToolOrientation,
};
use congruent_twin::setup::RunSetup;

use super::{instants, pose};

/// A joint along an axis from a link to the next.
fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], [xyz, axis]: [&str; 2]) -> String {
    format!(
        "<link name=\"{child}\"/><joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <origin xyz=\"{xyz}\"/><axis xyz=\"{axis}\"/><limit lower=\"-2\" upper=\"2\" velocity=\"2\" effort=\"9\"/></joint>"
    )
}

fn setup(joints: &[String], start: &StartSettings, line: LineMotion) -> Result<RunSetup, String> {
    let text = format!("<robot name=\"few\"><link name=\"base\"/>{}</robot>", joints.concat());
    let description =
        parse_robot(None, &SourceFile { path: "few.urdf".into(), text, is_foreign: false }.into()).unwrap();
    let scenario = Scenario {
        name: "few".to_owned(),
        controller: ControllerSettings::default(),
        start: start.clone(),
        motion: vec![MotionSettings::Line(line)],
        ..Scenario::default()
    };
    RunSetup::new(scenario, description)
        .map_err(|found| format!("{}; {}", found[0].message, found[0].help.clone().unwrap_or_default()))
}

/// Three slides and a spindle on whose axis the tool is: it turns while it goes.
#[test]
fn a_gantry_leads_the_tool_on_the_axis_of_its_spindle() {
    let joints = [
        joint("x", "prismatic", ["base", "a"], ["0 0 0", "1 0 0"]),
        joint("y", "prismatic", ["a", "b"], ["0 0 0", "0 1 0"]),
        joint("z", "prismatic", ["b", "c"], ["0 0 0", "0 0 1"]),
        joint("spindle", "revolute", ["c", "tool"], ["0 0 -0.1", "0 0 1"]),
    ];
    let line_tcp = PoseSettings { rpy_deg: Some([0.0, 0.0, 90.0]), ..pose([0.6, 0.2, -0.5]) };
    let line = LineMotion { line_tcp, duration_s: Some(1.5), ..LineMotion::default() };
    let found = instants(&setup(&joints, &StartSettings::default(), line).unwrap());
    let end = &found[found.len() - 1].q;
    for (q, expected) in end.iter().zip([0.6, 0.2, -0.4, std::f64::consts::FRAC_PI_2]) {
        assert!((q - expected).abs() < 1e-9, "{end:?}");
    }
}

/// A turning column, a shoulder and an elbow: the position is all that they lead.
#[test]
fn an_arm_of_three_joints_leads_the_position_if_the_orientation_is_free() {
    let joints = [
        joint("column", "revolute", ["base", "a"], ["0 0 0", "0 0 1"]),
        joint("shoulder", "revolute", ["a", "b"], ["0 0 0.3", "0 1 0"]),
        joint("elbow", "revolute", ["b", "c"], ["0.4 0 0", "0 1 0"]),
        "<link name=\"tool\"/><joint name=\"flange\" type=\"fixed\"><parent link=\"c\"/><child link=\"tool\"/>\
         <origin xyz=\"0.3 0 0\"/></joint>"
            .to_owned(),
    ];
    let joints_rad = BTreeMap::from([("shoulder".to_owned(), 0.35), ("elbow".to_owned(), 0.7)]);
    let start = StartSettings { joints_rad, ..StartSettings::default() };
    let line = LineMotion { line_tcp: pose([0.5, 0.1, 0.1]), duration_s: Some(1.0), ..LineMotion::default() };
    let refused = setup(&joints, &start, line.clone()).unwrap_err();
    assert!(
        refused.contains("an orientation error of ") && refused.contains("`orientation = \"free\"`"),
        "{refused}"
    );
    let line = LineMotion { orientation: ToolOrientation::Free, ..line };
    let setup = setup(&joints, &start, line).unwrap();
    let robot = &setup.description.robot;
    let (tree, tool) = (UrdfTree::new(robot), robot.find_link("tool").unwrap());
    let positions: Vec<_> = instants(&setup)
        .iter()
        .map(|now| tree.root_from_link(&now.q, tool).unwrap().to_isometry().translation.vector)
        .collect();
    let (first, last) = (positions[0], positions[positions.len() - 1]);
    let along = (last - first).normalize();
    assert!((last - nalgebra::Vector3::new(0.5, 0.1, 0.1)).norm() < 1e-6, "{last}");
    for position in &positions {
        let moved = position - first;
        let off_m = (moved - along * moved.dot(&along)).norm();
        assert!(off_m < 1e-6, "{off_m}");
    }
}
