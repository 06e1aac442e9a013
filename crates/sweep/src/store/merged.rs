//! The rows of all files of a folder, one for each case.

use std::{collections::BTreeMap, path::PathBuf};

use congruent_input::Diagnostic;
use sha2::{Digest, Sha256};

use super::{
    cases::{CaseRange, missing},
    digest::hex,
    folder::SweepFolder,
    header::SweepHeader,
    rows::read_rows,
};
use crate::{codes, plan::SweepPlan, run::CaseRow};

/// The rows of a sweep, in the order of their cases.
#[derive(Debug, Clone, PartialEq)]
pub struct MergedTable {
    /// What they are of.
    pub header: SweepHeader,
    /// The rows; cases that have not run yet have none.
    pub rows: Vec<CaseRow>,
    /// The cases that have no row.
    pub missing: Vec<CaseRange>,
}

impl MergedTable {
    /// Reads the rows of one or more folders, which have parts of one sweep.
    ///
    /// # Errors
    /// A folder has no sweep, or one of another plan; a file is damaged; or two files have different rows of one case.
    pub fn read(folders: &[SweepFolder]) -> Result<Self, Diagnostic> {
        let mut header: Option<SweepHeader> = None;
        let mut rows: BTreeMap<u64, (CaseRow, PathBuf)> = BTreeMap::new();
        for folder in folders {
            let found = folder.header()?.ok_or_else(|| {
                let message = format!("{} has no sweep", folder.path().display());
                Diagnostic::error(codes::sweep::ROWS, message)
                    .with_help("give the folder that `congruent sweep run` was given as --out")
            })?;
            match &header {
                Some(known) if known.identity != found.identity => {
                    let message =
                        format!("{} has another sweep than the first folder", folder.path().display());
                    return Err(Diagnostic::error(codes::sweep::OTHER_PLAN, message));
                }
                _ => header = Some(found),
            }
            for file in folder.row_files()? {
                for row in read_rows(&file)? {
                    add(&mut rows, row, &file)?;
                }
            }
        }
        let header = header.ok_or_else(|| {
            Diagnostic::error(codes::sweep::ROWS, "no folder of a sweep was given".to_owned())
        })?;
        let rows: Vec<CaseRow> = rows.into_values().map(|(row, _)| row).collect();
        let missing = missing(CaseRange::all(header.cases), rows.iter().map(|row| row.case));
        Ok(Self { header, rows, missing })
    }

    /// Refuses rows whose seed or values are not those that the plan gives their case.
    ///
    /// # Errors
    /// A file of rows was changed.
    pub fn examine(&self, plan: &SweepPlan) -> Result<(), Diagnostic> {
        let differs = |row: &&CaseRow| {
            let case = (row.case < plan.cases).then(|| plan.case(row.case));
            case.is_none_or(|case| case.seed != row.seed || case.values != row.values)
        };
        let Some(row) = self.rows.iter().find(differs) else { return Ok(()) };
        let message =
            format!("the row of case {} has another seed or other values than the plan gives it", row.case);
        Err(Diagnostic::error(codes::sweep::ROWS, message)
            .with_help("its file was changed: remove it, and run its cases again with --resume"))
    }

    /// Number of cases without a row.
    pub fn missing_count(&self) -> u64 {
        self.missing.iter().map(|range| range.count()).sum()
    }
}

fn add(
    rows: &mut BTreeMap<u64, (CaseRow, PathBuf)>,
    row: CaseRow,
    file: &std::path::Path,
) -> Result<(), Diagnostic> {
    match rows.get(&row.case) {
        Some((known, of)) if *known != row => {
            let message =
                format!("{} and {} have different rows of case {}", of.display(), file.display(), row.case);
            Err(Diagnostic::error(codes::sweep::ROWS, message).with_help(
                "a case has one row wherever it runs: run it again, and remove the file that differs",
            ))
        }
        // The same case from two calls, such as one that was restarted while it still ran.
        Some(_) => Ok(()),
        None => {
            rows.insert(row.case, (row, file.to_owned()));
            Ok(())
        }
    }
}

/// SHA-256 over the rows: equal however the sweep was cut, and whichever machine ran which part.
pub fn table_sha256(rows: &[CaseRow]) -> String {
    let mut digest = Sha256::new();
    for row in rows {
        digest.update(serde_json::to_string(row).unwrap_or_default());
        digest.update(b"\n");
    }
    hex(&digest.finalize())
}
