//! Where the lines about a stream go, and what is counted of it.

use std::{cell::RefCell, io, rc::Rc};

use congruent_logs::{JointRowCounts, LiveNotice};
use congruent_results::report::RunReport;

use super::{
    latency::Latency,
    line::{
        BadLineFound, ConnectedAgain, LeftOutLater, LossCause, StreamCounts, StreamLoss, WatchEnd, WatchLine,
    },
};

/// Writes a line; it is not held back.
pub type WriteLine = Box<dyn FnMut(&WatchLine) -> io::Result<()>>;

/// The lines about a stream. Its samples and what happens beside them are said by different parts of a run.
pub struct WatchOutput {
    write: WriteLine,
    /// Why a line could not be written.
    broken: Option<io::Error>,
    pub(super) latency: Latency,
    bad_lines: u64,
    lost_samples: u64,
    lost_connections: u64,
    pub(super) gaps: u64,
    /// Time in the stream of the last sample, s.
    pub(super) time_s: f64,
}

/// The output of a run, in its hands and in those of the stream.
pub type SharedOutput = Rc<RefCell<WatchOutput>>;

impl std::fmt::Debug for WatchOutput {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("WatchOutput").field("broken", &self.broken).finish_non_exhaustive()
    }
}

impl WatchOutput {
    /// An output that writes by `write`.
    pub fn shared(write: WriteLine) -> SharedOutput {
        Rc::new(RefCell::new(Self {
            write,
            broken: None,
            latency: Latency::default(),
            bad_lines: 0,
            lost_samples: 0,
            lost_connections: 0,
            gaps: 0,
            time_s: f64::NAN,
        }))
    }

    /// Writes a line. An error is kept: it ends the run at its next sample.
    pub fn say(&mut self, line: &WatchLine) {
        if self.broken.is_none() {
            self.broken = (self.write)(line).err();
        }
    }

    /// Time in the stream of the last sample, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Why a line could not be written.
    pub fn broken(&self) -> Option<&io::Error> {
        self.broken.as_ref()
    }

    /// Counts what happens to a stream, and says it.
    pub fn notice(&mut self, notice: LiveNotice) {
        let line = match notice {
            LiveNotice::BadLine { line, message, text } => {
                self.bad_lines += 1;
                WatchLine::BadLine(BadLineFound { line, message, text })
            }
            LiveNotice::ConnectionLost { message } => {
                self.lost_connections += 1;
                WatchLine::Lost(StreamLoss { what: LossCause::Connection, message, samples: 0 })
            }
            LiveNotice::SamplesLost { samples } => {
                self.lost_samples += samples;
                let message = "the checks are slower than the stream".to_owned();
                WatchLine::Lost(StreamLoss { what: LossCause::Samples, message, samples })
            }
            LiveNotice::LateTopic { topic } => WatchLine::LeftOut(LeftOutLater {
                message: format!(
                    "poses of \"{topic}\" began when it was settled what is judged; send them from the first line on"
                ),
            }),
            LiveNotice::ConnectedAgain { attempts } => WatchLine::ConnectedAgain(ConnectedAgain { attempts }),
            _ => return,
        };
        self.say(&line);
    }

    /// The last line.
    pub fn end(&self, report: RunReport, rows: JointRowCounts) -> WatchEnd {
        WatchEnd {
            verdict: report.verdict,
            exit_code: report.exit_code,
            counts: StreamCounts {
                samples: rows.rows,
                left_out: rows.incomplete,
                repeated: rows.repeated,
                late: rows.late,
                without_positions: rows.without_positions,
                gaps: self.gaps,
                restarts: rows.restarts,
                bad_lines: self.bad_lines,
                lost_samples: self.lost_samples,
                lost_connections: self.lost_connections,
            },
            latency: self.latency.report(),
            report,
        }
    }
}
