//! `congruent check --configurations`: how far model and URDF are apart at configurations of one's own.

use std::fs;

use serde_json::{Value, json};

use crate::support::{
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

/// The planar arm at two configurations, by closed form: 0.6 m and 0.4 m at `q1` and `q1 + q2`. Its table has the first
/// length 10 mm too long.
#[test]
fn positions_by_both_models_are_a_table_and_a_chart() {
    let temporary = tempfile::tempdir().unwrap();
    let [robot, asked, plot] =
        ["robot.toml", "configurations.json", "plot.svg"].map(|name| temporary.path().join(name));
    let folder = workspace().join("robots/planar_2r");
    let file = fs::read_to_string(folder.join("robot.toml")).unwrap();
    let urdf = format!("{:?}", text(&folder.join("planar_2r.urdf")));
    let changed = file.replace("\"planar_2r.urdf\"", &urdf).replacen("a_m = 0.6", "a_m = 0.61", 1);
    assert_ne!(changed, file.replace("\"planar_2r.urdf\"", &urdf));
    fs::write(&robot, changed).unwrap();
    let at = [[0.3, -0.4], [1.1, 0.7]];
    let asked_for = at.map(|[first, second]| json!({ "q": { "joint_1": first, "joint_2": second } }));
    fs::write(&asked, Value::from(asked_for.to_vec()).to_string()).unwrap();
    let arguments =
        ["check", &text(&robot), "--configurations", &text(&asked), "--table", "--plot", &text(&plot)];

    let report = congruent_json(&arguments).json();
    for (difference, [first, second]) in report["at_configurations"].as_array().unwrap().iter().zip(at) {
        let tip = &difference["tip"][0];
        assert_eq!(tip["pair"], "model_urdf");
        for (key, length) in [("first", 0.61), ("second", 0.6)] {
            let x = length * f64::cos(first) + 0.4 * f64::cos(first + second);
            let found = tip[key]["translation_m"][0].as_f64().unwrap();
            assert!((found - x).abs() < CLOSED_FORM, "{key}: {found} for {x} m");
        }
        assert!((tip["position_m"].as_f64().unwrap() - 0.01).abs() < CLOSED_FORM);
        assert_eq!(difference["tip"][1]["pair"], "urdf_simulation");
    }
    let shown = congruent(&arguments).stdout;
    let table: Vec<&str> =
        shown.lines().skip_while(|line| !line.contains("by DH table, by URDF chain")).collect();
    assert!(table.len() > 3, "{shown}");
    let second_row: Vec<&str> = table[3].split_whitespace().collect();
    let x = |length: f64| format!("{:.2}", 1e3 * (length * f64::cos(1.1) + 0.4 * f64::cos(1.8)));
    assert_eq!((second_row[0], second_row[1], second_row[4]), ("2", x(0.61).as_str(), x(0.6).as_str()));
    assert!(table[3].contains("10 mm"), "{}", table[3]);
    assert!(!shown.contains("at configuration "), "{shown}");

    let svg = fs::read_to_string(&plot).unwrap();
    let chart = roxmltree::Document::parse(&svg).unwrap();
    // A point for each configuration and quantity.
    assert_eq!(chart.descendants().filter(|node| node.has_tag_name("circle")).count(), 4);
    for words in ["position in mm", "orientation in deg", "tolerance"] {
        assert!(svg.contains(words), "no {words:?}");
    }
}

#[test]
fn a_table_or_chart_of_nothing_is_refused() {
    let refused = |arguments: &[&str], words: &str| {
        let answer = congruent(&[&["check", "robots/planar_2r"], arguments].concat());
        assert_eq!(answer.code, 2, "{}", answer.stdout);
        assert!(answer.stderr.contains(words), "no {words:?} in {}", answer.stderr);
    };
    refused(&["--table"], "--configurations");
    refused(&["--plot", "p.svg"], "--plot needs --configurations");
    let temporary = tempfile::tempdir().unwrap();
    let asked = temporary.path().join("configurations.json");
    fs::write(&asked, "[{\"q\": {}}]").unwrap();
    refused(&["--configurations", &text(&asked), "--plot", &text(&asked)], "is an input file");
    refused(
        &["robots/ur5e", "--configurations", &text(&asked), "--plot", "p.svg"],
        "--plot works for one robot",
    );
    assert_eq!(fs::read_to_string(&asked).unwrap(), "[{\"q\": {}}]");
}

/// At many turns identified screws differ by rounding, which has no cause; positions that do not resolve the tolerance
/// are refused.
#[test]
fn large_angles_have_no_cause_or_are_refused() {
    let temporary = tempfile::tempdir().unwrap();
    let asked = temporary.path().join("configurations.json");
    let check = |position: f64| {
        fs::write(&asked, json!([{ "q": { "elbow_joint": position } }]).to_string()).unwrap();
        congruent_json(&["check", "robots/ur5e", "--configurations", &text(&asked)])
    };
    let many_turns = check(1000.0);
    assert_eq!(many_turns.code, 0, "{}", many_turns.stderr);
    let report = many_turns.json();
    assert_eq!((&report["verdict"], &report["diagnosis"]), (&json!("agree"), &json!([])));
    let unresolved = check(1e15);
    assert_eq!(unresolved.code, 2, "{}", unresolved.stdout);
    let said = unresolved.stdout + &unresolved.stderr;
    assert!(said.contains("elbow_joint") && said.contains("7.16 deg apart"), "{said}");
}

/// The heading of the table says what the files are.
#[test]
fn an_mjcf_is_called_an_mjcf() {
    let temporary = tempfile::tempdir().unwrap();
    let [mjcf, asked, plot] =
        ["arm.xml", "at.jsonl", "plot.svg"].map(|name| text(&temporary.path().join(name)));
    assert_eq!(congruent(&["convert", "robots/planar_2r", "--out", &mjcf]).code, 0);
    fs::write(&asked, "{\"q\": {\"joint_1\": 0.5}}\n").unwrap();
    let urdf = "robots/planar_2r/planar_2r.urdf";
    let at = ["--configurations", &asked, "--table", "--plot", &plot];
    let answer = congruent(&[&["check", &mjcf, "--against", urdf], &at[..]].concat());
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    assert!(answer.stdout.contains(" in mm by MJCF chain, by URDF chain, error\n"), "{}", answer.stdout);
    assert!(answer.stdout.contains("\n  the physics is that of the MJCF in poses"), "{}", answer.stdout);
    assert!(fs::read_to_string(&plot).unwrap().contains("MJCF chain against URDF chain"));
}
