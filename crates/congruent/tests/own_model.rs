//! Robot files without a URDF: a table of either convention and the screws of one robot are the same robot, a wrong value is
//! found with its line, and what needs masses or shapes is refused.
//!
//! The files in `own_models` are four published arms in four forms each. Their screws and the poses below are from numpy
//! (products of the 4x4 matrices of the rows, screws from axis and origin of each frame), which shares nothing with this code.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]
#![expect(clippy::unreadable_literal, reason = "numbers as numpy prints them")]

use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent::{
    agreement::compare::{Agreement, CheckOptions, Grade},
    analysis::conversion::{Conversion, ConversionTarget, DEFAULT_ACCURACY, RoundedAxes, convert},
    check, check_against,
    description::{Joint, RobotDescription, RobotQ, load_robot, parse_robot},
    kinematics::UrdfTree,
    writers::own_robot_file_text,
};
use congruent_input::{Capability, SourceFile};

const ROBOTS: [&str; 4] = ["puma560", "ur5e", "scara", "stanford"];
const FORMS: [&str; 4] = ["standard", "modified", "space", "body"];

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/own_models").join(format!("{name}.toml"))
}

fn robot(name: &str) -> RobotDescription {
    load_robot(&file(name)).unwrap()
}

/// A robot of this text.
fn robot_of(text: &str) -> RobotDescription {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.toml");
    fs::write(&path, text).unwrap();
    load_robot(&path).unwrap()
}

#[track_caller]
fn agree(a: &RobotDescription, b: &RobotDescription) {
    let report = check_against(a, b, &CheckOptions::default()).unwrap();
    let worst = report.geometry.worst.error;
    assert_eq!(report.geometry.verdict, Agreement::Agree, "{} and {}: {worst:?}", a.name, b.name);
    assert!(!report.geometry.comparisons.is_empty());
}

#[track_caller]
fn assert_grade(a: &RobotDescription, b: &RobotDescription, expected: Grade) {
    let report = check_against(a, b, &CheckOptions::default()).unwrap();
    assert_eq!(report.geometry.grade, Some(expected), "{}", report.headline());
}

/// The cause is the length of the row of this joint.
#[track_caller]
fn assert_names_length(a: &RobotDescription, b: &RobotDescription, joint: &str) {
    let report = check_against(a, b, &CheckOptions::default()).unwrap();
    let cause = &report.geometry.diagnosis[0].fault;
    let named = (cause.joint.as_deref(), cause.parameter.as_deref());
    assert_eq!(named, (Some(joint), Some("a")), "{}", cause.message);
}

#[test]
fn every_form_has_the_poses_of_the_matrices() {
    /// Rounding of six products within 1 m, and of the twelve digits of the screws; worst seen 3e-13.
    const ROUNDING: f64 = 1e-11;
    let expected: [(&str, [[f64; 4]; 3]); 4] = [
        (
            "puma560",
            [
                [-0.18882722763110865, -0.3907245885378842, 0.900932058491122, 0.4886924424222684],
                [-0.9620471887654423, -0.11044335785657387, -0.24953450922442427, 0.30823536516226097],
                [0.1970012301831107, -0.9138580637151843, -0.3550407789100784, -0.18645175654355872],
            ],
        ),
        (
            "ur5e",
            [
                [-0.11713309367827253, -0.4323825296523309, 0.8940498791548536, -0.5458674004813097],
                [0.3356920369053968, -0.8644959039193737, -0.37410919323765723, -0.37319541742407725],
                [0.9346607377672729, 0.2563048578511071, 0.24640845179957, 0.44163437262697586],
            ],
        ),
        (
            "scara",
            [
                [0.6216099682706646, -0.7833269096274833, 0.0, 0.5800026678721634],
                [-0.7833269096274833, -0.6216099682706645, 0.0, 0.041410001196293476],
                [0.0, 0.0, -1.0, 0.117],
            ],
        ),
        (
            "stanford",
            [
                [0.45508403540355147, 0.09982424071199698, -0.8848353754722358, -0.4705871541309069],
                [0.5160100906412307, 0.7802743768121283, 0.35341969844205595, 0.18056562763184802],
                [0.7256942242275656, -0.6174196448581128, 0.303580096623665, 0.8604262414059805],
            ],
        ),
    ];
    let q = [0.3, -0.5, 0.12, 0.7, -0.9, 1.1];
    for (name, rows) in expected {
        for form in FORMS {
            let arm = robot(&format!("{name}_{form}"));
            let q = RobotQ::from(q[..arm.robot.dof()].to_vec());
            let pose = UrdfTree::new(&arm.robot).root_from_link(&q, arm.tip).unwrap();
            for (at, row) in rows.iter().enumerate() {
                let found = [
                    pose.rotation[(at, 0)],
                    pose.rotation[(at, 1)],
                    pose.rotation[(at, 2)],
                    pose.translation[at],
                ];
                let off = found.iter().zip(row).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(off <= ROUNDING, "{name} {form} row {at}: {found:?}, expected {row:?}");
            }
        }
    }
}

#[test]
fn the_forms_of_one_robot_agree() {
    for name in ROBOTS {
        let [standard, modified, space, body] = FORMS.map(|form| robot(&format!("{name}_{form}")));
        agree(&standard, &modified);
        agree(&modified, &space);
        agree(&space, &body);
        agree(&body, &standard);
    }
}

#[test]
fn a_table_and_the_urdf_of_the_arm_agree_in_either_order() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/ur5e");
    let with_urdf = load_robot(&folder).unwrap();
    let text = fs::read_to_string(folder.join("robot.toml")).unwrap();
    let kept = text.lines().filter(|line| !line.starts_with("urdf") && !line.starts_with("srdf"));
    let table: Vec<&str> =
        kept.take_while(|line| !line.starts_with("[dynamics]") && !line.starts_with("[[inertial")).collect();
    let table = robot_of(&table.join("\n"));
    agree(&table, &with_urdf);
    agree(&with_urdf, &table);
}

#[test]
fn a_wrong_value_is_named_with_its_line() {
    let right = fs::read_to_string(file("ur5e_standard")).unwrap();
    let line = right.lines().position(|line| line == "a_m = -0.3922").unwrap() + 1;
    let wrong = robot_of(&right.replace("a_m = -0.3922", "a_m = -0.3722"));
    for reference in ["ur5e_modified", "ur5e_space", "ur5e_body"] {
        let reference = robot(reference);
        // Of either order: the table is named where it is the only one.
        for pair in [[&wrong, &reference], [&reference, &wrong]] {
            if reference.dh.is_some() && pair[0].dh.is_some() && !std::ptr::eq(pair[0], &raw const wrong) {
                continue;
            }
            let report = check_against(pair[0], pair[1], &CheckOptions::default()).unwrap();
            assert_eq!(report.geometry.verdict, Agreement::Disagree);
            let cause = &report.geometry.diagnosis[0].fault;
            assert_eq!((cause.joint.as_deref(), cause.parameter.as_deref()), (Some("q3"), Some("a")));
            assert_eq!(cause.line, Some(line), "{}", cause.message);
            assert!(cause.suggestion.contains("-0.3922"), "{}", cause.suggestion);
        }
    }
}

#[test]
fn a_wrong_table_against_a_urdf_is_named_in_either_order() {
    let right = robot("scara_standard");
    let report = convert(&right, &conversion(ConversionTarget::Urdf)).unwrap();
    let source = SourceFile { path: "arm.urdf".into(), text: report.urdf.unwrap(), is_foreign: false };
    let urdf = parse_robot(None, &Arc::new(source)).unwrap();
    let text = fs::read_to_string(file("scara_standard")).unwrap();
    let length = text.lines().find(|line| line.starts_with("a_m = ") && !line.ends_with("= 0.0")).unwrap();
    let wrong = robot_of(&text.replacen(length, "a_m = 0.4567", 1));
    let line = text.lines().position(|of| of == length).unwrap() + 1;
    for pair in [[&wrong, &urdf], [&urdf, &wrong]] {
        let report = check_against(pair[0], pair[1], &CheckOptions::default()).unwrap();
        assert_eq!(report.geometry.verdict, Agreement::Disagree);
        assert_eq!(report.geometry.diagnosis[0].fault.line, Some(line));
    }
}

#[test]
fn other_ranges_in_the_rows_are_a_disagreement() {
    let text = fs::read_to_string(file("scara_standard")).unwrap();
    let range = text.lines().find(|line| line.starts_with("range_deg")).unwrap();
    let other = robot_of(&text.replacen(range, "range_deg = [-1, 1]", 1));
    let report = check_against(&other, &robot("scara_modified"), &CheckOptions::default()).unwrap();
    assert_eq!(report.geometry.verdict, Agreement::Disagree);
    let answer = report.headline().to_string();
    assert!(
        answer.starts_with("SAME GEOMETRY, DIFFERENT JOINT LIMITS: q1: range -1 deg to 1 deg"),
        "{answer}"
    );
}

#[test]
fn wrong_screws_are_named_with_their_row() {
    let right = fs::read_to_string(file("scara_space")).unwrap();
    let wrong = robot_of(&right.replace("v_m = [0.0, -0.325, 0.0]", "v_m = [0.0, -0.335, 0.0]"));
    let report = check_against(&wrong, &robot("scara_body"), &CheckOptions::default()).unwrap();
    assert_eq!(report.geometry.verdict, Agreement::Disagree);
    let cause = &report.geometry.diagnosis[0].fault;
    assert_eq!(cause.joint.as_deref(), Some("q2"), "{}", cause.message);
    let line = right.lines().position(|line| line == "joint = \"q2\"").unwrap() + 1;
    assert_eq!(cause.line, Some(line), "{}", cause.message);
}

/// The tip of the UR5e's table with all lengths a little longer, in the other forms to four and three decimals.
#[test]
fn digits_explain_what_they_leave_open_in_every_form() {
    let exact = fs::read_to_string(file("ur5e_standard")).unwrap();
    // A calibration has all digits.
    let exact = exact.replace("-0.425", "-0.42512345678901234").replace("-0.3922", "-0.39217654321098765");
    let calibrated = robot_of(&exact);
    let rounded = robot_of(
        &exact.replace("-0.42512345678901234", "-0.4251").replace("-0.39217654321098765", "-0.3922"),
    );
    let screws = |decimals: usize| {
        let report = convert(&calibrated, &conversion(ConversionTarget::Poe)).unwrap();
        let text = own_robot_file_text(&calibrated, report.robot_toml.as_deref().unwrap());
        robot_of(&with_decimals(&text, "v_m = [", decimals))
    };
    for other in [rounded, screws(4), screws(3)] {
        for pair in [[&calibrated, &other], [&other, &calibrated]] {
            assert_grade(pair[0], pair[1], Grade::SameWithinDigits);
        }
    }
    // Half a millimetre is no rounding of four decimals.
    let wrong = robot_of(
        &exact.replace("-0.42512345678901234", "-0.4256").replace("-0.39217654321098765", "-0.3922"),
    );
    assert_names_length(&wrong, &calibrated, "q2");
}

/// The same two screws by twist and by a point on the axis, of three decimals: other numbers, of which neither is the rounded other.
#[test]
fn digits_of_a_twist_and_of_a_point_count_both() {
    let arm = |screws: [&str; 2]| {
        let [first, second] = screws;
        robot_of(&format!(
            "[poe]\nframe = 'space'\nhome = {{ xyz_m = [0.451, 0.111, -0.523], rpy_deg = [-90, 20, -180] }}\n\
             joint = [{{ joint = 'j1', kind = 'revolute', {first} }}, {{ joint = 'j2', kind = 'revolute', {second} }}]\n"
        ))
    };
    let axis = "[-0.3420201433256687, 0.0, 0.9396926207859084]";
    let twist = format!("omega = {axis}, v_m = [0.105, 0.195, 0.038]");
    let point = format!("axis = {axis}, point_m = [0, 0.111, -0.571]");
    let by_twist = arm(["omega = [0, 0, -1], v_m = [0, 0, 0]", &twist]);
    let by_point = arm(["axis = [0, 0, -1], point_m = [0, 0, 0]", &point]);
    let elsewhere = arm(["axis = [0, 0, -1], point_m = [0, 0, 0]", &point.replace("0.111", "0.115")]);
    for [a, b] in [[&by_twist, &by_point], [&by_point, &by_twist]] {
        assert_grade(a, b, Grade::SameWithinDigits);
    }
    assert_grade(&by_twist, &elsewhere, Grade::Different);
}

/// A declared zero turns what the digits of an axis leave open, and a wrong row is named although the other table is rounded.
#[test]
fn digits_count_in_other_variables_and_beside_a_wrong_row() {
    let table = |first: &str, second: &str| {
        format!(
            "[dh]\nconvention = 'standard'\ndhn_from_tip = {{ xyz_m = [0, 0.0844, -0.20364], rpy_deg = [20, 20, -90] }}\n\
             row = [{{ joint = 'j1', kind = 'revolute', a_m = {first}, alpha_deg = 180, d_m = -0.58709, theta_deg = -90 }},\n\
             {{ joint = 'j2', kind = 'revolute', a_m = {second}, alpha_deg = 20, d_m = 0, theta_deg = -30 }}]\n"
        )
    };
    let mapped = robot_of(
        &(table("0.42046", "0.52247") + "[mapping.joints]\nj2 = { joint = 'j2', offset_deg = 90 }\n"),
    );
    let screws = robot_of(
        "[poe]\nframe = 'space'\nhome = { xyz_m = [0.5270, -0.2882, -0.4246], rpy_deg = [-160, -40, 120] }\n\
         joint = [{ joint = 'j1', kind = 'revolute', omega = [0, 0, 1], v_m = [0, 0, 0] },\n\
         { joint = 'j2', kind = 'revolute', omega = [0, 0, -1], v_m = [0.4205, 0, 0] }]\n",
    );
    assert_grade(&mapped, &screws, Grade::SameWithinDigits);
    let (wrong, rounded) = (robot_of(&table("0.42046", "0.54247")), robot_of(&table("0.4205", "0.5225")));
    assert_names_length(&wrong, &rounded, "j2");
}

/// The text with the numbers of each list behind this key to some decimals.
fn with_decimals(text: &str, key: &str, decimals: usize) -> String {
    let rounded = |line: &str| {
        let Some((before, list)) = line.split_once(key) else { return line.to_owned() };
        let (list, after) = list.split_once(']').unwrap();
        let numbers = list.split(',').map(|of| of.trim().parse::<f64>().unwrap());
        let numbers: Vec<String> = numbers.map(|of| format!("{of:.decimals$}")).collect();
        format!("{before}{key}{}]{after}", numbers.join(", "))
    };
    text.lines().map(rounded).collect::<Vec<_>>().join("\n")
}

/// Where the axis of a sliding joint lies neither table says: what is compared is the tip.
#[test]
fn a_link_that_slides_is_as_far_off_as_the_link_before_it() {
    let table = fs::read_to_string(file("scara_standard")).unwrap();
    let longer = table.replacen("a_m = 0.325", "a_m = 0.32514", 1);
    assert_ne!(longer, table);
    let report = check_against(&robot_of(&table), &robot_of(&longer), &CheckOptions::default()).unwrap();
    let worst_m = report.geometry.worst.error.position_m;
    assert!((worst_m - 0.14e-3).abs() < 1e-9, "{worst_m}");
}

#[test]
fn alone_there_is_nothing_to_compare() {
    for form in FORMS {
        let arm = robot(&format!("scara_{form}"));
        let report = check(&arm, &CheckOptions::default()).unwrap();
        assert_eq!(report.geometry.verdict, Agreement::NothingCompared);
        assert_eq!(arm.check_capability(Capability::Kinematics), Ok(()));
        for needed in [Capability::Physics, Capability::Clearance] {
            let refused = arm.check_capability(needed).unwrap_err();
            assert_eq!(refused[0].code.name, "robot_file::no_bodies");
        }
    }
}

fn conversion(to: ConversionTarget) -> Conversion {
    Conversion { from: None, to, accuracy: DEFAULT_ACCURACY, seed: 0, rounded_axes: RoundedAxes::Corrected }
}

#[test]
fn conversions_are_the_same_robot() {
    for name in ROBOTS {
        for form in ["standard", "body"] {
            let arm = robot(&format!("{name}_{form}"));
            for to in [ConversionTarget::Standard, ConversionTarget::Modified, ConversionTarget::Poe] {
                let report = convert(&arm, &conversion(to)).unwrap();
                let text = own_robot_file_text(&arm, report.robot_toml.as_deref().unwrap());
                let back = robot_of(&text);
                agree(&back, &arm);
                let ranges = |of: &RobotDescription| {
                    of.robot.joints().iter().map(Joint::position_range).collect::<Vec<_>>()
                };
                assert_eq!(ranges(&back), ranges(&arm), "{text}");
            }
            let report = convert(&arm, &conversion(ConversionTarget::Urdf)).unwrap();
            let text = report.urdf.unwrap();
            let source = SourceFile { path: "arm.urdf".into(), text, is_foreign: false };
            agree(&parse_robot(None, &Arc::new(source)).unwrap(), &arm);
        }
    }
}
