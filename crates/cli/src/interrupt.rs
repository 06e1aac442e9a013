//! Signals: the first SIGTERM or Ctrl-C ends the runs of a call in order, so that what they have computed is kept; the
//! second ends the call at once.

use std::sync::{Arc, atomic::AtomicBool};

use signal_hook::{
    consts::{SIGINT, SIGTERM},
    flag,
};

use crate::failure::BROKEN;

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
