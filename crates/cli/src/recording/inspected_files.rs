//! A recording against the files of its run: the report beside it, and what the run was made from.

use std::path::Path;

use congruent::{
    input::{Diagnostic, FileAccess, Findings, InputFile},
    recording::{RecordingSummary, RerunFormat},
    results::{
        RecordingFormat,
        files::{DIGESTS, REPORT, compare_results, read_result},
    },
    scenario::Override,
    twin::RunSetup,
};
use serde_json::Value;

use crate::failure::{BAD_INPUT, NOTHING, worse};

/// Adds what the files say: a report beside the recording must be its own, and the results as the run wrote them.
pub(super) fn compare_files(summary: &mut RecordingSummary, path: &Path, access: &FileAccess) {
    let report = summary.report.as_ref();
    summary.changed_inputs = report.and_then(|report| changed_inputs(report, access));
    // A recording under another name was moved out of the folder of its run: what lies beside it now is unrelated.
    if path.file_name().is_none_or(|name| name != RerunFormat.file_name()) {
        return;
    }
    let beside = read_result(&path.with_file_name(REPORT)).ok();
    let is_its_own = |beside: Vec<u8>| serde_json::from_slice::<Value>(&beside).ok().as_ref() == report;
    // A file that is damaged may have lost its report.
    let problem = if report.is_some() && beside.is_some_and(|beside| !is_its_own(beside)) {
        format!(
            "{REPORT} beside the recording differs from the report inside the recording: {REPORT} has been changed, or belongs to another run"
        )
    } else if let Some(changed) = changed_results(path) {
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

/// The results beside a recording that are not those of its run; some may have been left behind on purpose.
fn changed_results(recording: &Path) -> Option<String> {
    let folder = recording.parent()?;
    let compared = compare_results(folder)?;
    let changed: Vec<&str> =
        compared.changed.into_iter().filter(|name| folder.join(name).is_file()).collect();
    (!changed.is_empty()).then(|| changed.join(", "))
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
pub(super) fn overrides(report: &Value) -> Result<Vec<Override>, Diagnostic> {
    let texts = report["overrides"].as_array().into_iter().flatten().filter_map(Value::as_str);
    texts.map(str::parse).collect()
}

/// Files of a run that have changed since; `None` if its scenario is missing, or names a file that may not be opened.
fn changed_inputs(report: &Value, access: &FileAccess) -> Option<Vec<String>> {
    let scenario = Path::new(report["scenario_file"].as_str()?);
    let before: Vec<(&str, &str)> = report["inputs"]
        .as_array()?
        .iter()
        .filter_map(|input| Some((input["file"].as_str()?, input["sha256"].as_str()?)))
        .collect();
    if !scenario.is_file() {
        return None;
    }
    let setup = overrides(report)
        .map_err(Findings::from)
        .and_then(|overrides| RunSetup::load_with(scenario, &overrides, access));
    Some(match setup {
        Ok(setup) => differences(&before, &setup.inputs),
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

fn differences(before: &[(&str, &str)], now: &[InputFile]) -> Vec<String> {
    let found = |file: &str| now.iter().find(|input| input.file == file);
    let old = before.iter().filter_map(|&(file, sha256)| match found(file) {
        None => Some(format!("{file} is no longer read")),
        Some(input) if input.sha256 != sha256 => Some(format!("{file} has changed since the run")),
        Some(_) => None,
    });
    let new = now.iter().filter(|input| !before.iter().any(|&(file, _)| file == input.file));
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
        let found = differences(&[("same", "1"), ("edited", "2"), ("gone", "5")], &now);
        let expected =
            ["edited has changed since the run", "gone is no longer read", "new was not read in the run"];
        assert_eq!(found, expected);
    }
}
