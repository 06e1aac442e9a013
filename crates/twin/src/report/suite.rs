//! Reports as CI sees them: a suite for each input, a case for each check of it.

/// The cases of one input: a scenario, a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct TestSuite {
    /// Its name.
    pub name: String,
    /// Its cases.
    pub cases: Vec<TestCase>,
    /// How long it took. The cases are computed together: each gets an equal share, so that sums are right.
    pub time_s: f64,
    /// The clock of that time.
    pub clock: Clock,
}

/// The clock of a suite's time; the file names it in the suite's property `clock`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clock {
    /// Time in the simulation, the same in every run.
    Simulated,
    /// Time of the machine, different in every run.
    Wall,
}

/// One check.
#[derive(Debug, Clone, PartialEq)]
pub struct TestCase {
    /// Its name.
    pub name: String,
    /// Its result.
    pub result: TestResult,
    /// What it has found, also if it passed.
    pub output: String,
    /// The line that it is about: of the check, or of what is wrong.
    pub place: Option<CasePlace>,
}

/// A line of a file, as CI shows it beside the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CasePlace {
    /// The file, as it was named.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
}

/// The result of a test case.
#[derive(Debug, Clone, PartialEq)]
pub enum TestResult {
    /// As expected.
    Passed,
    /// Checked, and not as expected.
    Failed(Reason),
    /// It could not be checked.
    Error(Reason),
    /// There was nothing to check.
    Skipped(String),
}

/// Why a test case did not pass.
#[derive(Debug, Clone, PartialEq)]
pub struct Reason {
    /// Its kind, for programs: a check, or the code of a finding.
    pub kind: String,
    /// The reason for people.
    pub message: String,
}

impl CasePlace {
    /// The place, if file and line are known.
    pub fn of(file: Option<&str>, line: Option<usize>) -> Option<Self> {
        Some(Self { file: file?.to_owned(), line: line? })
    }
}

impl TestResult {
    /// Why it is no success; `None` if it is one, or was skipped.
    pub fn reason(&self) -> Option<&Reason> {
        match self {
            Self::Failed(reason) | Self::Error(reason) => Some(reason),
            Self::Passed | Self::Skipped(_) => None,
        }
    }
}

impl TestSuite {
    /// The suite of an input with a single case, that gets no time of its own.
    pub fn of_case(name: impl Into<String>, case: &str, result: TestResult) -> Self {
        let case = TestCase { name: case.to_owned(), result, output: String::new(), place: None };
        Self { name: name.into(), cases: vec![case], time_s: 0.0, clock: Clock::Wall }
    }

    /// The same suite with the time that was measured.
    #[must_use]
    pub fn measured(mut self, wall_s: f64) -> Self {
        (self.time_s, self.clock) = (wall_s, Clock::Wall);
        self
    }
}
