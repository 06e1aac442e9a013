//! Messages of ROS 2 to events, whatever file they were recorded in: the topics of a log, and what is decoded of each message.

mod events;
mod topics;

pub(crate) use events::MessageEvents;
