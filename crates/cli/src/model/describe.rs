//! `congruent describe`: what a robot's files say.

use std::path::{Path, PathBuf};

use congruent::{
    analysis::description_summary::{DescriptionSummary, JointOrders, describe, joint_orders},
    description::load_robot_with,
    results::report::{TestResult, TestSuite},
    text::{description_text, joint_orders_text},
};

use crate::{
    batch::{Batch, BatchReport},
    ci::CiArguments,
    failure::Failure,
    input::{AccessArguments, ChainArguments},
    terminal::print::{Printer, text_options},
};

/// Summarises a robot's files: links, joints, and what is missing for kinematics, clearance or physics.
///
/// The tree with types, axes, limits, masses and shapes; the chain from base to tip, and other links at which it might
/// end; what blocks kinematics, clearance or physics, and which missing data they do without.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Folders with robot.toml, robot files, URDFs, MJCFs, or - for a URDF or MJCF on standard input.
    #[arg(required = true)]
    robots: Vec<PathBuf>,
    /// Print the moving joints in the orders in which programs list them instead: the order of the file, depth first (MuJoCo) and
    /// breadth first (Isaac Sim, Isaac Lab), and where these differ.
    #[arg(long)]
    orders: bool,
    #[command(flatten)]
    chain: ChainArguments,
    #[command(flatten)]
    access: AccessArguments,
}

impl BatchReport for DescriptionSummary {
    fn exit_code(&self) -> u8 {
        0
    }

    fn text(&self) -> String {
        description_text(self)
    }

    fn one_line(&self) -> Option<String> {
        Some(format!("{}: {}", self.file, self.answer()))
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
    let batch = Batch::begin(&arguments.robots, &ci, printer)?;
    let loaded = |path: &Path| {
        let description = arguments.chain.of(load_robot_with(path, &arguments.access.access()?)?)?;
        batch.warn(path, &description.warnings);
        Ok::<_, Failure>(description)
    };
    let robots = arguments.robots.iter();
    if arguments.orders {
        let orders = |path: &Path| Ok(joint_orders(&loaded(path)?));
        return batch.finish(robots.map(|path| batch.answer(path, || orders(path))).collect());
    }
    let summary = |path: &Path| Ok(describe(&loaded(path)?));
    batch.finish(robots.map(|path| batch.answer(path, || summary(path))).collect())
}
