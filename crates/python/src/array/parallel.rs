//! Results that are computed row by row on all cores, without the interpreter's lock; Ctrl-C ends them between two blocks.

use std::{
    iter::Enumerate,
    ops::Range,
    slice::ChunksMut,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
        mpsc::channel,
    },
    thread,
};

use congruent::{codes::dynamics::OVERFLOW, input::Diagnostic};
use pyo3::prelude::*;

use crate::{error::refused, interrupt::wait_for_end};

/// The numbers of a result, and how many rows a thread computes before it looks whether it should go on.
pub(crate) struct RowBlocks<'a> {
    /// The numbers of all rows.
    pub(crate) out: &'a mut [f64],
    /// Numbers of a row.
    pub(crate) width: usize,
    /// Rows of a block.
    pub(crate) rows: usize,
}

/// Fills rows of numbers. Each thread makes a worker, with memory of its own, that computes the rows of one block after another.
///
/// # Errors
/// `CongruentError` if the worker refuses a row, the first of them, or if a number overflows; what Python raises for a signal.
pub(crate) fn fill_rows<Worker>(
    py: Python<'_>,
    blocks: RowBlocks<'_>,
    worker: impl Fn() -> Worker + Sync,
) -> PyResult<()>
where
    Worker: FnMut(Range<usize>, &mut [f64]) -> Result<(), Diagnostic>,
{
    let RowBlocks { out, width, rows } = blocks;
    if out.is_empty() {
        return Ok(());
    }
    let count = out.len().div_ceil(width * rows);
    if count == 1 {
        let filled = py.detach(|| fill(&mut worker(), 0, width, out));
        return filled.map_err(|(_, found)| refused(py, found));
    }
    let cores = thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let queue = Queue {
        blocks: Mutex::new(out.chunks_mut(width * rows).enumerate()),
        stop: AtomicBool::new(false),
        first_error: Mutex::new(None),
    };
    let ended = thread::scope(|scope| {
        let (running, ended) = channel();
        for _ in 0..cores.min(count) {
            let (running, queue, worker) = (running.clone(), &queue, &worker);
            scope.spawn(move || {
                queue.work(worker(), width, rows);
                // That all of these are gone is the sign that all threads have ended.
                drop(running);
            });
        }
        drop(running);
        wait_for_end(py, ended, &queue.stop)
    });
    ended?;
    match queue.first_error.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some((_, found)) => Err(refused(py, found)),
        None => Ok(()),
    }
}

/// The blocks that are not computed yet, and why no more are.
struct Queue<'a> {
    blocks: Mutex<Enumerate<ChunksMut<'a, f64>>>,
    stop: AtomicBool,
    /// The finding of the row with the least index.
    first_error: Mutex<Option<(usize, Diagnostic)>>,
}

impl Queue<'_> {
    fn work(
        &self,
        mut worker: impl FnMut(Range<usize>, &mut [f64]) -> Result<(), Diagnostic>,
        width: usize,
        rows: usize,
    ) {
        while !self.stop.load(Ordering::Relaxed) {
            let next = self.blocks.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((block, out)) = next else { return };
            if let Err((row, found)) = fill(&mut worker, block * rows, width, out) {
                // Blocks are taken in their order, so those before this one are computed to their end: the least row does not
                // depend on the threads.
                self.stop.store(true, Ordering::Relaxed);
                let mut first = self.first_error.lock().unwrap_or_else(PoisonError::into_inner);
                if first.as_ref().is_none_or(|(least, _)| row < *least) {
                    *first = Some((row, found));
                }
            }
        }
    }
}

/// The rows of one block; of a row that is refused the index and the finding.
fn fill(
    worker: &mut impl FnMut(Range<usize>, &mut [f64]) -> Result<(), Diagnostic>,
    first: usize,
    width: usize,
    out: &mut [f64],
) -> Result<(), (usize, Diagnostic)> {
    worker(first..first + out.len() / width, out).map_err(|found| (first, found))?;
    match out.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(at) => {
            let row = first + at / width;
            let message =
                format!("the result of row {row} is not a finite number: a value of that row is too large");
            let help = "correct the largest value of that row; often its exponent is wrong";
            Err((row, Diagnostic::error(OVERFLOW, message).with_help(help)))
        }
    }
}
