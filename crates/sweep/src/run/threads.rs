//! Cases on threads: each takes the next one, and rows come as they are done.

use std::{
    sync::{
        Mutex,
        atomic::{AtomicBool, Ordering},
        mpsc,
    },
    thread,
};

/// Results that may wait for whoever takes them, for each thread. Kind: choice; a slow disk must not fill the memory.
const WAITING: usize = 64;

/// Runs these cases on `jobs` threads; `take` gets the result of each as it is done, in no order. Ends in order once `interrupt` is set:
/// cases that have not ended have no result, for which `run` gives `None`.
///
/// # Errors
/// The first error of `take`, after which no further case begins.
///
/// # Panics
/// If a run does.
pub fn run_cases<T: Send, E>(
    cases: impl Iterator<Item = u64> + Send,
    jobs: usize,
    interrupt: &AtomicBool,
    run: impl Fn(u64) -> Option<T> + Sync,
    mut take: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    let waiting = Mutex::new(cases);
    let (sender, results) = mpsc::sync_channel(WAITING * jobs);
    // Not the flag of the caller: an error here is no interruption of the program.
    let is_over = AtomicBool::new(false);
    let ends = || interrupt.load(Ordering::Relaxed) || is_over.load(Ordering::Relaxed);
    let work = |results: mpsc::SyncSender<T>| {
        while !ends() {
            let next = waiting.lock().expect("no thread panics while it takes a case").next();
            let result = next.and_then(&run);
            if result.is_none_or(|result| results.send(result).is_err()) {
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
        for result in results {
            if let Err(error) = take(result) {
                is_over.store(true, Ordering::Relaxed);
                return Err(error);
            }
        }
        Ok(())
    })
}
