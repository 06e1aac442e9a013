//! `congruent clearance --write-srdf`: an SRDF of pairs that need not be looked at, read back by the program.

use std::{collections::BTreeSet, fs};

use serde_json::{Value, json};

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
};

fn pairs(report: &Value, reason: &str) -> BTreeSet<(String, String)> {
    let suggested = report["suggested"].as_array().unwrap().iter().filter(|pair| pair["reason"] == reason);
    let name = |pair: &Value, at: usize| pair["pair"][at].as_str().unwrap().to_owned();
    suggested.map(|pair| (name(pair, 0), name(pair, 1))).collect()
}

/// Who says that a pair never touches is held against the distances of the golden configurations, by other code.
#[test]
fn what_never_touches_is_apart_where_others_measured() {
    let folder = tempfile::tempdir().unwrap();
    let report =
        congruent_json(&["clearance", "robots/panda", "--samples", "3000", "--write-srdf", "-"]).json();
    let never = pairs(&report, "Never");
    assert!(never.len() > 10, "{never:?}");
    // 200 random configurations that the samples do not contain.
    let joints = ["panda_joint1", "panda_joint2", "panda_joint3", "panda_joint5", "panda_joint7"];
    let configurations: Vec<Value> = (0..200)
        .map(|at| {
            let value = |joint: u32| f64::from((37 * at + 101 * joint) % 200) / 100.0 - 1.0;
            let q = (0..).zip(joints).map(|(index, joint)| (joint.to_owned(), json!(1.5 * value(index))));
            let mut q: serde_json::Map<String, Value> = q.collect();
            q.insert("panda_joint4".to_owned(), json!(-1.5 + value(7)));
            q.insert("panda_joint6".to_owned(), json!(1.8 + 1.5 * value(9)));
            json!({ "q": q })
        })
        .collect();
    let file = folder.path().join("q.json");
    fs::write(&file, Value::from(configurations).to_string()).unwrap();
    let measured =
        congruent_json(&["clearance", "robots/panda", "--all-pairs", "--configurations", &text(&file)])
            .json();
    let names = measured["pairs"].as_array().unwrap();
    let mut apart = 0;
    for (at, pair) in names.iter().enumerate() {
        let pair = (pair[0].as_str().unwrap().to_owned(), pair[1].as_str().unwrap().to_owned());
        let distances = measured["results"].as_array().unwrap().iter();
        let least =
            distances.map(|each| each["distances_m"][at].as_f64().unwrap()).fold(f64::INFINITY, f64::min);
        if never.contains(&pair) {
            assert!(least > 0.0, "{pair:?} touch");
            apart += 1;
        }
    }
    assert!(apart > 10, "{apart}");
}

#[test]
fn the_srdf_is_read_by_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let srdf = folder.path().join("ur5e.srdf");
    let arguments = ["clearance", "robots/ur5e", "--samples", "500", "--write-srdf", &text(&srdf)];
    let made = congruent(&arguments);
    assert_eq!(made.code, 0, "{}", made.stderr);
    assert!(made.stdout.contains("which is no proof"), "{}", made.stdout);
    let written = fs::read_to_string(&srdf).unwrap();
    let document = roxmltree::Document::parse(&written).unwrap();
    let reasons: BTreeSet<&str> =
        document.descendants().filter_map(|node| node.attribute("reason")).collect();
    assert!(reasons.is_subset(&BTreeSet::from(["Adjacent", "Default", "Always", "Never"])), "{reasons:?}");
    assert!(reasons.contains("Adjacent"));
    // As the `srdf` of a robot file it disables what it names.
    let urdf = workspace().join("robots/ur5e/ur5e.urdf");
    let robot = folder.path().join("robot.toml");
    fs::write(&robot, format!("urdf = {:?}\nsrdf = \"ur5e.srdf\"\n", text(&urdf))).unwrap();
    let described = congruent_json(&["describe", &text(&robot)]).json();
    let count = document.descendants().filter(|node| node.has_tag_name("disable_collisions")).count();
    assert_eq!(described["disabled_collisions"], count, "{}", described["warnings"]);
    let again = congruent(&arguments);
    assert_eq!(again.code, 2);
    assert!(again.stderr.contains("--force"), "{}", again.stderr);
    let over = congruent(&["clearance", &text(&robot), "--write-srdf", &text(&srdf), "--force"]);
    assert!(over.code == 2 && over.stderr.contains("is an input file"), "{}", over.stderr);
}

/// The fingers of the arm touch at the ends of their travel alone: an SRDF that disables them is warned of.
#[test]
fn the_declared_srdf_is_compared_and_not_applied() {
    let report =
        congruent_json(&["clearance", "robots/rrr_arm", "--samples", "2000", "--write-srdf", "-"]).json();
    assert_eq!(report["declared"]["pairs"], 1);
    assert_eq!(report["declared"]["hidden"], json!([["gripper_link_1", "gripper_link_2"]]));
    let printed =
        congruent(&["clearance", "robots/rrr_arm", "--samples", "2000", "--write-srdf", "-"]).stdout;
    assert!(printed.contains("pairs that the robot's SRDF disables: 1;"), "{printed}");
    assert!(roxmltree::Document::parse(&printed).is_ok(), "{printed}");
    // The same seed, the same answer.
    assert_eq!(
        report,
        congruent_json(&["clearance", "robots/rrr_arm", "--samples", "2000", "--write-srdf", "-"]).json()
    );
}

#[test]
fn a_robot_without_shapes_has_nothing_to_suggest() {
    let folder = tempfile::tempdir().unwrap();
    let urdf = folder.path().join("r.urdf");
    fs::write(&urdf, "<robot name='r'><link name='a'/></robot>").unwrap();
    let answer = congruent(&["clearance", &text(&urdf), "--write-srdf", "-"]);
    assert_eq!(answer.code, 4, "{}", answer.stdout);
    assert!(answer.stdout.contains("no pair to examine"), "{}", answer.stdout);
}
