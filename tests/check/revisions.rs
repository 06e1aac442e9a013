//! `congruent check ROBOT --against git:REV`: a robot against what a revision of its repository has.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::support::{
    command::{congruent, congruent_json},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

/// A repository with the UR5e, committed and tagged `before`, and its folder.
fn repository() -> (ScratchFolder, PathBuf) {
    let folder = ScratchFolder::new();
    let robot = PathBuf::from(folder.robot("ur5e", &[]));
    git(folder.path(), &["init", "-q", "-b", "main"]);
    commit(folder.path());
    git(folder.path(), &["tag", "before"]);
    (folder, robot)
}

fn git(folder: &Path, arguments: &[&str]) {
    let identity = ["-c", "user.name=n", "-c", "user.email=n@example.org"];
    let status = Command::new("git").arg("-C").arg(folder).args(identity).args(arguments).status();
    assert!(status.unwrap().success(), "git {arguments:?}");
}

fn commit(folder: &Path) {
    git(folder, &["add", "-A"]);
    git(folder, &["commit", "-q", "-m", "change"]);
}

fn edit(file: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(file).unwrap();
    assert!(text.contains(from), "{from}");
    fs::write(file, text.replacen(from, to, 1)).unwrap();
}

#[track_caller]
fn answers(robot: &Path, other: &str, code: i32, expected: &str) {
    let answer = congruent(&["check", robot.to_str().unwrap(), "--against", other, "-q"]);
    assert_eq!(answer.code, code, "{}{}", answer.stdout, answer.stderr);
    let printed = answer.stdout + &answer.stderr;
    assert!(printed.contains(expected), "{printed}");
}

#[test]
fn a_revision_without_git_is_refused_with_what_to_write() {
    let (_folder, robot) = repository();
    let answer = congruent(&["check", robot.to_str().unwrap(), "--against", "main"]);
    assert_eq!(answer.code, 2, "{}", answer.stdout);
    let said = answer.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("it is a revision of the repository: --against git:main"), "{said}");
    assert_eq!(said.matches("does not exist").count(), 1, "{said}");
    let split = congruent(&["check", robot.to_str().unwrap(), "--against", "git", "HEAD~1"]);
    assert!(split.code == 2 && split.stderr.contains("--against git:HEAD~1"), "{}", split.stderr);
    let neither = congruent(&["check", robot.to_str().unwrap(), "--against", "nowhere"]);
    assert!(neither.code == 2 && !neither.stderr.contains("revision"), "{}", neither.stderr);
}

#[test]
fn the_answer_says_what_a_change_does() {
    let (_folder, robot) = repository();
    answers(&robot, "git:before", 0, "UNCHANGED since before: poses, torques and limits are the same");
    let urdf = robot.join("ur5e.urdf");
    edit(&urdf, "xyz=\"-0.3922 0 0.1333\"", "xyz=\"-0.3932 0 0.1333\"");
    edit(&urdf, "<mass value=\"2.846\"/>", "<mass value=\"3.246\"/>");
    answers(
        &urdf,
        "git:main",
        1,
        "CHANGED since main: moves tool0 by up to 1 mm; adds 0.4 kg at forearm_link; largest gravity torque of",
    );
    let answer = congruent_json(&["check", urdf.to_str().unwrap(), "--against", "git:main"]);
    let report = answer.json();
    let change = &report["change"];
    assert_eq!(change["revision"], "main");
    assert!((change["position_m"].as_f64().unwrap() - 1e-3).abs() < 1e-9, "{change}");
    let mass = &change["masses"][0];
    assert_eq!((mass["found_kg"].as_f64(), mass["before_kg"].as_f64()), (Some(3.246), Some(2.846)));
    assert!(report["against"]["file"].as_str().unwrap().starts_with("git:main:ur5e/ur5e.urdf"));
    // Nothing was checked out, and the working tree is as it was.
    assert!(fs::read_to_string(&urdf).unwrap().contains("3.246"));
}

#[test]
fn a_limit_and_a_mass_that_nothing_moves_are_reported() {
    let (folder, robot) = repository();
    let urdf = robot.join("ur5e.urdf");
    edit(&urdf, "effort=\"150\"", "effort=\"200\"");
    answers(&robot, "git:before", 1, "CHANGED since before: shoulder_pan_joint: effort 200 N m, was 150 N m");
    commit(folder.path());
    answers(&robot, "git:HEAD~1", 1, "effort 200 N m");
    edit(&urdf, "effort=\"200\"", "effort=\"200\" acceleration=\"4\" jerk=\"50\"");
    edit(&urdf, "<robot ", "<robot version=\"1.2\" ");
    commit(folder.path());
    edit(&urdf, "acceleration=\"4\"", "acceleration=\"5\"");
    answers(&robot, "git:HEAD", 1, "shoulder_pan_joint: acceleration 286 deg/s^2, was 229 deg/s^2");
    git(folder.path(), &["checkout", "-q", "."]);
    answers(&robot, "git:HEAD", 0, "UNCHANGED since HEAD");
    edit(&urdf, "<mass value=\"4\"/>", "<mass value=\"5.5\"/>");
    answers(
        &robot,
        "git:HEAD",
        0,
        "UNCHANGED since HEAD in poses, torques and limits; adds 1.5 kg at base_link_inertia",
    );
}

/// No pose and no torque depends on them, and what collides does.
#[test]
fn other_collision_shapes_are_named() {
    let (_folder, robot) = repository();
    let urdf = robot.join("ur5e.urdf");
    let drawn = "<geometry><cylinder radius=\"0.058\" length=\"0.152\"/></geometry>";
    edit(&urdf, drawn, &drawn.replace("0.058", "0.057"));
    answers(&robot, "git:HEAD", 0, "UNCHANGED since HEAD: poses, torques and limits are the same");
    edit(&urdf, drawn, &drawn.replace("0.152", "0.162"));
    let expected =
        "UNCHANGED since HEAD in poses, torques and limits; other collision shapes of shoulder_link";
    answers(&robot, "git:HEAD", 0, expected);
}

#[test]
fn an_armature_is_compared_with_that_of_a_revision_and_not_with_a_urdf() {
    let (folder, robot) = repository();
    let xml = folder.path().join("arm.xml");
    let [mjcf, plain] =
        [&xml, &folder.path().join("plain.urdf")].map(|path| path.to_str().unwrap().to_owned());
    let converted = congruent(&["convert", robot.to_str().unwrap(), "--out", &mjcf]);
    assert_eq!(converted.code, 0, "{}", converted.stderr);
    let elbow = "<joint name=\"elbow_joint\"";
    edit(&xml, elbow, &format!("{elbow} armature=\"0.1\""));
    commit(folder.path());
    answers(&xml, "git:HEAD", 0, "UNCHANGED since HEAD");
    edit(&xml, "armature=\"0.1\"", "armature=\"0.3\"");
    answers(&xml, "git:HEAD", 1, "elbow_joint: armature 0.3 kg m^2, was 0.1 kg m^2");
    let answer = congruent(&["check", &mjcf, "--against", robot.to_str().unwrap()]);
    let stated = format!("not compared: armature, stated by {mjcf} alone");
    assert_eq!((answer.code, answer.stdout.matches(&stated).count()), (0, 1), "{}", answer.stdout);
    let answer = congruent(&["describe", &mjcf]);
    assert!(answer.stdout.contains("armature 0.3 kg m^2"), "{}", answer.stdout);
    // A URDF has no place for it, and says so.
    let answer = congruent(&["convert", &mjcf, "--out", &plain]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    assert!(answer.stderr.contains("its armature, 0.3 kg m^2, is not written"), "{}", answer.stderr);
}

#[test]
fn a_file_that_moved_is_named_by_its_old_path_and_includes_come_from_the_same_revision() {
    let (folder, robot) = repository();
    let xml = folder.path().join("arm.xml");
    fs::write(&xml, "<mujoco><include file='body.xml'/></mujoco>").unwrap();
    let body = "<mujoco><worldbody><body name='arm'><joint name='q' axis='0 1 0' range='-90 90'/><geom size='.1' mass='1' pos='0 0 .3'/>\
                </body></worldbody></mujoco>";
    fs::write(folder.path().join("body.xml"), body).unwrap();
    commit(folder.path());
    answers(&xml, "git:HEAD", 0, "UNCHANGED since HEAD");
    edit(&folder.path().join("body.xml"), "mass='1'", "mass='2'");
    answers(&xml, "git:HEAD", 1, "CHANGED since HEAD: adds 1 kg at arm");
    fs::rename(robot.join("ur5e.urdf"), robot.join("arm.urdf")).unwrap();
    answers(&robot.join("arm.urdf"), "git:HEAD:ur5e/ur5e.urdf", 0, "UNCHANGED since HEAD");
    answers(&robot.join("arm.urdf"), "git:HEAD", 2, "HEAD has no file");
}

#[test]
fn what_git_does_not_have_is_said_with_the_nearest_name() {
    let (folder, robot) = repository();
    answers(&robot, "git:mian", 2, "did you mean git:main?");
    answers(&robot, "git:", 2, "has no revision \"\"");
    answers(&robot, "git:--help", 2, "has no revision \"--help\"");
    answers(&robot, "git:main:ur5/ur5e.urdf", 2, "it has git:main:ur5e/ur5e.urdf");
    let urdf = robot.join("ur5e.urdf");
    edit(&urdf, "type=\"revolute\"", "type=\"revolut\"");
    commit(folder.path());
    edit(&urdf, "type=\"revolut\"", "type=\"revolute\"");
    // The place of a fault is in the revision.
    answers(&robot, "git:HEAD", 2, "git:HEAD:ur5e/ur5e.urdf:");
    let elsewhere = ScratchFolder::new();
    fs::copy(workspace().join("robots/ur5e/ur5e.urdf"), elsewhere.path().join("a.urdf")).unwrap();
    answers(&elsewhere.path().join("a.urdf"), "git:main", 2, "is in no git repository");
}

#[test]
fn everything_that_changes_is_named_beside_an_origin() {
    let (folder, robot) = repository();
    let urdf = robot.join("ur5e.urdf");
    edit(&urdf, "xyz=\"-0.3922 0 0.1333\"", "xyz=\"-0.3932 0 0.1333\"");
    edit(&urdf, "effort=\"150\"", "effort=\"200\"");
    for part in ["moves tool0 by up to 1 mm", "shoulder_pan_joint: effort 200 N m, was 150 N m"] {
        answers(&urdf, "git:main", 1, part);
    }
    git(folder.path(), &["checkout", "-q", "."]);
    // A frame that is gone moves nothing, and whoever names it misses it.
    let text = fs::read_to_string(&urdf).unwrap();
    let start =
        text.find("<joint name=\"ft_frame").or_else(|| text.find("<joint name=\"wrist_3_link-ft_frame"));
    let start = start.unwrap_or_else(|| panic!("{text}"));
    let end = start + text[start..].find("</joint>").unwrap() + "</joint>".len();
    let without = text[..start].to_owned() + &text[end..];
    fs::write(&urdf, without.replacen("<link name=\"ft_frame\"/>", "", 1)).unwrap();
    answers(&urdf, "git:main", 1, "CHANGED since main: removes link ft_frame");
}

#[test]
fn a_changed_table_is_a_change() {
    let (_folder, robot) = repository();
    edit(&robot.join("robot.toml"), "a_m = -0.3922", "a_m = -0.3932");
    let report = congruent_json(&["check", robot.to_str().unwrap(), "--against", "git:before"]).json();
    let value = &report["change"]["values"][0];
    assert_eq!(
        (&value["figure"], &value["found"], &value["before"]),
        (&"table a".into(), &(-0.3932).into(), &(-0.3922).into())
    );
}

/// Another coupling of a joint that follows moves the tip. The constant to write counts from the `ref` of both joints.
#[test]
fn another_coupling_of_an_mjcf_moves_the_tip() {
    let body = |name: &str, pos: &str, joint: &str, inside: &str| {
        format!(
            "<body name=\"{name}\" pos=\"{pos}\"><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"0.1 0.1 0.1\"/>{joint}{inside}</body>"
        )
    };
    let tip = body("tip", "0.3 0 0", "", "");
    let last = body("last", "0.4 0 0", "<joint name=\"j2\" axis=\"0 1 0\" range=\"-1 1\"/>", &tip);
    let first =
        body("first", "0 0 0.2", "<joint name=\"j1\" axis=\"0 1 0\" range=\"-1 1\" ref=\"0.2\"/>", &last);
    let text = format!(
        "<mujoco><compiler angle=\"radian\"/><worldbody>{first}</worldbody>\n<equality>\
         <joint joint1=\"j2\" joint2=\"j1\" polycoef=\"0.1 -0.5 0 0 0\"/></equality></mujoco>\n"
    );
    let folder = ScratchFolder::new();
    let file = PathBuf::from(folder.write("arm.xml", &text));
    git(folder.path(), &["init", "-q", "-b", "main"]);
    commit(folder.path());
    edit(&file, "0.1 -0.5 0", "0.1 -0.6 0");
    let answer = congruent(&["check", file.to_str().unwrap(), "--against", "git:HEAD", "--tip", "tip"]);
    assert!(
        answer.code == 1 && answer.stdout.contains("CHANGED since HEAD: moves tip by up to"),
        "{}",
        answer.stdout
    );
    assert!(!answer.stdout.contains("not the tip"), "{}", answer.stdout);
    assert!(answer.stdout.contains("polycoef=\"0.1 -0.5 0 0 0\""), "{}", answer.stdout);
}
