//! Runs the built command as a user does.

use std::{
    ffi::OsStr,
    io::Write,
    path::Path,
    process::{Command, Output, Stdio},
};

use serde_json::Value;

use super::corpus::workspace;

/// What the command did.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Answer {
    /// The one JSON document on standard output.
    #[track_caller]
    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.stdout)
            .unwrap_or_else(|error| panic!("no JSON: {error}\n{}\n{}", self.stdout, self.stderr))
    }
}

/// Commands that open no file that another file names.
const WITHOUT_ACCESS: [&str; 7] = ["compare", "completions", "explain", "inspect", "man", "schema", "--help"];

/// Runs `congruent` with these arguments, from the root of the workspace. Files of tests are in temporary folders and name
/// robots of the workspace and of the corpus, which is allowed here.
pub(crate) fn congruent<S: AsRef<OsStr>>(arguments: &[S]) -> Answer {
    answer(&allowing(arguments).output().expect("the command starts"))
}

/// The same with nothing allowed.
pub(crate) fn congruent_alone<S: AsRef<OsStr>>(arguments: &[S]) -> Answer {
    answer(&command(arguments).output().expect("the command starts"))
}

/// The same with this text on standard input.
pub(crate) fn congruent_with_input<S: AsRef<OsStr>>(arguments: &[S], input: &str) -> Answer {
    let mut command = allowing(arguments);
    let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = pipes.spawn().expect("the command starts");
    // A command that refuses its arguments reads nothing.
    let _ = child.stdin.take().expect("it is a pipe").write_all(input.as_bytes());
    answer(&child.wait_with_output().expect("the command ends"))
}

/// The same with this `PATH`, where other programs are looked for.
pub(crate) fn congruent_in_path<S: AsRef<OsStr>>(arguments: &[S], path: &Path) -> Answer {
    answer(&allowing(arguments).env("PATH", path).output().expect("the command starts"))
}

/// The same in another folder.
pub(crate) fn congruent_in<S: AsRef<OsStr>>(folder: &Path, arguments: &[S]) -> Answer {
    answer(&allowing(arguments).current_dir(folder).output().expect("the command starts"))
}

/// The command, which may open the robots of the workspace and of the corpus.
pub(crate) fn allowing<S: AsRef<OsStr>>(arguments: &[S]) -> Command {
    let mut command = command(arguments);
    let has_access = |first: &OsStr| WITHOUT_ACCESS.iter().all(|each| first != OsStr::new(each));
    let is_help = arguments.iter().any(|argument| argument.as_ref() == OsStr::new("--help"));
    // Whether there is a corpus is said by the tests that use it.
    let corpus = std::env::var_os("CONGRUENT_CORPUS").map(|path| workspace().join(path));
    if !is_help && arguments.first().is_some_and(|first| has_access(first.as_ref())) {
        for folder in [Some(workspace()), corpus].into_iter().flatten() {
            command.arg("--allow").arg(folder);
        }
    }
    command
}

/// The command under a shell that gives it an address space of so many KiB.
#[cfg(target_os = "linux")]
pub(crate) fn with_memory<S: AsRef<OsStr>>(most_kib: u32, arguments: &[S]) -> Command {
    let command = allowing(arguments);
    // One arena: the allocator reserves 64 MiB of addresses for each further thread that allocates at the same time.
    let limit = format!("ulimit -v {most_kib}; MALLOC_ARENA_MAX=1 exec \"$0\" \"$@\"");
    let mut shell = Command::new("/bin/sh");
    shell.args(["-c", &limit]).arg(command.get_program()).args(command.get_args()).current_dir(workspace());
    shell
}

fn command<S: AsRef<OsStr>>(arguments: &[S]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_congruent"));
    command
        .args(arguments)
        .current_dir(workspace())
        .env_remove("GITHUB_ACTIONS")
        .env("GITHUB_WORKSPACE", workspace())
        .env_remove("NO_COLOR")
        .env_remove("COLUMNS"); // the width of help
    command
}

fn answer(output: &Output) -> Answer {
    Answer {
        code: output.status.code().expect("the command ends by itself"),
        stdout: String::from_utf8(output.stdout.clone()).expect("the command prints UTF-8"),
        stderr: String::from_utf8(output.stderr.clone()).expect("the command prints UTF-8"),
    }
}

/// The same, with `--format json`.
pub(crate) fn congruent_json<S: AsRef<OsStr>>(arguments: &[S]) -> Answer {
    let mut all: Vec<&OsStr> = arguments.iter().map(AsRef::as_ref).collect();
    all.extend(["--format", "json"].map(OsStr::new));
    congruent(&all)
}

/// The commands that a help lists, without `help` itself.
pub(crate) fn commands_in(help: &str) -> Vec<&str> {
    // Below `Commands:`, or of all commands in groups: below a line that ends in `:`, until the options.
    let listed = help
        .lines()
        .skip_while(|line| !["Commands:", "Check:"].contains(line))
        .take_while(|line| *line != "Options:");
    // A line that goes on with a description is indented further, and has an empty first word.
    let names = listed.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    names.filter(|name| !["", "help"].contains(name)).collect()
}

/// A path as an argument.
pub(crate) fn text(path: &Path) -> String {
    path.to_str().expect("paths of tests are UTF-8").to_owned()
}
