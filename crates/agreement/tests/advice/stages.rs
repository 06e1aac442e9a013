//! Tables that differ from their URDF by one gross fault and by lengths of another source: the gross one is named
//! first whatever the tolerance, then the lengths.

use std::fmt::Write;

use congruent_agreement::{
    compare::CheckReport,
    diagnosis::Cause,
    report::{Fault, ReportedCause},
};

use crate::robots::{Texts, agrees, is_written};

/// Lengths of a UR10, mm: d1, a2, a3, d4, d5, d6.
///
/// The URDF has those of Universal Robots' article "DH Parameters for calculations of kinematics and dynamics", CB3
/// series, as `ur_description` has them.
const URDF_MM: [f64; 6] = [127.3, -612.0, -572.3, 163.941, 115.7, 92.2];
/// The table has those of the arm's drawing in the data sheet (128.0, 163.9), and the arm lengths with the decimals of
/// the `UR10e` row of that article (612.7, 571.55).
const TABLE_MM: [f64; 6] = [128.0, -612.7, -571.55, 163.9, 115.7, 92.2];

/// Joint, `a` and `d` by their place in the lengths, `alpha` in quarter turns.
const UR_ROWS: [(&str, Option<usize>, f64, Option<usize>); 6] = [
    ("shoulder_pan_joint", None, 1.0, Some(0)),
    ("shoulder_lift_joint", Some(1), 0.0, None),
    ("elbow_joint", Some(2), 0.0, None),
    ("wrist_1_joint", None, 1.0, Some(3)),
    ("wrist_2_joint", None, -1.0, Some(4)),
    ("wrist_3_joint", None, 0.0, Some(5)),
];

/// The URDF: its base link looks backwards from the table's base.
fn ur10_urdf() -> String {
    let at = |length: Option<usize>| length.map_or(0.0, |length| URDF_MM[length] / 1000.0);
    let mut text = String::from("<robot name='ur10'>\n<link name='base_link'/>\n");
    let (mut parent, mut origin) = ("base_link", format!("rpy='0 0 {:?}'", std::f64::consts::PI));
    for (joint, a, quarters, d) in UR_ROWS {
        let _ = write!(
            text,
            "<link name='{joint}_link'/>\n<joint name='{joint}' type='revolute'><parent link='{parent}{}'/>\
             <child link='{joint}_link'/>\n<origin {origin}/><axis xyz='0 0 1'/>\
             <limit lower='-6.2' upper='6.2' effort='100' velocity='2'/></joint>\n",
            if parent == "base_link" { "" } else { "_link" },
        );
        parent = joint;
        let roll = quarters * std::f64::consts::FRAC_PI_2;
        origin = format!("xyz='{:?} 0 {:?}' rpy='{roll:?} 0 0'", at(a), at(d));
    }
    let _ = write!(
        text,
        "<link name='tool0'/>\n<joint name='flange' type='fixed'><parent link='{parent}_link'/>\
         <child link='tool0'/><origin {origin}/></joint>\n</robot>\n"
    );
    text
}

/// The table of the data sheet, without its base.
fn ur10(lengths_mm: &[f64; 6]) -> Texts {
    let mut text =
        "urdf = \"ur10.urdf\"\nbase = \"base_link\"\ntip = \"tool0\"\n\n[dh]\nconvention = \"standard\"\n"
            .to_owned();
    let mm = |length: Option<usize>| length.map_or(0.0, |length| lengths_mm[length]);
    for (joint, a, quarters, d) in UR_ROWS {
        let _ = write!(
            text,
            "\n[[dh.row]]\njoint = \"{joint}\"\nkind = \"revolute\"\na_mm = {:?}\nalpha_deg = {:?}\nd_mm = {:?}\n",
            mm(a),
            90.0 * quarters,
            mm(d)
        );
    }
    Texts { name: "ur10".to_owned(), robot_file: text, urdf: ur10_urdf() }
}

fn parts(cause: &ReportedCause) -> Vec<&Fault> {
    if cause.parts.is_empty() { vec![&cause.fault] } else { cause.parts.iter().collect() }
}

/// The first fault, of the named cause or of one that cannot be distinguished from it.
fn first_faults(report: &CheckReport) -> Vec<&Fault> {
    let others = report.indistinguishable.iter().map(|other| &other.cause);
    report.diagnosis.first().into_iter().chain(others).map(|cause| parts(cause)[0]).collect()
}

/// The named cause explains everything, each stage has a smaller residual than the one before, and its advice makes
/// the models agree.
#[track_caller]
fn explains(texts: &Texts, report: &CheckReport, tolerance: f64) {
    let cause = &report.diagnosis[0];
    assert!(cause.within_tolerance, "{}: {}", texts.name, cause.fault.message);
    assert_eq!(cause.stages.len(), parts(cause).len());
    assert!(cause.stages.windows(2).all(|pair| pair[0].after == pair[1].before));
    let largest = &cause.stages[0];
    assert!(largest.after.position_m < 0.1 * largest.before.position_m, "{:?}", cause.stages);
    // A joint that the table lacks is reported in a sentence; the corrections that the file has keys for are listed
    // as well.
    let others = report.indistinguishable.iter().map(|other| &other.cause);
    let can_be_written = |cause: &&ReportedCause| parts(cause).iter().all(|fault| is_written(fault));
    let advised = [cause].into_iter().chain(others).find(can_be_written);
    let advised = advised.unwrap_or_else(|| panic!("{} at {tolerance:e}: {cause:?}", texts.name));
    let corrected = texts.corrected(advised);
    assert!(agrees(&corrected.check(tolerance)), "{}\n{}", texts.name, corrected.robot_file);
}

#[test]
fn the_base_of_a_data_sheet_is_named_before_its_lengths() {
    for tolerance in [1e-9, 1e-6] {
        let texts = ur10(&TABLE_MM);
        let report = texts.check(tolerance);
        explains(&texts, &report, tolerance);
        let cause = &report.diagnosis[0];
        assert_eq!(parts(cause)[0].suggestion, "base_from_dh0 = { rpy_deg = [0, 0, 180] }");
        // No pose distinguishes it from the zero of the first joint.
        assert!(first_faults(&report).iter().any(|fault| fault.cause == Cause::ZeroOffset));
        assert!(cause.stages[0].before.position_m > 2.6 && cause.stages[0].after.position_m < 3e-3);
        let mut lines: Vec<&str> = cause.parts[1..].iter().map(|fault| fault.suggestion.as_str()).collect();
        lines.sort_unstable();
        // 163.9 is 163.941 as it is printed: no mistake.
        assert_eq!(lines, ["a_mm = -572.3", "a_mm = -612", "d_mm = 127.3"]);
    }
}

#[test]
fn a_loose_tolerance_needs_fewer_lengths() {
    let texts = ur10(&TABLE_MM);
    for (tolerance, faults) in [(1e-3, 2..=4), (5e-3, 1..=1)] {
        let report = texts.check(tolerance);
        explains(&texts, &report, tolerance);
        let cause = &report.diagnosis[0];
        assert!(faults.contains(&parts(cause).len()), "{}", cause.fault.message);
        // Digits that the residual does not determine are not written.
        assert_eq!(parts(cause)[0].suggestion, "base_from_dh0 = { rpy_deg = [0, 0, 180] }");
    }
}

/// Quarter turns with nine decimals are off by 2e-9 rad; three values of the table would have to make up for it.
#[test]
fn rounded_quarter_turns_of_the_urdf_are_named_beside_lengths() {
    let mut lengths_mm = URDF_MM;
    (lengths_mm[0], lengths_mm[1]) = (127.8, -611.4);
    let mut texts = ur10(&lengths_mm);
    texts.robot_file = texts.robot_file.replace(
        "convention = \"standard\"\n",
        "convention = \"standard\"\nbase_from_dh0 = { rpy_deg = [0, 0, 180] }\n",
    );
    texts.urdf = texts.urdf.replace("1.5707963267948966", "1.570796325");
    let report = texts.check(1e-9);
    let cause = &report.diagnosis[0];
    assert!(cause.within_tolerance && cause.parts.len() == 3, "{}", cause.fault.message);
    let rounding = cause.parts.iter().find(|fault| fault.parameter.as_deref() == Some("rpy")).unwrap();
    assert!(rounding.message.contains("rpy=\"1.570796325 0 0\""), "{}", rounding.message);
    assert!(rounding.suggestion.contains("1.5707963267948966"), "{}", rounding.suggestion);
    let value = rounding.value.unwrap();
    assert!((1e-9..3e-9).contains(&value), "{value:e}");
}

#[test]
fn a_table_without_a_common_cause_is_shown_row_by_row() {
    // Every length and several angles.
    let mut texts = ur10(&TABLE_MM.map(|length| length + 3.0 + 0.01 * length));
    for (from, to) in [("alpha_deg = 90.0", "alpha_deg = 84.0"), ("alpha_deg = 0.0", "alpha_deg = 7.0")] {
        texts.robot_file = texts.robot_file.replace(from, to);
    }
    texts.robot_file = texts.robot_file.replace("a_mm = 0.0", "a_mm = 11.0\ntheta_deg = 5.0");
    let report = texts.check(1e-9);
    assert!(!report.diagnosis[0].within_tolerance);
    let table = report.diagnoses[0].table.as_ref().unwrap();
    assert!(table.residual.position_m < 1e-9, "{:?}", table.residual);
    assert_eq!(table.values.len(), 6 * 4 + 2);
    let value = |joint: &str, key: &str| {
        let is_it = |value: &&congruent_agreement::report::ComparedValue| {
            value.joint.as_deref() == Some(joint) && value.key == key
        };
        table.values.iter().find(is_it).unwrap()
    };
    let a2 = value("shoulder_lift_joint", "a_mm");
    assert_eq!((a2.expected.as_str(), a2.differs), ("-612", true));
    let alpha4 = value("wrist_1_joint", "alpha_deg");
    assert_eq!((alpha4.found.as_str(), alpha4.expected.as_str(), alpha4.differs), ("84", "90", true));
}

/// Tables of some makers leave all signs out. Three joints that are turned around, every third choice of them.
#[test]
fn three_signs_are_named_together() {
    for robot in ["ur5e", "panda"] {
        let texts = Texts::named(robot);
        let joints = texts.robot_file.matches("sign = 1").count();
        let triples = (0..joints).flat_map(|a| (0..a).flat_map(move |b| (0..b).map(move |c| (a, b, c))));
        for (a, b, c) in triples.step_by(3) {
            let mut robot_file = String::new();
            for (index, piece) in texts.robot_file.split("sign = 1").enumerate() {
                let sign = |joint: usize| if [a, b, c].contains(&joint) { "sign = -1" } else { "sign = 1" };
                robot_file += index.checked_sub(1).map_or("", sign);
                robot_file += piece;
            }
            let flipped = Texts { robot_file, ..texts.clone() };
            let report = flipped.check(1e-9);
            let cause = &report.diagnosis[0];
            assert!(cause.within_tolerance, "{robot} {a} {b} {c}: {}", cause.fault.message);
            let others = report.indistinguishable.iter().map(|other| &other.cause);
            let is_signs = |cause: &ReportedCause| {
                cause.parts.len() == 3 && cause.parts.iter().all(|fault| fault.cause == Cause::AxisFlipped)
            };
            assert!([cause].into_iter().chain(others).any(is_signs), "{robot} {a} {b} {c}: {cause:?}");
            assert!(agrees(&flipped.corrected(cause).check(1e-9)), "{robot} {a} {b} {c}");
        }
    }
}

/// A change of a line within the row of a joint, or anywhere for an empty name.
fn replaced(texts: &Texts, joint: &str, from: &str, to: &str) -> Texts {
    let file = &texts.robot_file;
    let row = if joint.is_empty() { 0 } else { file.find(&format!("joint = \"{joint}\"")).unwrap() };
    let at = row + file[row..].find(from).unwrap_or_else(|| panic!("no {from} in {joint}"));
    let mut robot_file = file.clone();
    robot_file.replace_range(at..at + from.len(), to);
    Texts { robot_file, ..texts.clone() }
}

/// Joint, line, other line.
type Change<'a> = (&'a str, &'a str, &'a str);

/// Gross faults together with small differences of lengths.
#[track_caller]
fn gross_comes_first(robot: &str, lengths: &[Change<'_>], gross: &[(Cause, &[Change<'_>])]) {
    for (expected, changes) in gross {
        let faults = changes.iter().chain(lengths);
        let texts =
            faults.fold(Texts::named(robot), |texts, (joint, from, to)| replaced(&texts, joint, from, to));
        for tolerance in [1e-6, 1e-3, 5e-3] {
            let report = texts.check(tolerance);
            explains(&texts, &report, tolerance);
            let first = first_faults(&report);
            let causes: Vec<Cause> = first.iter().map(|fault| fault.cause).collect();
            // The base that is left out is a fixed joint of the URDF, half a turn, which says more.
            let is_named = causes.contains(expected)
                || (*expected == Cause::Base && causes.contains(&Cause::FixedJointDropped));
            assert!(
                is_named,
                "{robot} at {tolerance:e}: {expected} is not among {causes:?}: {}",
                report.diagnosis[0].fault.message
            );
        }
    }
}

#[test]
fn gross_faults_of_a_standard_table_are_named_before_its_lengths() {
    gross_comes_first(
        "ur5e",
        &[
            ("shoulder_pan_joint", "d_m = 0.1625", "d_m = 0.1631"),
            ("shoulder_lift_joint", "a_m = -0.425", "a_m = -0.4244"),
            ("wrist_2_joint", "d_m = 0.0997", "d_m = 0.0992"),
        ],
        &[
            (Cause::ConventionSwapped, &[("", "\"standard\"", "\"modified\"")]),
            (Cause::AxisFlipped, &[("elbow_joint", "sign = 1", "sign = -1")]),
            (Cause::Tool, &[("", "dhn_from_tip = {}", "dhn_from_tip = { xyz_m = [0, 0, 0.12] }")]),
            (Cause::Base, &[("", "base_from_dh0 = { rpy_deg = [0, 0, 180] }", "base_from_dh0 = {}")]),
            (
                Cause::JointsSwapped,
                &[
                    ("", "joint = \"elbow_joint\"", "joint = \"wrist_2_joint\""),
                    ("wrist_1_joint", "joint = \"wrist_2_joint\"", "joint = \"elbow_joint\""),
                ],
            ),
            (Cause::MillimetresAsMetres, &[("elbow_joint", "a_m = -0.3922", "a_m = -392.2")]),
            (Cause::ZeroOffset, &[("shoulder_lift_joint", "theta_deg = 0.0", "theta_deg = -90.0")]),
        ],
    );
}

#[test]
fn gross_faults_of_a_modified_table_are_named_before_its_lengths() {
    gross_comes_first(
        "panda",
        &[
            ("panda_joint1", "d_m = 0.333", "d_m = 0.3353"),
            ("panda_joint3", "d_m = 0.316", "d_m = 0.3143"),
            ("panda_joint5", "d_m = 0.384", "d_m = 0.3865"),
        ],
        &[
            (Cause::ConventionSwapped, &[("", "\"modified\"", "\"standard\"")]),
            (Cause::AxisFlipped, &[("panda_joint4", "sign = 1", "sign = -1")]),
            (Cause::Tool, &[("", "dhn_from_tip = { xyz_m = [0.0, 0.0, 0.107] }", "dhn_from_tip = {}")]),
            (Cause::MillimetresAsMetres, &[("panda_joint7", "a_m = 0.088", "a_m = 88.0")]),
        ],
    );
}

/// Three wrong values hide so much of the difference that the convention alone explains nothing; signs of angles turn the
/// table so far that no fit from its values ends at the right ones.
#[test]
fn the_convention_is_found_beneath_large_faults() {
    let of_ur5e: [Change<'_>; 4] = [
        ("", "\"standard\"", "\"modified\""),
        ("shoulder_lift_joint", "a_m = -0.425", "a_m = 0.425"),
        ("wrist_1_joint", "d_m = 0.1333", "d_m = 0.1133"),
        ("shoulder_pan_joint", "d_m = 0.1625", "d_m = 0.1652"),
    ];
    let of_panda: [Change<'_>; 4] = [
        ("", "\"modified\"", "\"standard\""),
        ("panda_joint3", "alpha_deg = 90.0", "alpha_deg = -90.0"),
        ("panda_joint4", "a_m = 0.0825", "a_m = -0.0825"),
        ("panda_joint5", "d_m = 0.384", "d_m = 0.348"),
    ];
    for (robot, changes) in [("ur5e", of_ur5e), ("panda", of_panda)] {
        let given = Texts::named(robot);
        let texts = changes.iter().fold(given, |texts, (joint, from, to)| replaced(&texts, joint, from, to));
        for tolerance in [1e-9, 1e-3] {
            let report = texts.check(tolerance);
            let cause = &report.diagnosis[0];
            assert!(cause.within_tolerance, "{robot} at {tolerance:e}: {}", cause.fault.message);
            let is_convention = |fault: &&Fault| fault.cause == Cause::ConventionSwapped;
            let others = report.indistinguishable.iter().map(|other| &other.cause);
            let mut all = [cause].into_iter().chain(others);
            assert!(all.any(|cause| parts(cause).iter().any(is_convention)), "{}", cause.fault.message);
            assert!(agrees(&texts.corrected(cause).check(tolerance)), "{robot} at {tolerance:e}");
        }
    }
}
