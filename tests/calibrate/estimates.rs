//! `congruent calibrate`: the reference case, known errors recovered from noisy measurements, corrections that
//! cannot be identified, and refusals. The measurements are made by `congruent fk` from a robot file with
//! changed values, so nothing of the estimator is in them.

use std::{fmt::Write, path::Path};

use serde_json::{Value, json};

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
    golden::number,
    measurements::{CASE_04, measured},
    published_table::{PANDA_JOINTS, UR5E_JOINTS},
    scratch_folder::ScratchFolder,
};

#[track_caller]
fn calibrate(arguments: &[&str]) -> Value {
    let answer = congruent_json(&[&["calibrate"], arguments].concat());
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    answer.json()
}

fn parameter<'a>(report: &'a Value, name: &str) -> &'a Value {
    let all = report["parameters"].as_array().unwrap();
    all.iter().find(|each| each["name"] == name).unwrap_or_else(|| panic!("no {name} in {all:?}"))
}

fn names(list: &Value) -> Vec<&str> {
    list.as_array().unwrap().iter().map(|each| each["name"].as_str().unwrap()).collect()
}

/// Known errors of a UR5e: four zeros, two lengths and a twist.
const UR5E_ERRORS: [(&str, &str); 4] = [
    (
        "a_m = -0.425\nalpha_deg = 0.0\nd_m = 0.0\ntheta_deg = 0.0",
        "a_m = -0.4262\nalpha_deg = 0.0\nd_m = 0.0\ntheta_deg = 0.35",
    ),
    (
        "a_m = -0.3922\nalpha_deg = 0.0\nd_m = 0.0\ntheta_deg = 0.0",
        "a_m = -0.3922\nalpha_deg = 0.0\nd_m = 0.0\ntheta_deg = -0.6",
    ),
    ("alpha_deg = 90.0\nd_m = 0.1333\ntheta_deg = 0.0", "alpha_deg = 90.12\nd_m = 0.1333\ntheta_deg = 0.2"),
    ("d_m = 0.0997\ntheta_deg = 0.0", "d_m = 0.1005\ntheta_deg = -0.15"),
];

/// The corrections to be found for them, rad and m.
fn ur5e_truth() -> [(&'static str, f64); 7] {
    [
        ("shoulder_lift_joint.theta", 0.35_f64.to_radians()),
        ("shoulder_lift_joint.a", -0.0012),
        ("elbow_joint.theta", -0.6_f64.to_radians()),
        ("wrist_1_joint.theta", 0.2_f64.to_radians()),
        ("wrist_1_joint.alpha", 0.12_f64.to_radians()),
        ("wrist_2_joint.theta", -0.15_f64.to_radians()),
        ("wrist_2_joint.d", 0.0008),
    ]
}

#[test]
fn case_04_zero_offset_of_the_planar_arm() {
    /// Golden digits: the case prints 14 and 13 of them.
    const DIGITS_DEG: f64 = 5e-13;
    /// Golden digits.
    const DIGITS_M2: f64 = 1e-14;
    let scratch = ScratchFolder::new();
    let file = scratch.write("points.csv", CASE_04);
    let report = calibrate(&["robots/planar_2r", &file, "--free", "joint_1.zero"]);
    let offset = parameter(&report, "joint_1.zero");
    assert!(
        (number(&offset["correction"]).to_degrees() - 1.019_128_690_972_2).abs() < DIGITS_DEG,
        "{offset}"
    );
    assert!((number(&report["least_squares"]["cost_m2"]) - 0.016_334_185_292_229).abs() < DIGITS_M2);
    assert!((number(&report["nominal"]["cost_m2"]) - 0.017_794_112_276).abs() < 5e-13);
    assert_eq!(report["verdict"], "unexplained_rows");
    let outliers = report["outliers"].as_array().unwrap();
    let rows: Vec<u64> = outliers.iter().map(|each| each["row"].as_u64().unwrap()).collect();
    assert_eq!(rows, [4, 5]);
    for (row, (line, expected_m)) in outliers.iter().zip([(5, 0.065), (6, 0.110)]) {
        assert_eq!(row["line"], line);
        assert!((number(&row["least_squares_m"]) - expected_m).abs() < 5e-4, "{row}");
    }
    // The others agree on another offset, which explains them to some millimetres.
    let robust = number(&offset["robust_correction"]).to_degrees();
    assert!((0.5..0.8).contains(&robust), "{robust}");
    assert!(number(&report["held_out"]["rms_m"]) < 0.006);
    // The largest of its statements comes first, in words.
    let first = report["statements"][0].as_str().unwrap();
    assert!(first.contains("4 (off by 64.7 mm) and 5 (off by 110 mm) are outliers"), "{first}");
    assert!(report["next"].as_array().unwrap().len() == 5);
    let human = congruent(&["calibrate", "robots/planar_2r", &file, "--free", "joint_1.zero"]);
    assert!(human.stdout.contains("+1.0191"), "{}", human.stdout);
    // Suggestions are in the robot's order.
    let next = human.stdout.split("most informative").nth(1).unwrap();
    assert!(next.find("joint_1") < next.find("joint_2"), "{next}");
}

#[test]
fn without_noise_the_table_comes_back_to_rounding() {
    /// Rounding of twelve values within 1 m, times the condition of the problem. Worst seen 3e-13.
    const ROUNDING: f64 = 1e-11;
    let scratch = ScratchFolder::new();
    let robot = scratch.robot("ur5e", &UR5E_ERRORS);
    let rows = measured(&robot, &UR5E_JOINTS, 40, (0.0, 0.0));
    let file = scratch.write("poses.json", &Value::from(rows).to_string());
    let report = calibrate(&["robots/ur5e", &file, "--free", "dh"]);
    assert!(number(&report["least_squares"]["worst_m"]) < ROUNDING, "{}", report["least_squares"]);
    assert!(number(&report["least_squares"]["worst_rad"]) < ROUNDING);
    for (name, truth) in ur5e_truth() {
        assert!((number(&parameter(&report, name)["correction"]) - truth).abs() < ROUNDING, "{name}");
    }
    assert_eq!(report["verdict"], "explained");
    // Along parallel axes only the sum of the shifts has an effect: one is estimated, the others are fixed.
    let fixed = names(&report["fixed"]);
    assert!(fixed.contains(&"elbow_joint.d") && fixed.contains(&"wrist_1_joint.d"), "{fixed:?}");
    let elbow =
        report["fixed"].as_array().unwrap().iter().find(|each| each["name"] == "elbow_joint.d").unwrap();
    assert_eq!(
        elbow["reason"],
        "cannot be distinguished from shoulder_lift_joint.d: only their sum can be identified"
    );
}

#[test]
fn noisy_poses_of_a_ur5e_recover_its_errors_within_their_sigmas() {
    /// Normal noise exceeds this once in 16,000; seven values.
    const SIGMAS: f64 = 4.0;
    let (noise_m, noise_rad) = (1e-4, 2e-4);
    let scratch = ScratchFolder::new();
    let robot = scratch.robot("ur5e", &UR5E_ERRORS);
    let rows = measured(&robot, &UR5E_JOINTS, 40, (noise_m, noise_rad));
    let file = scratch.write("poses.json", &Value::from(rows).to_string());
    let report = calibrate(&["robots/ur5e", &file, "--free", "dh"]);
    for (name, truth) in ur5e_truth() {
        let found = parameter(&report, name);
        let sigma = number(&found["standard_deviation"]);
        let error = (number(&found["correction"]) - truth).abs();
        assert!(error < SIGMAS * sigma, "{name}: {error:e} of {sigma:e}");
        assert!(found["significant"].as_bool().unwrap(), "{name}");
    }
    // 240 components less 24 corrections know the noise to 5 %.
    for (key, truth) in [("noise_m", noise_m), ("noise_rad", noise_rad)] {
        let ratio = number(&report["least_squares"][key]) / truth;
        assert!((0.85..1.15).contains(&ratio), "{key}: {ratio}");
    }
    assert!(report["outliers"].as_array().unwrap().is_empty(), "{}", report["outliers"]);
    assert_eq!(report["verdict"], "explained");
}

#[test]
fn planted_outliers_are_named_and_do_not_bend_the_robust_estimate() {
    const PLANTED: [usize; 6] = [3, 8, 11, 20, 27, 33];
    let scratch = ScratchFolder::new();
    let robot = scratch.robot("ur5e", &UR5E_ERRORS);
    let mut rows = measured(&robot, &UR5E_JOINTS, 40, (1e-4, 2e-4));
    for (turn, &row) in PLANTED.iter().enumerate() {
        let coordinate = &mut rows[row - 1]["translation_m"][turn % 3];
        *coordinate = json!(number(coordinate) + if turn % 2 == 0 { 0.02 } else { -0.004 });
    }
    let file = scratch.write("poses.json", &Value::from(rows).to_string());
    let report = calibrate(&[
        "robots/ur5e",
        &file,
        "--free",
        "zero-offsets,shoulder_lift_joint.a,wrist_1_joint.alpha,wrist_2_joint.d",
    ]);
    let found: Vec<usize> = report["outliers"]
        .as_array()
        .unwrap()
        .iter()
        .map(|each| usize::try_from(each["row"].as_u64().unwrap()).unwrap())
        .collect();
    assert_eq!(found, PLANTED);
    assert_eq!(report["recommended"], "robust");
    for (name, truth) in ur5e_truth() {
        let found = parameter(&report, &name.replace("theta", "zero"));
        let error = (number(&found["robust_correction"]) - truth).abs();
        assert!(error < 5.0 * number(&found["robust_standard_deviation"]), "{name}: {error:e}");
    }
}

#[test]
fn panda_zeros_from_points_alone() {
    let scratch = ScratchFolder::new();
    let robot = scratch.robot(
        "panda",
        &[(
            "alpha_deg = 90.0\nd_m = 0.316\ntheta_deg = 0.0",
            "alpha_deg = 90.0\nd_m = 0.316\ntheta_deg = 0.4",
        )],
    );
    let mut csv = PANDA_JOINTS.iter().fold(String::new(), |header, joint| header + joint + "_rad,")
        + "x_mm,y_mm,z_mm\n";
    for row in measured(&robot, &PANDA_JOINTS, 30, (5e-5, 0.0)) {
        for joint in PANDA_JOINTS {
            let _ = write!(csv, "{},", row["q"][joint]);
        }
        let mm: Vec<String> =
            (0..3).map(|at| (number(&row["translation_m"][at]) * 1e3).to_string()).collect();
        csv += &(mm.join(",") + "\n");
    }
    let file = scratch.write("points.csv", &csv);
    let report = calibrate(&["robots/panda", &file, "--free", "zero-offsets,base,tool"]);
    let zero = parameter(&report, "panda_joint3.zero");
    let error = (number(&zero["correction"]) - 0.4_f64.to_radians()).abs();
    assert!(error < 4.0 * number(&zero["standard_deviation"]), "{zero}");
    // The base's yaw is the first joint's zero, and points do not depend on the tool's orientation.
    let fixed = report["fixed"].as_array().unwrap();
    let reason = |name: &str| {
        fixed.iter().find(|each| each["name"] == name).map(|each| each["reason"].as_str().unwrap())
    };
    assert_eq!(
        reason("base.yaw"),
        Some("cannot be distinguished from panda_joint1.zero: only their sum can be identified")
    );
    for name in ["tool.roll", "tool.pitch", "tool.yaw"] {
        assert_eq!(reason(name), Some("has no effect on these measurements"), "{fixed:?}");
    }
}

#[test]
fn a_bare_urdf_is_calibrated_by_its_axes() {
    let scratch = ScratchFolder::new();
    let robot = scratch.robot(
        "ur5e",
        &[
            ("d_m = 0.0997\ntheta_deg = 0.0", "d_m = 0.0997\ntheta_deg = 0.5"),
            ("xyz_m = [0.0, 0.0, 0.05]", "xyz_m = [0.0, 0.0, 0.0]"),
        ],
    );
    let rows = measured(&robot, &UR5E_JOINTS, 30, (1e-5, 1e-5));
    let file = scratch.write("poses.json", &Value::from(rows).to_string());
    let urdf = text(&Path::new(&workspace()).join("robots/ur5e/ur5e.urdf"));
    let report = calibrate(&[&urdf, &file, "--free", "zero-offsets,axes"]);
    assert_eq!(report["model"], "urdf");
    assert!(number(&report["held_out"]["rms_m"]) < 1e-4, "{}", report["held_out"]);
    let zero = parameter(&report, "wrist_2_joint.zero");
    assert!((number(&zero["correction"]).to_degrees() - 0.5).abs() < 0.02, "{zero}");
}
