//! `congruent describe`: what the files of a robot say, and what is missing for which use.

use std::fs;

use serde_json::{Value, json};

use crate::support::{
    command::{congruent, congruent_json, congruent_with_input, text},
    corpus::{corpus, workspace},
};

/// An arm of two links with a mesh that does not exist, and without masses.
const BARE: &str = r#"<robot name="bare">
  <link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <link name="arm"><collision><geometry><mesh filename="missing.stl"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="0.5" upper="1" velocity="2" effort="0"/></joint>
</robot>"#;

fn use_of<'a>(summary: &'a Value, name: &str) -> &'a Value {
    summary["uses"].as_array().unwrap().iter().find(|each| each["use"] == name).unwrap()
}

#[test]
fn links_joints_and_masses_are_those_of_the_urdf() {
    let answer = congruent_json(&["describe", "robots/ur5e"]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let summary = answer.json();
    let urdf = fs::read_to_string(workspace().join("robots/ur5e/ur5e.urdf")).unwrap();
    let urdf = roxmltree::Document::parse(&urdf).unwrap();
    let named = |tag: &str| urdf.root_element().children().filter(|node| node.has_tag_name(tag)).count();
    assert_eq!(summary["links"].as_array().unwrap().len(), named("link"));
    assert_eq!(summary["joints"].as_array().unwrap().len(), named("joint"));
    let masses = urdf.descendants().filter(|node| node.has_tag_name("mass"));
    let total: f64 = masses.map(|mass| mass.attribute("value").unwrap().parse::<f64>().unwrap()).sum();
    // Rounding: the sum of ten masses in another order.
    assert!((summary["mass_kg"].as_f64().unwrap() - total).abs() < 1e-12);
    for joint in summary["joints"].as_array().unwrap() {
        let name = joint["name"].as_str().unwrap();
        let node = urdf.root_element().children().find(|node| node.attribute("name") == Some(name)).unwrap();
        assert_eq!(joint["kind"], node.attribute("type").unwrap());
        let child = |tag| node.children().find(|node| node.has_tag_name(tag)).unwrap();
        assert_eq!(joint["parent"], child("parent").attribute("link").unwrap());
        assert_eq!(joint["child"], child("child").attribute("link").unwrap());
        if joint["kind"] == "revolute" {
            for key in ["lower", "upper", "velocity", "effort"] {
                let written: f64 = child("limit").attribute(key).unwrap().parse().unwrap();
                assert_eq!(joint[key], json!(written), "{name} {key}");
            }
        }
    }
    assert_eq!(summary["table"], json!({ "convention": "standard", "rows": 6 }));
    assert_eq!(summary["likely_tips"], json!([{ "link": "tool0", "joints": 6 }]));
    assert!(summary["uses"].as_array().unwrap().iter().all(|each| each["is_ready"] == true));
}

#[test]
fn what_is_missing_is_named_with_its_use() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bare.urdf");
    fs::write(&file, BARE).unwrap();
    let summary = congruent_json(&["describe", &text(&file)]).json();
    let clearance = use_of(&summary, "clearance");
    assert_eq!(clearance["is_ready"], false);
    assert_eq!(clearance["stopped_by"][0]["line"], 3);
    assert_eq!(use_of(&summary, "kinematics")["missing"][1]["names"], json!(["turn"]));
    // The mesh that is missing is what is said of clearance, and not that there is no shape.
    assert_eq!(clearance["missing"], json!([]));
    let physics = use_of(&summary, "physics")["missing"].as_array().unwrap();
    let names: Vec<&Value> = physics.iter().map(|missing| &missing["names"]).collect();
    assert_eq!(names, [&json!(["arm"]), &json!(["turn"]), &json!(["base"])], "{summary}");
    let shown = congruent(&["describe", &text(&file)]);
    assert_eq!(shown.code, 0, "{}", shown.stderr);
    for words in ["clearance: cannot be used", "missing.stl", "no limit of effort is stated (1): turn"] {
        assert!(shown.stdout.contains(words), "no {words:?} in {}", shown.stdout);
    }
}

#[test]
fn lines_have_80_columns() {
    let mut robots: Vec<String> = ["ur5e", "panda", "rrr_arm", "cylindrical_rpp", "spherical_wrist"]
        .map(|name| format!("robots/{name}"))
        .into();
    robots.extend(corpus().into_iter().flat_map(|corpus| {
        let folders = fs::read_dir(corpus.join("robots")).unwrap();
        let urdfs = folders.map(|folder| folder.unwrap().path().join("robot.urdf"));
        urdfs.filter(|urdf| urdf.is_file()).map(|urdf| text(&urdf)).collect::<Vec<_>>()
    }));
    for robot in robots {
        let answer = congruent(&["describe", &robot]);
        assert_eq!(answer.code, 0, "{robot}: {}", answer.stderr);
        // A path is not broken.
        let long = answer.stdout.lines().find(|line| line.chars().count() > 80 && !line.contains('/'));
        assert_eq!(long, None, "{robot}");
    }
}

#[test]
fn every_input_is_answered() {
    let answer = congruent_json(&["describe", "robots/ur5e", "nowhere.urdf", "robots/panda"]);
    assert_eq!(answer.code, 2);
    let entries = answer.json();
    assert_eq!((&entries[0]["robot"], &entries[2]["robot"]), (&json!("ur5e"), &json!("panda")));
    assert_eq!(entries[1]["error"], "bad input");
    let answer = congruent_with_input(&["describe", "-"], BARE);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    assert!(answer.stdout.contains("turn: revolute about z"), "{}", answer.stdout);
}

/// Names of joints divided by spaces.
fn names(orders: &Value, order: &str) -> String {
    let names = orders[order].as_array().unwrap().iter().map(|name| name.as_str().unwrap());
    names.collect::<Vec<_>>().join(" ")
}

/// The joints of a robot with two arms as MuJoCo 4.0.0 lists those of the model that it compiles from the URDF.
const BAXTER_IN_MUJOCO: &str = "head_pan right_s0 right_s1 right_e0 right_e1 right_w0 right_w1 right_w2 r_gripper_l_finger_joint \
    r_gripper_r_finger_joint left_s0 left_s1 left_e0 left_e1 left_w0 left_w1 left_w2 l_gripper_l_finger_joint \
    l_gripper_r_finger_joint";

/// The same by a queue of links in another language, with fixed joints merged and kept.
const BAXTER_BREADTH_FIRST: &str = "head_pan right_s0 left_s0 right_s1 left_s1 right_e0 left_e0 right_e1 left_e1 right_w0 left_w0 \
    right_w1 left_w1 right_w2 left_w2 r_gripper_l_finger_joint r_gripper_r_finger_joint l_gripper_l_finger_joint \
    l_gripper_r_finger_joint";

#[test]
fn joints_of_two_arms_are_listed_in_the_orders_of_programs() {
    let Some(corpus) = corpus() else { return };
    let urdf = corpus.join("robots/baxter/robot.urdf");
    let answer = congruent_json(&["describe", &text(&urdf), "--orders"]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let orders = answer.json();
    assert_eq!(names(&orders, "depth_first"), BAXTER_IN_MUJOCO);
    assert_eq!(names(&orders, "breadth_first"), BAXTER_BREADTH_FIRST);
    assert_eq!(names(&orders, "breadth_first_of_links"), BAXTER_BREADTH_FIRST);
    let written = fs::read_to_string(&urdf).unwrap();
    let document = roxmltree::Document::parse(&written).unwrap();
    let moving = document.root_element().children().filter(|node| {
        node.has_tag_name("joint") && node.attribute("type").is_some_and(|kind| kind != "fixed")
    });
    let in_file: Vec<&str> = moving.map(|joint| joint.attribute("name").unwrap()).collect();
    assert_eq!(names(&orders, "in_file"), in_file.join(" "));
    assert_eq!(orders["remarks"].as_array().unwrap().len(), 2, "{:#}", orders["remarks"]);
    let printed = congruent(&["describe", &text(&urdf), "--orders"]).stdout;
    let printed = printed.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        printed.contains("place 9 is left_s0 in the file, r_gripper_l_finger_joint in MuJoCo"),
        "{printed}"
    );
}

#[test]
fn joints_of_an_mjcf_are_listed_in_the_order_of_the_compiled_model() {
    let Some(corpus) = corpus() else { return };
    for pair in ["panda", "piper", "so_arm100", "ur5e", "wx250s"] {
        let folder = corpus.join("pairs").join(pair);
        let golden: Value =
            serde_json::from_str(&fs::read_to_string(folder.join("golden.json")).unwrap()).unwrap();
        let orders = congruent_json(&["describe", &text(&folder.join("robot.xml")), "--orders"]).json();
        let compiled = golden["joints"].as_array().unwrap().iter().map(|joint| joint["name"].clone());
        assert_eq!(orders["depth_first"], compiled.collect::<Value>(), "{pair}");
    }
}

#[test]
fn a_chain_has_the_same_order_everywhere() {
    let printed = congruent(&["describe", "robots/ur5e", "--orders"]).stdout;
    assert!(printed.contains("all orders are the same"), "{printed}");
    assert!(printed.contains("wrist_3_joint"), "{printed}");
}
