//! The worst cases of a sweep, run again with page and recording: that is what a person opens.

use std::{path::Path, sync::atomic::Ordering};

use congruent::{
    PreparedScenario,
    input::{Diagnostic, Override},
    page::PageFormat,
    results::{Options, RecordingFormat},
    sweep::{codes, run::CaseRunner, store::MergedTable, summary::SweepSummary},
};

use crate::{
    failure::Failure,
    interrupt::flag_of_signals,
    run::run_one,
    terminal::{print::Printer, progress::ProgressLines},
};

/// The folder of the worst cases, in that of the sweep.
const WORST: &str = "worst";

/// Runs the listed cases again, and notes their pages in the summary. A run that differs from its row is reported: rows are equal
/// wherever they ran.
pub(super) fn run_worst(
    summary: &mut SweepSummary,
    table: &MergedTable,
    out: &Path,
    runner: &CaseRunner<'_>,
    printer: &Printer,
) -> Result<(), Failure> {
    let interrupt = flag_of_signals();
    let recordings = formats();
    let recordings: Vec<&dyn RecordingFormat> = recordings.iter().map(|format| &**format).collect();
    let options = Options { out: out.join(WORST), recordings, interrupt: Some(&interrupt) };
    let progress = ProgressLines::new(printer);
    for worst in &mut summary.worst {
        if interrupt.load(Ordering::Relaxed) {
            break;
        }
        let case = runner.plan().case(worst.case);
        let name = format!("{}_case_{}", table.header.scenario, worst.case);
        let mut overrides = case.overrides;
        overrides.push(Override::name(&name));
        let setup = runner.setup_with(&overrides)?;
        let ran = match run_one(&PreparedScenario::without_cases(setup), &options, &progress) {
            Ok(ran) => ran,
            // As of another call that merges the same folder: the rows are right all the same.
            Err(failure) => {
                Printer::explain(Some(&options.out.join(&name)), &failure);
                continue;
            }
        };
        let row = table.rows.iter().find(|row| row.case == worst.case);
        let recorded = row.and_then(|row| row.trajectory_sha256.as_deref());
        if recorded.is_some_and(|recorded| recorded != ran.report.trajectory_sha256) {
            let message = format!(
                "case {} moves otherwise than its row says: the row is of another machine",
                worst.case
            );
            printer.warnings(None, &[Diagnostic::warning(codes::sweep::ROWS, message)]);
        }
        let page = PageFormat.file_name();
        worst.page = ran.results.is_ok().then(|| format!("{WORST}/{name}/{page}"));
    }
    Ok(())
}

fn formats() -> Vec<Box<dyn RecordingFormat>> {
    vec![
        #[cfg(feature = "recording")]
        Box::new(congruent::recording::RerunFormat),
        Box::new(PageFormat),
    ]
}
