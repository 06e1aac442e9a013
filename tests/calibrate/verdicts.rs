//! `congruent calibrate`: measurements that the corrections do not explain, or that cannot verify them. The
//! errors of units, order and frame are made in measurements that are right without them.

use serde_json::{Value, json};

use crate::support::{
    command::{Answer, congruent, congruent_json},
    golden::number,
    measurements::measured,
    published_table::UR5E_JOINTS,
    scratch_folder::ScratchFolder,
};

/// Noise of a good measurement of an arm of 1 m.
const NOISE: (f64, f64) = (1e-4, 2e-4);

/// The answer for rows on the UR5e with these corrections free.
#[track_caller]
fn judged(rows: &[Value], free: &str) -> Answer {
    let scratch = ScratchFolder::new();
    let file = scratch.write("poses.json", &Value::from(rows.to_vec()).to_string());
    congruent_json(&["calibrate", "robots/ur5e", &file, "--free", free])
}

/// Poses of a UR5e with two zeros known to be off.
fn poses(rows: usize) -> Vec<Value> {
    let zeros = [
        ("d_m = 0.1333\ntheta_deg = 0.0", "d_m = 0.1333\ntheta_deg = 0.2"),
        ("d_m = 0.0997\ntheta_deg = 0.0", "d_m = 0.0997\ntheta_deg = -0.15"),
    ];
    let scratch = ScratchFolder::new();
    measured(&scratch.robot("ur5e", &zeros), &UR5E_JOINTS, rows, NOISE)
}

fn values<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|at| number(&value[at]))
}

/// After an error the command says that nothing is explained, names the error, and the residual without it.
#[track_caller]
fn named(error: impl Fn(&mut Value), words: &str) {
    let mut rows = poses(40);
    rows.iter_mut().for_each(error);
    let answer = judged(&rows, "zero-offsets");
    let report = answer.json();
    let statements = format!("{words}: {}", report["statements"]);
    assert_eq!((answer.code, &report["verdict"]), (1, &json!("unexplained")), "{statements}");
    assert_eq!(report["recommended"], "nominal");
    let reason = &report["likely_reason"];
    assert!(
        reason["condition"].as_str().is_some_and(|condition| condition.contains(words)),
        "{words}: {reason}"
    );
    assert!(number(&reason["rms_m"]) < 3.0 * NOISE.0, "{reason}");
    let first = report["statements"][0].as_str().unwrap();
    assert!(first.contains("do NOT explain") && first.contains(words), "{first}");
}

#[test]
fn errors_of_units_are_named() {
    let under = |from: &'static str, to: &'static str| {
        move |row: &mut Value| {
            let moved = row.as_object_mut().unwrap().remove(from).unwrap();
            row[to] = moved;
        }
    };
    named(under("translation_m", "translation_mm"), "positions given as mm are in metres");
    let thousandfold = |row: &mut Value| {
        row["translation_m"] = json!(values::<3>(&row["translation_m"]).map(|value| value * 1e3));
    };
    named(thousandfold, "positions given as m are in millimetres");
    let degrees = |row: &mut Value| {
        for joint in UR5E_JOINTS {
            row["q"][joint] = json!(number(&row["q"][joint]).to_degrees());
        }
    };
    named(degrees, "joint angles given as rad are in degrees");
}

#[test]
fn lengths_a_thousand_times_as_short_do_not_explain_an_error_of_units() {
    let mut rows = poses(40);
    for row in &mut rows {
        let metres = row.as_object_mut().unwrap().remove("translation_m").unwrap();
        row["translation_mm"] = metres;
    }
    let answer = judged(&rows, "dh");
    let report = answer.json();
    let first = report["statements"][0].as_str().unwrap();
    assert_eq!((answer.code, &report["verdict"]), (1, &json!("misinterpreted")), "{first}");
    assert!(first.contains("given as mm are in metres") && report["recommended"] == "nominal", "{first}");
}

#[test]
fn errors_of_order_sign_and_frame_are_named() {
    let scalar_last = |row: &mut Value| {
        let [w, x, y, z] = values(&row["quaternion_wxyz"]);
        row["quaternion_wxyz"] = json!([x, y, z, w]);
    };
    named(scalar_last, "qw, qx, qy, qz hold x, y, z, w");
    let scalar_first = |row: &mut Value| {
        let [w, x, y, z] = values(&row["quaternion_wxyz"]);
        row["quaternion_wxyz"] = json!([z, w, x, y]);
    };
    named(scalar_first, "qx, qy, qz, qw hold w, x, y, z");
    let conjugate = |row: &mut Value| {
        let [w, x, y, z] = values(&row["quaternion_wxyz"]);
        row["quaternion_wxyz"] = json!([w, -x, -y, -z]);
    };
    named(conjugate, "orientations are those of the base in the tip");
    let inverse = |row: &mut Value| {
        let [w, x, y, z] = values(&row["quaternion_wxyz"]);
        let t = values(&row["translation_m"]);
        row["translation_m"] = json!(turned([w, -x, -y, -z], t).map(|value| -value));
        row["quaternion_wxyz"] = json!([w, -x, -y, -z]);
    };
    named(inverse, "poses are those of the base in the tip");
    let other_way = |row: &mut Value| {
        row["q"]["elbow_joint"] = json!(-number(&row["q"]["elbow_joint"]));
    };
    named(other_way, "elbow_joint is positive in the opposite direction");
    let shifted_base = |row: &mut Value| {
        let [x, y, z] = values(&row["translation_m"]);
        row["translation_m"] = json!([x + 0.2, y - 0.1, z + 0.4]);
    };
    named(shifted_base, "--free zero-offsets,base)");
    // A tracker whose frame is rotated by 0.3 rad about z, as the first joint's zero could be.
    let turned_base = |row: &mut Value| {
        let by = [0.15_f64.cos(), 0.0, 0.0, 0.15_f64.sin()];
        let [w, x, y, z] = values(&row["quaternion_wxyz"]);
        let [c, .., s] = by;
        row["quaternion_wxyz"] = json!([c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w]);
        let [x, y, z] = turned(by, values(&row["translation_m"]));
        row["translation_m"] = json!([x + 0.3, y + 0.1, z]);
    };
    named(turned_base, "--free zero-offsets,base)");
}

/// `v` turned by a quaternion, w first, of unit length up to its noise.
fn turned([w, x, y, z]: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let cross = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let (axis, norm_squared) = ([x, y, z], w * w + x * x + y * y + z * z);
    let once = cross(axis, v);
    let twice = cross(axis, once);
    std::array::from_fn(|at| v[at] + 2.0 * (w * once[at] + twice[at]) / norm_squared)
}

#[test]
fn what_no_common_error_explains_stays_unexplained() {
    let mut rows = poses(40);
    let shifted: Vec<Value> =
        (0..rows.len()).map(|at| rows[(at + 7) % 40]["translation_m"].clone()).collect();
    rows.iter_mut().zip(shifted).for_each(|(row, other)| row["translation_m"] = other);
    // An arm that may shrink to nothing would fit any positions in millimetres.
    for free in ["zero-offsets", "dh", "all"] {
        let answer = judged(&rows, free);
        let report = answer.json();
        let first = report["statements"][0].as_str().unwrap();
        assert_eq!((answer.code, &report["verdict"]), (1, &json!("unexplained")), "{first}");
        assert!(report["likely_reason"].is_null() && first.contains("none of the errors"), "{first}");
    }
}

#[test]
fn as_many_corrections_as_measurements_cannot_be_verified() {
    let mut rows = poses(2);
    for row in &mut rows {
        row.as_object_mut().unwrap().remove("quaternion_wxyz");
    }
    // A point gives three components, however often it is measured.
    let mut repeated = vec![rows[0].clone(); 20];
    for (at, row) in repeated.iter_mut().enumerate() {
        row["q"]["elbow_joint"] = json!(number(&row["q"]["elbow_joint"]) + [0.0, 1e-5, -2e-5][at % 3]);
    }
    for rows in [&rows[..1], &repeated[..]] {
        let answer = judged(rows, "zero-offsets");
        let report = answer.json();
        assert_eq!((answer.code, &report["verdict"]), (4, &json!("unverifiable")), "{report}");
        assert_eq!((&report["redundancy"], &report["recommended"]), (&json!(0), &json!("nominal")));
        assert!(report["held_out"].is_null() && report["least_squares"]["noise_m"].is_null());
        let parameters = report["parameters"].as_array().unwrap();
        assert!(!parameters.is_empty());
        for each in parameters {
            assert!(each["standard_deviation"].is_null() && each["significant"] == false, "{each}");
        }
    }
    // A pose at one configuration has redundancy, but cannot verify other configurations.
    let pose = poses(1);
    let report = judged(&pose, "elbow_joint.zero").json();
    assert_eq!((&report["verdict"], &report["redundancy"]), (&json!("unverifiable"), &json!(4)));
    assert!(report["statements"][0].as_str().unwrap().contains("one configuration"), "{report}");
}

#[test]
fn repetitions_are_left_out_together() {
    let rows = poses(5);
    let repeated: Vec<Value> = (0..30).map(|at| rows[at % 5].clone()).collect();
    assert_eq!(judged(&repeated, "zero-offsets").json()["held_out"]["folds"], 5);
}

#[test]
fn one_absurd_coordinate_is_an_outlier() {
    let mut rows = poses(40);
    rows[5]["translation_m"][1] = json!(1e5);
    let answer = judged(&rows, "dh");
    let report = answer.json();
    assert_eq!((answer.code, &report["verdict"]), (0, &json!("unexplained_rows")), "{report}");
    let outliers = report["outliers"].as_array().unwrap();
    assert!(outliers.len() == 1 && outliers[0]["row"] == 6, "{outliers:?}");
    assert!(number(&report["held_out"]["rms_m"]) < 5.0 * NOISE.0, "{}", report["held_out"]);
}

#[test]
fn a_stated_noise_that_is_exceeded_is_a_failed_check() {
    let scratch = ScratchFolder::new();
    let file = scratch.write("poses.json", &Value::from(poses(40)).to_string());
    let run = |millimetres: &str| {
        let noise = ["--noise", &format!("{millimetres}mm,0.0115deg")];
        congruent(&[&["calibrate", "robots/ur5e", &file, "--free", "dh"], &noise[..]].concat())
    };
    assert_eq!(run("0.1").code, 0);
    let exceeded = run("0.01");
    assert!(exceeded.code == 1 && exceeded.stdout.contains("stated noise"), "{}", exceeded.stdout);
}

/// A gross error in one coordinate never turns into whole turns or metres of a correction, and is named.
#[test]
fn a_gross_error_gives_no_gross_corrections() {
    let scratch = ScratchFolder::new();
    let perfect = measured(&scratch.robot("ur5e", &[]), &UR5E_JOINTS, 40, (0.0, 0.0));
    for row in [0, 3, 8, 17, 25, 39] {
        let mut rows = perfect.clone();
        let coordinate = number(&rows[row]["translation_m"][row % 3]);
        rows[row]["translation_m"][row % 3] = json!(1e3 * coordinate);
        for free in ["zero-offsets", "dh"] {
            let report = judged(&rows, free).json();
            assert!(report["outliers"].as_array().unwrap().iter().any(|of| of["row"] == row + 1), "{report}");
            assert_eq!(report["recommended"], "robust", "{free}, row {row}: {}", report["statements"]);
            for parameter in report["parameters"].as_array().unwrap() {
                assert!(
                    number(&parameter["robust_correction"]).abs() < 1e-9,
                    "{free}, row {row}: {parameter}"
                );
                assert!(number(&parameter["correction"]).abs() <= 1e3, "{parameter}");
            }
        }
    }
}

/// The suggestions are chosen from a stated number of configurations.
#[test]
fn more_suggestions_than_candidates_are_refused() {
    let scratch = ScratchFolder::new();
    let file = scratch.write("poses.json", &Value::from(poses(5)).to_string());
    for count in ["18446744073709551615", "100000000000", "401"] {
        let answer = congruent(&["calibrate", "robots/ur5e", &file, "--next", count]);
        assert!(
            answer.code == 2 && answer.stderr.contains("at most 400: they are chosen from that many"),
            "{count}: {}",
            answer.stderr
        );
    }
}
