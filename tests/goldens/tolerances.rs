//! `tolerances` through the command: its sources, its exit codes and its refusals. The numbers are tested in the crate.

use std::fs;

use serde_json::Value;

use crate::support::{
    command::{congruent, congruent_json, text},
    golden::number,
};

const TYPICAL: [&str; 4] = ["--a=0.05mm", "--d=0.05mm", "--alpha=0.02deg", "--theta=0.02deg"];

/// The UR5e with more lines in its robot file.
fn ur5e_with(lines: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    for file in ["robot.toml", "ur5e.urdf"] {
        fs::copy(
            format!("{}/robots/ur5e/{file}", crate::support::corpus::workspace().display()),
            folder.path().join(file),
        )
        .unwrap();
    }
    let path = folder.path().join("robot.toml");
    let written = fs::read_to_string(&path).unwrap();
    fs::write(&path, format!("{written}\n{lines}")).unwrap();
    let robot = text(folder.path());
    (folder, robot)
}

fn parameter<'a>(document: &'a Value, name: &str) -> &'a Value {
    let all = document["parameters"].as_array().unwrap();
    all.iter().find(|of| of["name"] == name).unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn a_robot_file_declares_what_options_do() {
    let (_folder, robot) = ur5e_with(
        "[tolerances]\na_mm = 0.05\nd_m = 5e-5\nalpha_deg = 0.02\ntheta_deg = 0.02\n[[tolerances.row]]\njoint = \"elbow_joint\"\na_mm = 0.01",
    );
    let declared = congruent_json(&["tolerances", &robot]).json();
    let given = congruent_json(&[&["tolerances", "robots/ur5e"][..], &TYPICAL].concat()).json();
    assert_eq!((&declared["source"], &given["source"]), (&"robot_file".into(), &"options".into()));
    assert!((number(&parameter(&declared, "elbow_joint.a")["tolerance"]) - 1e-5).abs() < 1e-18);
    assert!((number(&parameter(&given, "elbow_joint.a")["tolerance"]) - 5e-5).abs() < 1e-18);
    let rms = |document: &Value| number(&document["overall"]["first_order"]["rms_m"]);
    assert!(rms(&declared) < rms(&given) && rms(&declared) > 0.99 * rms(&given));
    // The three methods in their order: what is drawn, what is attained, what is certified.
    let worst_case = &given["worst_case"];
    assert!(number(&given["worst"]["monte_carlo"]["largest_m"]) < number(&worst_case["attained_m"]));
    assert!(number(&worst_case["attained_m"]) < number(&worst_case["certified_m"]));
}

#[test]
fn wrong_sections_are_refused_at_their_place() {
    for (lines, mention) in [
        ("[tolerances]\na_mm = -0.05", "a_mm must be greater than 0, it is -0.05"),
        ("[tolerances]\na_mm = 0.05\na_m = 5e-5", "are both given"),
        ("[tolerances]\na_mm = 0.05\nsigmas = 3", "sigmas is of normal errors"),
        ("[tolerances]\na_inch = 0.05", "a_inch"),
        ("[[tolerances.row]]\njoint = \"elbow\"\na_mm = 1", "the robot has no joint \"elbow\""),
    ] {
        let (_folder, robot) = ur5e_with(lines);
        let answer = congruent(&["tolerances", &robot]);
        assert!(answer.code == 2 && answer.stderr.contains(mention), "{}", answer.stderr);
        assert!(answer.stderr.contains("robot.toml:1"), "{}", answer.stderr);
    }
}

/// A joint of the robot that does not move has no row and no zero.
#[test]
fn a_row_is_of_a_joint_that_moves_the_tool() {
    let (_folder, robot) = ur5e_with("[[tolerances.row]]\njoint = \"flange-tool0\"\na_mm = 0.01");
    let answer = congruent(&["tolerances", &robot]);
    assert!(answer.code == 2 && answer.stderr.contains("is no joint of the chain"), "{}", answer.stderr);
}

#[test]
fn without_tolerances_the_refusal_says_what_to_write() {
    for (arguments, mentions) in [
        (&["robots/ur5e"][..], ["has no tolerances", "--a 0.05mm", "[tolerances]"]),
        (&["robots/ur5e/ur5e.urdf"], ["has no tolerances", "--xyz 0.05mm", "xyz_mm = 0.05"]),
        (&["robots/ur5e/ur5e.urdf", "--a=1mm"], ["tolerance of a has no effect", "--xyz", "--rpy"]),
        (&["robots/ur5e", "--xyz=1mm"], ["tolerance of xyz has no effect", "--a 0.05mm", "--alpha"]),
        (&["robots/ur5e", "--theta=1"], ["needs a unit", "1deg", "--theta"]),
        (&["robots/ur5e", "--a=1mm", "--digits"], ["cannot be used with", "--digits", "--a"]),
        (
            &["robots/ur5e", "--calibration=schemas/robot.json"],
            ["calibrate", "--format json", "not the report"],
        ),
    ] {
        let answer = congruent(&[&["tolerances"], arguments].concat());
        assert_eq!(answer.code, 2, "{}", answer.stdout);
        let unwrapped: String = answer.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        for mention in mentions {
            assert!(unwrapped.contains(mention), "{mention}: {unwrapped}");
        }
    }
}

#[test]
fn the_exit_code_is_that_of_the_requirement() {
    let with = |limit: &str| {
        let more = ["--samples=20000", "--random=50", limit];
        let answer = congruent_json(&[&["tolerances", "robots/ur5e"][..], &TYPICAL, &more].concat());
        (answer.code, answer.json()["requirement"]["verdict"].clone())
    };
    assert_eq!(with("--tolerance=0.5mm"), (1, "exceeded".into()));
    assert_eq!(with("--tolerance=1mm,0.01deg"), (1, "exceeded".into()));
    assert_eq!(with("--tolerance=1mm"), (0, "within".into()));
    assert_eq!(with("--tolerance=3mm,1deg"), (0, "certified".into()));
    let quiet =
        congruent(&[&["tolerances", "robots/ur5e", "-q", "--tolerance=0.5mm"][..], &TYPICAL].concat());
    assert!(
        quiet.code == 1 && quiet.stdout.starts_with("ur5e: tolerance exceeded: 99.7 %"),
        "{}",
        quiet.stdout
    );
    assert_eq!(quiet.stdout.lines().count(), 1);
}

/// The covariance of a calibration of joint zeros, carried to the tool by the Jacobian of the URDF: `tr(J S J')`.
#[test]
fn a_calibration_gives_its_covariance() {
    let folder = tempfile::tempdir().unwrap();
    let points = "docs/examples/calibration/ur5e_points.csv";
    let calibration = congruent_json(&["calibrate", "robots/ur5e", points]);
    let file = folder.path().join("calibration.json");
    fs::write(&file, &calibration.stdout).unwrap();
    let at =
        ["--at=shoulder_pan_joint=0.3rad", "--at=shoulder_lift_joint=-1.2rad", "--at=elbow_joint=1.5rad"];
    let file = format!("--calibration={}", text(&file));
    let found = congruent_json(&[&["tolerances", "robots/ur5e", &file][..], &at].concat()).json();
    let jacobian = congruent_json(&[&["jacobian", "robots/ur5e", "--link=tcp"][..], &at].concat()).json();

    let report = calibration.json();
    let names = report["parameters"].as_array().unwrap();
    let joints = jacobian["joints"].as_array().unwrap();
    let column = |name: &Value| -> [f64; 3] {
        let joint = name["name"].as_str().unwrap().trim_end_matches(".zero");
        let at = joints.iter().position(|of| of == joint).unwrap();
        [0, 1, 2].map(|row: usize| number(&jacobian["results"][0]["linear"][row][at]))
    };
    let mut square = 0.0;
    for (row, one) in names.iter().enumerate() {
        for (at, other) in names.iter().enumerate() {
            let dot: f64 = column(one).iter().zip(column(other)).map(|(a, b)| a * b).sum();
            square += dot * number(&report["covariance"][row][at]);
        }
    }
    let rms_m = number(&found["overall"]["first_order"]["rms_m"]);
    assert!((rms_m / square.sqrt() - 1.0).abs() < 1e-9, "{rms_m} {}", square.sqrt());
    let other = congruent(&["tolerances", "robots/panda", &file]);
    assert!(other.code == 2 && other.stderr.contains("is of robot \"ur5e\""), "{}", other.stderr);
}

/// The lengths of the UR5e have four decimals and one has three, in m: half of the last place is 0.05 mm and 0.5 mm.
#[test]
fn digits_are_half_of_the_last_place() {
    let found = congruent_json(&["tolerances", "robots/ur5e", "--digits", "--samples=1000"]).json();
    let tolerance = |name: &str| number(&parameter(&found, name)["tolerance"]);
    assert!((tolerance("elbow_joint.a") - 5e-5).abs() < 1e-15);
    assert!((tolerance("shoulder_lift_joint.a") - 5e-4).abs() < 1e-15);
    assert_eq!(found["parameters"][0]["name"], "shoulder_lift_joint.a");
}

/// Errors of half a turn and more: no bound or draw is above 180 degrees, and the worst case is no better than a draw.
#[test]
fn large_tolerances_have_bounds_that_hold() {
    for theta in ["--theta=60deg", "--theta=170deg"] {
        let arguments = ["tolerances", "robots/ur5e", theta, "--samples=5000", "--random=50"];
        let found = congruent_json(&arguments).json();
        let worst = &found["worst_case"];
        let drawn = |at: &str, what: &str| number(&found[at]["monte_carlo"][what]);
        for (what, attained, certified) in
            [("largest_m", "attained_m", "certified_m"), ("largest_rad", "attained_rad", "certified_rad")]
        {
            let drawn = drawn("worst", what).max(drawn("worst_orientation", what));
            assert!(number(&worst[attained]) >= drawn, "{theta}: {worst}");
            assert!(number(&worst[certified]) >= number(&worst[attained]), "{theta}: {worst}");
        }
        assert!(number(&worst["certified_rad"]) <= std::f64::consts::PI, "{theta}: {worst}");
    }
}

#[test]
fn the_plot_is_of_the_slice() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("error.svg");
    let plot = format!("--plot={}", text(&file));
    let answer = congruent(
        &[&["tolerances", "robots/ur5e", &plot, "--samples=1000", "--random=20"][..], &TYPICAL].concat(),
    );
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let svg = fs::read_to_string(&file).unwrap();
    for words in ["distance from the base", "z in m", "rms in mm", "ur5e: error of the tool"] {
        assert!(svg.contains(words), "{words}");
    }
}
