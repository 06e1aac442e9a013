//! `run --resume`: what holds is kept, the rest runs.

use std::{fs, path::Path, time::SystemTime};

use crate::support::{
    command::{congruent, text},
    scenario_files::scenario_files,
    scratch_folder::ScratchFolder,
};

/// Three scenarios of a planar arm, the last of which fails its check.
fn scenarios(scratch: &ScratchFolder) -> [String; 3] {
    let robot = scratch.robot("planar_2r", &[]);
    ["one", "two", "three"].map(|name| {
        let limit = if name == "three" { "path_deg = 1e-9" } else { "path_deg = 5.0" };
        scratch.write(
            &format!("{name}.toml"),
            &format!(
                "schema_version = 1\nname = \"{name}\"\nrobot = {robot:?}\n[simulation]\nduration_s = 0.1\n\
                 [controller]\nkind = \"computed_torque\"\nstiffness = 100.0\ndamping = 20.0\n\
                 [[motion]]\nmove_joints_deg = {{ joint_1 = 1.0 }}\nduration_s = 0.1\n\
                 [[check]]\nkind = \"tracking\"\n{limit}\n"
            ),
        )
    })
}

fn changed(path: &Path) -> SystemTime {
    fs::metadata(path).unwrap().modified().unwrap()
}

/// A folder of results and calls into it.
struct Calls {
    scratch: ScratchFolder,
    scenarios: [String; 3],
}

impl Calls {
    fn new() -> Self {
        let scratch = ScratchFolder::new();
        let scenarios = scenarios(&scratch);
        Self { scratch, scenarios }
    }

    /// Exit code and how many were kept, by the note and by the results on disk; also compares the files over all.
    #[track_caller]
    fn run(&self, more: &[&str]) -> (i32, usize) {
        let out = text(&self.scratch.path().join("out"));
        let junit = text(&self.scratch.path().join("junit.xml"));
        let [one, two, three] = &self.scenarios;
        let arguments = ["run", one, two, three, "--out", &out, "--junit", &junit, "--resume"];
        let reports = ["one", "two", "three"]
            .map(|name| self.scratch.path().join("out").join(name).join("report.json"));
        let before = reports.each_ref().map(|path| path.exists().then(|| changed(path)));
        let answer = congruent(&[&arguments[..], more].concat());
        let kept = (0..3).filter(|&at| before[at].is_some_and(|time| time == changed(&reports[at]))).count();
        assert!(answer.stderr.contains(&format!("{kept} of 3 kept")), "{kept}: {}", answer.stderr);
        assert_eq!(answer.stdout.matches("kept from an earlier call").count(), kept, "{}", answer.stdout);
        let junit = fs::read_to_string(junit).unwrap();
        assert!(
            ["one", "two", "three"].iter().all(|name| junit.contains(&format!("name=\"{name}\""))),
            "{junit}"
        );
        let index = fs::read_to_string(self.scratch.path().join("out/index.html")).unwrap();
        assert!(["one", "two", "three"].iter().all(|name| index.contains(&format!("{name}/report.html"))));
        (answer.code, kept)
    }

    fn result(&self, name: &str) -> std::path::PathBuf {
        self.scratch.path().join("out").join(name)
    }
}

#[test]
fn what_is_finished_and_the_same_is_kept() {
    let calls = Calls::new();
    assert_eq!(calls.run(&[]), (1, 0), "nothing is there yet");
    assert_eq!(calls.run(&[]), (1, 3), "a failed check is a result, too");
    // As if the call had been killed.
    fs::remove_file(calls.result("two").join("report.json")).unwrap();
    assert_eq!(calls.run(&[]), (1, 2));
    fs::remove_file(calls.result("one").join("report.html")).unwrap();
    assert_eq!(calls.run(&[]), (1, 2));
}

#[test]
fn a_file_that_is_not_as_it_was_written_is_made_again() {
    let calls = Calls::new();
    calls.run(&[]);
    for name in ["junit.xml", "scenario.resolved.toml", "report.html", "recording.rrd", "SHA256SUMS"] {
        let file = calls.result("two").join(name);
        let whole = fs::read(&file).unwrap();
        let mut flipped = whole.clone();
        flipped[whole.len() / 2] ^= 1;
        for damaged in [&whole[..whole.len() * 2 / 3], &flipped] {
            fs::write(&file, damaged).unwrap();
            assert_eq!(calls.run(&[]), (1, 2), "{name}");
            assert!(fs::read(&file).unwrap() == whole, "{name}");
        }
    }
}

#[test]
fn inspect_reports_results_that_are_not_as_written() {
    let calls = Calls::new();
    calls.run(&[]);
    let folder = text(&calls.result("one"));
    let inspected = || congruent(&["inspect", &folder]);
    assert_eq!(inspected().code, 0);
    let page = calls.result("one").join("report.html");
    let mut html = fs::read(&page).unwrap();
    let middle = html.len() / 2;
    html[middle] ^= 1;
    fs::write(&page, html).unwrap();
    let answer = inspected();
    assert_eq!(answer.code, 2, "{}", answer.stdout);
    assert!(answer.stdout.contains("report.html has changed since the run wrote it"), "{}", answer.stdout);
    fs::remove_file(page).unwrap();
    assert_eq!(inspected().code, 0, "what was left behind is not damaged");
}

#[test]
fn what_was_made_from_something_else_runs_again() {
    let calls = Calls::new();
    calls.run(&[]);
    let two = fs::read_to_string(&calls.scenarios[1]).unwrap();
    fs::write(&calls.scenarios[1], two.replace("path_deg = 5.0", "path_deg = 4.0")).unwrap();
    assert_eq!(calls.run(&[]), (1, 2), "one scenario has changed");
    assert_eq!(calls.run(&["--seed", "3"]), (1, 0), "all have another seed");
    assert_eq!(calls.run(&["--seed", "3"]), (1, 3));
    assert_eq!(calls.run(&[]), (1, 0));
    let urdf = calls.scratch.path().join("planar_2r/planar_2r.urdf");
    fs::write(&urdf, fs::read_to_string(&urdf).unwrap() + "<!-- edited -->\n").unwrap();
    assert_eq!(calls.run(&[]), (1, 0), "their robot has changed");
    let report = calls.result("one").join("report.json");
    let edited = fs::read_to_string(&report).unwrap().replacen(
        "\"verdict\": \"as_expected\"",
        "\"verdict\": \"broken\"",
        1,
    );
    fs::write(&report, edited).unwrap();
    assert_eq!(calls.run(&[]), (1, 2), "a report that does not follow from its values is none");
}

#[test]
#[cfg(feature = "recording")]
fn a_damaged_recording_is_made_again() {
    let calls = Calls::new();
    calls.run(&[]);
    let recording = calls.result("one").join("recording.rrd");
    let mut bytes = fs::read(&recording).unwrap();
    let whole = bytes.clone();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    fs::write(&recording, bytes).unwrap();
    assert_eq!(calls.run(&[]), (1, 2));
    assert!(fs::read(&recording).unwrap() == whole);
    assert_eq!(calls.run(&["--no-recording"]), (1, 3), "none is asked for");
}

#[test]
fn all_scenarios_of_the_project_are_kept() {
    let out = tempfile::tempdir().unwrap();
    let out = text(out.path());
    let mut arguments: Vec<String> =
        ["run", "--no-recording", "--resume", "--out", &out].map(str::to_owned).to_vec();
    let files = scenario_files("scenarios");
    arguments.extend(files.iter().map(|path| text(path)));
    let first = congruent(&arguments);
    let second = congruent(&arguments);
    assert_eq!(first.code, second.code);
    // The cause of a failed agreement is not read back: these run again.
    let failed = first.stdout.matches("agreement  fail").count();
    let kept = format!("{} of {} kept", files.len() - failed, files.len());
    assert!(second.stderr.contains(&kept) && failed < files.len(), "{kept}: {}", second.stderr);
}

#[test]
fn a_scenario_that_is_refused_keeps_the_results_of_an_earlier_run() {
    let calls = Calls::new();
    calls.run(&[]);
    let report = fs::read(calls.result("two").join("report.json")).unwrap();
    let [_, two, _] = &calls.scenarios;
    let wrong = fs::read_to_string(two).unwrap().replace("kind = \"tracking\"", "kind = \"trakcing\"");
    fs::write(two, wrong).unwrap();
    let answer = congruent(&["run", two, "--out", &text(&calls.scratch.path().join("out"))]);
    assert_eq!(answer.code, 2, "{}", answer.stdout);
    assert_eq!(fs::read(calls.result("two").join("report.json")).unwrap(), report);
    assert!(answer.stderr.contains("two keeps the results of an earlier run"), "{}", answer.stderr);
}
