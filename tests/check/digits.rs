//! Files that are typed with few digits: what rounding explains is no fault, and what it does not explain is named.

use std::{fs, iter::once};

use serde_json::Value;

use crate::support::{
    command::{Answer, congruent_json, text},
    corpus::workspace,
};

/// Origins of the joints of Kinova's Gen3 with seven joints, `xyz` and `rpy` as the vendor's URDF writes them
/// (`ros_kortex`, `GEN3_URDF_V12.urdf`).
const GEN3_ORIGINS: [[&str; 2]; 7] = [
    ["0 0 0.15643", "-3.1416 2.7629E-18 -4.9305E-36"],
    ["0 0.005375 -0.12838", "1.5708 2.1343E-17 -1.1102E-16"],
    ["0 -0.21038 -0.006375", "-1.5708 1.2326E-32 -2.9122E-16"],
    ["0 0.006375 -0.21038", "1.5708 -6.6954E-17 -1.6653E-16"],
    ["0 -0.20843 -0.006375", "-1.5708 2.2204E-16 -6.373E-17"],
    ["0 0.00017505 -0.10593", "1.5708 9.2076E-28 -8.2157E-15"],
    ["0 -0.10593 -0.00017505", "-1.5708 -5.5511E-17 9.6396E-17"],
];

/// Link offsets `d` in m of the table of the same arm, with four decimals (Kinova, *Gen3 user guide*, classical DH
/// parameters of the robot with seven joints). The sixth is 0 there.
const GEN3_D_M: [&str; 7] = ["-0.2848", "-0.0118", "-0.4208", "-0.0128", "-0.3143", "0.0", "-0.1674"];

fn chain(joints: &[[&str; 2]], tool: &str) -> String {
    let link = |number: usize| format!("<link name=\"link_{number}\"/>\n");
    let joint = |(number, [xyz, rpy]): (usize, &[&str; 2])| {
        let (before, name) = (number, number + 1);
        format!(
            "<joint name=\"joint_{name}\" type=\"revolute\"><origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>\
             <parent link=\"link_{before}\"/><child link=\"link_{name}\"/><axis xyz=\"0 0 1\"/>\
             <limit lower=\"-2.2\" upper=\"2.2\" effort=\"1\" velocity=\"1\"/></joint>\n"
        )
    };
    let links: String = (0..=joints.len()).map(link).collect();
    let joints: String = joints.iter().enumerate().map(joint).collect();
    format!("<robot name=\"arm\">\n{links}{joints}{tool}</robot>\n")
}

fn gen3_urdf() -> String {
    let tool = "<link name=\"tip\"/><joint name=\"tool\" type=\"fixed\"><origin xyz=\"0 0 -0.0615250000000000\" \
                rpy=\"3.14159265358979 1.09937075168372E-32 0\"/><parent link=\"link_7\"/><child link=\"tip\"/></joint>\n";
    chain(&GEN3_ORIGINS, tool)
}

/// The table with these offsets, and further lines before it.
fn gen3_table(d_m: [&str; 7], before: &str) -> String {
    let row = |(at, d_m): (usize, &str)| {
        let (alpha, theta) = (if at == 6 { 180 } else { 90 }, if at == 0 { 0 } else { 180 });
        format!(
            "  {{ joint = \"joint_{}\", kind = \"revolute\", a_m = 0.0, alpha_deg = {alpha}, d_m = {d_m}, theta_deg = {theta} }},\n",
            at + 1
        )
    };
    let rows: String = d_m.into_iter().enumerate().map(row).collect();
    format!(
        "urdf = \"arm.urdf\"\nbase = \"link_0\"\ntip = \"tip\"\n{before}[dh]\nconvention = \"standard\"\n\
         base_from_dh0 = {{ rpy_deg = [180, 0, 0] }}\nrow = [\n{rows}]\n"
    )
}

fn checked(urdf: &str, table: &str) -> (Answer, Value) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("arm.urdf"), urdf).unwrap();
    let path = folder.path().join("robot.toml");
    fs::write(&path, table).unwrap();
    let answer = congruent_json(&["check", &text(&path)]);
    let report = answer.json();
    (answer, report)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("no number: {value}"))
}

/// A flange of 0.107 m in both files is one flange: its last place does not hide 0.9 mm of the last row.
#[test]
fn a_length_that_both_files_have_alike_explains_nothing() {
    let origins = [["0 0 0.2", "0 0 0"], ["0 0 0", "1.5707963267948966 0 0"], ["0.4 0 0", "0 0 0"]];
    let tool = "<link name=\"wrist\"/><joint name=\"last\" type=\"fixed\"><origin xyz=\"0.054317 0 0\"/><parent link=\"link_3\"/>\
                <child link=\"wrist\"/></joint><link name=\"tip\"/><joint name=\"flange\" type=\"fixed\">\
                <origin xyz=\"0.107 0 0\"/><parent link=\"wrist\"/><child link=\"tip\"/></joint>\n";
    let table = |last_mm: &str| {
        format!(
            "urdf = \"arm.urdf\"\nbase = \"link_0\"\ntip = \"tip\"\n[dh]\nconvention = \"standard\"\n\
             dhn_from_tip = {{ xyz_m = [0.107, 0, 0] }}\nrow = [\n\
             {{ joint = \"joint_1\", kind = \"revolute\", a_mm = 0, alpha_deg = 90, d_mm = 200.0, theta_deg = 0 }},\n\
             {{ joint = \"joint_2\", kind = \"revolute\", a_mm = 400.0, alpha_deg = 0, d_mm = 0, theta_deg = 0 }},\n\
             {{ joint = \"joint_3\", kind = \"revolute\", a_mm = {last_mm}, alpha_deg = 0, d_mm = 0, theta_deg = 0 }},\n]\n"
        )
    };
    let grade = |last_mm: &str| checked(&chain(&origins, tool), &table(last_mm)).1["grade"].clone();
    assert_eq!(["54.3", "53.4"].map(grade), ["same_within_digits", "different"]);
}

/// A base of pi under `rpy_deg`, and one of 3.1: the base is named, and not the zero of the first joint, which no pose distinguishes.
#[test]
fn a_base_that_is_nearly_half_a_turn_is_corrected_at_the_base() {
    let folder = tempfile::tempdir().unwrap();
    let of_ur5e = workspace().join("robots/ur5e");
    let robot = fs::read_to_string(of_ur5e.join("robot.toml")).unwrap();
    fs::copy(of_ur5e.join("ur5e.urdf"), folder.path().join("ur5e.urdf")).unwrap();
    let written = "base_from_dh0 = { rpy_deg = [0, 0, 180] }";
    assert!(robot.contains(written), "{robot}");
    for wrong in ["{ rpy_deg = [0, 0, 3.1416] }", "{ rpy_rad = [0, 0, 3.1] }"] {
        let path = folder.path().join("robot.toml");
        fs::write(&path, robot.replace(written, &format!("base_from_dh0 = {wrong}"))).unwrap();
        let report = congruent_json(&["check", &text(&path)]).json();
        assert_eq!(report["diagnosis"][0]["cause"], "base", "{wrong}: {}", report["diagnosis"]);
    }
}

/// The published table against the vendor's own URDF: one offset differs, the rest is the fourth decimal and a pi/2 that
/// is typed as 1.5708.
#[test]
fn of_a_rounded_table_only_what_no_digit_explains_is_named() {
    let (answer, report) = checked(&gen3_urdf(), &gen3_table(GEN3_D_M, ""));
    assert_eq!(answer.code, 1, "{}", answer.stdout);
    assert_eq!((&report["verdict"], &report["grade"]), (&"disagree".into(), &"different".into()));
    let cause = &report["diagnosis"][0];
    assert_eq!(cause["cause"], "parameter", "{cause:#}");
    assert_eq!((&cause["joint"], &cause["parameter"]), (&"joint_6".into(), &"d".into()));
    // 2 * 0.17505 mm in the URDF; the fourth decimal of the table is 0.1 mm.
    assert!((number(&cause["expected"]) + 0.3501e-3).abs() < 0.05e-3, "{cause:#}");
    assert_eq!(cause["within_tolerance"], true);
}

#[test]
fn a_table_that_is_only_rounded_is_the_same_robot() {
    let mut d_m = GEN3_D_M;
    d_m[5] = "-0.0004";
    let (answer, report) = checked(&gen3_urdf(), &gen3_table(d_m, ""));
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    assert_eq!((&report["verdict"], &report["grade"]), (&"agree".into(), &"same_within_digits".into()));
    let [found, allowed] = ["worst", "allowed_by_digits"].map(|key| number(&report[key]["position_m"]));
    assert!(1e-5 < found && found < allowed && allowed < 1e-3, "{found} m of {allowed} m");
    assert_eq!(report["diagnosis"], Value::Array(Vec::new()));
}

/// A declared tolerance decides; rounding is still no cause.
#[test]
fn a_declared_tolerance_decides_about_rounding() {
    let mut d_m = GEN3_D_M;
    d_m[5] = "-0.0004";
    let tolerance = "[tolerance]\nposition_mm = 0.01\norientation_deg = 0.01\n";
    let (answer, report) = checked(&gen3_urdf(), &gen3_table(d_m, tolerance));
    assert_eq!(answer.code, 1, "{}", answer.stdout);
    assert_eq!((&report["verdict"], &report["grade"]), (&"disagree".into(), &"same_within_digits".into()));
    assert_eq!(report["diagnosis"], Value::Array(Vec::new()), "{:#}", report["diagnosis"]);
}

/// Half of the last place is the limit, in the table and in the URDF.
#[test]
fn digits_allow_half_of_the_last_place_and_no_more() {
    let urdf = |length: &str| chain(&[["0 0 0.2", "0 0 0"], [&format!("{length} 0 0"), "0 0 0"]], "");
    let table = |a_m: &str| {
        format!(
            "urdf = \"arm.urdf\"\nbase = \"link_0\"\ntip = \"link_2\"\n[dh]\nconvention = \"standard\"\nrow = [\n  \
             {{ joint = \"joint_1\", kind = \"revolute\", a_m = {a_m}, alpha_deg = 0, d_m = 0.2 }},\n  \
             {{ joint = \"joint_2\", kind = \"revolute\", a_m = 0, alpha_deg = 0, d_m = 0 }},\n]\n"
        )
    };
    for (typed, in_urdf, grade) in [
        ("0.3125", "0.3125", "identical"),
        ("0.3125", "0.31254999999999", "same_within_digits"),
        ("0.3125", "0.31256000000000", "different"),
        ("0.31250000000000", "0.31254999999999", "different"),
        ("0.31254999999999", "0.3125", "same_within_digits"),
        ("0.3126", "0.3125", "same_within_digits"),
        ("0.3127", "0.3125", "different"),
    ] {
        let (answer, report) = checked(&urdf(in_urdf), &table(typed));
        assert_eq!(report["grade"], grade, "{typed} against {in_urdf}: {}", answer.stdout);
        assert_eq!(answer.code, i32::from(grade == "different"), "{typed} against {in_urdf}");
    }
}

/// UFACTORY's xArm 6 (user manual, modified DH parameters, mm and degrees): two digits of one offset are transposed, and
/// the value to write is the one that the URDF has, not a fit between the rounded neighbours.
#[test]
fn transposed_digits_are_corrected_to_the_known_value() {
    let urdf = chain(
        &[
            ["0 0 0.267", "0 0 0"],
            ["0 0 0", "-1.5708 0 0"],
            ["0.053 -0.2845 0", "0 0 0"],
            ["0.0775 0.3425 0", "-1.5708 0 0"],
            ["0 0 0", "1.5708 0 0"],
            ["0.076 0.097 0", "-1.5708 0 0"],
        ],
        "",
    );
    let rows = [
        "alpha_deg = 0, a_mm = 0, d_mm = 267",
        "alpha_deg = -90, a_mm = 0, d_mm = 0, theta_deg = -79.349",
        "alpha_deg = 0, a_mm = 289.49, d_mm = 0, theta_deg = 79.349",
        "alpha_deg = -90, a_mm = 77.5, d_mm = 324.5",
        "alpha_deg = 90, a_mm = 0, d_mm = 0",
        "alpha_deg = -90, a_mm = 76, d_mm = 97",
    ];
    for tolerance in ["", "[tolerance]\nposition_mm = 1\norientation_deg = 0.1\n"] {
        let row = |(at, row): (usize, &&str)| {
            format!("  {{ joint = \"joint_{}\", kind = \"revolute\", {row} }},\n", at + 1)
        };
        let rows: String = rows.iter().enumerate().map(row).collect();
        let table = format!(
            "urdf = \"arm.urdf\"\nbase = \"link_0\"\ntip = \"link_6\"\n{tolerance}[dh]\nconvention = \"modified\"\nrow = [\n{rows}]\n"
        );
        let (answer, report) = checked(&urdf, &table);
        assert_eq!(answer.code, 1, "{}", answer.stdout);
        let cause = &report["diagnosis"][0];
        assert_eq!((&cause["cause"], &cause["joint"]), (&"parameter".into(), &"joint_4".into()));
        assert!((number(&cause["expected"]) - 0.3425).abs() < 1e-12, "{cause:#}");
        let new_text = cause["changes"][0]["text"].as_str().unwrap_or_default();
        assert!(new_text.contains("d_mm = 342.5"), "{cause:#}");
    }
}

/// A wrong pitch in the URDF of an arm whose table has whole millimetres: two values of the table explain it within their digits, one
/// `<origin>` explains it exactly, and is named.
#[test]
fn an_exact_origin_is_named_before_values_that_digits_excuse() {
    let joint = |(number, axis, xyz, rpy): (usize, &str, &str, &str)| {
        format!(
            "<joint name=\"joint_{number}\" type=\"revolute\"><parent link=\"link_{}\"/><child link=\"link_{number}\"/>\
             <origin xyz=\"{xyz}\" rpy=\"{rpy}\"/><axis xyz=\"{axis}\"/>\
             <limit lower=\"-1.9\" upper=\"1.9\" effort=\"50\" velocity=\"5\"/></joint>\n",
            number - 1
        )
    };
    let joints = [
        (1, "0 0 1", "0 0 0", "0 0 0"),
        (2, "0 1 0", "0 0 0.29", "0 0 0"),
        (3, "0 1 0", "0 0 0.27", "0 0 0"),
        (4, "1 0 0", "0 0 0.07", "0 0.05 0"),
        (5, "0 1 0", "0.302 0 0", "0 0 0"),
        (6, "1 0 0", "0.072 0 0", "0 0 0"),
    ];
    let links = [0, 1, 2, 3, 4, 5, 6].map(|number| format!("<link name=\"link_{number}\"/>\n")).concat();
    let tool = "<link name=\"tool0\"/><joint name=\"tool\" type=\"fixed\"><parent link=\"link_6\"/><child link=\"tool0\"/>\
                <origin xyz=\"0 0 0\" rpy=\"0 1.5707963267948966 0\"/></joint>";
    let urdf = format!("<robot name=\"arm\">\n{links}{}{tool}</robot>\n", joints.map(joint).concat());
    let row = |(at, [a_mm, alpha_deg, d_mm, theta_deg]): (usize, &[i32; 4])| {
        format!(
            "  {{ joint = \"joint_{}\", kind = \"revolute\", a_mm = {a_mm}, alpha_deg = {alpha_deg}, d_mm = {d_mm}, theta_deg = {theta_deg} }},\n",
            at + 1
        )
    };
    let rows = [
        [0, -90, 290, 0],
        [270, 0, 0, -90],
        [70, -90, 0, 0],
        [0, 90, 302, 0],
        [0, -90, 0, 0],
        [0, 0, 72, 180],
    ];
    let rows: String = rows.iter().enumerate().map(row).collect();
    let table = format!(
        "urdf = \"arm.urdf\"\nbase = \"link_0\"\ntip = \"tool0\"\n[dh]\nconvention = \"standard\"\nrow = [\n{rows}]\n"
    );
    let (_, report) = checked(&urdf, &table);
    let first = &report["diagnosis"][0];
    assert_eq!((&first["cause"], &first["joint"]), (&"joint_origin".into(), &"joint_4".into()), "{first:#}");
    // The two values are the other reading; no corrected table is offered for it.
    let diagnosis = &report["diagnoses"][0];
    assert!(!diagnosis["indistinguishable"].as_array().unwrap().is_empty(), "{diagnosis:#}");
    assert!(diagnosis["corrected"].is_null(), "{:#}", diagnosis["corrected"]);
    let right = checked(&urdf.replace("0 0.05 0", "0 0 0"), &table).1;
    assert_eq!(right["verdict"], "agree", "{right:#}");
}

/// An `<origin>` whose x of -0.45 mm was rounded to 0: a wrong sign and exchanged angles together give the same poses as that 0.14 deg,
/// and each alone moves the tip by 370 mm.
#[test]
fn two_corrections_that_make_up_for_each_other_are_no_cause() {
    let origins = [
        ["0.321 0.0 0.0", "0.0 0.0 0.0"],
        ["-0.001 0.268 0.0", "-1.5708 0.0 1.573"],
        ["0.0 0.185 0.0", "0.0 0.0 1.5732"],
        ["0.0 -0.369 0.309", "1.5647 0.0 -1.5708"],
        ["0.0 0.0 0.244", "0.0027 0.0 0.0"],
    ];
    let tool = "<link name=\"tip\"/><joint name=\"tool\" type=\"fixed\"><parent link=\"link_5\"/><child link=\"tip\"/>\
                <origin xyz=\"0.0 0.0 0.072\" rpy=\"0.0 0.0 -0.0031\"/></joint>\n";
    let rows = [
        "a_m = 0.321, alpha_deg = 0.0, d_m = 0.0, theta_deg = 90.13",
        "a_m = 0.268, alpha_deg = -90.0, d_m = 0.0, theta_deg = 90.14",
        "a_m = 0.185, alpha_deg = 0.0, d_m = 0.309, theta_deg = -90.0",
        "a_m = 0.369, alpha_deg = 89.65, d_m = 0.244, theta_deg = 0.0",
        "a_m = 0.0, alpha_deg = 0.15, d_m = 0.072, theta_deg = -0.18",
    ];
    let row = |(at, values): (usize, &&str)| {
        format!("  {{ joint = \"joint_{}\", kind = \"revolute\", {values} }},\n", at + 1)
    };
    let rows: String = rows.iter().enumerate().map(row).collect();
    let table = format!(
        "urdf = \"arm.urdf\"\nbase = \"link_0\"\ntip = \"tip\"\n[dh]\nconvention = \"modified\"\nrow = [\n{rows}]\n"
    );
    let (_, report) = checked(&chain(&origins, tool), &table);
    // About parallel axes, that origin is an angle of 0.14 deg which one row has too much and the next too little: both readings are
    // named, and neither moves the tip far.
    let diagnosis = &report["diagnoses"][0];
    let listed = |name: &str| diagnosis[name].as_array().into_iter().flatten();
    let named = || report["diagnosis"].as_array().into_iter().flatten().chain(listed("indistinguishable"));
    let is_origin = |of: &Value| of["cause"] == "joint_origin" && of["joint"] == "joint_3";
    assert!(named().any(is_origin), "{report:#}");
    let gross = ["axis_flipped", "parameters_exchanged", "joints_swapped"];
    let faults = named().flat_map(|of| once(of).chain(of["faults"].as_array().into_iter().flatten()));
    let causes: Vec<&Value> = faults.map(|of| &of["cause"]).collect();
    assert!(!causes.iter().any(|cause| gross.iter().any(|name| *cause == name)), "{causes:?}");
}
