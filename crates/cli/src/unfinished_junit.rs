//! The JUnit file of a call with several inputs, while it is not finished.

use std::time::Instant;

use congruent::results::report::TestSuite;

use crate::ci::CiArguments;

/// The JUnit file until all inputs are answered.
pub(crate) struct UnfinishedJunit {
    /// One for each input.
    pub(crate) suites: Vec<TestSuite>,
    /// How many inputs are answered.
    answered: usize,
    /// When it may be written again, once there are many answers.
    next: Option<Instant>,
}

/// Up to so many answers the JUnit file is written after each. Kind: choice; a write takes a millisecond for these.
const WRITTEN_AT_ONCE: usize = 64;
/// With more answers, it is written again after so many times the duration of the last write, which is proportional to their
/// number: written after each, a thousand answers took seven times as long as their runs.
const PAUSE: u32 = 10;

impl UnfinishedJunit {
    /// Nothing is answered yet; `suites` says so of each input.
    pub(crate) fn new(suites: Vec<TestSuite>) -> Self {
        Self { suites, answered: 0, next: None }
    }

    /// Notes an answer, and writes the file unless it was written just now. An answer that is not written yet is an error in
    /// the file of a call that is killed.
    #[expect(clippy::disallowed_methods, reason = "when the JUnit file is written changes no result")]
    pub(crate) fn keep(&mut self, input: usize, suite: TestSuite, ci: &CiArguments) {
        if let Some(planned) = self.suites.get_mut(input) {
            *planned = suite;
        }
        self.answered += 1;
        let start = Instant::now();
        if self.answered > WRITTEN_AT_ONCE && self.next.is_some_and(|next| start < next) {
            return;
        }
        // A file that cannot be written is reported by `finish`, which writes it again.
        let _ = ci.write_unfinished(&self.suites);
        self.next = Some(start + start.elapsed() * (PAUSE + 1));
    }
}
