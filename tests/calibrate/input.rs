//! `congruent calibrate`: measurements that are refused, each with its line.

use std::fs;

use crate::support::command::{congruent_json, text};

/// Runs with a file of measurements of the planar arm and expects a refusal with all of `words`.
#[track_caller]
fn refuse(measurements: &str, line: u64, words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let file = text(&folder.path().join("points"));
    fs::write(&file, measurements).unwrap();
    let answer = congruent_json(&["calibrate", "robots/planar_2r", &file]);
    assert_eq!(answer.code, 2, "{}{}", answer.stdout, answer.stderr);
    let finding = &answer.json()["findings"][0];
    for word in words {
        assert!(finding.to_string().contains(word), "{word} is not in {finding}");
    }
    assert_eq!(finding["line"].as_u64(), Some(line), "{finding}");
}

#[test]
fn bad_measurements_are_refused_with_their_place() {
    refuse("joint_1_deg,joint_2_deg,x_m,y_m\n0,0,1,0\n# note\n\n1,2,oops,3\n", 5, &["oops", "x_m"]);
    refuse("joint_1_deg,joint_2_deg,x_m,y_m\n0,0,1\n", 2, &["3 cells", "the header has 4"]);
    refuse("joint_1_deg,joint_2_deg,x_m,y_m\n0,,1,0\n", 2, &["joint_2_deg"]);
    refuse("joint_1_deg,joint_2_deg,x_m,y_m\n0,nan,1,0\n", 2, &["nan", "joint_2_deg"]);
    refuse("joint_1_deg,joint_2_deg,x_mm,y_m\n0,0,1,0\n0,0,1e15,0\n", 3, &["1e15", "x_mm"]);
    refuse("joint_1_deg,joint_2_deg,x_m,y_m\n0,1e308,1,0\n", 2, &["1e308", "joint_2_deg"]);
    refuse("joint_1_deg,joint_2_deg,x_m,y_m\n0,0,1e999,0\n", 2, &["1e999", "x_m"]);
    refuse(
        "[{\"q\": {\"joint_1\": 0, \"joint_2\": 0},\n\"translation_m\": [1, 1e30]}]",
        1,
        &["measurement 1"],
    );
    refuse("joint_1,joint_2_deg,x_m,y_m\n0,0,1,0\n", 1, &["joint_1", "unit"]);
    refuse("joint_1_mm,joint_2_deg,x_m,y_m\n0,0,1,0\n", 1, &["joint_1_mm", "joint_1_deg"]);
    refuse("joint_1_deg,joint_3_deg,x_m,y_m\n0,0,1,0\n", 1, &["joint_3_deg", "joint_2"]);
    refuse("joint_1_deg,x_m,y_m\n0,1,0\n", 1, &["joint_2"]);
    refuse("joint_1_deg,joint_2_deg\n0,1\n", 1, &["x_m"]);
    refuse("joint_1_deg,joint_2_deg,x_m,x_mm\n0,1,0,0\n", 1, &["same quantity"]);
    refuse("joint_1_deg,joint_2_deg,x_m,qw\n0,1,0,0\n", 1, &["orientation"]);
    refuse("joint_1_deg,joint_2_deg,x_m,y_m\n", 1, &["no measurement"]);
    refuse(
        "[{\"q\": {\"joint_1\": 0, \"joint_2\": 0}, \"translation_m\": [1, 0]},\n {\"q\": {\"joint_1\": 0}}]",
        2,
        &["measurement 2", "joint_2"],
    );
    refuse("[{\"q\": {\"joint_1\": 0, \"joint_2\": 0}, \"position\": [1, 0]}]", 1, &["position"]);
    refuse("[{\"q\": {\"joint_1\": 0, \"joint_2\": 0}, \"translation_m\": [1]}]", 1, &["x, y"]);
}

#[test]
fn an_unknown_correction_is_refused_with_the_nearest_known_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = text(&folder.path().join("points.csv"));
    fs::write(&file, "joint_1_deg,joint_2_deg,x_m,y_m\n0,0,1,0\n30,-45,0.9,0.2\n").unwrap();
    let answer = congruent_json(&["calibrate", "robots/planar_2r", &file, "--free", "joint_1.zer"]);
    assert_eq!(answer.code, 2);
    assert!(answer.stdout.contains("did you mean \\\"joint_1.zero\\\""), "{}", answer.stdout);
}

#[test]
fn a_joint_that_is_called_roll_is_a_joint() {
    let folder = tempfile::tempdir().unwrap();
    let urdf = "<robot name='r'><link name='base'/><link name='arm'/><link name='tip'/>\
        <joint name='roll' type='revolute'><parent link='base'/><child link='arm'/><axis xyz='0 0 1'/>\
        <limit lower='-1' upper='1' effort='10' velocity='2'/></joint>\
        <joint name='end' type='fixed'><origin xyz='0.3 0 0'/><parent link='arm'/><child link='tip'/></joint></robot>";
    let [robot, points] = ["r.urdf", "points.csv"].map(|name| text(&folder.path().join(name)));
    fs::write(&robot, urdf).unwrap();
    let rows = (-4..5)
        .map(|at| 0.2 * f64::from(at))
        .map(|roll: f64| format!("{},{},{},0\n", roll.to_degrees(), 0.3 * roll.cos(), 0.3 * roll.sin()));
    fs::write(&points, format!("roll_deg,x_m,y_m,z_m\n{}", rows.collect::<String>())).unwrap();
    let answer = congruent_json(&["calibrate", &robot, &points]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    assert_eq!(answer.json()["rows"], 9);
}
