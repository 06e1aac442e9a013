//! Analysis of an arm: `ik`, `sensitivity`, `manipulability`, `workspace` and `move_tcp`, through the
//! command.

use std::f64::consts::PI;

use serde_json::Value;

use crate::support::{
    command::{congruent, congruent_json, text},
    golden::number,
};

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

/// With 1275 mm to go, such a target was "reached".
#[test]
fn a_tolerance_that_every_pose_meets_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let targets = targets(&folder, r#"[{"translation_m": [0, 0, 1]}]"#);
    for tolerance in ["1e9m", "4m", "4rad"] {
        let answer = congruent_json(&["ik", "robots/ur5e", "--targets", &targets, "--tolerance", tolerance]);
        let finding = answer.json()["findings"][0].clone();
        assert_eq!((answer.code, &finding["code"]), (2, &"tolerance::meaningless".into()), "{finding}");
    }
    let answer = congruent(&["ik", "robots/ur5e", "--targets", &targets, "--tolerance", "0.5m"]);
    assert!(answer.stderr.contains("more than a tenth of the reach"), "{}", answer.stderr);
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
    // The elbow bends to 150 degrees: a ring, which the shoulder's 170 degrees close except for a sliver at its outer
    // edge, where the elbow no longer makes up for the missing 10 degrees.
    let inner_m = (0.36_f64 + 0.16 - 0.48 * (PI / 6.0).cos()).sqrt();
    assert!((number(&document["reach"][0]["distance_m"]) - inner_m).abs() < 1e-9);
    assert!((number(&document["reach"][1]["distance_m"]) - 1.0).abs() < 1e-9);
    let area_m2 = PI * (1.0 - inner_m * inner_m) - missing_m2();
    assert!((number(&document["area_m2"]) - area_m2).abs() < 0.005 * area_m2);
    assert!(document["volume_m3"].is_null());
    assert!(std::fs::read_to_string(svg).unwrap().contains("</svg>"));
    for samples in ["100", "1000", "10000", "1000000"] {
        let document = congruent_json(&["workspace", "robots/planar_2r", "--samples", samples]).json();
        let [lower, upper] = [0, 1].map(|end| number(&document["between"][end]));
        assert!(
            lower <= area_m2 && area_m2 <= upper,
            "{area_m2} is not within {lower} to {upper}, {samples} samples"
        );
    }
    let few = congruent(&["workspace", "robots/planar_2r", "--samples", "100"]);
    assert!(few.stdout.contains("the interval is wide"), "{}", few.stdout);
}

/// At distance `r` the elbow turns the tool away from the upper arm by `psi`, on either side: what is further beyond
/// the shoulder's limit is missing, on both sides.
fn missing_m2() -> f64 {
    const STEPS: u32 = 100_000;
    let edge = |r: f64| (PI / 18.0 - ((0.36 + r * r - 0.16) / (1.2 * r)).acos()).max(0.0) * 2.0 * r;
    let from = 0.9; // psi is more than 10 degrees there
    let step = (1.0 - from) / f64::from(STEPS);
    (0..STEPS).map(|at| edge(from + (f64::from(at) + 0.5) * step) * step).sum()
}

/// A slide without a range has no extreme: the answer says which range was taken.
#[test]
fn a_slide_without_a_range_is_said_to_have_been_limited() {
    let folder = tempfile::tempdir().unwrap();
    let mjcf = "<mujoco><worldbody><body><joint name='rail' type='slide' axis='1 0 0'/><geom size='0.1'/><body pos='0 0 0.2'>\
                <joint name='turn' axis='0 1 0'/><geom size='0.1'/></body></body></worldbody></mujoco>";
    let answer = congruent(&["workspace", &targets(&folder, mjcf), "--samples", "1000"]);
    let said = "joint \"rail\" slides without a range: -1000 mm to 1000 mm are taken\n";
    assert!(answer.stdout.contains(said) && !answer.stdout.contains("\"turn\""), "{}", answer.stdout);
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
        std::fs::read_to_string(crate::support::corpus::workspace().join("robots/planar_2r/planar_2r.urdf"))
            .unwrap();
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
    let elbow = |q: f64| format!("{}={q}rad", names[1].as_str().unwrap());
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

/// A turn, a lift and a slide that reaches out by `r`: the tool moves by `r` m per rad, and each m of the others counts
/// as much as the length that is given.
#[test]
fn manipulability_of_turning_and_sliding_joints_has_no_unit() {
    let folder = tempfile::tempdir().unwrap();
    let robots = crate::support::corpus::workspace().join("robots/cylindrical_rpp");
    let manipulability = |robot: &str, reach: f64, more: &[&str]| {
        let at = format!("joint_3={reach}");
        let document = congruent_json(&[&["manipulability", robot, "--at", &at], more].concat()).json();
        (document["results"][0].clone(), number(&document["metres_per_rad"]))
    };
    let close =
        |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found} not {expected}");
    let (found, _) = manipulability("robots/cylindrical_rpp", 0.3, &["--length", "200mm"]);
    close(number(&found["linear"]["yoshikawa"]), 0.3 * 0.2 * 0.2);
    close(number(&found["linear"]["semi_axes"][0]), 0.3);
    close(number(&found["linear"]["condition"]), 1.5);
    close(number(&found["angular"]["yoshikawa"]), 1.0);
    // In lengths of 0.2 m: the turn moves and turns, the others only move.
    close(number(&found["whole"]["yoshikawa"]), f64::hypot(1.0, 1.5));
    // The same arm in millimetres, its own length not given: nothing without a unit of length changes.
    let (found, length_m) = manipulability("robots/cylindrical_rpp", 0.3, &[]);
    let urdf = std::fs::read_to_string(robots.join("cylindrical_rpp.urdf")).unwrap();
    let path = folder.path().join("large.urdf");
    std::fs::write(&path, in_thousandths(&urdf)).unwrap();
    let (large, large_length) = manipulability(&text(&path), 300.0, &[]);
    assert!((large_length / length_m - 1e3).abs() < 1e-9, "{large_length}");
    for measure in ["yoshikawa", "condition", "distance_to_singularity"] {
        let [found, large] = [&found, &large].map(|each| number(&each["whole"][measure]));
        assert!((found - large).abs() < 1e-9 * found, "{measure}: {found} and {large}");
    }
    let human = congruent(&["manipulability", "robots/cylindrical_rpp"]);
    assert!(human.stdout.contains("of joint_2, joint_3 count as one radian"), "{}", human.stdout);
}

/// A URDF with the origins and the strokes of its joints a thousand times as long.
fn in_thousandths(urdf: &str) -> String {
    let mut is_prismatic = false;
    let scaled = |line: &str, attribute: &str| {
        let Some((before, rest)) = line.split_once(&format!("{attribute}=\"")) else {
            return line.to_owned();
        };
        let (values, after) = rest.split_once('"').unwrap();
        let values: Vec<String> = values
            .split_whitespace()
            .map(|value| (value.parse::<f64>().unwrap() * 1e3).to_string())
            .collect();
        format!("{before}{attribute}=\"{}\"{after}", values.join(" "))
    };
    let mut in_joint = false;
    let line = |line: &str| {
        if line.contains("<joint ") {
            (in_joint, is_prismatic) = (true, line.contains("prismatic"));
        }
        let is_of_joint = in_joint;
        in_joint &= !line.contains("</joint>");
        match line {
            line if is_of_joint && line.contains("<origin") => scaled(line, "xyz"),
            line if is_of_joint && is_prismatic && line.contains("<limit") => {
                scaled(&scaled(line, "lower"), "upper")
            }
            line => line.to_owned(),
        }
    };
    urdf.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Central differences of the TCP that `fk` gives, by each joint; the body and the space Jacobian by their axes.
#[test]
fn the_jacobian_of_the_tcp_is_the_derivative_of_its_pose() {
    /// Kind: truncation. h^2 / 6 of a third derivative of about 1 m, and rounding 1e-16 / h; worst seen 2e-10.
    const DIFFERENCE: f64 = 1e-8;
    const STEP: f64 = 1e-5;
    const Q: [f64; 6] = [0.4, -1.1, 1.3, 0.2, -0.7, 0.5];
    let joints = crate::support::published_table::UR5E_JOINTS;
    let at = |q: [f64; 6]| {
        joints
            .iter()
            .zip(q)
            .flat_map(|(joint, q)| ["--at".to_owned(), format!("{joint}={q}rad")])
            .collect::<Vec<_>>()
    };
    let run = |command: &[&str], q: [f64; 6]| {
        let arguments: Vec<String> = command.iter().map(|&word| word.to_owned()).chain(at(q)).collect();
        congruent_json(&arguments).json()["results"][0].clone()
    };
    let tcp = |q: [f64; 6]| -> Vec<f64> {
        let pose = run(&["fk", "robots/ur5e"], q)["links"]["tcp"].clone();
        pose["translation_m"].as_array().unwrap().iter().map(number).collect()
    };
    let entries = |jacobian: &Value, block: &str| -> Vec<Vec<f64>> {
        let rows = jacobian[block].as_array().unwrap().iter();
        rows.map(|row| row.as_array().unwrap().iter().map(number).collect()).collect()
    };
    let of_tcp = run(&["jacobian", "robots/ur5e", "--link", "tcp"], Q);
    let of_tip = run(&["jacobian", "robots/ur5e"], Q);
    let linear = entries(&of_tcp, "linear");
    for joint in 0..6 {
        let moved = |by: f64| {
            let mut q = Q;
            q[joint] += by;
            tcp(q)
        };
        let (ahead, behind) = (moved(STEP), moved(-STEP));
        for axis in 0..3 {
            let difference = (ahead[axis] - behind[axis]) / (2.0 * STEP);
            assert!((linear[axis][joint] - difference).abs() < DIFFERENCE, "joint {joint}, axis {axis}");
        }
    }
    assert_eq!(of_tcp["angular"], of_tip["angular"], "the tool turns as the tip");
    assert_ne!(of_tcp["linear"], of_tip["linear"]);
    let document = congruent_json(&["jacobian", "robots/ur5e", "--link", "tcp"]).json();
    assert_eq!((&document["link"], &document["tcp"]["link"]), (&Value::from("tcp"), &Value::from("tool0")));
    let none = congruent(&["jacobian", "robots/planar_2r", "--link", "tcp"]);
    assert!(none.code == 2 && none.stderr.contains("declares no tool centre point"), "{}", none.stderr);
}

#[test]
fn a_motion_goes_to_a_pose_of_the_tool_and_a_pose_out_of_reach_has_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let run = |x_m: f64| {
        let path = folder.path().join("scenario.toml");
        let robot = text(&crate::support::corpus::workspace().join("robots/ur5e"));
        let scenario = format!(
            "schema_version = 1\nname = \"tcp\"\nrobot = \"{robot}\"\n\
             [start]\njoints_deg = {{ shoulder_lift_joint = -90, elbow_joint = 90 }}\n\
             [controller]\nkind = \"kinematic\"\n\
             [[motion]]\nmove_tcp = {{ xyz_m = [{x_m}, 0.1, 0.3], rpy_deg = [180, 0, 0] }}\nduration_s = 2.0\n\
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
