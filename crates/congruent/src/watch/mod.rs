//! A stream of the real robot against the checks of a run, while it comes: `congruent watch`. It observes and answers, and sends
//! nothing to a robot.

mod check_states;
mod latency;
mod line;
mod observer;
mod output;
mod setup;
mod text;

pub use latency::LatencyReport;
pub use line::{
    BadLineFound, CheckChange, ComparedStream, ConnectedAgain, GapCause, LeftOutLater, LossCause,
    RecordingFull, StreamCounts, StreamGap, StreamLoss, WatchEnd, WatchLine, WatchStart, WatchedPose,
};
pub use observer::{Observation, WatchObserver};
pub use output::{SharedOutput, WatchOutput, WriteLine};
pub use setup::{WatchRequest, WatchSetup};
pub use text::watch_text;
