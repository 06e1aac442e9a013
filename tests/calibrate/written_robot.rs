//! `calibrate --out`: the written robot is its own URDF, is the measured arm, and needs no further correction. The measurements are
//! made by `congruent fk` from a robot file with changed values.

use std::{fs, path::Path};

use serde_json::{Value, json};

use crate::support::{
    command::{congruent, congruent_json, text},
    golden::number,
    measurements::measured,
    published_table::{PANDA_JOINTS, UR5E_JOINTS},
    scratch_folder::{ScratchFolder, file_names},
};

/// Rounding of measured values and of an estimate from them. Unit: m and rad. Worst seen 2e-13.
const ROUNDING: f64 = 1e-9;

/// Known errors of a UR5e in a length, a twist and three zeros.
const UR5E_ERRORS: [(&str, &str); 2] = [
    (
        "a_m = -0.425\nalpha_deg = 0.0\nd_m = 0.0\ntheta_deg = 0.0",
        "a_m = -0.4262\nalpha_deg = 0.0\nd_m = 0.0\ntheta_deg = 0.35",
    ),
    ("alpha_deg = 90.0\nd_m = 0.1333\ntheta_deg = 0.0", "alpha_deg = 90.12\nd_m = 0.1333\ntheta_deg = 0.2"),
];

/// A scratch folder with measurements of a robot with errors.
struct Measured {
    scratch: ScratchFolder,
    file: String,
    out: String,
}

impl Measured {
    fn new(rows: &[Value]) -> Self {
        let scratch = ScratchFolder::new();
        let file = scratch.write("poses.json", &Value::from(rows.to_vec()).to_string());
        let out = text(&scratch.path().join("new/calibrated"));
        Self { scratch, file, out }
    }

    fn of(robot: &str, errors: &[(&str, &str)], joints: &[&str]) -> Self {
        let scratch = ScratchFolder::new();
        Self::new(&measured(&scratch.robot(robot, errors), joints, 40, (0.0, 0.0)))
    }

    /// The report of `calibrate --out`.
    #[track_caller]
    fn calibrate(&self, robot: &str, options: &[&str]) -> Value {
        let call = [&["calibrate", robot, &self.file, "--out", &self.out], options].concat();
        let answer = congruent_json(&call);
        assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
        answer.json()
    }

    fn robot_file(&self) -> String {
        format!("{}/robot.toml", self.out)
    }

    /// The written robot is its own URDF and the measured arm; calibrated again with the same options it stays as it is.
    #[track_caller]
    fn is_the_arm(&self, options: &[&str]) {
        let robot = self.robot_file();
        let check = congruent(&["check", &robot]);
        assert_eq!(check.code, 0, "{}{}", check.stdout, check.stderr);
        assert!(check.stdout.lines().next().unwrap().contains("SAME"), "{}", check.stdout);
        let against = ["check", &robot, "--measurements", &self.file, "--tolerance", "1nm,1urad"];
        let measured = congruent(&against);
        assert_eq!(measured.code, 0, "{}{}", measured.stdout, measured.stderr);
        let again = congruent_json(&[&["calibrate", &robot, &self.file], options].concat()).json();
        for each in again["parameters"].as_array().unwrap() {
            assert!(number(&each["correction"]).abs() < ROUNDING, "{each}");
        }
        assert!(number(&again["nominal"]["worst_m"]) < ROUNDING, "{}", again["nominal"]);
    }
}

#[test]
fn a_corrected_table_stays_a_table() {
    const OPTIONS: [&str; 4] = ["--free", "dh", "--hold", "shoulder_lift_joint.beta,elbow_joint.beta"];
    let arm = Measured::of("ur5e", &UR5E_ERRORS, &UR5E_JOINTS);
    let report = arm.calibrate("robots/ur5e", &OPTIONS);
    let written = &report["written"];
    assert_eq!((&written["model"], &written["has_corrected_tcp"]), (&json!("dh"), &json!(false)));
    assert!(number(&written["position_m"]) < 1e-13, "{written}");
    assert_eq!(file_names(Path::new(&arm.out)), ["robot.toml", "ur5e.urdf"]);
    arm.is_the_arm(&OPTIONS);
    let toml = fs::read_to_string(arm.robot_file()).unwrap();
    // That of no bytes: the digest was that of a file of which nothing was read.
    assert!(!toml.contains("e3b0c44298fc1c14"), "{toml}");
    for words in ["40 measurements", "poses.json (SHA-256 ", "held-out", "shoulder_lift_joint.a -1.2000 mm"] {
        assert!(toml.contains(words), "{words} is not in\n{toml}");
    }
    // The shapes, masses and limits of the nominal tree are those of the new one.
    let [nominal, new] = ["robots/ur5e/ur5e.urdf".to_owned(), format!("{}/ur5e.urdf", arm.out)].map(|urdf| {
        let described = congruent_json(&["describe", &urdf]).json();
        let of_joint = |joint: &Value| {
            ["name", "kind", "parent", "child", "lower", "upper", "velocity", "effort"]
                .map(|key| joint[key].clone())
        };
        let joints: Vec<_> = described["joints"].as_array().unwrap().iter().map(of_joint).collect();
        (described["mass_kg"].clone(), described["links"].clone(), joints)
    });
    assert!(number(&nominal.0) > 10.0);
    assert_eq!(nominal, new);
}

#[test]
fn what_no_table_says_is_written_as_screws() {
    let arm = Measured::of("ur5e", &UR5E_ERRORS, &UR5E_JOINTS);
    let report = arm.calibrate("robots/ur5e", &["--free", "dh"]);
    let written = &report["written"];
    assert_eq!(written["model"], "poe");
    assert_eq!(written["beyond_the_table"], json!(["shoulder_lift_joint.beta", "elbow_joint.beta"]));
    arm.is_the_arm(&["--free", "zero-offsets"]);
}

#[test]
fn base_and_tool_are_a_link_and_the_key_tcp() {
    const OPTIONS: [&str; 2] = ["--free", "base,tool"];
    // A tracker 3 m away and turned by a right angle: (x, y, z) is (3 - y, x - 2, z + 1), of a target that is 0.1 m off the flange.
    const FLANGE: [(&str, &str); 1] = [("xyz_m = [0.0, 0.0, 0.107]", "xyz_m = [0.02, 0.0, 0.207]")];
    let scratch = ScratchFolder::new();
    let mut rows = measured(&scratch.robot("panda", &FLANGE), &PANDA_JOINTS, 40, (0.0, 0.0));
    let half = 0.5_f64.sqrt();
    for row in &mut rows {
        let [x, y, z] = [0, 1, 2].map(|at| number(&row["translation_m"][at]));
        row["translation_m"] = json!([3.0 - y, x - 2.0, z + 1.0]);
        let [w, a, b, c] = [0, 1, 2, 3].map(|at| number(&row["quaternion_wxyz"][at]));
        row["quaternion_wxyz"] = json!([half * (w - c), half * (a - b), half * (b + a), half * (c + w)]);
    }
    let arm = Measured::new(&rows);
    let report = arm.calibrate("robots/panda", &OPTIONS);
    let written = &report["written"];
    assert_eq!((&written["model"], &written["base_link"]), (&json!("dh"), &json!("measuring_frame")));
    let base = &report["frames"]["measured_from_base"];
    for (at, expected) in [3.0, -2.0, 1.0].into_iter().enumerate() {
        assert!((number(&base["translation_m"][at]) - expected).abs() < ROUNDING, "{base}");
    }
    arm.is_the_arm(&OPTIONS);
    // For people the two frames are beside the corrections.
    let answer = congruent(&[&["calibrate", "robots/panda", &arm.file], &OPTIONS[..]].concat()).stdout;
    let frames = answer.split("frames with which the corrections of the arm are right").nth(1).unwrap();
    assert!(
        frames.contains(
            "panda_link0 in the frame of the measurements  xyz_mm = [3000.0000, -2000.0000, 1000.0000]"
        ),
        "{answer}"
    );
    assert!(frames.contains("measured frame in panda_link8  xyz_mm = ["), "{answer}");
}

#[test]
fn a_robot_file_is_replaced_only_by_force_and_always_the_same() {
    let arm = Measured::of("ur5e", &UR5E_ERRORS, &UR5E_JOINTS);
    let options = ["--free", "zero-offsets,shoulder_lift_joint.a"];
    let call = [&["calibrate", "robots/ur5e", &arm.file, "--out", &arm.out], &options[..]].concat();
    congruent(&call);
    let files = || ["robot.toml", "ur5e.urdf"].map(|name| fs::read(format!("{}/{name}", arm.out)).unwrap());
    let first = files();
    let again = congruent(&call);
    assert_eq!(again.code, 2, "{}{}", again.stdout, again.stderr);
    assert!(
        again.stderr.contains("robot.toml exists") && again.stderr.contains("--force"),
        "{}",
        again.stderr
    );
    congruent(&[&call[..], &["--force"]].concat());
    assert_eq!(files(), first);
    // The nominal robot is an input, and never replaced.
    let folder = arm.scratch.robot("ur5e", &[]);
    let own = ["calibrate", &folder, &arm.file, "--out", &folder, "--force"];
    let refused = congruent(&own);
    assert_eq!(refused.code, 2, "{}", refused.stderr);
    assert!(refused.stderr.contains("is an input file"), "{}", refused.stderr);
}

#[test]
fn what_is_not_recommended_is_not_written() {
    let mut rows = {
        let scratch = ScratchFolder::new();
        measured(&scratch.robot("ur5e", &[]), &UR5E_JOINTS, 40, (1e-4, 1e-4))
    };
    let arm = Measured::new(&rows);
    let call = |arm: &Measured| {
        congruent(&["calibrate", "robots/ur5e", &arm.file, "--out", &arm.out, "--free", "elbow_joint.d"])
    };
    // Noise alone: the nominal model is no worse.
    let answer = call(&arm);
    assert!(answer.stdout.contains("nothing is written to"), "{}", answer.stdout);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    // Metres as millimetres: not explained.
    for row in &mut rows {
        row["translation_m"] = json!([0, 1, 2].map(|at| number(&row["translation_m"][at]) * 1e3));
    }
    let arm = Measured::new(&rows);
    let answer = call(&arm);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    assert!(!Path::new(&arm.out).exists());
}
