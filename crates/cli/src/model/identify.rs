//! `congruent identify`: friction, masses and torque constants of a robot from a log.

#![expect(clippy::doc_markdown, reason = "the comments are printed as help, where backticks are noise")]

use std::path::PathBuf;

use congruent::{
    identification::{EffortKind, FreeGroup, report::IdentificationVerdict},
    identify::{IdentifiedLog, IdentifyRequest, identify_log},
    input::Capability,
    nalgebra::Vector3,
    text::identification_text,
};

use crate::{
    failure::{FAILED, Failure},
    input::{ArmArguments, files_of},
    output::file::NewFile,
    run::log_arguments::LogArguments,
    terminal::{print::Printer, progress::waiting},
};

/// Friction, armature, payload, masses and torque constants of a robot from a log of its joint positions and efforts.
///
/// What the efforts are (torques, torques without gravity, currents) is recognised by the masses of the description. Each value has a
/// standard error; what the log cannot show apart is said. Whether the values are better is decided on data that they were not estimated
/// from: each fifth of the time by the other four. Then the lines to write are printed: of the URDF or MJCF, of robot.toml
/// and of a scenario. Exit code 1 if they are not better.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// The log: an MCAP, a folder that rosbag2 wrote, a table in CSV or Parquet, or a dataset of LeRobot.
    log: PathBuf,
    /// What is estimated, beside a constant effort of each joint.
    #[arg(long, value_delimiter = ',', value_enum, default_values = ["friction", "armature"])]
    free: Vec<FreeArgument>,
    /// The link that carries the payload, in whose frame it is reported; by default the TCP.
    #[arg(long, value_name = "LINK")]
    payload_at: Option<String>,
    /// What the efforts of the log are; by default that is recognised.
    #[arg(long, value_enum, value_name = "KIND")]
    effort: Option<Kind>,
    /// Torque of a joint for a unit of its effort, of currents: elbow_joint=9.2. May be given several times.
    #[arg(long, value_name = "JOINT=VALUE", value_parser = constant)]
    torque_constant: Vec<(String, f64)>,
    /// Take the instants at which the robot is at rest: masses and centres by gravity alone.
    #[arg(long)]
    still: bool,
    /// Rows within this time before and after an instant are smoothed, ms; by default chosen by the noise of the positions.
    #[arg(long, value_name = "MS", value_parser = window_ms)]
    window_ms: Option<f64>,
    /// Gravity in the root link, m/s^2, of a robot that does not stand upright: 0,9.81,0.
    #[arg(long, value_name = "X,Y,Z", value_parser = gravity, allow_hyphen_values = true)]
    gravity: Option<[f64; 3]>,
    /// Write the URDF or MJCF with what was identified to this file.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace the file of --out.
    #[arg(long, requires = "out")]
    force: bool,
    #[command(flatten)]
    of_log: LogArguments,
}

/// A group of parameters.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub(super) enum FreeArgument {
    /// Viscous and Coulomb friction of each joint.
    Friction,
    /// Inertia of motor and gear of each joint.
    Armature,
    /// A body that the description does not have.
    Payload,
    /// Masses, centres and inertias of all links.
    Links,
}

impl FreeArgument {
    pub(super) fn of_library(self) -> FreeGroup {
        match self {
            Self::Friction => FreeGroup::Friction,
            Self::Armature => FreeGroup::Armature,
            Self::Payload => FreeGroup::Payload,
            Self::Links => FreeGroup::Links,
        }
    }
}

/// What efforts are.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Kind {
    /// Torques and forces, N m and N.
    Torque,
    /// The same without those of gravity.
    TorqueWithoutGravity,
    /// Currents of the motors.
    Current,
}

fn constant(text: &str) -> Result<(String, f64), String> {
    let wrong = || format!("\"{text}\" is not JOINT=VALUE, as in elbow_joint=9.2");
    let (joint, value) = text.split_once('=').ok_or_else(wrong)?;
    let value: f64 = value.trim().parse().map_err(|_| wrong())?;
    // A negative one is a current that counts the other way.
    if joint.is_empty() || !value.is_finite() || value == 0.0 {
        return Err(wrong());
    }
    Ok((joint.trim().to_owned(), value))
}

fn window_ms(text: &str) -> Result<f64, String> {
    let value = text.trim_end_matches("ms").trim().parse().ok();
    let is_usable = |value: &f64| (0.1..=2000.0).contains(value);
    value.filter(is_usable).ok_or_else(|| format!("\"{text}\" is no time from 0.1 to 2000 ms"))
}

fn gravity(text: &str) -> Result<[f64; 3], String> {
    let parts: Vec<f64> = text.split(',').filter_map(|part| part.trim().parse().ok()).collect();
    let gravity = <[f64; 3]>::try_from(parts).ok().filter(|of| of.iter().all(|value| value.is_finite()));
    gravity.ok_or_else(|| format!("\"{text}\" is not three numbers in m/s^2, as in 0,0,-9.81"))
}

impl Arguments {
    fn request(&self) -> IdentifyRequest {
        IdentifyRequest {
            log: self.of_log.request(),
            free: self.free.iter().map(|group| group.of_library()).collect(),
            payload_at: self.payload_at.clone(),
            effort: self.effort.map(|kind| match kind {
                Kind::Torque => EffortKind::Torque,
                Kind::TorqueWithoutGravity => EffortKind::TorqueWithoutGravity,
                Kind::Current => EffortKind::Current,
            }),
            torque_constants: self.torque_constant.iter().cloned().collect(),
            is_still: self.still,
            half_window_s: self.window_ms.map(|window_ms| window_ms / 1000.0),
            gravity_m_s2: self.gravity.map(Vector3::from),
        }
    }

    fn out(&self) -> Option<NewFile<'_>> {
        self.out.as_ref().map(|path| NewFile { option: "--out", path, force: self.force })
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.arm.load_for(Capability::Physics, printer)?;
    let mut inputs = files_of(&description);
    inputs.push(arguments.log.clone());
    if let Some(out) = arguments.out() {
        out.may_be_written(&inputs)?;
    }
    let identified =
        waiting(printer, "identifying", || identify_log(&description, &arguments.log, &arguments.request()))?;
    let IdentifiedLog { mut report, edited, taken } = identified;
    printer.notes(taken.iter().map(String::as_str));
    if let (Some(out), Some(text)) = (arguments.out(), edited) {
        out.write(&text, &inputs, |_| Ok(()))?;
        report.written.push(out.path.display().to_string());
    }
    printer.result(&report, identification_text)?;
    Ok(if report.verdict == IdentificationVerdict::Better { 0 } else { FAILED })
}
