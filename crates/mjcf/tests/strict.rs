//! What is refused, and how the messages say it; and inputs that would take for ever.

use std::{collections::BTreeMap, sync::Arc};

use congruent_input::{Diagnostic, Diagnostics, SourceFile, codes};
use congruent_mjcf::{MjEffort, MjModel};

/// A body that may move.
const INERTIAL: &str = r#"<inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>"#;

fn source(name: &str, text: &str) -> Arc<SourceFile> {
    Arc::new(SourceFile { path: name.into(), text: text.to_owned(), is_foreign: false })
}

/// Reads a text; the files that it names are in a list.
fn read(text: &str, files: &[(&str, &str)]) -> (Option<MjModel>, Vec<Diagnostic>) {
    let files: BTreeMap<&str, &str> = files.iter().copied().collect();
    let mut include = |name: &str| {
        let text = files.get(name).ok_or_else(|| Diagnostic::error(codes::file::NOT_FOUND, name))?;
        Ok(source(name, text))
    };
    let mut found = Diagnostics::default();
    let model = congruent_mjcf::parse(&source("main.xml", text), &mut include, &mut found);
    (model, found.into_vec())
}

#[track_caller]
fn model(text: &str) -> MjModel {
    let (model, found) = read(text, &[]);
    model.unwrap_or_else(|| panic!("{found:?}"))
}

/// A model with one body, which has a mass.
fn body(attributes: &str, inside: &str, after: &str) -> String {
    format!(
        "<mujoco><worldbody><body name=\"b\" {attributes}>{INERTIAL}{inside}</body></worldbody>{after}</mujoco>"
    )
}

#[track_caller]
fn refused(text: &str, code: &str, message: &str, line: usize) {
    let (model, found) = read(text, &[]);
    assert!(model.is_none(), "{text} is read");
    let fault = found.iter().find(|fault| fault.code.name == code).unwrap_or_else(|| panic!("{found:?}"));
    assert!(fault.message.contains(message), "{}", fault.message);
    assert_eq!(fault.line_column().map(|(line, _)| line), Some(line), "{fault:?}");
}

#[test]
fn mistakes_are_refused_with_their_places() {
    let joint = |attributes: &str| body("", &format!("\n<joint name=\"j\" {attributes}/>"), "");
    for (text, code, message, line) in [
        ("<robot/>".to_owned(), "mjcf::root", "<robot>, an MJCF begins with <mujoco>", 1),
        (
            body("poss=\"0 0 1\"", "", ""),
            "mjcf::unknown_attribute",
            "body \"b\" has no attribute \"poss\"",
            1,
        ),
        (body("", "\n<jiont/>", ""), "mjcf::unknown_element", "<jiont> is no element of body \"b\"", 2),
        (body("", &format!("\n{INERTIAL}"), ""), "mjcf::repeated_element", "<inertial>", 2),
        (joint("axis=\"0 0\""), "mjcf::number", "axis has 2 numbers, expected 3", 2),
        (joint("axis=\"0 0,5 1\""), "mjcf::number", "decimal point is a dot", 2),
        (joint("axis=\"0 0 nan\""), "mjcf::number", "not a finite number", 2),
        (joint("limited=\"yes\""), "mjcf::keyword", "limited is \"yes\"", 2),
        (joint("axis=\"0 0 1e-12\""), "mjcf::axis", "the axis has the length 0", 2),
        (joint("limited=\"true\""), "mjcf::range", "without range", 2),
        (joint("class=\"arm\""), "mjcf::class", "no class of defaults \"arm\"", 2),
    ] {
        refused(&text, code, message, line);
    }
}

#[test]
fn poses_and_joints_that_mujoco_refuses_are_refused() {
    for (text, code, message, line) in [
        (
            body("quat=\"1 0 0 0\" euler=\"0 0 1\"", "", ""),
            "mjcf::orientation",
            "two orientations: quat and euler",
            1,
        ),
        (body("quat=\"0 0 0 0\"", "", ""), "mjcf::orientation", "the quaternion of quat has the length 0", 1),
        (body("xyaxes=\"1 0 0 2 0 0\"", "", ""), "mjcf::orientation", "y axis normal to x", 1),
        (body("", "<joint/>\n<freejoint/>", ""), "mjcf::joint", "free joint is beside other joints", 2),
        (
            body("", &format!("<body>{INERTIAL}\n<freejoint/></body>"), ""),
            "mjcf::joint",
            "below another body",
            2,
        ),
        (
            body("", "<joint type=\"ball\"/>\n<joint/>", ""),
            "mjcf::joint",
            "followed by a joint that turns",
            2,
        ),
        (body("", &"<joint/>".repeat(7), ""), "mjcf::joint", "7 degrees of freedom, limit <= 6", 1),
        (
            body("", "<joint name=\"j\"/>\n<joint name=\"j\"/>", ""),
            "mjcf::name",
            "two joints are called \"j\"",
            2,
        ),
        (
            body("", "<joint name=\"j\"/>", "\n<actuator><motor joint=\"k\"/></actuator>"),
            "mjcf::unknown_name",
            "no joint \"k\"",
            2,
        ),
    ] {
        refused(&text, code, message, line);
    }
}

#[test]
fn parts_that_mujoco_refuses_are_refused() {
    for (text, code, message, line) in [
        (body("", "", "\n<actuator><motor/></actuator>"), "mjcf::actuator", "has no target", 2),
        (body("", "", "\n<compiler coordinate=\"global\"/>"), "mjcf::compiler", "global", 2),
        (body("", "", "\n<compiler eulerseq=\"abc\"/>"), "mjcf::compiler", "eulerseq is \"abc\"", 2),
        (body("", "\n<geom type=\"box\" size=\"1 1\"/>", ""), "mjcf::geom", "number 3 of size is 0 m", 2),
        (
            body("", "<joint/>\n<geom type=\"plane\" size=\"1 1 1\"/>", ""),
            "mjcf::geom",
            "moves and has a plane",
            2,
        ),
        (body("", "", "\n<default class=\"x\"/>"), "mjcf::class", "it must be \"main\"", 2),
        ("<mujoco><worldbody>\n<joint/></worldbody></mujoco>".to_owned(), "mjcf::placement", "<joint>", 2),
        (
            "<mujoco><worldbody>\n<body><joint/></body></worldbody></mujoco>".to_owned(),
            "mjcf::massless",
            "moves",
            2,
        ),
        (
            body("", "<joint/>", "\n<keyframe><key qpos=\"1 2\"/></keyframe>"),
            "mjcf::keyframe",
            "2 numbers, the model has 1",
            2,
        ),
    ] {
        refused(&text, code, message, line);
    }
}

#[test]
fn inertias_that_no_body_has_are_refused() {
    let inertial = |attributes: &str| {
        format!(
            "<mujoco><worldbody><body>\n<inertial pos=\"0 0 0\" mass=\"1\" {attributes}/></body></worldbody></mujoco>"
        )
    };
    for (attributes, message) in [
        ("diaginertia=\"3 1 1\"", "the moment 3 kg m^2 exceeds the sum of the other two, 2 kg m^2"),
        ("fullinertia=\"1 1 1 2 0 0\"", "the principal moment -1.000e0 kg m^2"),
        ("fullinertia=\"1 1 1 0 0 0\" quat=\"1 0 0 0\"", "beside quat"),
        ("fullinertia=\"1 1 1 0 0 0\" diaginertia=\"1 1 1\"", "twice"),
    ] {
        refused(&inertial(attributes), "mjcf::inertial", message, 2);
    }
    assert!(read(&inertial("diaginertia=\"2 1 1\""), &[]).0.is_some());
}

#[test]
fn a_value_knows_the_file_and_the_class_that_state_it() {
    let part =
        "<mujoco>\n<default><default class=\"arm\"><joint range=\"-90 90\"/></default></default></mujoco>";
    let text =
        body("childclass=\"arm\"", "<joint name=\"j\" damping=\"2\"/>", "<include file=\"sub/part.xml\"/>");
    let (model, found) = read(&text, &[("sub/part.xml", part)]);
    let model = model.unwrap_or_else(|| panic!("{found:?}"));
    let [joint] = &model.joints[..] else { panic!("{:?}", model.joints) };
    let range = joint.range.as_ref().unwrap().place.as_ref().unwrap();
    assert_eq!((range.text(), range.key.as_str(), range.class.as_deref()), ("-90 90", "range", Some("arm")));
    assert_eq!(format!("{range:?}"), "range at sub/part.xml:2:45");
    let damping = joint.damping.place.as_ref().unwrap();
    assert_eq!(
        (damping.text(), damping.class.as_deref(), &damping.source.path),
        ("2", None, &model.files[0].path)
    );
    assert_eq!(joint.armature.place, None);
    assert_eq!(model.files.len(), 2);
}

#[test]
fn a_fault_of_an_included_file_names_that_file() {
    let text = body("", "<include file=\"part.xml\"/>", "");
    let (_, found) = read(&text, &[("part.xml", "<mujocoinclude>\n<joint axis=\"0 0 0\"/></mujocoinclude>")]);
    let [fault] = &found[..] else { panic!("{found:?}") };
    assert_eq!(fault.source.as_ref().unwrap().path.to_str(), Some("part.xml"));
    assert_eq!(fault.line_column(), Some((2, 14)));
    let (_, found) = read(&body("", "<include file=\"gone.xml\"/>", ""), &[]);
    assert_eq!(found[0].line_column().map(|(line, _)| line), Some(1));
}

#[test]
fn efforts_of_a_joint_add_within_its_own_limits() {
    let joint = "<joint name=\"j\" actuatorfrcrange=\"-100 50\"/>";
    let actuators = "<actuator><motor joint=\"j\" gear=\"-50\" ctrlrange=\"-1 0.5\"/>\
        <position joint=\"j\" kp=\"3\" forcerange=\"-30 30\" gear=\"2\"/></actuator>";
    let found = model(&body("", joint, actuators));
    let MjEffort::Within { range, places } = &found.joints[0].effort else { panic!("{found:?}") };
    // -25 to 50 and -60 to 60, at most 50.
    assert_eq!((*range, places.len()), ([-85.0, 50.0], 3));
}

#[test]
fn replicas_bring_their_actuators_along() {
    let replicate = |inside: &str| {
        format!(
            "<mujoco><worldbody><body name=\"o\">{INERTIAL}<joint name=\"q\"/></body><replicate count=\"10\" euler=\"0 0 36\">\
         <body name=\"f\">{INERTIAL}<joint name=\"k\"/></body></replicate></worldbody>{inside}</mujoco>"
        )
    };
    let found = model(&replicate(
        "<actuator><motor name=\"m\" joint=\"k\"/></actuator><contact><exclude body1=\"o\" body2=\"f\"/></contact>",
    ));
    assert_eq!((found.bodies[2].name.text.as_str(), found.joints[10].name.text.as_str()), ("f00", "k09"));
    assert_eq!((found.actuators.len(), found.exclusions.len()), (10, 10));
    assert_eq!(found.actuators[3].name, "m03");
    let (dropped, warnings) =
        read(&replicate("<equality><joint joint1=\"q\" joint2=\"k\"/></equality>"), &[]);
    assert!(dropped.unwrap().equalities.is_empty());
    assert_eq!(warnings[0].code.name, "mjcf::replicate");
}

#[test]
fn an_attached_model_keeps_its_units_and_brings_its_actuators() {
    let hand = format!(
        "<mujoco><compiler angle=\"radian\"/><default><joint damping=\"1\"/></default><worldbody><body name=\"palm\">{INERTIAL}\
         <joint name=\"grip\" range=\"-1 1\"/></body><body name=\"spare\">{INERTIAL}<joint name=\"s\"/></body></worldbody>\
         <actuator><motor name=\"m\" joint=\"grip\"/><motor joint=\"s\"/></actuator></mujoco>"
    );
    let text = body(
        "",
        "<attach model=\"h\" body=\"palm\" prefix=\"left_\"/>",
        "<asset><model name=\"h\" file=\"hand.xml\"/></asset>",
    );
    let (model, found) = read(&text, &[("hand.xml", &hand)]);
    let model = model.unwrap_or_else(|| panic!("{found:?}"));
    assert_eq!(model.joints[0].name.text, "left_grip");
    let joint = &model.joints[0];
    assert_eq!(joint.range.as_ref().and_then(|range| range.place.as_ref()).unwrap().text(), "-1 1");
    let [low, high] = joint.range.as_ref().unwrap().value;
    assert!((low + 1.0).abs() + (high - 1.0).abs() + (joint.damping.value[0] - 1.0).abs() < f64::EPSILON);
    assert_eq!(model.actuators.iter().map(|actuator| actuator.name.as_str()).collect::<Vec<_>>(), ["left_m"]);
    let (_, found) =
        read(&text, &[("hand.xml", "<mujoco><asset><model file=\"hand.xml\"/></asset></mujoco>")]);
    assert!(found.iter().any(|fault| fault.code.name == "mjcf::too_large"), "{found:?}");
}

#[test]
fn hostile_files_are_refused_soon() {
    let nested = |depth: usize, tag: &str, inside: &str| {
        let (open, close) = (format!("<{tag} count=\"1000\">"), format!("</{tag}>"));
        format!(
            "<mujoco><worldbody>{}{inside}{}</worldbody></mujoco>",
            open.repeat(depth),
            close.repeat(depth)
        )
    };
    refused(&nested(10, "replicate", ""), "mjcf::too_large", "more than 1000000 parts", 1);
    refused(&nested(1, "replicate", "<replicate count=\"2000000000\"/>"), "mjcf::too_large", "parts", 1);
    refused(&nested(70, "frame", ""), "xml::depth", "nested deeper", 1);
    let deep = "<body>".repeat(50) + "<include file=\"x.xml\"/>" + &"</body>".repeat(50);
    let part = format!("<m>{}{}</m>", "<body>".repeat(60), "</body>".repeat(60));
    let (_, found) = read(&format!("<mujoco><worldbody>{deep}</worldbody></mujoco>"), &[("x.xml", &part)]);
    assert_eq!(found[0].code.name, "mjcf::too_large");
    let class = |number| format!("<default class=\"c{number}\"/>");
    let classes = (0..2_000).map(class).collect::<Vec<_>>().concat();
    refused(&format!("<mujoco><default>{classes}</default></mujoco>"), "mjcf::too_large", "1000 classes", 1);
    let huge = body("", "<joint axis=\"1e99 1e99 0\" pos=\"1e99 0 0\"/>", "");
    assert!(model(&huge).joints[0].axis_in_body.value.x.is_finite());
}
