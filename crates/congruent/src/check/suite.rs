//! The report of a check as a test suite, which CI reads as JUnit: one case for each comparison of poses and of dynamics.

use congruent_agreement::{
    SourcePair,
    compare::{Agreement, CheckReport, ComparedSource, Comparison, Grade, NotCompared, ReportedCertificate},
    report::{ReportedDiagnosis, foremost},
};
use congruent_dynamics_agreement::DynamicsReport;
use congruent_input::{display::length_and_angle, serde_name};
use congruent_kinematics::PoseError;
use congruent_results::report::{CasePlace, Reason, TestCase, TestResult, TestSuite};

use super::{
    cause_in_words::places,
    change::is_of_revision,
    change_answer::{change_case, change_since},
    judged_by::comparison_judged_by,
    mapped_joints::mapped_joints,
    robot_check::RobotCheck,
};

/// The comparisons of a report as test cases; what failed names its cause with the line.
///
/// `name` distinguishes this robot from the others of the file, as its path does.
pub fn check_suite(name: &str, report: &RobotCheck) -> TestSuite {
    let geometry = &report.geometry;
    let mut cases: Vec<TestCase> =
        geometry.comparisons.iter().map(|comparison| case(comparison, report)).collect();
    let not_compared = report.against.as_ref().and_then(|against| against.dynamics_not_compared.as_ref());
    cases.extend(not_compared.map(|why| TestCase {
        name: "dynamics against the other description".to_owned(),
        result: of_other(report, Reason { kind: "other_chain".to_owned(), message: why.clone() }),
        output: why.clone(),
        place: None,
        further: Vec::new(),
    }));
    cases.extend(change_case(report));
    cases.extend(mapping_case(report));
    cases.extend(report.all_dynamics().map(|dynamics| dynamics_case(dynamics, report)));
    cases.extend(geometry.not_asked.iter().map(|source| not_compared_case(source, report)));
    let dropped = geometry
        .warnings
        .iter()
        .filter(|found| found.code == congruent_description::codes::chain::TABLE_DROPPED.name);
    cases.extend(dropped.map(|found| skipped("table", found.message.clone())));
    cases.push(lint_case(report));
    // Nothing moves, so that no time passes but the machine's.
    let set = &geometry.chain.set_values;
    let name = if set.is_empty() { name.to_owned() } else { format!("{name} --set {}", set.join(", ")) };
    TestSuite { cases, change: change_since(report), ..TestSuite::new(&name) }
}

/// The result of a comparison with the other description that disagrees: of a revision it is a change.
fn of_other(report: &RobotCheck, reason: Reason) -> TestResult {
    if report.change.is_some() { TestResult::Changed(reason) } else { TestResult::Failed(reason) }
}

fn case(comparison: &Comparison, check: &RobotCheck) -> TestCase {
    let report = &check.geometry;
    let worst = &comparison.worst;
    let error = worst.error;
    let mut lines = vec![format!(
        "largest difference {} at {}, {}",
        length_and_angle(error.position_m, error.orientation_rad),
        worst.link,
        comparison_judged_by(report, comparison)
    )];
    lines.extend(grade(comparison, report));
    let result = if comparison.verdict == Agreement::Agree {
        lines.extend(certified(comparison, report));
        TestResult::Passed
    } else {
        lines.extend(causes(comparison, report));
        let kind = serde_name(&comparison.name).to_owned();
        let reason = Reason { kind, message: lines.join("\n") };
        if comparison.name == SourcePair::UrdfOther {
            of_other(check, reason)
        } else {
            TestResult::Failed(reason)
        }
    };
    let diagnosed = diagnosis_of(comparison, report).filter(|_| result.reason().is_some());
    let mut places = diagnosed.map(places).unwrap_or_default().into_iter();
    let place = places.next().map(|(place, _)| place);
    let (name, output) = (comparison.title.to_owned(), lines.join("\n"));
    TestCase { name, result, output, place, further: places.collect() }
}

/// How much alike the two files are, and what their digits allow.
fn grade(comparison: &Comparison, report: &CheckReport) -> Option<String> {
    let grade = report.grade.filter(|_| comparison.name.is_written())?;
    let allowed =
        report.allowed_by_digits.map_or_else(String::new, |PoseError { position_m, orientation_rad }| {
            format!(
                "; rounding of the written digits could explain {}",
                length_and_angle(position_m, orientation_rad)
            )
        });
    Some(format!("grade: {}{allowed}", grade.words()))
}

/// A source that was not compared; a second description of the geometry that is missing fails with --strict.
fn not_compared_case(source: &NotCompared, report: &RobotCheck) -> TestCase {
    let reasons: Vec<&str> = source.findings.iter().map(|found| found.message.as_str()).collect();
    let case = skipped(source.source.name(), reasons.join("\n"));
    if source.source != ComparedSource::Geometry || !report.fails_without_second() {
        return case;
    }
    let reason = Reason { kind: "no_second_description".to_owned(), message: case.output.clone() };
    TestCase { result: TestResult::Failed(reason), ..case }
}

/// A source that was not compared.
fn skipped(source: &str, why: String) -> TestCase {
    TestCase {
        name: source.replace('_', " "),
        result: TestResult::Skipped(why.clone()),
        output: why,
        place: None,
        further: Vec::new(),
    }
}

fn dynamics_case(report: &DynamicsReport, check: &RobotCheck) -> TestCase {
    let output = report.sentences().join("\n");
    let result = if report.agrees() {
        TestResult::Passed
    } else {
        let kind = report.explanations.first().map_or("dynamics", |first| first.cause.name()).to_owned();
        let reason = Reason { kind, message: output.clone() };
        if is_of_revision(report) { of_other(check, reason) } else { TestResult::Failed(reason) }
    };
    TestCase {
        name: format!("dynamics of {} against {}", report.sides.candidate, report.sides.reference),
        result,
        output,
        place: report
            .explanations
            .first()
            .and_then(|first| CasePlace::if_known(first.file.as_deref(), first.line)),
        further: Vec::new(),
    }
}

/// Whether the joints of the other description are those that the robot file declares.
fn mapping_case(report: &RobotCheck) -> Option<TestCase> {
    let mapping = report.against.as_ref()?.mapping.as_ref()?;
    let joints = mapped_joints(mapping);
    let output = format!("{joints}\nto declare it:\n{}", mapping.lines.join("\n"));
    let result = if mapping.is_declared {
        TestResult::Passed
    } else {
        of_other(report, Reason { kind: "mapping".to_owned(), message: output.clone() })
    };
    let name = "joints of the other description".to_owned();
    Some(TestCase { name, result, output, place: None, further: Vec::new() })
}

/// What lint finds, which fails if the caller says so.
fn lint_case(report: &RobotCheck) -> TestCase {
    let worst = &report.lint.worst;
    let lines: Vec<String> = worst.iter().map(ToString::to_string).collect();
    let output = lines.join("\n");
    let first = worst.first();
    let result = if report.fails_by_lint() {
        let kind = first.map_or_else(|| "lint".to_owned(), |found| found.code.to_string());
        TestResult::Failed(Reason { kind, message: output.clone() })
    } else {
        TestResult::Passed
    };
    let place = first.filter(|_| report.fails_by_lint());
    let place = place.and_then(|found| CasePlace::if_known(found.file.as_deref(), found.line));
    TestCase { name: "lint".to_owned(), result, output, place, further: Vec::new() }
}

/// The bound over the whole joint range, if the same two sources have one.
fn certified(comparison: &Comparison, report: &CheckReport) -> Option<String> {
    let same = |certificate: &&ReportedCertificate| certificate.name == comparison.name;
    let brackets = report.certificates.iter().find(same)?.brackets.as_ref()?;
    let bound = brackets.bounds();
    Some(format!(
        "certified at most {} over the whole joint range",
        length_and_angle(bound.position_m, bound.orientation_rad)
    ))
}

/// The cause by the diagnosis of the same two sources, otherwise by the first that has one.
fn causes(comparison: &Comparison, report: &CheckReport) -> Vec<String> {
    let statements = diagnosis_of(comparison, report).map(ReportedDiagnosis::statements).unwrap_or_default();
    if statements.is_empty() && report.grade == Some(Grade::SameWithinDigits) {
        return vec!["rounding explains it: without the declared tolerance the digits decide".to_owned()];
    }
    if statements.is_empty() {
        return vec!["no known cause explains it".to_owned()];
    }
    let starts = std::iter::once("cause: ").chain(std::iter::repeat("and: "));
    starts.zip(statements).map(|(start, line)| format!("{start}{line}")).collect()
}

fn diagnosis_of<'a>(comparison: &Comparison, report: &'a CheckReport) -> Option<&'a ReportedDiagnosis> {
    let same = report.diagnoses.iter().find(|diagnosis| diagnosis.name == comparison.name);
    same.filter(|diagnosis| diagnosis.is_explained()).or(foremost(&report.diagnoses))
}
