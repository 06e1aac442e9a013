//! How far a stream has come: who answers it reads what the source writes after each sample.

use std::{cell::Cell, rc::Rc};

use congruent_logs::{EventTime, JointRowCounts};

/// How far a stream has come.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StreamPosition {
    /// The times of the message whose time the present sample has.
    pub message: EventTime,
    /// What became of the messages with joint states so far.
    pub counts: JointRowCounts,
}

/// The place where a source says how far its stream has come.
pub type StreamProgress = Rc<Cell<StreamPosition>>;
