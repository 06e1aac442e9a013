//! Runs that end early by a signal: what was computed is kept, and the next run is clean.
#![cfg(unix)]

use std::{
    fs,
    path::Path,
    process::{Child, Command, Stdio},
    time::Duration,
};

use serde_json::Value;

use crate::support::{
    command::{allowing, congruent, text},
    corpus::workspace,
    scratch_folder::{ScratchFolder, file_names},
};

/// A run of this length of the planar arm under forces, with a trajectory.
fn scenario(scratch: &ScratchFolder, name: &str, duration_s: f64) -> String {
    let robot = text(&workspace().join("robots/planar_2r"));
    let text = format!(
        "schema_version = 1\nname = \"{name}\"\nrobot = {robot:?}\n[simulation]\nduration_s = {duration_s}\n\
         [controller]\nkind = \"kinematic\"\n[output]\ntrajectory = \"csv\"\n\
         [[motion]]\nmove_joints_deg = {{ joint_1 = 0.5 }}\nduration_s = 1.0\n[[check]]\nkind = \"agreement\"\n"
    );
    scratch.write(&format!("{name}.toml"), &text)
}

struct Call {
    child: Child,
}

impl Call {
    fn start(arguments: &[&str]) -> Self {
        let child = allowing(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        Self { child }
    }

    fn signal(&self, name: &str) {
        let sent = Command::new("kill").args([format!("-{name}"), self.child.id().to_string()]).status();
        assert!(sent.unwrap().success());
    }

    /// Exit code, standard output and error.
    fn end(self) -> (Option<i32>, String, String) {
        let output = self.child.wait_with_output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    }
}

/// Waits until the file exists and is not empty.
fn wait_for(path: &Path) {
    for _ in 0..5000 {
        if fs::metadata(path).is_ok_and(|metadata| metadata.len() > 0) {
            return;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    panic!("no {}", path.display());
}

fn report(folder: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.join("report.json")).unwrap()).unwrap()
}

#[test]
fn a_signal_ends_a_run_in_order() {
    for signal in ["TERM", "INT"] {
        let scratch = ScratchFolder::new();
        let (short, long) = (scenario(&scratch, "short", 0.01), scenario(&scratch, "long", 1e5));
        let waiting = scenario(&scratch, "waiting", 1e5);
        let (out, junit) = (scratch.path().join("out"), scratch.path().join("junit.xml"));
        let files = ["--out", &text(&out), "--junit", &text(&junit)];
        let call = Call::start(&[&["run", &short, &long, &waiting, "--jobs", "1"][..], &files].concat());
        wait_for(&out.join("long/trajectory.csv.partial"));
        call.signal(signal);
        let (code, stdout, stderr) = call.end();
        assert_eq!(code, Some(3), "{stdout}{stderr}");
        assert!(stderr.contains("short.toml: passed") && stderr.contains("long.toml: BROKEN"), "{stderr}");
        let report = report(&out.join("long"));
        assert_eq!((&report["error"], &report["verdict"]), (&"interrupted".into(), &"broken".into()));
        assert!(report["simulation"]["steps"].as_u64().unwrap() > 0);
        let all = [
            "SHA256SUMS",
            "junit.xml",
            "recording.rrd",
            "report.html",
            "report.json",
            "scenario.resolved.toml",
            "trajectory.csv",
        ];
        assert_eq!(file_names(&out.join("long")), all);
        assert_eq!(file_names(&out.join("waiting")), Vec::<String>::new(), "it did not start");
        let recording = text(&out.join("long/recording.rrd"));
        let inspected = congruent(&["inspect", &recording]);
        assert!(
            !inspected.stdout.is_empty() && !inspected.stderr.contains("damaged"),
            "{}",
            inspected.stderr
        );
        let junit = fs::read_to_string(junit).unwrap();
        assert!(junit.contains("interrupted before it started"), "{junit}");
        assert!(
            junit.contains("tests=\"2\" disabled=\"0\" errors=\"0\"") || junit.contains("name=\"short\""),
            "{junit}"
        );
    }
}

#[test]
fn every_check_of_a_call_that_is_killed_is_an_error_and_the_next_is_clean() {
    let scratch = ScratchFolder::new();
    let (short, long) = (scenario(&scratch, "short", 0.01), scenario(&scratch, "long", 5e2));
    let (out, junit) = (scratch.path().join("out"), scratch.path().join("junit.xml"));
    let (out_text, junit_text) = (text(&out), text(&junit));
    // Moments that no one has chosen: multiples of the golden ratio, from the start of the call on.
    for moment in 0..50_u32 {
        let _ = fs::remove_file(&junit);
        let call = Call::start(&["run", &long, "--out", &out_text, "--junit", &junit_text]);
        std::thread::sleep(Duration::from_secs_f64((f64::from(moment) * 0.618_034).fract() * 0.4));
        call.signal("KILL");
        let (code, _, stderr) = call.end();
        assert!(!stderr.contains("panicked"), "{stderr}");
        if code.is_some() || !junit.exists() {
            continue; // it had ended, or had not begun
        }
        let written = fs::read_to_string(&junit).unwrap();
        let document = roxmltree::Document::parse(&written).unwrap();
        let root = document.root_element();
        assert_eq!(root.attribute("tests"), root.attribute("errors"), "{written}");
        let finished = out.join("long/report.json");
        assert!(
            !finished.exists()
                || serde_json::from_str::<Value>(&fs::read_to_string(finished).unwrap()).is_ok()
        );
    }
    let answer = congruent(&["run", &short, "--out", &out_text, "--no-recording"]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let again = scratch.write(
        "long.toml",
        &fs::read_to_string(&long).unwrap().replace("duration_s = 500", "duration_s = 2"),
    );
    let answer = congruent(&["run", &again, "--out", &out_text]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let left = file_names(&out.join("long"));
    assert!(left.iter().all(|name| !name.contains("partial") && !name.contains("tmp")), "{left:?}");
    assert_eq!(report(&out.join("long"))["verdict"], "as_expected");
}

#[test]
fn what_cannot_start_is_an_error_of_the_junit_file() {
    let scratch = ScratchFolder::new();
    let short = scenario(&scratch, "short", 0.01);
    let refused = scratch.write("refused.toml", "schema_version = 1\n");
    let a_file = scratch.write("a_file", "");
    let junit = scratch.path().join("junit.xml");
    let errors = |arguments: &[&str]| {
        let _ = fs::remove_file(&junit);
        let answer = congruent(&[arguments, &["--junit", &text(&junit), "--no-recording"]].concat());
        let written = fs::read_to_string(&junit).unwrap();
        let document = roxmltree::Document::parse(&written).unwrap();
        let count = |name| document.root_element().attribute(name).unwrap().parse::<usize>().unwrap();
        (
            answer.code,
            count("errors"),
            document.descendants().filter(|node| node.has_tag_name("testsuite")).count(),
        )
    };
    let out = text(&scratch.path().join("out"));
    assert_eq!(errors(&["run", &short, &refused, "--out", &out]), (2, 1, 2));
    assert_eq!(errors(&["run", &short, &refused, "--out", &a_file]), (2, 2, 2));
    assert_eq!(errors(&["run", &short, "nowhere.toml", "--out", &out]), (2, 1, 2));
    assert_eq!(errors(&["run", &short, "--out", &out, "--allow", "/nowhere/at/all"]).0, 2);
}

/// The limit of a shell on the size of files, as a full disk.
#[test]
fn a_file_size_limit_is_an_error_and_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html");
    let limited = Command::new("sh")
        .args(["-c", "ulimit -f 10; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_congruent")])
        .args(["check", "robots/ur5e", "--html", page.to_str().unwrap()])
        .current_dir(workspace())
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&limited.stderr);
    assert_eq!(limited.status.code(), Some(3), "{errors}");
    assert!(errors.contains("page.html"), "{errors}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
