//! What a person says of a log that is replayed.

use congruent_scenario::{LogClock, PoseOrigin};

/// What a person says of a log beside its name.
#[derive(Debug, Clone, Default)]
pub struct ReplayRequest {
    /// The clock of its messages.
    pub clock: Option<LogClock>,
    /// Rate of the rows of a table without times.
    pub rate_hz: Option<f64>,
    /// The index of the episode of a dataset that is judged alone.
    pub episode: Option<u64>,
    /// Whether the positions of joints that turn are degrees.
    pub degrees: bool,
    /// The topic of the measured joint states, if several have them.
    pub joints: Option<String>,
    /// The topic of the commanded joint states.
    pub setpoint: Option<String>,
    /// Where the poses of a topic come from.
    pub poses: Vec<(String, PoseOrigin)>,
}
