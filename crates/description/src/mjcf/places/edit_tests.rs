//! Edits of small models: what they give is read again and compared.

use congruent_input::{TextEdit, edited};
use congruent_robot::{Inertia, Joint, JointResistance, Robot};
use nalgebra::{Isometry3, Matrix3, UnitVector3, Vector3};

use super::{
    MjcfPlaces,
    tests::{places, read},
};
use crate::parameter_places::ParameterPlaces;

/// Numbers of a file have twelve digits. Kind: golden digits; worst seen 4e-13.
const WRITTEN: f64 = 1e-11;
/// Numbers of poses are written without the noise of products, 1e-10; a turn has four of them. Kind: golden digits.
const WRITTEN_POSE: f64 = 1e-9;

/// An arm of two joints; `inertial`, `joint` and `body` are attributes of the first.
fn arm(inertial: &str, joint: &str, body: &str) -> String {
    format!(
        "<mujoco>\n<default><default class=\"arm\"><joint damping=\"2\"/></default></default>\n<worldbody>\n\
         <body name=\"upper\" {body}>\n<inertial {inertial}/>\n<joint name=\"shoulder\" {joint}/>\n\
         <body name=\"lower\" pos=\"0 0 1\">\n<geom size=\"0.1\" mass=\"3\"/>\n<joint name=\"elbow\" class=\"arm\"/>\n\
         </body></body></worldbody>\n<actuator>\n<motor joint=\"shoulder\" ctrlrange=\"-30 30\" gear=\"2\"/>\n\
         </actuator></mujoco>"
    )
}

const BALL: &str = "pos=\"0 0 0.1\" mass=\"2\" diaginertia=\"1 1 1\"";

#[track_caller]
fn applied(places: &MjcfPlaces, edits: &[TextEdit]) -> (Robot, String) {
    assert!(!edits.is_empty(), "there is an edit");
    let text = edited(&places.source().text, edits);
    (read(&text, "").robot, text)
}

fn joint<'a>(robot: &'a Robot, name: &str) -> &'a Joint {
    robot.joint(robot.find_joint(name).expect("a joint"))
}

fn wanted(turn: Vector3<f64>, tensor_kg_m2: Matrix3<f64>) -> Inertia {
    Inertia {
        mass_kg: 3.0,
        link_from_inertial: Isometry3::new(Vector3::new(0.1, 0.0, -0.25), turn),
        tensor_kg_m2,
    }
}

/// That an `<inertial>` with these attributes gets this inertia, and that it is written with these words.
#[track_caller]
fn check_inertia(inertial: &str, wanted: &Inertia, words: &[&str]) {
    let places = places(&arm(inertial, "", "pos=\"0 0 1\""), "");
    let (robot, text) = applied(&places, &places.set_inertial("upper", wanted).expect("it is its own"));
    let found = robot.link(robot.find_link("upper").unwrap()).inertia.expect("it has one");
    let [one, other] = [&found, wanted].map(|of| {
        let turn = of.link_from_inertial.rotation.to_rotation_matrix().into_inner();
        turn * of.tensor_kg_m2 * turn.transpose()
    });
    assert!((one - other).amax() < WRITTEN, "{one} {other}\n{text}");
    assert!((found.mass_kg - wanted.mass_kg).abs() < WRITTEN, "{text}");
    let apart = found.link_from_inertial.translation.vector - wanted.link_from_inertial.translation.vector;
    assert!(apart.amax() < WRITTEN, "{text}");
    let line = text.lines().find(|line| line.contains("<inertial")).expect("it stays");
    assert!(words.iter().all(|word| line.contains(word)), "{line}");
}

#[test]
fn an_inertia_is_written_about_its_axes_or_as_a_whole() {
    let diagonal = Matrix3::from_diagonal(&Vector3::new(0.5, 0.6, 0.7));
    let full = Matrix3::new(0.5, 0.1, 0.0, 0.1, 0.6, 0.02, 0.0, 0.02, 0.7);
    let none = Vector3::zeros();
    let quarter = Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2);
    let quat = "pos=\"0 0 0\" mass=\"2\" quat=\"1 0 0 1\" diaginertia=\"1 1.5 1\"";
    let words = ["pos=\"0.1 0.0 -0.25\"", "mass=\"3.0\"", "diaginertia=\"0.5 0.6 0.7\""];
    check_inertia(BALL, &wanted(none, diagonal), &words);
    // The axes of the file stay if they are axes of the tensor.
    check_inertia(quat, &wanted(none, diagonal), &["quat=\"1 0 0 1\" diaginertia=\"0.6 0.5 0.7\""]);
    check_inertia(quat, &wanted(quarter, diagonal), &["diaginertia=\"0.5 0.6 0.7\""]);
    check_inertia(BALL, &wanted(none, full), &["mass=\"3.0\" fullinertia=\"0.5 0.6 0.7 0.1 0.0 0.02\"/>"]);
    check_inertia(quat, &wanted(none, full), &["mass=\"3.0\" fullinertia=\"0.5 0.6 0.7 0.1 0.0 0.02\"/>"]);
    check_inertia(quat, &wanted(Vector3::new(0.3, -0.2, 0.5), full), &["fullinertia="]);
    let fullinertia = "pos=\"0 0 0\" mass=\"3\" fullinertia=\"1 1 1 0.1 0 0\"";
    check_inertia(
        fullinertia,
        &wanted(none, diagonal),
        &["mass=\"3\" fullinertia=\"0.5 0.6 0.7 0.0 0.0 0.0\"/>"],
    );
}

#[test]
fn what_is_right_keeps_its_form() {
    let places = places(&arm("mass=\"3.00\" pos=\".1 0 -0.25\" diaginertia=\"1 1 1\"", "", ""), "");
    let wanted = wanted(Vector3::zeros(), Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.5)));
    let (_, text) = applied(&places, &places.set_inertial("upper", &wanted).unwrap());
    assert!(text.contains("mass=\"3.00\" pos=\".1 0 -0.25\" diaginertia=\"1.0 1.0 0.5\""), "{text}");
}

#[test]
fn an_inertia_in_a_frame_is_written_in_it() {
    let text = arm(BALL, "", "").replace("<inertial", "<frame pos=\"1 2 3\" euler=\"0 0 90\">\n<inertial");
    let places = places(&text.replace("<joint name=\"shoulder\"", "</frame><joint name=\"shoulder\""), "");
    let tensor = Matrix3::from_diagonal(&Vector3::new(0.5, 0.6, 0.7));
    let wanted = wanted(Vector3::zeros(), tensor);
    let (robot, text) = applied(&places, &places.set_inertial("upper", &wanted).unwrap());
    let found = robot.link(robot.find_link("upper").unwrap()).inertia.unwrap();
    assert!((found.tensor_kg_m2 - tensor).amax() < WRITTEN, "{text}");
    let apart = found.link_from_inertial.translation.vector - Vector3::new(0.1, 0.0, -0.25);
    assert!(apart.amax() < WRITTEN, "{text}");
}

#[test]
fn an_inertia_that_no_element_of_its_own_states_has_no_edit() {
    let inertia = wanted(Vector3::zeros(), Matrix3::identity());
    let none = |text: &str, included: &str, link: &str| {
        assert_eq!(places(text, included).set_inertial(link, &inertia), None, "{text}");
    };
    let text = arm(BALL, "", "");
    none(&text, "", "lower");
    none(&text, "", "nobody");
    none("<mujoco><include file=\"arm.xml\"/></mujoco>", &text, "upper");
    none(&text.replace("<mujoco>", "<mujoco><compiler settotalmass=\"7\"/>"), "", "upper");
    none(&text.replace("<mujoco>", "<mujoco><compiler boundmass=\"4\"/>"), "", "upper");
    none(&text.replace("<mujoco>", "<mujoco><compiler boundinertia=\"1.5\"/>"), "", "upper");
    let copies = text.replace("<worldbody>", "<worldbody><replicate count=\"2\" offset=\"1 0 0\">");
    none(&copies.replace("</worldbody>", "</replicate></worldbody>"), "", "upper0");
    let impossible =
        Inertia { tensor_kg_m2: Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 3.0)), ..inertia };
    assert_eq!(places(&text, "").set_inertial("upper", &impossible), None);
}

#[test]
fn losses_are_attributes_of_the_joint() {
    let terms = JointResistance { damping: 0.5, friction: 0.25, armature: 0.1 };
    let of = |joint: &str| places(&arm(BALL, joint, ""), "");
    for attributes in ["", "damping=\"1 0.3\" frictionloss=\"0.25\"", "armature=\"4\" damping=\"0.5\""] {
        let places = of(attributes);
        let (robot, text) = applied(&places, &places.set_terms("shoulder", &terms).expect("its own"));
        let found = JointResistance::from(joint(&robot, "shoulder"));
        assert_eq!(found, terms, "{text}");
        assert_eq!(
            text.contains(" 0.3\""),
            attributes.contains(" 0.3\""),
            "powers of the speed stay: {text}"
        );
    }
    // Those of the other joint are in a class.
    assert_eq!(of("").set_terms("elbow", &terms), None);
    let driven = arm(BALL, "armature=\"1\"", "").replace("gear=\"2\"", "gear=\"2\" armature=\"3\"");
    assert_eq!(places(&driven, "").set_terms("shoulder", &terms), None, "12 of the actuator are more");
    let terms = JointResistance { armature: 12.5, ..JointResistance::default() };
    let places = places(&driven, "");
    let (robot, text) = applied(&places, &places.set_terms("shoulder", &terms).unwrap());
    assert_eq!(joint(&robot, "shoulder").armature, Some(12.5), "{text}");
}

#[test]
fn a_range_is_written_in_the_unit_of_the_file() {
    for (compiler, range) in [("<mujoco>", "-90  90"), ("<mujoco><compiler angle=\"radian\"/>", "-1 1")] {
        let text = arm(BALL, &format!("range=\"{range}\""), "").replace("<mujoco>", compiler);
        let places = places(&text, "");
        let edits =
            [places.set_limit("shoulder", "lower", -0.5), places.set_limit("shoulder", "upper", 0.75)];
        let (robot, text) = applied(&places, &edits.concat());
        let (lower, upper) = joint(&robot, "shoulder").position_range().expect("a range");
        assert!((lower + 0.5).abs() < WRITTEN && (upper - 0.75).abs() < WRITTEN, "{text}");
        assert_eq!(places.set_limit("elbow", "upper", 1.0), [], "it has none");
        assert_eq!(places.set_limit("shoulder", "velocity", 1.0), [], "nor has an MJCF");
    }
}

#[test]
fn an_effort_is_written_where_it_is_limited() {
    let effort = |text: &str, value: f64| {
        let places = places(text, "");
        let edits = places.set_limit("shoulder", "effort", value);
        (!edits.is_empty()).then(|| {
            let (robot, text) = applied(&places, &edits);
            let found = joint(&robot, "shoulder").limit.and_then(|limit| limit.effort);
            assert_eq!(found, Some(value), "{text}");
            text
        })
    };
    let text = arm(BALL, "", "");
    assert!(effort(&text, 20.0).expect("of the control").contains("ctrlrange=\"-10.0 10.0\""));
    let forces = text.replace("ctrlrange", "ctrlrange=\"-1 1\" forcerange");
    assert!(
        effort(&forces, 20.0).expect("of the force").contains("ctrlrange=\"-1 1\" forcerange=\"-10.0 10.0\"")
    );
    let capped = arm(BALL, "actuatorfrcrange=\"-15 15\"", "");
    assert!(effort(&capped, 20.0).expect("of the joint").contains("actuatorfrcrange=\"-20.0 20.0\""));
    assert_eq!(effort(&capped, 70.0), None, "the actuator has 60 N m");
    let wide = arm(BALL, "actuatorfrcrange=\"-90 90\"", "");
    assert!(effort(&wide, 80.0).expect("of the control").contains("ctrlrange=\"-40.0 40.0\""));
    assert_eq!(effort(&wide, 100.0), None, "the joint allows 90 N m");
    assert_eq!(effort(&text.replace("-30 30", "-20 30"), 20.0), None, "two limits");
    let motor = "<motor joint=\"shoulder\" ctrlrange=\"-30 30\" gear=\"2\"/>";
    assert_eq!(effort(&text.replace(motor, &format!("{motor}{motor}")), 20.0), None, "two actuators");
}

#[test]
fn an_origin_is_the_pose_of_the_body() {
    let wanted = Isometry3::new(Vector3::new(0.1, 0.2, 1.3), Vector3::new(0.4, -0.2, 2.9));
    let bodies = ["", "pos=\"0 0 1\"", "euler=\"0 10 0\" pos=\"0 0 1\"", "quat=\"0 1 0 0\""];
    for (body, shoulder) in
        bodies.into_iter().flat_map(|body| [(body, ""), (body, "pos=\"0 0.5 0\" axis=\"1 0 0\"")])
    {
        let text = arm(BALL, shoulder, body);
        let framed = text.replace("<worldbody>", "<worldbody><frame pos=\"1 0 0\" euler=\"30 0 20\">");
        for text in [text, framed.replace("</worldbody>", "</frame></worldbody>")] {
            let places = places(&text, "");
            let (robot, text) = applied(&places, &places.set_joint_origin("shoulder", &wanted));
            let found = joint(&robot, "shoulder").parent_from_joint;
            let apart = found.inverse() * wanted;
            assert!(apart.translation.vector.norm() + apart.rotation.angle() < WRITTEN_POSE, "{text}");
        }
    }
    let reference = places(&arm(BALL, "ref=\"10\"", ""), "");
    assert_eq!(reference.set_joint_origin("nobody", &wanted), []);
    // Without the `ref` the body is where it is written at position 0.
    let plain = arm(BALL, "pos=\"0 0.5 0\" ref=\"0\"", "quat=\"0 1 0 0\"");
    let turned = places(&plain.replace("ref=\"0\"", "ref=\"25\""), "");
    let origin = joint(&read(&plain, "").robot, "shoulder").parent_from_joint;
    assert_eq!(applied(&turned, &turned.set_joint_origin("shoulder", &origin)).1, plain);
    let shifted = Isometry3::translation(0.0, 0.0, 0.5);
    let (_, text) = applied(&reference, &reference.set_joint_origin("elbow", &shifted));
    assert!(text.contains("<body name=\"lower\" pos=\"0 0 0.5\">"), "{text}");
}

#[test]
fn an_axis_is_written_in_its_frame() {
    let wanted = UnitVector3::new_normalize(Vector3::new(0.6, 0.0, -0.8));
    for attributes in ["", "axis=\"1 0 0\"", "pos=\"0 0.5 0\""] {
        let places = places(&arm(BALL, attributes, "euler=\"0 0 30\""), "");
        let (robot, text) = applied(&places, &places.set_joint_axis("shoulder", &wanted));
        let found = joint(&robot, "shoulder").axis_in_joint;
        assert!((found.into_inner() - wanted.into_inner()).norm() < WRITTEN_POSE, "{text}");
    }
}
