//! Published arms with parallel axes and with quarter turns in few digits, against URDFs whose frames are elsewhere than
//! those of the table: one wrong value is one cause, whatever the digits of the angles.

use std::fmt::Write;

use congruent_agreement::{
    compare::{CheckReport, Grade},
    diagnosis::Cause,
};

use crate::robots::{Texts, agrees};

/// A joint of a URDF: kind, xyz, rpy and axis; `%90`, `%180` and `%45` are angles to be written.
type Joint = (&'static str, &'static str, &'static str, &'static str);

/// A row of a table: a, alpha, d and theta, in m and degrees.
type Row = [f64; 4];

/// An arm as its table and its URDF have it.
struct Arm {
    joints: &'static [Joint],
    rows: Vec<Row>,
    prismatic: Option<usize>,
    base: &'static str,
    tool: String,
}

/// A SCARA arm: all axes are parallel, so that only the sum of its offsets matters.
fn scara() -> Arm {
    Arm {
        joints: &[
            ("revolute", "0 0 0", "0 0 0", "0 0 1"),
            ("revolute", "0.325 0 0.387", "0 0 0", "0 0 1"),
            ("prismatic", "0.275 0 0.033", "0 0 0", "0 0 -1"),
            ("revolute", "0 0 -0.05", "0 0 0", "0 0 -1"),
            ("fixed", "0 0 -0.0505", "%180 0 %45", ""),
        ],
        rows: vec![
            [0.325, 0.0, 0.387, 0.0],
            [0.275, 180.0, 0.033, 0.0],
            [0.0, 0.0, 0.05, 0.0],
            [0.0, 0.0, 0.02, 0.0],
        ],
        prismatic: Some(2),
        base: "",
        tool: "xyz_m = [0, 0, 0.0305], rpy_deg = [0, 0, -45]".to_owned(),
    }
}

/// KR 6 with frames of its URDF beside those of the table.
fn kr6() -> Arm {
    Arm {
        joints: &[
            ("revolute", "0 0 0.014", "0 0 %90", "0 0 1"),
            ("revolute", "-0.049 -0.025 0.386", "-%90 0 -%90", "0 0 1"),
            ("revolute", "0.455 0 0.101", "0 0 -%90", "0 0 1"),
            ("revolute", "0.035 0.03 -0.052", "-%90 -%90 0", "0 0 1"),
            ("revolute", "-0.081 0 0.39", "-%180 -%90 0", "0 0 1"),
            ("revolute", "0.079 0 0.081", "-%90 0 -%90", "0 0 1"),
            ("fixed", "0 0 0.0315", "0 0 -%45", ""),
        ],
        rows: vec![
            [0.025, -90.0, 0.4, 0.0],
            [0.455, 0.0, 0.0, 0.0],
            [0.035, -90.0, 0.0, -90.0],
            [0.0, 90.0, 0.42, 0.0],
            [0.0, -90.0, 0.0, 0.0],
            [0.0, 0.0, 0.08, 0.0],
        ],
        prismatic: None,
        base: "",
        tool: "xyz_m = [0, 0, 0.0305], rpy_deg = [0, 0, -45]".to_owned(),
    }
}

/// AUBO i5.
fn aubo() -> Arm {
    Arm {
        joints: &[
            ("revolute", "0 0 0", "0 0 0", "0 0 1"),
            ("revolute", "0 0 0.0985", "0 0 0", "0 -1 0"),
            ("revolute", "0 -0.1405 0.408", "0 0 0", "0 1 0"),
            ("revolute", "0 0 0.376", "0 0 0", "0 -1 0"),
            ("revolute", "0 -0.019 0", "0 0 0", "0 0 1"),
            ("revolute", "0 0 0.1025", "0 0 0", "0 -1 0"),
            ("fixed", "0 -0.094 0", "%90 0 0", ""),
        ],
        rows: vec![
            [0.0, -90.0, 0.0985, 180.0],
            [0.408, 180.0, 0.1405, -90.0],
            [0.376, 180.0, 0.0, 0.0],
            [0.0, -90.0, 0.019, -90.0],
            [0.0, 90.0, 0.1025, 0.0],
            [0.0, 0.0, 0.094, 0.0],
        ],
        prismatic: None,
        base: "",
        tool: String::new(),
    }
}

impl Arm {
    /// The files with angles of so many significant digits in the URDF.
    fn texts(&self, digits: usize) -> Texts {
        let angle = |degrees: f64| {
            let rad = degrees.to_radians();
            if digits >= 16 { format!("{rad:?}") } else { format!("{rad:.*}", digits - 1) }
        };
        let mut urdf = String::from("<robot name='arm'>\n<link name='base_link'/>\n");
        let mut parent = "base_link".to_owned();
        for (number, (kind, xyz, rpy, axis)) in (1..).zip(self.joints) {
            let rpy =
                rpy.replace("%90", &angle(90.0)).replace("%180", &angle(180.0)).replace("%45", &angle(45.0));
            let (name, child) = match *kind {
                "fixed" => ("flange".to_owned(), "tool0".to_owned()),
                _ => (format!("joint_{number}"), format!("link_{number}")),
            };
            let _ = write!(
                urdf,
                "<link name='{child}'/>\n<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>\n\
                 <origin xyz='{xyz}' rpy='{rpy}'/>"
            );
            if !axis.is_empty() {
                let range =
                    if *kind == "prismatic" { "lower='0' upper='0.2'" } else { "lower='-2.6' upper='2.6'" };
                let _ = write!(urdf, "<axis xyz='{axis}'/><limit {range} effort='100' velocity='2'/>");
            }
            urdf.push_str("</joint>\n");
            parent = child;
        }
        urdf.push_str("</robot>\n");
        let mut file = String::from(
            "urdf = \"arm.urdf\"\nbase = \"base_link\"\ntip = \"tool0\"\n\n[dh]\nconvention = \"standard\"\n",
        );
        for (key, value) in [("base_from_dh0", self.base), ("dhn_from_tip", &self.tool)] {
            if !value.is_empty() {
                let _ = writeln!(file, "{key} = {{ {value} }}");
            }
        }
        for (at, [a, alpha, d, theta]) in self.rows.iter().enumerate() {
            let kind = if self.prismatic == Some(at) { "prismatic" } else { "revolute" };
            let _ = write!(
                file,
                "\n[[dh.row]]\njoint = \"joint_{}\"\nkind = \"{kind}\"\na_m = {a}\nalpha_deg = {alpha}\nd_m = {d}\ntheta_deg = {theta}\n",
                at + 1
            );
        }
        Texts { name: "arm".to_owned(), robot_file: file, urdf }
    }
}

/// The lines to write for the named cause.
fn suggested(report: &CheckReport) -> Vec<&str> {
    report.diagnosis[0].faults().iter().map(|fault| fault.suggestion.as_str()).collect()
}

/// The named cause and those that cannot be distinguished from it.
fn alike(report: &CheckReport) -> Vec<(Cause, &str)> {
    let others = report.indistinguishable.iter().map(|other| &other.cause);
    let all = report.diagnosis.first().into_iter().chain(others);
    all.map(|cause| (cause.fault.cause, cause.fault.suggestion.as_str())).collect()
}

/// The file at the end of the check agrees.
#[track_caller]
fn fix_agrees(texts: &Texts) -> CheckReport {
    let corrected = texts.check(1e-9).diagnoses[0].corrected.clone().unwrap();
    let report = Texts { robot_file: corrected.text.clone(), ..texts.clone() }.check(1e-9);
    assert!(agrees(&report), "{}", corrected.text);
    report
}

/// Angles of a URDF, in significant digits.
const DIGITS: [usize; 3] = [5, 7, 17];

#[test]
fn a_wrong_offset_of_parallel_axes_is_one_value_and_no_shifted_column() {
    for digits in DIGITS {
        let mut arm = scara();
        arm.rows[1][2] = 0.03;
        // Beyond the digits, as a table with mm and a URDF with all digits has them.
        let mut texts = arm.texts(digits);
        texts.urdf =
            texts.urdf.replace("0.387", "0.3870000000000001").replace("0.033", "0.03300000000000001");
        arm.rows[1][2] = 0.0123;
        let texts_far = arm.texts(digits);
        for texts in [texts, texts_far] {
            let report = texts.check(1e-9);
            let [suggestion] = &suggested(&report)[..] else { panic!("{:?}", report.diagnosis[0]) };
            assert_ne!(report.diagnosis[0].fault.cause, Cause::ParametersExchanged, "{digits}: {suggestion}");
            let all = alike(&report);
            assert!(all.iter().any(|(_, lines)| *lines == "d_m = 0.033"), "{digits}: {all:?}");
            let shifted = all.iter().position(|(cause, _)| *cause == Cause::ParametersExchanged);
            let values = all.iter().filter(|(cause, _)| *cause == Cause::Parameter).count();
            assert!(shifted.is_none_or(|at| at >= values), "{digits}: {all:?}");
            fix_agrees(&texts);
        }
    }
}

#[test]
fn exchanged_offsets_are_named_whatever_the_digits_of_the_angles() {
    let named = DIGITS.map(|digits| {
        let mut arm = scara();
        (arm.rows[1][2], arm.rows[2][2]) = (arm.rows[2][2], arm.rows[1][2]);
        let texts = arm.texts(digits);
        let report = texts.check(1e-9);
        assert_eq!(report.diagnosis[0].fault.cause, Cause::ParametersExchanged, "{digits}");
        fix_agrees(&texts);
        let all = alike(&report).into_iter().map(|(cause, lines)| (cause, lines.to_owned()));
        all.collect::<Vec<(Cause, String)>>()
    });
    assert_eq!(named[0], named[2]);
    assert_eq!(named[1], named[2]);
    assert!(
        named[0]
            .iter()
            .any(|(_, lines)| lines == "dhn_from_tip = { xyz_m = [0, 0, 0.0645], rpy_deg = [0, 0, -45] }")
    );
}

#[test]
fn two_wrong_values_are_two_values_whatever_the_digits_of_the_angles() {
    for digits in DIGITS {
        let mut arm = aubo();
        (arm.rows[1][0], arm.rows[5][2]) = (0.048, 0.086);
        let texts = arm.texts(digits);
        let report = texts.check(1e-9);
        assert!(suggested(&report).contains(&"a_m = 0.408"), "{digits}: {:?}", suggested(&report));
        let all = alike(&report);
        assert!(all.iter().any(|(_, lines)| lines.contains("d_m = 0.094")), "{digits}: {all:?}");
        assert!(all.iter().all(|(_, lines)| !lines.contains("0.0000")), "{digits}: {all:?}");
        fix_agrees(&texts);
    }
}

/// Coarser digits allow more: what is the same with fine ones is the same with coarse ones.
#[test]
fn a_difference_within_the_digits_of_lengths_is_so_whatever_the_digits_of_the_angles() {
    for d in [0.399, 0.3995, 0.3999, 0.4] {
        let grade = |digits| {
            let mut arm = kr6();
            arm.rows[0][2] = d;
            arm.texts(digits).check(1e-9).grade
        };
        let exact = grade(17);
        assert!(exact != Some(Grade::Different), "{d}");
        for digits in [5, 7] {
            assert_eq!(grade(digits), Some(Grade::SameWithinDigits), "{d} with {digits} digits");
        }
    }
}

#[test]
fn rounded_quarter_turns_are_no_cause_beside_a_wrong_length() {
    for digits in DIGITS {
        let mut arm = kr6();
        arm.rows[0][2] = 0.394;
        let texts = arm.texts(digits);
        let report = texts.check(1e-9);
        assert_eq!(suggested(&report), ["d_m = 0.4"], "{digits}");
        fix_agrees(&texts);
    }
}

#[test]
fn a_dropped_flange_is_written_so_that_the_next_check_agrees() {
    for digits in [5, 7] {
        let mut arm = kr6();
        arm.tool = String::new();
        arm.rows[3][3] = 1.0;
        let texts = arm.texts(digits);
        fix_agrees(&texts);
    }
}
