//! The command `congruent` as a library: arguments, printing, exit codes. What it prints is computed in
//! the library `congruent`. A new command is a file here or in a folder, a variant of `Command` and a line in `answer`.

mod arm;
mod batch;
mod ci;
mod codes;
mod compare;
mod completions;
mod configurations;
mod explain;
mod failure;
mod help;
mod input;
mod interrupt;
mod invocation;
mod man;
mod model;
mod new;
mod old_names;
mod output;
mod quantity;
#[cfg(feature = "recording")]
mod recording;
mod run;
mod schema;
mod sweep;
mod sweep_plans;
mod terminal;
mod tolerance;
mod unfinished_junit;
mod usage_hints;
mod watch;

pub use failure::worse;
pub use tolerance::ToleranceArgument;

use std::ffi::OsString;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use congruent::input::Diagnostic;

use crate::{
    failure::{BAD_INPUT, Failure},
    old_names::{Renamed, with_command},
    terminal::print::{Color, Format, Printer, Verbosity},
};

/// Columns of help, unless the terminal has fewer.
const WIDEST_HELP: usize = 100;

/// Checks whether a robot's analytical model and its URDF describe the same robot; if not, gives the difference and
/// its cause.
///
/// Exit codes: 0 all as expected, 1 a check failed, 2 bad input, 3 the simulation or the machine
/// failed, 4 nothing was checked.
#[derive(Debug, Parser)]
#[command(name = "congruent", version, max_term_width = WIDEST_HELP)]
struct Arguments {
    /// Output format: text for people, or one JSON document.
    #[arg(long, value_enum, default_value_t = Format::Human, global = true)]
    format: Format,
    /// Colour what people read. `auto` is on a terminal, unless `NO_COLOR` is set.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = Color::Auto, global = true)]
    color: Color,
    /// Print only the answer and errors, no warnings and no progress. The answer about a whole input, as of `check`, is a line.
    #[arg(short, long, global = true)]
    quiet: bool,
    /// Also print what was read and how long it took, and findings in full, unless --quiet is given.
    #[arg(short, long, global = true)]
    verbose: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Check(model::check::Arguments),
    Lint(model::lint::Arguments),
    Explain(explain::Arguments),
    Describe(model::describe::Arguments),
    Run(run::Arguments),
    Replay(run::replay::Arguments),
    Watch(watch::Arguments),
    Sweep(sweep::Arguments),
    New(new::Arguments),
    #[cfg(feature = "recording")]
    View(recording::view::Arguments),
    #[cfg(feature = "recording")]
    Inspect(recording::inspect::Arguments),
    Compare(compare::Arguments),
    Fk(arm::fk::Arguments),
    Ik(arm::ik::Arguments),
    Jacobian(arm::jacobian::Arguments),
    Dynamics(arm::dynamics::Arguments),
    Clearance(arm::clearance::Arguments),
    Workspace(arm::workspace::Arguments),
    Manipulability(arm::manipulability::Arguments),
    Sensitivity(arm::sensitivity::Arguments),
    Tolerances(arm::tolerances::Arguments),
    Convert(model::convert::Arguments),
    Calibrate(model::calibrate::Arguments),
    Identify(model::identify::Arguments),
    Plan(model::plan::Arguments),
    Schema(schema::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

impl Arguments {
    fn verbosity(&self) -> Verbosity {
        match (self.quiet, self.verbose) {
            (true, _) => Verbosity::Quiet,
            (false, true) => Verbosity::Verbose,
            (false, false) => Verbosity::Usual,
        }
    }
}

/// The codes of all messages of the command, with what `explain` says of them.
pub fn codes() -> Vec<&'static congruent::input::Code> {
    codes::all_codes()
}

/// Does what the command `congruent` does with these arguments, and returns its exit code. The first argument is the
/// name of the program, as the operating system gives it.
///
/// Results go to standard output, findings to standard error. It is made for one call in a process: `--color` and
/// `--verbose` of the first call are those of all, and from then on Ctrl-C and SIGTERM end the process in order.
///
/// | exit code | meaning |
/// |---|---|
/// | 0 | all as expected |
/// | 1 | a check failed |
/// | 2 | bad input |
/// | 3 | the simulation or the machine failed |
/// | 4 | nothing was checked |
///
/// # Examples
/// ```
/// let robot = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/ur5e");
/// assert_eq!(congruent_cli::run(["congruent", "describe", robot]), 0);
/// ```
pub fn run<T: Into<OsString>>(arguments: impl IntoIterator<Item = T>) -> u8 {
    let words: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    invocation::note(&words);
    let Renamed { words, hints } = Renamed::from_words(&words);
    let arguments = match input::shown_arguments(&words).map(|()| parse(words)) {
        Ok(Ok(arguments)) => arguments,
        Ok(Err(error)) => return not_parsed(&error),
        Err(failure) => {
            Printer::explain(None, &failure);
            return failure.exit_code();
        }
    };
    interrupt::watch_signals();
    arguments.color.apply();
    let printer = Printer::new(arguments.format, arguments.verbosity());
    let hints = hints.into_iter().map(|hint| {
        Diagnostic::warning(codes::cli::RENAMED, hint).with_help("the old name is gone in the next version")
    });
    printer.warnings(None, &hints.collect::<Vec<_>>());
    if arguments.format == Format::Sarif && !matches!(arguments.command, Command::Lint(_)) {
        let only = Diagnostic::error(codes::cli::FORMAT, "--format sarif works with `lint` only");
        Printer::explain(None, &Failure::from(only.with_help("use --format json")));
        return BAD_INPUT;
    }
    answer(arguments.command, &printer).unwrap_or_else(|failure| {
        printer.failure(&failure);
        failure.exit_code()
    })
}

/// All commands, as they are parsed and printed.
fn all_commands() -> clap::Command {
    help::with_groups_and_examples(Arguments::command())
}

/// The arguments; help is as wide as the terminal, up to what is read with ease.
fn parse(words: Vec<OsString>) -> Result<Arguments, clap::Error> {
    let command = all_commands();
    let words = with_command(words, |word| word == "help" || command.find_subcommand(word).is_some());
    let mut command = match terminal::columns() {
        Some(columns) => command.term_width(columns.min(WIDEST_HELP)),
        None => command,
    };
    let matches = command.try_get_matches_from_mut(words.clone()).map_err(|error| {
        usage_hints::with_hint(help::with_nearest_command(error, &command), &words, &command)
    })?;
    Arguments::from_arg_matches(&matches).map_err(|error| error.format(&mut command))
}

/// Prints help or version, or what is wrong with the arguments.
fn not_parsed(error: &clap::Error) -> u8 {
    if error.use_stderr() {
        Printer::usage(error);
        return BAD_INPUT;
    }
    // There is nothing to be done if standard output is closed.
    let _ = error.print();
    0
}

fn answer(command: Command, printer: &Printer) -> Result<u8, Failure> {
    match command {
        Command::Run(arguments) => run::run(&arguments, printer),
        Command::Replay(arguments) => run::replay::run(&arguments, printer),
        Command::Watch(arguments) => watch::run(&arguments, printer),
        Command::Sweep(arguments) => sweep::run(&arguments, printer),
        Command::Check(arguments) => model::check::run(&arguments, printer),
        Command::Lint(arguments) => model::lint::run(&arguments, printer),
        Command::Explain(arguments) => explain::run(&arguments.code, printer),
        Command::Describe(arguments) => model::describe::run(&arguments, printer),
        Command::Fk(arguments) => arm::fk::run(&arguments, printer),
        Command::Jacobian(arguments) => arm::jacobian::run(&arguments, printer),
        Command::Calibrate(arguments) => model::calibrate::run(&arguments, printer),
        Command::Identify(arguments) => model::identify::run(&arguments, printer),
        Command::Plan(arguments) => model::plan::run(&arguments, printer),
        Command::Dynamics(arguments) => arm::dynamics::run(&arguments, printer),
        Command::Ik(arguments) => arm::ik::run(&arguments, printer),
        Command::Manipulability(arguments) => arm::manipulability::run(&arguments, printer),
        Command::Workspace(arguments) => arm::workspace::run(&arguments, printer),
        Command::Sensitivity(arguments) => arm::sensitivity::run(&arguments, printer),
        Command::Tolerances(arguments) => arm::tolerances::run(&arguments, printer),
        Command::Clearance(arguments) => arm::clearance::run(&arguments, printer),
        Command::New(arguments) => new::run(&arguments, printer),
        Command::Convert(arguments) => model::convert::run(&arguments, printer),
        #[cfg(feature = "recording")]
        Command::Inspect(arguments) => recording::inspect::run(&arguments, printer),
        #[cfg(feature = "recording")]
        Command::View(arguments) => recording::view::run(&arguments, printer),
        Command::Compare(arguments) => compare::run(&arguments, printer),
        Command::Schema(arguments) => schema::run(&arguments, printer),
        Command::Completions(arguments) => completions::run(&arguments, all_commands(), printer),
        Command::Man(arguments) => man::run(&arguments, all_commands(), printer),
    }
}
