//! Answers say what they are judged by, name the file of each value, and say what to write.

use std::fs;

use crate::support::{
    command::{Answer, congruent, congruent_in, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

/// A table with one wrong value and few digits, in a file that declares no tolerance.
const UNDECLARED: &str = "docs/examples/gen3/robot.toml";

#[track_caller]
fn says(answer: &Answer, words: &[&str]) {
    let said = format!("{}{}", answer.stdout, answer.stderr).replace('\u{2502}', " ");
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    for word in words {
        assert!(said.contains(word), "no {word:?} in: {said}");
    }
}

#[test]
fn a_tolerance_that_nobody_has_declared_is_not_the_robot_files() {
    let check = |tolerance: &str| congruent(&["check", UNDECLARED, "-q", "--tolerance", tolerance]);
    let both = check("0.1mm,0.1deg");
    says(&both, &["tolerance 0.1 mm and 0.1 deg by --tolerance. Cause"]);
    assert!(!both.stdout.contains("the robot file's"), "{}", both.stdout);
    let by_digits = |part: &str| format!("and {part} by the digits written, since none is declared for them");
    says(&check("0.1mm"), &[&format!("tolerance 0.1 mm by --tolerance, {}", by_digits("angles"))]);
    says(&check("0.1deg"), &[&format!("tolerance 0.1 deg by --tolerance, {}", by_digits("lengths"))]);
    let declared = congruent(&["check", "robots/planar_2r", "-q", "--tolerance", "1mm"]);
    says(&declared, &["tolerance 1 mm by --tolerance, and for angles 1 prad by the robot file"]);
    let declared = congruent(&["check", "robots/planar_2r", "-q", "--tolerance", "1mm,1deg"]);
    says(&declared, &["tolerance 1 mm and 1 deg by --tolerance, the robot file's is 1 pm and 1 prad"]);
}

#[test]
fn ci_and_pages_say_that_the_digits_decide() {
    const BY_DIGITS: &str = "judged by the digits written (no tolerance declared)";
    let scratch = ScratchFolder::new();
    let [junit, page] = ["junit.xml", "page.html"].map(|name| text(&scratch.path().join(name)));
    let answer =
        congruent(&["check", UNDECLARED, "-q", "--junit", &junit, "--html", &page, "--annotate", "github"]);
    says(&answer, &[BY_DIGITS]);
    let annotation = answer.stderr.lines().find(|line| line.starts_with("::error")).unwrap();
    assert!(annotation.contains(BY_DIGITS), "{annotation}");
    assert!(annotation.contains("write in line 17: ") && annotation.contains("; then "), "{annotation}");
    let junit = fs::read_to_string(junit).unwrap();
    assert!(junit.contains(BY_DIGITS), "{junit}");
    let page = fs::read_to_string(page).unwrap();
    assert!(page.contains(&format!("<dd>{BY_DIGITS}</dd>")), "the facts of the page");
}

/// Two URDFs that differ in a mass: neither is known to be right.
#[test]
fn values_of_two_files_name_both_files_with_all_digits() {
    let scratch = ScratchFolder::new();
    let urdf = fs::read_to_string(workspace().join("robots/rrr_arm/rrr_arm.urdf")).unwrap();
    let start = urdf.match_indices("<mass value=\"").nth(2).unwrap().0 + "<mass value=\"".len();
    let end = start + urdf[start..].find('"').unwrap();
    let with_mass =
        |name: &str, mass: &str| scratch.write(name, &format!("{}{mass}{}", &urdf[..start], &urdf[end..]));
    let [good, transposed, grams] =
        [("good.urdf", "3.909"), ("transposed.urdf", "3.099"), ("grams.urdf", "3909")]
            .map(|(name, mass)| with_mass(name, mass));
    let check = |one: &str, other: &str| congruent(&["check", one, "--against", other]);
    let line = urdf[..start].matches('\n').count() + 1;
    let transposed = check(&good, &transposed);
    says(&transposed, &[&format!("mass 3.909 kg in good.urdf:{line}, 3.099 kg in transposed.urdf:{line}")]);
    let remark = "a factor of 1000, grams?";
    let other = check(&good, &grams);
    says(
        &other,
        &[
            &format!("mass 3.909 kg in good.urdf:{line}, 3909 kg in grams.urdf:{line}: {remark}"),
            "to correct in",
        ],
    );
    assert!(!other.stdout.contains("to write in"), "{}", other.stdout);
    let own = check(&grams, &good);
    says(&own, &[&format!("mass 3909 kg in grams.urdf:{line}, 3.909 kg in good.urdf:{line}: {remark}")]);
    says(&own, &["to write in"]);
    // The page has the cause where it answers why, and draws no two equal arms.
    let page = scratch.path().join("page.html");
    congruent(&["check", &grams, "--against", &good, "--html", &text(&page)]);
    let page = fs::read_to_string(page).unwrap();
    let why = &page[page.find("Why they differ").unwrap()..page.find("<h2>Dynamics</h2>").unwrap()];
    assert!(why.contains("3909 kg in"), "{why}");
    assert!(!page.contains("<svg"), "two equal arms answer nothing");
}

/// A table of the UR5e with one quarter turn of five digits: rounding explains all that differs, up to some micrometres.
fn rounded_table(scratch: &ScratchFolder, tolerance: &str) -> String {
    let urdf = text(&workspace().join("robots/ur5e/ur5e.urdf"));
    let table = fs::read_to_string(workspace().join("robots/ur5e/robot.toml")).unwrap();
    let rows = table[..table.find("[dynamics]").unwrap()].replace("\"ur5e.urdf\"", &format!("\"{urdf}\""));
    let rounded = rows.replace("alpha_deg = 90.0", "alpha_rad = 1.5708");
    assert_ne!(rounded, rows);
    scratch.write("rounded.toml", &format!("{tolerance}{rounded}"))
}

#[test]
fn a_part_of_a_tolerance_has_the_digits_decide_the_other_part() {
    let scratch = ScratchFolder::new();
    let robot = rounded_table(&scratch, "");
    for tolerance in ["5mm", "0.1deg"] {
        let answer = congruent(&["check", &robot, "-q", "--tolerance", tolerance]);
        assert_eq!(answer.code, 0, "{tolerance}: {}", answer.stdout);
        says(
            &answer,
            &["SAME GEOMETRY within the digits written (up to ", "by the digits written, since none"],
        );
    }
    // What is declared still decides.
    let tight = congruent(&["check", &robot, "-q", "--tolerance", "1nm"]);
    assert_eq!(tight.code, 1, "{}", tight.stdout);
    says(&tight, &["DIFFERENT by rounding alone"]);
    let declared = rounded_table(&scratch, "tolerance = { position_mm = 5 }\n");
    let answer = congruent(&["check", &declared, "-q"]);
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    says(&answer, &["tolerance 5 mm, and angles by the digits written"]);
}

#[test]
fn the_first_line_says_how_far_apart_rounded_descriptions_are() {
    let scratch = ScratchFolder::new();
    let answer = congruent(&["check", &rounded_table(&scratch, ""), "-q"]);
    says(&answer, &["within the digits written (up to ", " apart; the digits could explain "]);
    says(&answer, &["DH table against URDF at ", "no tolerance declared"]);
    let different = congruent(&["check", UNDECLARED, "-q"]);
    says(&different, &["(DH table against URDF; no rounding of the written digits explains it)"]);
    assert!(!different.stdout.contains("could explain"), "{}", different.stdout);
}

#[test]
fn a_scenario_of_a_rounded_table_has_the_limits_of_its_digits() {
    let scratch = ScratchFolder::new();
    let to = text(&scratch.path().join("run.toml"));
    let robot = rounded_table(&scratch, "");
    let answer = congruent(&["new", "scenario", &robot, "--to", &to]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    // The limits that the digits allow are in the scenario, which passes with them.
    let scenario = fs::read_to_string(&to).unwrap();
    assert!(scenario.contains("position_mm") || scenario.contains("position_um"), "{scenario}");
    let out = text(&scratch.path().join("out"));
    let run = congruent(&["run", &to, "--out", &out]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
}

#[test]
fn a_change_without_robots_is_no_fault() {
    let scratch = ScratchFolder::new();
    scratch.write("README.md", "# Arms\n");
    scratch.write("pyproject.toml", "[tool.setuptools]\npackages = [\"arms\"]\n");
    let answer =
        congruent_in(scratch.path(), &["check", "--changed", "README.md", "pyproject.toml", "gone.urdf"]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    says(&answer, &["nothing to check: no robot has changed", "gone.urdf: not checked: it does not exist"]);
}

#[test]
fn names_and_endings_that_are_not_meant_are_refused() {
    let scratch = ScratchFolder::new();
    let page = text(&scratch.path().join("report.pdf"));
    let pdf = congruent(&["check", "robots/planar_2r", "--html", &page]);
    assert_eq!(pdf.code, 2, "{}", pdf.stderr);
    says(&pdf, &["a page is an HTML file, so its name must end in .html"]);
    let readme = congruent(&["check", "README.md"]);
    says(&readme, &["README.md is neither a robot file (.toml) nor a URDF"]);
    let twice = congruent(&["fk", "robots/planar_2r", "--at", "joint_1=30deg", "--at", "joint_1=20deg"]);
    says(&twice, &["given already, by --at joint_1=30deg"]);
    let seed = congruent(&["check", "robots/planar_2r", "--seed", "abc"]);
    says(&seed, &["a seed is a whole number from 0 on"]);
}
