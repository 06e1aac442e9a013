//! `congruent new robot` and `congruent new scenario`: what they write passes the commands that it is for.

use std::{
    fs,
    path::{Path, PathBuf},
};

use serde_json::Value;

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::{corpus, workspace},
};

/// All URDFs of real robots: those of the project, and of the corpus where there is one.
fn urdfs() -> Vec<PathBuf> {
    let folders = std::iter::once(workspace().join("robots"));
    let folders = folders.chain(corpus().map(|corpus| corpus.join("robots")));
    let mut urdfs: Vec<PathBuf> = folders
        .flat_map(|folder| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()))
        .filter(|folder| folder.is_dir())
        .flat_map(|folder| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()))
        .filter(|file| file.extension().is_some_and(|extension| extension == "urdf"))
        // Variants of a robot that is here already.
        .filter(|file| !["original.urdf", "traj_model.urdf"].iter().any(|name| file.ends_with(name)))
        .collect();
    urdfs.sort();
    assert!(urdfs.len() >= 7, "{urdfs:?}");
    urdfs
}

fn write(folder: &Path, name: &str, contents: &str) -> String {
    fs::write(folder.join(name), contents).unwrap();
    text(&folder.join(name))
}

#[test]
fn a_new_robot_file_passes_its_check() {
    let folder = tempfile::tempdir().unwrap();
    for (index, urdf) in urdfs().into_iter().enumerate() {
        let out = text(&folder.path().join(format!("deep/{index}")));
        let made = congruent_json(&["new", "robot", &text(&urdf), "--out", &out]);
        assert_eq!(made.code, 0, "{}: {}{}", urdf.display(), made.stdout, made.stderr);
        let report = made.json();
        assert_eq!(report["verdict"], "agree");
        assert_eq!(report["has_table"], true, "{report}");
        let written = fs::read_to_string(Path::new(&out).join("robot.toml")).unwrap();
        assert!(written.contains("# The link that the model's last frame is declared in:"), "{written}");
        let table: toml::Table = written.parse().unwrap();
        // The URDF is referred to, relative to the file, and nothing else is in the folder.
        assert!(!Path::new(table["urdf"].as_str().unwrap()).is_absolute());
        assert_eq!(fs::read_dir(&out).unwrap().count(), 1);
        let checked = congruent_json(&["check", &out]);
        assert_eq!(checked.code, 0, "{}: {}", urdf.display(), checked.stderr);
        assert_eq!(checked.json()["chain"]["tip"], report["chain"]["tip"]);
    }
}

#[test]
fn base_tip_and_convention_are_taken_from_the_call() {
    let folder = tempfile::tempdir().unwrap();
    let out = text(&folder.path().join("arm"));
    let urdf = "robots/ur5e/ur5e.urdf";
    let arguments =
        ["new", "robot", urdf, "--out", &out, "--tip", "wrist_1_link", "--convention", "modified"];
    let made = congruent(&arguments);
    assert_eq!(made.code, 0, "{}", made.stderr);
    let written = fs::read_to_string(Path::new(&out).join("robot.toml")).unwrap();
    for words in [
        "given by --tip",
        "tip = \"wrist_1_link\"",
        "convention = \"modified\"",
        "chosen automatically: the root",
    ] {
        assert!(written.contains(words), "no {words:?} in {written}");
    }
    let again = congruent(&arguments);
    assert_eq!(again.code, 2);
    assert!(again.stderr.contains("exists") && again.stderr.contains("--force"), "{}", again.stderr);
    assert_eq!(congruent(&[&arguments[..], &["--force"]].concat()).code, 0);
}

/// The table will be replaced by one of a data sheet: a declared tolerance would then count its rounding as a difference.
#[test]
fn the_digits_decide_about_a_table_that_replaces_the_derived_one() {
    let folder = tempfile::tempdir().unwrap();
    let out = text(folder.path());
    let made = congruent(&["new", "robot", "robots/ur5e/ur5e.urdf", "--out", &out]);
    assert_eq!(made.code, 0, "{}", made.stderr);
    let file = folder.path().join("robot.toml");
    let written = fs::read_to_string(&file).unwrap();
    assert!(!written.lines().any(|line| line.starts_with("tolerance")), "{written}");
    let rounded = written.replace("a_m = 0.3922", "a_m = 0.392");
    assert_ne!(rounded, written);
    fs::write(&file, &rounded).unwrap();
    let answer = congruent(&["check", &text(&file)]);
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    assert!(answer.stdout.contains("within the digits written"), "{}", answer.stdout);
    // A tolerance that is finer than the digits is named with its line.
    fs::write(&file, format!("tolerance = {{ position_m = 1e-9 }}\n{rounded}")).unwrap();
    let answer = congruent(&["check", &text(&file)]);
    assert_eq!(answer.code, 1, "{}", answer.stdout);
    let advice = "without it (robot.toml:1) the digits decide";
    assert!(answer.stdout.contains(advice), "{}", answer.stdout);
}

const FIXED: &str = "<robot name='stand'><link name='base'/><link name='top'/>\
    <joint name='j' type='fixed'><parent link='base'/><child link='top'/></joint></robot>";

#[test]
fn a_chain_without_a_table_gets_a_file_that_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let urdf = write(folder.path(), "stand.urdf", FIXED);
    let made = congruent(&["new", "robot", &urdf, "--out", &text(folder.path())]);
    let written = fs::read_to_string(folder.path().join("robot.toml")).unwrap();
    assert!(written.contains("# No [dh] table:") && !written.contains("\n[dh]"), "{written}");
    assert!(made.stdout.contains("without a table"), "{}{}", made.stdout, made.stderr);
    // The exit code is that of `check`.
    assert_eq!(made.code, congruent(&["check", &text(folder.path())]).code);
}

#[test]
fn what_is_no_urdf_is_refused_and_nothing_stays_behind() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("a/b");
    let broken = write(folder.path(), "broken.urdf", "<robot name='r'><link name='a'/>");
    for robot in ["robots/ur5e", "robots/ur5e/robot.toml", "-", &broken, "nowhere.urdf"] {
        let answer = congruent(&["new", "robot", robot, "--out", &text(&out)]);
        assert_eq!(answer.code, 2, "{robot}: {}", answer.stdout);
        assert!(!folder.path().join("a").exists(), "{robot}");
        let file = text(&folder.path().join("s.toml"));
        if robot.starts_with("robots") {
            continue;
        }
        assert_eq!(congruent(&["new", "scenario", robot, "--to", &file]).code, 2, "{robot}");
        assert!(!Path::new(&file).exists(), "{robot}");
    }
    let file = write(folder.path(), "file", "");
    let answer = congruent(&["new", "robot", "robots/ur5e/ur5e.urdf", "--out", &file]);
    assert_eq!(answer.code, 2);
    assert!(answer.stderr.contains("is not a folder"), "{}", answer.stderr);
}

/// A robot.toml is no top of a project: beside the URDF it hides no mesh in a folder above.
#[test]
fn behind_a_fence_a_robot_file_beside_the_urdf_hides_no_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("pkg/urdf");
    fs::create_dir_all(&inner).unwrap();
    fs::create_dir(folder.path().join("pkg/meshes")).unwrap();
    write(
        &folder.path().join("pkg/meshes"),
        "part.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n",
    );
    let urdf = write(
        &inner,
        "r.urdf",
        "<robot name='r'><link name='a'/><link name='b'><collision><geometry>\
         <mesh filename='../meshes/part.obj'/></geometry></collision></link>\
         <joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint></robot>",
    );
    let beside = congruent(&["new", "robot", &urdf, "--out", &text(&inner), "--fence"]);
    assert!(beside.code == 0 || beside.code == 4, "{}", beside.stderr);
    let described = congruent_json(&["describe", &text(&inner), "--fence"]).json();
    assert_eq!(described["uses"][1]["is_ready"], true, "{described}");
    let above = congruent(&["new", "robot", &urdf, "--out", &text(&folder.path().join("pkg"))]);
    assert!(above.code == 0 || above.code == 4, "{}", above.stderr);
    let described = congruent_json(&["describe", &text(&folder.path().join("pkg"))]).json();
    assert_eq!(described["uses"][1]["is_ready"], true, "{described}");
}

/// Checks that a scenario for this robot passes, or that the refusal says why; returns whether it passes.
fn new_scenario(folder: &Path, robot: &str, name: &str) -> bool {
    let file = text(&folder.join(format!("{name}.toml")));
    let made = congruent_json(&["new", "scenario", robot, "--to", &file]);
    if made.code != 0 {
        assert_eq!(made.code, 2, "{robot}: {}{}", made.stdout, made.stderr);
        assert!(!Path::new(&file).exists());
        assert!(!made.json()["findings"].as_array().unwrap().is_empty());
        return false;
    }
    let out = text(&folder.join("out"));
    let ran = congruent_json(&["run", &file, "--no-recording", "--out", &out]);
    assert_eq!(ran.code, 0, "{robot}: {}", ran.stdout);
    let checks = ran.json()["checks"].clone();
    let passed: Vec<&Value> = checks.as_array().unwrap().iter().map(|check| &check["check"]).collect();
    for kind in ["agreement", "limits", "tracking"] {
        assert!(passed.contains(&&Value::from(kind)), "{robot}: no {kind} in {passed:?}");
    }
    assert!(checks.as_array().unwrap().iter().all(|check| check["status"] == "pass"), "{robot}: {checks}");
    // Something moves: the report has the motions there and back.
    assert_eq!(ran.json()["motions"].as_array().unwrap().len(), 2);
    true
}

#[test]
fn a_new_scenario_passes() {
    let folder = tempfile::tempdir().unwrap();
    for robot in ["ur5e", "panda", "rrr_arm", "planar_2r", "spatial_3r", "spherical_wrist", "cylindrical_rpp"]
    {
        assert!(new_scenario(folder.path(), &format!("robots/{robot}"), robot), "{robot}");
    }
    let Some(corpus) = corpus() else { return };
    for entry in fs::read_dir(corpus.join("robots")).unwrap() {
        let urdf = entry.unwrap().path().join("robot.urdf");
        if urdf.is_file() {
            assert!(new_scenario(folder.path(), &text(&urdf), "of_corpus"), "{}", urdf.display());
            fs::remove_file(folder.path().join("of_corpus.toml")).unwrap();
        }
    }
}

#[test]
fn a_robot_that_cannot_pass_gets_no_scenario() {
    let folder = tempfile::tempdir().unwrap();
    let file = text(&folder.path().join("s.toml"));
    let refused = |robot: &str, words: &str| {
        let answer = congruent(&["new", "scenario", robot, "--to", &file]);
        assert_eq!(answer.code, 2, "{}", answer.stdout);
        assert!(answer.stderr.contains(words), "no {words:?} in {}", answer.stderr);
        assert!(!Path::new(&file).exists());
    };
    refused("robots/ur5e/wrong_convention.toml", "are not the same robot");
    refused(&write(folder.path(), "stand.urdf", FIXED), "can move: there is nothing to run");
    let no_mass = "<robot name='r'><link name='a'/><link name='b'><inertial><mass value='-1'/>\
                   <inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>\
                   <joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>";
    refused(&write(folder.path(), "negative.urdf", no_mass), "mass");
    let robot = text(&workspace().join("robots/ur5e/robot.toml"));
    let over = congruent(&["new", "scenario", "robots/ur5e", "--to", &robot, "--force"]);
    assert_eq!(over.code, 2);
    assert!(over.stderr.contains("is an input file"), "{}", over.stderr);
}

/// A check that has nothing to check is left out, and the file says so.
#[test]
fn a_joint_without_limits_has_no_check_of_limits() {
    let folder = tempfile::tempdir().unwrap();
    let free = "<robot name='free'><link name='a'/><link name='b'><inertial><mass value='1'/>\
                <inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>\
                <joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>";
    let urdf = write(folder.path(), "free.urdf", free);
    let file = text(&folder.path().join("free.toml"));
    let made = congruent(&["new", "scenario", &urdf, "--to", &file]);
    assert_eq!(made.code, 0, "{}", made.stderr);
    let written = fs::read_to_string(&file).unwrap();
    assert!(!written.contains("kind = \"limits\"") && written.contains("# - no check limits:"), "{written}");
    let ran = congruent_json(&["run", &file, "--no-recording", "--out", &text(&folder.path().join("out"))]);
    assert_eq!(ran.code, 0, "{}", ran.stdout);
}

/// A range of 2e29 m means nothing, and one of 2e308 m has no width.
#[test]
fn ranges_without_end_are_no_trouble() {
    let folder = tempfile::tempdir().unwrap();
    let ball = "<collision><geometry><sphere radius='0.1'/></geometry></collision>\
                <inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
    let wide = format!(
        "<robot name='wide'><link name='a'>{ball}</link><link name='b'>{ball}</link><link name='c'>{ball}</link>\
         <joint name='j' type='prismatic'><parent link='a'/><child link='b'/><origin xyz='0.5 0 0'/>\
         <limit lower='-1e29' upper='1e29' effort='99' velocity='2'/></joint>\
         <joint name='k' type='continuous'><parent link='b'/><child link='c'/><origin xyz='0.5 0 0'/></joint></robot>"
    );
    let urdf = write(folder.path(), "wide.urdf", &wide);
    assert!(new_scenario(folder.path(), &urdf, "wide"));
    let acm = congruent(&["clearance", &urdf, "--write-srdf", "-"]);
    assert_eq!(acm.code, 2, "{}", acm.stdout);
    assert!(acm.stderr.contains("joint \"j\" has a range of"), "{}", acm.stderr);
    assert_eq!(congruent(&["describe", &urdf]).code, 0);
    let endless = write(folder.path(), "endless.urdf", &wide.replace("1e29", "1e308"));
    for command in ["describe", "workspace"] {
        let refused = congruent(&[command, &endless]);
        assert!(refused.code == 2 && refused.stderr.contains("computed up to 1e30"), "{}", refused.stderr);
    }
}

/// Whatever is wrong with a URDF, the new commands say so, or do without.
#[test]
fn malformed_urdfs_are_refused_or_used_without_what_is_wrong() {
    let Some(corpus) = corpus() else { return };
    let folder = tempfile::tempdir().unwrap();
    let index = fs::read_to_string(corpus.join("bad-inputs/index.json")).unwrap();
    let index: Value = serde_json::from_str(&index).unwrap();
    let cases = index["cases"].as_array().unwrap().iter().filter_map(|case| case["file"].as_str());
    let urdfs: Vec<&str> = cases.filter(|file| file.starts_with("urdf/")).collect();
    assert!(urdfs.len() > 40, "{urdfs:?}");
    for (at, file) in urdfs.into_iter().enumerate() {
        let urdf = text(&corpus.join("bad-inputs").join(file));
        let out = folder.path().join(at.to_string());
        let (robot, scenario) = (text(&out), format!("{}.toml", out.display()));
        let commands: [&[&str]; 4] = [
            &["describe", &urdf],
            &["new", "robot", &urdf, "--out", &robot],
            &["new", "scenario", &urdf, "--to", &scenario],
            &["clearance", &urdf, "--samples", "100", "--write-srdf", "-"],
        ];
        let answers = commands.map(congruent);
        for (command, answer) in commands.iter().zip(&answers) {
            assert!([0, 1, 2, 4].contains(&answer.code), "{command:?}: {}", answer.stderr);
            assert!(!answer.stderr.contains("panicked"), "{command:?}: {}", answer.stderr);
        }
        // Without a tree of joints there is nothing to describe, to write or to suggest.
        if answers[0].code == 2 {
            assert!(answers.iter().all(|answer| answer.code == 2), "{file}");
        }
        assert_eq!(answers[1].code != 2, out.exists(), "{file}");
        assert_eq!(answers[2].code == 0, Path::new(&scenario).exists(), "{file}");
    }
}
