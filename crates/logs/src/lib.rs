//! Recorded joint states and poses of robots, from MCAP, SQLite bags, CSV, Parquet, JSON Lines and datasets of LeRobot, those that come as a
//! stream, and a survey of what a log has.
//!
//! A log is read once, from its beginning to its end, in memory that does not grow with it: [`open_log`] gives its events, [`LogStream`] rows of all joints in the order of time,
//! [`survey_log`] says what is in it, [`LiveReader`] is a log that has no end yet, [`recorded_description`] which robot was recorded. Nothing here compares a log with a model.

mod cdr;
pub mod codes;
mod csv;
mod db3;
mod descriptions;
mod event;
mod json_lines;
mod live;
mod mcap;
mod messages;
mod open;
mod options;
mod parquet;
mod recorded_description;
mod rtde;
mod stream;
mod survey;
mod table;
mod table_reading;
mod tcp_pose;
mod written;

pub use event::{
    EventTime, LogEvent, LogFormat, LogGap, LogReader, LogTopic, LoggedDescription, LoggedJoints, LoggedPose,
    OtherMessage, TopicContent,
};
pub use live::{ArrivalClock, HeadRate, LiveNotice, LiveReader, OnNotice, listen_to_lines, survey_head};
pub use open::{is_log, is_table, open_log};
pub use options::LogOptions;
pub use recorded_description::{RecordedDescription, recorded_description};
pub use rtde::{RTDE_JOINTS, RTDE_PORT, RtdeOptions, listen_to_rtde};
pub use stream::{
    JointRow, JointRowCounts, LogStream, PoseCounts, SelectedJoint, SelectedJoints, SelectedPoses,
    StreamEvent, StreamSelection, StreamedPose,
};
pub use survey::{
    ClockKind, FramePair, GapsSurvey, JointLimitsSurvey, JointSource, JointsSurvey, LogSurvey, LoggedJoint,
    MissingShares, PositionUnit, RobotInLog, RobotOfLog, SurveyWords, SurveyedLog, TopicSurvey, TopicTimes,
    UndecodedMessages, UnknownJoint, survey_line, survey_log, survey_words,
};
pub use table_reading::{
    DecimalMark, LoggedQuantity, Preset, Separator, TableColumn, TableEncoding, TableEpisodes, TableReading,
    TableText, TableTime, TimeUnit, TimeUnitFrom,
};

pub use written::{
    DiagnosticLevel, JointTopic, LogWriteError, LogWriter, WrittenDiagnostic, WrittenEdge, WrittenJoints,
};

#[cfg(test)]
mod mutation_tests;
