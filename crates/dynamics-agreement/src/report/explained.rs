//! Turns an exact hypothesis into an explanation with names, parameters and places in the file.

use congruent_dynamics::JointResistance;
use congruent_input::{ChangedLines, TextEdit};
use nalgebra::Matrix3;

use super::{
    content::{DynamicsExplanation, PlacedCause},
    places::{ModelFiles, without_rounding},
};
use crate::{
    diagnosis::{
        Corrected, DiagnosisInput, DynamicsCause, DynamicsHypothesis, DynamicsPlace, ExactExplanation,
        ExplanationGroup, FaultySide, MISSING_THERE, rounded_damping_unit, rounded_unit,
    },
    differences::{ParameterDifference, parameters},
    model::{BodyLaw, DynamicsModel, Inertial, JointTerm},
    thresholds::FILE_DIGITS,
    torque::reduced_difference::ReducedTorqueDifference,
};

/// Products of inertia of a smaller share are those of frames that digits turn a little. Kind: choice.
const NO_PRODUCT: f64 = 1e-4;

/// Everything that an explanation needs beside the hypothesis: both models, their files and the torque difference.
#[derive(Clone, Copy)]
pub(crate) struct ExplanationContext<'a> {
    pub(crate) candidate: &'a DynamicsModel,
    /// The other description; `None` if the reference is a source of accelerations.
    pub(crate) reference: Option<&'a DynamicsModel>,
    pub(crate) faulty: FaultySide,
    pub(crate) files: ModelFiles<'a>,
    pub(crate) torque: &'a ReducedTorqueDifference,
    /// Norm of the whole torque difference, weighted.
    pub(crate) difference: f64,
    /// The largest residual norm that counts as exact.
    pub(crate) exact: f64,
}

/// Whether the expected value of a link is not that of the reference, up to the digits of a file.
fn is_other_value(parameter: &ParameterDifference, reference: &DynamicsModel) -> bool {
    let link = reference.frames.find_link(&parameter.of);
    let of_link = link.and_then(|link| reference.inertials[link]);
    let Some((of_link, expected)) = of_link.zip(parameter.expected) else { return false };
    // Tensors are compared as they are written if the axes are the same.
    let is_other = |tensor: Matrix3<f64>| {
        let written = parameters::parameter(&parameter.parameter, &of_link, &tensor);
        written.is_some_and(|(written, size)| (written - expected).abs() > FILE_DIGITS * size)
    };
    is_other(of_link.tensor_in_link()) && is_other(of_link.tensor_kg_m2)
}

impl<'a> ExplanationContext<'a> {
    pub(crate) fn new(
        setting: &DiagnosisInput<'a>,
        files: ModelFiles<'a>,
        torque: &'a ReducedTorqueDifference,
    ) -> Self {
        let difference = libm::hypot(torque.difference.norm(), torque.outside);
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

impl ExplanationContext<'_> {
    pub(crate) fn explanation(&self, grouped: &ExplanationGroup) -> DynamicsExplanation {
        let exact = &grouped.named;
        let corrected = self.rounded_for_file(exact);
        let mut parameters = self.parameters(&corrected);
        self.files.place(&mut parameters);
        self.files.mark_computed(&mut parameters);
        // Torques alone do not show which of several values is written there.
        let is_other = |parameter: &&mut ParameterDifference| {
            self.reference.is_some_and(|reference| is_other_value(parameter, reference))
        };
        for parameter in parameters.iter_mut().filter(is_other) {
            parameter.is_computed = true;
            (parameter.expected_line, parameter.expected_elsewhere) = (None, None);
        }
        let file = self.files.found.filter(|_| self.faulty == FaultySide::Candidate);
        let first = self.name(exact, &corrected);
        let law_broken = corrected.law_broken(self.candidate);
        let changes = self.changes(&corrected).unwrap_or_default();
        // Where something is to be written: a rotation of the inertial frame changes every entry of the tensor.
        let lines = || parameters.iter().filter_map(|parameter| parameter.line);
        let is_changed = |line: &usize| changes.iter().any(|of| (of.from_line..=of.to_line).contains(line));
        let written = changes.first().map(|of| of.from_line);
        let line = lines().find(is_changed).or(written).or_else(|| lines().next());
        let file = file.map(|file| file.source().path.display().to_string());
        let included = parameters.iter().filter_map(|parameter| parameter.elsewhere.as_ref());
        let mut included = included.filter(|_| line.is_none() && file.is_some());
        let (file, line) = match included.find(|place| place.file.is_some()) {
            Some(place) => (place.file.clone(), Some(place.line)),
            None => (file, line),
        };
        DynamicsExplanation {
            cause: first.cause,
            detail: first.detail,
            place: first.place,
            suggestion: super::sentences::suggestion(self.faulty, &parameters),
            line: file.as_ref().and(line),
            file,
            changes,
            otherwise: None,
            parameters,
            numbers: exact.complexity,
            left_relative: exact.residual_norm() / self.difference,
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

    /// Corrected links whose written values are physically impossible.
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

    /// The cause of a single fault, or `several` with all causes in the detail.
    fn name(&self, exact: &ExactExplanation, corrected: &Corrected) -> PlacedCause {
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

    /// The detail, or that the other file has the moments without their axes: its tensor is diagonal in the axes of the link, and the one here
    /// is not.
    fn missing_there(&self, hypothesis: &DynamicsHypothesis, corrected: &Corrected) -> String {
        let is_diagonal = |tensor: Matrix3<f64>| {
            let products = tensor - Matrix3::from_diagonal(&tensor.diagonal());
            products.amax() <= NO_PRODUCT * tensor.amax()
        };
        let lost = |(link, right): &(usize, Inertial)| {
            let written = self.candidate.inertials[*link].map(|of| of.tensor_in_link());
            is_diagonal(right.tensor_in_link()) && written.is_some_and(|written| !is_diagonal(written))
        };
        let is_turned = hypothesis.cause == DynamicsCause::InertiaRotation && self.reference.is_some();
        if is_turned && !corrected.links.is_empty() && corrected.links.iter().all(lost) {
            return MISSING_THERE.to_owned();
        }
        hypothesis.detail.clone()
    }

    fn parts(&self, exact: &ExactExplanation, corrected: &Corrected) -> Vec<PlacedCause> {
        let part = |hypothesis: &DynamicsHypothesis| {
            let (cause, detail) = self.rounded_unit(hypothesis, corrected).map_or_else(
                || (hypothesis.cause, self.missing_there(hypothesis, corrected)),
                |(cause, unit)| (cause, unit.to_owned()),
            );
            PlacedCause { cause, detail, place: self.place(&hypothesis.place, corrected) }
        };
        exact.parts.iter().map(|fit| part(&fit.hypothesis)).collect()
    }

    /// The unit of values that were rounded when they were converted, so that no unit explains them exactly.
    fn rounded_unit(
        &self,
        hypothesis: &DynamicsHypothesis,
        corrected: &Corrected,
    ) -> Option<(DynamicsCause, &'static str)> {
        if self.faulty == FaultySide::Reference || !hypothesis.cause.is_of_free_values() {
            return None;
        }
        match &hypothesis.place {
            DynamicsPlace::Links(links) => {
                let [link] = links[..] else { return None };
                let (_, right) = corrected.links.iter().find(|(other, _)| *other == link)?;
                rounded_unit(self.candidate.inertials[link].as_ref()?, right)
            }
            DynamicsPlace::Joints(_) | DynamicsPlace::AllJoints => {
                rounded_damping_unit(&self.candidate.resistances, corrected.joints.as_ref()?)
            }
            DynamicsPlace::AllLinks | DynamicsPlace::Gravity => None,
        }
    }

    fn place(&self, place: &DynamicsPlace, corrected: &Corrected) -> Vec<String> {
        let frames = &self.candidate.frames;
        let is_right = |joint: usize, right: &JointResistance| *right == self.candidate.resistances[joint];
        let joints = corrected.joints.iter().flatten().enumerate();
        let changed: Vec<usize> =
            joints.filter(|(joint, right)| !is_right(*joint, right)).map(|(joint, _)| joint).collect();
        match place {
            // Of all joints those whose values change.
            DynamicsPlace::AllJoints if !changed.is_empty() && changed.len() < frames.dof() => {
                changed.iter().map(|&joint| frames.joint_name(joint).to_owned()).collect()
            }
            DynamicsPlace::Links(links) => {
                links.iter().map(|&link| frames.link_name(link).to_owned()).collect()
            }
            DynamicsPlace::Joints(joints) => {
                joints.iter().map(|&joint| frames.joint_name(joint).to_owned()).collect()
            }
            DynamicsPlace::AllLinks | DynamicsPlace::AllJoints => vec!["*".to_owned()],
            DynamicsPlace::Gravity => vec!["gravity".to_owned()],
        }
    }

    /// The corrected parameters without the rounding of a fit; those of the other description if their residual is within
    /// tolerance as well, since not every free parameter is identifiable.
    fn rounded_for_file(&self, exact: &ExactExplanation) -> Corrected {
        let mut corrected = exact.corrected.clone();
        // A hypothesis without free parameters gives exact values already; fitted ones may differ from the file of the
        // reference in directions that are not identifiable.
        let there = (exact.complexity > 0.0).then(|| self.by_reference(&corrected)).flatten();
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

    /// The corrected links with the parameters of the other description; `None` if their residual is above tolerance.
    fn by_reference(&self, corrected: &Corrected) -> Option<Vec<(usize, Inertial)>> {
        let reference = self.reference.filter(|_| corrected.gravity.is_none())?;
        let mut residual = self.torque.difference.clone();
        let mut links = Vec::with_capacity(corrected.links.len());
        for (link, _) in &corrected.links {
            let there = reference.frames.find_link(self.candidate.frames.link_name(*link))?;
            let there = reference.inertials[there]?;
            let written = self.candidate.inertials[*link].unwrap_or_else(Inertial::nothing);
            residual -= self.torque.link(*link)? * (there.ten_numbers() - written.ten_numbers());
            links.push((*link, without_rounding(self.candidate.inertials[*link].as_ref(), &there)));
        }
        for (joint, new) in corrected.joints.iter().flatten().enumerate() {
            for term in JointTerm::ALL {
                let change = term.value_in(new) - term.value_in(&self.candidate.resistances[joint]);
                residual.axpy(-change, &self.torque.term(term).column(joint), 1.0);
            }
        }
        (libm::hypot(residual.norm(), self.torque.outside) <= self.exact).then_some(links)
    }

    /// The parameters that a correction changes; `found` is the value of the model that is assumed to be wrong.
    fn parameters(&self, corrected: &Corrected) -> Vec<parameters::ParameterDifference> {
        let model = self.candidate;
        let mut differences = Vec::new();
        for (link, parameters) in &corrected.links {
            let name = model.frames.link_name(*link);
            let written: Option<&Inertial> = model.inertials[*link].as_ref();
            let right = (*parameters != Inertial::nothing()).then_some(parameters);
            differences.extend(parameters::link_differences(name, written, right));
        }
        if let Some(joints) = &corrected.joints {
            differences.extend(parameters::joint_term_differences(&model.frames, &model.resistances, joints));
        }
        if let Some(gravity) = &corrected.gravity {
            differences.extend(parameters::gravity_differences(&model.gravity_m_s2, gravity));
        }
        if self.faulty == FaultySide::Reference {
            for difference in &mut differences {
                // Here the reference is wrong: its value is found, and the written value of the candidate is
                // expected.
                std::mem::swap(&mut difference.found, &mut difference.expected);
            }
        }
        differences
    }

    /// The lines with the corrected parameters; `None` if the file is right, or if its elements cannot have all of them.
    fn changes(&self, corrected: &Corrected) -> Option<Vec<ChangedLines>> {
        let file = self.files.found.filter(|_| self.faulty == FaultySide::Candidate)?;
        let model = self.candidate;
        let mut edits: Vec<TextEdit> = Vec::new();
        for (link, parameters) in corrected.links.iter().filter(|(_, of)| *of != Inertial::nothing()) {
            edits.extend(file.set_inertial(model.frames.link_name(*link), &parameters.to_inertia())?);
        }
        for (joint, terms) in corrected.joints.iter().flatten().enumerate() {
            if *terms != model.resistances[joint] {
                edits.extend(file.set_terms(model.frames.joint_name(joint), terms)?);
            }
        }
        edits.extend(corrected.gravity.iter().flat_map(|gravity| file.set_gravity(gravity)));
        Some(file.changed_lines(&edits))
    }
}
