//! Mistakes that people make with their first files: the message says what to write instead.

use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::support::{
    command::{congruent, text},
    corpus::workspace,
};

/// A folder with a small robot, changed in one place.
struct Desk {
    folder: tempfile::TempDir,
}

impl Desk {
    fn new() -> Self {
        let desk = Self { folder: tempfile::tempdir().unwrap() };
        for (file, to) in [("robot.toml", "arm/robot.toml"), ("planar_2r.urdf", "arm/planar_2r.urdf")] {
            let path = desk.path(to);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::copy(workspace().join("robots/planar_2r").join(file), path).unwrap();
        }
        desk
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The robot file with one piece replaced, beside the original.
    #[track_caller]
    fn robot_with(&self, from: &str, to: &str) -> String {
        let before = fs::read_to_string(self.path("arm/robot.toml")).unwrap();
        assert!(before.contains(from), "no {from:?}");
        let path = self.path("arm/changed.toml");
        fs::write(&path, before.replacen(from, to, 1)).unwrap();
        text(&path)
    }

    fn scenario_with(&self, more: &str) -> String {
        let path = self.path("run.toml");
        let head = "schema_version = 1\nname = \"desk\"\nrobot = \"arm\"\n[controller]\nkind = \"passive\"\n";
        fs::write(&path, format!("{head}{more}")).unwrap();
        text(&path)
    }
}

/// The call is refused with all of these words, in one line or in wrapped ones.
#[track_caller]
fn refused(arguments: &[&str], words: &[&str]) -> String {
    let answer = congruent(arguments);
    assert_eq!(answer.code, 2, "{}{}", answer.stdout, answer.stderr);
    // Messages are wrapped at the width of a terminal.
    let said = answer.stderr.replace('\u{2502}', " ");
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    for word in words {
        assert!(said.contains(word), "no {word:?} in: {}", answer.stderr);
    }
    said
}

#[test]
fn a_folder_of_a_description_package_names_its_urdf() {
    let desk = Desk::new();
    let urdf = desk.path("arm_description/urdf/arm.urdf");
    fs::create_dir_all(urdf.parent().unwrap()).unwrap();
    fs::copy(desk.path("arm/planar_2r.urdf"), &urdf).unwrap();
    let package = text(&desk.path("arm_description"));
    refused(&["check", &package], &["is a directory without a robot.toml", "arm.urdf: give that file"]);
    // A robot file that names it without its folder.
    let named = desk.robot_with("urdf = \"planar_2r.urdf\"", "urdf = \"arm.urdf\"");
    let meant = Path::new("..").join("arm_description/urdf/arm.urdf").display().to_string();
    refused(&["check", &named], &["relative to the robot file; did you mean", &meant]);
    let address = desk.robot_with("urdf = \"planar_2r.urdf\"", "urdf = \"package://arm/arm.urdf\"");
    refused(&["check", &address], &["is no path", "package:// is for meshes"]);
}

#[test]
fn values_of_a_table_in_another_form() {
    let desk = Desk::new();
    for (from, to, words) in [
        ("dhn_from_tip = {}", "dhn_from_tip = [0, 0, 70]", "dhn_from_tip = { xyz_mm = [0, 0, 70] }"),
        ("alpha_deg = 0.0", "alpha_deg = pi/2", "TOML has no expressions such as pi/2: alpha_deg = 90.0"),
        ("alpha_deg = 0.0", "alpha_deg = 0,5", "0,5 is not a number: use a point for decimals"),
        ("alpha_deg = 0.0", "alpha_deg = 0,5", "write alpha_deg = 0.5"),
        (
            "alpha_deg = 0.0",
            "alpha_deg = 90\u{b0}",
            "write 90 without the sign: the unit is in the key, alpha_deg = 90",
        ),
        ("alpha_deg = 0.0", "alpha_deg = \"0,5\"", "write 0.5 without quotes: use a point for decimals"),
        ("dhn_from_tip = {}", "dhn_from_tip = {", "the table { ... } that begins in line"),
        ("kind = \"revolute\"\n", "", "kind = \"revolute\" or kind = \"prismatic\""),
        ("\"revolute\"", "\"continuous\"", "\"continuous\" is called \"revolute\" here"),
        ("\"standard\"", "\"craig\"", "\"craig\" is called \"modified\" here"),
    ] {
        refused(&["check", &desk.robot_with(from, to)], &[words]);
    }
    let table = fs::read_to_string(desk.path("arm/robot.toml")).unwrap();
    let second = &table[table.rfind("[[dh.row]]").unwrap()..table.find("[tolerance]").unwrap()];
    refused(&["check", &desk.robot_with(second, "")], &["no row for joint_2", "add a row for each of them"]);
    let twice = second.replace("joint_2", "joint_1");
    refused(
        &["check", &desk.robot_with(second, &twice)],
        &["joint \"joint_1\" has two rows (lines", "joint \"joint_2\" has none"],
    );
}

/// A misspelt key is one finding: that the key is missing follows from it.
#[test]
fn a_misspelt_key_of_a_table_is_one_finding() {
    let desk = Desk::new();
    for (from, to) in [("convention", "conventon"), ("alpha_deg", "alfa_deg"), ("[[dh.row]]", "[[dh.rows]]")]
    {
        let table = fs::read_to_string(desk.path("arm/robot.toml")).unwrap().replace(from, to);
        let path = desk.path("arm/misspelt.toml");
        fs::write(&path, table).unwrap();
        let said = refused(&["check", &text(&path)], &["unknown key", "did you mean"]);
        let lines = said.matches("error:").count();
        assert_eq!(lines, said.matches("unknown key").count(), "{said}");
    }
}

#[test]
fn values_of_a_scenario_in_another_form() {
    let desk = Desk::new();
    let obstacle =
        "[[obstacle]]\nname = \"box\"\nbox_mm = [100, 100, 200]\n[obstacle.pose]\nxyz_m = [0.5, 0, 0]\n";
    refused(&["run", &desk.scenario_with(obstacle)], &["write box_m = [0.1, 0.1, 0.2]"]);
    let pairs = "[[check]]\nkind = \"clearance\"\nminimum_mm = 1\nignore = [\"link_1--link_2\"]\n";
    refused(&["run", &desk.scenario_with(pairs)], &["write [\"link_1\", \"link_2\"]"]);
    let said = refused(
        &["run", &desk.scenario_with("[[motion]]\nmove_joint_deg = { joint_1 = 1 }\n")],
        &["unknown key \"move_joint_deg\"", "did you mean \"move_joints_deg\"?"],
    );
    assert!(!said.contains("has no target"), "{said}");
    let collision = "[[check]]\nkind = \"collision\"\n";
    refused(&["run", &desk.scenario_with(collision)], &["did you mean \"clearance\" or \"contact\"?"]);
}

#[test]
fn a_robot_that_a_scenario_does_not_find_is_one_finding() {
    let desk = Desk::new();
    let path = desk.scenario_with("[[check]]\nkind = \"agreement\"\n");
    let wrong = fs::read_to_string(&path).unwrap().replace("robot = \"arm\"", "robot = \"amr/robot.toml\"");
    fs::write(&path, wrong).unwrap();
    let said = refused(&["run", &path], &["does not exist", "run.toml:3:"]);
    assert_eq!(said.matches("error:").count(), 1, "{said}");
}

#[test]
fn a_pattern_that_matches_nothing() {
    refused(&["run", "scenarios_of_nobody/*.toml"], &["no file matches this pattern"]);
}

#[test]
fn targets_in_millimetres() {
    let robot = "robots/ur5e";
    let said = refused(&["ik", robot, "--xyz", "350,100,450mm"], &["write 350mm,100mm,450mm"]);
    assert!(said.contains("only some values have a unit"), "{said}");
    refused(&["ik", robot, "--xyz", "350mm 100mm 450mm"], &["with commas: 350mm,100mm,450mm"]);
    refused(&["ik", robot, "--xyz", "0.4", "0.1", "0.3"], &["no spaces: --xyz 0.4,0.1,0.3"]);
    let far = congruent(&["ik", robot, "--xyz", "350,100,450"]);
    assert_eq!(far.code, 1, "{}", far.stderr);
    assert!(far.stdout.contains("(in mm? --xyz 350mm,100mm,450mm)"), "{}", far.stdout);
    let near = congruent(&["ik", robot, "--xyz", "350mm,100mm,450mm"]);
    assert!(near.stdout.contains("target 1, [350 mm, 100 mm, 450 mm]: reached"), "{}", near.stdout);
}

/// A wrist that cannot turn far enough.
#[test]
fn a_joint_that_keeps_the_tool_from_its_orientation_is_named() {
    let desk = Desk::new();
    let read = |name: &str| fs::read_to_string(workspace().join("robots/ur5e").join(name)).unwrap();
    let (urdf, table) = (read("ur5e.urdf"), read("robot.toml"));
    let at = urdf.find("<joint name=\"wrist_3_joint\"").unwrap();
    let limited =
        urdf[at..].replacen("lower=\"-6.283185307179586\" upper=\"6.28", "lower=\"0\" upper=\"0.28", 1);
    fs::write(desk.path("ur5e.urdf"), urdf[..at].to_owned() + &limited).unwrap();
    fs::write(desk.path("ur5e.toml"), table).unwrap();
    let robot = text(&desk.path("ur5e.toml"));
    let answer = congruent(&["ik", &robot, "--xyz", "0.5,0.1,0.3", "--rpy", "180deg,0,40deg"]);
    assert_eq!(answer.code, 1, "{}", answer.stderr);
    let reason = "but not in this orientation: wrist_3_joint is at its limit; after";
    assert!(answer.stdout.contains(reason), "{}", answer.stdout);
}

#[test]
fn lists_units_and_revisions_that_are_nearly_right() {
    let both = "shoulder_pan_joint=1rad,elbow_joint=2rad";
    refused(
        &["fk", "robots/ur5e", "--at", both],
        &["once for each joint: --at shoulder_pan_joint=1rad --at elbow_joint=2rad"],
    );
    let said = refused(
        &["check", "robots/ur5e", "--tolerance", "1mm", "0.1deg"],
        &["a comma joins both parts of a tolerance, without a space: --tolerance 1mm,0.1deg"],
    );
    assert_eq!(said.matches("0.1deg does not exist").count(), 1, "{said}");
    refused(
        &["compare", "robots/ur5e", "robots/ur5e/wrong_convention.toml"],
        &["congruent check robots/ur5e --against robots/ur5e/wrong_convention.toml compares two robots"],
    );
    let desk = Desk::new();
    let table = fs::read_to_string(workspace().join("robots/rrr_arm/robot.toml")).unwrap();
    let urdf = text(&workspace().join("robots/rrr_arm/rrr_arm.urdf"));
    let inches =
        table.replace("\"rrr_arm.urdf\"", &format!("\"{urdf}\"")).replacen("d_m = 0.", "d_inch = 4", 1);
    assert!(inches.contains("d_inch"), "{inches}");
    fs::write(desk.path("inches.toml"), inches).unwrap();
    let said = refused(&["check", &text(&desk.path("inches.toml"))], &["inches are not read: write d_mm = "]);
    assert!(!said.contains("neither"), "{said}");
}

#[test]
fn names_that_are_nearly_right() {
    refused(&["chek", "robots/ur5e"], &["'check'"]);
    let said = refused(&["fk", "robots/ur5e", "--at", "elbw=90deg"], &["did you mean \"elbow_joint\"?"]);
    assert!(said.contains("known joints"), "{said}");
    refused(&["fk", "robots/ur5e", "--joints", "0,0"], &["write --at JOINT=POSITION"]);
    // Where the codes are explained, once.
    let said = refused(&["fk", "robots/ur5e", "--at", "elbw=90deg"], &["more: congruent explain CGR-"]);
    assert_eq!(said.matches("more: ").count(), 1, "{said}");
}
