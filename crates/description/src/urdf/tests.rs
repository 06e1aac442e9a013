//! URDF documents with one fault each, and good ones that must not be refused.

#![expect(clippy::float_cmp, reason = "values must arrive as they are written")]

use std::f64::consts::FRAC_PI_2;

use congruent_input::{Capability, Severity, line_column};
use congruent_robot::{Geometry, JointKind};
use nalgebra::{Point3, Vector3};

use super::*;

/// Two links and a joint, each with a place for more.
pub(super) fn arm(joint: &str, link: &str) -> String {
    format!(
        r#"<robot name="arm">
<link name="base"/>
<joint name="j" type="revolute">
<parent link="base"/><child link="tip"/>
{joint}
</joint>
<link name="tip">
{link}
</link>
</robot>"#
    )
}

pub(super) const LIMIT: &str = r#"<limit lower="-1" upper="2" effort="3" velocity="4"/>"#;
pub(super) const INERTIAL: &str =
    r#"<inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"#;

pub(super) fn read(text: &str) -> (Option<Robot>, Vec<Diagnostic>) {
    let mut diagnostics = Diagnostics::default();
    let mut no_mesh =
        |uri: &str, _| Err(Diagnostic::error(congruent_meshes::codes::mesh::EMPTY, format!("no mesh {uri}")));
    let inputs = UrdfInputs { find_mesh: &mut no_mesh, repairs: &Repairs::default() };
    let robot = parse(text, inputs, &mut diagnostics);
    (robot, diagnostics.into_vec())
}

#[track_caller]
pub(super) fn good(text: &str) -> Robot {
    let (robot, diagnostics) = read(text);
    assert_eq!(diagnostics, []);
    robot.unwrap()
}

/// The text has exactly this diagnostic, on this line.
#[track_caller]
fn one(text: &str, severity: Severity, line: usize, code: &str, message: &str) {
    let (robot, diagnostics) = read(text);
    let [found] = &diagnostics[..] else { panic!("{diagnostics:#?}") };
    assert_eq!((found.severity, found.code.name), (severity, code), "{}", found.message);
    assert!(found.message.contains(message), "{}", found.message);
    assert_eq!(line_column(text, found.span.as_ref().unwrap().start).0, line);
    assert_eq!(robot.is_some(), severity == Severity::Warning);
}

#[track_caller]
fn joint_error(joint: &str, code: &str, message: &str) {
    one(&arm(joint, INERTIAL), Severity::Error, 5, code, message);
}

#[track_caller]
fn joint_warning(joint: &str, code: &str, message: &str) {
    one(&arm(joint, INERTIAL), Severity::Warning, 5, code, message);
}

/// The text has exactly this finding, which stops this use and no other.
#[track_caller]
pub(super) fn stops(
    text: &str,
    line: usize,
    stopped: Option<Capability>,
    code: &str,
    message: &str,
) -> Robot {
    one(text, Severity::Warning, line, code, message);
    let (robot, found) = read(text);
    assert_eq!(found[0].stops, stopped, "{}", found[0].message);
    robot.unwrap()
}

/// Elements beside a good inertial.
#[track_caller]
fn link_stops(link: &str, stopped: Option<Capability>, code: &str, message: &str) -> Robot {
    stops(&arm(LIMIT, &format!("{link}{INERTIAL}")), 8, stopped, code, message)
}

#[track_caller]
pub(super) fn joint_stops(joint: &str, stopped: Option<Capability>, code: &str, message: &str) -> Robot {
    stops(&arm(joint, INERTIAL), 5, stopped, code, message)
}

#[test]
fn every_value_arrives() {
    let joint = format!(
        r#"{LIMIT}<origin rpy="0 0 {FRAC_PI_2}" xyz="1 2 3"/><axis xyz="0 -1 0"/><dynamics damping="0.5" friction="0.25"/>"#
    );
    let visual = r#"<visual><origin xyz="0 0 1"/><geometry><box size="1 2 3"/></geometry><material name="red"/></visual>"#;
    let text = arm(&joint, &format!("{INERTIAL}{visual}"))
        .replace("</robot>", r#"<material name="red"><color rgba="1 0 0 1"/></material></robot>"#);
    let robot = good(&text);
    let joint = &robot.joints()[0];
    assert_eq!(joint.kind, JointKind::Revolute);
    assert_eq!(joint.position_range(), Some((-1.0, 2.0)));
    assert_eq!((joint.damping, joint.friction), (0.5, 0.25));
    assert_eq!(joint.axis_in_joint.into_inner(), -Vector3::y());
    let turned = joint.parent_from_joint * Point3::new(1.0, 0.0, 0.0);
    assert!((turned - Point3::new(1.0, 3.0, 3.0)).norm() < 1e-15, "a quarter turn rounds once: {turned}");
    let tip = &robot.links()[1];
    assert_eq!(tip.inertia.unwrap().mass_kg, 2.0);
    assert_eq!(tip.visuals[0].color_rgba, Some([1.0, 0.0, 0.0, 1.0]));
    assert_eq!(tip.visuals[0].geometry, Geometry::Box { size_m: Vector3::new(1.0, 2.0, 3.0) });
    assert_eq!(tip.visuals[0].link_from_shape.translation.z, 1.0);
}

#[test]
fn what_real_files_hold_is_no_fault() {
    good(
        &arm(LIMIT, &format!("{INERTIAL} &gt; stray text"))
            .replace("<mass value=\"2\"/>", "<mass value=\"2\">a<!-- b --><![CDATA[c]]></mass>"),
    );
    good(&arm(&format!("{LIMIT}<dynamics damping='1' D='2' K='3' mu_viscous='0'/>"), INERTIAL));
    good(&arm(
        LIMIT,
        &format!(
            "{INERTIAL}<self_collision_checking><geometry><capsule/></geometry></self_collision_checking>"
        ),
    ));
    good(&arm(&format!("{LIMIT}<axis xyz='0.7071067 0.7071067 0'/>"), INERTIAL));
    good(&arm(&format!("{LIMIT}<safety_controller k_velocity='1'/>"), INERTIAL));
    good(&arm(LIMIT, INERTIAL).replace("</robot>", "<gazebo><a b='$(find x)'/></gazebo></robot>"));
    good(&arm("<axis xyz='0 0 0'/><limit effort='0' velocity='0'/>", "").replace("revolute", "fixed"));
    good(
        &arm("<limit lower='0' upper='0' effort='1' velocity='1'/>", INERTIAL)
            .replace("revolute", "continuous"),
    );
}

#[test]
fn joints_are_checked() {
    let absurd = format!("{LIMIT}<mimic joint='k' multiplier='1e300'/>");
    // The joint that it mimics is missing, too.
    let found = read(&arm(&absurd, INERTIAL)).1;
    let names: Vec<&str> = found.iter().map(|found| found.code.name).collect();
    assert_eq!(names[0], "urdf::number", "{found:#?}");
    assert!(found[0].message.contains("mimic: multiplier 1e300, limit <= 1e6"), "{}", found[0].message);
    joint_error("<limits lower='0'/>", "urdf::unknown_element", "did you mean <limit>?");
    joint_error(
        "<limit lower='1' upper='0' effort='1' velocity='1'/>",
        "urdf::limit",
        "lower limit 1 is above upper limit 0",
    );
    joint_error(
        "<limit lower='0' upper='1e308' effort='1' velocity='1'/>",
        "urdf::limit",
        "limit 1e308 is too large: poses are computed up to 1e30",
    );
    joint_error(&format!("{LIMIT}<axis xyz='0 0 0'/>"), "urdf::axis", "zero vector");
    joint_error(&format!("{LIMIT}<axis xyz='1.7e308 1.7e308 0'/>"), "urdf::axis", "its length overflows");
    joint_error(
        &format!("{LIMIT}<axis xzy='0 0 1' xyz='0 0 1'/>"),
        "urdf::unknown_attribute",
        "did you mean \"xyz\"?",
    );
    joint_error(&format!("{LIMIT}<axis xyz='0 0'/>"), "urdf::number", "expected 3 numbers, found 2");
    joint_error(&format!("{LIMIT}{LIMIT}"), "urdf::repeated_element", "<limit> is given twice");
    joint_error(&format!("{LIMIT}<mimic joint='j'/>"), "urdf::tree", "mimics itself");
    joint_error(&format!("{LIMIT}<mimic joint='k'/>"), "urdf::tree", "mimicked joint \"k\" not found");
    let text = arm("", INERTIAL);
    one(&text, Severity::Error, 3, "urdf::limit", "a revolute joint needs <limit> (or type \"continuous\")");
    one(
        &text.replace("revolute", "planar"),
        Severity::Error,
        3,
        "urdf::joint_type",
        "\"planar\" is not supported",
    );
    one(
        &text.replace("<parent link=\"base\"/>", ""),
        Severity::Error,
        3,
        "urdf::missing_element",
        "missing <parent>",
    );
    one(
        &arm(LIMIT, INERTIAL).replace("link=\"tip\"", "link=\"tap\""),
        Severity::Error,
        4,
        "urdf::tree",
        "child link \"tap\" not found",
    );
}

#[test]
fn suspicious_joints_are_warned_of() {
    joint_warning(
        &format!("{LIMIT}<axis xyz='0 0 2'/>"),
        "urdf::axis",
        "axis has length 2 and is normalised to 1",
    );
    joint_warning(
        "<limit upper='1' effort='1' velocity='1'/>",
        "urdf::limit",
        "<limit> has no lower, which counts as 0",
    );
    joint_warning(
        "<limit lower='1' upper='1' effort='1' velocity='1'/>",
        "urdf::limit",
        "lower and upper limit are both 1: the joint cannot move",
    );
    joint_warning(
        "<limit lower='-90' upper='90' effort='1' velocity='1'/>",
        "urdf::degrees",
        "degrees instead",
    );
    joint_warning(&format!("{LIMIT}<origin rpy='0 90 0'/>"), "urdf::degrees", "rpy 90");
    joint_warning(&format!("{LIMIT}<origin xyz='0 0 400'/>"), "urdf::millimetres", "origin 400");
    one(&arm(LIMIT, ""), Severity::Warning, 7, "urdf::massless", "link \"tip\" moves but has no <inertial>");
    let text = arm(LIMIT, INERTIAL).replace("revolute", "continuous");
    one(&text, Severity::Warning, 5, "urdf::limit", "ignores the limits");
}

/// Squares of entries this large or small are not numbers any more.
#[test]
fn an_axis_of_any_length_keeps_its_direction() {
    for axis in ["3e307 4e307 0", "3e160 4e160 0", "3e-170 4e-170 0", "3e-310 4e-310 0"] {
        let (robot, diagnostics) = read(&arm(&format!("{LIMIT}<axis xyz='{axis}'/>"), INERTIAL));
        assert!(diagnostics.iter().all(|diagnostic| diagnostic.message.contains("is normalised to 1")));
        let axis = robot.unwrap().joints()[0].axis_in_joint;
        assert!((axis.into_inner() - Vector3::new(0.6, 0.8, 0.0)).norm() < 1e-12, "{axis:?}");
    }
}

#[test]
fn quaternions_need_version_1_1_and_keep_their_digits() {
    // So near a pitch of a quarter turn that angles would lose it.
    let text =
        arm(&format!("{LIMIT}<origin quat_xyzw='0 0.706825181105366 0 0.7073882691671998'/>"), INERTIAL);
    one(&text, Severity::Error, 5, "urdf::quaternion", "needs <robot version=\"1.1\">");
    let robot = good(&text.replace("<robot ", "<robot version='1.1' "));
    let rotation = robot.joints()[0].parent_from_joint.rotation;
    assert!((rotation.angle() - 1.57).abs() < 1e-15, "rounding of an arc tangent: {rotation}");
}

#[test]
fn escaped_names_arrive() {
    let text = arm(LIMIT, INERTIAL).replace("\"tip\"", "\"a&lt;b&amp;&quot;&#x41;\"");
    assert_eq!(good(&text).links()[1].name, "a<b&\"A");
}

/// Half a metre of cylinder with ends of 0.1 m reaches 0.35 m from its middle, turned and shifted as its element.
#[test]
fn a_capsule_is_a_cylinder_with_round_ends() {
    let capsule = "<collision><origin xyz='1 0 0' rpy='0 1.5707963267948966 0'/><geometry><capsule radius='0.1' length='0.5'/>";
    let robot = good(&arm(LIMIT, &format!("{INERTIAL}{capsule}</geometry></collision>")));
    let [middle, low, high] = &robot.links()[1].collisions[..] else { panic!("{robot:#?}") };
    assert_eq!(middle.geometry, Geometry::Cylinder { radius_m: 0.1, length_m: 0.5 });
    for (end, x_m) in [(low, 0.75), (high, 1.25)] {
        assert_eq!(end.geometry, Geometry::Sphere { radius_m: 0.1 });
        assert!((end.link_from_shape.translation.vector - Vector3::new(x_m, 0.0, 0.0)).norm() < 1e-15);
    }
}

#[test]
fn shapes_are_checked() {
    let shape = |shape: &str| format!("<collision><geometry>{shape}</geometry></collision>");
    for (shape, code, message) in [
        (shape(""), "urdf::geometry", "<geometry> has no shape"),
        (shape("<box size='1 0 1'/>"), "urdf::geometry", "box size 0 must be positive"),
        (shape("<box size='1 1'/>"), "urdf::number", "expected 3 numbers, found 2"),
        (shape("<cylinder radius='-1' length='1'/>"), "urdf::geometry", "cylinder radius -1"),
        (shape("<capsule radius='0' length='1'/>"), "urdf::geometry", "capsule radius 0 must be positive"),
        (shape("<sphere radius='1'/><box size='1 1 1'/>"), "urdf::geometry", "more than one shape"),
        (shape("<mesh filename='a.stl' scale='0 1 1'/>"), "urdf::scale", "flattens"),
        (shape("<mesh filename='a.stl'/>"), "mesh::empty", "link \"tip\": no mesh a.stl"),
        ("<colision/>".to_owned(), "urdf::unknown_element", "did you mean <collision>?"),
        ("<collision/>".to_owned(), "urdf::missing_element", "<collision> has no <geometry>"),
    ] {
        let robot = link_stops(&shape, Some(Capability::Clearance), code, message);
        assert_eq!(robot.links()[1].collisions, [], "{shape}");
        // What is only drawn stops nothing.
        let drawn = shape.replace("collision", "visual").replace("colision", "visaul");
        let robot = link_stops(&drawn, None, code, &message.replace("collision", "visual"));
        assert_eq!(robot.links()[1].visuals, [], "{drawn}");
    }
}

#[test]
fn what_is_drawn_keeps_what_can_be_read_of_it() {
    let visual =
        |material: &str| format!("<visual><geometry><sphere radius='1'/></geometry>{material}</visual>");
    let red = "<color rgba='1 0 0 1'/>";
    let cases = [
        (format!("<material name='m'>{red}<texture/></material>"), "<texture> has no filename", true),
        ("<material name='m'><color rgba='1 0 0'/></material>".to_owned(), "expected 4 numbers", false),
        ("<material name='m'><color rgba='a 0 0 1'/></material>".to_owned(), "\"a\" is not a number", false),
        (format!("<material>{red}</material>"), "<material> has no name", false),
    ];
    for (material, message, is_red) in cases {
        let (robot, found) = read(&arm(LIMIT, &format!("{}{INERTIAL}", visual(&material))));
        assert_eq!(found.len(), 1, "{found:#?}");
        assert!(found[0].message.contains(message) && found[0].stops.is_none(), "{found:#?}");
        let color = robot.unwrap().links()[1].visuals[0].color_rgba;
        assert_eq!(color.is_some(), is_red, "{material}");
    }
}

#[test]
fn forces_need_what_kinematics_does_not() {
    let physics = Some(Capability::Physics);
    let limit = |rest: &str| format!("<limit lower='0' upper='1' {rest}/>");
    let of = |robot: Robot| robot.joints()[0].limit.unwrap();
    let read = of(joint_stops(
        &limit("effort='1'"),
        None,
        "urdf::missing_attribute",
        "<limit> has no velocity: it is taken as unlimited",
    ));
    assert_eq!((read.effort, read.velocity, read.upper), (Some(1.0), None, 1.0));
    let read = of(joint_stops(&limit("effort='many' velocity='1'"), physics, "urdf::number", "\"many\""));
    assert_eq!((read.effort, read.velocity), (None, Some(1.0)));
    joint_stops(&limit("effort='-1' velocity='1'"), physics, "urdf::limit", "effort -1 is negative");
    joint_stops(&format!("{LIMIT}<dynamics damping='-1'/>"), physics, "urdf::dynamics", "damping -1");
    joint_stops(&format!("{LIMIT}<dynamics damping='a'/>"), physics, "urdf::number", "\"a\" is not");
    joint_stops(&format!("{LIMIT}<safety_controller/>"), None, "urdf::missing_attribute", "k_velocity");
    // A fixed joint needs none of it.
    good(&arm("<limit lower='0' upper='1'/>", "").replace("revolute", "fixed"));
}

#[test]
fn an_inertial_that_cannot_be_read_is_none() {
    for (inertial, code, message) in [
        (INERTIAL.replace("\"2\"", "\"2kg\""), "urdf::number", "\"2kg\" is not a number"),
        (INERTIAL.replace("<mass value=\"2\"/>", ""), "urdf::missing_element", "<inertial> has no <mass>"),
        (INERTIAL.replace("izz", "izzz"), "urdf::unknown_attribute", "did you mean \"izz\"?"),
        (format!("{INERTIAL}{INERTIAL}"), "urdf::repeated_element", "<inertial> is given twice"),
    ] {
        let (robot, found) = read(&arm(LIMIT, &inertial));
        let found =
            found.iter().find(|found| found.code.name == code).unwrap_or_else(|| panic!("{found:#?}"));
        assert!(found.stops == Some(Capability::Physics) && found.message.contains(message), "{found:#?}");
        assert_eq!(robot.unwrap().links()[1].inertia, None);
    }
}

#[test]
fn all_faults_of_a_pass_are_found_at_once() {
    let (_, diagnostics) =
        read(&arm("<limit lower='a' upper='1e400' effort='nan' velocity='1,5'/>", "<mass/>"));
    assert_eq!(diagnostics.len(), 4, "{diagnostics:#?}");
}

#[test]
fn other_formats_are_recognised() {
    let refused = |text: &str, code, message: &str| one(text, Severity::Error, 1, code, message);
    refused("<sdf version='1.9'/>", "urdf::root", "SDF");
    refused("<mujoco/>", "urdf::root", "MuJoCo");
    refused("<robot name='a'><xacro:macro/></robot>", "urdf::xacro", "unexpanded xacro");
    refused(
        "<robot name='a' xmlns:xacro='http://ros.org/wiki/xacro'><xacro:m/></robot>",
        "urdf::xacro",
        "<xacro:m>",
    );
    refused("<robot name='a'><link name='${b}'/></robot>", "urdf::xacro", "name = \"${b}\"");
    refused("<robot name='a'/>", "urdf::tree", "no link");
    refused("", "xml::malformed", "no XML element");
    good("<robot name='a' xmlns:xacro='http://ros.org/wiki/xacro'><link name='b'/></robot>");
}

#[test]
fn text_cut_at_any_byte_never_panics() {
    let whole = arm(&format!("{LIMIT}<origin rpy='0 0 1'/>"), &format!("é{INERTIAL}"));
    for end in (0..whole.len()).filter(|&end| whole.is_char_boundary(end)) {
        assert!(read(&whole[..end]).0.is_none(), "{end}");
    }
}

#[test]
fn names_are_shown_as_they_are() {
    let good = arm(LIMIT, INERTIAL);
    let name = r#"<link name="base""#;
    assert!(good.contains(name), "{good}");
    for (hidden, said) in [("&#10;", r"\n"), ("\u{202e}", r"\u{202e}"), ("\u{9b}", r"\u{9b}")] {
        let (robot, found) = read(&good.replace(name, &format!("<link name=\"a{hidden}b\"")));
        let first = &found[0];
        assert_eq!(
            (robot, first.severity, first.code.name),
            (None, Severity::Error, "urdf::hidden_character")
        );
        assert!(first.message.contains(&format!(r#"link "a{said}b": <link> name = "a{said}b""#)), "{first}");
    }
    // What kinematics can do without stops what needs it.
    let mesh =
        "<visual><geometry><mesh filename=\"a&#27;.stl\"/></geometry></visual>".replace("&#27;", "\u{85}");
    let (robot, found) = read(&arm(LIMIT, &format!("{mesh}{INERTIAL}")));
    assert!(robot.is_some() && found[0].code.name == "urdf::hidden_character", "{found:#?}");
}
