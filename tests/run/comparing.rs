//! `compare`: the first difference between two runs, and the same run whatever the number of jobs.

use std::{fs, path::Path};

use serde_json::Value;

use crate::support::{
    command::{Answer, congruent, congruent_json, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

/// Runs two scenarios into a folder; the first has a trajectory.
#[track_caller]
fn run(scratch: &ScratchFolder, out: &str, more: &[&str]) -> String {
    let out = text(&scratch.path().join(out));
    let files =
        ["scenarios/ur5e_pick.toml", "scenarios/panda_reach.toml"].map(|file| text(&workspace().join(file)));
    let short = ["--set", "simulation.duration_s=0.5", "--set", "output.trajectory=csv"];
    let arguments: Vec<&str> = ["run", &files[0], &files[1], "--out", &out]
        .into_iter()
        .chain(short)
        .chain(more.iter().copied())
        .collect();
    let answer = congruent(&arguments);
    assert!(answer.code < 2, "{}{}", answer.stdout, answer.stderr);
    out
}

fn compare(a: &str, b: &str, more: &[&str]) -> Answer {
    let arguments: Vec<&str> = ["compare", a, b].into_iter().chain(more.iter().copied()).collect();
    congruent_json(&arguments)
}

/// The comparison of the files of this kind.
#[track_caller]
fn file<'a>(comparison: &'a Value, kind: &str) -> &'a Value {
    let files = comparison["files"].as_array().unwrap();
    files.iter().find(|file| file["kind"] == kind).unwrap_or_else(|| panic!("no {kind} in {comparison:#}"))
}

/// With joints that have no start, which the resolved scenario names; the lines of its checks are others.
#[test]
fn a_resolved_scenario_gives_what_its_scenario_gave() {
    let scratch = ScratchFolder::new();
    let out = run(&scratch, "first", &[]);
    for scenario in ["ur5e_pick", "panda_reach"] {
        let resolved = format!("{out}/{scenario}/scenario.resolved.toml");
        let again = text(&scratch.path().join("again"));
        let answer = congruent(&["run", &resolved, "--out", &again]);
        assert!(answer.code < 2, "{}{}", answer.stdout, answer.stderr);
        let answer = compare(&format!("{out}/{scenario}"), &format!("{again}/{scenario}"), &[]);
        assert_eq!((answer.code, &answer.json()["same"]), (0, &Value::Bool(true)), "{:#}", answer.json());
    }
}

#[test]
fn the_number_of_jobs_changes_nothing() {
    let scratch = ScratchFolder::new();
    let [one, two] = [("1", "one"), ("2", "two")].map(|(jobs, out)| run(&scratch, out, &["--jobs", jobs]));
    for scenario in ["ur5e_pick", "panda_reach"] {
        let [a, b] = [&one, &two].map(|out| format!("{out}/{scenario}"));
        let answer = compare(&a, &b, &[]);
        let comparison = answer.json();
        assert_eq!((answer.code, &comparison["same"]), (0, &Value::Bool(true)), "{comparison:#}");
        for (kind, least) in [("report", 50), ("trajectory", 50), ("recording", 60)] {
            let compared = file(&comparison, kind)["compared"].as_u64().unwrap();
            assert!(compared >= least, "{compared} series of the {kind}");
        }
        for name in ["report.json", "trajectory.csv", "recording.rrd"] {
            let [a, b] = [&a, &b].map(|folder| fs::read(Path::new(folder).join(name)).unwrap());
            assert!(a == b, "{name} of {scenario} has other bytes");
        }
    }
}

#[test]
fn the_first_difference_has_a_time_a_joint_and_values() {
    let scratch = ScratchFolder::new();
    let (a, b) = (run(&scratch, "a", &[]), run(&scratch, "b", &["--set", "controller.stiffness=1990"]));
    let [a, b] = [a, b].map(|out| format!("{out}/ur5e_pick"));
    let answer = compare(&a, &b, &[]);
    assert_eq!(answer.code, 1, "{}", answer.stdout);
    let comparison = answer.json();
    let trajectory = file(&comparison, "trajectory");
    let first = &trajectory["first"];
    // At the first step both arms stand where they start, and the torques differ in the second row or soon after.
    let (time_s, joint) = (first["time_s"].as_f64().unwrap(), first["joint"].as_str().unwrap());
    assert!((0.001..0.05).contains(&time_s) && joint.ends_with("_joint"), "{first:#}");
    assert!(first["series"].as_str().unwrap().starts_with(joint), "{first:#}");
    let difference = first["b"].as_f64().unwrap() - first["a"].as_f64().unwrap();
    assert_eq!(first["difference"].as_f64(), Some(difference));
    // What is commanded is the same, what is reached is not.
    let series: Vec<&str> = trajectory["series"]
        .as_array()
        .unwrap()
        .iter()
        .map(|series| series["series"].as_str().unwrap())
        .collect();
    assert!(
        series.contains(&"elbow_joint.q_rad") && !series.contains(&"elbow_joint.reference_q_rad"),
        "{series:?}"
    );
    let recording = file(&comparison, "recording");
    assert!(
        recording["first"]["series"].as_str().unwrap().starts_with("/joint/"),
        "{:#}",
        recording["first"]
    );
    assert!(recording["first"]["joint"].is_string());
    let report = file(&comparison, "report");
    assert!(report["statements"][0].as_str().unwrap().contains("hashes"), "{report:#}");
    // For people the same, and each kind of file by itself.
    let shown = congruent(&["compare", &a, &b]).stdout;
    assert!(shown.contains(&format!("at {time_s:?} s: {}", first["series"].as_str().unwrap())), "{shown}");
    let recordings = [&a, &b].map(|out| format!("{out}/recording.rrd"));
    let shown = congruent(&["compare", &recordings[0], &recordings[1]]).stdout;
    assert!(shown.contains("position of elbow_joint"), "{shown}");
    assert!(shown.contains("deg apart") || shown.contains("rad apart"), "{shown}");
    for name in ["report.json", "trajectory.csv", "recording.rrd"] {
        assert_eq!(compare(&format!("{a}/{name}"), &format!("{b}/{name}"), &[]).code, 1, "{name}");
    }
    // A stiffness that is 0.5 % less moves no joint by a degree.
    let within = |tolerance| {
        compare(&format!("{a}/trajectory.csv"), &format!("{b}/trajectory.csv"), &["--tolerance", tolerance])
    };
    assert_eq!((within("5").code, within("1e-9").code), (0, 1));
    let text = fs::read_to_string(workspace().join("schemas/compare.json")).unwrap();
    let schema = jsonschema::draft202012::new(&serde_json::from_str(&text).unwrap()).unwrap();
    assert!(schema.is_valid(&comparison), "{:?}", schema.iter_errors(&comparison).next());
}

/// Compares a small table with another.
#[track_caller]
fn tables(a: &str, b: &str) -> (i32, Value) {
    let scratch = ScratchFolder::new();
    let answer = compare(&scratch.write("a.csv", a), &scratch.write("b.csv", b), &[]);
    (answer.code, answer.json())
}

const TABLE: &str = "time_s,step,elbow.q_rad,wrist.q_rad\n0.0,0,1.0,2.0\n0.1,1,1.5,NaN\n0.2,2,1.25,\n";

#[test]
fn nan_and_empty_cells_are_values() {
    assert_eq!(tables(TABLE, TABLE).0, 0);
    let (code, comparison) = tables(TABLE, &TABLE.replace("NaN", "7.5"));
    let first = &file(&comparison, "trajectory")["first"];
    assert_eq!((code, &first["joint"], &first["time_s"]), (1, &"wrist".into(), &0.1.into()));
    assert_eq!((&first["a"], &first["b"], &first["difference"]), (&"NaN".into(), &7.5.into(), &Value::Null));
    let (code, comparison) = tables(TABLE, &TABLE.replace("1.25,\n", "1.25,0.0\n"));
    let first = &file(&comparison, "trajectory")["first"];
    assert_eq!((code, &first["a"], &first["b"]), (1, &Value::Null, &0.0.into()));
}

#[test]
fn lengths_columns_and_robots_that_differ_are_said() {
    let said = |b: &str| {
        let (code, comparison) = tables(TABLE, b);
        let trajectory = file(&comparison, "trajectory").clone();
        assert_eq!((code, &trajectory["same"]), (1, &Value::Bool(false)), "{trajectory:#}");
        trajectory
    };
    let shorter = said(&TABLE.replace("0.2,2,1.25,\n", ""));
    assert_eq!(shorter["statements"][0], "A has 3 rows, B 2; 2 are at the same times");
    assert_eq!(shorter["statements"][1], "only A has a row at 0.2 s");
    let without = said("time_s,step,elbow.q_rad\n0.0,0,1.0\n0.1,1,1.5\n0.2,2,1.25\n");
    assert_eq!(without["only_in_a"], serde_json::json!(["wrist.q_rad"]));
    let other = said(&TABLE.replace("elbow", "joint_1").replace("wrist", "joint_2"));
    assert!(other["statements"][0].as_str().unwrap().starts_with("the robots differ"), "{other:#}");
    // Every second sample of the same motion: what both have is the same.
    let (code, comparison) = tables(TABLE, &TABLE.replace("0.1,1,1.5,NaN\n", ""));
    assert_eq!((code, &file(&comparison, "trajectory")["first"]), (1, &Value::Null));
}

#[test]
fn what_cannot_be_compared_is_bad_input() {
    let scratch = ScratchFolder::new();
    let table = scratch.write("a.csv", TABLE);
    let no_time = scratch.write("no_time.csv", "q\n1.0\n");
    let back = scratch.write("back.csv", "time_s,q\n0.1,1.0\n0.0,1.0\n");
    let ragged = scratch.write("ragged.csv", "time_s,q\n0.1\n");
    let twice = scratch.write("twice.csv", "time_s,q,q\n0.1,1,2\n");
    let report = scratch.write("report.json", "{}");
    let (parquet, rrd) = (scratch.write("a.parquet", "PAR1"), scratch.write("a.rrd", "no recording"));
    let folder = text(scratch.path());
    fs::create_dir(scratch.path().join("empty")).unwrap();
    let empty = format!("{folder}/empty");
    for (a, b, message) in [
        (&table, &report, "of one kind"),
        (&table, &no_time, "no column time_s"),
        (&table, &back, "row 2"),
        (&table, &ragged, "row 1"),
        (&table, &twice, "two columns q"),
        (&table, &parquet, "cannot be read"),
        (&report, &report, "no trajectory_sha256"),
        (&rrd, &rrd, "not a rerun recording"),
        (&table, &folder, "one is a folder"),
        (&empty, &empty, "in common"),
        (&table, &format!("{folder}/none.csv"), "does not exist"),
    ] {
        let answer = congruent(&["compare", a, b]);
        assert_eq!(answer.code, 2, "{a} {b}: {}", answer.stdout);
        let said = answer.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(message), "{a} {b}: {said}");
    }
    for tolerance in ["--tolerance=-1", "--tolerance=NaN"] {
        assert_eq!(congruent(&["compare", &table, &table, tolerance]).code, 2, "{tolerance}");
    }
}
