//! `congruent check` on chains that arms rarely have: a joint that mimics another in the middle, a
//! sliding joint, one without limits; faults of the URDF; wrong units of whole columns.

use std::{f64::consts::FRAC_PI_2, fmt::Write, fs};

use serde_json::{Value, json};

use crate::support::command::{Answer, congruent_json, text};

/// A fitted figure: rounding of the fit; worst seen 2e-15.
const FITTED: f64 = 1e-12;
/// The certified bound of models that agree: rounding of identification and proof within a few
/// metres, in m or rad; worst seen 1.8e-13.
const ROUNDING: f64 = 1e-12;

/// A row of a modified table: joint, kind, `a`, `alpha` in degrees, `d`, and what limits or ties it.
type Row = (&'static str, &'static str, f64, f64, f64, &'static str);

const LIMIT: &str = "<limit lower='-2' upper='2.5' effort='10' velocity='1'/>";

const ROWS: [Row; 5] = [
    ("shoulder", "revolute", 0.0, 0.0, 0.3, ""),
    ("elbow", "revolute", 0.05, -90.0, 0.0, ""),
    ("follower", "revolute", 0.4, 0.0, 0.02, "<mimic joint='elbow' multiplier='-0.5' offset='0.2'/>"),
    ("slide", "prismatic", 0.0, -90.0, 0.1, ""),
    ("wrist", "continuous", 0.07, 90.0, 0.05, ""),
];

/// The linkage as a URDF; each of its lines holds one element that can be at fault.
fn urdf() -> String {
    let link = |name: &str| {
        format!(
            "<link name='{name}'><inertial><mass value='1'/>\
             <inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'/></inertial></link>\n"
        )
    };
    let mut text = format!("<robot name='linkage'>\n{}", link("base"));
    let mut parent = "base";
    for (name, kind, a_m, alpha_deg, d_m, tie) in ROWS {
        let (sin, cos) = if alpha_deg == 0.0 { (0.0, 1.0) } else { (alpha_deg.signum(), 0.0) };
        let limit = if kind == "continuous" { "" } else { LIMIT };
        let _ = write!(
            text,
            "{}<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='after_{name}'/>\n\
             <origin xyz='{a_m} {} {}' rpy='{} 0 0'/>\n<axis xyz='0 0 1'/>{limit}{tie}</joint>\n",
            link(&format!("after_{name}")),
            -sin * d_m,
            cos * d_m,
            sin * FRAC_PI_2,
        );
        parent = match name {
            "shoulder" => "after_shoulder",
            "elbow" => "after_elbow",
            "follower" => "after_follower",
            "slide" => "after_slide",
            _ => "after_wrist",
        };
    }
    let _ = write!(
        text,
        "{}<joint name='mount' type='fixed'><parent link='{parent}'/><child link='tip'/>\n\
         <origin xyz='0 0 0.08' rpy='0 0 0.3'/></joint>\n</robot>\n",
        link("tip")
    );
    text
}

fn table() -> String {
    let mut text = "name = \"linkage\"\nurdf = \"linkage.urdf\"\nbase = \"base\"\ntip = \"tip\"\n\
                    [dh]\nconvention = \"modified\"\nbase_from_dh0 = {}\n\
                    dhn_from_tip = { xyz_m = [0, 0, 0.08], rpy_rad = [0, 0, 0.3] }\n"
        .to_owned();
    for (name, kind, a_m, alpha_deg, d_m, _) in ROWS {
        let kind = if kind == "prismatic" { kind } else { "revolute" };
        let _ = write!(
            text,
            "[[dh.row]]\njoint = \"{name}\"\nkind = \"{kind}\"\na_m = {a_m:?}\nalpha_deg = {alpha_deg:?}\n\
             d_m = {d_m:?}\ntheta_deg = 0.0\nsign = 1\n"
        );
    }
    text
}

/// The file with `from` replaced by `to` behind `mark`.
#[track_caller]
fn changed(file: &str, (mark, from, to): (&str, &str, &str)) -> String {
    let start = file.find(mark).unwrap();
    let at = start + file[start..].find(from).unwrap_or_else(|| panic!("no {from} behind {mark}"));
    format!("{}{to}{}", &file[..at], &file[at + from.len()..])
}

/// The table's lines that begin with `key`, each figure times a factor.
fn scaled(file: &str, key: &str, factor: f64) -> String {
    let line = |line: &str| match line.strip_prefix(key).and_then(|rest| rest.strip_prefix(" = ")) {
        Some(figure) => format!("{key} = {:?}\n", figure.parse::<f64>().unwrap() * factor),
        None => format!("{line}\n"),
    };
    file.lines().map(line).collect()
}

fn check(table: &str, urdf: &str) -> Answer {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.toml");
    fs::write(&path, table).unwrap();
    fs::write(folder.path().join("linkage.urdf"), urdf).unwrap();
    congruent_json(&["check", &text(&path)])
}

/// The first cause, whose residual is rounding.
#[track_caller]
fn first(answer: &Answer) -> Value {
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    let cause = answer.json()["diagnosis"][0].clone();
    near(&cause["residual_m"], 0.0);
    near(&cause["residual_rad"], 0.0);
    cause
}

#[track_caller]
fn near(found: &Value, expected: f64) {
    let number = found.as_f64().unwrap_or_else(|| panic!("no number: {found}"));
    assert!((number - expected).abs() < FITTED, "{number} not {expected}");
}

/// The line at fault, in the file of that name.
#[track_caller]
fn is_at_line(cause: &Value, name: &str, file: &str, line: &str) {
    assert!(cause["file"].as_str().expect("a file").ends_with(name), "{cause}");
    let number = usize::try_from(cause["line"].as_u64().expect("a line")).unwrap();
    assert_eq!(file.lines().nth(number - 1), Some(line));
}

#[test]
fn a_chain_with_a_mimic_a_sliding_and_an_endless_joint_agrees() {
    let answer = check(&table(), &urdf());
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let report = answer.json();
    assert_eq!(report["verdict"], "agree");
    let certificates = report["certificates"].as_array().unwrap();
    let names: Vec<&Value> = certificates.iter().map(|certificate| &certificate["name"]).collect();
    assert_eq!(names, ["model_urdf", "model_simulation"]);
    for certificate in certificates {
        assert!(certificate["position_m"]["certified"].as_f64().unwrap() < ROUNDING, "{certificate}");
        assert!(certificate["orientation_rad"]["certified"].as_f64().unwrap() < ROUNDING, "{certificate}");
    }
    let premise = &certificates[1]["premise"];
    assert_eq!(premise["holds"], true);
    // It is looked at before the certificates, which then add two configurations each.
    let [at_premise, at_all] =
        [premise, &report].map(|part| part["configurations"].as_u64().expect("a number"));
    let certificates = report["certificates"].as_array().unwrap().len() as u64;
    assert_eq!(at_premise + 2 * certificates, at_all);
    assert!(premise["residual_m"].as_f64().unwrap() < ROUNDING, "{premise}");
    assert!(report["certificate"]["position_m"].as_f64().unwrap() < ROUNDING);
}

#[test]
fn a_figure_of_a_mimic_joint_is_named() {
    let file = changed(&table(), ("\"follower\"", "a_m = 0.4", "a_m = 0.41"));
    let answer = check(&file, &urdf());
    let cause = first(&answer);
    assert_eq!([&cause["cause"], &cause["joint"], &cause["parameter"]], ["parameter", "follower", "a"]);
    near(&cause["found"], 0.41);
    near(&cause["expected"], 0.4);
    is_at_line(&cause, "robot.toml", &file, "a_m = 0.41");
    // The physics, which knows no table, reports the same.
    let report = answer.json();
    assert_eq!(report["diagnoses"][1]["causes"][0]["joint"], "follower");
    near(&report["certificates"][1]["position_m"]["attained"], 0.01);
}

#[test]
fn a_row_that_is_missing_shows_in_the_invariants() {
    let file = table();
    let (start, end) =
        (file.find("[[dh.row]]\njoint = \"follower\""), file.find("[[dh.row]]\njoint = \"slide\""));
    let without = format!("{}{}", &file[..start.unwrap()], &file[end.unwrap()..]);
    let answer = check(&without, &urdf());
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    let report = answer.json();
    assert_eq!(report["diagnosis"][0]["cause"], "unexplained");
    let first = &report["diagnoses"][0]["invariants"][0];
    assert_eq!(*first, json!({ "invariant": "kind", "joint": "follower", "found": null, "expected": 0.0 }));
}

#[test]
fn faults_of_sliding_and_endless_joints_are_named() {
    let cases = [
        (("\"slide\"", "sign = 1", "sign = -1"), ["axis_flipped", "slide"]),
        (("\"slide\"", "d_m = 0.1", "d_m = 0.13"), ["zero_offset", "slide"]),
        (("\"wrist\"", "theta_deg = 0.0", "theta_deg = 3.0"), ["zero_offset", "wrist"]),
        (("\"wrist\"", "sign = 1", "sign = -1"), ["axis_flipped", "wrist"]),
    ];
    for (change, expected) in cases {
        let cause = first(&check(&changed(&table(), change), &urdf()));
        assert_eq!([&cause["cause"], &cause["joint"]], expected);
    }
}

#[test]
fn a_fixed_joint_that_is_left_out_has_a_line_in_the_urdf() {
    let file = changed(&table(), ("[dh]", "{ xyz_m = [0, 0, 0.08], rpy_rad = [0, 0, 0.3] }", "{}"));
    let cause = first(&check(&file, &urdf()));
    assert_eq!([&cause["cause"], &cause["joint"]], ["fixed_joint_dropped", "mount"]);
    is_at_line(&cause, "linkage.urdf", &urdf(), "<origin xyz='0 0 0.08' rpy='0 0 0.3'/></joint>");
}

#[test]
fn an_rpy_in_another_order_has_a_line_in_the_urdf() {
    // Rx(0.5) Rz(0.7), as a modified row has it; a URDF reads the same figures as Rz(0.7) Rx(0.5).
    let file = changed(&table(), ("\"follower\"", "alpha_deg = 0.0", "alpha_rad = 0.5"));
    let file = changed(&file, ("\"follower\"", "theta_deg = 0.0", "theta_rad = 0.7"));
    let file = changed(&file, ("\"follower\"", "d_m = 0.02", "d_m = 0.0"));
    let urdf = changed(&urdf(), ("name='follower'", "0.4 -0 0.02' rpy='0 0 0'", "0.4 0 0' rpy='0.5 0 0.7'"));
    let cause = first(&check(&file, &urdf));
    assert_eq!([&cause["cause"], &cause["joint"]], ["rpy_order", "follower"]);
    is_at_line(&cause, "linkage.urdf", &urdf, "<origin xyz='0.4 0 0' rpy='0.5 0 0.7'/>");
}

#[test]
fn a_column_in_another_unit_is_named_with_figures_and_line() {
    let cause = first(&check(&scaled(&table(), "d_m", 1e3), &urdf()));
    assert_eq!([&cause["cause"], &cause["parameter"]], ["millimetres_as_metres", "d"]);
    assert_eq!(cause["found"], "d = [300, 0, 20, 100, 50]");
    assert_eq!(cause["expected"], "d = [0.3, 0, 0.02, 0.1, 0.05]");
    near(&cause["value"], 1e3);
    assert_eq!(cause["suggestion"], "d_m = 0.3\nd_m = 0.02\nd_m = 0.1\nd_m = 0.05");
    is_at_line(&cause, "robot.toml", &scaled(&table(), "d_m", 1e3), "d_m = 300.0");

    let metres = table().replace("d_m = ", "d_mm = ").replace("a_m = ", "a_mm = ");
    let cause = first(&check(&metres, &urdf()));
    assert_eq!([&cause["cause"], &cause["parameter"]], ["millimetres_as_metres", "a, d"]);
    near(&cause["value"], 1e-3);
    let lines = "d_mm = 300\na_mm = 50\na_mm = 400\nd_mm = 20\nd_mm = 100\na_mm = 70\nd_mm = 50";
    assert_eq!(cause["suggestion"], lines);

    let degrees = table().replace("alpha_deg = ", "alpha_rad = ");
    let cause = first(&check(&degrees, &urdf()));
    assert_eq!([&cause["cause"], &cause["parameter"]], ["degrees_as_radians", "alpha"]);
    near(&cause["value"], 180.0 / std::f64::consts::PI);
    let quarter = "1.5707963268";
    let lines = format!("alpha_rad = -{quarter}\nalpha_rad = -{quarter}\nalpha_rad = {quarter}");
    assert_eq!(cause["suggestion"], lines);
    is_at_line(&cause, "robot.toml", &degrees, "alpha_rad = -90.0");

    let radians = scaled(&table(), "alpha_deg", std::f64::consts::PI / 180.0);
    let cause = first(&check(&radians, &urdf()));
    assert_eq!([&cause["cause"], &cause["parameter"]], ["radians_as_degrees", "alpha"]);
    assert_eq!(cause["suggestion"], "alpha_deg = -90\nalpha_deg = -90\nalpha_deg = 90");
    let message = "all values of alpha in the table are in radians, but their keys say degrees";
    assert_eq!(cause["message"], message);
    let twice = first(&check(&scaled(&table(), "d_m", 1e-3), &urdf()));
    let message = "all values of d in the table are 1000 times too small, as if converted to metres twice";
    assert_eq!(twice["message"], message);
}

/// A value in another unit is not fitted: as a hypothesis that does not explain the difference it keeps its digits.
#[test]
fn a_value_in_another_unit_keeps_its_digits() {
    let turned = table().replacen("theta_deg = 0.0", "theta_deg = 90.0", 1);
    let report = check(&turned, &urdf()).json();
    let all = report["diagnosis"].as_array().unwrap();
    let quarter =
        all.iter().find(|cause| cause["cause"] == "degrees_as_radians" && cause["parameter"] == "theta");
    assert_eq!(quarter.unwrap()["suggestion"], "theta_deg = 1.570796", "{all:#?}");
}
