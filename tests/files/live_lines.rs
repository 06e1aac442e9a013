//! Lines on standard input are answered while they come.

use std::{
    io::{BufRead, BufReader, Write},
    process::{ChildStdin, Stdio},
    sync::mpsc,
    time::Duration,
};

use serde_json::Value;

use crate::support::command::allowing;

/// How long an answer may take on a machine that is busy; without it, a command that waits for the end would block the test.
const PATIENCE: Duration = Duration::from_mins(1);

/// A command that reads standard input line by line.
struct Live {
    child: std::process::Child,
    input: Option<ChildStdin>,
    output: mpsc::Receiver<String>,
}

impl Live {
    fn begin(arguments: &[&str]) -> Self {
        let mut command = allowing(arguments);
        let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = pipes.spawn().expect("the command starts");
        let (sender, output) = mpsc::channel();
        let lines = BufReader::new(child.stdout.take().expect("it is a pipe")).lines();
        std::thread::spawn(move || lines.map_while(Result::ok).try_for_each(|line| sender.send(line)));
        Self { input: child.stdin.take(), child, output }
    }

    /// Writes a line, and waits for a line of the answer that has this text.
    #[track_caller]
    fn ask(&mut self, line: &str, wanted: &str) -> String {
        writeln!(self.input.as_mut().unwrap(), "{line}").expect("the command reads");
        loop {
            let answered = self.output.recv_timeout(PATIENCE).expect("an answer before the next line");
            if answered.contains(wanted) {
                return answered;
            }
        }
    }

    /// The exit code after the end of the lines.
    fn end(mut self) -> i32 {
        drop(self.input.take());
        self.child.wait().expect("it ends").code().expect("by itself")
    }
}

#[test]
fn each_line_is_answered_before_the_next_is_written() {
    let json = ["--configurations", "-", "--format", "json"];
    for command in ["fk", "jacobian", "dynamics"] {
        let mut live = Live::begin(&[&[command, "robots/ur5e"], &json[..]].concat());
        let mut first = None;
        for angle in [0.0, 0.5, 1.0] {
            let line = format!(r#"{{"q": {{"elbow_joint": {angle}}}}}"#);
            let answer: Value = serde_json::from_str(&live.ask(&line, "{")).expect("a document in one line");
            let result = answer["results"][0].clone();
            assert!(result.is_object() && answer["results"].as_array().unwrap().len() == 1, "{answer}");
            assert_ne!(first.replace(result.clone()), Some(result), "{command} at {angle}");
        }
        assert_eq!(live.end(), 0, "{command}");
    }
}

#[test]
fn targets_are_answered_one_by_one() {
    let mut live = Live::begin(&["ik", "robots/ur5e", "--targets", "-", "--format", "json"]);
    for (x_m, is_reached) in [(0.4, true), (9.0, false)] {
        let line = format!(r#"{{"translation_m": [{x_m}, 0.1, 0.3]}}"#);
        let answer: Value = serde_json::from_str(&live.ask(&line, "{")).expect("a document in one line");
        assert_eq!(answer["results"][0]["converged"], is_reached, "{answer}");
    }
    assert_eq!(live.end(), 1, "one target is not reached");
}

#[test]
fn for_people_the_lines_are_counted() {
    let mut live = Live::begin(&["fk", "robots/ur5e", "--to", "tool0", "--configurations", "-"]);
    for number in 1..=3 {
        live.ask(r#"{"q": {}}"#, &format!("configuration {number}: "));
    }
    assert_eq!(live.end(), 0);
    // The number of a wrong line is that of the input.
    let mut live = Live::begin(&["fk", "robots/ur5e", "--configurations", "-"]);
    live.ask(r#"{"q": {}}"#, "configuration 1: ");
    writeln!(live.input.as_mut().unwrap(), r#"{{"q": {{"elbo": 1}}}}"#).unwrap();
    assert_eq!(live.end(), 2);
}
