//! A command that reads standard input line by line, and answers while it comes.

use std::{
    io::{BufRead, BufReader, Write},
    process::{Child, ChildStdin, Stdio},
    sync::mpsc,
    time::Duration,
};

use serde_json::Value;

use super::command::allowing;

/// How long an answer may take on a machine that is busy; without it, a command that waits for the end would block the test.
const PATIENCE: Duration = Duration::from_mins(1);

/// A command that reads standard input line by line.
pub(crate) struct Live {
    child: Child,
    input: Option<ChildStdin>,
    output: mpsc::Receiver<String>,
}

impl Live {
    pub(crate) fn begin(arguments: &[&str]) -> Self {
        let mut command = allowing(arguments);
        let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = pipes.spawn().expect("the command starts");
        let (sender, output) = mpsc::channel();
        let lines = BufReader::new(child.stdout.take().expect("it is a pipe")).lines();
        std::thread::spawn(move || lines.map_while(Result::ok).try_for_each(|line| sender.send(line)));
        Self { input: child.stdin.take(), child, output }
    }

    /// Writes a line.
    pub(crate) fn write(&mut self, line: &str) {
        writeln!(self.input.as_mut().unwrap(), "{line}").expect("the command reads");
    }

    /// Writes a line, and waits for a line of the answer that has this text.
    #[track_caller]
    pub(crate) fn ask(&mut self, line: &str, wanted: &str) -> String {
        self.write(line);
        loop {
            let answered = self.output.recv_timeout(PATIENCE).expect("an answer before the next line");
            if answered.contains(wanted) {
                return answered;
            }
        }
    }

    /// The next line of the answer, a document.
    #[track_caller]
    pub(crate) fn next(&mut self) -> Value {
        let line = self.output.recv_timeout(PATIENCE).expect("an answer");
        serde_json::from_str(&line).unwrap_or_else(|error| panic!("no JSON: {error}\n{line}"))
    }

    /// The exit code after the end of the lines.
    pub(crate) fn end(mut self) -> i32 {
        drop(self.input.take());
        self.code()
    }

    /// The exit code of a command that ends by itself.
    pub(crate) fn code(&mut self) -> i32 {
        self.child.wait().expect("it ends").code().expect("by itself")
    }

    /// Sends a signal.
    #[cfg(unix)]
    pub(crate) fn signal(&self, name: &str) {
        let sent = std::process::Command::new("kill")
            .args([format!("-{name}"), self.child.id().to_string()])
            .status();
        assert!(sent.expect("there is a command `kill`").success());
    }
}
