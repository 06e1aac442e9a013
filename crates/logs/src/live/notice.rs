//! What happens to a stream beside its messages.

/// What happens to a stream beside its messages.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum LiveNotice {
    /// A line is no message and was left out.
    BadLine {
        /// Its number, from 1.
        line: u64,
        /// What is wrong with it.
        message: String,
        /// How it begins.
        text: String,
    },
    /// The connection is lost; it is tried again until it is there.
    ConnectionLost {
        /// Why.
        message: String,
    },
    /// A lost connection is there again.
    ConnectedAgain {
        /// How often it was tried.
        attempts: u32,
    },
    /// A topic that was not there when it was found out what is judged.
    LateTopic {
        /// Its name.
        topic: String,
    },
    /// The queue was full, and the sender does not wait: these samples were not judged.
    SamplesLost {
        /// How many.
        samples: u64,
    },
}
