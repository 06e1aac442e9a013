//! Faults of the machine: a full disk, files that may not grow, folders that cannot be written, closed pipes, signals.
#![cfg(unix)]

use std::{
    fs::{self, File},
    path::Path,
    process::{Command, Output, Stdio},
    time::Duration,
};

use serde_json::Value;

use crate::support::{
    command::{allowing, congruent, text},
    corpus::workspace,
    scratch_folder::{ScratchFolder, file_names},
};

/// A run of a planar arm, with a trajectory.
fn scenario(scratch: &ScratchFolder, duration_s: f64) -> String {
    scenario_with(scratch, duration_s, "[output]\ntrajectory = \"csv\"\n")
}

fn scenario_with(scratch: &ScratchFolder, duration_s: f64, output: &str) -> String {
    let by_deg = (10.0 * duration_s).min(90.0);
    let robot = text(&workspace().join("robots/planar_2r"));
    let contents = format!(
        "schema_version = 1\nname = \"run\"\nrobot = {robot:?}\n[simulation]\nduration_s = {duration_s}\n\
         [controller]\nkind = \"kinematic\"\n{output}[[motion]]\nmove_joints_deg = {{ joint_1 = {by_deg:?} }}\n\
         duration_s = {duration_s}\n[[check]]\nkind = \"agreement\"\n"
    );
    scratch.write("run.toml", &contents)
}

/// The command under a shell that lets no file grow beyond so many blocks of 512 bytes.
fn limited(blocks: u32, arguments: &[&str]) -> Output {
    let command = allowing(arguments);
    let limit = format!("ulimit -f {blocks}; exec \"$0\" \"$@\"");
    let mut shell = Command::new("/bin/sh");
    shell.args(["-c", &limit]).arg(command.get_program()).args(command.get_args()).current_dir(workspace());
    shell.output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn what_was_computed_before_a_file_could_not_grow_is_kept() {
    let scratch = ScratchFolder::new();
    let scenario = scenario(&scratch, 100.0);
    let out = scratch.path().join("out");
    // Enough for the report, and not for recording and trajectory.
    let output = limited(600, &["run", &scenario, "--out", &text(&out)]);
    let said = said(&output);
    assert_eq!(output.status.code(), Some(3), "{said}");
    let folder = out.join("run");
    let report: Value = serde_json::from_slice(&fs::read(folder.join("report.json")).unwrap()).unwrap();
    assert_eq!(report["verdict"], "broken");
    assert!(report["error"].as_str().unwrap().contains("File too large"), "{}", report["error"]);
    assert!(report["simulation"]["steps"].as_u64().unwrap() > 0);
    let names = file_names(&folder);
    for name in ["junit.xml", "report.json", "scenario.resolved.toml", "trajectory.csv.partial"] {
        assert!(names.iter().any(|known| known == name), "no {name}: {names:?}");
    }
    assert!(!names.iter().any(|name| name.contains(".tmp") || name == "trajectory.csv"), "{names:?}");
    let answer = String::from_utf8_lossy(&output.stdout);
    assert!(answer.contains(", without trajectory.csv"), "{answer}");
    let rows = fs::read_to_string(folder.join("trajectory.csv.partial")).unwrap();
    assert!(rows.lines().count() > 100, "{}", rows.lines().count());
    // The next run takes no notice of it.
    let shorter = self::scenario(&scratch, 0.1);
    let again = congruent(&["run", &shorter, "--out", &text(&out)]);
    assert_eq!(again.code, 0, "{}", again.stderr);
    assert!(!self::file_names(&folder).iter().any(|name| name.contains("partial")));
}

#[cfg(feature = "recording")]
#[test]
fn a_recording_that_could_not_be_completed_is_read_as_far_as_it_goes() {
    let scratch = ScratchFolder::new();
    let scenario = scenario_with(&scratch, 100.0, "");
    let out = scratch.path().join("out");
    let output = limited(600, &["run", &scenario, "--out", &text(&out)]);
    assert_eq!(output.status.code(), Some(3), "{}", said(&output));
    let partial = text(&out.join("run/recording.rrd.partial"));
    let inspected = congruent(&["inspect", &partial, "--format", "json"]);
    let summary = inspected.json();
    assert_eq!((inspected.code, &summary["complete"]), (2, &Value::Bool(false)), "{}", inspected.stderr);
    let reason = summary["reason"].as_str().unwrap();
    assert!(reason.contains("cut off") && reason.contains("repeat its run"), "{reason}");
    assert!(summary["duration_s"].as_f64().unwrap() > 5.0, "{}", summary["duration_s"]);
}

/// Shapes and frames of the robot are the beginning of a recording: more than these blocks hold, and more than the report.
#[cfg(feature = "recording")]
#[test]
fn the_report_is_kept_although_the_recording_cannot_be_begun() {
    let scratch = ScratchFolder::new();
    let robot = text(&workspace().join("robots/ur5e"));
    let scenario = format!(
        "schema_version = 1\nname = \"run\"\nrobot = {robot:?}\n[simulation]\nduration_s = 0.1\n\
         [controller]\nkind = \"kinematic\"\n[[check]]\nkind = \"agreement\"\n"
    );
    let scenario = scratch.write("run.toml", &scenario);
    for blocks in [60, 100] {
        let out = scratch.path().join(format!("out{blocks}"));
        let output = limited(blocks, &["run", &scenario, "--out", &text(&out)]);
        assert_eq!(output.status.code(), Some(3), "{}", said(&output));
        let folder = out.join("run");
        let report: Value = serde_json::from_slice(&fs::read(folder.join("report.json")).unwrap()).unwrap();
        assert_eq!(report["verdict"], "broken");
        assert!(report["error"].as_str().unwrap().contains("File too large"), "{}", report["error"]);
    }
}

#[cfg(feature = "recording")]
#[test]
fn a_folder_without_its_recording_is_named_with_what_is_there() {
    let scratch = ScratchFolder::new();
    let scenario = scenario(&scratch, 0.1);
    let out = scratch.path().join("out");
    assert_eq!(congruent(&["run", &scenario, "--out", &text(&out)]).code, 0);
    let folder = text(&out.join("run"));
    for name in ["recording.rrd", "junit.xml"] {
        fs::remove_file(out.join("run").join(name)).unwrap();
    }
    let answer = congruent(&["inspect", &folder]);
    let said = answer.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(answer.code, 2, "{said}");
    for expected in
        ["recording.rrd is gone", "gone: junit.xml, recording.rrd", "as the run wrote them: report.json"]
    {
        assert!(said.replace("│ ", "").contains(expected), "{expected}: {said}");
    }
}

#[test]
fn results_that_cannot_be_written_at_all_are_reported() {
    let scratch = ScratchFolder::new();
    let scenario = scenario(&scratch, 1.0);
    for blocks in [0, 1, 4] {
        let out = scratch.path().join(format!("out{blocks}"));
        let output = limited(blocks, &["run", &scenario, "--out", &text(&out)]);
        let said = said(&output);
        assert!(matches!(output.status.code(), Some(2 | 3)), "{blocks}: {:?} {said}", output.status);
        assert!(said.contains("cannot write") || said.contains("File too large"), "{blocks}: {said}");
        let left = if out.join("run").is_dir() { file_names(&out.join("run")) } else { Vec::new() };
        assert!(
            !left.iter().any(|name| name.contains(".tmp") || name == "report.json"),
            "{blocks}: {left:?}"
        );
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_reported_before_the_run() {
    let scratch = ScratchFolder::new();
    let scenario = scenario(&scratch, 1e5);
    // Also for root, who may write to any folder of a disk.
    for out in ["/proc/results", "/dev/null/results"] {
        let answer = congruent(&["run", &scenario, "--out", out]);
        assert_eq!(answer.code, 2, "{out}: {}", answer.stderr);
        assert!(answer.stderr.contains(out) && answer.stderr.contains("--out"), "{}", answer.stderr);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_reported() {
    let scratch = ScratchFolder::new();
    let scenario = scenario(&scratch, 0.01);
    let full = || File::options().write(true).open("/dev/full").unwrap();
    for arguments in
        [&["describe", "robots/planar_2r"][..], &["check", "robots/planar_2r", "--format", "json"]]
    {
        let output = allowing(arguments).stdout(full()).stderr(Stdio::piped()).output().unwrap();
        assert_eq!(output.status.code(), Some(3), "{arguments:?}: {}", said(&output));
        assert!(said(&output).contains("No space left"), "{}", said(&output));
    }
    let out = text(&scratch.path().join("out"));
    let output = allowing(&["run", &scenario, "--out", &out]).stdout(full()).output().unwrap();
    assert_eq!(output.status.code(), Some(3), "{}", said(&output));
    assert!(Path::new(&out).join("run/report.json").exists(), "what is on disk is whole");
}

#[test]
fn every_command_ends_quietly_if_no_one_reads_it() {
    let scratch = ScratchFolder::new();
    let scenario = scenario(&scratch, 0.01);
    let out = text(&scratch.path().join("out"));
    assert_eq!(congruent(&["run", &scenario, "--out", &out]).code, 0);
    let run = text(&scratch.path().join("out/run"));
    let other = text(&scratch.path().join("other"));
    let robot = "robots/planar_2r";
    let commands: &[&[&str]] = &[
        &["describe", robot],
        &["check", robot],
        &["fk", robot],
        &["jacobian", robot],
        &["dynamics", robot],
        &["manipulability", robot],
        &["workspace", robot],
        &["sensitivity", robot],
        &["tolerances", robot, "--a=1mm"],
        &["clearance", robot],
        &["clearance", robot, "--write-srdf", "-"],
        &["convert", robot, "--from", "urdf", "--to", "standard"],
        &["compare", &run, &run],
        &["run", &scenario, "--out", &other],
        &["run", "--faults", &scenario],
        &["schema"],
        &["completions", "bash"],
        &["man"],
        &["--help"],
        #[cfg(feature = "recording")]
        &["inspect", &run],
    ];
    for command in commands {
        let usual = allowing(command).output().unwrap();
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let closed = allowing(command).stdout(writer).stderr(Stdio::piped()).output().unwrap();
        assert_eq!(closed.status.code(), usual.status.code(), "{command:?}: {}", said(&closed));
        assert_eq!(
            said(&closed).contains("error"),
            said(&usual).contains("error"),
            "{command:?}: {}",
            said(&closed)
        );
        assert!(!said(&closed).contains("panicked") && !said(&closed).contains("pipe"), "{}", said(&closed));
    }
}

#[test]
fn a_signal_ends_any_command_without_its_unfinished_files() {
    let scratch = ScratchFolder::new();
    let junit = text(&scratch.path().join("junit.xml"));
    let commands: &[&[&str]] = &[
        &["check", "robots/ur5e", "robots/panda", "robots/ur5e", "robots/panda", "--junit", &junit],
        &["workspace", "robots/ur5e", "robots/panda", "robots/ur5e"],
        &["sensitivity", "robots/ur5e"],
        // What it reads does not come.
        &["fk", "robots/ur5e", "--configurations", "-"],
    ];
    let mut interrupted = 0;
    for (at, command) in (0_u32..).zip(commands) {
        for moment in 0..6_u32 {
            let pipes = |command: &mut Command| {
                command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
            };
            let mut child = pipes(&mut allowing(command));
            // Not before the program watches signals.
            let later = (f64::from(moment + 7 * at) * 0.618_034).fract() * 0.2;
            std::thread::sleep(Duration::from_secs_f64(0.05 + later));
            let name = if moment % 2 == 0 { "-TERM" } else { "-INT" };
            let _ = Command::new("kill").args([name, &child.id().to_string()]).stderr(Stdio::null()).status();
            let stdin = child.stdin.take();
            let output = child.wait_with_output().unwrap();
            drop(stdin);
            let said = said(&output);
            assert!(!said.contains("panicked"), "{command:?}: {said}");
            if output.status.code() == Some(3) {
                assert!(said.contains("interrupted"), "{command:?}: {said}");
                interrupted += 1;
            } else {
                assert!(
                    matches!(output.status.code(), Some(0..=2)),
                    "{command:?}: {:?} {said}",
                    output.status
                );
            }
            let left = file_names(scratch.path());
            assert!(left.iter().all(|name| name == "junit.xml"), "{command:?}: {left:?}");
        }
    }
    assert!(interrupted >= 6, "{interrupted}");
}
