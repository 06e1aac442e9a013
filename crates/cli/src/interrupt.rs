//! Signals: SIGTERM and Ctrl-C end a call. The first ends the runs of a call in order, so that what they have computed is
//! kept; any other ends the call at once, without its unfinished files.

use std::{
    sync::{
        Arc, OnceLock,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use congruent::results::files::remove_unfinished_files;
use signal_hook::{
    consts::{SIGINT, SIGTERM},
    flag,
};

use crate::{
    failure::{BROKEN, Failure},
    terminal::print::Printer,
};

/// How often the watcher looks: not noticed by a person, and nothing beside a run.
const PERIOD: Duration = Duration::from_millis(20);

/// The flag of a call that ends its runs in order.
static OF_RUNS: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// Watches signals until the program ends. SIGHUP keeps its meaning: `nohup` works.
pub(crate) fn watch_signals() {
    // A file that would be larger than allowed is an error of the write, like a full disk, and not the end.
    #[cfg(unix)]
    let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
    let received = Arc::new(AtomicBool::new(false));
    // Without a watcher a signal ends the call at once, as it would have.
    for signal in [SIGINT, SIGTERM] {
        if flag::register(signal, Arc::clone(&received)).is_err() {
            return;
        }
    }
    // A flag and a look at it, since an iterator over signals does not exist on Windows.
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(PERIOD);
            let is_new = received.swap(false, Ordering::Relaxed);
            if is_new && OF_RUNS.get().is_none_or(|flag| flag.swap(true, Ordering::Relaxed)) {
                remove_unfinished_files();
                Printer::explain(None, &Failure::Machine("interrupted".to_owned()));
                std::process::exit(i32::from(BROKEN));
            }
        }
    });
}

/// A flag that the first of these signals sets from now on, instead of ending the call.
pub(crate) fn flag_of_signals() -> Arc<AtomicBool> {
    Arc::clone(OF_RUNS.get_or_init(Arc::default))
}
