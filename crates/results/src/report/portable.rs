//! Paths in a report: none is absolute, so that a report can be given to others.

use std::path::Path;

use congruent_agreement::report::{Fault, ReportedCause, ReportedDiagnosis};
use congruent_input::{Finding, portable_path};

/// A path as a report names it.
pub(super) fn portable(path: &Path) -> String {
    portable_path(path).display().to_string()
}

pub(super) fn portable_finding(finding: Finding) -> Finding {
    Finding { file: finding.file.map(|file| portable(Path::new(&file))), ..finding }
}

/// A diagnosis whose places are named so.
pub(super) fn portable_diagnosis(mut diagnosis: ReportedDiagnosis) -> ReportedDiagnosis {
    diagnosis.causes.iter_mut().for_each(name_files);
    diagnosis.indistinguishable.iter_mut().for_each(|other| name_files(&mut other.cause));
    if let Some(corrected) = &mut diagnosis.corrected {
        corrected.file = portable(Path::new(&corrected.file));
    }
    diagnosis
}

fn name_files(cause: &mut ReportedCause) {
    let faults = std::iter::once(&mut cause.fault).chain(&mut cause.parts);
    for Fault { file, expected_file, .. } in faults {
        for file in [file, expected_file].into_iter().flatten() {
            *file = portable(Path::new(&*file));
        }
    }
}
