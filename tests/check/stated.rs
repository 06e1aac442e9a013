//! `congruent check --against`: what only one of two descriptions states, and what differs beside torques.

use std::fs;

use serde_json::{Value, json};

use crate::support::{
    command::{Answer, congruent, congruent_json, text},
    suggested_changes::names,
};

/// Three turning joints, a tool that is fixed to the last link, and a finger behind the tool.
pub(super) const ARM: &str = r#"<robot name="arm">
<link name="base"/>
<link name="first"><inertial><origin xyz="0.05 0.02 0.2"/><mass value="10"/>
<inertia ixx="0.3" iyy="0.31" izz="0.2" ixy="0.01" ixz="-0.02" iyz="0.03"/></inertial></link>
<link name="second"><inertial><origin xyz="0.1 -0.02 0.03"/><mass value="6"/>
<inertia ixx="0.1" iyy="0.12" izz="0.15" ixy="0.004" ixz="0.006" iyz="-0.002"/></inertial></link>
<link name="third"><inertial><origin xyz="0.02 0.01 0.05"/><mass value="2"/>
<inertia ixx="0.01" iyy="0.012" izz="0.014" ixy="0.001" ixz="0.0002" iyz="0.0003"/></inertial></link>
<link name="tool"><inertial><origin xyz="0.01 0.02 0.03"/><mass value="0.5"/>
<inertia ixx="0.001" iyy="0.0012" izz="0.0014" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="turn" type="revolute"><parent link="base"/><child link="first"/><origin xyz="0 0 0.1"/><axis xyz="0 0 1"/>
<limit lower="-2.5" upper="2.5" velocity="1.5" effort="200"/><dynamics damping="1" friction="0"/></joint>
<joint name="lift" type="revolute"><parent link="first"/><child link="second"/><origin xyz="0.1 0 0.4"/><axis xyz="0 1 0"/>
<limit lower="-2" upper="2" velocity="1.5" effort="200"/><dynamics damping="0.5" friction="0"/></joint>
<joint name="bend" type="revolute"><parent link="second"/><child link="third"/><origin xyz="0.3 0.03 0.02"/><axis xyz="1 0 0"/>
<limit lower="-2" upper="2" velocity="1.5" effort="50"/><dynamics damping="0.1" friction="0"/></joint>
<joint name="mount" type="fixed"><parent link="third"/><child link="tool"/><origin xyz="0 0 0.1"/></joint>
</robot>
"#;

const FINGER: &str = r#"<link name="finger"><inertial><origin xyz="0 0 0.02"/><mass value="0.1"/>
<inertia ixx="0.0001" iyy="0.0001" izz="0.0001" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="grip" type="prismatic"><parent link="tool"/><child link="finger"/><axis xyz="0 1 0"/>
<limit lower="0" upper="0.04" velocity="0.1" effort="20"/></joint>
</robot>"#;

/// The arm without the `<inertial>` of these links.
pub(super) fn without_inertials(links: &[&str]) -> String {
    let mut urdf = ARM.to_owned();
    for link in links {
        let from =
            urdf.find(&format!("<link name=\"{link}\">")).unwrap() + format!("<link name=\"{link}\">").len();
        let to = from + urdf[from..].find("</link>").unwrap();
        urdf.replace_range(from..to, "");
    }
    urdf
}

/// The arm with one text in place of another that it has once.
pub(super) fn with(old: &str, new: &str) -> String {
    assert_eq!(ARM.matches(old).count(), 1, "{old}");
    ARM.replacen(old, new, 1)
}

/// A description against another one, as JSON and as text.
pub(super) fn against(first: &str, second: &str, more: &[&str]) -> (Answer, String) {
    let folder = tempfile::tempdir().unwrap();
    let [one, other] = ["one.urdf", "other.urdf"].map(|name| folder.path().join(name));
    fs::write(&one, first).unwrap();
    fs::write(&other, second).unwrap();
    let [one, other] = [&one, &other].map(|path| text(path));
    let arguments = [&["check", &one, "--against", &other], more].concat();
    (congruent_json(&arguments), congruent(&arguments).stdout)
}

/// The comparison of the two descriptions.
fn dynamics(report: &Value) -> &Value {
    let more = report["other_dynamics"].as_array().into_iter().flatten();
    let mut all = std::iter::once(&report["dynamics"]).chain(more);
    all.find(|of| of["sides"]["reference"] != "physics").unwrap()
}

const LINKS: [&str; 4] = ["first", "second", "third", "tool"];

#[test]
fn a_file_without_masses_is_no_reference_for_masses() {
    let (answer, printed) = against(ARM, &without_inertials(&LINKS), &[]);
    let report = answer.json();
    assert_eq!((answer.code, &report["verdict"]), (0, &json!("agree")), "{printed}");
    let compared = dynamics(&report);
    assert_eq!(compared["verdict"], "not_compared", "{compared:#}");
    assert_eq!(names(&compared["not_stated"]), ["masses of all links"]);
    assert!(compared["explanations"].as_array().unwrap().is_empty());
    assert!(printed.contains("SAME GEOMETRY, DYNAMICS NOT COMPARED"), "{printed}");
    assert!(!printed.contains("to write in"), "{printed}");
    // The other file still lacks what this one states.
    let (answer, _) = against(&without_inertials(&LINKS), ARM, &[]);
    assert_eq!(answer.code, 1);
}

#[test]
fn what_one_body_lacks_is_not_compared_and_the_rest_is() {
    let bare = without_inertials(&["first"]).replace("damping=\"0.5\"", "damping=\"0.7\"");
    let (answer, printed) = against(ARM, &bare, &[]);
    let report = answer.json();
    let compared = dynamics(&report);
    assert_eq!((answer.code, &compared["verdict"]), (1, &json!("explained")), "{printed}");
    assert_eq!(names(&compared["not_stated"]), ["masses of first"]);
    let [explanation] = &compared["explanations"].as_array().unwrap()[..] else { panic!("{compared:#}") };
    assert_eq!((&explanation["cause"], &explanation["place"]), (&json!("damping"), &json!(["lift"])));
}

#[test]
fn a_mass_on_a_frame_at_the_tip_is_a_payload() {
    // A link without mass that is fixed to one with a mass is a frame: that is a statement.
    let (answer, printed) = against(ARM, &without_inertials(&["tool"]), &[]);
    assert_eq!(answer.code, 1, "{printed}");
    let report = answer.json();
    let first = &dynamics(&report)["explanations"][0];
    assert_eq!((&first["cause"], &first["place"]), (&json!("payload"), &json!(["tool"])), "{printed}");
    // A point mass more on the tool: its mass, and the place and the tensor of both together.
    let heavier = with(
        "<origin xyz=\"0.01 0.02 0.03\"/><mass value=\"0.5\"/>\n<inertia ixx=\"0.001\" iyy=\"0.0012\" izz=\"0.0014\"",
        "<origin xyz=\"0.01 0.02 0.08\"/><mass value=\"1.0\"/>\n<inertia ixx=\"0.0035\" iyy=\"0.0037\" izz=\"0.0014\"",
    );
    let (answer, printed) = against(ARM, &heavier, &[]);
    let report = answer.json();
    let first = &dynamics(&report)["explanations"][0];
    assert_eq!((&first["cause"], &first["place"]), (&json!("payload"), &json!(["tool"])), "{printed}");
}

/// A description without the `<dynamics>` of its joints.
fn undamped(urdf: &str, dampings: &[&str]) -> String {
    dampings.iter().fold(urdf.to_owned(), |urdf, damping| {
        urdf.replace(&format!("<dynamics damping=\"{damping}\" friction=\"0\"/>"), "")
    })
}

#[test]
fn a_joint_without_dynamics_is_no_reference_for_damping() {
    let all = ["1", "0.5", "0.1"];
    for (masses, first) in [(without_inertials(&LINKS), Some("masses of all links")), (ARM.to_owned(), None)]
    {
        let silent = undamped(&masses, &all);
        let (answer, printed) = against(ARM, &silent, &[]);
        assert_eq!(answer.code, 0, "{printed}");
        let report = answer.json();
        let not_stated = names(&dynamics(&report)["not_stated"]);
        let expected: Vec<&str> =
            first.into_iter().chain(["damping and dry friction of all joints"]).collect();
        assert_eq!(not_stated, expected, "{printed}");
        assert!(!printed.contains("to write in"), "{printed}");
        let losses = printed.contains("SAME ROBOT, LOSSES NOT COMPARED");
        assert_eq!(losses, first.is_none(), "{printed}");
        // The other file still lacks what this one states.
        assert_eq!(against(&silent, ARM, &[]).0.code, 1);
        // A zero that is written is a statement.
        let zero = masses.replace("damping=\"1\"", "damping=\"0\"");
        assert_eq!(against(ARM, &zero, &[]).0.code, 1);
    }
    // One silent joint, and another that differs.
    let other = undamped(&with("damping=\"1\"", "damping=\"2\""), &["0.5"]);
    let (answer, printed) = against(ARM, &other, &[]);
    let report = answer.json();
    let compared = dynamics(&report);
    assert_eq!(names(&compared["not_stated"]), ["damping and dry friction of lift"], "{printed}");
    let [explanation] = &compared["explanations"].as_array().unwrap()[..] else { panic!("{compared:#}") };
    assert_eq!((&explanation["cause"], &explanation["place"]), (&json!("damping"), &json!(["turn"])));
    // A file in which most joints have no entry has no damping there by the default of the format, and so has the other.
    let (answer, printed) = against(&undamped(ARM, &["0.5", "0.1"]), &undamped(ARM, &all), &[]);
    let report = answer.json();
    let first = &dynamics(&report)["explanations"][0];
    assert_eq!((answer.code, &first["place"]), (1, &json!(["turn"])), "{printed}");
}

/// The arm with some mass on the axis of `bend` moved from the body behind this joint to the one before it.
fn split_otherwise() -> String {
    // 0.4 kg at the origin of the joint, (0.3, 0.03, 0.02) in the link before it: by hand, with Steiner's theorem.
    let com = |mass: f64, at: [f64; 3], more: f64, there: [f64; 3]| -> (f64, [f64; 3], [[f64; 3]; 3]) {
        let sum = mass + more;
        let com: [f64; 3] = std::array::from_fn(|axis| (mass * at[axis] + more * there[axis]) / sum);
        let about = |mass: f64, at: [f64; 3], row: usize, column: usize| {
            let square: f64 = at.iter().map(|at| at * at).sum();
            mass * (if row == column { square } else { 0.0 } - at[row] * at[column])
        };
        let shift = std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                about(mass, at, row, column) + about(more, there, row, column) - about(sum, com, row, column)
            })
        });
        (sum, com, shift)
    };
    let inertial = |(mass, com, shift): (f64, [f64; 3], [[f64; 3]; 3]), tensor: [f64; 6]| {
        let [xx, yy, zz, xy, xz, yz] = tensor;
        let xyz = com.map(|of| format!("{of:?}")).join(" ");
        format!(
            "<inertial><origin xyz=\"{xyz}\"/><mass value=\"{mass:?}\"/>\n<inertia ixx=\"{:?}\" iyy=\"{:?}\" izz=\"{:?}\" \
             ixy=\"{:?}\" ixz=\"{:?}\" iyz=\"{:?}\"/></inertial></link>",
            xx + shift[0][0],
            yy + shift[1][1],
            zz + shift[2][2],
            xy + shift[0][1],
            xz + shift[0][2],
            yz + shift[1][2]
        )
    };
    let second = inertial(
        com(6.0, [0.1, -0.02, 0.03], 0.4, [0.3, 0.03, 0.02]),
        [0.1, 0.12, 0.15, 0.004, 0.006, -0.002],
    );
    let third =
        inertial(com(2.0, [0.02, 0.01, 0.05], -0.4, [0.0; 3]), [0.01, 0.012, 0.014, 0.001, 0.0002, 0.0003]);
    let mut urdf = ARM.to_owned();
    for (link, inertial) in [("second", second), ("third", third)] {
        let tag = format!("<link name=\"{link}\">");
        let from = urdf.find(&tag).unwrap() + tag.len();
        let to = from + urdf[from..].find("</link>").unwrap() + "</link>".len();
        urdf.replace_range(from..to, &inertial);
    }
    urdf
}

#[test]
fn what_an_unstated_mass_can_explain_is_no_difference() {
    let split = split_otherwise();
    let (answer, printed) = against(&split, ARM, &[]);
    let report = answer.json();
    assert_eq!((answer.code, &dynamics(&report)["verdict"]), (0, &json!("same_torques")), "{printed}");
    // With some masses on `third`, the rest of the file has the torques of the other one: nothing contradicts it.
    for lacking in ["second", "first"] {
        let other = without_inertials(&[lacking]);
        let (answer, printed) = against(&split, &other, &[]);
        assert_eq!(answer.code, 0, "{lacking}: {printed}");
        assert!(!printed.contains("to write in"), "{printed}");
        let not_stated = format!("masses of {lacking}");
        assert_eq!(names(&dynamics(&answer.json())["not_stated"]), [not_stated.as_str()], "{printed}");
    }
    // A difference that no masses there explain is one, with its cause.
    let other = without_inertials(&["second"]).replace("mass value=\"2\"", "mass value=\"2.5\"");
    let (answer, printed) = against(&split, &other, &[]);
    assert_eq!(answer.code, 1, "{printed}");
    let (answer, printed) = against(ARM, &other, &[]);
    let report = answer.json();
    let first = &dynamics(&report)["explanations"][0];
    assert_eq!((&first["cause"], &first["place"]), (&json!("mass"), &json!(["third"])), "{printed}");
}

#[test]
fn a_mass_of_zero_is_none() {
    let zero = with("<mass value=\"6\"/>", "<mass value=\"0\"/>").replace(
        "ixx=\"0.1\" iyy=\"0.12\" izz=\"0.15\" ixy=\"0.004\" ixz=\"0.006\" iyz=\"-0.002\"",
        "ixx=\"0\" iyy=\"0\" izz=\"0\" ixy=\"0\" ixz=\"0\" iyz=\"0\"",
    );
    let (answer, printed) = against(ARM, &zero, &[]);
    assert_eq!(answer.code, 0, "{printed}");
    assert!(printed.contains("masses of second (0 there, which is no mass)"), "{printed}");
}

#[test]
fn one_moment_is_named_alone_although_torques_show_few_of_its_body() {
    for (old, new) in [("izz=\"0.2\"", "izz=\"0.3\""), ("izz=\"0.2\"", "izz=\"0.31\"")] {
        let other = with(old, new);
        for (first, second) in [(ARM, other.as_str()), (other.as_str(), ARM)] {
            let (answer, printed) = against(first, second, &[]);
            let report = answer.json();
            let compared = dynamics(&report);
            let first = &compared["explanations"][0];
            assert_eq!(
                (&first["cause"], &first["detail"]),
                (&json!("inertia_entry"), &json!("izz")),
                "{printed}"
            );
            assert_eq!(first["figures"].as_array().unwrap().len(), 1, "{first:#}");
            assert!(!printed.contains("quarter"), "{printed}");
        }
    }
}

#[test]
fn a_range_that_differs_is_no_difference_of_dynamics() {
    let (answer, printed) = against(ARM, &with("lower=\"-2.5\"", "lower=\"-2.4\""), &[]);
    assert_eq!(answer.code, 1);
    assert!(printed.contains("SAME GEOMETRY AND DYNAMICS, DIFFERENT JOINT LIMITS"), "{printed}");
    assert!(
        printed.contains("  agree     dynamics of") && printed.contains("  disagree  joint limits of"),
        "{printed}"
    );
    assert!(!printed.contains("disagree  dynamics"), "{printed}");
    // Without masses in either file, nothing is said of torques.
    let bare = without_inertials(&LINKS);
    let (answer, printed) = against(&bare, &bare.replace("effort=\"50\"", "effort=\"51\""), &[]);
    assert_eq!(answer.code, 1);
    assert!(printed.contains("SAME GEOMETRY, DIFFERENT JOINT LIMITS"), "{printed}");
}

#[test]
fn a_named_tip_narrows_what_is_compared() {
    let gripping = ARM.replace("</robot>", FINGER);
    let (answer, printed) = against(&gripping, ARM, &[]);
    assert_eq!(answer.code, 1, "{printed}");
    for (first, second) in [(gripping.as_str(), ARM), (ARM, gripping.as_str())] {
        let (answer, printed) = against(first, second, &["--tip", "tool"]);
        let report = answer.json();
        assert_eq!((answer.code, &report["verdict"]), (0, &json!("agree")), "{printed}");
        assert_eq!(names(&report["against"]["joints_left_out"]), ["grip"]);
        assert_eq!(dynamics(&report)["verdict"], "same");
        assert!(report["comparisons"].as_array().unwrap().iter().any(|of| of["name"] == "urdf_other"));
        let longer = with("xyz=\"0.3 0.03 0.02\"", "xyz=\"0.31 0.03 0.02\"");
        let longer = if first == ARM { longer } else { longer.replace("</robot>", FINGER) };
        assert_eq!(against(&longer, second, &["--tip", "tool"]).0.code, 1);
    }
}

/// The same axes with other frames, of links that are only names: what a table says of a robot.
#[test]
fn frames_of_links_that_are_names_may_lie_anywhere() {
    let names_only = without_inertials(&LINKS);
    // The frame of `second` is 50 mm further along its axis, and that of `first` is turned about its own.
    let elsewhere = names_only
        .replace("xyz=\"0 0 0.1\"/><axis xyz=\"0 0 1\"", "xyz=\"0 0 0.3\"/><axis xyz=\"0 0 1\"")
        .replace("xyz=\"0.1 0 0.4\"", "xyz=\"0.1 0.05 0.2\"")
        .replace("xyz=\"0.3 0.03 0.02\"", "xyz=\"0.3 -0.02 0.02\"");
    assert_ne!(elsewhere, names_only);
    let (answer, printed) = against(ARM, &elsewhere, &[]);
    assert_eq!(answer.code, 0, "{printed}");
    assert!(printed.contains("the frames of first, second are placed differently"), "{printed}");
    // One that has a shape there is where its file says.
    let shape = "<link name=\"first\"><visual><geometry><sphere radius=\"0.1\"/></geometry></visual></link>";
    let (answer, _) = against(ARM, &elsewhere.replace("<link name=\"first\"></link>", shape), &[]);
    assert_eq!(answer.code, 1);
    // A wrong length moves the tip.
    let (answer, _) = against(ARM, &elsewhere.replace("0.3 -0.02 0.02", "0.3 -0.02 0.03"), &[]);
    assert_eq!(answer.code, 1);
}

/// The tip is what is asked about: a file in which its link has another name has it compared by its fixed joint, and
/// refused if nothing shows which link is meant.
#[test]
fn a_tip_under_another_name_is_compared_or_refused() {
    let renamed = ARM.replace("\"tool\"", "\"gripper_tcp\"");
    let moved = renamed.replace(
        "<origin xyz=\"0 0 0.1\"/></joint>\n</robot>",
        "<origin xyz=\"0 0 0.2\"/></joint>\n</robot>",
    );
    assert_ne!(renamed, moved);
    assert_eq!(against(ARM, &renamed, &[]).0.code, 0);
    let (answer, printed) = against(ARM, &moved, &["--tip", "tool"]);
    assert_eq!(answer.code, 1, "{printed}");
    assert!(printed.contains("DIFFERENT, by up to 100 mm at tool"), "{printed}");
    let elsewhere = renamed.replace("\"mount\"", "\"screws\"");
    let (answer, printed) = against(ARM, &elsewhere, &["--tip", "tool"]);
    assert_eq!(answer.code, 1, "{printed}");
    assert!(printed.contains("the other description has no link \"tool\", which is the tip"), "{printed}");
    // Nobody has named the tip: the rest is compared, and the answer says so.
    let (answer, printed) = against(ARM, &elsewhere, &[]);
    assert_eq!(answer.json()["against"]["links_not_found"], json!(["tool"]));
    assert!(printed.contains(" without the tip \"tool\" (in one file alone)"), "{printed}");
}

/// A speed limit that one file alone states at every joint is one line; neither of two files is the expected one.
#[test]
fn limits_and_masses_of_two_files_have_the_values_of_both() {
    let silent = ARM.replace(" velocity=\"1.5\"", "").replace("<mass value=\"2\"/>", "<mass value=\"2.5\"/>");
    let (answer, printed) = against(ARM, &silent, &[]);
    assert_eq!(answer.code, 1, "{printed}");
    let one_sided: Vec<&str> = printed.lines().filter(|line| line.contains("velocity limit")).collect();
    let [line] = one_sided[..] else { panic!("{printed}") };
    let start = "  not compared: velocity limits of 3 joints, stated by ";
    assert!(line.starts_with(start) && line.contains("one.urdf alone"), "{line}");
    assert!(line.ends_with(": turn, lift, bend"), "{line}");
    let mass = printed.lines().find(|line| line.contains("total mass")).unwrap();
    assert!(mass.starts_with("    total mass 18.5 kg, 19 kg in ") && mass.ends_with("other.urdf"), "{mass}");
    assert!(!printed.contains("expected"), "{printed}");
    // One that both state is named with its line in both, and no factor.
    let limit = "<limit lower=\"-2\" upper=\"2\" velocity=\"1.5\" effort=\"50\"/>";
    let (answer, printed) = against(ARM, &with(limit, &limit.replace("50", "40")), &[]);
    assert_eq!(answer.code, 1, "{printed}");
    let line = printed.lines().find(|line| line.contains("    bend: effort limit ")).unwrap();
    assert!(line.contains(" 50 N m in ") && line.contains("one.urdf:16, 40 N m in "), "{line}");
    assert!(line.ends_with("other.urdf:16") && !printed.contains("factor"), "{printed}");
}

/// A mass above a vertical first axis, through its centre of mass, is in no torque: the first line says that it differs.
#[test]
fn a_mass_without_effect_on_torques_is_in_the_first_line() {
    let centred = ARM.replace("<origin xyz=\"0.05 0.02 0.2\"/>", "<origin xyz=\"0 0 0.2\"/>");
    let (answer, printed) =
        against(&centred, &centred.replace("<mass value=\"10\"/>", "<mass value=\"100\"/>"), &[]);
    assert_eq!(answer.code, 0, "{printed}");
    let first = printed.lines().next().unwrap();
    assert!(first.contains("; without effect on torques: first: mass 10 kg in "), "{first}");
}
