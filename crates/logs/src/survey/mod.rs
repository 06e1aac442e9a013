//! What is in a log: one pass over it, in memory that does not grow with its length.

mod clock;
mod description;
mod findings;
mod frames;
mod joints;
mod limits;
mod names;
mod pass;
mod report;
mod robot;
mod spacing;
mod topic;
mod utc;
mod words;

pub(crate) use pass::survey_events;
pub use pass::{SurveyedLog, survey_log};
pub use report::{
    ClockKind, FramePair, GapsSurvey, JointLimitsSurvey, JointSource, JointsSurvey, LogSurvey, LoggedJoint,
    MissingShares, PositionUnit, RobotInLog, RobotOfLog, TopicSurvey, TopicTimes, UndecodedMessages,
    UnknownJoint,
};
pub use words::{SurveyWords, survey_line, survey_words};
