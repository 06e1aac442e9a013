//! Signals: the first SIGTERM or Ctrl-C ends the runs of a call in order, so that what they have computed is kept; the
//! second ends the call at once.

use std::sync::{Arc, atomic::AtomicBool};

use signal_hook::{
    consts::{SIGINT, SIGTERM},
    flag,
};

use crate::failure::BROKEN;

/// From now on a file that would be larger than `ulimit -f` allows is an error of the write, as on a full disk, and not the
/// end of the call, which would leave unfinished files.
pub(crate) fn survive_file_size_limit() {
    #[cfg(unix)]
    let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// A flag that is set by the first of these signals from now on. SIGHUP keeps its meaning: `nohup` works.
pub(crate) fn flag_of_signals() -> Arc<AtomicBool> {
    let flag = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        // The order matters: the first signal finds the flag unset, and sets it. Without a handler a signal ends the call at
        // once, as it would have.
        let _ = flag::register_conditional_shutdown(signal, i32::from(BROKEN), Arc::clone(&flag));
        let _ = flag::register(signal, Arc::clone(&flag));
    }
    flag
}
