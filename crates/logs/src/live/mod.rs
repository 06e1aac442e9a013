//! Streams that come while they are read: a thread reads and puts what has come into a bounded queue, so that nothing is lost while a
//! check is slow; a [`LiveReader`] takes it out as the events of a log. Nothing here sends a command to a robot.

mod arrival;
mod head;
mod lines;
mod notice;
mod queue;
mod reader;

pub use arrival::ArrivalClock;
pub use head::{HeadRate, survey_head};
pub use lines::listen_to_lines;
pub use notice::LiveNotice;
pub use reader::{LiveReader, OnNotice};

pub(crate) use queue::{Closed, LiveQueue};
