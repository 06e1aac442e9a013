//! `check --measurements`: the model against measured points, with a tolerance and a verdict, base and tool fitted before.

use std::fs;

use crate::support::{
    command::{congruent, congruent_json, text},
    golden::number,
    scratch_folder::ScratchFolder,
};

/// Points of the planar arm of 0.6 m and 0.4 m, by hand; the third is 2 mm off along y.
const POINTS: &str = "\
joint_1_deg,joint_2_deg,x_m,y_m,z_m
0,0,1,0,0
90,0,0,1,0
0,90,0.6,0.402,0
90,-90,0.4,0.6,0
0,-90,0.6,-0.4,0
180,90,-0.6,-0.4,0
";

/// The same points in a frame that is turned by a quarter turn and 3 m and 2 m away: (x, y) is (3 - y, x - 2, 1).
const FROM_ASIDE: &str = "\
joint_1_deg,joint_2_deg,x_m,y_m,z_m
0,0,3,-1,1
90,0,2,-2,1
0,90,2.598,-1.4,1
90,-90,2.4,-1.6,1
0,-90,3.4,-1.4,1
180,90,3.4,-2.6,1
";

#[test]
fn a_row_beyond_the_tolerance_is_named_with_its_line() {
    let scratch = ScratchFolder::new();
    let file = scratch.write("points.csv", POINTS);
    let check = |tolerance: &str| {
        congruent_json(&["check", "robots/planar_2r", "--measurements", &file, "--tolerance", tolerance])
    };
    let answer = check("1mm");
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    let report = answer.json();
    assert_eq!(report["verdict"], "disagree");
    assert_eq!([&report["rows"], &report["rows_beyond"]], [6, 1]);
    assert_eq!([&report["worst"]["row"], &report["worst"]["line"]], [3, 4]);
    assert!((number(&report["worst"]["position_m"]) - 0.002).abs() < 1e-12, "{}", report["worst"]);
    assert!((number(&report["differences"]["rms_m"]) - 0.002 / 6_f64.sqrt()).abs() < 1e-12);
    assert_eq!(check("3mm").code, 0);
}

#[test]
fn the_answer_is_the_first_line_and_that_of_quiet_and_ci() {
    let scratch = ScratchFolder::new();
    let file = scratch.write("points.csv", POINTS);
    let junit = text(&scratch.path().join("junit.xml"));
    let arguments = ["check", "robots/planar_2r", "--measurements", &file, "--tolerance", "1mm"];
    let whole = congruent(&[&arguments[..], &["--junit", &junit]].concat());
    assert_eq!(whole.code, 1, "{}{}", whole.stdout, whole.stderr);
    let first = whole.stdout.lines().next().unwrap();
    for words in
        ["DIFFERENT FROM MEASURED, by up to 2 mm", "1 of 6 is beyond the tolerance of 1 mm", "points.csv:4"]
    {
        assert!(first.contains(words), "{words} is not in {first}");
    }
    assert!(whole.stdout.contains("joint_2 90 deg"), "{}", whole.stdout);
    let quiet = congruent(&[&arguments[..], &["-q"]].concat());
    assert_eq!(quiet.stdout.trim_end(), first);
    let junit = fs::read_to_string(junit).unwrap();
    assert!(junit.contains("failures=\"1\"") && junit.contains("2 mm"), "{junit}");
}

#[test]
fn the_largest_distance_and_the_largest_angle_may_be_of_two_rows() {
    let scratch = ScratchFolder::new();
    // The second row is 2 mm off and not turned, the third one turned by 2 asin(0.01) and not off.
    let rows = "joint_1_deg,joint_2_deg,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,1,0,0,1,0,0,0\n0,0,1.002,0,0,1,0,0,0\n\
                0,0,1,0,0,0.99994999875,0,0,0.01\n";
    let file = scratch.write("two.csv", rows);
    let arguments = ["check", "robots/planar_2r", "--measurements", &file, "--tolerance", "1mm,2deg", "-q"];
    let answer = congruent(&arguments);
    assert!(
        answer.code == 1 && answer.stdout.contains("by up to 2 mm and 1.15 deg"),
        "{}{}",
        answer.stdout,
        answer.stderr
    );
}

#[test]
fn the_base_is_fitted_before_if_it_is_free() {
    let scratch = ScratchFolder::new();
    let file = scratch.write("aside.csv", FROM_ASIDE);
    let arguments = ["check", "robots/planar_2r", "--measurements", &file, "--tolerance", "3mm"];
    assert_eq!(congruent_json(&arguments).code, 1);
    let answer = congruent_json(&[&arguments[..], &["--free", "base"]].concat());
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let report = answer.json();
    let fitted = report["fitted"].as_array().unwrap();
    let value = |name: &str| number(&fitted.iter().find(|each| each["name"] == name).unwrap()["value"]);
    assert!((value("base.x") - 3.0).abs() < 2e-3 && (value("base.y") + 2.0).abs() < 2e-3, "{fitted:?}");
    assert!((value("base.yaw") - 90_f64.to_radians()).abs() < 5e-3, "{fitted:?}");
    let people = congruent(&[&arguments[..], &["--free", "base"]].concat());
    assert!(people.stdout.contains("SAME AS MEASURED"), "{}", people.stdout);
    assert!(people.stdout.contains("after base was fitted"), "{}", people.stdout);
}

#[test]
fn what_cannot_be_compared_is_refused_with_what_to_write() {
    let scratch = ScratchFolder::new();
    let file = scratch.write("points.csv", POINTS);
    let one = scratch.write("one.csv", "joint_1_deg,joint_2_deg,x_m,y_m,z_m\n0,0,1,0,0\n");
    for (arguments, words) in [
        (vec!["--measurements", &file], "write --tolerance 1mm"),
        (vec!["--measurements", &file, "--tolerance", "0.1deg"], "--tolerance 1mm"),
        (vec!["--measurements", &file, "--tolerance", "1mm", "--free", "base,dh"], "congruent calibrate"),
        (vec!["--measurements", &one, "--tolerance", "1mm", "--free", "base,tool"], "more configurations"),
    ] {
        let answer = congruent_json(&[&["check", "robots/planar_2r"], &arguments[..]].concat());
        assert_eq!(answer.code, 2, "{arguments:?}: {}{}", answer.stdout, answer.stderr);
        assert!(answer.stdout.contains(words), "{words} is not in {}", answer.stdout);
    }
    let refused =
        congruent(&["check", "robots/planar_2r", "--measurements", "missing.csv", "--tolerance", "1mm"]);
    assert_eq!(refused.code, 2, "{}", refused.stderr);
    let both = congruent(&["check", "robots/planar_2r", "--measurements", &file, "--against", "robots/ur5e"]);
    assert_eq!(both.code, 2, "{}", both.stderr);
}
