//! Joint limits that differ, as sentences: both values with their units, and their files if either may be wrong.

use congruent_input::display::{counted, limit_number, position};

use super::{content::DynamicsReport, parameter_sentence::place_in, sentences::with_distinct_digits};
use crate::differences::{
    LimitCause, LimitDifference,
    limits::{DEGREES_DETAIL, EXCHANGED, FOUR_TURNS, UNIFORM, UNIFORM_THERE},
};

impl LimitDifference {
    /// `elbow_joint: velocity limit is 10313 deg/s, expected 180 deg/s: in degrees?`.
    pub fn sentence(&self) -> String {
        let [found, expected] = self.values();
        let uniform = |is_reference: bool| {
            let found = if is_reference { "expected" } else { "found" };
            format!(": the one {found} for all joints, a placeholder?")
        };
        let remark = self.remark(uniform, |is_reference| match self.expected.filter(|_| is_reference) {
            Some(expected) => format!(": is the expected {} in {}?", limit_number(expected), self.detail),
            None => format!(": in {}?", self.detail),
        });
        format!("{}: {} limit is {found}, expected {expected}{remark}", self.joint, self.parameter)
    }

    /// `elbow_joint: velocity limit 10313 deg/s in a.urdf:5, 180 deg/s in b.urdf:7: is a.urdf in degrees?`, of two files of which
    /// either may be wrong.
    pub fn sentence_in(&self, files: [&str; 2]) -> String {
        let [found, expected] = self.values();
        let here = place_in(files[0], self.line, self.elsewhere.as_ref());
        let there = place_in(files[1], self.expected_line, self.expected_elsewhere.as_ref());
        let written = self.expected_as_written.map_or_else(String::new, |written| {
            format!(" (written as {} in the variable there)", position(written, self.unit.symbol()))
        });
        let uniform = |is_reference: bool| {
            format!(": {} has it for all joints, a placeholder?", files[usize::from(is_reference)])
        };
        let remark = self.remark(uniform, |is_reference| {
            // What is read as degrees, as the angles of an MJCF, is too small.
            let (at, unit) = if self.smaller_in_radians() {
                (!is_reference, "radians")
            } else {
                (is_reference, &self.detail[..])
            };
            format!(": is {} in {unit}?", files[usize::from(at)])
        });
        format!(
            "{}: {} limit {found} in {here}, {expected} in {there}{written}{remark}",
            self.joint, self.parameter
        )
    }

    /// Whether the smaller value is the wrong one of two that differ by the factor of degrees: the larger is possible.
    fn smaller_in_radians(&self) -> bool {
        let larger = self.found.zip(self.expected).map(|(found, expected)| found.abs().max(expected.abs()));
        self.detail == DEGREES_DETAIL && larger.is_some_and(|larger| larger <= FOUR_TURNS)
    }

    fn values(&self) -> [String; 2] {
        with_distinct_digits(self.found, self.expected, self.unit.symbol(), "not stated")
    }

    /// What the values suggest: that they have changed places, or that one is for all joints or the larger one in another unit, which
    /// `uniform` and `in_unit` say of the reference or of the candidate.
    fn remark(&self, uniform: impl Fn(bool) -> String, in_unit: impl Fn(bool) -> String) -> String {
        match self.found.zip(self.expected) {
            _ if self.detail.is_empty() => String::new(),
            _ if self.detail == UNIFORM || self.detail == UNIFORM_THERE => {
                uniform(self.detail == UNIFORM_THERE)
            }
            _ if self.detail == EXCHANGED => match self.cause {
                LimitCause::PositionLimit => ": lower and upper are exchanged, with their signs".to_owned(),
                _ => ": effort and velocity are exchanged".to_owned(),
            },
            both => in_unit(both.is_some_and(|(found, expected)| found.abs() < expected.abs())),
        }
    }
}

impl DynamicsReport {
    /// The limits that disagree, with the files of both if either may be wrong.
    pub fn limit_sentences(&self, files: Option<[&str; 2]>) -> Vec<String> {
        let sentence = |limit: &LimitDifference| match files {
            Some(files) => limit.sentence_in(files),
            None => limit.sentence(),
        };
        self.limits.iter().filter(|limit| limit.decides).map(sentence).collect()
    }

    /// The limits of speed and effort that only one of the two states, so that they are not compared: a sentence for each kind,
    /// with its joints.
    pub fn one_sided_limit_sentences(&self) -> Vec<String> {
        let kind = |limit: &LimitDifference| (limit.parameter.clone(), limit.found.is_some());
        let one_sided: Vec<&LimitDifference> = self.limits.iter().filter(|limit| !limit.decides).collect();
        let mut kinds: Vec<(String, bool)> = Vec::new();
        for limit in &one_sided {
            if !kinds.contains(&kind(limit)) {
                kinds.push(kind(limit));
            }
        }
        let sentence = |of: (String, bool)| {
            let joints = one_sided.iter().filter(|limit| kind(limit) == of).map(|limit| limit.joint.as_str());
            let joints: Vec<&str> = joints.collect();
            let (parameter, is_own) = of;
            let file = if is_own { &self.sides.candidate } else { &self.sides.reference };
            format!(
                "not compared: {parameter} limits of {}, stated by {file} alone: {}",
                counted(joints.len(), "joint"),
                joints.join(", ")
            )
        };
        kinds.into_iter().map(sentence).collect()
    }
}
