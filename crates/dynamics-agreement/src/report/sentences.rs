//! The sentences of the report, for people.

use std::fmt::Write;

use congruent_input::display::{length, number, quantity, quantity_with_digits};
use congruent_kinematics::UNRANGED_SLIDE_M;

use super::content::{
    ComparedModels, DynamicsExplanation, DynamicsReport, DynamicsVerdict, TorqueCertificates,
};
use crate::{
    bound::{CoveredMotion, TorqueBracket},
    diagnosis::{DynamicsCause, FaultySide, MISSING_THERE},
    differences::{CandidateAndReference, Invariants, ParameterDifference},
    thresholds::{LARGEST_ACCELERATION, LARGEST_SPEED, MOST_JOINTS, Precision, SAME_VALUE},
};

/// Most parameters that a suggestion lists; more are better read in the edited lines.
const MOST_PARAMETERS: usize = 10;

/// The values to write into the file; `None` if the file is right, or if too many of its values change.
pub(super) fn suggestion(faulty: FaultySide, parameters: &[ParameterDifference]) -> Option<String> {
    if faulty == FaultySide::Reference || parameters.is_empty() || parameters.len() > MOST_PARAMETERS {
        return None;
    }
    let values: Vec<String> = parameters
        .iter()
        .filter_map(|parameter| {
            Some(format!("{}: {} = {}", parameter.of, parameter.parameter, parameter.expected?))
        })
        .collect();
    Some(values.join(", ").trim_start_matches(": ").to_owned())
}

impl DynamicsExplanation {
    /// `forearm_link: the centre of mass is given in another unit (mm)`.
    pub fn sentence(&self) -> String {
        if self.cause == DynamicsCause::Several {
            let mut sentence = String::new();
            let mut before = None;
            for part in &self.parts {
                let cause = part.cause.with_detail(&part.detail);
                let place = part.cause.at(&part.place);
                // Several causes of one link follow its name.
                let _ = match before {
                    None => write!(sentence, "{place}: {cause}"),
                    Some(known) if known == place => write!(sentence, ", {cause}"),
                    Some(_) => write!(sentence, "; {place}: {cause}"),
                };
                before = Some(place);
            }
            return sentence;
        }
        format!("{}: {}", self.cause.at(&self.place), self.cause.with_detail(&self.detail))
    }
}

impl DynamicsCause {
    /// The names of a place as the subject of a sentence.
    fn at(self, place: &[String]) -> String {
        match place.join(", ") {
            all if all == "*" && self.is_of_joints() => "all joints".to_owned(),
            all if all == "*" => "all links".to_owned(),
            place => place,
        }
    }

    /// `the centre of mass is given in another unit (mm)`.
    fn with_detail(self, detail: &str) -> String {
        match (self, detail) {
            // How many values a fit has set is seen in the list of them.
            (_, "" | "same" | "each") => self.text().to_owned(),
            (Self::ComUnit, "m") => {
                "the centre of mass is 1000 times too small: metres under com_mm, or metres divided by 1000"
                    .to_owned()
            }
            (Self::Rpy, MISSING_THERE) => {
                "the other file lacks the rotation of the inertial frame".to_owned()
            }
            (Self::InertiaRotation, MISSING_THERE) => {
                "the other file has the principal moments without their axes".to_owned()
            }
            (Self::InertiaAboutOrigin, _) => {
                "the parallel-axis term is subtracted from an inertia that is already about the centre of mass"
                    .to_owned()
            }
            _ => format!("{} ({detail})", self.text()),
        }
    }

    /// Whether the cause is a link that only one of the two files has.
    pub fn is_of_one_file(self) -> bool {
        matches!(self, Self::LinkMissing | Self::LinkAdded)
    }

    /// Whether the cause names only the values that are wrong, not how they became wrong.
    pub fn is_of_free_values(self) -> bool {
        matches!(
            self,
            Self::Mass
                | Self::Density
                | Self::ComEntry
                | Self::Com
                | Self::InertiaScale
                | Self::InertiaEntry
                | Self::Inertia
                | Self::Inertial
                | Self::Damping
        )
    }

    /// Whether the cause is one of losses or armatures of joints.
    pub fn is_of_joints(self) -> bool {
        (Self::JointTermsMissing..=Self::Armature).contains(&self)
    }
}

/// Two values with three digits, or with as many as distinguish them. Values that differ in their last digits only, as by
/// rounding, are one value and a difference.
pub(super) fn with_distinct_digits(
    found: Option<f64>,
    expected: Option<f64>,
    unit: &str,
    nothing: &str,
) -> [String; 2] {
    /// More digits are read one by one.
    const MOST_DIGITS: usize = 8;
    let texts = [found, expected]
        .map(|value| value.map_or_else(|| nothing.to_owned(), |value| quantity(value, unit)));
    let Some((a, b)) = found.zip(expected) else { return texts };
    if texts[0] != texts[1] || a.total_cmp(&b).is_eq() {
        return texts;
    }
    let rounded = |digits| [a, b].map(|value| quantity_with_digits(value, unit, digits));
    let digits = (4..=MOST_DIGITS).find(|&digits| rounded(digits)[0] != rounded(digits)[1]);
    let difference = || {
        let sign = if a < b { '-' } else { '+' };
        let difference = quantity_with_digits((a - b).abs(), unit, 2);
        [format!("{} {sign} {difference}", texts[1]), texts[1].clone()]
    };
    // Some more digits than distinguish the two show how large their difference is.
    digits.map_or_else(difference, |digits| rounded(digits + 2))
}

impl Invariants {
    /// Sentences about masses, centre of mass, gravity torques and mass matrix, each only if it differs; `other` is the file of
    /// the reference.
    pub fn sentences(&self, other: &str) -> Vec<String> {
        let mass = |what: &str, CandidateAndReference { found, expected }: CandidateAndReference| {
            let differs = (found - expected).abs() > SAME_VALUE * expected.abs();
            let values = with_distinct_digits(Some(found), Some(expected), "kg", "");
            differs.then(|| format!("{what} {}, {} in {other}", values[0], values[1]))
        };
        let com = self.com_distance_m.filter(|distance| *distance > SAME_VALUE);
        let gravity = self.gravity_joint.as_ref().filter(|_| self.gravity_n_m > SAME_VALUE);
        let matrix = self.mass_matrix_relative.filter(|relative| *relative > SAME_VALUE);
        let sentences = [
            mass("total mass", self.total_mass_kg),
            mass("moving mass", self.moving_mass_kg),
            com.map(|distance| {
                format!("centre of mass of the moving links, joints at zero, off by {}", length(distance))
            }),
            gravity.map(|joint| {
                format!(
                    "largest gravity torque difference at the compared states {} at {joint}",
                    quantity(self.gravity_n_m, self.gravity_unit.symbol())
                )
            }),
            matrix.map(|relative| {
                format!(
                    "largest mass matrix difference at the compared states {} %",
                    number(relative * 100.0)
                )
            }),
        ];
        sentences.into_iter().flatten().collect()
    }
}

impl ComparedModels {
    /// The files of the two models, of which either may be wrong; `None` if the reference is the program's own physics.
    pub fn files(&self) -> Option<[&str; 2]> {
        (self.reference != "physics").then_some([&self.candidate, &self.reference])
    }
}

impl DynamicsReport {
    /// Adds to each explanation the cause if the other of the two files is wrong.
    pub fn add_otherwise(&mut self, other: &Self) {
        for explanation in &mut self.explanations {
            // Matched by place: the same fault in the other file is at the same link or joint.
            let there = other.explanations.iter().find(|there| there.place == explanation.place);
            explanation.otherwise = there.map(|there| {
                let mut places =
                    there.file.iter().zip(there.line).map(|(file, line)| format!("{file}:{line}: "));
                let values: Vec<String> =
                    there.parameters.iter().take(3).map(ParameterDifference::sentence).collect();
                format!("{}{} ({})", places.next().unwrap_or_default(), there.sentence(), values.join("; "))
            });
        }
    }

    /// All sentences for a person, the result first.
    pub fn sentences(&self) -> Vec<String> {
        let mut sentences = vec![self.headline()];
        for explanation in &self.explanations {
            sentences.push(explanation.sentence());
            sentences.extend(explanation.parameters.iter().map(ParameterDifference::sentence));
        }
        sentences.extend(self.limit_sentences(self.sides.files()));
        sentences.extend(self.one_sided_limit_sentences());
        sentences.extend(self.hidden_sentences(self.sides.files()));
        sentences.extend(self.not_stated_sentence());
        sentences.extend(self.armature_sentence());
        if !self.has_same_torques() {
            sentences.extend(self.invariant_sentences());
        }
        sentences.extend(self.worst_gravity().map(TorqueBracket::sentence));
        sentences
    }

    /// The result in one sentence, with the relative torque difference and the number of states.
    pub fn headline(&self) -> String {
        let states = number(count(self.premise.states));
        let percent = number(100.0 * self.difference_relative);
        match self.verdict {
            DynamicsVerdict::Same | DynamicsVerdict::SameTorques => {
                let seen =
                    self.identifiability_sentence().map_or_else(String::new, |seen| format!("; {seen}"));
                format!("torques equal at {states} states{seen}")
            }
            DynamicsVerdict::NotCompared => match &self.not_stated[..] {
                [] => "torques are not compared: neither description states a mass".to_owned(),
                what => format!(
                    "torques are not compared, since {} does not state: {}",
                    self.sides.reference,
                    what.join("; ")
                ),
            },
            DynamicsVerdict::Explained => {
                format!("torques differ by {percent} % at {states} states; the cause is found:")
            }
            DynamicsVerdict::Unexplained if self.seen.is_none() => format!(
                "torques differ by {percent} % at {states} states; the cause is searched only for robots of at most {MOST_JOINTS} joints"
            ),
            DynamicsVerdict::Unexplained => {
                let no_body = self.premise.fit_relative;
                let of_no_body = if no_body > Precision::ENGINE.of_torque {
                    let percent = number(no_body * 100.0);
                    format!("; {percent} % of the torques cannot come from any rigid-body parameters")
                } else {
                    String::new()
                };
                format!(
                    "torques differ by {percent} % at {states} states, and no known cause explains it{of_no_body}"
                )
            }
        }
    }

    /// Masses, centre of mass, gravity torques and mass matrix of the two, as far as they differ.
    pub fn invariant_sentences(&self) -> Vec<String> {
        let invariants = self.invariants.iter();
        invariants.flat_map(|invariants| invariants.sentences(&self.sides.reference)).collect()
    }

    /// The bracket of the largest gravity torque difference, if it was requested and there is one.
    pub fn worst_gravity(&self) -> Option<&TorqueBracket> {
        self.certificates.as_ref()?.gravity.worst.as_ref()
    }

    /// The bracket of the largest torque difference in any covered motion, if it was requested and there is one.
    pub fn worst_in_motion(&self) -> Option<&TorqueBracket> {
        self.certificates.as_ref()?.together.worst.as_ref()
    }

    /// Sentences about parameters that differ without an effect on torques, with both values, and with the files of both if either
    /// may be wrong.
    pub fn hidden_sentences(&self, files: Option<[&str; 2]>) -> Vec<String> {
        let why = |parameter: &ParameterDifference| match (parameter.below_resolution, parameter.cancelled) {
            (Some(share), _) => format!(
                "it changes joint torques by {} (relative), below the resolution of {}",
                number(share),
                number(Precision::EXACT.same)
            ),
            (None, Some(share)) => format!(
                "the other differences cancel its effect on joint torques, {} (relative)",
                number(share)
            ),
            (None, None) => "it has no effect on joint torques".to_owned(),
        };
        let hidden = self.hidden_differences.iter();
        let sentence = |parameter: &ParameterDifference| match files {
            Some(files) => parameter.sentence_in(files),
            None => parameter.sentence(),
        };
        hidden.map(|parameter| format!("{}; {}", sentence(parameter), why(parameter))).collect()
    }

    /// What is not compared, since the reference does not state it; `None` if it states everything, or if nothing else is
    /// compared either, which is the headline.
    pub fn not_stated_sentence(&self) -> Option<String> {
        let says_more = !self.not_stated.is_empty() && self.verdict != DynamicsVerdict::NotCompared;
        let what = || format!("not compared ({} does not state them): ", self.sides.reference);
        says_more.then(|| what() + &self.not_stated.join("; "))
    }

    /// That armatures are not compared, if only one of the two files states them.
    pub fn armature_sentence(&self) -> Option<String> {
        let file = self.armature_stated_by.as_ref()?;
        Some(format!("not compared: armature, stated by {file} alone"))
    }

    /// On how many combinations of inertial parameters joint torques depend; `None` if it is not computed.
    pub fn identifiability_sentence(&self) -> Option<String> {
        let seen = self.seen?;
        let all = format!(
            "joint torques depend on {} combinations of the {} inertial parameters",
            seen.numbers, seen.of
        );
        Some(match seen.weak {
            0 => all,
            weak => format!("{all}, {} of them only through the rounding of joint axes", number(count(weak))),
        })
    }
}

impl TorqueBracket {
    /// `3.43 N m at shoulder_lift_joint, certified below 3.44 N m (2.3 % of its effort limit) over the whole joint range`.
    /// Only a bound near the difference that was found is called certified; it holds in any case.
    pub fn sentence(&self) -> String {
        let share =
            self.share_of_effort.map(|share| format!(" ({} % of its effort limit)", number(share * 100.0)));
        let loose = self.ratio.filter(|ratio| *ratio > LOOSE);
        let loose = loose.map(|ratio| format!(", {} times as much,", number(ratio)));
        let is_tight = self.ratio.is_none_or(|ratio| ratio <= TIGHT);
        let bound = if is_tight { "certified below" } else { "loosely bounded by" };
        format!(
            "{} at {}, {bound} {}{}{} over the whole joint range",
            quantity(self.attained_n_m, self.unit.symbol()),
            self.joint,
            quantity(self.certified_n_m, self.unit.symbol()),
            share.unwrap_or_default(),
            loose.unwrap_or_default(),
        )
    }
}

/// A bound above this multiple of the difference that was found is reported with the ratio. No unit; kind: choice.
const LOOSE: f64 = 1.1;
/// A bound up to this multiple of the difference that was found is called certified. No unit; kind: choice.
const TIGHT: f64 = 1.5;

impl TorqueCertificates {
    /// The speeds and accelerations that the bounds cover, and whether they are stated or assumed.
    pub fn covered_sentence(&self) -> String {
        let named = |is: fn(&CoveredMotion) -> bool| -> Vec<&str> {
            self.covered.iter().filter(|covered| is(covered)).map(|covered| covered.joint.as_str()).collect()
        };
        let assumed = |what: &str, assumed: &[&str], most: f64| match assumed.len() {
            0 => format!("{what} as stated"),
            all if all == self.covered.len() => format!("{what} up to {} rad/s or m/s assumed", number(most)),
            _ => format!(
                "{what} as stated, up to {} rad/s or m/s assumed for {}",
                number(most),
                assumed.join(", ")
            ),
        };
        let speeds = assumed("speeds", &named(|covered| !covered.speed_is_stated), LARGEST_SPEED);
        let without = named(|covered| !covered.acceleration_is_declared);
        let accelerations = assumed("accelerations", &without, LARGEST_ACCELERATION);
        let accelerations = accelerations.replace("rad/s or m/s", "rad/s^2 or m/s^2");
        let how = if without.is_empty() {
            ""
        } else {
            " ([limits] acceleration_rad_s2 of robot.toml declares them)"
        };
        let unranged = named(|covered| covered.assumed_slide_m.is_some());
        let positions = match &unranged[..] {
            [] => String::new(),
            names => {
                format!("; positions of {} assumed within {UNRANGED_SLIDE_M} m of zero", names.join(", "))
            }
        };
        format!("{speeds}; {accelerations}{how}{positions}")
    }
}

fn count(number: usize) -> f64 {
    f64::from(u32::try_from(number).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_distinguish_them() {
        let texts = |found: f64, expected: f64| with_distinct_digits(Some(found), Some(expected), "kg", "");
        assert_eq!(texts(2.631, 3.7612), ["2.63 kg", "3.76 kg"]);
        assert_eq!(texts(9.80665, 9.809_999_999_999_999), ["9.80665 kg", "9.81 kg"]);
        assert_eq!(texts(0.364 + 2e-16, 0.364), ["0.364 kg + 2.2e-16 kg", "0.364 kg"]);
        assert_eq!(texts(0.364, 0.364), ["0.364 kg", "0.364 kg"]);
    }
}
