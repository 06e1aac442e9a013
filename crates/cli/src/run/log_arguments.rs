//! What a person says of a log beside its name: the same for every command that reads one.

use congruent::{replay::ReplayRequest, scenario::LogClock};

/// What is known of a log.
#[derive(Debug, clap::Args)]
pub(crate) struct LogArguments {
    /// The topic with the measured joint states, if several have the same joints.
    #[arg(long, value_name = "TOPIC")]
    joints: Option<String>,
    /// Positions and velocities of joints that turn are in degrees.
    #[arg(long)]
    degrees: bool,
    /// The time of a message: the stamp of its sender, or when the recorder had it. By default the stamp, where there is one.
    #[arg(long, value_enum)]
    clock: Option<StampChoice>,
    /// Rate of the rows of a table without times, Hz.
    #[arg(long, value_name = "HZ", value_parser = crate::quantity::rate_hz)]
    rate_hz: Option<f64>,
    /// The episode of a dataset of LeRobot that is read alone, by its index; by default all, one after the other.
    #[arg(long, value_name = "INDEX")]
    episode: Option<u64>,
}

/// The clock of the messages.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum StampChoice {
    /// The stamps of the senders.
    Stamp,
    /// The times of the recorder.
    Log,
}

impl LogArguments {
    /// The same for the library.
    pub(crate) fn request(&self) -> ReplayRequest {
        ReplayRequest {
            clock: self.clock.map(|clock| match clock {
                StampChoice::Stamp => LogClock::Stamp,
                StampChoice::Log => LogClock::Log,
            }),
            rate_hz: self.rate_hz,
            episode: self.episode,
            degrees: self.degrees,
            joints: self.joints.clone(),
            ..ReplayRequest::default()
        }
    }
}
