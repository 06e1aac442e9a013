//! Reports in the form of CI systems: a suite for each input, a case for each check of it.

/// The cases of one input: a scenario, a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct TestSuite {
    /// Name of the input: of the scenario or of the robot.
    pub name: String,
    /// One case for each check of the input.
    pub cases: Vec<TestCase>,
    /// What the input does otherwise than in an earlier revision, if it was compared with one.
    pub change: Option<ChangeSince>,
    /// Duration of the suite. The cases are computed together: each gets an equal share, so that sums are right.
    pub time_s: f64,
    /// The clock of that duration.
    pub clock: Clock,
}

/// What changes in an input since a revision. A change is no fault: CI hosts show it as a notice.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChangeSince {
    /// The revision, as the caller names it.
    pub revision: String,
    /// What changes, in one sentence, or that nothing does.
    pub sentence: String,
    /// Whether anything changes.
    pub is_changed: bool,
    /// The lines that change, each with what changes there.
    pub places: Vec<(CasePlace, String)>,
}

/// The clock of a suite's time; the file names it in the suite's property `clock`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clock {
    /// Time in the simulation, the same in every run.
    Simulated,
    /// Time of the machine, different in every run.
    Wall,
}

/// One check of an input.
#[derive(Debug, Clone, PartialEq)]
pub struct TestCase {
    /// Name of the case: number and kind of the check.
    pub name: String,
    /// Whether the check had the expected result.
    pub result: TestResult,
    /// Lines of the check in the report, also if it passed.
    pub output: String,
    /// Line of the check, or of the finding.
    pub place: Option<CasePlace>,
    /// Further lines that the same failure names, each with what is wrong there.
    pub further: Vec<(CasePlace, String)>,
}

/// A line of a file, as CI shows it beside the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CasePlace {
    /// The file, as it was named.
    pub file: String,
    /// Line in that file, from 1.
    pub line: usize,
}

/// The result of a test case.
#[derive(Debug, Clone, PartialEq)]
pub enum TestResult {
    /// The check has the expected result.
    Passed,
    /// The check has another result than expected.
    Failed(Reason),
    /// The check finds what the input does otherwise than in an earlier revision, which is a failure in JUnit and no fault.
    Changed(Reason),
    /// The check could not be evaluated.
    Error(Reason),
    /// There was nothing to check.
    Skipped(String),
}

/// Why a test case did not pass.
#[derive(Debug, Clone, PartialEq)]
pub struct Reason {
    /// Kind of the reason for programs: a kind of check, or the code of a finding.
    pub kind: String,
    /// The reason as text.
    pub message: String,
}

impl CasePlace {
    /// The place, if file and line are known.
    pub fn if_known(file: Option<&str>, line: Option<usize>) -> Option<Self> {
        Some(Self { file: file?.to_owned(), line: line? })
    }
}

impl ChangeSince {
    /// The revision for people: of the hash of a commit as many digits as distinguish it.
    pub fn short_revision(&self) -> &str {
        const DIGITS: usize = 12;
        let is_hash = self.revision.len() == 40 && self.revision.bytes().all(|of| of.is_ascii_hexdigit());
        if is_hash { &self.revision[..DIGITS] } else { &self.revision }
    }
}

impl TestResult {
    /// Why the case did not pass; `None` if it passed or was skipped.
    pub fn reason(&self) -> Option<&Reason> {
        match self {
            Self::Failed(reason) | Self::Changed(reason) | Self::Error(reason) => Some(reason),
            Self::Passed | Self::Skipped(_) => None,
        }
    }
}

impl TestSuite {
    /// The suite of an input with a single case and no duration.
    pub fn with_case(name: impl Into<String>, case: &str, result: TestResult) -> Self {
        let case = TestCase {
            name: case.to_owned(),
            result,
            output: String::new(),
            place: None,
            further: Vec::new(),
        };
        Self { cases: vec![case], ..Self::new(name) }
    }

    /// The suite of an input without cases, no duration and no change.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), cases: Vec::new(), change: None, time_s: 0.0, clock: Clock::Wall }
    }

    /// The same suite with a duration that was measured by the wall clock.
    #[must_use]
    pub fn measured(mut self, wall_s: f64) -> Self {
        (self.time_s, self.clock) = (wall_s, Clock::Wall);
        self
    }
}
