//! Unit mistakes planted in one arm are reported, and the arm itself gets no warning.

use std::sync::Arc;

use congruent_description::parse_robot;
use congruent_input::SourceFile;

use super::*;

/// An arm as a drawing has it: two links of aluminium tube, a gripper that slides.
const ARM: &str = "<robot name='arm'>
<link name='base'/>
<link name='upper'><inertial><origin xyz='0.2 0 0'/><mass value='2'/>
<inertia ixx='0.0021' ixy='0' ixz='0' iyy='0.028' iyz='0' izz='0.028'/></inertial>
<visual><origin xyz='0.2 0 0'/><geometry><box size='0.4 0.08 0.08'/></geometry></visual></link>
<link name='lower'><inertial><origin xyz='0.15 0 0'/><mass value='1.2'/>
<inertia ixx='0.0009' ixy='0' ixz='0' iyy='0.0098' iyz='0' izz='0.0098'/></inertial>
<visual><origin xyz='0.15 0 0'/><geometry><box size='0.3 0.06 0.06'/></geometry></visual></link>
<link name='finger'><inertial><mass value='0.06'/>
<inertia ixx='1.1e-5' ixy='0' ixz='0' iyy='1.2e-5' iyz='0' izz='1.4e-5'/></inertial>
<visual><geometry><box size='0.04 0.03 0.03'/></geometry></visual></link>
<joint name='shoulder' type='revolute'><origin xyz='0 0 0.1'/><parent link='base'/><child link='upper'/>
<limit lower='-2' upper='2' velocity='3.1' effort='40'/></joint>
<joint name='elbow' type='revolute'><origin xyz='0.4 0 0'/><parent link='upper'/><child link='lower'/>
<limit lower='-2' upper='2' velocity='4.2' effort='20'/></joint>
<joint name='grip' type='prismatic'><origin xyz='0.3 0 0'/><parent link='lower'/><child link='finger'/>
<limit lower='0' upper='0.05' velocity='0.2' effort='20'/></joint>
</robot>";

fn findings(urdf: &str) -> Vec<(&'static str, String)> {
    let source = Arc::new(SourceFile { path: "arm.urdf".into(), text: urdf.to_owned(), is_foreign: false });
    let description = parse_robot(None, &source).unwrap();
    unit_mistakes(&description).into_iter().map(|found| (found.code.name, found.message)).collect()
}

#[track_caller]
fn check(from: &str, to: &str, code: &str, message: &str) {
    assert!(ARM.contains(from), "{from}");
    let found = findings(&ARM.replacen(from, to, 1));
    assert!(
        found.iter().any(|(of, said)| *of == code && said.contains(message)),
        "{from} to {to}: {found:?}"
    );
}

#[test]
fn an_arm_as_it_should_be_is_not_reported() {
    assert_eq!(findings(ARM), []);
}

#[test]
fn efforts_in_n_mm_and_damping_times_1000_are_reported() {
    check(
        "effort='40'",
        "effort='40000'",
        "units::effort",
        "40000 N m, which times its velocity limit is 124",
    );
    check("velocity='4.2' effort='20'/>", "velocity='4.2' effort='21500'/>", "units::effort", "\"elbow\"");
    let damped = |damping: &str| {
        findings(&ARM.replacen("effort='40'/>", &format!("effort='40'/><dynamics damping='{damping}'/>"), 1))
    };
    assert_eq!(damped("12"), []);
    let found = damped("30");
    assert!(found.len() == 1 && found[0].1.contains("takes 93 N m, 2.33 times"), "{found:?}");
    let found = damped("12000");
    assert!(found.len() == 1 && found[0].0 == "units::damping", "{found:?}");
    assert!(found[0].1.contains("takes 37200 N m, 930 times its effort limit"), "{found:?}");
    // What stands for "no limit" is no mistake.
    for effort in ["1000", "100000", "1e9"] {
        assert_eq!(findings(&ARM.replacen("effort='40'", &format!("effort='{effort}'"), 1)), [], "{effort}");
    }
}

#[test]
fn friction_that_no_motor_overcomes_is_reported() {
    let with = |friction: &str| {
        findings(&ARM.replacen(
            "effort='40'/>",
            &format!("effort='40'/><dynamics friction='{friction}'/>"),
            1,
        ))
    };
    assert_eq!(with("39"), []);
    let found = with("2400");
    assert!(found.len() == 1 && found[0].0 == "units::friction", "{found:?}");
    assert!(found[0].1.contains("more than its effort limit of 40 N m"), "{found:?}");
}

/// A wrist of small motors is many times faster than the arm, as of fast industrial arms; with the torque of the others it is a speed in
/// another unit.
#[test]
fn a_wrist_of_little_power_may_be_fast() {
    let wrist = |effort: &str| {
        let joint = |(at, velocity): (usize, &str)| {
            let (parent, child) = (if at == 0 { "lower".to_owned() } else { format!("w{at}") }, at + 1);
            format!(
                "<link name='w{child}'/><joint name='w{child}' type='revolute'><origin xyz='0 0 0.02'/><parent link='{parent}'/>\
                 <child link='w{child}'/><limit lower='-2' upper='2' velocity='{velocity}' effort='{effort}'/></joint>"
            )
        };
        let joints: String = ["4", "30", "4"].into_iter().enumerate().map(joint).collect();
        findings(&ARM.replace("</robot>", &format!("{joints}</robot>")))
    };
    assert_eq!(wrist("1"), []);
    let found = wrist("15");
    assert!(found.len() == 1 && found[0].0 == "units::speed", "{found:?}");
}

/// The shape of the parent reaches to the joint, however long it is beside the others.
#[test]
fn an_origin_at_the_end_of_its_parents_shape_is_not_reported() {
    let mast = |length_m: f64| {
        let chain: Vec<String> = ["0.05", "0.08", "0.05"]
            .into_iter()
            .enumerate()
            .map(|(at, z)| {
                let (parent, child) = (if at == 0 { "finger".to_owned() } else { format!("l{at}") }, at + 1);
                format!(
                    "<link name='l{child}'><visual><origin xyz='0 0 {0}'/><geometry><box size='0.1 0.1 {length_m}'/></geometry>\
                     </visual></link><joint name='j{child}' type='continuous'><origin xyz='0 0 {z}'/><parent link='{parent}'/>\
                     <child link='l{child}'/></joint>",
                    length_m / 2.0
                )
            })
            .collect();
        let head = "<link name='head'/><joint name='tilt' type='continuous'><origin xyz='0 0 1.9'/><parent link='l3'/>\
                    <child link='head'/></joint></robot>";
        findings(&ARM.replace("</robot>", &format!("{}{head}", chain.concat())))
    };
    let of_tilt = |found: Vec<(&str, String)>| found.into_iter().any(|(_, said)| said.contains("\"tilt\""));
    assert!(!of_tilt(mast(1.8)));
    assert!(of_tilt(mast(0.2)));
}

/// A footprint far below the arm, with a box that is to be seen.
#[test]
fn a_footprint_is_at_any_distance() {
    let footprint = "<link name='footprint'><visual><geometry><box size='0.05 0.05 0.01'/></geometry></visual></link>\
         <joint name='foot' type='fixed'><origin xyz='0 0 0.9'/><parent link='footprint'/><child link='base'/></joint></robot>";
    assert_eq!(findings(&ARM.replace("</robot>", footprint)), []);
}

#[test]
fn one_length_in_inches_is_reported() {
    let chain = |last_m: &str| {
        let lengths_m = ["0.3", "0.25", "0.2", "0.1", last_m];
        let joint = |(at, length_m): (usize, &&str)| {
            format!(
                "<link name='l{0}'/><joint name='j{at}' type='continuous'><origin xyz='0 0 {length_m}'/>\
                 <parent link='l{at}'/><child link='l{0}'/></joint>",
                at + 1
            )
        };
        let joints: String = lengths_m.iter().enumerate().map(joint).collect();
        findings(&format!("<robot name='r'><link name='l0'/>{joints}</robot>"))
    };
    assert_eq!(chain("0.08"), []);
    let found = chain("3.15");
    assert!(found.len() == 1 && found[0].0 == "units::origin" && found[0].1.contains("\"j4\""), "{found:?}");
}

#[test]
fn what_belongs_together_reveals_a_mistake() {
    check("mass value='2'", "mass value='2000'", "units::mass", "781250 kg/m^3");
    check("mass value='0.06'", "mass value='60'", "units::mass", "link \"finger\"");
    // Masses in t: far too light for the shapes and for the tensor alike, whatever their size.
    check(
        "mass value='0.06'",
        "mass value='0.00006'",
        "units::mass",
        "link \"finger\": its mass is 6.0e-5 kg",
    );
    check("mass value='2'", "mass value='0.002'", "units::mass", "link \"upper\": its mass is 0.002 kg");
    check(
        "ixx='0.0009' ixy='0' ixz='0' iyy='0.0098' iyz='0' izz='0.0098'",
        "ixx='900' ixy='0' ixz='0' iyy='9800' iyz='0' izz='9800'",
        "units::inertia",
        "radius of gyration is 75.5 m",
    );
    check(
        "ixx='0.0009' ixy='0' ixz='0' iyy='0.0098' iyz='0' izz='0.0098'",
        "ixx='9e-10' ixy='0' ixz='0' iyy='9.8e-9' iyz='0' izz='9.8e-9'",
        "units::inertia",
        "link \"lower\"",
    );
    check("velocity='3.1'", "velocity='178'", "units::speed", "178 rad/s");
    check("upper='0.05'", "upper='50'", "units::travel", "over 50 m");
    check("upper='0.05'", "upper='5'", "units::travel", "over 5000 mm");
    check("velocity='0.2'", "velocity='200'", "units::slide_speed", "200 m/s");
    check("xyz='0.15 0 0'/><mass", "xyz='1.5 0 0'/><mass", CENTER, "away from its shapes and joints");
    check("xyz='0.3 0 0'/><parent", "xyz='5 0 0'/><parent", "units::origin", "joint \"grip\"");
    check("size='0.3 0.06 0.06'", "size='9.9 6 6'", "units::large_shape", "link \"lower\"");
}

/// The arm on a rail.
#[test]
fn a_track_may_be_long_but_not_in_millimetres() {
    let rail = |travel_m: &str| {
        let rail = format!(
            "<link name='floor'/><joint name='rail' type='prismatic'><parent link='floor'/><child link='base'/>\
             <limit lower='0' upper='{travel_m}' velocity='1.5' effort='900'/></joint></robot>"
        );
        findings(&ARM.replace("</robot>", &rail))
    };
    assert_eq!(rail("12"), []);
    for length in ["1200", "12000"] {
        let found = rail(length);
        assert!(
            found.iter().any(|(code, said)| *code == "units::travel" && said.contains("rail")),
            "{found:?}"
        );
    }
}

const CENTER: &str = congruent_description::codes::urdf::CENTER_OF_MASS.name;

/// A wrist without shapes, whose mass is in grams, and the same mass at the base, which may be a foundation.
#[test]
fn a_carried_link_that_outweighs_the_robot_is_reported() {
    let wrist = ARM.replace("<visual><geometry><box size='0.04 0.03 0.03'/></geometry></visual>", "");
    let with =
        |mass: &str| findings(&wrist.replacen("mass value='0.06'", &format!("mass value='{mass}'"), 1));
    assert_eq!(with("0.06"), []);
    let found = with("60");
    assert!(
        found.len() == 1
            && found[0].0 == "units::mass"
            && found[0].1.contains("all other links together have 3.2 kg"),
        "{found:?}"
    );
    let heavy_base = "<link name='base'><inertial><mass value='600'/>\
                      <inertia ixx='60' ixy='0' ixz='0' iyy='61' iyz='0' izz='62'/></inertial></link>";
    assert_eq!(findings(&ARM.replacen("<link name='base'/>", heavy_base, 1)), []);
}
