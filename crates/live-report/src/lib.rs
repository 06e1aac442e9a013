//! What is said of a stream while it is judged: a [`WatchLine`] for each violation, gap and loss at once, poses on request, and the
//! verdict at the end. Nothing here reads a stream or sends anything to a robot.

mod check_states;
mod latency;
mod line;
mod observer;
mod output;

pub use latency::LatencyReport;
pub use line::{
    BadLineFound, CheckChange, ComparedStream, ConnectedAgain, GapCause, LeftOutLater, LossCause,
    RecordingFull, StreamCounts, StreamGap, StreamLoss, WatchEnd, WatchLine, WatchStart, WatchedPose,
};
pub use observer::{Observation, WatchObserver};
pub use output::{SharedOutput, WatchOutput, WriteLine};
