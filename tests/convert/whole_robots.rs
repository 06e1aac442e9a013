//! Whole robots as URDF and MJCF: each is the robot that it was written from, to `congruent check` and to MuJoCo.

#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::{corpus, workspace},
    scratch_folder::ScratchFolder,
};

/// Kind: rounding, of poses within a few metres. Worst seen: 2e-15 m, and as much of the entries of rotations.
const POSE: f64 = 1e-12;
/// Relative to the largest entry. Kind: rounding; of a robot without any mass the 1e-12 kg of its links. Worst seen: 4e-15, 1e-11.
const MASS_MATRIX: f64 = 1e-10;
/// Of torques, relative to the largest. Kind: rounding. Worst seen: 2e-16.
const TORQUE: f64 = 1e-13;
/// MJCF files of the corpus beside their partners in URDF.
const PAIRS: [&str; 5] = ["panda", "piper", "so_arm100", "ur5e", "wx250s"];

/// The robots of the workspace, and those of the corpus if there is one.
fn sources() -> Vec<PathBuf> {
    let folders = fs::read_dir(workspace().join("robots")).unwrap().flatten().map(|entry| entry.path());
    let mut sources: Vec<PathBuf> =
        folders.map(|folder| folder.join(folder.file_name().unwrap()).with_extension("urdf")).collect();
    assert!(sources.len() >= 7, "{sources:?}");
    if let Some(corpus) = corpus() {
        let robots = fs::read_dir(corpus.join("robots")).unwrap().flatten();
        sources.extend(robots.map(|entry| entry.path().join("robot.urdf")).filter(|path| path.exists()));
        for pair in PAIRS {
            sources
                .extend(["robot.xml", "partner.urdf"].map(|file| corpus.join("pairs").join(pair).join(file)));
        }
    }
    sources
}

/// Writes a robot to a file in a folder and gives its path.
#[track_caller]
fn written(source: &Path, folder: &Path, ending: &str) -> String {
    let file = text(&folder.join(format!("written.{ending}")));
    let answer = congruent_json(&["convert", &text(source), "--out", &file, "--force"]);
    assert_eq!(answer.code, 0, "{}: {}", source.display(), answer.stderr);
    let report = answer.json();
    let worst = report["proof"]["worst"].as_f64().unwrap();
    assert!(worst <= POSE && report["read_back"].is_object(), "{}: {report:#}", source.display());
    file
}

/// Poses, masses, inertias, losses: `check` finds no difference, whichever format is written.
#[test]
fn what_is_written_is_the_same_robot_to_check() {
    let folder = tempfile::tempdir().unwrap();
    let mut with_dynamics = 0;
    for source in sources() {
        for ending in ["urdf", "xml"] {
            let file = written(&source, folder.path(), ending);
            let answer = congruent_json(&["check", &file, "--against", &text(&source)]);
            let report = answer.json();
            let place = format!("{} as {ending}: {}", source.display(), answer.stderr);
            assert_eq!((answer.code, report["grade"].as_str()), (0, Some("identical")), "{place}");
            let dynamics = &report["dynamics"];
            assert!(dynamics["difference_relative"].as_f64().unwrap() <= TORQUE, "{place}: {dynamics:#}");
            with_dynamics += usize::from(dynamics["verdict"] == "same");
        }
    }
    // One robot of the corpus has no masses.
    assert!(with_dynamics >= 2 * sources().len() - 2, "{with_dynamics}");
}

/// Python with MuJoCo and numpy, as `CONGRUENT_PYTHON` names it or as `python3`; `None`, and a line on stderr, without.
fn python_with_mujoco() -> Option<String> {
    let python = std::env::var("CONGRUENT_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let found = Command::new(&python).args(["-c", "import mujoco, numpy"]).output();
    let has_mujoco = found.is_ok_and(|output| output.status.success());
    if !has_mujoco {
        eprintln!("skipped: {python} has no module mujoco");
    }
    has_mujoco.then_some(python)
}

#[test]
fn mujoco_computes_the_same_poses_and_mass_matrices() {
    let Some(python) = python_with_mujoco() else { return };
    let script = workspace().join("tests/convert/against_mujoco.py");
    let folder = tempfile::tempdir().unwrap();
    for source in sources() {
        let file = written(&source, folder.path(), "xml");
        let output = Command::new(&python).arg(&script).arg(&source).arg(&file).output().unwrap();
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        let place = format!("{}: {printed}{}", source.display(), String::from_utf8_lossy(&output.stderr));
        let worst: Vec<f64> =
            printed.split_whitespace().map(|number| number.parse().expect(&place)).collect();
        let [position_m, rotation, mass_matrix] = worst[..] else { panic!("{place}") };
        assert!(position_m <= POSE && rotation <= POSE && mass_matrix <= MASS_MATRIX, "{place}");
    }
}

/// Colours, meshes with their scale and excluded pairs arrive; a printed robot is the same as the one in a file.
#[test]
fn a_printed_robot_is_read_from_beside_its_source() {
    let source = "robots/panda/panda.urdf";
    let answer = congruent(&["convert", source, "--to", "mjcf"]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    for part in
        ["<mujoco model=\"panda\">", "class=\"collision\"", "<motor name=\"panda_joint1\"", "read back: "]
    {
        assert!(answer.stdout.contains(part), "{part} in {}", answer.stdout);
    }
    let excluded = congruent(&["convert", "robots/panda", "--to", "mjcf"]);
    assert!(excluded.stdout.contains("<exclude body1="), "{}", excluded.stdout);
    assert!(excluded.stderr.contains("its table"), "{}", excluded.stderr);
}

#[test]
fn what_cannot_be_written_is_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = text(&folder.path().join("arm.xml"));
    for (arguments, message) in [
        (["convert", "robots/ur5e", "--from", "dh", "--out", &file], "a table has no masses"),
        (["convert", "robots/ur5e", "--base", "base_link", "--out", &file], "choose nothing"),
        (["convert", "robots/ur5e", "--to", &file, "--out", &file], "two models or two files"),
        (["convert", "robots/ur5e", "--to", "mjcf", "--out", "nowhere/arm.xml"], "nowhere"),
    ] {
        let answer = congruent(&arguments);
        assert_eq!(answer.code, 2, "{arguments:?}: {}", answer.stdout);
        assert!(answer.stderr.contains(message), "{arguments:?}: {}", answer.stderr);
        assert!(fs::read_dir(folder.path()).unwrap().next().is_none(), "{arguments:?}");
    }
}

#[test]
fn a_chosen_chain_is_written_with_what_it_cannot_hold() {
    let scratch = ScratchFolder::new();
    let arm = "<mujoco model=\"arm\"><worldbody><body name=\"base\"><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>\
               <body name=\"upper\" pos=\"0 0 0.3\"><joint name=\"lift\" axis=\"0 1 0\" armature=\"0.1\"/>\
               <inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/><body name=\"tool\" pos=\"0.4 0 0\">\
               <joint name=\"bend\" axis=\"0 1 0\"/><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/></body></body></body>\
               </worldbody></mujoco>";
    let robot = scratch.write("arm.xml", arm);
    let answer = congruent(&["convert", &robot, "--to", "urdf", "--base", "base", "--tip", "tool"]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let said = answer.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("joint \"lift\": its armature, 0.1 kg m^2, is not written"), "{said}");
    assert!(!said.contains("\"bend\""), "{said}");
}

/// A base or a tip still means the chain between them, as a table does.
#[test]
fn a_chosen_chain_is_written_alone() {
    let links = |arguments: &[&str]| congruent(arguments).stdout.matches("<link name=").count();
    let source = "robots/ur5e/ur5e.urdf";
    let whole = links(&["convert", source, "--to", "urdf"]);
    assert!(links(&["convert", source, "--to", "urdf", "--tip", "forearm_link"]) < whole);
    assert!(links(&["convert", "robots/ur5e", "--to", "urdf"]) < whole);
    assert_eq!(links(&["convert", "robots/ur5e", "--from", "urdf", "--to", "urdf"]), whole);
}
