//! A recording against the files of its run: the report beside it, and what the run was made from.

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent::{
    input::{Diagnostic, FileAccess, Findings, InputFile, Override},
    recording::{RecordingSummary, RerunFormat},
    results::{
        RecordingFormat,
        files::{ComparedResults, DIGESTS, REPORT, compare_results, read_result},
        report::RunReport,
    },
    twin::RunSetup,
};
use serde_json::Value;

use crate::{
    codes,
    failure::{BAD_INPUT, NOTHING, worse},
};

/// Adds what the files say: a report beside the recording must be its own, and the results as the run wrote them.
pub(super) fn compare_files(summary: &mut RecordingSummary, path: &Path, access: &FileAccess) {
    let (report, run) = (summary.report.as_ref(), summary.run.as_ref());
    summary.changed_inputs = run.and_then(|run| changed_inputs(run, access));
    // A recording under another name was moved out of the folder of its run: what lies beside it now is unrelated.
    if path.file_name().is_none_or(|name| name != RerunFormat.file_name()) {
        return;
    }
    let folder = path.with_file_name("");
    let compared = compare_results(&folder);
    summary.missing_results =
        run.map(|run| missing_results(&folder, run, compared.as_ref())).unwrap_or_default();
    let beside = read_result(&folder.join(REPORT)).ok();
    let is_its_own = |beside: Vec<u8>| serde_json::from_slice::<Value>(&beside).ok().as_ref() == report;
    // A file that is damaged may have lost its report.
    let problem = if report.is_some() && beside.is_some_and(|beside| !is_its_own(beside)) {
        format!(
            "{REPORT} beside the recording differs from the report inside the recording: {REPORT} has been changed, or belongs to another run"
        )
    } else if let Some(changed) = compared.and_then(|compared| changed_results(&folder, &compared)) {
        format!("{changed} has changed since the run wrote it (by {DIGESTS} beside the recording)")
    } else {
        return;
    };
    if summary.exit_code != BAD_INPUT {
        summary.reason.clone_from(&problem);
    }
    summary.exit_code = worse(summary.exit_code, BAD_INPUT);
    summary.problems.push(problem);
}

/// The folders of results in the folder of several runs, by name; `path` itself if it is no such folder.
pub(super) fn runs_in(path: &Path) -> Vec<PathBuf> {
    let has_results =
        |folder: &Path| [RerunFormat.file_name(), DIGESTS].iter().any(|name| folder.join(name).is_file());
    let entries = fs::read_dir(path).ok().filter(|_| !has_results(path)).into_iter().flatten().flatten();
    let mut runs: Vec<PathBuf> =
        entries.map(|entry| entry.path()).filter(|folder| has_results(folder)).collect();
    runs.sort();
    if runs.is_empty() { vec![path.to_owned()] } else { runs }
}

/// Why a folder of results has no recording to inspect, and what is there of the run by its digests; `None` if it has one, or if it is
/// no such folder.
pub(super) fn without_recording(folder: &Path) -> Option<Diagnostic> {
    let recording = RerunFormat.file_name();
    if !folder.is_dir() || folder.join(recording).exists() {
        return None;
    }
    let ComparedResults { intact, changed } = compare_results(folder)?;
    let (there, gone): (Vec<&str>, Vec<&str>) =
        changed.into_iter().partition(|name| folder.join(name).exists());
    let named =
        |names: &[&str], what: &str| (!names.is_empty()).then(|| format!("{what}: {}", names.join(", ")));
    let found = [named(&gone, "gone"), named(&there, "changed"), named(&intact, "as the run wrote them")];
    let unfinished = format!("{recording}.partial");
    let why = if gone.contains(&recording) {
        "is gone".to_owned()
    } else if folder.join(&unfinished).exists() {
        format!(
            "was not finished: {unfinished} has what was written before the run failed, as of a full disk"
        )
    } else {
        "was not written: the run had --no-recording".to_owned()
    };
    let message = format!("{}: {recording} {why}", folder.display());
    let found: Vec<String> = found.into_iter().flatten().collect();
    let help = format!("of the results that {DIGESTS} names, {}; run the scenario again", found.join("; "));
    Some(Diagnostic::error(codes::inspect::RECORDING, message).with_help(help))
}

/// The results beside a recording that are not those of its run.
fn changed_results(folder: &Path, compared: &ComparedResults) -> Option<String> {
    let is_there = |name: &&str| folder.join(name).is_file();
    let changed: Vec<&str> = compared.changed.iter().copied().filter(is_there).collect();
    (!changed.is_empty()).then(|| changed.join(", "))
}

/// The results of a run that are no longer beside its recording: those that its digests name, the digests themselves, and
/// the report. A recording that was not made from a scenario file is written alone.
fn missing_results(folder: &Path, run: &RunReport, compared: Option<&ComparedResults>) -> Vec<String> {
    if run.scenario_file.is_none() {
        return Vec::new();
    }
    let named = compared.map_or_else(|| vec![REPORT, DIGESTS], |compared| compared.changed.clone());
    named.into_iter().filter(|name| !folder.join(name).exists()).map(str::to_owned).collect()
}

/// A verdict about files that have changed says nothing about those that are there.
pub(super) fn judge_inputs(summary: &mut RecordingSummary) {
    let Some([first, others @ ..]) = summary.changed_inputs.as_deref() else { return };
    // Only if it makes the answer worse: a damaged file and a broken run stay what they are.
    let code = worse(summary.exit_code, NOTHING);
    if code != summary.exit_code {
        let more = if others.is_empty() { String::new() } else { format!(" (and {} more)", others.len()) };
        summary.reason = format!("{first}{more}; in the run {}", summary.reason);
        summary.exit_code = code;
    }
}

/// The values that replaced those of the scenario file in the run.
pub(super) fn overrides(run: &RunReport) -> Result<Vec<Override>, Diagnostic> {
    run.overrides.iter().map(|text| text.parse()).collect()
}

/// Files of a run that have changed since; `None` if its scenario is missing, or names a file that may not be opened.
fn changed_inputs(run: &RunReport, access: &FileAccess) -> Option<Vec<String>> {
    let scenario = Path::new(run.scenario_file.as_ref()?);
    if !scenario.is_file() {
        return None;
    }
    let setup = overrides(run)
        .map_err(Findings::from)
        .and_then(|overrides| RunSetup::load_with(scenario, &overrides, access));
    Some(match setup {
        Ok(setup) => differences(&run.inputs, &setup.inputs),
        // What may not be opened here need not have changed.
        Err(findings)
            if findings.iter().any(|finding| {
                [congruent::input::codes::file::OUTSIDE, congruent::input::codes::mesh::OUTSIDE]
                    .contains(&finding.code)
            }) =>
        {
            return None;
        }
        Err(findings) => {
            let first = &findings.first().message;
            vec![format!("{} cannot be loaded as it is now: {first}", scenario.display())]
        }
    })
}

fn differences(before: &[InputFile], now: &[InputFile]) -> Vec<String> {
    let find = |inputs: &[InputFile], file: &str| inputs.iter().position(|input| input.file == file);
    let old = before.iter().filter_map(|InputFile { file, sha256, .. }| match find(now, file) {
        None => Some(format!("{file} is no longer read")),
        Some(at) if now[at].sha256 != *sha256 => Some(format!("{file} has changed since the run")),
        Some(_) => None,
    });
    let new = now.iter().filter(|input| find(before, &input.file).is_none());
    old.chain(new.map(|input| format!("{} was not read in the run", input.file))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_difference_is_reported() {
        let input = |file: &str, sha256: &str| InputFile {
            file: file.to_owned(),
            sha256: sha256.to_owned(),
            path: file.into(),
        };
        let now = [input("same", "1"), input("edited", "3"), input("new", "4")];
        let found = differences(&[input("same", "1"), input("edited", "2"), input("gone", "5")], &now);
        let expected =
            ["edited has changed since the run", "gone is no longer read", "new was not read in the run"];
        assert_eq!(found, expected);
    }
}
