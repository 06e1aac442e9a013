//! `congruent check`: what has no second source is not said to agree, and suspicious values of what it reads are listed.

use std::fs;

use serde_json::Value;

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

/// The sources that a report says were not compared.
fn not_compared(report: &Value) -> Vec<&str> {
    let all = report["not_asked"].as_array().map(Vec::as_slice).unwrap_or_default();
    all.iter().map(|entry| entry["source"].as_str().unwrap()).collect()
}

/// The physics is built from the URDF: it is no second source.
#[test]
fn one_description_is_not_said_to_agree() {
    let bare = ["check", "robots/ur5e/ur5e.urdf"];
    let shown = congruent(&bare).stdout;
    assert!(shown.starts_with("robots/ur5e/ur5e.urdf: NO SECOND DESCRIPTION. "), "{shown}");
    assert!(!shown.contains("  agree"), "{shown}");
    assert_eq!(not_compared(&congruent_json(&bare).json()), ["geometry", "dynamics"]);
    // A table has the geometry a second time, `[[inertial]]` the dynamics.
    let table = congruent(&["check", "robots/panda"]).stdout;
    let answer = "SAME GEOMETRY in 7 of 9 joints (those of the table), DYNAMICS NOT COMPARED. ";
    assert!(table.starts_with(&format!("robots/panda/robot.toml: {answer}")), "{table}");
    assert_eq!(not_compared(&congruent_json(&["check", "robots/panda"]).json()), ["dynamics"]);
    let both = congruent(&["check", "robots/ur5e"]).stdout;
    assert!(both.starts_with("robots/ur5e/robot.toml: SAME ROBOT, INERTIA NOT COMPARED. "), "{both}");
    assert_eq!(not_compared(&congruent_json(&["check", "robots/ur5e"]).json()), [""; 0]);
}

/// JUnit has what was not compared as skipped, with the reason.
#[test]
fn junit_skips_what_has_no_second_source() {
    let folder = tempfile::tempdir().unwrap();
    let junit = folder.path().join("junit.xml");
    assert_eq!(congruent(&["check", "robots/panda", "--junit", &text(&junit)]).code, 0);
    let junit = fs::read_to_string(junit).unwrap();
    assert!(junit.contains("name=\"dynamics\"") && junit.contains("skipped=\"1\""), "{junit}");
}

/// A job that relies on the comparison must not pass if a robot file has lost its table.
#[test]
fn a_strict_check_needs_a_second_description() {
    let scratch = ScratchFolder::new();
    let robot = fs::read_to_string(workspace().join("robots/planar_2r/robot.toml")).unwrap();
    let urdf = text(&workspace().join("robots/planar_2r/planar_2r.urdf"));
    let robot = robot.replace("\"planar_2r.urdf\"", &format!("\"{urdf}\""));
    let table = &robot[robot.find("[dh]").unwrap()..robot.find("[tolerance]").unwrap()];
    let path = scratch.write("without.toml", &robot.replace(table, ""));
    let junit = text(&scratch.path().join("junit.xml"));
    assert_eq!(congruent(&["check", &path]).code, 0);
    let strict = congruent(&["check", "--strict", "-q", &path, "--junit", &junit]);
    assert_eq!(strict.code, 4, "{}", strict.stderr);
    assert!(strict.stdout.contains(": NO SECOND DESCRIPTION. "), "{}", strict.stdout);
    assert!(strict.stdout.ends_with("; --strict: a second description is missing\n"), "{}", strict.stdout);
    assert!(fs::read_to_string(junit).unwrap().contains("type=\"no_second_description\""));
    assert_eq!(congruent(&["check", "--strict", "robots/planar_2r", &path]).code, 4);
}

/// The fingers of one file are fixed in the other: the arm is compared, the answer names the fingers, and both ways to leave
/// them out make the two the same.
#[test]
fn joints_that_move_in_one_file_alone_do_not_stop_the_comparison_of_the_others() {
    let scratch = ScratchFolder::new();
    let own = "robots/panda/panda.urdf";
    let urdf = fs::read_to_string(workspace().join(own)).unwrap();
    let other = scratch.write("fixed.urdf", &urdf.replace("type=\"prismatic\"", "type=\"fixed\""));
    let whole = congruent(&["check", own, "--against", &other]);
    assert_eq!(whole.code, 1, "{}", whole.stderr);
    let answer = format!(
        "{own}: EQUAL IN 7 OF 9 JOINTS: panda_finger_joint1 and panda_finger_joint2 move in panda.urdf alone"
    );
    assert!(whole.stdout.starts_with(&answer), "{}", whole.stdout);
    let left_out = "left_out = [\"panda_finger_joint1\", \"panda_finger_joint2\"]";
    assert!(whole.stdout.contains(left_out), "{}", whole.stdout);
    let part = congruent(&["check", own, "--against", &other, "--tip", "panda_hand", "-q"]);
    assert!(part.stdout.starts_with(&format!("{own}: SAME ")), "{}", part.stdout);
    scratch.write("panda.urdf", &urdf);
    let robot_file = scratch.write("robot.toml", &format!("urdf = \"panda.urdf\"\n[mapping]\n{left_out}\n"));
    let declared = congruent(&["check", &robot_file, "--against", &other, "-q"]);
    assert!(
        declared.stdout.contains(": SAME ROBOT in 7 of 9 joints"),
        "{}{}",
        declared.stdout,
        declared.stderr
    );
}

/// A mass of 8058 kg agrees with the physics that is built from it.
#[test]
fn an_absurd_mass_is_listed_and_fails_a_strict_check() {
    let folder = tempfile::tempdir().unwrap();
    let urdf = folder.path().join("heavy.urdf");
    let own = fs::read_to_string(workspace().join("robots/ur5e/ur5e.urdf")).unwrap();
    fs::write(&urdf, own.replacen("<mass value=\"8.058\"/>", "<mass value=\"8058\"/>", 1)).unwrap();
    let path = text(&urdf);
    let usual = congruent(&["check", &path]);
    assert_eq!(usual.code, 0, "{}", usual.stderr);
    assert!(usual.stdout.contains("  lint: 1 warning (in full: `congruent lint`):\n"), "{}", usual.stdout);
    assert!(usual.stdout.contains("(mass 8058 kg over the volume"), "{}", usual.stdout);
    let strict = congruent(&["check", "--strict", "--quiet", &path]);
    assert_eq!((strict.code, strict.stdout.lines().count()), (1, 1), "{}", strict.stdout);
    assert!(strict.stdout.contains("; --strict: 1 finding of lint;"), "{}", strict.stdout);
    let report = congruent_json(&["check", "--strict", &path]).json();
    assert_eq!(report["lint"]["worst"][0]["code"], "units::mass");
    let junit = folder.path().join("junit.xml");
    congruent(&["check", "--strict", &path, "--junit", &text(&junit)]);
    // The second one is the missing table.
    assert!(fs::read_to_string(junit).unwrap().contains("failures=\"2\""));
    assert_eq!(congruent(&["check", "--strict", "robots/ur5e"]).code, 0);
}

/// A check computes no distances: a mesh that is missing is a note, whatever --strict says.
#[test]
fn a_missing_mesh_fails_no_strict_check() {
    let scratch = ScratchFolder::new();
    let [robot, urdf] = ["robot.toml", "planar_2r.urdf"]
        .map(|name| fs::read_to_string(workspace().join("robots/planar_2r").join(name)).unwrap());
    let mesh = "<collision><geometry><mesh filename=\"gone.stl\"/></geometry></collision></link>";
    scratch.write("planar_2r.urdf", &urdf.replacen("</link>", mesh, 1));
    let path = scratch.write("robot.toml", &robot);
    let strict = congruent(&["check", "--strict", &path]);
    assert_eq!(strict.code, 0, "{}{}", strict.stdout, strict.stderr);
    let note = "  lint: no findings\n  not needed for this check: link \"base_link\": mesh file ";
    assert!(strict.stdout.contains(note), "{}", strict.stdout);
    assert!(!strict.stderr.contains("gone.stl"), "{}", strict.stderr);
    let lint = &congruent_json(&["check", "--strict", &path]).json()["lint"];
    assert_eq!((&lint["errors"], &lint["for_clearance"][0]["code"]), (&0.into(), &"mesh::not_found".into()));
}

/// With --quiet, each input has one line, in the order of the call.
#[test]
fn quiet_is_a_line_for_each_input() {
    let wrong = "robots/ur5e/wrong_convention.toml";
    let answer = congruent(&["check", "--quiet", wrong, "robots/ur5e"]);
    let lines: Vec<&str> = answer.stdout.lines().collect();
    assert_eq!((answer.code, lines.len()), (1, 2), "{}", answer.stdout);
    assert!(lines[0].starts_with(&format!("{wrong}: DIFFERENT, by up to 1912 mm and 180 deg at tool0")));
    assert!(lines[0].contains("Cause: the values are those of the"), "{}", lines[0]);
    assert!(
        lines[1].starts_with("robots/ur5e/robot.toml: SAME ROBOT, INERTIA NOT COMPARED. "),
        "{}",
        lines[1]
    );
}

/// Two descriptions as two inputs are each checked alone: the hint is what was meant.
#[test]
fn two_inputs_without_against_are_answered_with_it() {
    let [one, other] =
        ["ur5e", "panda"].map(|name| text(&workspace().join(format!("robots/{name}/{name}.urdf"))));
    let answer = congruent(&["check", &one, &other]);
    assert_eq!(answer.code, 0);
    let hint = format!("each was checked alone; to compare the two: congruent check {one} --against {other}");
    assert!(answer.stderr.contains(&hint), "{}", answer.stderr);
}

/// A mass that is not a number is bad input, and no difference.
#[test]
fn a_mass_that_cannot_be_read_is_no_difference() {
    let original = workspace().join("robots/ur5e/ur5e.urdf");
    let urdf = fs::read_to_string(&original).unwrap();
    let scratch = ScratchFolder::new();
    let comma = scratch.write("comma.urdf", &urdf.replacen("\"8.058\"", "\"8,058\"", 1));
    for pair in [[&comma, &text(&original)], [&text(&original), &comma]] {
        let answer = congruent(&["check", "-q", pair[0], "--against", pair[1]]);
        assert_eq!(answer.code, 2, "{}", answer.stdout);
        assert!(
            answer.stdout.contains("SAME GEOMETRY, DYNAMICS NOT READ: ")
                && answer.stdout.contains("comma.urdf:76")
        );
    }
}

/// A file against itself is compared with nothing, whatever path names it.
#[test]
fn the_robots_own_file_is_no_second_description() {
    let urdf = "robots/planar_2r/planar_2r.urdf";
    for other in [urdf, "robots/../robots/planar_2r/planar_2r.urdf"] {
        let shown = congruent(&["check", urdf, "--against", other]).stdout;
        assert!(shown.starts_with(&format!("{urdf}: NO SECOND DESCRIPTION. ")), "{shown}");
        assert!(shown.lines().next().unwrap().contains("the robot's own file"), "{shown}");
        let table = congruent(&["check", "robots/panda", "--against", "robots/panda/panda.urdf"]).stdout;
        assert!(table.contains(": SAME GEOMETRY in 7 of 9 joints"), "{table}");
    }
    assert_eq!(congruent(&["check", "--strict", urdf, "--against", urdf]).code, 4);
    // Two robot files of one URDF have one set of masses.
    let other = congruent(&["check", urdf, "--against", "robots/planar_2r"]).stdout;
    assert!(other.contains(": SAME GEOMETRY, DYNAMICS NOT COMPARED. "), "{other}");
}

/// The table of the other description is a part of the answer, and of its grade.
#[test]
fn the_table_of_the_other_description_counts_in_the_grade() {
    let scratch = ScratchFolder::new();
    let gen3 = workspace().join("docs/examples/gen3");
    let [robot, urdf] = ["robot.toml", "gen3.urdf"].map(|name| fs::read_to_string(gen3.join(name)).unwrap());
    let urdf = scratch.write("gen3.urdf", &urdf);
    let corrected = scratch.write("robot.toml", &robot);
    assert_eq!(congruent(&["check", &corrected, "--fix"]).code, 0);
    let fixed = text(&scratch.path().join("robot.fixed.toml"));
    let answer = congruent_json(&["check", &urdf, "--against", &fixed]).json();
    assert_eq!((&answer["grade"], &answer["verdict"]), (&"same_within_digits".into(), &"agree".into()));
    assert!(answer["worst"]["position_m"].as_f64().unwrap() > 1e-4, "{}", answer["worst"]);
}
