//! What differs in masses, losses and limits, in words: as the first line of a check says it.

use std::path::Path;

use congruent_dynamics_agreement::{
    DynamicsExplanation, DynamicsReport, LimitCause, LimitDifference, ParameterDifference,
};

use super::{
    cause_in_words::{and_more, place},
    robot_check::RobotCheck,
};

impl RobotCheck {
    /// The first cause of different torques, and how many more there are.
    pub(super) fn cause_of_torques(&self, report: &DynamicsReport) -> String {
        let Some(first) = report.explanations.first() else { return report.headline() };
        let (sentence, remark, line) = if let [only] = &first.parameters[..] {
            // With two files the sentence has the line.
            let line = only.line.filter(|_| self.files_of(report).is_none());
            (self.value_in_words(report, only), only.unit_remark(), line)
        } else {
            let value = self.first_value(report, first);
            // The value has its line.
            let line = first.line.filter(|_| value.is_none());
            (first.sentence(), value, line)
        };
        let remark = remark.map_or_else(String::new, |remark| format!(": {remark}"));
        sentence + &place(first.file.as_deref(), line) + &remark + &and_more(report.explanations.len() - 1)
    }

    /// A parameter with both values.
    fn value_in_words(&self, report: &DynamicsReport, value: &ParameterDifference) -> String {
        match self.files_of(report) {
            Some(files) => value.sentence_in(short_names(files)),
            None => value.sentence(),
        }
    }

    /// Of several parameters the one whose values say most: the mass of a link, or the first of joints.
    fn first_value(&self, report: &DynamicsReport, explanation: &DynamicsExplanation) -> Option<String> {
        let is_mass = |of: &&ParameterDifference| of.parameter == "mass";
        let of_joints = || explanation.parameters.first().filter(|_| explanation.cause.is_of_joints());
        let value = explanation.parameters.iter().find(is_mass).or_else(of_joints)?;
        let sentence = self.value_in_words(report, value);
        let of_named = format!("{}: ", value.of);
        let is_named = explanation.place == [value.of.clone()];
        Some(sentence.strip_prefix(&of_named).filter(|_| is_named).map(str::to_owned).unwrap_or(sentence))
    }

    /// The limit that disagrees most, and how many more do.
    pub(super) fn limits(&self, report: &DynamicsReport) -> String {
        let decide: Vec<&LimitDifference> =
            report.limits.iter().filter(|difference| difference.decides).collect();
        let Some(first) = decide.iter().rev().max_by(|a, b| severity(a).total_cmp(&severity(b))) else {
            return String::new();
        };
        let rest = and_more(decide.len() - 1);
        match self.files_of(report) {
            Some(files) => format!(": {}{rest}", first.sentence_in(short_names(files))),
            None => format!(": {}{}{rest}", first.sentence(), place(first.file.as_deref(), first.line)),
        }
    }

    /// That limits disagree beside torques.
    pub(super) fn other_limits(&self, report: &DynamicsReport) -> String {
        if report.has_other_limits() {
            format!("; limits differ, too{}", self.limits(report))
        } else {
            String::new()
        }
    }

    /// The two files of a comparison with --against: the caller has not said that one of them is right.
    pub fn files_of<'r>(&self, report: &'r DynamicsReport) -> Option<[&'r str; 2]> {
        report.sides.files().filter(|_| self.against.is_some())
    }
}

/// How far two limits are apart: ends of ranges in rad or m, others as the logarithm of their ratio. A limit that one file lacks is
/// farthest.
fn severity(of: &LimitDifference) -> f64 {
    let Some((found, expected)) = of.found.zip(of.expected) else { return f64::INFINITY };
    match (of.cause, of.factor) {
        (LimitCause::PositionLimit, _) => (found - expected).abs(),
        (_, Some(factor)) => libm::log(factor.abs()).abs(),
        (_, None) => f64::MAX,
    }
}

/// The names of two files without their folders, if they differ.
fn short_names(files: [&str; 2]) -> [&str; 2] {
    let names = files.map(|file| Path::new(file).file_name().and_then(|name| name.to_str()).unwrap_or(file));
    if names[0] == names[1] { files } else { names }
}

/// What differs in the dynamics of two descriptions beside their poses.
pub(super) fn other_torques(check: &RobotCheck) -> String {
    let mut compared = check.dynamics_of_descriptions().filter(|_| check.against.is_some());
    let differing = compared.find(|report| !report.agrees());
    differing.map_or_else(String::new, |report| {
        let torques = if report.has_same_torques() {
            String::new()
        } else {
            format!("; torques differ, too: {}", check.cause_of_torques(report))
        };
        torques + &check.other_limits(report)
    })
}
