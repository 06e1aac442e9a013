//! The arguments of `congruent watch`.

use std::path::PathBuf;

use congruent::{
    description::{JointKind, RobotDescription},
    input::Diagnostic,
    logs::{RTDE_JOINTS, RtdeOptions},
    replay::ReplayRequest,
    watch::WatchRequest,
};

use crate::{codes, input::AccessArguments};

/// Rate of RTDE if none is given, Hz: every controller has it.
const RTDE_RATE_HZ: f64 = 125.0;

/// Judges a stream of the real robot while it comes: a line for each violation at once, and the verdict at the end.
///
/// The stream is JSON Lines on standard input, or RTDE of a robot of Universal Robots. It is judged as `replay` judges a
/// log, by the checks of a scenario with `[source]` or by those that its first 0.5 s allow. Watch observes and answers; it
/// never commands a robot. With `--format json` each line of the answer is a JSON document. The end of the stream, Ctrl-C or
/// SIGTERM end the run in order, with its verdict. Exit code 1 if a check fails.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// A folder with robot.toml, a robot file, a URDF or an MJCF.
    pub(super) robot: PathBuf,
    /// Use the checks, obstacles and zones of this scenario. It has `[source]`, whose log the stream replaces, and its robot is
    /// replaced by ROBOT.
    #[arg(long, value_name = "FILE")]
    scenario: Option<PathBuf>,
    /// Listen to the controller of a robot of Universal Robots, by RTDE, instead of standard input. A lost connection is
    /// opened again.
    #[arg(long, value_name = "HOST[:PORT]")]
    pub(super) rtde: Option<String>,
    /// Rate of the stream, Hz; it is then judged from its first message on. It is the rate that RTDE is asked for, 125 by
    /// default.
    #[arg(long, value_name = "HZ", value_parser = crate::quantity::rate_hz)]
    rate_hz: Option<f64>,
    /// Positions and velocities of joints that turn are in degrees.
    #[arg(long)]
    degrees: bool,
    /// End at the first violation, with exit code 1.
    #[arg(long)]
    until_violation: bool,
    #[command(flatten)]
    poses: PoseArguments,
    /// Folder for report, page and JUnit; without it nothing is written.
    #[arg(long)]
    pub(super) out: Option<PathBuf>,
    #[cfg(feature = "recording")]
    #[command(flatten)]
    pub(super) recording: super::recording::RecordingArguments,
    #[command(flatten)]
    pub(super) access: AccessArguments,
}

/// Which poses are said.
#[derive(Debug, clap::Args)]
struct PoseArguments {
    /// Also say the pose of the TCP at each sample.
    #[arg(long)]
    poses: bool,
    /// Say at most so many poses in a second.
    #[arg(long, value_name = "HZ", requires = "poses", value_parser = crate::quantity::rate_hz)]
    output_rate_hz: Option<f64>,
}

impl Arguments {
    /// What is said of the stream.
    pub(super) fn request(&self) -> WatchRequest {
        let source = self.rtde.as_ref().map_or("standard input".to_owned(), |host| format!("RTDE of {host}"));
        let is_rtde = self.rtde.is_some();
        let rate_hz = self.rate_hz.or(is_rtde.then_some(RTDE_RATE_HZ));
        WatchRequest {
            source,
            replay: ReplayRequest { rate_hz, degrees: self.degrees, ..ReplayRequest::default() },
            scenario: self.scenario.clone(),
            is_until_violation: self.until_violation,
        }
    }

    /// The rate of poses; 0 for each sample, `None` for none.
    pub(super) fn pose_rate_hz(&self) -> Option<f64> {
        self.poses.poses.then(|| self.poses.output_rate_hz.unwrap_or(0.0))
    }

    /// What is asked of a controller at this address, of a robot with six joints.
    pub(super) fn rtde_options(
        &self,
        address: &str,
        description: &RobotDescription,
    ) -> Result<RtdeOptions, Diagnostic> {
        let robot = &description.robot;
        let chain = robot.chain(description.base, description.tip).unwrap_or_default();
        let joints = chain.into_iter().map(|joint| robot.joint(joint));
        let moving = joints.filter(|joint| joint.kind != JointKind::Fixed && joint.mimic.is_none());
        let names: Vec<String> = moving.map(|joint| joint.name.clone()).collect();
        let found = names.len();
        let joints = names.try_into().map_err(|_| {
            let message = format!(
                "{found} joints move from base to tip; a robot of Universal Robots has {RTDE_JOINTS}"
            );
            Diagnostic::error(codes::watch::JOINTS, message)
                .with_help("give a robot file whose base and tip are those of the arm")
        })?;
        let rate_hz = self.rate_hz.unwrap_or(RTDE_RATE_HZ);
        Ok(RtdeOptions { address: address.to_owned(), rate_hz, joints })
    }
}
