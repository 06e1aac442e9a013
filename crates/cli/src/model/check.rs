//! `congruent check`: compares model, URDF and physics.

use std::{
    iter::{empty, once, once_with},
    path::{Path, PathBuf},
};

use congruent::{
    RobotCheck,
    agreement::compare::{Agreement, CheckOptions},
    analysis::plot::errors,
    check_suite, checked_robot,
    description::{Diagnostic, RobotDescription, RobotQList, Severity, load_robot_with, read_configurations},
    page::{CheckEntry, check_page},
    twin::report::TestSuite,
};

use serde::{Serialize, Serializer};

use super::{
    check_text::{basics, compared_text, explained_text},
    errors_at::{chart, lines, table},
    tolerance::ToleranceArgument,
};
use crate::{
    batch::{Answer, Batch, BatchReport, Parts},
    ci::CiArguments,
    failure::{FAILED, Failure, NOTHING},
    input::{AccessArguments, ChainArguments, files_of},
    output::{file::refuse_same, page::PageArgument, plot::PlotArgument},
    terminal::{print::Printer, progress::waiting, text::shown},
};

/// Whether a robot's table, its URDF and its physics twin are the same robot, in geometry and in dynamics.
///
/// Poses are compared at zero, one axis at a time, at 200 seeded random configurations within the limits,
/// at the limits, and at the worst configurations of the certificates. Dynamics, which is masses, centres of mass, inertias,
/// damping, friction, gravity and limits, is compared with the physics, which is probed as a black box, and with the
/// `[[inertial]]` entries of robot.toml, or with the URDF of --against: torques at 100 random states may differ by 1e-10 of
/// themselves between two descriptions and by 1e-8 between a description and the physics, which is rounding. Exit code 1 if they disagree, 4 if
/// there is neither a table nor a robot that can be simulated, so that nothing was compared.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Folders with robot.toml, robot files, bare .urdf files, or - for a URDF on standard input.
    #[arg(required = true)]
    robots: Vec<PathBuf>,
    /// Compare the URDF with that of another description of the robot as well, in geometry and, if it is the same chain
    /// within the tolerance, in dynamics: a folder with robot.toml, a robot file, or a bare .urdf.
    #[arg(long, value_name = "ROBOT")]
    against: Option<PathBuf>,
    #[command(flatten)]
    chain: ChainArguments,
    /// Seed of the random configurations.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Compare at the configurations of this file as well and show the difference at each: a JSON array of
    /// {"q": {"joint": value}} in rad and m; joints that are not named are at 0.
    #[arg(long, value_name = "FILE")]
    configurations: Option<PathBuf>,
    /// Show the position of the tip by both models and the error at each configuration as a table.
    #[arg(long)]
    table: bool,
    #[command(flatten)]
    plot: PlotArgument,
    /// Tolerance of positions and orientations in place of the robot file's, each with its unit: 1mm,0.1deg; a part
    /// that is not given stays the file's.
    #[arg(long, value_name = "LENGTH,ANGLE", allow_hyphen_values = true)]
    tolerance: Option<ToleranceArgument>,
    /// Also show the pose of the TCP at zero and its motion with each joint; JSON always has both.
    #[arg(long)]
    basics: bool,
    #[command(flatten)]
    access: AccessArguments,
    #[command(flatten)]
    ci: CiArguments,
    #[command(flatten)]
    page: PageArgument,
}

/// The report on one robot, and whether its first checks are shown too.
struct Checked {
    report: RobotCheck,
    description: RobotDescription,
    other: Option<RobotDescription>,
    with_basics: bool,
    with_table: bool,
}

impl Serialize for Checked {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.report.serialize(serializer)
    }
}

impl BatchReport for Checked {
    fn exit_code(&self) -> u8 {
        match self.report.geometry.verdict {
            Agreement::Agree => 0,
            Agreement::Disagree => FAILED,
            Agreement::NothingCompared => NOTHING,
        }
    }

    fn text(&self) -> String {
        self.parts().collect()
    }

    fn parts(&self) -> Parts<'_> {
        let Self { report, description: RobotDescription { robot, .. }, .. } = self;
        let at_configurations = match &report.at_configurations {
            Some(differences) if self.with_table => table(&report.geometry, differences),
            Some(differences) => lines(differences),
            None => Box::new(empty()),
        };
        let basics = if self.with_basics { basics(&report.geometry.basics) } else { String::new() };
        let explained = once_with(move || explained_text(report, robot) + &basics);
        Box::new(once(compared_text(report, robot)).chain(at_configurations).chain(explained))
    }

    fn test_suite(&self, input: &str) -> TestSuite {
        check_suite(input, &self.report)
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    one_plot(arguments)?;
    refuse_same(arguments.ci.outputs().chain(arguments.page.output()).chain(arguments.plot.output()))?;
    if arguments.table && arguments.configurations.is_none() {
        let error = Diagnostic::error("check::table", "--table is of configurations, and none are given");
        return Err(error.with_help("give --configurations FILE").into());
    }
    let batch = Batch::begin(&arguments.robots, &arguments.ci, printer)?;
    let robots = arguments.robots.iter();
    let answers: Vec<Answer<Checked>> =
        robots.map(|path| batch.answer(path, || check(path, arguments, &batch))).collect();
    let plotted = answers.iter().try_for_each(|answer| draw(answer, arguments, &batch));
    let written = arguments.page.write(|| page(&answers), &batch.read()).and(plotted);
    batch.finish_with_page(answers, written)
}

/// The errors at each configuration, if they were computed and the plot is wanted.
fn draw(answer: &Answer<Checked>, arguments: &Arguments, batch: &Batch<'_>) -> Result<(), Failure> {
    let Ok(Checked { report, .. }) = answer.report() else { return Ok(()) };
    let Some(differences) = &report.at_configurations else { return Ok(()) };
    arguments.plot.write(|| errors(&chart(&report.geometry, differences)), &batch.read())
}

fn page(answers: &[Answer<Checked>]) -> String {
    check_page(&answers.iter().map(entry).collect::<Vec<_>>())
}

fn entry(answer: &Answer<Checked>) -> CheckEntry<'_> {
    let result = answer.report();
    let result = result.map(|of| checked_robot(&of.report, &of.description, of.other.as_ref()));
    CheckEntry { input: answer.input(), result }
}

/// A plot is of one robot, at configurations.
fn one_plot(arguments: &Arguments) -> Result<(), Diagnostic> {
    let refused = |message: &str, help: &str| Err(Diagnostic::error("check::plot", message).with_help(help));
    if !arguments.plot.is_given() {
        return Ok(());
    }
    match (&arguments.configurations, arguments.robots.len()) {
        (None, _) => refused("--plot is of configurations, and none are given", "give --configurations FILE"),
        (Some(_), 2..) => refused("--plot is of one robot, and several are given", "check them one by one"),
        (Some(_), _) => Ok(()),
    }
}

fn check(path: &Path, arguments: &Arguments, batch: &Batch<'_>) -> Result<Checked, Failure> {
    let mut description = arguments.chain.of(load_robot_with(path, &arguments.access.access()?)?)?;
    let mut configurations = RobotQList::new(description.robot.dof());
    if let Some(path) = &arguments.configurations {
        let read = read_configurations(path, &description.robot)?;
        description.warnings.extend(read.warning);
        description.inputs.extend(read.input);
        configurations = read.entries;
    }
    let declared = description.tolerance;
    if let Some(tolerance) = arguments.tolerance {
        let (wrong, wide) = tolerance.examine(description.tolerance_scale());
        if !wrong.is_empty() {
            return Err(wrong.into());
        }
        description.warnings.extend(wide);
        description.tolerance = tolerance.replace(declared);
    }
    batch.warn(path, &description.warnings);
    let options = CheckOptions { seed: arguments.seed, configurations: configurations.into() };
    let access = arguments.access.access()?;
    let other = arguments.against.as_ref().map(|other| load_robot_with(other, &access)).transpose()?;
    let mut inputs = files_of(&description);
    inputs.extend(other.iter().flat_map(files_of));
    batch.reads(&inputs)?;
    arguments.plot.is_none_of(&inputs)?;
    arguments.page.is_none_of(&inputs)?;
    let compare = || match &other {
        Some(other) => congruent::check_against(&description, other, &options),
        None => congruent::check(&description, &options),
    };
    if let Some(other) = &other {
        batch.warn(&other.path, &other.warnings);
    }
    let compared = waiting(batch.printer(), &format!("checking {}", shown(path)), compare);
    let mut report = compared
        .map_err(|error| Diagnostic::error("check::robot", format!("{}: {error}", path.display())))?;
    let unusable = unusable_inertials(&description);
    if report.geometry.verdict == Agreement::Agree && !unusable.is_empty() {
        return Err(unusable.into());
    }
    report.geometry.replaced_tolerance = arguments.tolerance.map(|_| declared);
    let (with_basics, with_table) = (arguments.basics, arguments.table);
    Ok(Checked { report, description, other, with_basics, with_table })
}

/// Entries in frames that do not move with their joint: warnings as long as the table may be wrong, which the geometry
/// tells.
fn unusable_inertials(description: &RobotDescription) -> Vec<Diagnostic> {
    let of_inertials = description.warnings.iter().filter(|warning| warning.code == "robot_file::inertial");
    of_inertials.map(|warning| Diagnostic { severity: Severity::Error, ..warning.clone() }).collect()
}
