//! `congruent sweep`: rows equal single runs, however a plan is cut, killed or merged; what is no part of it is refused.

use std::{fs, path::Path, process::Command};

use serde_json::Value;

use crate::support::{
    command::{Answer, allowing, congruent, text},
    corpus::workspace,
    golden::read_json,
    scratch_folder::ScratchFolder,
};

/// A plan on the payload scenario, beside nothing of it.
fn plan(scratch: &ScratchFolder, name: &str, body: &str) -> String {
    let scenario = text(&workspace().join("scenarios/ur5e_payload.toml"));
    let head = format!("schema_version = 1\nname = \"{name}\"\nscenario = {scenario:?}\n");
    scratch.write(&format!("{name}.sweep.toml"), &(head + body))
}

const SMALL: &str = "cases = 12\nseed = 3\n[[vary]]\nkey = \"fault.wrong_payload.mass_kg\"\nuniform = [0.0, 4.0]\n\
                     [[vary]]\nkey = \"controller.stiffness\"\nlog_uniform = [800.0, 4000.0]\n\
                     [[vary]]\nkey = \"robot.dh.row.elbow_joint.a_m\"\nvalues = [-0.3922, -0.3923]\n";

fn sweep(arguments: &[&str]) -> Answer {
    congruent(&[&["sweep"], arguments].concat())
}

fn rows(folder: &Path) -> Vec<Value> {
    let mut files: Vec<_> =
        fs::read_dir(folder.join("rows")).unwrap().flatten().map(|entry| entry.path()).collect();
    files.sort();
    let texts: Vec<String> = files.iter().map(|file| fs::read_to_string(file).unwrap()).collect();
    let mut rows: Vec<Value> =
        texts.iter().flat_map(|text| text.lines()).map(|line| serde_json::from_str(line).unwrap()).collect();
    rows.sort_by_key(|row| row["case"].as_u64());
    rows
}

fn digest(folder: &Path) -> String {
    let summary = read_json(&folder.join("sweep_summary.json"));
    summary["table_sha256"].as_str().unwrap().to_owned()
}

#[test]
fn a_row_is_what_a_single_run_with_its_values_says() {
    let scratch = ScratchFolder::new();
    let plan = plan(&scratch, "small", SMALL);
    let out = scratch.path().join("out");
    let answer = sweep(&["run", &plan, "--out", &text(&out), "--worst", "1"]);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    let rows = rows(&out);
    assert_eq!(rows.len(), 12);
    let keys = ["fault.wrong_payload.mass_kg", "controller.stiffness", "robot.dh.row.elbow_joint.a_m"];
    for row in rows.iter().step_by(4) {
        let single = scratch.path().join(format!("single_{}", row["case"]));
        let mut arguments =
            vec!["run".to_owned(), "scenarios/ur5e_payload.toml".to_owned(), "--no-recording".to_owned()];
        arguments.extend(["--out".to_owned(), text(&single), "--seed".to_owned(), row["seed"].to_string()]);
        for (key, value) in keys.iter().zip(row["values"].as_array().unwrap()) {
            arguments.extend(["--set".to_owned(), format!("{key}={}", value.as_str().unwrap())]);
        }
        congruent(&arguments);
        let report = read_json(&single.join("ur5e_payload/report.json"));
        assert_eq!(report["trajectory_sha256"], row["trajectory_sha256"], "{row}");
        let passes = report["verdict"] == "as_expected";
        assert_eq!(row["verdict"] == "pass", passes, "{row}");
        let tracking = report["checks"].as_array().unwrap().iter().find(|check| check["check"] == "tracking");
        let worst = &tracking.unwrap()["measures"][0]["worst"]["value"];
        assert_eq!(&row["worst"]["tracking.path_error_of_tcp_m"]["value"], worst, "{row}");
    }
    let page = fs::read_to_string(out.join("index.html")).unwrap();
    let worst = read_json(&out.join("sweep_summary.json"))["worst"][0]["page"].as_str().unwrap().to_owned();
    assert!(page.contains(&worst) && out.join(&worst).is_file(), "{worst}");
    assert_eq!(fs::read_to_string(out.join("cases.csv")).unwrap().lines().count(), 13);
}

#[test]
fn the_table_is_the_same_however_it_was_cut() {
    let scratch = ScratchFolder::new();
    let plan = plan(&scratch, "cut", SMALL);
    let [whole, parts, other] = ["whole", "parts", "other"].map(|name| scratch.path().join(name));
    sweep(&["run", &plan, "--out", &text(&whole), "--worst", "0"]);
    for part in ["1/3", "3/3"] {
        assert_eq!(sweep(&["run", &plan, "--out", &text(&parts), "--shard", part, "--jobs", "1"]).code, 0);
    }
    let missing = sweep(&["status", &text(&parts)]);
    assert_eq!((missing.code, missing.stdout.contains("4..8")), (4, true), "{}", missing.stdout);
    assert_eq!(sweep(&["merge", &text(&parts)]).code, 2, "cases are missing");
    sweep(&["run", &plan, "--out", &text(&other), "--cases", "4..8"]);
    // A line that a kill has cut off is no row, and the case runs again.
    let file = fs::read_dir(other.join("rows")).unwrap().flatten().next().unwrap().path();
    let lines = fs::read_to_string(&file).unwrap();
    fs::write(&file, &lines[..lines.len() - 20]).unwrap();
    assert_eq!(sweep(&["run", &plan, "--out", &text(&other), "--cases", "4..8"]).code, 2, "rows are there");
    sweep(&["run", &plan, "--out", &text(&other), "--cases", "4..8", "--resume"]);
    sweep(&["merge", &text(&parts), &text(&other), "--worst", "0"]);
    assert_eq!(digest(&whole), digest(&parts));
    assert_eq!(
        fs::read(whole.join("cases.parquet")).unwrap(),
        fs::read(parts.join("cases.parquet")).unwrap()
    );
}

#[test]
fn rows_of_something_else_and_rows_that_differ_are_refused() {
    let scratch = ScratchFolder::new();
    let out = text(&scratch.path().join("out"));
    let first = plan(&scratch, "first", SMALL);
    sweep(&["run", &first, "--out", &out, "--cases", "0..2"]);
    let second = plan(&scratch, "second", &SMALL.replace("seed = 3", "seed = 4"));
    let refused = sweep(&["run", &second, "--out", &out, "--cases", "2..4"]);
    assert_eq!((refused.code, refused.stderr.contains("another seed")), (2, true), "{}", refused.stderr);
    let rows = scratch.path().join("out/rows");
    let file = fs::read_dir(&rows).unwrap().flatten().next().unwrap().path();
    let changed =
        fs::read_to_string(&file).unwrap().replacen("\"verdict\":\"pass\"", "\"verdict\":\"fail\"", 1);
    fs::write(rows.join("copied.jsonl"), changed).unwrap();
    let refused = sweep(&["status", &out]);
    assert_eq!(
        (refused.code, refused.stderr.contains("different rows of case")),
        (2, true),
        "{}",
        refused.stderr
    );
}

#[test]
fn a_case_that_cannot_be_run_is_a_row() {
    let scratch = ScratchFolder::new();
    let body =
        "sampling = \"grid\"\n[[vary]]\nkey = \"controller.stiffness\"\nvalues = [2000.0, -1.0, 3000.0]\n";
    let plan = plan(&scratch, "refused", body);
    let out = scratch.path().join("out");
    let answer = sweep(&["run", &plan, "--out", &text(&out), "--worst", "0"]);
    assert_eq!(answer.code, 4, "{}{}", answer.stdout, answer.stderr);
    let verdicts: Vec<String> =
        rows(&out).iter().map(|row| row["verdict"].as_str().unwrap().to_owned()).collect();
    assert_eq!(verdicts, ["pass", "refused", "pass"]);
    assert!(answer.stdout.contains("case 1 has no result"), "{}", answer.stdout);
}

#[test]
fn plans_are_refused_with_what_to_write() {
    let scratch = ScratchFolder::new();
    let out = text(&scratch.path().join("out"));
    let vary = "[[vary]]\nkey = \"controller.stiffness\"\n";
    for (body, message) in [
        ("cases = 3\nvary = []\n".to_owned(), "nothing varies"),
        (format!("cases = 3\n{vary}"), "0 distributions"),
        (format!("cases = 3\n{vary}uniform = [1, 2]\nvalues = [1]\n"), "2 distributions"),
        (format!("cases = 3\n{vary}uniform = [2, 1]\n"), "of which the second is larger"),
        (format!("cases = 3\n{vary}uniform = [0, nan]\n"), "of which the second is larger"),
        (format!("cases = 3\n{vary}log_uniform = [0, 1]\n"), "not above 0"),
        (format!("cases = 3\n{vary}normal = {{ mean = 1, deviation = 0 }}\n"), "deviation above 0"),
        (
            format!("cases = 3\n{vary}normal = {{ mean = 1, deviation = 0.1, min = 9 }}\n"),
            "nothing of the distribution",
        ),
        (format!("{vary}uniform = [1, 2]\n"), "how many cases"),
        (format!("cases = 0\n{vary}uniform = [1, 2]\n"), "cases = 0 is no sweep"),
        (format!("sampling = \"grid\"\n{vary}uniform = [1, 2]\n"), "needs steps"),
        (format!("sampling = \"grid\"\ncases = 5\n{vary}values = [1, 2]\n"), "2 combinations"),
        (format!("cases = 3\n{vary}uniform = [1, 2]\n{vary}uniform = [1, 2]\n"), "there twice"),
        ("cases = 3\n[[vary]]\nkey = \"controller.stifness\"\nuniform = [1, 2]\n".to_owned(), "stiffness"),
        (format!("cases = 3\n{vary}uniform = [1, 2, 3]\n"), "array of 2"),
        ("cases = 3\n[[vary]]\nkey = \"name\"\nvalues = [\"a\"]\n".to_owned(), "cannot vary"),
        ("cases = 3\n[[vary]]\nkey = 3\nvalues = [1]\n".to_owned(), "a list of keys, not 3"),
        ("cases = 3\n[set]\n\"check.1.minimum_m\" = 0.03\n[[vary]]\nkey = \"check.clearance.minimum_m\"\nuniform = [0.01, 0.02]\n".to_owned(), "the same value is set by"),
        ("cases = 3\n[[vary]]\nkey = \"fault.9.mass_kg\"\nuniform = [1, 2]\n".to_owned(), "one entry"),
        (
            "cases = 3\n[[vary]]\nkey = \"robot.link.tool.mass_kg\"\nuniform = [1, 2]\n".to_owned(),
            "no link \"tool\"",
        ),
        (format!("sampling = \"sobl\"\ncases = 3\n{vary}uniform = [1, 2]\n"), "sobol"),
    ] {
        let plan = plan(&scratch, "wrong", &body);
        let refused = sweep(&["run", &plan, "--out", &out]);
        let said = refused.stderr.split_whitespace().collect::<Vec<_>>().join(" ").replace("│ ", "");
        assert_eq!(
            (refused.code, said.contains(message)),
            (2, true),
            "{body}\n{message}\n{}",
            refused.stderr
        );
    }
    assert!(!Path::new(&out).exists(), "nothing is written for a plan that is refused");
}

/// The commands in the files for Slurm, Kubernetes and GitHub Actions run, with other places of plan and folder.
#[test]
fn the_files_for_clusters_run() {
    let scratch = ScratchFolder::new();
    let examples = workspace().join("docs/examples/sweeps");
    for (number, name) in ["sweep.sbatch", "sweep_job.yaml", "sweep_matrix.yaml"].into_iter().enumerate() {
        let written = fs::read_to_string(examples.join(name)).unwrap();
        let words = written.replace("\\\n", " ").replace("exec ", "");
        let at = words.find("congruent sweep run ").unwrap_or_else(|| panic!("{name}"));
        // The command of YAML goes on in lines that are indented alike.
        let end = words[at..]
            .find("\n          resources")
            .or(words[at..].find("\n      - uses"))
            .unwrap_or(words.len() - at);
        let call = words[at..at + end].replace('\n', " ").replace("${{ matrix.shard }}", "3");
        let out = scratch.path().join(number.to_string());
        let call = call
            .replace("/results/payload", &text(&out))
            .replace("--out payload", &format!("--out {}", text(&out)));
        let call =
            call.replace("/project/scenarios/", "scenarios/").trim_start_matches("congruent ").to_owned();
        let call = call.replace("/64", "/256").replace("/8 ", "/256 ").replace("/8\n", "/256");
        let call = call.trim().trim_end_matches("/8").to_owned() + if number == 2 { "/256" } else { "" };
        let mut shell = Command::new("sh");
        let command = allowing(&["--version"]);
        shell.arg("-c").arg(format!("{:?} {call}", command.get_program())).current_dir(workspace());
        shell
            .env("PLAN", "scenarios/ur5e_payload.sweep.toml")
            .env("OUT", &out)
            .env("JOB_COMPLETION_INDEX", "2");
        shell
            .env("SLURM_ARRAY_TASK_ID", "3")
            .env("SLURM_ARRAY_TASK_COUNT", "256")
            .env("SLURM_CPUS_PER_TASK", "1");
        let output = shell.output().unwrap();
        assert!(output.status.success(), "{name}: {call}\n{}", String::from_utf8_lossy(&output.stderr));
        let ran: Vec<u64> = rows(&out).iter().map(|row| row["case"].as_u64().unwrap()).collect();
        assert_eq!(ran, [2], "{name}: {call}");
    }
}

/// Of a check that fails at several pairs the worst of all is the case's; the seed that a plan sets is the row's.
#[test]
fn the_worst_of_several_pairs_and_a_seed_that_is_set() {
    let scratch = ScratchFolder::new();
    let body = "sampling = \"grid\"\n[set]\nseed = 5\n\"check.clearance.minimum_m\" = 0.2\n[[vary]]\nkey = \"controller.stiffness\"\nvalues = [2000.0]\n";
    let plan = plan(&scratch, "pairs", body);
    let out = scratch.path().join("out");
    assert_eq!(sweep(&["run", &plan, "--out", &text(&out), "--worst", "1"]).code, 1);
    let row = &rows(&out)[0];
    assert_eq!(row["seed"], 5);
    let report = read_json(&out.join("worst/ur5e_payload_case_0/report.json"));
    let clearance =
        report["checks"].as_array().unwrap().iter().find(|check| check["check"] == "clearance").unwrap();
    let measures = clearance["measures"].as_array().unwrap();
    assert!(measures.len() > 1, "{measures:?}");
    let worst =
        measures.iter().map(|of| of["worst"]["value"].as_f64().unwrap()).fold(f64::INFINITY, f64::min);
    assert_eq!(row["worst"]["clearance.distance_m"]["value"].as_f64(), Some(worst));
}

#[test]
fn a_requirement_is_met_is_not_met_or_needs_more_cases() {
    let scratch = ScratchFolder::new();
    let vary = "[[vary]]\nkey = \"fault.wrong_payload.mass_kg\"\nuniform = [0.0, 1.0]\n";
    for (name, body, code, words) in [
        (
            "met",
            "cases = 60\n[require]\npassing = 0.95\n",
            0,
            "requirement MET: at least 95.12 % of all cases pass",
        ),
        ("open", "cases = 30\n[require]\npassing = 0.95\n", 4, "59 cases are needed"),
        (
            "failed",
            "cases = 30\n[set]\n\"check.tracking.path_tcp_mm\" = 4.9\n[require]\npassing = 0.95\n",
            1,
            "requirement NOT MET",
        ),
    ] {
        let plan = plan(&scratch, name, &format!("{body}{vary}"));
        let answer = sweep(&["run", &plan, "--out", &text(&scratch.path().join(name)), "--worst", "0"]);
        assert_eq!(
            (answer.code, answer.stdout.contains(words)),
            (code, true),
            "{name}: {}{}",
            answer.stdout,
            answer.stderr
        );
    }
    let plan = plan(&scratch, "wrong", &format!("cases = 3\n[require]\npassing = 1.0\n{vary}"));
    let refused = sweep(&["run", &plan, "--out", &text(&scratch.path().join("wrong"))]);
    assert_eq!(
        (refused.code, refused.stderr.contains("not above 0 and below 1")),
        (2, true),
        "{}",
        refused.stderr
    );
}
