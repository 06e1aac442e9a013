//! Explanations in names, parameters and places of the file.

use congruent_description::{ChangedLines, Elementary as _, TextEdit};

use super::{
    content::{DynamicsExplanation, PlacedCause},
    places::{Files, without_rounding},
};
use crate::{
    compare::parameters,
    diagnosis::{
        Corrected, DynamicsCause, Exact, FaultySide, Grouped, Hypothesis, Place, Setting,
        rounded_damping_unit, rounded_unit,
    },
    side::{BodyLaw, Inertial, JointTerm, Side},
    torque::compressed::Compressed,
};

/// What explanations are told with.
#[derive(Clone, Copy)]
pub(super) struct Teller<'a> {
    pub(super) candidate: &'a Side,
    /// The other description, if there is one.
    pub(super) reference: Option<&'a Side>,
    pub(super) faulty: FaultySide,
    pub(super) files: Files<'a>,
    pub(super) torque: &'a Compressed,
    /// Norm of the whole difference.
    pub(super) difference: f64,
    /// The largest norm that counts as nothing left.
    pub(super) exact: f64,
}

impl<'a> Teller<'a> {
    pub(super) fn new(setting: &Setting<'a>, files: Files<'a>, torque: &'a Compressed) -> Self {
        let difference = torque.difference.norm().hypotenuse_with(torque.outside);
        Self {
            candidate: setting.candidate,
            reference: setting.reference,
            faulty: setting.faulty,
            files,
            torque,
            difference,
            exact: setting.precision.exact(difference, torque.torques),
        }
    }
}

impl Teller<'_> {
    pub(super) fn explanation(&self, grouped: &Grouped) -> DynamicsExplanation {
        let exact = &grouped.named;
        let corrected = self.worth_writing(exact);
        let mut parameters = self.parameters(&corrected);
        self.files.place(&mut parameters);
        let file = self.files.found.filter(|_| self.faulty == FaultySide::Candidate);
        let first = self.name(exact, &corrected);
        let law_broken = corrected.law_broken(self.candidate);
        DynamicsExplanation {
            cause: first.cause,
            detail: first.detail,
            place: first.place,
            suggestion: super::words::suggestion(self.faulty, &parameters),
            file: file.map(|file| file.source().path.display().to_string()),
            line: file.and_then(|_| parameters.iter().find_map(|parameter| parameter.line)),
            changes: self.changes(&corrected),
            otherwise: None,
            parameters,
            numbers: exact.price,
            left_relative: exact.left() / self.difference,
            is_a_body: law_broken.is_none(),
            body_law: law_broken
                .map(|(link, law)| format!("{}: {}", self.candidate.frames.link_name(link), law.broken())),
            impossible_as_written: self.impossible_as_written(&corrected),
            contradicted: exact.contradicted,
            also_named: grouped.also.iter().map(|exact| self.name(exact, &exact.corrected)).collect(),
            reason: grouped.reason,
            parts: if exact.parts.len() > 1 { self.parts(exact, &corrected) } else { Vec::new() },
        }
    }

    /// Links that are corrected and whose values as they are written no body has.
    fn impossible_as_written(&self, corrected: &Corrected) -> Vec<String> {
        if self.faulty == FaultySide::Reference {
            return Vec::new();
        }
        let frames = &self.candidate.frames;
        let links = corrected.links.iter().filter_map(|(link, _)| {
            let law = self.candidate.inertials[*link]?.law_broken(frames.reach_m)?;
            (law != BodyLaw::Size).then(|| format!("{}: {}", frames.link_name(*link), law.is_broken()))
        });
        links.collect()
    }

    /// One fault by its own name, several by their names together.
    fn name(&self, exact: &Exact, corrected: &Corrected) -> PlacedCause {
        let mut parts = self.parts(exact, corrected);
        if parts.len() == 1 {
            return parts.remove(0);
        }
        let causes: Vec<&str> = parts.iter().map(|part| part.cause.name()).collect();
        let mut place: Vec<String> = Vec::new();
        for link in parts.iter().flat_map(|part| &part.place) {
            if !place.contains(link) {
                place.push(link.clone());
            }
        }
        PlacedCause { cause: DynamicsCause::Several, detail: causes.join(" + "), place }
    }

    fn parts(&self, exact: &Exact, corrected: &Corrected) -> Vec<PlacedCause> {
        let part = |hypothesis: &Hypothesis| {
            let (cause, detail) = self.rounded_unit(hypothesis, corrected).map_or_else(
                || (hypothesis.cause, hypothesis.detail.clone()),
                |(cause, unit)| (cause, unit.to_owned()),
            );
            PlacedCause { cause, detail, place: self.place(&hypothesis.place) }
        };
        exact.parts.iter().map(|fit| part(&fit.hypothesis)).collect()
    }

    /// The unit that a file gives values in which no slip explains exactly, since they are rounded.
    fn rounded_unit(
        &self,
        hypothesis: &Hypothesis,
        corrected: &Corrected,
    ) -> Option<(DynamicsCause, &'static str)> {
        if self.faulty == FaultySide::Reference || !hypothesis.cause.is_of_free_values() {
            return None;
        }
        match &hypothesis.place {
            Place::Links(links) => {
                let [link] = links[..] else { return None };
                let (_, right) = corrected.links.iter().find(|(other, _)| *other == link)?;
                rounded_unit(self.candidate.inertials[link].as_ref()?, right)
            }
            Place::Joints(_) | Place::AllJoints => {
                rounded_damping_unit(&self.candidate.resistances, corrected.joints.as_ref()?)
            }
            Place::AllLinks | Place::Gravity => None,
        }
    }

    fn place(&self, place: &Place) -> Vec<String> {
        let frames = &self.candidate.frames;
        match place {
            Place::Links(links) => links.iter().map(|&link| frames.link_name(link).to_owned()).collect(),
            Place::Joints(joints) => {
                joints.iter().map(|&joint| frames.joint_name(joint).to_owned()).collect()
            }
            Place::AllLinks | Place::AllJoints => vec!["*".to_owned()],
            Place::Gravity => vec!["gravity".to_owned()],
        }
    }

    /// The corrected parameters without the rounding of a fit; those of the other description if they leave nothing
    /// either, since torque does not show every number that is free.
    fn worth_writing(&self, exact: &Exact) -> Corrected {
        let mut corrected = exact.corrected.clone();
        let there = (exact.price > 0.0).then(|| self.by_reference(&corrected)).flatten();
        corrected.links = there.unwrap_or_else(|| {
            let links = corrected.links.iter();
            links
                .map(|(link, parameters)| {
                    (*link, without_rounding(self.candidate.inertials[*link].as_ref(), parameters))
                })
                .collect()
        });
        corrected
    }

    /// The corrected links with the parameters of the other description; `None` if these leave something of the difference.
    fn by_reference(&self, corrected: &Corrected) -> Option<Vec<(usize, Inertial)>> {
        let reference = self.reference.filter(|_| corrected.gravity.is_none())?;
        let mut left = self.torque.difference.clone();
        let mut links = Vec::with_capacity(corrected.links.len());
        for (link, _) in &corrected.links {
            let there = reference.frames.find_link(self.candidate.frames.link_name(*link))?;
            let there = reference.inertials[there]?;
            let written = self.candidate.inertials[*link].unwrap_or_else(Inertial::nothing);
            left -= self.torque.link(*link)? * (there.ten_numbers() - written.ten_numbers());
            links.push((*link, without_rounding(self.candidate.inertials[*link].as_ref(), &there)));
        }
        for (joint, new) in corrected.joints.iter().flatten().enumerate() {
            for term in JointTerm::ALL {
                let change = term.of(new) - term.of(&self.candidate.resistances[joint]);
                left.axpy(-change, &self.torque.term(term).column(joint), 1.0);
            }
        }
        (left.norm().hypotenuse_with(self.torque.outside) <= self.exact).then_some(links)
    }

    /// The parameters that a correction changes: found is what the faulty says.
    fn parameters(&self, corrected: &Corrected) -> Vec<parameters::ParameterDifference> {
        let side = self.candidate;
        let mut differences = Vec::new();
        for (link, parameters) in &corrected.links {
            let name = side.frames.link_name(*link);
            let written: Option<&Inertial> = side.inertials[*link].as_ref();
            differences.extend(parameters::of_link(name, written, Some(parameters)));
        }
        if let Some(joints) = &corrected.joints {
            differences.extend(parameters::of_joints(&side.frames, &side.resistances, joints));
        }
        if let Some(gravity) = &corrected.gravity {
            differences.extend(parameters::of_gravity(&side.gravity_m_s2, gravity));
        }
        if self.faulty == FaultySide::Reference {
            for difference in &mut differences {
                std::mem::swap(&mut difference.found, &mut difference.expected);
            }
        }
        differences
    }

    /// The lines that say the corrected parameters; empty if the file is right, or cannot say them.
    fn changes(&self, corrected: &Corrected) -> Vec<ChangedLines> {
        let Some(file) = self.files.found.filter(|_| self.faulty == FaultySide::Candidate) else {
            return Vec::new();
        };
        let side = self.candidate;
        let mut edits: Vec<TextEdit> = Vec::new();
        for (link, parameters) in &corrected.links {
            edits.extend(file.set_inertial(side.frames.link_name(*link), parameters));
        }
        for (joint, terms) in corrected.joints.iter().flatten().enumerate() {
            if *terms != side.resistances[joint] {
                edits.extend(file.set_terms(side.frames.joint_name(joint), terms));
            }
        }
        edits.extend(corrected.gravity.iter().flat_map(|gravity| file.set_gravity(gravity)));
        file.lines(&edits)
    }
}
