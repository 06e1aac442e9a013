//! `congruent describe`: what a robot's files say, and what is in a log.

use std::path::{Path, PathBuf};

use congruent::{
    analysis::description_summary::{DescriptionSummary, JointOrders, describe, joint_orders},
    description::{RobotDescription, load_robot_with},
    input::Diagnostic,
    logs::{LogOptions, LogSurvey, SurveyedLog, is_log, is_table, survey_line, survey_log},
    results::report::{TestResult, TestSuite},
    text::{description_text, joint_orders_text, log_text},
};
use serde::Serialize;

use crate::{
    batch::{Batch, BatchReport},
    ci::CiArguments,
    codes,
    failure::Failure,
    input::{AccessArguments, ChainArguments},
    terminal::print::{Printer, text_options},
};

/// Summarises a robot's files: links, joints, and what is missing for kinematics, clearance or physics; or a log.
///
/// The tree with types, axes, limits, masses and shapes; the chain from base to tip, and other links at which it might
/// end; what blocks kinematics, clearance or physics, and which missing data they do without.
///
/// Of a log (MCAP, folder of rosbag2, table in CSV or Parquet, dataset of LeRobot): topics with rates, gaps
/// and repetitions, joints, missing values and frames; with --robot whether joints and units fit.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Folders with robot.toml, robot files, URDFs, MJCFs, or - for a URDF or MJCF on standard input; logs: .mcap, .csv,
    /// .parquet, folders of rosbag2 or LeRobot.
    #[arg(required = true, value_name = "ROBOT_OR_LOG")]
    inputs: Vec<PathBuf>,
    /// Compare the joints and units of logs with this robot: a folder with robot.toml, a robot file, a URDF or an MJCF.
    #[arg(long, value_name = "ROBOT")]
    robot: Option<PathBuf>,
    /// Rate of the rows of tables whose times are missing or too coarse, Hz.
    #[arg(long, value_name = "HZ", value_parser = crate::quantity::rate_hz)]
    rate_hz: Option<f64>,
    /// The episode of a dataset of LeRobot that is read alone, by its index; by default all, one after the other.
    #[arg(long, value_name = "INDEX")]
    episode: Option<u64>,
    /// Print the moving joints in the orders in which programs list them instead: the order of the file, depth first (MuJoCo) and
    /// breadth first (Isaac Sim, Isaac Lab), and where these differ.
    #[arg(long)]
    orders: bool,
    #[command(flatten)]
    chain: ChainArguments,
    #[command(flatten)]
    access: AccessArguments,
}

/// What one input is.
#[derive(Serialize)]
#[serde(untagged)]
enum Described {
    /// A robot.
    Robot(Box<DescriptionSummary>),
    /// A log.
    Log(Box<LogSurvey>),
}

impl BatchReport for Described {
    fn exit_code(&self) -> u8 {
        0
    }

    fn text(&self) -> String {
        match self {
            Self::Robot(summary) => description_text(summary),
            Self::Log(survey) => log_text(survey, &text_options()),
        }
    }

    fn one_line(&self) -> Option<String> {
        Some(match self {
            Self::Robot(summary) => format!("{}: {}", summary.file, summary.answer()),
            Self::Log(survey) => format!("{}: {}", survey.file, survey_line(survey)),
        })
    }

    fn test_suite(&self, input: &str) -> TestSuite {
        TestSuite::with_case(input, "describe", TestResult::Passed)
    }
}

impl BatchReport for JointOrders {
    fn exit_code(&self) -> u8 {
        0
    }

    fn text(&self) -> String {
        joint_orders_text(self, &text_options())
    }

    fn test_suite(&self, input: &str) -> TestSuite {
        TestSuite::with_case(input, "describe", TestResult::Passed)
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let ci = CiArguments::default();
    if let Some(refused) = unfit_option(arguments) {
        return Err(refused.into());
    }
    let batch = Batch::begin(&arguments.inputs, &ci, printer)?;
    let loaded = |path: &Path| {
        let description = arguments.chain.of(load_robot_with(path, &arguments.access.access()?)?)?;
        batch.warn(path, &description.warnings);
        Ok::<_, Failure>(description)
    };
    let inputs = arguments.inputs.iter();
    if arguments.orders {
        let orders = |path: &Path| Ok(joint_orders(&loaded(path)?));
        return batch.finish(inputs.map(|path| batch.answer(path, || orders(path))).collect());
    }
    let robot = arguments.robot.as_deref().map(&loaded).transpose()?;
    let described = |path: &Path| {
        if !is_log(path) {
            return Ok(Described::Robot(Box::new(describe(&loaded(path)?))));
        }
        let SurveyedLog { survey, warnings } = surveyed(path, arguments, robot.as_ref())?;
        batch.warn(path, &warnings);
        Ok(Described::Log(Box::new(survey)))
    };
    batch.finish(inputs.map(|path| batch.answer(path, || described(path))).collect())
}

/// An option that would be ignored.
fn unfit_option(arguments: &Arguments) -> Option<Diagnostic> {
    let Arguments { inputs, robot, rate_hz, episode, orders, .. } = arguments;
    let any = |is_one: fn(&Path) -> bool| inputs.iter().find(|path| is_one(path));
    let (log, table) = (any(is_log), any(is_table));
    let refused = |message: String, help: &str| {
        Some(Diagnostic::error(codes::describe::OPTION, message).with_help(help))
    };
    match log {
        Some(log) if *orders => {
            let message = format!("--orders lists the joints of robots, and {} is a log", log.display());
            refused(message, "leave --orders out, or give the robot alone")
        }
        None if robot.is_some() => {
            let message = "--robot is what logs are compared with, and no input is a log".to_owned();
            refused(message, "give a log beside --robot, or the robot without the option")
        }
        None if episode.is_some() => {
            let message = "--episode is of a dataset, and no input is a log".to_owned();
            refused(message, "leave --episode out")
        }
        _ if rate_hz.is_some() && table.is_none() => {
            let message = "--rate-hz is the rate of the rows of tables, and no input is a table".to_owned();
            refused(message, "leave --rate-hz out: an MCAP has the times of its messages")
        }
        _ => None,
    }
}

fn surveyed(
    path: &Path,
    arguments: &Arguments,
    robot: Option<&RobotDescription>,
) -> Result<SurveyedLog, Failure> {
    let options = LogOptions { rate_hz: arguments.rate_hz, episode: arguments.episode, joints: Vec::new() };
    Ok(survey_log(path, &options, robot.map(|description| &description.robot))?)
}
