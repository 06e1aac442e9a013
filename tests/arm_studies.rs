//! Analysis of an arm: `ik`, `sensitivity`, `manipulability`, `workspace` and `move_tcp`, through the
//! command.

use std::f64::consts::PI;

use serde_json::Value;

use crate::command::{congruent, congruent_json, text};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn targets(folder: &tempfile::TempDir, json: &str) -> String {
    let path = folder.path().join("targets.json");
    std::fs::write(&path, json).unwrap();
    text(&path)
}

#[test]
fn case_23_and_24_by_the_command() {
    let folder = tempfile::tempdir().unwrap();
    let start = r#""start": {"joint_1": 1.0, "joint_2": 1.0, "joint_3": 1.5, "joint_4": 1.5}"#;
    let names = congruent_json(&["fk", "robots/rrr_arm"]).json()["joints"].clone();
    let start = (1..=4).fold(start.to_owned(), |start, at| {
        start.replace(&format!("joint_{at}"), names[at - 1].as_str().unwrap())
    });
    let file = targets(
        &folder,
        &format!(r#"[{{"translation_m": [0.59840159, -0.21191189, 0.42244937], {start}}}]"#),
    );
    for method in ["lm", "newton", "pseudo-inverse", "transpose"] {
        let answer = congruent_json(&["ik", "robots/rrr_arm", "--targets", &file, "--method", method]);
        let document = answer.json();
        assert_eq!((answer.code, &document["method"]), (0, &Value::from(method)), "{}", answer.stderr);
        let result = &document["results"][0];
        assert_eq!(result["converged"], true);
        assert!(number(&result["residual_position_m"]) < 1e-9, "{result}");
    }
}

#[test]
fn a_target_out_of_reach_is_a_result_and_an_error_is_bad_input() {
    let folder = tempfile::tempdir().unwrap();
    let file = targets(&folder, r#"[{"translation_m": [0.4, 0.1, 0.3]}, {"translation_m": [3, 0, 0]}]"#);
    let answer = congruent_json(&["ik", "robots/ur5e", "--targets", &file]);
    let results = answer.json()["results"].clone();
    assert_eq!(answer.code, 1);
    assert_eq!(
        (&results[0]["converged"], &results[1]["converged"]),
        (&Value::from(true), &Value::from(false))
    );
    assert!(number(&results[1]["residual_position_m"]) > 1.9);
    for (json, mention) in [
        (r#"[{"translation_m": [0.4, 0.1]}]"#, "length 2"),
        (r#"[{"translation_m": [0.4, 0.1, 0], "quaternion_wxyz": [1, 1, 0, 0]}]"#, "norm"),
        (r#"[{"translation_m": [0.4, 0.1, 0], "start": {"elbo": 0}}]"#, "elbow_joint"),
    ] {
        let answer = congruent(&["ik", "robots/ur5e", "--targets", &targets(&folder, json)]);
        assert!(answer.code == 2 && answer.stderr.contains(mention), "{}", answer.stderr);
    }
}

#[test]
fn an_empty_list_is_no_check_and_an_error_has_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let run = |json: &str| congruent_json(&["ik", "robots/ur5e", "--targets", &targets(&folder, json)]);
    assert_eq!(run("[]").code, 4);
    let human = congruent(&["ik", "robots/ur5e", "--targets", &targets(&folder, "[]")]);
    assert!(human.code == 4 && human.stdout.contains("the file has no target"), "{}", human.stdout);
    for (second, mention) in [
        (r#"{"translation_m": [0.4, 0.1, 0.3], "quaternion_wxyz": [0, 0, 0, 0]}"#, "norm"),
        (r#"{"translation_m": [0.4, 0.1, 0.3], "start": {"elbo": 0}}"#, "elbo"),
        (r#"{"translation_m": [0.4, 0.1]}"#, "length 2"),
        (r#"{"translation_m": [0.4, 0.1, 1e308]}"#, "beyond"),
    ] {
        let answer = run(&format!("[{{\"translation_m\": [0.4, 0.1, 0.3]}},\n\n {second}]"));
        let finding = answer.json()["findings"][0].clone();
        assert_eq!((answer.code, &finding["line"]), (2, &Value::from(3)), "{finding}");
        let message = finding["message"].as_str().unwrap();
        assert!(message.contains("target 2") && message.contains(mention), "{message}");
    }
}

#[test]
fn a_start_outside_the_limits_is_warned_of_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let target = |start: f64| {
        let json = format!(
            "[{{\"translation_m\": [0.4, 0.1, 0.3]}},\n\
             {{\"translation_m\": [0.4, 0.1, 0.3], \"start\": {{\"elbow_joint\": {start}}}}}]"
        );
        congruent_json(&["ik", "robots/ur5e", "--targets", &targets(&folder, &json)])
    };
    let answer = target(4.0);
    let document = answer.json();
    // A whole turn less is within half a turn.
    assert!(answer.code == 0 && document.get("warnings").is_none(), "{document}");
    let planar = targets(&folder, r#"[{"translation_m": [0.4, 0.1, 0], "start": {"joint_2": 3}}]"#);
    let answer = congruent_json(&["ik", "robots/planar_2r", "--targets", &planar]);
    let warning = answer.json()["warnings"][0].clone();
    assert_eq!((&warning["line"], &warning["severity"]), (&Value::from(1), &Value::from("warning")));
    let message = warning["message"].as_str().unwrap();
    assert!(message.contains("target 1") && message.contains("joint_2"), "{message}");
    let human = congruent(&["ik", "robots/planar_2r", "--targets", &planar]);
    assert!(human.stderr.contains("outside its limits"), "{}", human.stderr);
}

#[test]
fn case_10_one_degree_of_joint_offset_for_two_arm_lengths() {
    /// Local search ends within its last step; worst seen 2e-12.
    const SEARCH_MM: f64 = 1e-6;
    let folder = tempfile::tempdir().unwrap();
    let svg = text(&folder.path().join("sensitivity.svg"));
    let arguments =
        ["sensitivity", "robots/planar_2r", "--length-factors", "1,1.5", "--samples", "500", "--plot", &svg];
    let document = congruent_json(&arguments).json();
    let chord_mm = |length_m: f64| 2.0 * (PI / 360.0).sin() * length_m * 1e3;
    for (arm, factor) in [(0, 1.0), (1, 1.5)] {
        let parameters = &document["arms"][arm]["parameters"];
        for (joint, length_m) in [(0, 1.0), (1, 0.4)] {
            let effect = &parameters[joint];
            assert_eq!(effect["parameter"], "zero");
            assert!(
                (number(&effect["worst_mm"]) - chord_mm(length_m * factor)).abs() < SEARCH_MM,
                "{effect}"
            );
        }
        // The first joint does most harm with the elbow stretched.
        let elbow = parameters[0]["worst_at"].as_object().unwrap().values().next_back().unwrap().clone();
        assert!(number(&elbow).abs() < 1e-3, "{elbow}");
    }
    assert!(std::fs::read_to_string(svg).unwrap().contains("</svg>"));
}

#[test]
fn case_01_the_reachable_area_of_the_planar_arm() {
    let folder = tempfile::tempdir().unwrap();
    let svg = text(&folder.path().join("workspace.svg"));
    let document = congruent_json(&["workspace", "robots/planar_2r", "--plot", &svg]).json();
    // The elbow bends to 150 degrees: a ring, which the shoulder's 170 degrees close.
    let inner_m = (0.36_f64 + 0.16 - 0.48 * (PI / 6.0).cos()).sqrt();
    assert!((number(&document["reach"][0]["distance_m"]) - inner_m).abs() < 1e-9);
    assert!((number(&document["reach"][1]["distance_m"]) - 1.0).abs() < 1e-9);
    let area_m2 = PI * (1.0 - inner_m * inner_m);
    assert!((number(&document["area_m2"]) - area_m2).abs() < 0.01 * area_m2);
    assert!(document["volume_m3"].is_null());
    assert!(std::fs::read_to_string(svg).unwrap().contains("</svg>"));
}

/// The extremes are those of the arm, not of the sample: side peaks of the Panda are 0.2 to 1.3 mm lower.
#[test]
fn the_extremes_of_the_workspace_do_not_depend_on_the_seed() {
    /// Local search ends within its last step; worst seen 8e-14 at the corners, 4e-8 at the base's origin,
    /// where the distance has a kink.
    const SEARCH_M: f64 = 1e-6;
    let extremes = |seed: &str| -> Vec<f64> {
        let arguments = ["workspace", "robots/panda", "--samples", "100000", "--seed", seed];
        let document = congruent_json(&arguments).json();
        let corners = [&document["lower_m"], &document["upper_m"]];
        let corners = corners.iter().flat_map(|corner| corner.as_array().unwrap().iter().map(number));
        let reach = (0..2).map(|end| number(&document["reach"][end]["distance_m"]));
        corners.chain(reach).collect()
    };
    let expected = extremes("0");
    for seed in ["1", "2", "3"] {
        for (found, expected) in extremes(seed).iter().zip(&expected) {
            assert!((found - expected).abs() < SEARCH_M, "seed {seed}: {found} not {expected}");
        }
    }
}

#[test]
fn an_axis_of_any_length_is_normalised_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("arm.urdf");
    let urdf =
        std::fs::read_to_string(crate::corpus::workspace().join("robots/planar_2r/planar_2r.urdf")).unwrap();
    let workspace = |axis: &str| {
        let axis = format!("<axis xyz=\"{axis}\"/>");
        std::fs::write(&file, urdf.replacen("<axis xyz=\"0 0 1\"/>", &axis, 1)).unwrap();
        congruent_json(&["workspace", &text(&file), "--samples", "1000"])
    };
    for axis in ["0 0 1e300", "0 0 1e-300"] {
        let answer = workspace(axis);
        assert_eq!(answer.code, 0, "{}", answer.stderr);
        assert!((number(&answer.json()["reach"][1]["distance_m"]) - 1.0).abs() < 1e-9, "{}", answer.stdout);
    }
    let answer = workspace("1.7e308 1.7e308 0");
    let finding = answer.json()["findings"][0].clone();
    assert_eq!((answer.code, &finding["line"]), (2, &Value::from(101)), "{finding}");
}

/// `w = l1 l2 |sin q2|` for two links (Yoshikawa 1985, eq. 15).
#[test]
fn case_12_manipulability_of_the_planar_arm() {
    let names = congruent_json(&["fk", "robots/planar_2r"]).json()["joints"].clone();
    let elbow = |q: f64| format!("{}={q}", names[1].as_str().unwrap());
    let linear = |q: f64| {
        let at = elbow(q);
        congruent_json(&["manipulability", "robots/planar_2r", "--at", &at]).json()["results"][0]["linear"]
            .clone()
    };
    let bent = linear(0.7);
    assert!((number(&bent["yoshikawa"]) - 0.24 * 0.7_f64.sin()).abs() < 1e-12, "{bent}");
    assert_eq!(bent["directions"], 2);
    let stretched = linear(0.0);
    assert!(number(&stretched["distance_to_singularity"]) < 1e-12, "{stretched}");
}

#[test]
fn a_motion_goes_to_a_pose_of_the_tool_and_a_pose_out_of_reach_has_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let run = |x_m: f64| {
        let path = folder.path().join("scenario.toml");
        let robot = text(&crate::corpus::workspace().join("robots/ur5e"));
        let scenario = format!(
            "schema_version = 1\nname = \"tcp\"\nrobot = \"{robot}\"\n\
             [start]\njoints_deg = {{ shoulder_lift_joint = -90, elbow_joint = 90 }}\n\
             [controller]\nkind = \"kinematic\"\n\
             [[motion]]\nmove_tcp = {{ xyz_m = [{x_m}, 0.1, 0.3], rpy_deg = [180, 0, 0] }}\nduration_s = 0.2\n\
             [[check]]\nkind = \"agreement\"\n"
        );
        std::fs::write(&path, scenario).unwrap();
        congruent(&["run", &text(&path), "--out", &text(&folder.path().join("out")), "--no-recording"])
    };
    let reached = run(0.4);
    assert_eq!(reached.code, 0, "{}", reached.stderr);
    let beyond = run(1.4);
    assert_eq!(beyond.code, 2);
    assert!(beyond.stderr.contains("scenario.toml:9:") && beyond.stderr.contains("mm"), "{}", beyond.stderr);
}
