//! `congruent check`: compares model, URDF and physics.

use std::path::{Path, PathBuf};

use congruent::{
    LintSummary, NamedBy, RobotCheck,
    agreement::compare::{Agreement, CheckOptions},
    analysis::plot::errors,
    cannot_be_checked, check_suite, checked_robot,
    configurations::read_configurations,
    description::{RobotDescription, RobotQList, Tolerance},
    input::{Diagnostic, Finding, Findings},
    page::{CheckEntry, check_page},
    results::report::TestSuite,
    robots_of_changed,
    text::{CheckTextParts, TextOptions, check_text_parts, layout::visible_path},
    unusable_inertials,
};
use serde::{Serialize, Serializer};

use super::{
    errors_at::chart,
    fixed_table::{FixArgument, fix},
    measured::{MeasuredArguments, MeasuredCall},
    split_values::split_values,
};
use crate::{
    batch::{Answer, Batch, BatchReport, TextParts},
    ci::CiArguments,
    codes,
    failure::Failure,
    input::{AccessArguments, ChainArguments, SetArguments, files_of, seed},
    invocation,
    output::{file::refuse_same, page::PageArgument, plot::PlotArgument},
    terminal::{
        print::{Format, Printer, text_options},
        progress::waiting,
    },
    tolerance::ToleranceArgument,
};

/// Checks whether a robot's DH table, its URDF and its physics simulation describe the same robot, in geometry and in
/// dynamics.
///
/// Poses are compared at zero, one axis at a time, at 200 seeded random configurations within the limits,
/// at the limits, and at the worst configurations of the certificates. Dynamics (masses, centres of mass, inertias,
/// damping, friction, gravity and limits) is compared with the physics, whose parameters are identified from its
/// torques, with the `[[inertial]]` entries of robot.toml, and with the URDF of --against. Torques at 100 random
/// states may differ by 1e-10 (relative) between two descriptions, and by 1e-8 between a description and the physics,
/// which is rounding. If a value of the table is wrong, the report ends with the whole table, corrected; --fix writes it.
/// Exit code 1 if they disagree, 4 if nothing was compared, since there is neither a table nor a robot that can be
/// simulated, or with --strict no second description; with --fix that of the corrected file.
#[derive(Debug, clap::Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is an option of the command line")]
pub(crate) struct Arguments {
    /// Folders with robot.toml, robot files, URDFs, MJCFs, or - for a URDF or MJCF on standard input.
    #[arg(required = true)]
    robots: Vec<PathBuf>,
    /// Also compare with another description of the robot (a folder with robot.toml, a robot file, a URDF or an MJCF), in
    /// geometry and, if both are the same chain within the tolerance, in dynamics. Joints with other names, directions or
    /// zeros are found, or declared by [mapping] in robot.toml. git:REV is the robot as the branch, tag or commit REV has
    /// it, git:REV:PATH another file of it; a log (.mcap, a folder of rosbag2) is the `robot_description` that was recorded
    /// in it. Given several times, each is compared. By default the files of [[reference]] in robot.toml.
    #[arg(long, value_name = "ROBOT")]
    against: Vec<PathBuf>,
    /// Take the files as those that changed in a repository: a .urdf leads to each robot.toml below the current folder that
    /// names it, and is checked by itself only if none does. Files that are deleted, or neither a robot file nor a URDF, are
    /// ignored.
    #[arg(long)]
    changed: bool,
    #[command(flatten)]
    measured: MeasuredArguments,
    #[command(flatten)]
    set: SetArguments,
    #[command(flatten)]
    chain: ChainArguments,
    /// Seed of the random configurations.
    #[arg(long, default_value_t = 0, value_parser = seed)]
    seed: u64,
    /// Also compare at the configurations of this file and show the difference at each: one {"q": {"joint": value}} per
    /// line (JSON Lines), or a JSON array of at most 100,000 of them, in rad and m; joints that are not named are at 0.
    #[arg(long, value_name = "FILE")]
    configurations: Option<PathBuf>,
    /// Show the position of the tip by both models and the error at each configuration as a table.
    #[arg(long)]
    table: bool,
    #[command(flatten)]
    plot: PlotArgument,
    #[command(flatten)]
    fix: FixArgument,
    /// Tolerance of positions and orientations in place of the robot file's, each with its unit: 1mm,0.1deg; a part
    /// that is not given is the file's, or is judged by the digits written if the file declares none.
    #[arg(long, value_name = "LENGTH,ANGLE", allow_hyphen_values = true)]
    tolerance: Option<ToleranceArgument>,
    /// Findings of lint in the descriptions fail, too, except what clearance alone needs, such as missing meshes. So does a
    /// robot without a second description: neither a table, nor [[inertial]], nor --against.
    #[arg(long)]
    strict: bool,
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
    /// Whether the robot is compared with others as well: a line by itself then says with which.
    is_one_of_several: bool,
    text_parts: CheckTextParts,
    options: TextOptions,
    /// The check of the file that --fix has written.
    fixed: Option<RobotCheck>,
}

impl Serialize for Checked {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.report.serialize(serializer)
    }
}

impl BatchReport for Checked {
    fn exit_code(&self) -> u8 {
        self.decisive().exit_code()
    }

    fn text(&self) -> String {
        self.parts().collect()
    }

    fn parts(&self) -> TextParts<'_> {
        Box::new(check_text_parts(&self.report, &self.description.robot, self.text_parts, &self.options))
    }

    fn one_line(&self) -> Option<String> {
        // With --fix the causes, too: the corrected file alone would hide that there were any.
        let all = std::iter::once(&self.report).chain(&self.fixed);
        let line = |report: &RobotCheck| {
            let against = report.against.as_ref().filter(|_| self.is_one_of_several);
            let other = against.map_or_else(String::new, |other| format!(" against {}", other.file));
            format!("{}{other}: {}", report.geometry.file, report.headline())
        };
        let lines = all.map(line);
        Some(lines.collect::<Vec<_>>().join("\n"))
    }

    fn test_suite(&self, input: &str) -> TestSuite {
        check_suite(input, self.decisive())
    }
}

impl Checked {
    /// The check that decides: of the corrected file, if one was written.
    fn decisive(&self) -> &RobotCheck {
        self.fixed.as_ref().unwrap_or(&self.report)
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    one_plot(arguments)?;
    split_values(&arguments.robots, &arguments.against, arguments.tolerance)?;
    if let Some(file) = arguments.measured.file() {
        let Arguments { robots, chain, access, ci, tolerance, .. } = arguments;
        let call = MeasuredCall { robots, chain, access, ci, tolerance: *tolerance };
        return arguments.measured.run(file, &call, printer);
    }
    refuse_same(arguments.ci.outputs().chain(arguments.page.output()).chain(arguments.plot.output()))?;
    if arguments.table && arguments.configurations.is_none() {
        let error =
            Diagnostic::error(codes::check::TABLE, "--table needs --configurations, which is missing");
        return Err(error.with_help("give --configurations FILE: the joint positions of each row").into());
    }
    let changed = arguments.changed.then(|| robots_of_changed(&arguments.robots, Path::new(".")));
    let robots = changed.as_ref().map_or(&arguments.robots, |changed| &changed.robots);
    if let Some(changed) = &changed {
        let ignored = changed.ignored.iter();
        let notes: Vec<String> =
            ignored.map(|(path, why)| format!("{}: not checked: {why}", visible_path(path))).collect();
        printer.notes(notes.iter().map(String::as_str));
    }
    let batch = Batch::begin(robots, &arguments.ci, printer)?;
    let mut answers: Vec<Answer<Checked>> = Vec::new();
    for path in robots {
        let first = batch.answer(path, || check(path, arguments, &batch));
        let others = first.report().map_or(0, |of| others(&of.description, arguments).len());
        answers.push(first);
        // The file is corrected once, whatever it is compared with afterwards.
        answers.extend((1..others).map(|at| batch.answer(path, || compared(path, at, arguments, &batch))));
    }
    if let Some(hint) = two_alone(&answers, arguments) {
        printer.hint(&hint);
    }
    let plotted = answers.iter().try_for_each(|answer| draw(answer, arguments, &batch));
    let written = arguments.page.write(|| page(&answers), &batch.read()).and(plotted);
    if answers.is_empty() {
        // A commit without robots is no fault.
        printer.result(&[(); 0], |_| "nothing to check: no robot has changed\n".to_owned())?;
    }
    batch.finish_with_page(answers, written)
}

/// Two descriptions without a second one of either, each checked alone: what compares them.
fn two_alone(answers: &[Answer<Checked>], arguments: &Arguments) -> Option<String> {
    let [first, second] = answers else { return None };
    let is_alone = |of: &Answer<Checked>| of.report().is_ok_and(|of| of.report.lacks_second_description());
    let [a, b] = &arguments.robots[..] else { return None };
    (is_alone(first) && is_alone(second)).then(|| {
        let [a, b] = [a, b].map(|path| visible_path(path));
        format!("each was checked alone; to compare the two: congruent check {a} --against {b}")
    })
}

/// The errors at each configuration, if they were computed and the plot is wanted.
fn draw(answer: &Answer<Checked>, arguments: &Arguments, batch: &Batch<'_>) -> Result<(), Failure> {
    let Ok(Checked { report, .. }) = answer.report() else { return Ok(()) };
    let Some(differences) = &report.at_configurations else { return Ok(()) };
    arguments.plot.write(|| errors(&chart(&report.geometry, differences)), &batch.read())
}

fn page(answers: &[Answer<Checked>]) -> String {
    check_page(&answers.iter().map(entry).collect::<Vec<_>>(), &invocation::command())
}

fn entry(answer: &Answer<Checked>) -> CheckEntry<'_> {
    let result = answer.report();
    let result = result.map(|of| checked_robot(&of.report, &of.description, of.other.as_ref()));
    CheckEntry { input: answer.input(), result }
}

/// A plot is of one robot, at configurations.
fn one_plot(arguments: &Arguments) -> Result<(), Diagnostic> {
    let refused =
        |message: &str, help: &str| Err(Diagnostic::error(codes::check::PLOT, message).with_help(help));
    if !arguments.plot.is_given() {
        return Ok(());
    }
    match (&arguments.configurations, arguments.robots.len()) {
        (None, _) => refused(
            "--plot needs --configurations, which is missing",
            "give --configurations FILE: the joint positions that are plotted",
        ),
        (Some(_), 2..) => {
            refused("--plot works for one robot, but several are given", "check them one by one")
        }
        (Some(_), _) => Ok(()),
    }
}

/// The other descriptions with which a robot is compared, one after the other: those of --against, or those that its file
/// names.
fn others(description: &RobotDescription, arguments: &Arguments) -> Vec<PathBuf> {
    if arguments.against.is_empty() {
        description.references.iter().map(|reference| reference.path.clone()).collect()
    } else {
        arguments.against.clone()
    }
}

/// The check of a robot, and with --fix that of its corrected file.
fn check(path: &Path, arguments: &Arguments, batch: &Batch<'_>) -> Result<Checked, Failure> {
    let mut checked = compared(path, 0, arguments, batch)?;
    if arguments.fix.fix {
        let again = |path: &Path| Ok(compared(path, 0, arguments, batch)?.report);
        let (fix, fixed) = fix(&checked.report, &checked.description, &batch.read(), again)?;
        (checked.report.fix, checked.fixed) = (Some(fix), fixed);
    }
    Ok(checked)
}

/// The check against the other description at this place of the list, if there is one.
fn compared(path: &Path, at: usize, arguments: &Arguments, batch: &Batch<'_>) -> Result<Checked, Failure> {
    let mut description =
        arguments.chain.of(arguments.set.load_file(path, &arguments.access.access()?)?)?;
    let mut configurations = RobotQList::new(description.robot.dof());
    // About the options, and not about the descriptions that lint examines.
    let mut of_options = Vec::new();
    if let Some(path) = &arguments.configurations {
        let read = read_configurations(path, &description.robot)?;
        of_options.extend(read.warning);
        description.inputs.extend(read.input);
        configurations = read.entries;
    }
    let declared = description.declared_tolerance;
    let declared = declared.is_declared().then_some(description.tolerance);
    if let Some(tolerance) = arguments.tolerance {
        let (wrong, wide) = tolerance.examine(description.tolerance_scale());
        if !wrong.is_empty() {
            return Err(Findings::from(wrong).into());
        }
        of_options.extend(wide);
        description.declared_tolerance = tolerance.requested_or(description.declared_tolerance);
        description.tolerance = description.declared_tolerance.or(Tolerance::default());
    }
    batch.warn(path, &of_options);
    let options = CheckOptions { seed: arguments.seed, configurations: configurations.into() };
    let others = others(&description, arguments);
    let is_one_of_several = others.len() > 1;
    let other = others.into_iter().nth(at);
    let other = other.map(|other| other_description(&mut description, &other, arguments)).transpose()?;
    let mut inputs = files_of(&description);
    inputs.extend(other.iter().flat_map(files_of));
    batch.reads(&inputs)?;
    arguments.plot.is_none_of(&inputs)?;
    arguments.page.is_none_of(&inputs)?;
    let compare = || match &other {
        Some(other) => congruent::check_against(&description, other, &options),
        None => congruent::check(&description, &options),
    };
    let compared = waiting(batch.printer(), &format!("checking {}", visible_path(path)), compare);
    let lint = compared.as_ref().ok().map(|report| &report.lint);
    let of_other = other.as_ref().map(|other| (&*other.path, other));
    for (path, of) in std::iter::once((path, &description)).chain(of_other) {
        warn_of(path, of, lint, batch);
    }
    let mut report = compared.map_err(|error| cannot_be_checked(path, &error))?;
    let unusable = unusable_inertials(&description);
    if report.geometry.verdict == Agreement::Agree && !unusable.is_empty() {
        return Err(Findings::from(unusable).into());
    }
    report.geometry.warnings.extend(of_options.iter().map(Finding::from));
    report.lint.is_strict = arguments.strict;
    report.geometry.requested_tolerance = arguments.tolerance.map(ToleranceArgument::requested);
    report.geometry.replaced_tolerance = arguments.tolerance.and(declared);
    Ok(Checked {
        report,
        description,
        other,
        is_one_of_several,
        text_parts: CheckTextParts { with_basics: arguments.basics, with_table: arguments.table },
        options: text_options(),
        fixed: None,
    })
}

/// Prints the warnings about a description, without those that lint lists below the answer for people.
fn warn_of(path: &Path, description: &RobotDescription, lint: Option<&LintSummary>, batch: &Batch<'_>) {
    let is_text = batch.printer().format() == Format::Human;
    let is_listed = |warning: &&Diagnostic| {
        let mut listed = lint.into_iter().flat_map(|lint| lint.worst.iter().chain(&lint.for_clearance));
        is_text && listed.any(|finding| finding.message == warning.message)
    };
    let others: Vec<Diagnostic> =
        description.warnings.iter().filter(|warning| !is_listed(warning)).cloned().collect();
    batch.warn(path, &others);
}

/// Another description, with the mapping that the robot file declares for it.
fn other_description(
    description: &mut RobotDescription,
    other: &Path,
    arguments: &Arguments,
) -> Result<RobotDescription, Failure> {
    let named_by = if arguments.against.is_empty() { NamedBy::RobotFile } else { NamedBy::Caller };
    Ok(congruent::other_description(description, other, named_by, arguments.access.access()?)?)
}
