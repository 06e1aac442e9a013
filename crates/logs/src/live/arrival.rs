//! When messages of a stream come: the clock of whoever listens.

use std::{
    sync::{Arc, OnceLock},
    time::Instant,
};

/// A clock that shows the time of the first message when that one comes, and goes on from there: what a message is later than its
/// stamp by is then its delay beside that of the first.
#[derive(Debug, Clone)]
pub struct ArrivalClock {
    started: Instant,
    /// What is added to the time since the start, ns.
    offset_ns: Arc<OnceLock<i64>>,
}

impl ArrivalClock {
    /// A clock that no message has set yet.
    #[expect(
        clippy::disallowed_methods,
        reason = "how late the answers to a stream are can only be measured; no verdict depends on it"
    )]
    pub(crate) fn start() -> Self {
        Self { started: Instant::now(), offset_ns: Arc::default() }
    }

    /// The time now, at which a message comes that is of `stamp_ns`.
    pub(crate) fn arrives(&self, stamp_ns: i64) -> i64 {
        let since_ns = self.since_start_ns();
        self.offset_ns.get_or_init(|| stamp_ns.saturating_sub(since_ns)).saturating_add(since_ns)
    }

    /// The time now, ns.
    pub fn now_ns(&self) -> i64 {
        self.offset_ns.get().copied().unwrap_or(0).saturating_add(self.since_start_ns())
    }

    /// How long ago a message came, ns.
    pub fn age_ns(&self, log_ns: i64) -> u64 {
        u64::try_from(self.now_ns().saturating_sub(log_ns)).unwrap_or(0)
    }

    fn since_start_ns(&self) -> i64 {
        i64::try_from(self.started.elapsed().as_nanos()).unwrap_or(i64::MAX)
    }
}
