//! The progress of a run, with the time left, and of a computation, with the time it has taken: a line on the terminal, and
//! nothing in a pipe.

use std::{
    sync::mpsc::{RecvTimeoutError, channel},
    thread,
    time::Duration,
};

use congruent::{RunStage, twin::RunSetup};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};

use super::print::Printer;

/// Steps after which the clock is read again.
const STEPS_A_TICK: u64 = 256;

/// A computation that is over by then shows no line.
const UNTOLD: Duration = Duration::from_secs(1);
/// Between two pictures of the line.
const TICK: Duration = Duration::from_millis(200);

/// Does `work`, which prints nothing, and shows on the terminal that it goes on.
pub(crate) fn waiting<T>(printer: &Printer, what: &str, work: impl FnOnce() -> T) -> T {
    if !printer.is_interactive() {
        return work();
    }
    let (end, ended) = channel::<()>();
    thread::scope(|scope| {
        scope.spawn(move || {
            if ended.recv_timeout(UNTOLD) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            let style = ProgressStyle::with_template("{spinner} {prefix}, {elapsed}")
                .unwrap_or_else(|_| ProgressStyle::default_spinner());
            let line = ProgressBar::new_spinner().with_style(style).with_prefix(of_a_line(what));
            line.enable_steady_tick(TICK);
            // It ends when the other side of the channel is dropped, by a panic too.
            let _ = ended.recv();
            line.finish_and_clear();
        });
        let _end = end;
        work()
    })
}

/// As much as fits a line beside the time.
fn of_a_line(what: &str) -> String {
    const COLUMNS: usize = 60;
    what.chars().take(COLUMNS).collect()
}

/// The lines of a call, one for each scenario that runs; none if no one sees them.
#[derive(Debug)]
pub(crate) struct ProgressLines(Option<MultiProgress>);

/// The line of a run, which goes with it.
#[derive(Debug)]
pub(crate) struct RunProgress(Option<ProgressBar>);

impl ProgressLines {
    pub(crate) fn new(printer: &Printer) -> Self {
        Self(printer.is_interactive().then(MultiProgress::new))
    }

    /// A line of at most 80 columns: name, bar, share, time left.
    pub(crate) fn start_run(&self, setup: &RunSetup) -> RunProgress {
        let style = ProgressStyle::with_template("{prefix:28!} {bar:24} {percent:>3} %  {eta:>5} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = |bars: &MultiProgress| {
            let bar = setup.clock.steps.map_or_else(ProgressBar::no_length, ProgressBar::new);
            bars.add(bar.with_style(style).with_prefix(setup.scenario.name.clone()))
        };
        RunProgress(self.0.as_ref().map(bar))
    }

    /// The line of a sweep with so many cases.
    pub(crate) fn start_cases(&self, name: &str, cases: u64) -> RunProgress {
        let bar = |bars: &MultiProgress| {
            bars.add(ProgressBar::new(cases).with_style(style_of_cases()).with_prefix(name.to_owned()))
        };
        RunProgress(self.0.as_ref().map(bar))
    }

    /// Prints while the lines are away.
    pub(crate) fn suspended(&self, print: impl FnOnce()) {
        match &self.0 {
            Some(bars) => bars.suspend(print),
            None => print(),
        }
    }
}

fn style_of_cases() -> ProgressStyle {
    ProgressStyle::with_template("{prefix:20!} {bar:18} {pos}/{len} cases {eta:>5} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
}

impl RunProgress {
    /// A run is so far; its cases, if it has some, have the line after its steps.
    pub(crate) fn stage(&self, stage: RunStage) {
        match stage {
            RunStage::Steps(steps) => self.steps(steps),
            RunStage::Cases { ran, of } => {
                if let Some(bar) = &self.0 {
                    bar.set_style(style_of_cases());
                    bar.set_length(of);
                    bar.set_position(ran);
                }
            }
        }
    }

    /// So many cases have run.
    pub(crate) fn cases(&self, ran: u64) {
        self.0.iter().for_each(|bar| bar.set_position(ran));
    }

    /// So many steps are done.
    pub(crate) fn steps(&self, steps: u64) {
        if let Some(bar) = self.0.as_ref().filter(|_| steps.is_multiple_of(STEPS_A_TICK)) {
            bar.set_position(steps);
        }
    }
}

impl Drop for RunProgress {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}
