//! `congruent convert`: their output is parsed again and checked by `congruent check`.

use std::{fs, path::Path};

use serde_json::Value;

use crate::support::{
    command::{Answer, congruent, congruent_json, text},
    corpus::{corpus, workspace},
};

/// Largest error of a conversion: rad and m. Worst seen: 1e-14.
const ACCURACY: f64 = 1e-12;
const CONVENTIONS: [&str; 2] = ["standard", "modified"];

/// A robot file around a section `[dh]`, judged at the accuracy of conversions.
#[track_caller]
fn agrees(section: &str, urdf: &Path, report: &Value) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("robot.toml");
    let head = format!("urdf = {:?}\nbase = {}\ntip = {}\n", text(urdf), report["base"], report["tip"]);
    let tolerance = format!("[tolerance]\nposition_m = {ACCURACY:?}\norientation_rad = {ACCURACY:?}\n");
    fs::write(&file, format!("{head}{tolerance}{section}")).unwrap();
    let answer = congruent_json(&["check", &text(&file)]);
    let comparisons = answer.json()["comparisons"].clone();
    let by_table =
        comparisons.as_array().and_then(|all| all.iter().find(|each| each["name"] == "model_urdf"));
    let verdict = by_table.map(|comparison| comparison["verdict"].clone());
    assert_eq!(verdict, Some("agree".into()), "{}: {}{}", urdf.display(), answer.stdout, answer.stderr);
}

#[track_caller]
fn proved(answer: &Answer) -> Value {
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let report = answer.json();
    let worst = report["proof"]["worst"].as_f64().unwrap();
    assert!(worst <= ACCURACY, "{worst:e}: {report:#}");
    report
}

/// Derives both tables, checks each as it is printed, and turns it into a URDF that agrees again.
#[track_caller]
fn goes_round(urdf: &Path, chain: &[&str]) {
    for convention in CONVENTIONS {
        let path = text(urdf);
        let mut arguments = vec!["convert", &path, "--from", "urdf", "--to", convention, "--exact"];
        arguments.extend(chain);
        let report = proved(&congruent_json(&arguments));
        let printed = congruent(&arguments).stdout;
        agrees(&printed, urdf, &report);
        assert!(printed.ends_with(report["robot_toml"].as_str().unwrap()));
        let mut arguments = vec!["convert", &path, "--to", "urdf"];
        arguments.extend(chain);
        proved(&congruent_json(&arguments));
        let folder = tempfile::tempdir().unwrap();
        let written = folder.path().join("chain.urdf");
        fs::write(&written, congruent(&arguments).stdout).unwrap();
        agrees(&printed, &written, &report);
    }
}

#[test]
fn longest_chains_of_the_corpus() {
    let Some(corpus) = corpus() else { return };
    let names = [
        "baxter",
        "denso_hsr065",
        "fanuc_m10ia",
        "iiwa14",
        "panda",
        "rrr_arm",
        "so100",
        "ur5e",
        "xarm7_gripper",
    ];
    for name in names {
        goes_round(&corpus.join("robots").join(name).join("robot.urdf"), &[]);
    }
}

#[test]
fn both_arms_of_a_torso() {
    let Some(corpus) = corpus() else { return };
    let urdf = corpus.join("robots/baxter/robot.urdf");
    for tip in ["left_gripper", "right_gripper"] {
        goes_round(&urdf, &["--base", "torso", "--tip", tip]);
    }
}

/// Reference cases 8 and 9: table, screws and URDF of one robot, in both conventions.
#[test]
fn declared_tables_of_all_robots() {
    for entry in fs::read_dir(workspace().join("robots")).unwrap().flatten() {
        let folder = text(&entry.path());
        let signs = |report: &Value| {
            let rows = report["table"]["rows"].as_array().unwrap().clone();
            rows.iter().map(|row| row["sign"].clone()).collect::<Vec<_>>()
        };
        let by_convention = CONVENTIONS.map(|convention| {
            let report = proved(&congruent_json(&["convert", &folder, "--to", convention]));
            assert_eq!(report["from"], "dh");
            report
        });
        assert_eq!(signs(&by_convention[0]), signs(&by_convention[1]));
        proved(&congruent_json(&["convert", &folder, "--to", "poe"]));
        proved(&congruent_json(&["convert", &folder, "--to", "urdf"]));
        proved(&congruent_json(&["convert", &folder, "--from", "urdf", "--to", "modified"]));
        let urdf = fs::read_dir(entry.path()).unwrap().flatten().map(|file| file.path());
        let urdf = urdf.into_iter().find(|path| path.extension().is_some_and(|end| end == "urdf")).unwrap();
        goes_round(&urdf, &[]);
        for report in by_convention {
            agrees_within_the_robots_own(report["robot_toml"].as_str().unwrap(), &urdf, &report);
        }
    }
}

/// The declared table may differ from the URDF by digits; the tolerance of robot files applies.
#[track_caller]
fn agrees_within_the_robots_own(section: &str, urdf: &Path, report: &Value) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("robot.toml");
    let head = format!("urdf = {:?}\nbase = {}\ntip = {}\n", text(urdf), report["base"], report["tip"]);
    fs::write(&file, format!("{head}{section}")).unwrap();
    let answer = congruent_json(&["check", &text(&file)]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
}

const TWO_JOINTS: &str = r#"<robot name="two">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="tip"/>
  <joint name="shoulder" type="continuous">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 0.3" rpy="0.3 0.4 0.5"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper"/><child link="lower"/><origin xyz="0.3 0.4 0.1" rpy="ROLL 0 0"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="flange" type="fixed"><parent link="lower"/><child link="tip"/><origin xyz="0 0 0.2"/></joint>
</robot>"#;

/// Two joints whose axes are this far from parallel.
fn two_joints(roll: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("two.urdf");
    fs::write(&file, TWO_JOINTS.replace("ROLL", roll)).unwrap();
    let path = text(&file);
    (folder, path)
}

#[test]
fn nearly_parallel_axes_are_refused_and_simplified_only_on_demand() {
    let (_folder, path) = two_joints("3.14159265");
    let refused = congruent(&["convert", &path, "--from", "urdf", "--to", "standard", "--exact"]);
    assert_eq!(refused.code, 2, "{}", refused.stdout);
    for word in ["shoulder", "elbow", "3.59 nrad from parallel", "--accuracy"] {
        assert!(refused.stderr.contains(word), "no {word:?} in {}", refused.stderr);
    }
    let coarse = ["convert", &path, "--from", "urdf", "--to", "standard", "--exact", "--accuracy", "1e-7"];
    let coarse = congruent_json(&coarse).json();
    assert_eq!(coarse["axes"][0]["relation"], "anti_parallel");
    let worst = coarse["proof"]["worst"].as_f64().unwrap();
    assert!(worst > 1e-9 && worst < 1e-8, "{worst:e}");
    // A turn that says the half turn with all its digits is exactly anti-parallel.
    let (_folder, path) = two_joints("3.141592653589793");
    goes_round(Path::new(&path), &[]);
}

/// A quarter turn or a half turn with this many digits: the axes are taken as anti-parallel, and said so.
#[test]
fn axes_that_are_parallel_up_to_rounding_are_taken_as_parallel() {
    for (roll, off_by) in [("3.14159", 2.653_589_793_2e-6), ("-3.1415", 9.265_358_979_3e-5)] {
        let (_folder, path) = two_joints(roll);
        let answer = congruent_json(&["convert", &path, "--from", "urdf", "--to", "standard"]);
        assert_eq!(answer.code, 0, "{}", answer.stderr);
        for word in ["convert::rounded_axes", "shoulder and elbow", "--exact"] {
            assert!(
                congruent(&["convert", &path, "--from", "urdf", "--to", "standard"]).stderr.contains(word),
                "{word}"
            );
        }
        let report = answer.json();
        let rounded = &report["rounded_axes"][0];
        assert_eq!((&rounded["relation"], &rounded["joints"][1]), (&"anti_parallel".into(), &"elbow".into()));
        assert!((rounded["angle_rad"].as_f64().unwrap() - off_by).abs() < 1e-12, "{rounded}");
        let row = &report["table"]["rows"][0];
        // The axes are 0.5 m apart in the URDF: 0.3 m along x and 0.4 m along y.
        assert!((row["a_m"].as_f64().unwrap() - 0.5).abs() < ACCURACY, "{row}");
        assert!(row["d_m"].as_f64().unwrap().abs() < 1.0, "{row}");
        // A turn of the second axis by this angle at the flange, which is 0.2 m from the joint.
        let proof = &report["proof"];
        let (position_m, orientation_rad) =
            (proof["position_m"].as_f64().unwrap(), proof["orientation_rad"].as_f64().unwrap());
        assert!(position_m > 0.1 * off_by && position_m <= 0.4 * off_by + ACCURACY, "{position_m:e}");
        assert!(
            orientation_rad > off_by && orientation_rad <= 2.0 * off_by + ACCURACY,
            "{orientation_rad:e}"
        );
    }
}

#[test]
fn a_robot_file_that_is_derived_agrees_at_once() {
    let (folder, path) = two_joints("3.1415");
    fs::create_dir(folder.path().join("models")).unwrap();
    let output = text(&folder.path().join("models/robot.toml"));
    let derive = |more: &[&str]| {
        let mut arguments = vec!["convert", &path, "--from", "urdf", "--to", "modified", "--to", &output];
        arguments.extend(more);
        congruent(&arguments)
    };
    let written = derive(&[]);
    assert_eq!(written.code, 0, "{}", written.stderr);
    assert!(written.stdout.ends_with(&format!("written to {output}\n")), "{}", written.stdout);
    let robot_file: toml::Value = toml::from_str(&fs::read_to_string(&output).unwrap()).unwrap();
    assert_eq!(robot_file["urdf"].as_str(), Some("../two.urdf"));
    assert_eq!((robot_file["base"].as_str(), robot_file["tip"].as_str()), (Some("base"), Some("tip")));
    let checked = congruent_json(&["check", &output]);
    assert_eq!(checked.code, 0, "{}{}", checked.stdout, checked.stderr);
    assert_eq!(
        (&checked.json()["verdict"], &checked.json()["table_compared"]),
        (&"agree".into(), &true.into())
    );
    let again = derive(&[]);
    assert!(again.code == 2 && again.stderr.contains("exists"), "{}", again.stderr);
    assert_eq!(derive(&["--force"]).code, 0);
}

#[test]
fn nothing_that_exists_is_lost_by_an_output() {
    let (folder, path) = two_joints("0.3");
    let before = fs::read(&path).unwrap();
    let linked = folder.path().join("linked.toml");
    fs::hard_link(&path, &linked).unwrap();
    for (output, says) in [
        (text(&linked), "is an input file"),
        (text(folder.path()), "must end in .toml"),
        (path.clone(), "must end in .toml"),
        (text(&folder.path().join("nowhere/robot.toml")), "cannot write"),
    ] {
        let refused =
            congruent(&["convert", &path, "--from", "urdf", "--to", "standard", "--force", "--to", &output]);
        assert_eq!(refused.code, 2, "{output}: {}", refused.stdout);
        assert!(refused.stderr.contains(says), "{output}: {}", refused.stderr);
    }
    let urdf = congruent(&["convert", &path, "--to", "urdf", "--force", "--to", &path]);
    assert!(urdf.code == 2 && urdf.stderr.contains("is an input file"), "{}", urdf.stderr);
    // A robot file beside the URDF of another robot's meshes that it cannot reach.
    let output = folder.path().join("robot.toml");
    fs::write(&output, "kept").unwrap();
    let refused = congruent(&[
        "convert",
        &path,
        "--from",
        "urdf",
        "--to",
        "standard",
        "--tip",
        "base",
        "--to",
        &text(&output),
        "--force",
    ]);
    assert_eq!(refused.code, 2, "{}", refused.stderr);
    assert_eq!((fs::read(&path).unwrap(), fs::read(&output).unwrap()), (before, b"kept".to_vec()));
    let left = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 3);
}

#[test]
fn lengths_that_no_arm_has_are_warned_of() {
    let (_folder, path) = two_joints("0.001");
    let answer = congruent(&["convert", &path, "--from", "urdf", "--to", "standard", "--accuracy", "1e-9"]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    // Lines 0.5 m apart in projection that differ by 0.001 rad meet some 400 m away.
    for word in ["convert::far_normal", "d of shoulder is 400 m", "0.0573 deg from parallel"] {
        assert!(answer.stderr.contains(word), "no {word:?} in {}", answer.stderr);
    }
}

#[test]
fn a_chain_that_does_not_move_has_no_table() {
    let (_folder, path) = two_joints("0.3");
    let refused = congruent(&[
        "convert", &path, "--from", "urdf", "--to", "modified", "--base", "lower", "--tip", "tip",
    ]);
    assert_eq!(refused.code, 2);
    assert!(refused.stderr.contains("no moving joint"), "{}", refused.stderr);
    let poe = proved(&congruent_json(&["convert", &path, "--to", "poe", "--base", "lower", "--tip", "tip"]));
    assert_eq!(poe["poe"]["space_screws"].as_array().unwrap().len(), 0);
    let upwards = congruent(&[
        "convert", &path, "--from", "urdf", "--to", "modified", "--base", "tip", "--tip", "upper",
    ]);
    assert_eq!(upwards.code, 2);
    assert!(upwards.stderr.contains("is not a descendant of"), "{}", upwards.stderr);
    let unknown = congruent(&["convert", &path, "--to", "poe", "--tip", "tipp"]);
    assert!(unknown.code == 2 && unknown.stderr.contains("did you mean \"tip\"?"), "{}", unknown.stderr);
}

#[test]
fn a_mimic_joint_in_the_chain_is_noted() {
    let Some(corpus) = corpus() else { return };
    let urdf = text(&corpus.join("robots/xarm7_gripper/robot.urdf"));
    let derive = ["convert", &urdf, "--from", "urdf", "--to", "standard", "--tip", "left_finger", "--exact"];
    let report = proved(&congruent_json(&derive));
    let notes = report["notes"].to_string();
    assert!(notes.contains("left_finger_joint") && notes.contains("drive_joint"), "{notes}");
}

#[test]
fn a_table_does_not_exist_from_another_base() {
    let arguments = ["convert", "robots/ur5e", "--to", "urdf", "--from", "dh", "--base", "shoulder_link"];
    let answer = congruent(&arguments);
    assert_eq!(answer.code, 2);
    for words in [
        "--from dh: the [dh] table",
        "\"base_link\" to \"tool0\", not from \"shoulder_link\" to \"tool0\"",
        "--from urdf",
    ] {
        assert!(answer.stderr.contains(words), "no {words:?} in {}", answer.stderr);
    }
    let bare = congruent(&["convert", "robots/ur5e/ur5e.urdf", "--to", "urdf", "--from", "dh"]);
    assert!(bare.code == 2 && bare.stderr.contains("has no [dh] table"), "{}", bare.stderr);
}
