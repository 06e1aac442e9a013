//! Cases on threads: each takes the next one, and rows come as they are done.

use std::{
    sync::{
        Mutex,
        atomic::{AtomicBool, Ordering},
        mpsc,
    },
    thread,
};

use super::{case_row::CaseRow, runner::CaseRunner};

/// Rows that may wait for whoever takes them, for each thread. Kind: choice; a slow disk must not fill the memory.
const WAITING_ROWS: usize = 64;

/// Runs these cases on `jobs` threads; `take` gets each row as it is done, in no order. Ends in order once `interrupt` is set: cases
/// that have not ended have no row.
///
/// # Errors
/// The first error of `take`, after which no further case begins.
///
/// # Panics
/// If a run does.
pub fn run_cases<E>(
    runner: &CaseRunner<'_>,
    cases: impl Iterator<Item = u64> + Send,
    jobs: usize,
    interrupt: &AtomicBool,
    mut take: impl FnMut(CaseRow) -> Result<(), E>,
) -> Result<(), E> {
    let waiting = Mutex::new(cases);
    let (sender, rows) = mpsc::sync_channel(WAITING_ROWS * jobs);
    // Not the flag of the caller: an error here is no interruption of the program.
    let is_over = AtomicBool::new(false);
    let ends = || interrupt.load(Ordering::Relaxed) || is_over.load(Ordering::Relaxed);
    let work = |rows: mpsc::SyncSender<CaseRow>| {
        while !ends() {
            let next = waiting.lock().expect("no thread panics while it takes a case").next();
            let row = next.and_then(|case| runner.run(case, interrupt));
            if row.is_none_or(|row| rows.send(row).is_err()) {
                return;
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..jobs {
            let (sender, work) = (sender.clone(), &work);
            scope.spawn(move || work(sender));
        }
        drop(sender);
        for row in rows {
            if let Err(error) = take(row) {
                is_over.store(true, Ordering::Relaxed);
                return Err(error);
            }
        }
        Ok(())
    })
}
