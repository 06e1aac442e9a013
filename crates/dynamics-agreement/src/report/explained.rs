//! Explanations in names, figures and places of the file.

use congruent_description::{UrdfPlaces, line_column};

use super::content::{DynamicsExplanation, PlacedCause};
use crate::{
    compare::figures,
    diagnosis::{Corrected, DynamicsCause, Exact, FaultySide, Grouped, Place},
    side::{Inertial, Side},
};

/// What explanations are told with.
#[derive(Clone, Copy)]
pub(super) struct Teller<'a> {
    pub(super) candidate: &'a Side,
    pub(super) faulty: FaultySide,
    pub(super) places: Option<&'a UrdfPlaces>,
    /// Norm of the whole difference.
    pub(super) difference: f64,
}

impl Teller<'_> {
    pub(super) fn explanation(&self, grouped: &Grouped) -> DynamicsExplanation {
        let exact = &grouped.named;
        let figures = self.figures(&exact.corrected);
        let (file, line) = self.file_and_line(exact).unzip();
        let first = self.name(exact);
        DynamicsExplanation {
            cause: first.cause,
            detail: first.detail,
            place: first.place,
            suggestion: super::words::suggestion(self.faulty, &figures),
            figures,
            numbers: exact.price,
            left_relative: exact.left() / self.difference,
            is_a_body: exact.law_broken.is_none(),
            body_law: exact
                .law_broken
                .map(|(link, law)| format!("{}: {}", self.candidate.frames.link_name(link), law.broken())),
            contradicted: exact.contradicted,
            also_named: grouped.also.iter().map(|exact| self.name(exact)).collect(),
            reason: grouped.reason,
            parts: if exact.parts.len() > 1 { self.parts(exact) } else { Vec::new() },
            file,
            line,
        }
    }

    /// One fault by its own name, several by their names together.
    fn name(&self, exact: &Exact) -> PlacedCause {
        let mut parts = self.parts(exact);
        if parts.len() == 1 {
            return parts.remove(0);
        }
        let causes: Vec<&str> = parts.iter().map(|part| part.cause.name()).collect();
        let mut place: Vec<String> = Vec::new();
        for part in &parts {
            place.extend(part.place.iter().cloned());
        }
        PlacedCause { cause: DynamicsCause::Several, detail: causes.join(" + "), place }
    }

    fn parts(&self, exact: &Exact) -> Vec<PlacedCause> {
        let hypotheses = exact.parts.iter().map(|part| &part.hypothesis);
        hypotheses
            .map(|hypothesis| PlacedCause {
                cause: hypothesis.cause,
                detail: hypothesis.detail.clone(),
                place: self.place(&hypothesis.place),
            })
            .collect()
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

    /// The figures that a correction changes: found is what the faulty says.
    fn figures(&self, corrected: &Corrected) -> Vec<figures::FigureDifference> {
        let side = self.candidate;
        let mut differences = Vec::new();
        for (link, figures) in &corrected.links {
            let name = side.frames.link_name(*link);
            let written: Option<&Inertial> = side.inertials[*link].as_ref();
            differences.extend(figures::of_link(name, written, Some(figures)));
        }
        if let Some(joints) = &corrected.joints {
            differences.extend(figures::of_joints(&side.frames, &side.resistances, joints));
        }
        if let Some(gravity) = &corrected.gravity {
            differences.extend(figures::of_gravity(&side.gravity_m_s2, gravity));
        }
        if self.faulty == FaultySide::Reference {
            for difference in &mut differences {
                std::mem::swap(&mut difference.found, &mut difference.expected);
            }
        }
        differences
    }

    fn file_and_line(&self, exact: &Exact) -> Option<(String, usize)> {
        let places = self.places.filter(|_| self.faulty == FaultySide::Candidate)?;
        let frames = &self.candidate.frames;
        let place = &exact.parts.first()?.hypothesis.place;
        let span = match place {
            Place::Links(links) => places.link_inertial(frames.link_name(*links.first()?)),
            Place::Joints(joints) => places.joint_dynamics(frames.joint_name(*joints.first()?)),
            Place::AllLinks => {
                let (link, _) = exact.corrected.links.first()?;
                places.link_inertial(frames.link_name(*link))
            }
            Place::AllJoints => places.joint_dynamics(&frames.joints.first()?.name),
            Place::Gravity => None,
        }?;
        let source = places.source();
        Some((source.path.display().to_string(), line_column(&source.text, span.start).0))
    }
}
