//! Places of small models, in one file or two.

use std::sync::Arc;

use congruent_input::{Diagnostics, SourceFile};

use super::MjcfPlaces;
use crate::{
    mjcf::{MjcfInputs, ModelRobot, parse},
    parameter_places::{JointElement, ParameterPlaces},
};

fn source(path: &str, text: &str) -> Arc<SourceFile> {
    Arc::new(SourceFile { path: path.into(), text: text.to_owned(), is_foreign: false })
}

/// The places of a model that may include `arm.xml`.
#[track_caller]
pub(super) fn places(main: &str, included: &str) -> MjcfPlaces {
    read(main, included).places
}

/// A model that may include `arm.xml`.
#[track_caller]
pub(super) fn read(main: &str, included: &str) -> ModelRobot {
    let mut diagnostics = Diagnostics::default();
    let mut include = |_: &str| Ok(source("arm.xml", included));
    let inputs = MjcfInputs { include: &mut include, find_mesh: &mut crate::urdf::no_mesh };
    let read = parse(&source("robot.xml", main), &mut { inputs }, &mut diagnostics);
    read.unwrap_or_else(|| panic!("{:#?}", diagnostics.into_vec()))
}

/// A place as a message has it, and the text there.
#[track_caller]
fn at(places: &MjcfPlaces, of: &str, parameter: &str) -> (String, String) {
    let place = places.parameter(of, parameter).expect("it has a place");
    (place.to_string(), place.source.text[place.span.clone()].to_owned())
}

fn pair(place: &str, text: &str) -> (String, String) {
    (place.to_owned(), text.to_owned())
}

const ARM: &str = r#"<mujoco>
<compiler angle="radian"/>
<default>
  <default class="arm">
    <joint damping="2" range="-1 1"/>
  </default>
  <default class="wrist">
    <joint armature="0.1" frictionloss="3"/>
  </default>
</default>
<worldbody>
  <body name="upper">
    <inertial pos="0 0 0.1" mass="2"
      diaginertia="1 1 1"/>
    <joint name="shoulder" class="arm"/>
    <body name="lower">
      <geom size="0.1"
        mass="3"/>
      <joint name="elbow" class="arm" range="-2 2"/>
      <body name="hand">
        <geom size="0.1"/>
        <geom size="0.2"/>
        <joint name="wrist" class="wrist"/>
      </body>
    </body>
  </body>
</worldbody>
<actuator>
  <motor joint="shoulder" ctrlrange="-30 30"/>
  <motor joint="elbow" forcerange="-20 20" gear="2"/>
</actuator>
</mujoco>"#;

#[test]
fn values_have_the_lines_of_their_elements_or_of_their_class() {
    let places = places(ARM, "");
    assert_eq!(at(&places, "upper", "mass"), pair("robot.xml:13", "2"));
    assert_eq!(at(&places, "upper", "com_z"), pair("robot.xml:13", "0 0 0.1"));
    assert_eq!(at(&places, "upper", "ixx"), pair("robot.xml:14", "1 1 1"));
    assert_eq!(at(&places, "elbow", "lower"), pair("robot.xml:19", "-2 2"));
    // Two joints have it from there.
    assert_eq!(at(&places, "shoulder", "damping"), pair("robot.xml:5 (class \"arm\")", "2"));
    // One joint has it from there: a change there changes no other element.
    assert_eq!(at(&places, "shoulder", "upper"), pair("robot.xml:5", "-1 1"));
    assert_eq!(at(&places, "wrist", "friction"), pair("robot.xml:8", "3"));
    assert_eq!(at(&places, "shoulder", "effort"), pair("robot.xml:29", "-30 30"));
    assert_eq!(at(&places, "elbow", "effort"), pair("robot.xml:30", "-20 20"));
    // What the file does not write is at the element.
    assert_eq!(at(&places, "wrist", "lower"), pair("robot.xml:23", "<joint"));
    assert_eq!(at(&places, "wrist", "damping"), pair("robot.xml:23", "<joint"));
    assert!(places.parameter("wrist", "velocity").is_none(), "an MJCF has none");
    assert!(places.parameter("nobody", "mass").is_none());
}

#[test]
fn a_mass_that_follows_from_geoms_is_at_the_only_one_or_at_the_body() {
    let places = places(ARM, "");
    assert_eq!(at(&places, "lower", "mass"), pair("robot.xml:18", "3"));
    assert_eq!(at(&places, "hand", "mass"), pair("robot.xml:20", "<body"));
}

#[test]
fn a_value_of_an_included_file_has_its_name() {
    let main = "<mujoco>\n<include file=\"arm.xml\"/>\n</mujoco>";
    let places = places(main, &ARM.replace("<worldbody>", "\n<worldbody>"));
    assert_eq!(at(&places, "upper", "mass"), pair("arm.xml:14", "2"));
    let damping = places.parameter("elbow", "damping").unwrap();
    assert_eq!(damping.line_in(places.source()), None);
    let elsewhere = damping.elsewhere(places.source()).unwrap();
    assert_eq!(elsewhere.in_words("robot.xml"), "arm.xml:5 (class \"arm\")");
}

#[test]
fn the_smaller_of_two_limits_is_the_place_of_the_effort() {
    let capped = |own: &str| {
        let joint = format!("name=\"elbow\" actuatorfrcrange=\"{own}\"");
        at(&places(&ARM.replace("name=\"elbow\"", &joint), ""), "elbow", "effort").1
    };
    assert_eq!(capped("-10 10"), "-10 10");
    assert_eq!(capped("-90 90"), "-20 20");
}

#[test]
fn copies_share_their_places() {
    let text = ARM.replace("<worldbody>", "<worldbody>\n<replicate count=\"2\" offset=\"1 0 0\">");
    let places = places(&text.replace("</worldbody>", "</replicate></worldbody>"), "");
    let (_, body) = places.body("upper0").expect("a copy");
    assert!(places.users.are_several(&body.place));
}

#[test]
fn the_origin_of_a_joint_is_at_its_body_and_the_axis_at_the_joint() {
    let text = ARM.replace(
        "<body name=\"lower\">",
        "<body name=\"lower\"\n pos=\"0 0 1\">\n<body name=\"flange\" quat=\"0 1 0 0\"/>\n<site name=\"tool\"/>",
    );
    let text = text
        .replace("class=\"arm\" range=\"-2 2\"", "class=\"arm\"\n axis=\"0 1 0\"/><joint name=\"second\"");
    let coupling = "<equality>\n<joint joint1=\"wrist\" joint2=\"elbow\"/>\n</equality>\n</mujoco>";
    let places = places(&text.replace("</mujoco>", coupling), "");
    let part = |joint: &str, part| {
        let place = places.joint_part(joint, part).expect("it has a place");
        (place.line(), place.source.text[place.span.clone()].to_owned())
    };
    let text_at = |line: usize, text: &str| (line, text.to_owned());
    assert_eq!(part("elbow", JointElement::Origin), text_at(17, "0 0 1"));
    assert_eq!(part("elbow", JointElement::Axis), text_at(23, "0 1 0"));
    assert_eq!(part("second", JointElement::Origin), text_at(23, "<joint"));
    assert_eq!(part("shoulder", JointElement::Origin), text_at(12, "<body"));
    assert_eq!(part("shoulder", JointElement::Axis), text_at(15, "<joint"));
    assert_eq!(part("flange (fixed)", JointElement::Origin), text_at(18, "0 1 0 0"));
    assert_eq!(part("tool (fixed)", JointElement::Origin), text_at(19, "<site"));
    assert_eq!(part("wrist", JointElement::Mimic).1, "<joint");
    assert!(part("wrist", JointElement::Mimic).0 > part("wrist", JointElement::Axis).0);
    assert!(places.joint_part("nobody", JointElement::Axis).is_none());
}
