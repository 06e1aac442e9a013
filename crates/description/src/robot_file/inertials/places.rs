//! Byte ranges of the parameters of `[[inertial]]` entries, and the edits that change them.

use std::{ops::Range, sync::Arc};

use congruent_input::{
    SourceFile, TextEdit,
    number::{significant, significant_components},
};
use nalgebra::{Matrix3, Vector3};
use toml::Spanned;

use super::written::{WrittenDynamics, WrittenInertial, WrittenTerm};

/// The `[[inertial]]` entries of a robot file as they are written, with the text that they were parsed from.
#[derive(Debug, PartialEq)]
pub struct InertialPlaces {
    source: Arc<SourceFile>,
    dynamics: Option<WrittenDynamics>,
    entries: Vec<Spanned<WrittenInertial>>,
}

impl InertialPlaces {
    /// `dynamics` and `entries` must have been parsed from the text of `source`.
    pub(crate) fn new(
        source: Arc<SourceFile>,
        dynamics: Option<WrittenDynamics>,
        entries: Vec<Spanned<WrittenInertial>>,
    ) -> Self {
        Self { source, dynamics, entries }
    }

    /// The same, to name its file in another form.
    pub(crate) fn source_mut(&mut self) -> &mut Arc<SourceFile> {
        &mut self.source
    }

    /// The entries, in the order of the file.
    pub(super) fn entries(&self) -> impl Iterator<Item = &WrittenInertial> {
        self.entries.iter().map(Spanned::get_ref)
    }

    /// The robot file that the places are in.
    pub fn source(&self) -> &Arc<SourceFile> {
        &self.source
    }

    /// Place of a parameter of an entry, by the entry's number from 0: `mass`, `com_x`, `ixx`, `damping` and so on; the
    /// entry's joint if the parameter is not written.
    pub fn parameter(&self, entry: usize, parameter: &str) -> Option<Range<usize>> {
        let entry = self.entries.get(entry)?.get_ref();
        let written = match parameter {
            "mass" => Some(entry.mass_kg.span()),
            "com_x" | "com_y" | "com_z" => entry.com_m.as_ref().or(entry.com_mm.as_ref()).map(Spanned::span),
            "armature" => written_term(entry, WrittenTerm::Armature).map(Spanned::span),
            "damping" => written_term(entry, WrittenTerm::Damping).map(Spanned::span),
            "friction" => written_term(entry, WrittenTerm::Friction).map(Spanned::span),
            moment => entry.inertia_kg_m2.as_ref().map(|tensor| {
                let entries = tensor.get_ref().entries().into_iter();
                let own = entries.filter(|(name, ..)| moment.strip_prefix('i') == Some(*name));
                own.map(|(_, _, value)| value.span()).next().unwrap_or(tensor.span())
            }),
        };
        Some(written.unwrap_or_else(|| entry.joint.span()))
    }

    /// Place of gravity, if it is written.
    pub fn gravity(&self) -> Option<Range<usize>> {
        self.dynamics.as_ref()?.gravity_m_s2.as_ref().map(Spanned::span)
    }

    /// The edits after which an entry has this mass.
    pub fn set_mass(&self, entry: usize, mass_kg: f64) -> Vec<TextEdit> {
        let written = self.entries.get(entry).map(|entry| &entry.get_ref().mass_kg);
        written.and_then(|written| changed(written, mass_kg)).into_iter().collect()
    }

    /// The edits after which an entry has this centre of mass, in metres, in its own frame.
    pub fn set_com(&self, entry: usize, com_m: &Vector3<f64>) -> Vec<TextEdit> {
        let Some(entry) = self.entries.get(entry).map(Spanned::get_ref) else { return Vec::new() };
        let (written, unit) = match (&entry.com_m, &entry.com_mm) {
            (Some(written), _) => (written, 1.0),
            (None, Some(written)) => (written, 1000.0),
            (None, None) => return Vec::new(),
        };
        array(written, &(com_m * unit)).into_iter().collect()
    }

    /// The edits after which an entry has this tensor, in its own frame; none if it declares no tensor.
    pub fn set_tensor(&self, entry: usize, tensor_kg_m2: &Matrix3<f64>) -> Vec<TextEdit> {
        let written = self.entries.get(entry).and_then(|entry| entry.get_ref().inertia_kg_m2.as_ref());
        let entries = written.iter().flat_map(|tensor| tensor.get_ref().entries());
        entries.filter_map(|(_, at, value)| changed(value, tensor_kg_m2[at])).collect()
    }

    /// The edits after which an entry has these terms of its joint; terms that it does not declare are not added.
    pub fn set_terms(&self, entry: usize, [armature, damping, friction]: [f64; 3]) -> Vec<TextEdit> {
        let Some(entry) = self.entries.get(entry).map(Spanned::get_ref) else { return Vec::new() };
        let terms = [
            (WrittenTerm::Armature, armature),
            (WrittenTerm::Damping, damping),
            (WrittenTerm::Friction, friction),
        ];
        terms.into_iter().filter_map(|(term, value)| changed(written_term(entry, term)?, value)).collect()
    }

    /// The edits after which gravity has this value, m/s^2 in link `base`; none if the file does not declare it.
    pub fn set_gravity(&self, gravity_m_s2: &Vector3<f64>) -> Vec<TextEdit> {
        let written = self.dynamics.as_ref().and_then(|dynamics| dynamics.gravity_m_s2.as_ref());
        written.and_then(|written| array(written, gravity_m_s2)).into_iter().collect()
    }
}

fn written_term(entry: &WrittenInertial, term: WrittenTerm) -> Option<&Spanned<f64>> {
    let [turning, sliding] = entry.term(term);
    turning.1.or(sliding.1)
}

fn changed(written: &Spanned<f64>, value: f64) -> Option<TextEdit> {
    is_other(*written.get_ref(), value).then(|| TextEdit { span: written.span(), text: significant(value) })
}

fn array(written: &Spanned<[f64; 3]>, values: &Vector3<f64>) -> Option<TextEdit> {
    let differs = written.get_ref().iter().zip(values).any(|(old, new)| is_other(*old, *new));
    let text = || format!("[{}]", significant_components(<[f64; 3]>::from(*values)).join(", "));
    differs.then(|| TextEdit { span: written.span(), text: text() })
}

/// Whether two values differ in any bit; zero and minus zero count as equal.
fn is_other(old: f64, new: f64) -> bool {
    (old + 0.0).total_cmp(&(new + 0.0)).is_ne()
}
