//! `congruent check --against`: joints that follow others in two URDFs in different ways.

use std::fs;

use serde_json::{Value, json};

use crate::support::{
    command::{Answer, congruent, congruent_json, text},
    corpus::corpus,
};

/// Two links of 0.4 m; the second joint follows as its `<mimic>` says, the length is that of the first link.
fn urdf(mimic: &str, length_m: f64) -> String {
    let link = |name: &str| {
        format!(
            "<link name=\"{name}\"><inertial><mass value=\"1\"/><inertia ixx=\"0.01\" iyy=\"0.01\" izz=\"0.01\" \
             ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n"
        )
    };
    let joint = |name: &str, links: [&str; 2], x_m: f64, rest: &str| {
        format!(
            "<joint name=\"{name}\" type=\"revolute\"><parent link=\"{}\"/><child link=\"{}\"/>\
             <origin xyz=\"{x_m} 0 0\"/><axis xyz=\"0 1 0\"/>\
             <limit lower=\"-2\" upper=\"2\" effort=\"9\" velocity=\"3\"/>{rest}</joint>\n",
            links[0], links[1]
        )
    };
    let links = link("base") + &link("upper") + &link("lower") + "<link name=\"tool\"/>\n";
    let joints = joint("lift", ["base", "upper"], 0.0, "")
        + "\n"
        + &joint("bend", ["upper", "lower"], length_m, mimic)
        + "<joint name=\"end\" type=\"fixed\"><parent link=\"lower\"/><child link=\"tool\"/>\
           <origin xyz=\"0.4 0 0\"/></joint>\n";
    format!("<robot name=\"two\">\n{links}{joints}</robot>\n")
}

/// The report of two such files.
fn against(first: &str, second: &str, second_length_m: f64) -> Answer {
    let temporary = tempfile::tempdir().unwrap();
    let [one, other, asked] =
        ["one.urdf", "other.urdf", "asked.json"].map(|name| temporary.path().join(name));
    fs::write(&one, urdf(first, 0.4)).unwrap();
    fs::write(&other, urdf(second, second_length_m)).unwrap();
    fs::write(&asked, json!([{ "q": { "lift": 1.0 } }]).to_string()).unwrap();
    let [one, other, asked] = [&one, &other, &asked].map(|path| text(path));
    congruent_json(&["check", &one, "--against", &other, "--configurations", &asked])
}

const HALF: &str = "<mimic joint=\"lift\" multiplier=\"0.5\"/>";

fn named(second: &str, parameter: &str) -> Value {
    let answer = against(HALF, second, 0.4);
    let report = answer.json();
    assert_eq!((answer.code, &report["verdict"]), (1, &json!("disagree")), "{second}");
    let fault = report["diagnosis"][0].clone();
    assert_eq!((&fault["cause"], &fault["joint"]), (&json!("mimic"), &json!("bend")), "{fault}");
    assert_eq!((&fault["parameter"], &fault["within_tolerance"]), (&json!(parameter), &json!(true)));
    assert!(fault["line"].is_u64() && fault["file"].as_str().unwrap().ends_with("one.urdf"), "{fault}");
    // Torques are compared as if all joints were driven: the masses are equal.
    assert!(report["against"]["dynamics_not_compared"].is_null(), "{}", report["against"]);
    assert_eq!(report["dynamics"]["verdict"], "same", "{}", report["dynamics"]);
    assert!(report["certificate"].is_null(), "{}", report["certificate"]);
    report
}

/// At 1 rad of the master the tool is `2 * 0.4 sin(0.05)` m away.
#[test]
fn another_multiplier_is_a_fault_of_the_file() {
    let report = named("<mimic joint=\"lift\" multiplier=\"0.6\"/>", "multiplier");
    let found = report["at_configurations"][0]["position_m"].as_f64().unwrap();
    assert!((found - 0.8 * 0.05_f64.sin()).abs() < 1e-12, "{found}");
    let fault = &report["diagnosis"][0];
    assert_eq!((&fault["found"], &fault["expected"]), (&json!(0.5), &json!(0.6)));
    let suggestion = fault["suggestion"].as_str().unwrap();
    assert!(suggestion.contains("<mimic joint=\"lift\" multiplier=\"0.6\" offset=\"0\"/>"), "{suggestion}");
}

#[test]
fn another_offset_and_a_joint_that_follows_in_one_file_alone_are_faults() {
    named("<mimic joint=\"lift\" multiplier=\"0.5\" offset=\"0.2\"/>", "offset");
    named("", "mimic");
}

#[test]
fn equal_relations_agree_and_a_wrong_length_is_named_as_well() {
    assert_eq!(against(HALF, HALF, 0.4).code, 0);
    let rounded = "<mimic joint=\"lift\" multiplier=\"0.5000000000001\"/>";
    assert_eq!(against(HALF, rounded, 0.4).code, 0);
    let both = against(HALF, "<mimic joint=\"lift\" multiplier=\"0.6\"/>", 0.41).json();
    let first = &both["diagnosis"][0];
    assert_eq!(first["stages"].as_array().unwrap().len(), 2, "{first}");
    assert_eq!((&first["cause"], &first["within_tolerance"]), (&json!("several"), &json!(true)), "{first}");
    let causes: Vec<&Value> = first["parts"].as_array().unwrap().iter().map(|part| &part["cause"]).collect();
    assert_eq!(causes, ["mimic", "joint_origin"]);
}

/// An MJCF has bodies and constraints: what to write is said in its own elements.
#[test]
fn an_mjcf_is_corrected_in_its_own_elements() {
    let Some(corpus) = corpus() else { return };
    let pair = corpus.join("pairs/piper");
    let [mjcf, urdf] = ["robot.xml", "partner.urdf"].map(|name| pair.join(name).display().to_string());
    let printed = congruent(&["check", &mjcf, "--against", &urdf]).stdout;
    let printed = printed.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
    assert!(
        printed.contains("to do: remove joint \"joint8\" from <equality>, or write <mimic "),
        "{printed}"
    );
    let pose = "pos=\"-0.2422100788 0.0685081015 -0.000000369\" quat=\"0.5447666607 -0.5447687785 ";
    assert!(printed.contains(&format!("to write: <body name=\"link4\" {pose}")), "{printed}");
    assert!(printed.contains("(robot.xml:71)"), "{printed}");
    assert!(!printed.contains("in the <origin>"), "{printed}");
}

/// A link that turns alone, about its own origin, is the one that differs: not the root, which no joint moves.
#[test]
fn a_follower_that_turns_its_link_in_place_is_named_by_that_link() {
    let report = against(HALF, "<mimic joint=\"lift\" multiplier=\"0.6\"/>", 0.4).json();
    assert_eq!(report["worst"]["link"], "tool", "{report:#}");
    let temporary = tempfile::tempdir().unwrap();
    let files = ["0.5", "0.6"].map(|multiplier| {
        let mimic = format!("<mimic joint=\"lift\" multiplier=\"{multiplier}\"/>");
        let path = temporary.path().join(format!("{multiplier}.urdf"));
        let in_place =
            urdf(&mimic, 0.4).replace("<origin xyz=\"0.4 0 0\"/></joint>\n</robot>", "</joint>\n</robot>");
        fs::write(&path, in_place).unwrap();
        text(&path)
    });
    let answer = congruent(&["check", &files[0], "--against", &files[1], "-q"]);
    assert!(answer.stdout.contains("deg at lower "), "{}", answer.stdout);
}
