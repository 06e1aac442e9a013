//! A stream of the real robot against the checks of a run, while it comes: `congruent watch`. It observes and answers, and sends
//! nothing to a robot.

mod setup;

pub use congruent_live_report::{
    BadLineFound, CheckChange, ComparedStream, ConnectedAgain, GapCause, LatencyReport, LeftOutLater,
    LossCause, Observation, RecordingFull, SharedOutput, StreamCounts, StreamGap, StreamLoss, WatchEnd,
    WatchLine, WatchObserver, WatchOutput, WatchStart, WatchedPose, WriteLine,
};
pub use congruent_text::watch_text;
pub use setup::{WatchRequest, WatchSetup};
