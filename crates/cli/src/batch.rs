//! Several inputs in one call: each is answered, whatever becomes of the others, and the exit code is the worst.

use std::{
    fmt::Write,
    iter::once_with,
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
    time::Instant,
};

use congruent::{
    input::{Diagnostic, Finding, display::quantity},
    results::report::{CasePlace, Reason, TestResult, TestSuite},
    text::{MOST_FINDINGS, layout::visible_path},
};
use serde::Serialize;

use crate::{
    ci::{CiArguments, in_repository},
    failure::{BAD_INPUT, BROKEN, FAILED, Failure, NOTHING, worse},
    terminal::print::{Format, Printer, Refusal},
    unfinished_junit::UnfinishedJunit,
};

/// A text for people in parts of whole lines.
pub(crate) type TextParts<'a> = Box<dyn Iterator<Item = String> + 'a>;

/// What a command prints for one input.
pub(crate) trait BatchReport: Serialize {
    /// The exit code of its verdict.
    fn exit_code(&self) -> u8;
    /// The report for people.
    fn text(&self) -> String;
    /// The same in parts of whole lines, each made when it is printed.
    fn parts(&self) -> TextParts<'_> {
        Box::new(once_with(|| self.text()))
    }
    /// The answer in a line with the name of the input, for --quiet; `None` if the report is no answer to a question.
    fn one_line(&self) -> Option<String> {
        None
    }
    /// The report for CI; `input` names it among the others of the file.
    fn test_suite(&self, input: &str) -> TestSuite;
}

/// The answer to one input: a report, or why there is none.
pub(crate) struct Answer<R> {
    input: PathBuf,
    result: Result<R, Failure>,
    /// Time of the machine that it took.
    wall_s: f64,
}

/// One input in the JSON document of several inputs.
#[derive(Serialize)]
#[serde(untagged)]
enum AnswerEntry<'a, R> {
    Report {
        input: String,
        #[serde(flatten)]
        report: &'a R,
    },
    Refusal(Refusal<'a>),
}

/// The inputs of a call. Findings name their input if there are several.
pub(crate) struct Batch<'a> {
    printer: &'a Printer,
    inputs: &'a [PathBuf],
    ci: &'a CiArguments,
    /// The files that were read for them, which no result may replace.
    read: Mutex<Vec<PathBuf>>,
    unfinished: Mutex<UnfinishedJunit>,
}

impl<'a> Batch<'a> {
    /// Finds out at once whether the files for CI can be written. Until the end the JUnit file has an error for every
    /// input, so that a call that is killed does not look successful.
    pub(crate) fn begin(
        inputs: &'a [PathBuf],
        ci: &'a CiArguments,
        printer: &'a Printer,
    ) -> Result<Self, Failure> {
        let unfinished = |input: &PathBuf| {
            let message = "the call ended before this input was answered".to_owned();
            let reason = Reason { kind: "unfinished".to_owned(), message };
            TestSuite::with_case(visible_path(input), "end", TestResult::Error(reason))
        };
        let suites: Vec<TestSuite> = inputs.iter().map(unfinished).collect();
        // Before any work: a file that cannot be written is known at once, and a call that is killed later has
        // reported errors.
        ci.begin(inputs, &suites)?;
        let unfinished = UnfinishedJunit::new(suites);
        Ok(Self {
            printer,
            inputs,
            ci,
            read: Mutex::new(inputs.to_vec()),
            unfinished: Mutex::new(unfinished),
        })
    }

    /// The printer of the answers.
    pub(crate) fn printer(&self) -> &Printer {
        self.printer
    }

    /// Notes files that were read.
    ///
    /// # Errors
    /// A file for CI would replace one of them.
    pub(crate) fn reads(&self, files: &[PathBuf]) -> Result<(), Diagnostic> {
        self.read.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(files);
        self.ci.is_none_of(files)
    }

    /// A file for CI is none of these, which the call writes itself.
    pub(crate) fn writes(&self, files: &[PathBuf]) -> Result<(), Diagnostic> {
        self.ci
            .is_none_of(files)
            .map_err(|refused| refused.with_help("it is a result of the run: choose another name"))
    }

    /// The files that were read.
    pub(crate) fn read(&self) -> Vec<PathBuf> {
        self.read.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The name of an input in front of its findings, if there are several inputs.
    fn label<'p>(&self, input: &'p Path) -> Option<&'p Path> {
        (self.inputs.len() > 1).then_some(input)
    }

    /// Prints warnings about an input.
    pub(crate) fn warn(&self, input: &Path, warnings: &[Diagnostic]) {
        self.printer.warnings(self.label(input), warnings);
    }

    /// The answer to one input by `work`. For one of several inputs, the reason of a failure is printed at once; for
    /// a single input it is the failure of the command. A panic must not lose the answers to the others.
    pub(crate) fn answer<R>(&self, input: &Path, work: impl FnOnce() -> Result<R, Failure>) -> Answer<R> {
        #[expect(clippy::disallowed_methods, reason = "for the JUnit file of the call alone, which CI reads")]
        let start = Instant::now();
        let result = catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
            let message = format!("{} ended in an internal error; please report it", visible_path(input));
            Err(Failure::Machine(message))
        });
        // Of a quiet call for people the line of the input has it.
        let is_in_line = self.printer.is_quiet() && self.printer.format() == Format::Human;
        if let (Err(failure), Some(label), false) = (&result, self.label(input), is_in_line) {
            Printer::explain(Some(label), failure);
        }
        let wall_s = start.elapsed().as_secs_f64();
        self.printer.detail(|| format!("{}: took {}", input.display(), quantity(wall_s, "s")));
        Answer { input: input.to_owned(), result, wall_s }
    }

    /// The next stage of an answer, unless the first has failed.
    pub(crate) fn go_on<S, R>(
        &self,
        answer: Answer<S>,
        work: impl FnOnce(S) -> Result<R, Failure>,
    ) -> Answer<R> {
        let Answer { input, result, wall_s } = answer;
        match result {
            Ok(stage) => {
                let next = self.answer(&input, || work(stage));
                Answer { wall_s: wall_s + next.wall_s, ..next }
            }
            Err(failure) => Answer { input, result: Err(failure), wall_s },
        }
    }

    /// Notes what the JUnit file must have of each input that goes on.
    pub(crate) fn plan<S>(&self, loaded: &[Answer<S>], planned: impl Fn(&S) -> TestSuite) {
        let Ok(mut unfinished) = self.unfinished.lock() else { return };
        for (suite, answer) in unfinished.suites.iter_mut().zip(loaded) {
            *suite = match &answer.result {
                Ok(stage) => planned(stage),
                Err(failure) => refused_suite(&answer.input, failure),
            };
        }
        // A file that cannot be written is reported by `finish`, which writes it again.
        let _ = self.ci.begin(self.inputs, &unfinished.suites);
    }

    /// Prints at once how one of several inputs has ended; the whole answers follow at the end.
    pub(crate) fn report<R: BatchReport>(&self, answer: &Answer<R>) {
        let word = WORDS.iter().find_map(|&(code, word)| (code == answer.exit_code()).then_some(word));
        if let (Some(input), Some(word)) = (self.label(&answer.input), word) {
            self.printer.ended(input, word);
        }
    }

    /// Writes the answer to the input of this number to the JUnit file: a call that is killed keeps it.
    pub(crate) fn keep<R: BatchReport>(&self, input: usize, answer: &Answer<R>) {
        if !self.ci.has_junit() {
            return;
        }
        let suite = answer.suite();
        if let Ok(mut unfinished) = self.unfinished.lock() {
            unfinished.keep(input, suite, self.ci);
        }
    }

    /// Writes the files for CI, prints all answers, and returns the worst exit code. Answers are in the order of the inputs;
    /// for people the worst come first.
    pub(crate) fn finish<R: BatchReport>(&self, answers: Vec<Answer<R>>) -> Result<u8, Failure> {
        self.finish_with_page(answers, Ok(()))
    }

    /// Like `finish`; `written` says whether the page over all answers was written.
    pub(crate) fn finish_with_page<R: BatchReport>(
        &self,
        mut answers: Vec<Answer<R>>,
        written: Result<(), Failure>,
    ) -> Result<u8, Failure> {
        // The files for CI come first: standard output may be a pipe that is closed, which ends the call.
        let code = self.conclude(&answers, written);
        let all =
            |answers: &[Answer<R>]| if self.printer.is_quiet() { lines(answers) } else { text(answers) };
        if answers.len() > 1 {
            let entries: Vec<AnswerEntry<'_, R>> = answers.iter().map(Answer::entry).collect();
            self.printer.result(&entries, |_| all(&answers))?;
        } else if let Some(Answer { result, .. }) = answers.pop() {
            let report = result?;
            match report.one_line().filter(|_| self.printer.is_quiet()) {
                Some(line) => self.printer.result(&report, |_| line + "\n")?,
                None => self.printer.parts(&report, R::parts)?,
            }
        }
        Ok(code)
    }

    /// Like `finish`, with one document for all answers instead of one for each.
    pub(crate) fn finish_as<R: BatchReport, T: Serialize>(
        &self,
        answers: Vec<Answer<R>>,
        document: impl FnOnce(&[Answer<R>]) -> T,
    ) -> Result<u8, Failure> {
        let code = self.conclude(&answers, Ok(()));
        self.printer.verbatim(&document(&answers), |_| String::new())?;
        // The failure of a single input is that of the command, with its findings in full.
        match <[Answer<R>; 1]>::try_from(answers) {
            Ok([Answer { result: Err(failure), .. }]) => Err(failure),
            _ => Ok(code),
        }
    }

    /// Writes the files for CI; the worst exit code.
    fn conclude<R: BatchReport>(&self, answers: &[Answer<R>], written: Result<(), Failure>) -> u8 {
        let mut code = answers.iter().map(Answer::exit_code).fold(0, worse);
        if let Err(failure) = written {
            Printer::explain(None, &failure);
            code = worse(code, failure.exit_code());
        }
        if self.ci.is_wanted() {
            let suites: Vec<TestSuite> = answers.iter().map(Answer::suite).collect();
            for failure in self.ci.finish(&suites, &self.read()) {
                Printer::explain(None, &failure);
                // CI decides by its file: without it, the verdict of the answers must not look valid.
                code = BROKEN;
            }
        }
        code
    }
}

impl<R> Answer<R> {
    /// The input as it was named.
    pub(crate) fn input(&self) -> String {
        visible_path(&self.input)
    }

    /// The report, or why there is none.
    pub(crate) fn report(&self) -> Result<&R, String> {
        self.result.as_ref().map_err(|failure| reason(failure).message)
    }
}

impl<R: BatchReport> Answer<R> {
    fn exit_code(&self) -> u8 {
        match &self.result {
            Ok(report) => report.exit_code(),
            Err(failure) => failure.exit_code(),
        }
    }

    fn entry(&self) -> AnswerEntry<'_, R> {
        match &self.result {
            Ok(report) => AnswerEntry::Report { input: self.input.display().to_string(), report },
            Err(failure) => AnswerEntry::Refusal(Refusal::from(failure).with_input(&self.input)),
        }
    }

    fn suite(&self) -> TestSuite {
        let suite = match &self.result {
            Ok(report) => report.test_suite(&name_of(&self.input)),
            Err(failure) => refused_suite(&self.input, failure),
        };
        in_repository(suite.measured(self.wall_s))
    }

    /// The report, or the first reason why there is none, for people.
    fn text(&self) -> String {
        match &self.result {
            Ok(report) => report.text(),
            Err(failure) => {
                let reason = reason(failure).message;
                let mut lines = reason.lines();
                // The others were printed in full when the input was answered.
                let first = lines.next().unwrap_or_default();
                let more = match lines.count() {
                    0 => String::new(),
                    count => format!(" (and {count} more)"),
                };
                format!("  {first}{more}\n")
            }
        }
    }
}

/// The name of an input in files for CI: `.` says there nothing, and the folder has the name of the robot.
fn name_of(input: &Path) -> String {
    match input.canonicalize() {
        Ok(folder) if input.file_name().is_none() => {
            visible_path(Path::new(folder.file_name().unwrap_or(input.as_os_str())))
        }
        _ => visible_path(input),
    }
}

/// The suite of an input that could not start.
fn refused_suite(input: &Path, failure: &Failure) -> TestSuite {
    let mut suite = TestSuite::with_case(visible_path(input), "start", TestResult::Error(reason(failure)));
    suite.cases.iter_mut().for_each(|case| case.place = place(failure));
    suite
}

/// Exit codes as people read them, the worst first.
const WORDS: [(u8, &str); 5] = [
    (BROKEN, "BROKEN"),
    (BAD_INPUT, "BAD INPUT"),
    (FAILED, "FAILED"),
    (NOTHING, "NOT CHECKED"),
    (0, "passed"),
];

/// All answers for people, the worst first, each below its input, and how many there are of each kind.
fn text<R: BatchReport>(answers: &[Answer<R>]) -> String {
    let (mut text, mut counts) = (String::new(), Vec::new());
    for (code, word) in WORDS {
        // By code rather than by order of the arguments: what failed is read first.
        let of_code = || answers.iter().filter(|answer| answer.exit_code() == code);
        for answer in of_code() {
            let _ = write!(text, "{}: {word}\n{}", visible_path(&answer.input), answer.text());
        }
        if of_code().next().is_some() {
            counts.push(format!("{} {word}", of_code().count()));
        }
    }
    let _ = writeln!(text, "{} inputs: {}", answers.len(), counts.join(", "));
    text
}

/// All answers in the order of the inputs, a line each.
fn lines<R: BatchReport>(answers: &[Answer<R>]) -> String {
    let line = |answer: &Answer<R>| match &answer.result {
        Ok(report) => report.one_line().map_or_else(|| report.text(), |line| line + "\n"),
        Err(_) => format!("{}: BAD INPUT: {}", visible_path(&answer.input), answer.text().trim_start()),
    };
    answers.iter().map(line).collect()
}

/// A failure as the reason of a test case, one line for each finding that is shown.
fn reason(failure: &Failure) -> Reason {
    match failure {
        Failure::Machine(message) => Reason { kind: "machine".to_owned(), message: message.clone() },
        Failure::Input(findings) => {
            let shown = findings.iter().take(MOST_FINDINGS);
            let mut lines: Vec<String> = shown.map(|finding| Finding::from(finding).to_string()).collect();
            if findings.len() > MOST_FINDINGS {
                lines.push(format!("and {} more", findings.len() - MOST_FINDINGS));
            }
            // The code of the first finding: CI groups failures by it.
            let kind = findings.first().code.name.to_owned();
            Reason { kind, message: lines.join("\n") }
        }
    }
}

/// The line of the first finding that has one.
fn place(failure: &Failure) -> Option<CasePlace> {
    let Failure::Input(findings) = failure else { return None };
    let of = |finding: Finding| CasePlace::if_known(finding.file.as_deref(), finding.line);
    findings.iter().map(Finding::from).find_map(of)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terminal::print::{Format, Verbosity};

    #[derive(Serialize)]
    struct Passed;

    impl BatchReport for Passed {
        fn exit_code(&self) -> u8 {
            0
        }

        fn text(&self) -> String {
            "  answered\n".to_owned()
        }

        fn test_suite(&self, input: &str) -> TestSuite {
            TestSuite::with_case(input, "test", TestResult::Passed)
        }
    }

    #[test]
    fn a_panic_does_not_affect_the_other_answers() {
        let folder = tempfile::tempdir().unwrap();
        let junit = folder.path().join("junit.xml");
        let inputs = ["a.toml", "b.toml", "c.toml"].map(PathBuf::from);
        let printer = Printer::new(Format::Human, Verbosity::Usual);
        let ci = CiArguments::with_junit(&junit);
        let batch = Batch::begin(&inputs, &ci, &printer).unwrap();
        // On threads of their own, as scenarios run.
        let work = |input: &Path| {
            assert!(input != Path::new("b.toml"), "a fault of the program");
            Ok(Passed)
        };
        let answer = |input: &PathBuf| batch.answer(input, || work(input));
        let answers: Vec<Answer<Passed>> = std::thread::scope(|scope| {
            let answer = &answer;
            let spawn = |input| scope.spawn(move || answer(input));
            let threads: Vec<_> = inputs.iter().map(spawn).collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).collect()
        });
        let codes: Vec<u8> = answers.iter().map(Answer::exit_code).collect();
        assert_eq!(codes, [0, BROKEN, 0]);
        let shown = text(&answers);
        assert!(shown.contains("b.toml: BROKEN\n  b.toml ended in an internal error"), "{shown}");
        assert!(shown.contains("a.toml: passed\n  answered") && shown.contains("c.toml: passed"), "{shown}");
        assert_eq!(batch.finish(answers).ok(), Some(BROKEN));
        let junit = std::fs::read_to_string(junit).unwrap();
        assert!(junit.contains("tests=\"3\"") && junit.contains("errors=\"1\""), "{junit}");
    }
}
