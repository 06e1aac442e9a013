//! Robot files with one fault each.

use std::f64::consts::FRAC_PI_2;

use congruent_input::{Severity, line_column, toml_text::parse_toml};
use congruent_robot::{DhRowKind, JointKind};

use super::*;

/// base -(fixed)- root -a- one -b- two -(fixed)- tip, and a joint c that follows b beside it.
fn robot() -> Robot {
    let joint = |name: &str, kind: &str, parent: &str, child: &str, more: &str| {
        format!(
            "<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>\
             <limit lower='-1' upper='1' effort='1' velocity='1'/>{more}</joint><link name='{child}'/>"
        )
    };
    let text = format!(
        "<robot name='r'><link name='base'/>{}{}{}{}{}</robot>",
        joint("mount", "fixed", "base", "root", ""),
        joint("a", "revolute", "root", "one", ""),
        joint("c", "revolute", "one", "side", "<mimic joint='b'/>"),
        joint("b", "prismatic", "one", "two", ""),
        joint("flange", "fixed", "two", "tip", ""),
    );
    crate::parse_urdf(&text).unwrap_or_else(|found| panic!("{found:#?}"))
}

const GOOD: &str = "\
name = 'r'
urdf = 'r.urdf'
base = 'base'
tip = 'tip'
[dh]
convention = 'modified'
base_from_dh0 = { rpy_deg = [0, 0, 180] }
[[dh.row]]
joint = 'a'
kind = 'revolute'
a_mm = 100
alpha_deg = 90.0
d_m = 0.2
theta_deg = -90
sign = -1
[[dh.row]]
joint = 'b'
kind = 'prismatic'
a_m = 0
alpha_rad = 0.0
d_m = 0
";

fn read(text: &str) -> (Option<Declared>, Vec<Diagnostic>) {
    let mut diagnostics = Diagnostics::default();
    let declared = parse_toml(text, &mut diagnostics)
        .and_then(|written| check(&written, text, &robot(), &mut diagnostics));
    (declared, diagnostics.into_vec())
}

/// The good file with one change has exactly this diagnostic, on this line.
#[track_caller]
fn one(from: &str, to: &str, severity: Severity, line: usize, message: &str) {
    assert!(GOOD.contains(from));
    let text = GOOD.replacen(from, to, 1);
    let (_, diagnostics) = read(&text);
    let [found] = &diagnostics[..] else { panic!("{diagnostics:#?}") };
    assert!(found.message.contains(message), "{}", found.message);
    assert_eq!(found.severity, severity);
    assert_eq!(line_column(&text, found.span.as_ref().unwrap().start).0, line, "{found:?}");
}

#[track_caller]
fn error(from: &str, to: &str, line: usize, message: &str) {
    one(from, to, Severity::Error, line, message);
}

#[track_caller]
fn warning(from: &str, to: &str, line: usize, message: &str) {
    one(from, to, Severity::Warning, line, message);
}

#[test]
fn a_good_file_gives_si_units() {
    let (declared, diagnostics) = read(GOOD);
    assert_eq!(diagnostics, []);
    let (declared, robot) = (declared.unwrap(), robot());
    assert_eq!(
        (robot.link(declared.base).name.as_str(), robot.link(declared.tip).name.as_str()),
        ("base", "tip")
    );
    let dh = declared.dh.unwrap();
    let [first, second] = dh.rows[..] else { panic!("{dh:?}") };
    assert_eq!((first.a_m, first.alpha_rad, first.d_m), (0.1, FRAC_PI_2, 0.2));
    assert_eq!((first.theta_rad, first.sign, first.line), (-FRAC_PI_2, -1.0, 8));
    assert_eq!(
        (second.kind, second.theta_rad, second.sign, second.line),
        (DhRowKind::Prismatic, 0.0, 1.0, 16)
    );
    assert_eq!(robot.joint(second.joint).kind, JointKind::Prismatic);
    assert_eq!(declared.tolerance, Tolerance::default());
    assert_eq!(dh.dhn_from_tip, Isometry3::identity());
}

#[test]
fn base_and_tip_have_defaults() {
    let (declared, _) = read("urdf = 'r.urdf'");
    let (declared, robot) = (declared.unwrap(), robot());
    assert_eq!(declared.base, robot.root());
    // One joint carries two that move together: fingers.
    assert_eq!(robot.link(declared.tip).name, "one");
    assert_eq!(declared.chain_ends, ChainEnds { base: ChainEnd::Chosen, tip: ChainEnd::Chosen });
}

#[test]
fn names_are_checked() {
    error("tip = 'tip'", "tip = 'top'", 4, "tip = \"top\": the robot has no such link");
    error("base = 'base'", "base = 'side'", 4, "tip \"tip\" is not a descendant of base \"side\"");
    error("joint = 'a'", "joint = 'z'", 9, "joint \"z\" is not in the robot");
    error("joint = 'a'", "joint = 'c'", 9, "joint \"c\" is not in the chain");
    error("joint = 'a'", "joint = 'mount'", 9, "joint \"mount\" is fixed");
    error("sign", "sing", 15, "unknown key \"sing\"");
}

#[test]
fn the_table_must_fit_the_chain() {
    let second = &GOOD[GOOD.rfind("[[dh.row]]").unwrap()..];
    error(
        second,
        "",
        5,
        "the table has 1 row, but the chain from base to tip has 2 moving joints: no row for b",
    );
    // A joint that follows another one moves the tip like any other.
    let following = GOOD.replace(second, "").replace("tip = 'tip'", "tip = 'side'");
    let found = read(&following).1;
    assert_eq!(
        found.iter().map(|found| found.message.as_str()).collect::<Vec<_>>(),
        [
            "rows are missing for joints with <mimic>, which do not move in the table then: \"c\" (follows \"b\")"
        ]
    );
    assert_eq!(found[0].severity, Severity::Warning);
    let twice = GOOD.replacen("joint = 'b'", "joint = 'a'", 1);
    let messages: Vec<String> = read(&twice).1.into_iter().map(|found| found.message).collect();
    assert_eq!(
        messages,
        [
            "joint \"a\" has two rows (lines 8, 16), joint \"b\" has none",
            "the row is prismatic, but joint \"a\" of the URDF moves in radians",
        ]
    );
    let swapped = GOOD.replace("'a'", "'x'").replace("'b'", "'a'").replace("'x'", "'b'");
    let codes: Vec<&str> = read(&swapped).1.into_iter().map(|found| found.code.name).collect();
    // Both rows are of the wrong kind, which is one warning.
    assert_eq!(codes, ["robot_file::row_kind", "robot_file::row_order"]);
    warning("kind = 'revolute'", "kind = 'prismatic'", 10, "the row is prismatic, but joint \"a\"");
}

#[test]
fn a_misspelt_key_is_the_only_finding_about_it() {
    for (from, to, message) in [
        ("convention", "conventon", "unknown key \"conventon\""),
        ("d_m = 0.2", "dd_m = 0.2", "unknown key \"dd_m\""),
        ("d_m = 0.2", "d_cm = 20", "unknown key \"d_cm\""),
        ("alpha_rad = 0.0", "alfa_rad = 0.0", "unknown key \"alfa_rad\""),
        ("joint = 'a'", "jiont = 'a'", "unknown key \"jiont\""),
    ] {
        let found = read(&GOOD.replacen(from, to, 1)).1;
        let messages: Vec<&str> = found.iter().map(|found| found.message.as_str()).collect();
        assert_eq!(messages, [message]);
    }
    let rows = read(&GOOD.replace("[[dh.row]]", "[[dh.rows]]")).1;
    let messages: Vec<&str> = rows.iter().map(|found| found.message.as_str()).collect();
    assert_eq!(messages, ["unknown key \"rows\""]);
    // The key of another row is missing all the same.
    let other = GOOD.replacen("d_m = 0.2\n", "", 1).replace("alpha_rad = 0.0", "alfa_rad = 0.0");
    assert_eq!(read(&other).1.len(), 2);
    let offset = read(&GOOD.replacen("d_m = 0.2", "d_m = 0.2\noffset_deg = 0", 1)).1;
    assert_eq!(offset[0].help.as_deref(), Some("the offset of a data sheet is theta_deg"));
}

#[test]
fn names_that_all_lack_a_prefix_are_one_finding() {
    let prefixed = GOOD.replace("joint = 'a'", "joint = 'left_a'").replace("joint = 'b'", "joint = 'left_b'");
    let found = read(&prefixed).1;
    let messages: Vec<&str> = found.iter().map(|found| found.message.as_str()).collect();
    let message =
        "no joint of the table is in the robot: the URDF has all of them without the prefix \"left_\"";
    assert_eq!(messages, [message]);
    assert_eq!(found[0].help.as_deref(), Some("write in the rows: a, b"));
}

#[test]
fn values_are_checked() {
    error("convention = 'modified'\n", "", 5, "[dh] has no convention");
    error("d_m = 0.2", "d_m = nan", 13, "d_m is NaN");
    error("d_m = 0.2\n", "", 8, "row of joint \"a\" has neither d_m nor d_mm");
    error("d_m = 0.2", "d_m = 0.2\nd_mm = 200", 14, "d_m and d_mm are both given");
    error("sign = -1", "sign = -2", 15, "sign must be 1 or -1, it is -2");
    warning("alpha_rad = 0.0", "alpha_rad = 90", 20, "alpha_rad = 90 is more than a full turn");
    error(
        "tip = 'tip'",
        "tip = 'tip'\ntolerance = { position_m = 0 }",
        5,
        "tolerance of position must be greater than 0",
    );
    error("tip = 'tip'", "tip = 'tip'\ntolerance = { orientation_deg = nan }", 5, "orientation_deg is NaN");
    error("tip = 'tip'", "tip = 'tip'\ntcp = { quaternion_wxyz = [0.5, 0.5, 0.5, 0.6] }", 5, "norm 1.05");
}
