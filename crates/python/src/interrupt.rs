//! Ctrl-C during long calls: the work is done on other threads, while the thread of Python waits for them without the interpreter's
//! lock and looks at signals from time to time.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::{Receiver, RecvTimeoutError, channel},
    },
    thread,
    time::Duration,
};

use pyo3::prelude::*;

/// How often signals are looked at: not noticed by a person, and nothing beside the work.
const PERIOD: Duration = Duration::from_millis(20);

/// What becomes of work that is interrupted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum OnInterrupt {
    /// It ends by itself without a result, while Python goes on: it has no place at which it could stop.
    Abandon,
    /// It sees the flag and ends in order; Python waits for that, up to a second Ctrl-C.
    Wait,
}

/// Does the work on a thread of its own; a signal of Python, such as `KeyboardInterrupt`, sets the flag of the work and is raised.
pub(crate) fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    on_interrupt: OnInterrupt,
    work: impl FnOnce(&AtomicBool) -> T + Send + 'static,
) -> PyResult<T> {
    let interrupt = Arc::new(AtomicBool::new(false));
    let (sender, mut receiver) = channel();
    let flag = Arc::clone(&interrupt);
    let worker = thread::spawn(move || {
        // Nobody receives the result of work that was abandoned.
        let _ = sender.send(work(&flag));
    });
    let mut raised = None;
    loop {
        match (next(py, &mut receiver), py.check_signals()) {
            (Ok(result), signal) => return raised.map_or(signal, Err).map(|()| result),
            // The thread has ended without a result: it has panicked, which is a bug that is shown as such.
            (Err(RecvTimeoutError::Disconnected), _) => {
                let panic = worker.join().expect_err("work that ends without a result has panicked");
                std::panic::resume_unwind(panic)
            }
            (Err(RecvTimeoutError::Timeout), Ok(())) => {}
            (Err(RecvTimeoutError::Timeout), Err(signal)) => {
                let is_second = interrupt.swap(true, Ordering::Relaxed);
                if is_second || on_interrupt == OnInterrupt::Abandon {
                    return Err(signal);
                }
                raised = Some(signal);
            }
        }
    }
}

/// Waits until nothing more can be received, and sets the flag if Python has a signal to raise, which is returned.
pub(crate) fn wait_for_end(
    py: Python<'_>,
    mut receiver: Receiver<()>,
    interrupt: &AtomicBool,
) -> PyResult<()> {
    let mut raised = Ok(());
    while next(py, &mut receiver) != Err(RecvTimeoutError::Disconnected) {
        if let Err(signal) = py.check_signals() {
            interrupt.store(true, Ordering::Relaxed);
            raised = Err(signal);
        }
    }
    raised
}

/// Waits for a period without the interpreter's lock.
fn next<T: Send>(py: Python<'_>, receiver: &mut Receiver<T>) -> Result<T, RecvTimeoutError> {
    py.detach(move || receiver.recv_timeout(PERIOD))
}
