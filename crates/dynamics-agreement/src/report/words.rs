//! The comparison in sentences.

use congruent_description::display::{length, number, quantity, quantity_in_full};

use super::content::{DynamicsExplanation, DynamicsReport, DynamicsVerdict};
use crate::{
    bound::TorqueBracket,
    compare::{Compared, FigureDifference, Invariants, LimitDifference},
    diagnosis::{DynamicsCause, FaultySide},
    thresholds::{Precision, SAME_FIGURE},
};

/// Figures that a suggestion names one by one.
const MOST_FIGURES: usize = 10;

/// What to write into the file; `None` if the file is right, or if too much of it would have to change.
pub(super) fn suggestion(faulty: FaultySide, figures: &[FigureDifference]) -> Option<String> {
    if faulty == FaultySide::Reference || figures.is_empty() || figures.len() > MOST_FIGURES {
        return None;
    }
    let values: Vec<String> = figures
        .iter()
        .filter_map(|figure| Some(format!("{}: {} = {}", figure.of, figure.figure, figure.expected?)))
        .collect();
    Some(values.join(", ").trim_start_matches(": ").to_owned())
}

impl FigureDifference {
    /// `shoulder_link: mass is 2.63 kg, expected 3.76 kg`.
    pub fn sentence(&self) -> String {
        let [found, expected] = told_apart(self.found, self.expected, &self.unit, "not given");
        let what = format!("{} is {found}, expected {expected}", self.figure);
        if self.of.is_empty() { what } else { format!("{}: {what}", self.of) }
    }
}

impl DynamicsExplanation {
    /// `forearm_link: the centre of mass is given in another unit (mm)`.
    pub fn sentence(&self) -> String {
        let place = match self.place.join(", ") {
            all if all == "*" && self.cause.is_of_joints() => "all joints".to_owned(),
            all if all == "*" => "all links".to_owned(),
            place => place,
        };
        let text = if self.cause == DynamicsCause::Several {
            let parts =
                self.parts.iter().map(|part| format!("{}: {}", part.place.join(", "), part.cause.text()));
            return parts.collect::<Vec<String>>().join("; ");
        } else {
            self.cause.text()
        };
        if self.detail.is_empty() {
            format!("{place}: {text}")
        } else {
            format!("{place}: {text} ({})", self.detail)
        }
    }
}

impl DynamicsCause {
    fn is_of_joints(self) -> bool {
        (Self::JointTermsMissing..=Self::Armature).contains(&self)
    }
}

impl LimitDifference {
    /// `elbow_joint: velocity limit is 10313 deg/s, expected 180 deg/s, 57.3 times as much: degrees?`.
    pub fn sentence(&self) -> String {
        let [found, expected] = told_apart(self.found, self.expected, &self.unit, "not stated");
        let factor = self.factor.map_or_else(String::new, |factor| format!(", factor {}", number(factor)));
        let unit = if self.detail.is_empty() { String::new() } else { format!(": in {}?", self.detail) };
        let remark =
            if self.decides { "" } else { "; only one of the two states it, which is no disagreement" };
        format!("{}: {} limit is {found}, expected {expected}{factor}{unit}{remark}", self.joint, self.figure)
    }
}

/// Two values with as many digits as it takes to tell them apart: as they are written if three do not.
fn told_apart(found: Option<f64>, expected: Option<f64>, unit: &str, nothing: &str) -> [String; 2] {
    let texts = [found, expected]
        .map(|value| value.map_or_else(|| nothing.to_owned(), |value| quantity(value, unit)));
    match found.zip(expected) {
        Some((a, b)) if texts[0] == texts[1] && a.total_cmp(&b).is_ne() => {
            [a, b].map(|value| quantity_in_full(value, unit))
        }
        _ => texts,
    }
}

impl Invariants {
    /// Masses, centre of mass, gravity torque and mass matrix, as far as they differ.
    pub fn sentences(&self) -> Vec<String> {
        let mass = |what: &str, Compared { found, expected }: Compared| {
            let differs = (found - expected).abs() > SAME_FIGURE * expected.abs();
            let values = told_apart(Some(found), Some(expected), "kg", "");
            differs.then(|| format!("{what} {}, expected {}", values[0], values[1]))
        };
        let com = self.com_distance_m.filter(|distance| *distance > SAME_FIGURE);
        let gravity = self.gravity_joint.as_ref().filter(|_| self.gravity_n_m > SAME_FIGURE);
        let matrix = self.mass_matrix_relative.filter(|relative| *relative > SAME_FIGURE);
        let sentences = [
            mass("total mass", self.total_mass_kg),
            mass("moving mass", self.moving_mass_kg),
            com.map(|distance| format!("centre of mass of what moves, at zero, off by {}", length(distance))),
            gravity.map(|joint| {
                format!(
                    "gravity torques seen to differ by up to {} at {joint}",
                    quantity(self.gravity_n_m, &self.gravity_unit)
                )
            }),
            matrix.map(|relative| {
                format!("inertia seen to differ by up to {} % in some direction", number(relative * 100.0))
            }),
        ];
        sentences.into_iter().flatten().collect()
    }
}

impl DynamicsReport {
    /// Everything that a person reads of it, the result first.
    pub fn sentences(&self) -> Vec<String> {
        let mut sentences = vec![self.headline()];
        for explanation in &self.explanations {
            sentences.push(explanation.sentence());
            sentences.extend(explanation.figures.iter().map(FigureDifference::sentence));
        }
        sentences.extend(self.limits.iter().map(LimitDifference::sentence));
        sentences.extend(self.hidden_sentences());
        if !self.has_same_torques() {
            sentences.extend(self.invariants.iter().flat_map(Invariants::sentences));
        }
        sentences.extend(self.worst_gravity().map(TorqueBracket::sentence));
        sentences
    }

    /// The result with its numbers in one sentence.
    pub fn headline(&self) -> String {
        let states = number(count(self.premise.states));
        let [equal, percent] = [1.0, 100.0].map(|unit| number(self.difference_relative * unit));
        match self.verdict {
            DynamicsVerdict::Same | DynamicsVerdict::SameTorques => {
                format!("torques equal but for {equal} of them at {states} states; {}", self.seen_sentence())
            }
            DynamicsVerdict::Explained => {
                format!("torques differ by {percent} % at {states} states, explained")
            }
            DynamicsVerdict::Unexplained => {
                let no_body = self.premise.fit_relative;
                let of_no_body = if no_body > Precision::ENGINE.of_torque {
                    let percent = number(no_body * 100.0);
                    format!(
                        "; {percent} % of them are torques that no masses and inertias at these joints have"
                    )
                } else {
                    String::new()
                };
                format!(
                    "torques differ by {percent} % at {states} states, and no known cause explains it{of_no_body}"
                )
            }
        }
    }

    /// The largest difference of gravity torque, if it was asked for and there is one.
    pub fn worst_gravity(&self) -> Option<&TorqueBracket> {
        self.certificates.as_ref()?.gravity.worst.as_ref()
    }

    /// What no torque shows, in words with the numbers that are meant.
    pub fn hidden_sentences(&self) -> Vec<String> {
        let hidden = self.hidden_differences.iter();
        hidden.map(|figure| format!("{}; no joint torque shows it", figure.sentence())).collect()
    }

    /// How much of the inertial numbers torques tell.
    pub fn seen_sentence(&self) -> String {
        let seen = &self.seen;
        let all = format!("joint torques show {} of {} inertial numbers", seen.numbers, seen.of);
        match seen.weak {
            0 => all,
            weak => format!("{all}, {} of them only by the rounding of the axes", number(count(weak))),
        }
    }
}

impl TorqueBracket {
    /// `3.43 N m at shoulder_lift_joint (2.3 % of its effort), certified below 3.44 N m over the whole joint range`.
    pub fn sentence(&self) -> String {
        let share = self.share_of_effort.map(|share| format!(" ({} % of its effort)", number(share * 100.0)));
        format!(
            "{} at {}{}, certified below {} over the whole joint range",
            quantity(self.attained_n_m, &self.unit),
            self.joint,
            share.unwrap_or_default(),
            quantity(self.certified_n_m, &self.unit),
        )
    }
}

fn count(number: usize) -> f64 {
    f64::from(u32::try_from(number).unwrap_or(u32::MAX))
}
