//! Links that only one of two descriptions has, such as a camera on a bracket: their mass is missing in the other one.

use crate::{
    diagnosis::DynamicsCause,
    differences::parameters,
    model::{DynamicsModel, Inertial},
    report::{content::DynamicsExplanation, places::ModelFiles},
    thresholds::COMPLEXITY_OF_MISSING,
};

/// Links with an inertial on a moving body that only one of the two has, by their index there.
pub(super) struct Unmatched<'a> {
    candidate: &'a DynamicsModel,
    reference: &'a DynamicsModel,
    added: Vec<usize>,
    missing: Vec<usize>,
}

impl<'a> Unmatched<'a> {
    pub(super) fn new(candidate: &'a DynamicsModel, reference: &'a DynamicsModel) -> Self {
        let only_in = |one: &DynamicsModel, other: &DynamicsModel| {
            let links = one.frames.links.iter().zip(&one.inertials).enumerate();
            links
                .filter(|(_, (place, inertial))| place.body.is_some() && inertial.is_some())
                .filter(|(_, (place, _))| other.frames.find_link(&place.name).is_none())
                .map(|(link, _)| link)
                .collect()
        };
        let [mut added, missing]: [Vec<usize>; 2] =
            [only_in(candidate, reference), only_in(reference, candidate)];
        // A link of both to which the reference gives no mass.
        let is_massless = |link: &usize| {
            let there = reference.frames.find_link(candidate.frames.link_name(*link));
            let has_mass =
                candidate.frames.links[*link].body.is_some() && candidate.inertials[*link].is_some();
            has_mass && there.is_some_and(|there| reference.inertials[there].is_none())
        };
        added.extend((0..candidate.frames.links.len()).filter(is_massless));
        Self { candidate, reference, added, missing }
    }

    /// Adds the mass of missing links to their bodies, and removes that of links which the reference does not have.
    pub(super) fn correct(&self, model: &mut DynamicsModel) {
        self.added.iter().for_each(|&link| model.inertials[link] = None);
        self.missing.iter().for_each(|&link| self.add(link, model));
    }

    /// The candidate with one of these links corrected, in the order of the explanations.
    pub(super) fn corrected_one_by_one(&self) -> impl Iterator<Item = DynamicsModel> + '_ {
        let without = self.added.iter().map(|&link| {
            let mut model = self.candidate.clone();
            model.inertials[link] = None;
            model
        });
        without.chain(self.missing.iter().map(|&link| {
            let mut model = self.candidate.clone();
            self.add(link, &mut model);
            model
        }))
    }

    /// Adds the mass of a missing link to its body.
    fn add(&self, link: usize, model: &mut DynamicsModel) {
        let place = &self.reference.frames.links[link];
        let (Some(body), Some(inertial)) = (place.body, &self.reference.inertials[link]) else { return };
        let Some(joint) = model.frames.find_joint(self.reference.frames.joint_name(body)) else { return };
        // The frame of a body is that of the link which its joint carries, and both descriptions have this joint: the
        // inertia can be added although the candidate does not have the link.
        let in_body = inertial.about_origin().transformed_by(&place.body_from_link);
        let carried = model.frames.joints[joint].link;
        let before = model.inertials[carried].unwrap_or_else(Inertial::nothing);
        // About one origin, where inertias add.
        let sum = Inertial::from_origin(&(before.about_origin() + in_body), before.link_from_axes);
        model.inertials[carried] = Some(sum);
    }

    /// One explanation for each of these links, with the lines to write.
    pub(super) fn explanations(&self, files: ModelFiles<'_>) -> Vec<DynamicsExplanation> {
        let added = self.added.iter().map(|&link| {
            let name = self.candidate.frames.link_name(link);
            let nothing = Inertial::nothing().to_inertia();
            let edits =
                files.found.and_then(|file| Some(file.changed_lines(&file.set_inertial(name, &nothing)?)));
            let explanation = explanation(
                DynamicsCause::LinkAdded,
                name,
                [self.candidate.inertials[link].as_ref(), None],
                files,
            );
            let suggestion =
                format!("remove the <inertial> of {name}, or add the link to the other description");
            DynamicsExplanation {
                changes: edits.unwrap_or_default(),
                suggestion: Some(suggestion),
                ..explanation
            }
        });
        let missing = self.missing.iter().map(|&link| {
            let name = self.reference.frames.link_name(link);
            let found = self.reference.inertials[link].as_ref();
            let explanation = explanation(DynamicsCause::LinkMissing, name, [None, found], files);
            let there = files.expected.map_or_else(String::new, |file| {
                let place = file.parameter(name, "mass");
                let place = place.map_or_else(|| file.source().path.display().to_string(), |at| at.to_string());
                format!(", {place}")
            });
            let suggestion = format!(
                "add link {name} with its fixed joint as in the other description{there}, or add its mass to the \
                 link that carries it"
            );
            let text = files.expected.and_then(|file| file.link_text(name));
            let edits = files.found.zip(text).map(|(file, text)| file.changed_lines(&file.add_link(&text)));
            let changes = edits.unwrap_or_default();
            // The candidate has no line of this link: the place where it would be inserted stands for it.
            let line = changes.first().map(|lines| lines.from_line);
            DynamicsExplanation { suggestion: Some(suggestion), line, changes, ..explanation }
        });
        added.chain(missing).collect()
    }
}

fn explanation(
    cause: DynamicsCause,
    name: &str,
    [found, expected]: [Option<&Inertial>; 2],
    files: ModelFiles<'_>,
) -> DynamicsExplanation {
    let mut parameters = parameters::link_differences(name, found, expected);
    files.place(&mut parameters);
    DynamicsExplanation {
        cause,
        detail: String::new(),
        place: vec![name.to_owned()],
        line: parameters.iter().find_map(|parameter| parameter.line),
        parameters,
        numbers: COMPLEXITY_OF_MISSING,
        left_relative: 0.0,
        is_a_body: true,
        body_law: None,
        impossible_as_written: Vec::new(),
        contradicted: false,
        also_named: Vec::new(),
        reason: None,
        parts: Vec::new(),
        file: files.found.map(|file| file.source().path.display().to_string()),
        suggestion: None,
        changes: Vec::new(),
        otherwise: None,
    }
}
