//! From a robot and a log of it to an answer: a scenario that judges the log (`congruent replay`), and its parameters (`identify/`:
//! `congruent identify`, with the motion of `congruent plan`).

pub mod codes;
mod draft;
mod fitted;
pub mod identify;
mod paired;
mod pose_cause;
mod pose_fit;
mod poses;
mod replayed;
mod request;
mod survey_words;
mod written;

pub use draft::{ReplayDraft, in_folder, replay_draft, stream_draft};
pub use pose_cause::explain_recorded;
pub use request::ReplayRequest;
pub use survey_words::LEFT_OUT;
pub use written::replay_text;
