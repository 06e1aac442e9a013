//! What CI reads of a call: annotations at lines, the summary, JUnit with places; and that the files of `docs/ci` call
//! commands that exist.

use std::{fs, path::Path, process::Command};

use roxmltree::Document;

use crate::support::{
    command::{Answer, congruent, congruent_in, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

/// A scenario whose first check fails, and should not.
const STRICT: [&str; 4] =
    ["run", "scenarios/ur5e_pick.toml", "--no-recording", "--set=check.1.position_m=1e-20"];

/// Runs a command with all that CI reads: the answer, the JUnit file, the summary.
fn with_ci(scratch: &ScratchFolder, arguments: &[&str]) -> (Answer, String, String) {
    let [junit, summary, out] =
        ["ci/junit.xml", "ci/summary.md", "ci/out"].map(|name| text(&scratch.path().join(name)));
    let mut all = arguments.to_vec();
    all.extend(["--annotate", "github", "--junit", &junit, "--summary", &summary]);
    if arguments[0] == "run" {
        all.extend(["--out", &out]);
    }
    let answer = congruent(&all);
    (answer, fs::read_to_string(&junit).unwrap(), fs::read_to_string(&summary).unwrap())
}

/// The line of a file, from 1, that holds this text.
#[track_caller]
fn line_of(file: &str, part: &str) -> usize {
    let text = fs::read_to_string(workspace().join(file)).unwrap();
    text.lines().position(|line| line.contains(part)).unwrap() + 1
}

#[track_caller]
fn annotation(answer: &Answer) -> String {
    let lines: Vec<&str> = answer.stderr.lines().filter(|line| line.starts_with("::error")).collect();
    assert_eq!(lines.len(), 1, "{}", answer.stderr);
    lines[0].to_owned()
}

#[test]
fn a_check_that_fails_is_shown_at_its_line() {
    let scratch = ScratchFolder::new();
    let (answer, junit, summary) = with_ci(&scratch, &STRICT);
    assert_eq!(answer.code, 1, "{}", answer.stderr);
    let file = "scenarios/ur5e_pick.toml";
    let line = line_of(file, "[[check]]");
    let annotation = annotation(&answer);
    assert!(annotation.starts_with(&format!("::error file={file},line={line},title=")), "{annotation}");
    assert!(annotation.contains("position "), "{annotation}");
    assert!(!answer.stdout.contains("::error"), "{}", answer.stdout);
    assert!(summary.contains("**failed**") && summary.contains(&format!(".toml:{line} |")), "{summary}");
    let document = Document::parse(&junit).unwrap();
    let failed = document.descendants().find(|node| node.has_tag_name("failure")).unwrap();
    let case = failed.parent().unwrap();
    let place = ["file", "line"].map(|name| case.attribute(name).unwrap_or_default());
    assert_eq!(place, [file, &line.to_string()]);
    let message = failed.attribute("message").unwrap();
    assert!(["position ", " at ", "limit ", " s)"].iter().all(|part| message.contains(part)), "{message}");
}

#[test]
fn a_robot_that_disagrees_is_shown_at_the_wrong_line() {
    let scratch = ScratchFolder::new();
    let file = "robots/ur5e/wrong_convention.toml";
    // Code hosts know files from the top of the repository.
    let named = "robots/panda/../ur5e/wrong_convention.toml";
    let (answer, _, summary) = with_ci(&scratch, &["check", named]);
    assert_eq!(answer.code, 1, "{}", answer.stderr);
    let line = line_of(file, "convention = ");
    let start = format!("::error file={file},line={line},");
    let annotations: Vec<&str> = answer.stderr.lines().filter(|line| line.starts_with("::error")).collect();
    assert!(!annotations.is_empty(), "{}", answer.stderr);
    assert!(annotations.iter().all(|annotation| annotation.starts_with(&start)), "{annotations:?}");
    assert!(summary.starts_with("### Congruent: failed"), "{summary}");
}

#[test]
fn several_causes_are_shown_each_at_its_line() {
    let scratch = ScratchFolder::new();
    let robot = fs::read_to_string(workspace().join("robots/ur5e/robot.toml")).unwrap();
    let urdf = text(&workspace().join("robots/ur5e/ur5e.urdf"));
    let robot = robot.replace("\"ur5e.urdf\"", &format!("\"{urdf}\""));
    let wrong = robot.replace("a_m = -0.425", "a_m = -0.525").replace("d_m = 0.1625", "d_m = 0.2625");
    let path = scratch.write("two.toml", &wrong);
    let (answer, ..) = with_ci(&scratch, &["check", &path]);
    assert_eq!(answer.code, 1, "{}", answer.stderr);
    for value in ["a_m = -0.525", "d_m = 0.2625"] {
        let line = wrong.lines().position(|line| line == value).unwrap() + 1;
        let marked = |annotation: &str| {
            annotation.starts_with("::error") && annotation.contains(&format!("line={line},"))
        };
        assert!(answer.stderr.lines().any(marked), "no {value}: {}", answer.stderr);
    }
}

#[test]
fn what_cannot_start_is_an_error_at_the_line_of_the_finding() {
    let scratch = ScratchFolder::new();
    let scenario = fs::read_to_string(workspace().join("scenarios/ur5e_pick.toml")).unwrap();
    let scenario = scenario.replace("../robots", &text(&workspace().join("robots")));
    let path = scratch.write("typo.toml", &format!("sed = 1\n{scenario}"));
    let (answer, junit, summary) = with_ci(&scratch, &["run", &path]);
    assert_eq!(answer.code, 2, "{}", answer.stderr);
    let annotation = annotation(&answer);
    assert!(annotation.contains("line=1,") && annotation.contains("\"seed\""), "{annotation}");
    assert!(junit.contains("errors=\"1\"") && junit.contains("line=\"1\""), "{junit}");
    assert!(summary.contains("| error |") && summary.contains(":1 |"), "{summary}");
}

#[test]
fn what_passes_is_summed_up_and_not_annotated() {
    let scratch = ScratchFolder::new();
    let (answer, _, summary) = with_ci(&scratch, &["check", "robots/ur5e", "robots/planar_2r"]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    assert!(!answer.stderr.contains("::"), "{}", answer.stderr);
    assert!(summary.starts_with("### Congruent: passed") && summary.contains("robots/ur5e"), "{summary}");
    assert!(summary.contains("robots/planar\\_2r (not compared: dynamics)"), "{summary}");
    // The summary of the next step of a job is below.
    let (_, _, summary) = with_ci(&scratch, &["check", "robots/planar_2r"]);
    assert_eq!(summary.matches("### Congruent").count(), 2, "{summary}");
}

#[test]
fn a_summary_that_cannot_be_written_is_reported_before_the_work() {
    let scratch = ScratchFolder::new();
    let file = scratch.write("file", "");
    let answer = congruent(&["check", "robots/ur5e", "--summary", &format!("{file}/below.md")]);
    assert_eq!(answer.code, 2, "{}", answer.stderr);
    assert!(answer.stderr.contains("--summary") && answer.stdout.is_empty(), "{}", answer.stderr);
}

/// What pre-commit does with a hook: its command, with the names of the files of the commit that its pattern matches.
fn committed(repository: &Path, hook: &str, pattern: &str) -> Answer {
    let hooks = fs::read_to_string(workspace().join(".pre-commit-hooks.yaml")).unwrap();
    let hook = &hooks[hooks.find(&format!("- id: {hook}\n")).unwrap()..];
    let entry = hook.lines().find_map(|line| line.trim().strip_prefix("entry: congruent ")).unwrap();
    git(repository, &["add", "."]);
    let names = git(repository, &["diff", "--cached", "--name-only"]);
    let names = names.lines().filter(|name| name.ends_with(pattern));
    let arguments: Vec<&str> = entry.split(' ').chain(names).collect();
    let answer = congruent_in(repository, &arguments);
    git(repository, &["-c", "user.name=t", "-c", "user.email=t@t", "commit", "-qm", "next"]);
    answer
}

fn git(repository: &Path, arguments: &[&str]) -> String {
    let done =
        Command::new("git").args(arguments).current_dir(repository).output().expect("git is installed");
    assert!(done.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&done.stderr));
    String::from_utf8(done.stdout).unwrap()
}

/// The table is in another folder than the URDF, and does not change in the second commit.
#[test]
fn a_commit_of_a_urdf_checks_the_robot_file_that_names_it() {
    let scratch = ScratchFolder::new();
    let repository = scratch.path();
    git(repository, &["init", "-q"]);
    for folder in ["arm", "arm_description", "other"] {
        fs::create_dir(repository.join(folder)).unwrap();
    }
    let copy = |name: &str| fs::read_to_string(workspace().join("robots/planar_2r").join(name)).unwrap();
    let urdf = repository.join("arm_description/arm.urdf");
    fs::write(&urdf, copy("planar_2r.urdf")).unwrap();
    fs::write(repository.join("other/other.urdf"), copy("planar_2r.urdf")).unwrap();
    let table = copy("robot.toml");
    let named = |urdf: &str| table.replace("\"planar_2r.urdf\"", &format!("\"{urdf}\""));
    fs::write(repository.join("arm/robot.toml"), named("../arm_description/arm.urdf")).unwrap();
    fs::write(repository.join("other/robot.toml"), named("other.urdf")).unwrap();
    let first = committed(repository, "congruent-check", ".toml");
    assert_eq!((first.code, first.stdout.matches("SAME GEOMETRY").count()), (0, 2), "{}", first.stdout);
    let moved = copy("planar_2r.urdf").replace("xyz=\"0.4 0 0\"", "xyz=\"0.41 0 0\"");
    assert_ne!(moved, copy("planar_2r.urdf"));
    fs::write(&urdf, moved).unwrap();
    let second = committed(repository, "congruent-check", ".urdf");
    assert_eq!(second.code, 1, "{}{}", second.stdout, second.stderr);
    assert!(second.stdout.starts_with("arm/robot.toml: DIFFERENT, by up to 10 mm"), "{}", second.stdout);
    assert!(!second.stdout.contains("other/"), "{}", second.stdout);
    // A URDF that no robot file names is not compared with anything.
    fs::write(repository.join("lone.urdf"), copy("planar_2r.urdf")).unwrap();
    let third = committed(repository, "congruent-check", ".urdf");
    assert_eq!(third.code, 4, "{}{}", third.stdout, third.stderr);
    assert!(third.stdout.starts_with("lone.urdf: NO SECOND DESCRIPTION"), "{}", third.stdout);
}

/// A robot that has changed beside one that has not, as the workflow `robot_changes.yml` calls it.
#[test]
fn a_change_since_a_revision_is_a_notice_and_no_failure() {
    let scratch = ScratchFolder::new();
    let repository = scratch.path();
    git(repository, &["init", "-q"]);
    for robot in ["planar_2r", "rrr_arm"] {
        fs::create_dir_all(repository.join(robot)).unwrap();
        for file in ["robot.toml".to_owned(), format!("{robot}.urdf")] {
            fs::copy(workspace().join("robots").join(robot).join(&file), repository.join(robot).join(&file))
                .unwrap();
        }
    }
    git(repository, &["add", "."]);
    git(repository, &["-c", "user.name=t", "-c", "user.email=t@t", "commit", "-qm", "first"]);
    let urdf = repository.join("planar_2r/planar_2r.urdf");
    let before = fs::read_to_string(&urdf).unwrap();
    fs::write(&urdf, before.replace("xyz=\"0.4 0 0\"", "xyz=\"0.41 0 0\"")).unwrap();
    let arguments = [
        "check",
        "planar_2r",
        "rrr_arm",
        "--against",
        "git:HEAD",
        "--annotate",
        "github",
        "--summary",
        "s.md",
    ];
    let answer = congruent_in(repository, &[&arguments[..], &["--junit", "j.xml"]].concat());
    assert_eq!(answer.code, 1, "{}", answer.stderr);
    assert!(!answer.stderr.contains("::error"), "{}", answer.stderr);
    let notices: Vec<&str> = answer.stderr.lines().filter(|line| line.starts_with("::notice")).collect();
    let [whole, of_line] = notices[..] else { panic!("{}", answer.stderr) };
    let start = "::notice file=planar_2r/planar_2r.urdf,line=";
    let end = "::moves tip by up to 10 mm; other collision shapes of link_2";
    assert!(whole.starts_with(start) && whole.ends_with(end), "{whole}");
    assert!(of_line.contains("0.41 0 0") && of_line.contains("was"), "{of_line}");
    // The table has not followed, which is a fault of today's robot.
    let table = "::warning file=planar_2r/robot.toml,line=24,";
    assert!(answer.stderr.lines().any(|line| line.starts_with(table)), "{}", answer.stderr);
    let summary = fs::read_to_string(repository.join("s.md")).unwrap();
    assert!(
        summary.starts_with(
            "### Changes since HEAD\n\n- **planar\\_2r**: moves tip by up to 10 mm; other collision"
        ),
        "{summary}"
    );
    assert!(summary.contains("\n- **rrr\\_arm**: no change in poses"), "{summary}");
    assert!(!summary.contains("failed"), "{summary}");
    let junit = fs::read_to_string(repository.join("j.xml")).unwrap();
    assert!(junit.contains("type=\"changed\""), "{junit}");
}

#[test]
fn workflows_call_commands_that_exist() {
    let mut calls = 0;
    for file in [
        ".pre-commit-hooks.yaml",
        "docs/ci/github.yml",
        "docs/ci/robot_changes.yml",
        "docs/ci/gitlab.yml",
        "docs/ci/Jenkinsfile",
    ] {
        let whole = fs::read_to_string(workspace().join(file)).unwrap().replace("\\\n", " ");
        for line in whole.lines() {
            let Some(start) = line.find("congruent check").or_else(|| line.find("congruent run")) else {
                continue;
            };
            let words: Vec<&str> = line[start..].split_whitespace().collect();
            let help = congruent(&[words[1], "--help"]);
            let options = words.iter().filter(|word| word.starts_with("--"));
            for option in options {
                assert!(
                    help.stdout.contains(&format!("{option} "))
                        || help.stdout.contains(&format!("{option}\n")),
                    "{file}: {option}"
                );
            }
            calls += 1;
        }
    }
    assert_eq!(calls, 9, "two in each file, and one for what changes");
}
