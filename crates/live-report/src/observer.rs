//! Answers each sample of a stream: its pose, checks that change, gaps.

use congruent_description::RobotDescription;
use congruent_logs::{ArrivalClock, EventTime};
use congruent_monitors::{Interruption, Names, RecordingError, RunningCheck, Sample};
use congruent_twin::{RunObserver, source::StreamProgress};
use nalgebra::Isometry3;

use super::{
    check_states::CheckStates,
    line::{GapCause, StreamGap, WatchLine, WatchedPose},
    output::SharedOutput,
};

/// The frame of a TCP that is no link. In a stream a frame that is no link is taken as the TCP as well.
const TCP: &str = "tcp";
/// Rounding of times, s.
const ROUNDING_S: f64 = 1e-9;

/// What an observer looks at, and where it answers.
pub struct Observation {
    /// Where the lines go.
    pub output: SharedOutput,
    /// How far the stream has come.
    pub state: StreamProgress,
    /// The clock by which its messages come.
    pub clock: ArrivalClock,
    /// Whether the pose of the TCP is said, and its largest rate, Hz; 0 for each sample.
    pub pose_rate_hz: Option<f64>,
}

/// Answers the samples of a stream.
pub struct WatchObserver<'a> {
    observation: Observation,
    description: &'a RobotDescription,
    checks: CheckStates,
    /// Time in the stream of the sample before.
    before_s: f64,
    /// Time of the run at which the next pose is due.
    pose_due_s: f64,
    /// Messages that came before the run began are no measure of how fast it answers.
    begun_ns: i64,
}

impl<'a> WatchObserver<'a> {
    /// An observer of a run that begins now.
    pub fn new(observation: Observation, description: &'a RobotDescription) -> Self {
        Self {
            begun_ns: observation.clock.now_ns(),
            observation,
            description,
            checks: CheckStates::default(),
            before_s: f64::NAN,
            pose_due_s: f64::NEG_INFINITY,
        }
    }

    fn pose(&mut self, time_s: f64, sample: &Sample<'_>) -> Option<WatchLine> {
        let rate_hz = self.observation.pose_rate_hz?;
        if sample.time_s + ROUNDING_S < self.pose_due_s {
            return None;
        }
        if rate_hz > 0.0 {
            // From the time that was due, so that the mean rate is the wanted one; not from one long ago, as before a gap.
            let next_s = self.pose_due_s + 1.0 / rate_hz;
            self.pose_due_s = if next_s > sample.time_s { next_s } else { sample.time_s + 1.0 / rate_hz };
        }
        let RobotDescription { robot, base, tip, tip_from_tcp, .. } = self.description;
        let root_from_tcp = sample.twin[tip.get()] * tip_from_tcp.unwrap_or_else(Isometry3::identity);
        let base_from_tcp = sample.twin[base.get()].inverse() * root_from_tcp;
        let rotation = base_from_tcp.rotation.quaternion();
        let wxyz = [rotation.w, rotation.i, rotation.j, rotation.k];
        let is_negative = wxyz.iter().find(|part| **part != 0.0).is_some_and(|part| *part < 0.0);
        Some(WatchLine::Pose(WatchedPose {
            time_s,
            frame: robot.link(*base).name.clone(),
            child: if tip_from_tcp.is_some() { TCP.to_owned() } else { robot.link(*tip).name.clone() },
            translation_m: base_from_tcp.translation.vector.into(),
            quaternion_wxyz: if is_negative { wxyz.map(|part| -part) } else { wxyz },
        }))
    }

    fn gap(&self, time_s: f64, sample: &Sample<'_>) -> Option<WatchLine> {
        let cause = match sample.interruption? {
            Interruption::Gap => GapCause::NoSamples,
            Interruption::NewPart => GapCause::ClockWentBack,
        };
        Some(WatchLine::Gap(StreamGap { from_s: self.before_s, to_s: time_s, cause }))
    }
}

/// The time of a message by its sender, s.
fn time_s(EventTime { stamp_ns, log_ns, .. }: EventTime) -> f64 {
    let ns = stamp_ns.unwrap_or(log_ns);
    #[expect(
        clippy::cast_precision_loss,
        reason = "the number that the sender has written, to its last digit"
    )]
    let time_s = ns as f64 / 1e9;
    time_s
}

impl RunObserver for WatchObserver<'_> {
    fn observe(
        &mut self,
        sample: &mut Sample<'_>,
        checks: &[RunningCheck<'_>],
        names: &Names,
    ) -> Result<(), RecordingError> {
        let message = self.observation.state.get().message;
        let time_s = time_s(message);
        let gap = self.gap(time_s, sample);
        let pose = self.pose(time_s, sample);
        let changes = self.checks.changes(time_s, sample, checks, names);
        self.before_s = time_s;
        let mut output = self.observation.output.borrow_mut();
        output.time_s = time_s;
        output.gaps += u64::from(gap.is_some());
        gap.iter().chain(&pose).chain(&changes).for_each(|line| output.say(line));
        if message.log_ns > self.begun_ns {
            let age_ns = self.observation.clock.age_ns(message.log_ns);
            output.latency.take(std::time::Duration::from_nanos(age_ns).as_secs_f64());
        }
        output.broken().map_or(Ok(()), |error| Err(RecordingError { message: error.to_string() }))
    }
}
