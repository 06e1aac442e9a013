//! `congruent check --configurations`: how far model and URDF are apart at configurations of one's own.

use std::fs;

use serde_json::{Value, json};

use crate::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
};

/// Rounding: three products against a closed form on an arm of 0.9 m; worst seen 2.0e-16 m and
/// 2.9e-16 rad.
const CLOSED_FORM: f64 = 1e-14;

/// Reference case 7: the second joint's zero is off by 1 degree, so the tip turns by that about an
/// axis from which it is `|0.4 + 0.2 exp(i q3)|` m away.
#[test]
fn case_07_both_errors_at_each_of_twenty_configurations() {
    let temporary = tempfile::tempdir().unwrap();
    let [robot, asked] = ["robot.toml", "configurations.json"].map(|name| temporary.path().join(name));
    let folder = workspace().join("robots/spatial_3r");
    let file = fs::read_to_string(folder.join("robot.toml")).unwrap();
    let (before, second_row) = file.split_at(file.find("joint = \"joint_2\"").unwrap());
    let urdf = format!("{:?}", text(&folder.join("spatial_3r.urdf")));
    let before = before.replace("\"spatial_3r.urdf\"", &urdf);
    fs::write(&robot, before + &second_row.replacen("theta_deg = 0.0", "theta_deg = 1.0", 1)).unwrap();
    let q = |at: i32| [1.3, 0.7, 2.9].map(|step| (f64::from(at) * step).sin() * 3.0);
    let configurations: Vec<Value> = (0..20)
        .map(|at| json!({ "q": { "joint_1": q(at)[0], "joint_2": q(at)[1], "joint_3": q(at)[2] } }))
        .collect();
    fs::write(&asked, Value::from(configurations).to_string()).unwrap();

    let answer = congruent_json(&["check", &text(&robot), "--configurations", &text(&asked)]);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    let report = answer.json();
    let differences = report["at_configurations"].as_array().unwrap();
    assert_eq!(differences.len(), 20);
    for (at, difference) in (0..).zip(differences) {
        assert_eq!(difference["q"]["joint_3"].as_f64(), Some(q(at)[2]));
        let away_m = (0.4 + 0.2 * q(at)[2].cos()).hypot(0.2 * q(at)[2].sin());
        let expected_m = 2.0 * 0.5_f64.to_radians().sin() * away_m;
        let [found_m, found_rad] =
            ["position_m", "orientation_rad"].map(|key| difference[key].as_f64().unwrap());
        assert!((found_m - expected_m).abs() < CLOSED_FORM, "{at}: {found_m} for {expected_m} m");
        assert!((found_rad - 1_f64.to_radians()).abs() < CLOSED_FORM, "{at}: {found_rad} rad");
    }
    assert_eq!(report["diagnosis"][0]["joint"], "joint_2");

    let shown = congruent(&["check", &text(&robot), "--configurations", &text(&asked)]).stdout;
    assert_eq!(shown.matches("at configuration ").count(), 20, "{shown}");
}

/// Those that were not asked for are not listed.
#[test]
fn nothing_is_listed_where_nothing_was_asked() {
    let answer = congruent_json(&["check", "robots/spatial_3r"]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    assert!(answer.json().get("at_configurations").is_none());
}
