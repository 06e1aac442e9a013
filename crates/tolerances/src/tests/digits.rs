//! Digits of a file: the tool of a file whose last place is changed is where the error of that value says.

use congruent_description::{RobotDescription, RobotQ, parse_robot};
use congruent_input::SourceFile;
use congruent_kinematics::UrdfTree;
use nalgebra::Vector3;

use super::{robot, robot_q};
use crate::{digits::written_digits, error_chain::ErrorMotions, parameters::ToleratedChain};

/// Second order of a turn by half of a place (5e-6 rad) of an arm of a metre. Kind: truncation; worst seen 2e-11, x5.
const SECOND_ORDER_M: f64 = 1e-10;

/// A tilted axis on a bracket that is turned, and a tool behind a fixed joint.
const ARM: &str =
    "<robot name='arm'><link name='base'/><link name='bracket'/><link name='arm'/><link name='tool'/>
    <joint name='mount' type='fixed'><parent link='base'/><child link='bracket'/>
        <origin xyz='0.1 0 0.25' rpy='0.30000 0.40000 0.50000'/></joint>
    <joint name='turn' type='continuous'><parent link='bracket'/><child link='arm'/>
        <origin xyz='0.3 0.1 0'/><axis xyz='0.36000 0.48000 0.80000'/></joint>
    <joint name='flange' type='fixed'><parent link='arm'/><child link='tool'/>
        <origin xyz='0.50000 0.2 0' rpy='0.10000 0 0'/></joint></robot>";

fn parsed(text: &str) -> RobotDescription {
    let source = SourceFile { path: "arm.urdf".into(), text: text.into(), is_foreign: false };
    parse_robot(None, &source.into()).unwrap()
}

fn tool(description: &RobotDescription, q: &RobotQ) -> Vector3<f64> {
    UrdfTree::new(&description.robot).root_from_link(q, description.tip).unwrap().translation
}

fn place(tolerated: &ToleratedChain, name: &str) -> usize {
    let names: Vec<&str> = tolerated.parameters.iter().map(|of| of.name.as_str()).collect();
    names.iter().position(|known| *known == name).unwrap_or_else(|| panic!("no {name} in {names:?}"))
}

/// The parameter at one end of its tolerance is the value with half of a place more: lengths of one file have one last place.
#[track_caller]
fn assert_moves(name: &str, typed: &str, changed: &str) {
    let (nominal, built) = (parsed(ARM), parsed(&ARM.replacen(typed, changed, 1)));
    let tolerated = written_digits(&nominal).unwrap();
    let mut errors = vec![0.0; tolerated.parameters.len()];
    let parameter = place(&tolerated, name);
    errors[parameter] = tolerated.spread.tolerances[parameter];
    let mut at = ErrorMotions::default();
    for angle in [0.0, 0.7, -2.0] {
        let q = robot_q(&nominal, &[angle]);
        tolerated.chain.motions_into(&q, &mut at);
        let shift = tool(&built, &q) - tool(&nominal, &q);
        let found = at.tool_error(&errors).shift_in_base;
        assert!((found - shift).norm() < SECOND_ORDER_M, "{name} at {angle}: {found} {shift}");
    }
}

#[test]
fn the_last_place_of_each_value_moves_the_tool() {
    assert_moves("mount.z", "0 0.25'", "0 0.250005'");
    assert_moves("turn.y", "0.3 0.1 0'", "0.3 0.100005 0'");
    assert_moves("flange.x", "0.50000 0.2", "0.500005 0.2");
    assert_moves("flange.roll", "'0.10000", "'0.100005");
    assert_moves("mount.roll", "'0.30000 0.4", "'0.300005 0.4");
    assert_moves("mount.pitch", "0.40000 ", "0.400005 ");
    assert_moves("mount.yaw", "0.50000'/>", "0.500005'/>");
    // The axis alone is tilted: at zero the tool stays where it is.
    let named = |component: &str| {
        let tolerated = written_digits(&parsed(ARM)).unwrap();
        let axes = tolerated.parameters.iter().filter(|of| of.name.starts_with("turn.axis"));
        let names: Vec<String> = axes.map(|of| of.name.clone()).collect();
        assert_eq!(names.len(), 3, "{names:?}");
        names[["x", "y", "z"].iter().position(|of| *of == component).unwrap()].clone()
    };
    assert_moves(&named("x"), "'0.36000", "'0.360005");
    assert_moves(&named("y"), " 0.48000", " 0.480005");
    assert_moves(&named("z"), "0.80000'", "0.800005'");
}

/// The table of the UR5e: twelve lengths; angles of whole quarter turns are exact.
#[test]
fn a_table_has_the_digits_of_its_lengths() {
    let tolerated = written_digits(&robot("robots/ur5e")).unwrap();
    assert_eq!(tolerated.parameters.len(), 12);
    let half = |name: &str| tolerated.spread.tolerances[place(&tolerated, name)];
    assert!(
        (half("elbow_joint.a") - 5e-5).abs() < 1e-15 && (half("shoulder_lift_joint.a") - 5e-4).abs() < 1e-15
    );
}
