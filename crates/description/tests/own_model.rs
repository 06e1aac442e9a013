//! Robot files whose table or screws are the robot: what is made of them, and what is refused at which line.

use std::fs;

use congruent_description::{JointKind, JointRounding, OwnModelForm, Robot, RobotDescription, load_robot};
use congruent_input::Findings;

fn load(text: &str) -> Result<RobotDescription, Findings> {
    let folder = tempfile::tempdir().expect("a folder for the file");
    let path = folder.path().join("arm.toml");
    fs::write(&path, text).expect("it can be written");
    load_robot(&path)
}

#[track_caller]
fn refused(text: &str, line: usize, message: &str, help: &str) {
    let found = load(text).expect_err(text);
    let words = format!("{found:#?}");
    let fault =
        found.iter().find(|fault| fault.message.contains(message)).unwrap_or_else(|| panic!("{words}"));
    assert_eq!(fault.line_column().map(|(line, _)| line), Some(line), "{words}");
    assert!(fault.help.as_deref().unwrap_or_default().contains(help), "{words}");
}

const TABLE: &str = "tip = 'flange'
[dh]
convention = 'standard'
[[dh.row]]
joint = 'turn'
kind = 'revolute'
a_m = 0.3
alpha_deg = 90
d_mm = 200
[[dh.row]]
joint = 'slide'
kind = 'prismatic'
a_m = 0
alpha_deg = 0
d_m = 0.1
range_mm = [0, 50]
";

const SCREWS: &str = "[poe]
frame = 'space'
home = { xyz_m = [0.6, 0, 0.1] }
[[poe.joint]]
joint = 'turn'
kind = 'revolute'
omega = [0, 0, 1]
v_m = [0, -0.3, 0]
range_deg = [-90, 90]
[[poe.joint]]
joint = 'slide'
kind = 'prismatic'
axis = [0, 0, 1]
";

#[test]
fn a_table_is_a_robot() {
    let arm = load(TABLE).expect("it is one");
    assert_eq!((arm.name.as_str(), arm.own_model()), ("arm", Some(OwnModelForm::Table)));
    let links: Vec<&str> = arm.robot.links().iter().map(|link| link.name.as_str()).collect();
    assert_eq!(links, ["base", "turn_link", "slide_link", "flange"]);
    let joints = arm.robot.joints();
    assert_eq!(joints[0].kind, JointKind::Continuous);
    // A short slide at the end is no gripper here: the chain goes on to the tip.
    assert_eq!((joints[1].kind, joints[1].position_range()), (JointKind::Prismatic, Some((0.0, 0.05))));
    assert_eq!(arm.robot.link(arm.tip).name, "flange");
    // z of the first frame, turned by alpha about x, is -y.
    assert!((joints[1].axis_in_joint.into_inner() + nalgebra::Vector3::y()).norm() < 1e-15);
}

#[test]
fn screws_are_a_robot() {
    let arm = load(SCREWS).expect("it is one");
    assert_eq!(arm.own_model(), Some(OwnModelForm::Screws));
    let turn = &arm.robot.joints()[0];
    assert_eq!(turn.kind, JointKind::Revolute);
    assert_eq!(turn.position_range(), Some((-90_f64.to_radians(), 90_f64.to_radians())));
    assert_eq!(turn.parent_from_joint.translation.vector, nalgebra::Vector3::new(0.3, 0.0, 0.0));
    let by_point =
        SCREWS.replace("omega = [0, 0, 1]\nv_m = [0, -0.3, 0]", "axis = [0, 0, 1]\npoint_mm = [300, 0, 7]");
    assert_eq!(exact(&load(&by_point).expect("it is one").robot), exact(&arm.robot));
}

/// Links and joints alone: a point opens something else than a moment.
fn exact(robot: &Robot) -> Robot {
    robot.with_joints(|joint| joint.rounding = JointRounding::default())
}

#[test]
fn the_digits_of_a_row_move_the_axes_behind_it() {
    let arm = load(&TABLE.replace("d_m = 0.1", "d_m = 0.123")).expect("it is one");
    let [turn, slide, tip] = [0, 1, 2].map(|at| arm.robot.joints()[at].rounding.clone());
    assert_eq!(turn, JointRounding { form: turn.form, ..JointRounding::default() });
    // a = 0.3 m and d = 200 mm of the first row have lost their zeros: they are as fine as 0.123 m of the second.
    let sizes =
        |of: &JointRounding| of.origin.iter().map(|motion| motion.linear_m.norm()).collect::<Vec<_>>();
    assert_eq!(sizes(&slide), [5e-4, 5e-4]);
    // A zero is off by less, and whole degrees are exact.
    assert_eq!(sizes(&tip), [5e-4, 5e-5]);
    assert!(slide.axis.is_empty() && slide.origin.iter().all(|motion| motion.angular_rad.norm() == 0.0));
}

#[test]
fn the_digits_of_a_screw_move_its_axis_alone() {
    let text = SCREWS
        .replace("[0, -0.3, 0]", "[0, -0.312, 0.0003]")
        .replace("[0, 0, 1]\nv", "[0, 0.0008, 0.99999968]\nv");
    let arm = load(&text).expect("a pitch of 0.05 mm per radian is within the digits of v");
    let turn = &arm.robot.joints()[0].rounding;
    assert!(turn.origin.is_empty() && turn.axis.len() >= 3, "{turn:?}");
    // A direction of four digits is of length 1 within these.
    load(&SCREWS.replace("axis = [0, 0, 1]", "axis = [0.8660, 0.5000, 0]")).expect("it is one");
    // In the tip, all axes lie where its digits place it.
    let in_tip = load(&SCREWS.replace("'space'", "'body'").replace("0.6, 0, 0.1", "0.612, 0, 0.1"))
        .expect("it is one");
    let joints = in_tip.robot.joints();
    assert_eq!((joints[0].rounding.origin.len(), joints[2].rounding.origin.len()), (3, 0));
    assert_eq!(arm.robot.joints()[2].rounding.origin.len(), 3);
}

#[test]
fn wrong_screws_are_refused_at_their_line() {
    for (from, to, line, message, help) in [
        ("omega = [0, 0, 1]", "omega = [0, 0, 2]", 7, "omega has length 2.000000", "omega = [0.0, 0.0, 1.0]"),
        ("omega = [0, 0, 1]", "omega = [0, 0, 0]", 7, "its omega is 0", "prismatic"),
        ("omega = [0, 0, 1]", "omega = [0, 0, nan]", 7, "omega is NaN", "finite"),
        ("omega = [0, 0, 1]\n", "", 5, "has no omega", "direction of its axis"),
        ("[0, -0.3, 0]", "[0, -0.3, 0.05]", 8, "advances by 50 mm per radian", "v_m = [0.0, -0.3, 0.0]"),
        ("axis = [0, 0, 1]", "omega = [0, 1, 0]\nv_m = [0, 0, 1]", 13, "its omega is not 0", "revolute"),
        ("axis = [0, 0, 1]", "axis = [0, 0, 1]\npoint_m = [0, 0, 0]", 11, "has no meaning", "remove"),
        ("axis = [0, 0, 1]", "axis = [0, 0, 1]\nv_m = [0, 0, 1]", 11, "both an axis and a twist", "keep"),
        ("axis = [0, 0, 1]", "range_m = [0, 1]", 11, "has no screw", "omega"),
        ("[-90, 90]", "[90, -90]", 9, "has no positions", "lowest"),
        ("range_deg = [-90, 90]", "range_m = [-1, 1]", 9, "\"turn\" turns", "range_rad or range_deg"),
        ("'slide'", "'turn'", 11, "two joints are called \"turn\" (lines 5 and 11)", "one name"),
        ("frame = 'space'\n", "", 1, "\"frame\"", "\"body\""),
    ] {
        refused(&SCREWS.replacen(from, to, 1), line, message, help);
    }
}

#[test]
fn two_models_and_keys_of_a_urdf_are_refused() {
    refused(&format!("{TABLE}{SCREWS}"), 18, "both a table ([dh]) and screws ([poe])", "--against");
    refused(&format!("srdf = 'a.srdf'\n{TABLE}"), 1, "srdf needs a URDF", "urdf = ");
    refused(&format!("urdf = 'arm.urdf'\nbase = 'x'\n{TABLE}"), 1, "does not exist", "relative");
    refused(
        &TABLE.replace("kind = 'revolute'\n", "kind = 'revolute'\nrange_deg = [1]\n"),
        7,
        "array of 2",
        "",
    );
    refused("name = 'empty'\n[dh]\nconvention = 'standard'\n", 2, "no [[dh.row]]", "row for each joint");
    refused(&TABLE.replace("tip = 'flange'", "tip = 'turn_link'"), 1, "duplicate link name", "other names");
    refused(&TABLE.replace("d_mm = 200\n", ""), 4, "has neither d_m nor d_mm", "");
}

#[test]
fn a_file_with_a_urdf_has_neither_screws_nor_ranges() {
    let folder = tempfile::tempdir().expect("a folder for the files");
    let urdf = "<robot name='r'><link name='base'/><link name='flange'/><joint name='turn' type='continuous'>\
                <parent link='base'/><child link='flange'/></joint></robot>";
    fs::write(folder.path().join("r.urdf"), urdf).expect("it can be written");
    let path = folder.path().join("robot.toml");
    let row = "[dh]\nconvention = 'standard'\nrow = [{ joint = 'turn', kind = 'revolute', a_m = 0, alpha_deg = 0, d_m = 0, range_deg = [0, 1] }]\n";
    for (text, message) in [(SCREWS, "[poe] takes the place of a URDF"), (row, "is that of the URDF")] {
        fs::write(&path, format!("urdf = 'r.urdf'\n{text}")).expect("it can be written");
        let found = load_robot(&path).expect_err(message);
        assert!(found.iter().any(|fault| fault.message.contains(message)), "{found:#?}");
    }
}
