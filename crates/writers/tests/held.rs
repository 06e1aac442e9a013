//! What each format holds and what it cannot: small robots, a thing or two each, written and read back.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

use std::sync::Arc;

use congruent_description::{JointKind, Robot, RobotDescription, parse_robot};
use congruent_input::{FileAccess, SourceFile};
use congruent_writers::{ReadBack, ReadBackReport, RobotFormat, RobotText, read_back, robot_text};

/// Rounding of poses within some metres and of tensors that are turned once; worst seen 2e-15.
const LIMIT: f64 = 1e-12;

fn described(text: &str) -> RobotDescription {
    let source = SourceFile { path: "source.xml".into(), text: text.to_owned(), is_foreign: false };
    parse_robot(None, &Arc::new(source)).unwrap()
}

/// A robot as text, read back.
#[track_caller]
fn written(text: &str, format: RobotFormat) -> (RobotText, ReadBackReport) {
    let folder = tempfile::tempdir().unwrap();
    let written = robot_text(&described(text), format, folder.path()).unwrap();
    let path = folder.path().join("written.xml");
    let how = ReadBack { path: &path, access: &FileAccess::default(), limit: LIMIT, seed: 0 };
    let (report, _) = read_back(&written, how).unwrap_or_else(|found| panic!("{found:#?}\n{}", written.text));
    (written, report)
}

fn codes(written: &RobotText) -> Vec<&'static str> {
    written.warnings.iter().map(|warning| warning.code.name).collect()
}

fn link_names(robot: &Robot) -> Vec<&str> {
    robot.links().iter().map(|link| link.name.as_str()).collect()
}

const INERTIAL: &str = "<inertial><origin xyz='0.1 0.2 0.3' rpy='0.3 -0.2 1.1'/><mass value='2'/>\
    <inertia ixx='0.03' ixy='0.002' ixz='-0.001' iyy='0.04' iyz='0.003' izz='0.05'/></inertial>";

/// A URDF of links and joints: names of links, then what each joint has.
fn urdf(links: &[(&str, &str)], joints: &str) -> String {
    let links: Vec<String> =
        links.iter().map(|(name, has)| format!("<link name='{name}'>{has}</link>")).collect();
    format!("<robot name='r'>{}{joints}</robot>", links.concat())
}

fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], has: &str) -> String {
    format!(
        "<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>\
         <origin xyz='0.1 0.2 0.3' rpy='0.4 0.5 0.6'/><axis xyz='0 0.6 0.8'/>{has}</joint>"
    )
}

#[test]
fn all_that_a_urdf_has_is_written_and_read_again() {
    let shapes = "<visual><origin xyz='1 2 3' rpy='0.1 0.2 0.3'/><geometry><box size='0.1 0.2 0.3'/></geometry>\
        <material name='m'><color rgba='0.1 0.2 0.3 1'/></material></visual>\
        <collision><geometry><cylinder radius='0.1' length='0.3'/></geometry></collision>\
        <collision><geometry><sphere radius='0.1'/></geometry></collision>";
    let has = format!("{INERTIAL}{shapes}");
    let limits =
        "<limit lower='-1' upper='2' effort='30' velocity='4'/><dynamics damping='0.1' friction='0.2'/>";
    let joints = joint("j &amp; \"k\"".replace('"', "&quot;").as_str(), "revolute", ["a", "b"], limits)
        + &joint(
            "follower",
            "prismatic",
            ["b", "c"],
            "<limit lower='0' upper='1' effort='3' velocity='1'/><mimic joint='j &amp; &quot;k&quot;' multiplier='-0.5' offset='0.1'/>",
        );
    let text = urdf(&[("a", ""), ("b", &has), ("c", INERTIAL)], &joints);
    for format in [RobotFormat::Urdf, RobotFormat::Mjcf] {
        let (written, report) = written(&text, format);
        assert_eq!((report.links, report.joints, report.shapes), (3, 2, 3));
        assert!(written.text.contains("j &amp; &quot;k&quot;"), "{}", written.text);
        let expected: &[&str] = if format == RobotFormat::Urdf { &[] } else { &["write::velocity"] };
        assert_eq!(codes(&written), expected);
    }
}

#[test]
fn an_ellipsoid_is_written_as_mjcf_and_reported_as_urdf() {
    // A box, a sphere, a capsule, a cylinder, an ellipsoid and others, each on a body of its own; all are drawn and collide.
    let text = include_str!("../../../fuzz/corpus/mjcf/c15-inertia-from-primitives.xml");
    let (mjcf, all) = written(text, RobotFormat::Mjcf);
    assert_eq!(mjcf.text.matches("type=\"ellipsoid\" size=\"0.1 0.2 0.3\"").count(), 2, "{}", mjcf.text);
    assert_eq!(codes(&mjcf), [""; 0]);
    let (urdf, without) = written(text, RobotFormat::Urdf);
    assert_eq!(all.shapes - without.shapes, 2);
    assert_eq!(codes(&urdf), ["write::ellipsoid"]);
    let message = &urdf.warnings[0].message;
    assert_eq!(message, "2 shapes are left out: a URDF has no ellipsoids: ellipsoid, ellipsoid");
}

#[test]
fn limits_of_version_1_2_are_written_with_the_version() {
    let limit =
        "<limit lower='-1' upper='2' effort='30' velocity='4' acceleration='7' deceleration='8' jerk='90'/>";
    let text = urdf(&[("a", ""), ("b", INERTIAL)], &joint("j", "revolute", ["a", "b"], limit))
        .replace("<robot ", "<robot version='1.2' ");
    let (as_urdf, _) = written(&text, RobotFormat::Urdf);
    for part in ["version=\"1.2\"", "acceleration=\"7.0\"", "deceleration=\"8.0\"", "jerk=\"90.0\""] {
        assert!(as_urdf.text.contains(part), "{part}: {}", as_urdf.text);
    }
    assert_eq!(codes(&as_urdf), [""; 0]);
    let (mjcf, _) = written(&text, RobotFormat::Mjcf);
    assert_eq!(codes(&mjcf), ["write::velocity", "write::rates"]);
    let (plain, _) =
        written(&text.replace(" acceleration='7' deceleration='8' jerk='90'", ""), RobotFormat::Urdf);
    assert!(!plain.text.contains("version=\"1.2\""), "{}", plain.text);
}

#[test]
fn an_armature_is_written_as_mjcf_and_reported_as_urdf() {
    let text = "<mujoco><worldbody><body name='arm'><joint name='turn' axis='0 1 0' armature='0.25'/>\
        <inertial pos='0 0 0.1' mass='1' diaginertia='0.1 0.1 0.1'/></body></worldbody>\
        <actuator><motor joint='turn' gear='10' armature='0.0025'/></actuator></mujoco>";
    let (mjcf, _) = written(text, RobotFormat::Mjcf);
    assert!(mjcf.text.contains("armature=\"0.5\""), "{}", mjcf.text);
    assert_eq!(codes(&mjcf), [""; 0]);
    let (urdf, _) = written(text, RobotFormat::Urdf);
    assert_eq!(codes(&urdf), ["write::armature"]);
    assert!(urdf.warnings[0].message.contains("0.5 kg m^2"), "{}", urdf.warnings[0].message);
}

#[test]
fn a_massless_link_between_two_joints_is_a_body_with_two_joints() {
    let between =
        joint("j", "continuous", ["a", "between"], "") + &joint("k", "continuous", ["between", "b"], "");
    let text = urdf(&[("a", INERTIAL), ("between", ""), ("b", INERTIAL)], &between);
    let (written, _) = written(&text, RobotFormat::Mjcf);
    assert_eq!(written.text.matches("<body").count(), 2, "{}", written.text);
    assert_eq!(link_names(&written.robot), ["a", "b (before k)", "b"]);
    assert_eq!(codes(&written), ["write::name"]);
}

#[test]
fn a_body_without_mass_gets_as_good_as_none_and_says_so() {
    let text = urdf(&[("a", ""), ("b", "")], &joint("j", "continuous", ["a", "b"], ""));
    let (written, _) = written(&text, RobotFormat::Mjcf);
    assert_eq!(codes(&written), ["write::massless"]);
    assert!(written.text.contains("mass=\"1e-12\""), "{}", written.text);
    // Links of a robot without masses stay links, and keep their names.
    let chain = joint("j", "continuous", ["a", "b"], "") + &joint("k", "continuous", ["b", "c"], "");
    let (chain, _) = self::written(&urdf(&[("a", ""), ("b", ""), ("c", "")], &chain), RobotFormat::Mjcf);
    assert_eq!(link_names(&chain.robot), ["a", "b", "c"]);
    // The mass of a link that is fixed to it is enough for MuJoCo.
    let fixed = joint("j", "continuous", ["a", "b"], "") + &joint("f", "fixed", ["b", "c"], "");
    let text = urdf(&[("a", ""), ("b", ""), ("c", INERTIAL)], &fixed);
    assert_eq!(codes(&self::written(&text, RobotFormat::Mjcf).0), ["write::name"]);
}

#[test]
fn an_impossible_inertia_becomes_the_nearest_possible_one() {
    let wrong = INERTIAL.replace("izz='0.05'", "izz='0.09'");
    let text = urdf(&[("a", ""), ("b", &wrong)], &joint("j", "continuous", ["a", "b"], ""));
    let (mjcf, _) = written(&text, RobotFormat::Mjcf);
    assert_eq!(codes(&mjcf), ["write::inertia"]);
    // A URDF holds any number.
    assert_eq!(codes(&written(&text, RobotFormat::Urdf).0), [""; 0]);
}

#[test]
fn ranges_without_room_or_without_ends() {
    let locked = joint("j", "revolute", ["a", "b"], "<limit lower='1' upper='1' effort='0' velocity='1'/>");
    let (locked, _) = written(&urdf(&[("a", ""), ("b", INERTIAL)], &locked), RobotFormat::Mjcf);
    assert_eq!(codes(&locked), ["write::range", "write::velocity", "write::effort"]);
    assert_eq!(locked.robot.joints()[0].kind, JointKind::Continuous);
    let slide = "<mujoco><worldbody><body name='b'><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>\
                 <joint name='s' type='slide'/></body></worldbody></mujoco>";
    let (slide, _) = written(slide, RobotFormat::Urdf);
    assert_eq!(codes(&slide), ["write::range", "write::ros_limit"]);
    assert_eq!(slide.robot.joints()[0].position_range(), Some((-1e6, 1e6)));
}

#[test]
fn the_world_is_the_root_of_an_mjcf_and_of_no_other_link() {
    let fixed = joint("f", "fixed", ["world", "a"], "");
    let (root, _) = written(&urdf(&[("world", ""), ("a", INERTIAL)], &fixed), RobotFormat::Mjcf);
    assert!(!root.text.contains("<body name=\"world\""), "{}", root.text);
    let inner = joint("f", "fixed", ["a", "world"], "");
    let (inner, _) = written(&urdf(&[("a", ""), ("world", INERTIAL)], &inner), RobotFormat::Mjcf);
    assert_eq!(link_names(&inner.robot), ["a", "world_link"]);
    assert_eq!(codes(&inner), ["write::name", "write::name"]);
}

const MJCF: &str = "<mujoco model='m'><asset><mesh name='t' vertex='0 0 0 1 0 0 0 1 0 0 0 1' scale='2 1 1'/></asset><worldbody>\
    <body name='a'><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><joint name='j' range='-30 40' pos='0.1 0 0'/>\
    <geom type='mesh' mesh='t' rgba='1 0 0 1'/><site name='tip' pos='0 0 1'/>\
    <body name='b'><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><joint name='x'/><joint name='y' axis='0 1 0'/></body></body>\
    </worldbody><contact><exclude body1='a' body2='b'/></contact></mujoco>";

#[test]
fn an_mjcf_is_the_same_after_it_is_written() {
    let source = described(MJCF);
    let (written, report) = written(MJCF, RobotFormat::Mjcf);
    assert_eq!(link_names(&written.robot), link_names(&source.robot));
    assert_eq!((codes(&written), report.shapes), (vec![], 2));
    assert_eq!(written.excluded.len(), 1);
}

#[test]
fn what_a_urdf_cannot_hold_of_an_mjcf_is_reported() {
    let (written, report) = written(MJCF, RobotFormat::Urdf);
    assert_eq!(codes(&written), ["write::excluded", "write::mesh", "write::ros_limit"]);
    assert_eq!(report.shapes, 0);
}

#[test]
fn a_text_of_another_robot_is_refused() {
    let text = urdf(&[("a", ""), ("b", INERTIAL)], &joint("j", "continuous", ["a", "b"], ""));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("written.urdf");
    let how = ReadBack { path: &path, access: &FileAccess::default(), limit: LIMIT, seed: 0 };
    let written = robot_text(&described(&text), RobotFormat::Urdf, folder.path()).unwrap();
    for (what, with, message) in [
        ("value=\"2.0\"", "value=\"2.0000001\"", "masses of link \"b\""),
        ("<axis xyz=\"0.0 ", "<axis xyz=\"0.2 ", "poses"),
        ("ixy=\"0.002\"", "ixy=\"0.0021\"", "inertias of link \"b\""),
        ("name=\"j\"", "name=\"i\"", "no moving joint \"j\""),
    ] {
        let changed = RobotText { text: written.text.replace(what, with), ..written.clone() };
        assert_ne!(changed.text, written.text, "{what}");
        let found = read_back(&changed, how).unwrap_err();
        assert!(found[0].message.contains(message), "{found:#?}");
    }
}
