//! The comparison in sentences.

use congruent_description::display::{number, quantity};

use super::content::{DynamicsExplanation, DynamicsReport};
use crate::{
    bound::TorqueBracket,
    compare::FigureDifference,
    diagnosis::{DynamicsCause, FaultySide},
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
        let value = |value: Option<f64>| {
            value.map_or_else(|| "not given".to_owned(), |value| quantity(value, &self.unit))
        };
        let what = format!("{} is {}, expected {}", self.figure, value(self.found), value(self.expected));
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

impl DynamicsReport {
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
