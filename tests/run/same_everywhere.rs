//! The same results on every processor: the operating system's mathematics chooses its instructions by what the processor
//! has, and with them the last bit.
#![cfg(all(target_arch = "x86_64", target_env = "gnu"))]

use std::{fs, path::Path};

use crate::support::{
    command::{allowing, text},
    scenario_files::scenario_files,
};

/// Lets the C library take a processor to be without these. What the program itself chooses by the processor, the width of
/// vectors, gives the same bits by tests of its own.
const OLD_PROCESSOR: &str = "glibc.cpu.hwcaps=-AVX512F,-AVX2,-AVX,-FMA,-FMA4,-AVX2_Usable,-AVX_Usable,-FMA_Usable,-SSE4_1,-SSE4_2,-ERMS";

/// The reports of all scenarios by their folder.
fn reports(out: &Path, processor: Option<&str>) -> Vec<(String, String)> {
    let files = ["scenarios", "scenarios/faults"].into_iter().flat_map(scenario_files);
    let scenarios: Vec<String> = files.map(|path| text(&path)).collect();
    let out_text = text(out);
    let arguments: Vec<&str> = ["run", "--no-recording", "--out", &out_text]
        .into_iter()
        .chain(scenarios.iter().map(String::as_str))
        .collect();
    let mut command = allowing(&arguments);
    if let Some(processor) = processor {
        command.env("GLIBC_TUNABLES", processor);
    }
    let output = command.output().unwrap();
    assert!(matches!(output.status.code(), Some(0 | 1)), "{}", String::from_utf8_lossy(&output.stderr));
    let folders = fs::read_dir(out).unwrap().flatten().filter(|entry| entry.path().is_dir());
    let mut reports: Vec<(String, String)> = folders
        .map(|entry| {
            let report = fs::read_to_string(entry.path().join("report.json")).unwrap();
            (entry.file_name().into_string().unwrap(), report)
        })
        .collect();
    reports.sort();
    assert_eq!(reports.len(), scenarios.len());
    reports
}

#[test]
fn reports_do_not_depend_on_the_instructions_of_the_processor() {
    let folder = tempfile::tempdir().unwrap();
    let here = reports(&folder.path().join("here"), None);
    let old = reports(&folder.path().join("old"), Some(OLD_PROCESSOR));
    assert!(here.len() > 25, "{}", here.len());
    for ((name, here), (_, old)) in here.iter().zip(&old) {
        assert!(here == old, "{name} has another report on an older processor");
    }
}
