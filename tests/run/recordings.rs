//! `inspect --check`, `inspect --csv`, `view` and `run --view` as a user calls them. The viewer is a small program of the
//! test that keeps what it was given.

use std::{fs, path::Path};

use crate::support::{
    command::{congruent, congruent_in_path, congruent_json, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

/// A run's recording and its exit code.
fn recorded(folder: &Path, scenario: &str) -> String {
    let answer = congruent(&["run", &format!("scenarios/{scenario}.toml"), "--out", &text(folder)]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    text(&folder.join(scenario.rsplit('/').next().unwrap()).join("recording.rrd"))
}

#[test]
fn the_checks_of_runs_follow_from_their_recordings() {
    let folder = tempfile::tempdir().unwrap();
    for scenario in
        ["ur5e_pick", "ur5e_into_zone", "ur5e_soft_servos", "rrr_arm_servo", "rrr_arm_wave", "panda_reach"]
    {
        let recording = recorded(folder.path(), scenario);
        let file = format!("scenarios/{scenario}.toml");
        let answer = congruent_json(&["inspect", &recording, "--check", &file]);
        let document = answer.json();
        assert_eq!(answer.code, 0, "{scenario}: {}", document["recheck"]["disagreements"]);
        let recheck = &document["recheck"];
        assert_eq!(
            (&recheck["same_verdict"], &recheck["same_limits"]),
            (&true.into(), &true.into()),
            "{scenario}"
        );
        let shown = congruent(&["inspect", &recording, "--check", &file]).stdout;
        assert!(shown.contains("verdict as_expected, as in the run"), "{shown}");
        assert!(shown.contains("recorded samples, up to 0.01 s apart"), "{shown}");
    }
}

#[test]
fn a_recording_is_checked_with_the_values_that_its_run_had() {
    let folder = tempfile::tempdir().unwrap();
    let out = text(folder.path());
    let file = "scenarios/ur5e_pick.toml";
    let ran = congruent(&["run", file, "--set", "check.2.minimum_m=0.05", "--out", &out]);
    assert_eq!(ran.code, 1, "{}", ran.stderr);
    let recording = text(&folder.path().join("ur5e_pick/recording.rrd"));
    let answer = congruent_json(&["inspect", &recording, "--check", file]);
    assert_eq!((answer.code, &answer.json()["recheck"]["same_limits"]), (1, &true.into()));
    assert!(answer.json()["recheck"]["disagreements"].as_array().unwrap().is_empty());
    let other = congruent(&["inspect", &recording, "--check", "scenarios/ur5e_weld.toml"]);
    assert!(other.code == 2 && other.stderr.contains("another scenario"), "{}", other.stderr);
}

/// The shipped scenario with another minimum distance, in a file of its own.
fn pick_with_minimum(folder: &Path, minimum_m: &str) -> String {
    let shipped = fs::read_to_string(workspace().join("scenarios/ur5e_pick.toml")).unwrap();
    let robot = format!("robot = '{}'", workspace().join("robots/ur5e").display());
    let changed = shipped.lines().map(|line| match line.split_once(" = ") {
        Some(("robot", _)) => robot.clone(),
        Some(("minimum_m", _)) => format!("minimum_m = {minimum_m}"),
        _ => line.to_owned(),
    });
    let file = folder.join("other_limit.toml");
    fs::write(&file, changed.collect::<Vec<_>>().join("\n")).unwrap();
    text(&file)
}

#[test]
fn the_first_line_is_the_verdict_of_the_new_check() {
    let folder = tempfile::tempdir().unwrap();
    let recording = recorded(folder.path(), "ur5e_pick");
    let other = pick_with_minimum(folder.path(), "0.05");
    let answer = congruent(&["inspect", &recording, "--check", &other, "--allow", &text(&workspace())]);
    let first = "ur5e_pick: FAIL: clearance; in the run every check passes, as expected; 10 checks, 4 s, ";
    assert!(answer.code == 1 && answer.stdout.starts_with(first), "{}{}", answer.stdout, answer.stderr);
    let same = congruent(&["inspect", &recording, "--check", "scenarios/ur5e_pick.toml"]);
    let first = "ur5e_pick: pass: every check passes, as expected; 10 checks, 4 s, recorded with congruent ";
    assert!(same.code == 0 && same.stdout.starts_with(first), "{}", same.stdout);
}

#[test]
fn run_page_and_inspect_give_a_verdict_in_the_same_words() {
    let folder = tempfile::tempdir().unwrap();
    let out = text(folder.path());
    for (scenario, change, sentence) in [
        ("ur5e_into_table", "seed=1", "expected failure: clearance"),
        ("ur5e_pick", "expect.verdict=fail", "unexpected pass: every check passed"),
    ] {
        let file = format!("scenarios/{scenario}.toml");
        let ran = congruent(&["run", &file, "--set", change, "--out", &out]);
        let verdict = ran.stdout.split(" (ur5e, ").next().unwrap().to_owned();
        assert!(verdict.contains(sentence), "{}{}", ran.stdout, ran.stderr);
        let results = folder.path().join(scenario);
        let inspected = congruent(&["inspect", &text(&results)]).stdout;
        assert!(inspected.starts_with(&format!("{verdict}; ")), "{inspected}");
        let page = fs::read_to_string(results.join("report.html")).unwrap();
        let (first, rest) = sentence.split_at(1);
        assert!(page.contains(&format!("{}{rest}", first.to_uppercase())), "{sentence}");
    }
}

#[test]
fn a_result_that_is_no_longer_there_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let recording = recorded(folder.path(), "ur5e_into_zone");
    let results = text(Path::new(&recording).parent().unwrap());
    let missing = || {
        let answer = congruent_json(&["inspect", &results]);
        assert_eq!(answer.code, 0, "{}", answer.stderr);
        let missing = answer.json()["missing_results"].as_array().cloned().unwrap_or_default();
        let names: Vec<String> = missing.iter().map(|name| name.as_str().unwrap().to_owned()).collect();
        names.join(", ")
    };
    assert_eq!(missing(), "");
    for (removed, named) in
        [("junit.xml", "junit.xml"), ("SHA256SUMS", "SHA256SUMS"), ("report.json", "report.json, SHA256SUMS")]
    {
        fs::remove_file(Path::new(&results).join(removed)).unwrap();
        assert_eq!(missing(), named);
    }
    let shown = congruent(&["inspect", &results]).stdout;
    assert!(shown.contains("missing beside the recording: report.json, SHA256SUMS"), "{shown}");
}

#[test]
fn a_table_of_a_recording_is_of_one_and_replaces_no_input() {
    let folder = tempfile::tempdir().unwrap();
    let recording = recorded(folder.path(), "rrr_arm_wave");
    let table = folder.path().join("series.csv");
    let answer = congruent(&["inspect", &recording, "--csv", &text(&table)]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let mut reader = csv::Reader::from_path(&table).unwrap();
    let column = reader.headers().unwrap().iter().position(|name| name == "/joint/position/joint_1").unwrap();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 601, "6 s, one sample in 10 ms");
    let values = rows.iter().filter_map(|row| row[column].parse::<f64>().ok());
    let largest = values.fold(f64::NEG_INFINITY, f64::max);
    let document = congruent_json(&["inspect", &recording]).json();
    let scalars = document["scalars"].as_array().unwrap();
    let joint = scalars.iter().find(|scalar| scalar["path"] == "/joint/position/joint_1").unwrap();
    assert_eq!(joint["max"].as_f64().unwrap().to_bits(), largest.to_bits());
    let before = fs::read(&recording).unwrap();
    for arguments in [
        &["inspect", &recording, "--csv", &recording][..],
        &["inspect", &recording, &recording, "--csv", "x.csv"],
    ] {
        assert_eq!(congruent(arguments).code, 2, "{arguments:?}");
    }
    assert_eq!(fs::read(&recording).unwrap(), before);
}

#[test]
fn without_a_viewer_the_recording_is_written_and_it_is_said_how_to_get_one() {
    let folder = tempfile::tempdir().unwrap();
    let empty = folder.path().join("empty");
    fs::create_dir(&empty).unwrap();
    let out = text(folder.path());
    let answer = congruent_in_path(&["view", "robots/rrr_arm", "--out", &out], &empty);
    assert_eq!(answer.code, 3, "{}", answer.stdout);
    assert!(answer.stderr.contains("pip install rerun-sdk==0.36"), "{}", answer.stderr);
    let recording = text(&folder.path().join("rrr_arm_joints/recording.rrd"));
    assert!(answer.stdout.contains(&recording) && answer.stderr.contains(&recording), "{}", answer.stderr);
    let summary = congruent_json(&["inspect", &recording]).json();
    assert_eq!((&summary["exit_code"], &summary["complete"]), (&0.into(), &true.into()));
    let live = congruent_in_path(&["run", "scenarios/rrr_arm_wave.toml", "--view", "--out", &out], &empty);
    assert!(live.code == 3 && live.stderr.contains("rerun"), "{}", live.stderr);
}

#[test]
fn each_joint_of_a_robot_moves_over_its_range() {
    let folder = tempfile::tempdir().unwrap();
    for robot in ["robots/panda", "robots/cylindrical_rpp", "robots/rrr_arm"] {
        let answer = congruent_json(&["view", robot, "--no-viewer", "--out", &text(folder.path())]);
        assert_eq!(answer.code, 0, "{}", answer.stderr);
        let sweep = answer.json();
        let summary = congruent_json(&["inspect", sweep["recording"].as_str().unwrap()]).json();
        assert_eq!(sweep["agrees"], true, "{robot}");
        for joint in sweep["joints"].as_array().unwrap() {
            let path = format!("/joint/position/{}", joint["joint"].as_str().unwrap());
            let scalars = summary["scalars"].as_array().unwrap();
            let moved = scalars.iter().find(|scalar| scalar["path"] == path.as_str()).unwrap();
            for (bound, end) in [("min", 0), ("max", 1)] {
                let (reached, range) =
                    (moved[bound].as_f64().unwrap(), joint["range"][end].as_f64().unwrap());
                assert!((reached - range).abs() < 1e-9, "{robot} {path}: {bound} {reached}, range {range}");
            }
        }
    }
}

/// A robot and a scenario in a folder of their own, and the folder of its results.
fn own_run(scratch: &ScratchFolder) -> (String, String) {
    let robot = scratch.robot("planar_2r", &[]);
    let scenario = scratch.write(
        "own.toml",
        &format!(
            "schema_version = 1\nname = \"own\"\nrobot = {robot:?}\n[simulation]\nduration_s = 0.05\n\
             [controller]\nkind = \"kinematic\"\n[[check]]\nkind = \"agreement\"\n"
        ),
    );
    let out = text(&scratch.path().join("out"));
    assert_eq!(congruent(&["run", &scenario, "--out", &out]).code, 0);
    (scenario, text(&scratch.path().join("out/own")))
}

#[test]
fn what_has_changed_since_the_run_is_reported() {
    let scratch = ScratchFolder::new();
    let (scenario, folder) = own_run(&scratch);
    let inspect = || congruent_json(&["inspect", &folder]);
    let inspected = inspect();
    let summary = inspected.json();
    assert_eq!(
        (inspected.code, &summary["changed_inputs"]),
        (0, &serde_json::json!([])),
        "{}",
        inspected.stderr
    );
    let urdf = scratch.path().join("planar_2r/planar_2r.urdf");
    let before = fs::read_to_string(&urdf).unwrap();
    fs::write(&urdf, before.clone() + "<!-- edited -->\n").unwrap();
    let inspected = inspect();
    let summary = inspected.json();
    assert_eq!(inspected.code, 4, "{summary}");
    let changed = summary["changed_inputs"].as_array().unwrap();
    assert!(
        changed.len() == 1
            && changed[0].as_str().unwrap().ends_with("planar_2r.urdf has changed since the run")
    );
    assert!(
        summary["reason"]
            .as_str()
            .unwrap()
            .contains("has changed since the run; in the run every check passes")
    );
    // A scenario is given to compare with: what has changed is reported, and is not the answer.
    assert_eq!(congruent(&["inspect", &folder, "--check", &scenario]).code, 0);
    fs::write(&urdf, "<robot").unwrap();
    let shown = congruent(&["inspect", &folder]);
    assert!(shown.code == 4 && shown.stdout.contains("cannot be loaded as it is now"), "{}", shown.stdout);
    fs::write(&urdf, before).unwrap();
    fs::rename(&scenario, scratch.path().join("elsewhere.toml")).unwrap();
    let inspected = inspect();
    assert_eq!((inspected.code, &inspected.json()["changed_inputs"]), (0, &serde_json::Value::Null));
}

#[test]
fn a_report_of_another_run_beside_a_recording_is_reported() {
    let scratch = ScratchFolder::new();
    let (_, folder) = own_run(&scratch);
    let report = Path::new(&folder).join("report.json");
    let edited = fs::read_to_string(&report).unwrap().replacen("\"exit_code\": 0", "\"exit_code\": 1", 1);
    fs::write(&report, edited).unwrap();
    let answer = congruent(&["inspect", &folder]);
    assert_eq!(answer.code, 2, "{}", answer.stdout);
    assert!(answer.stdout.contains(
        "BAD RECORDING: report.json beside the recording differs from the report inside the recording"
    ));
    fs::remove_file(&report).unwrap();
    assert_eq!(congruent(&["inspect", &folder]).code, 0, "a recording may be alone");
}

#[test]
fn a_flipped_bit_is_noticed_by_the_digests_beside_the_recording() {
    let scratch = ScratchFolder::new();
    let (_, folder) = own_run(&scratch);
    let recording = Path::new(&folder).join("recording.rrd");
    let mut bytes = fs::read(&recording).unwrap();
    // No divisor of the usual lengths, so that all parts of messages are met.
    for at in (0..bytes.len()).step_by(bytes.len() / 23) {
        bytes[at] ^= 1 << (at % 8);
        fs::write(&recording, &bytes).unwrap();
        let answer = congruent(&["inspect", &folder]);
        assert_eq!(answer.code, 2, "byte {at}: {}", answer.stdout);
        bytes[at] ^= 1 << (at % 8);
    }
}

#[test]
fn damage_is_an_answer_in_words() {
    let scratch = ScratchFolder::new();
    let (_, folder) = own_run(&scratch);
    let recording = Path::new(&folder).join("recording.rrd");
    let mut bytes = fs::read(&recording).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle..middle + 40].fill(0);
    fs::write(&recording, bytes).unwrap();
    let answer = congruent(&["inspect", &folder]);
    assert_eq!(answer.code, 2, "{}", answer.stdout);
    for words in ["problem: the file is damaged at byte ", ", after /", "or repeat its run"] {
        assert!(answer.stdout.contains(words), "no {words:?} in {}", answer.stdout);
    }
}

#[cfg(unix)]
mod with_a_viewer {
    use std::os::unix::fs::PermissionsExt;

    use super::*;

    /// A folder with a program `rerun` that keeps its arguments and its standard input.
    fn viewer(folder: &Path, version: &str, status: u8) -> std::path::PathBuf {
        let bin = folder.join("bin");
        fs::create_dir(&bin).unwrap();
        let script = format!(
            "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 'rerun-cli {version} (test)'; exit; fi\n\
             echo \"$@\" > {0}/arguments\nif [ \"$1\" = - ]; then /bin/cat > {0}/input.partial; /bin/mv {0}/input.partial {0}/input; fi\nexit {status}\n",
            folder.display()
        );
        fs::write(bin.join("rerun"), script).unwrap();
        fs::set_permissions(bin.join("rerun"), fs::Permissions::from_mode(0o755)).unwrap();
        bin
    }

    #[test]
    fn a_robot_a_scenario_and_a_recording_are_opened() {
        let folder = tempfile::tempdir().unwrap();
        let bin = viewer(folder.path(), "0.36.3", 0);
        let out = text(folder.path());
        let opened = || fs::read_to_string(folder.path().join("arguments")).unwrap().trim().to_owned();
        let view = |input: &str| congruent_in_path(&["view", input, "--out", &out], &bin);
        assert_eq!(view("robots/rrr_arm/robot.toml").code, 0);
        let recording = text(&folder.path().join("rrr_arm_joints/recording.rrd"));
        assert_eq!(opened(), recording);
        assert_eq!(view("scenarios/ur5e_into_table.toml").code, 0);
        assert!(opened().ends_with("ur5e_into_table/recording.rrd"), "{}", opened());
        assert_eq!(view(&recording).code, 0);
        assert_eq!(opened(), recording);
        let none = view("README.md");
        assert!(
            none.code == 2 && none.stderr.contains("is not a recording, a robot or a scenario"),
            "{}",
            none.stderr
        );
    }

    #[test]
    fn a_viewer_that_is_too_old_or_fails_is_reported() {
        let folder = tempfile::tempdir().unwrap();
        let bin = viewer(folder.path(), "0.22.0", 7);
        let answer = congruent_in_path(&["view", "robots/rrr_arm", "--out", &text(folder.path())], &bin);
        assert_eq!(answer.code, 3);
        assert!(
            answer.stderr.contains("0.22.0 is older") && answer.stderr.contains('7'),
            "{}",
            answer.stderr
        );
    }

    #[test]
    fn a_run_is_shown_while_it_is_written_to_its_last_byte() {
        let folder = tempfile::tempdir().unwrap();
        let bin = viewer(folder.path(), "0.36.3", 0);
        let arguments = ["run", "scenarios/rrr_arm_wave.toml", "--view", "--out", &text(folder.path())];
        let answer = congruent_in_path(&arguments, &bin);
        assert_eq!(answer.code, 0, "{}", answer.stderr);
        let written = fs::read(folder.path().join("rrr_arm_wave/recording.rrd")).unwrap();
        // The viewer ends by itself, a little later.
        let shown = (0..200).find_map(|_| {
            std::thread::sleep(std::time::Duration::from_millis(50));
            fs::read(folder.path().join("input")).ok()
        });
        assert!(shown.unwrap() == written, "the viewer got what is in the file");
        assert_eq!(fs::read_to_string(folder.path().join("arguments")).unwrap(), "-\n");
        let two = ["run", "scenarios/rrr_arm_wave.toml", "scenarios/ur5e_pick.toml", "--view"];
        assert_eq!(congruent_in_path(&two, &bin).code, 2);
    }
}
