//! The answer of a comparison with measurements: in a line, and as a test suite for CI.

use congruent_calibration::{MeasuredCheck, MeasuredDifference, MeasuredVerdict, report::CalibratedModel};
use congruent_description::RequestedTolerance;
use congruent_input::display::{angle, counted, length, length_and_angle};
use congruent_results::report::{CasePlace, Reason, TestCase, TestResult, TestSuite};

use super::headline::Headline;

/// The first line of `check --measurements`: whether the model is the measured robot, how far the worst row is off, and where it is.
pub fn measured_headline(check: &MeasuredCheck) -> Headline {
    // The largest of each, which may be of two rows.
    let worst = length_and_angle(check.differences.worst_m, check.differences.worst_rad);
    let rms = length_and_angle(check.differences.rms_m, check.differences.rms_rad);
    let model = match check.model {
        CalibratedModel::Dh => "DH table",
        CalibratedModel::Urdf => "URDF",
    };
    let fitted = match &fitted_frames(check)[..] {
        [] => String::new(),
        frames => format!(" after {} fitted", was(frames)),
    };
    let is_open = check.camera.as_ref().is_some_and(|camera| !camera.undetermined.is_empty());
    let fitted = if is_open { fitted + ", which these measurements do not determine" } else { fitted };
    let tolerance = tolerance(check.tolerance);
    let (rows, frame) = (counted(check.rows, "measurement"), &check.measured_frame);
    match check.verdict {
        MeasuredVerdict::Agree => Headline {
            answer: "SAME AS MEASURED".to_owned(),
            details: format!(
                ". {model} and {rows} of {frame} agree within {worst}{fitted} (root mean square {rms}, tolerance {tolerance})"
            ),
        },
        MeasuredVerdict::Disagree => Headline {
            answer: "DIFFERENT FROM MEASURED".to_owned(),
            details: format!(
                ", by up to {worst} at {frame} ({model} against {rows}{fitted}); {} beyond the tolerance of {tolerance}, root mean \
                 square {rms}. Worst: measurement {} ({}:{})",
                are(check.rows_beyond, check.rows),
                check.worst.row,
                check.measurements,
                check.worst.line
            ),
        },
    }
}

/// The frames that were fitted before the comparison: `base`, `tool`, or those of a camera and its target.
pub(crate) fn fitted_frames(check: &MeasuredCheck) -> Vec<&'static str> {
    if check.camera.is_some() {
        return vec!["camera", "target"];
    }
    let has = |frame: &&str| check.fitted.iter().any(|of| of.name.split('.').next() == Some(*frame));
    ["base", "tool"].into_iter().filter(has).collect()
}

/// The comparison as a test suite of one case; `name` distinguishes the robot from the others of the file.
pub fn measured_suite(name: &str, check: &MeasuredCheck) -> TestSuite {
    let output = measured_headline(check).to_string();
    let result = match check.verdict {
        MeasuredVerdict::Agree => TestResult::Passed,
        MeasuredVerdict::Disagree => {
            TestResult::Failed(Reason { kind: "measurements".to_owned(), message: output.clone() })
        }
    };
    let failed = result.reason().is_some();
    let place = |row: &MeasuredDifference| CasePlace { file: check.measurements.clone(), line: row.line };
    let case = TestCase {
        name: format!("model against {}", check.measurements),
        result,
        output,
        place: failed.then(|| place(&check.worst)),
        further: Vec::new(),
    };
    TestSuite { cases: vec![case], ..TestSuite::new(name) }
}

fn was(frames: &[&str]) -> String {
    let verb = if frames.len() > 1 { "were" } else { "was" };
    format!("{} {verb}", frames.join(" and "))
}

/// How many of the rows are.
fn are(count: usize, all: usize) -> String {
    format!("{count} of {all} {}", if count == 1 { "is" } else { "are" })
}

fn tolerance(tolerance: RequestedTolerance) -> String {
    let parts = [tolerance.position_m.map(length), tolerance.orientation_rad.map(angle)];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" and ")
}
