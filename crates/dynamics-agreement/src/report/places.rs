//! Parameters of the two models with their lines, and as they should be written.

use congruent_description::{ParameterPlaces, PlaceElsewhere};
use congruent_input::TextEdit;
use nalgebra::Matrix3;

use crate::{
    differences::{LimitDifference, ParameterDifference, limits::UNIFORM_THERE},
    model::Inertial,
    thresholds::{SAME_VALUE, ZERO_VALUE},
};

/// The files of the two models; `None` if the places of their parameters are not known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ModelFiles<'a> {
    pub(crate) found: Option<&'a dyn ParameterPlaces>,
    pub(crate) expected: Option<&'a dyn ParameterPlaces>,
}

impl ModelFiles<'_> {
    pub(crate) fn place(&self, differences: &mut [ParameterDifference]) {
        for difference in differences {
            let at = |file| line(file, &difference.of, &difference.parameter);
            let [found, expected] = [self.found, self.expected].map(at);
            (difference.line, difference.elsewhere) = found;
            (difference.expected_line, difference.expected_elsewhere) = expected;
        }
    }

    /// Marks values that the reference writes nowhere, as the rest of links that it has as one.
    pub(super) fn mark_computed(&self, differences: &mut [ParameterDifference]) {
        for difference in differences.iter_mut().filter(|of| self.expected.is_some() && of.expected.is_some())
        {
            difference.is_computed =
                difference.expected_line.is_none() && difference.expected_elsewhere.is_none();
        }
    }

    pub(crate) fn place_limits(&self, differences: &mut [LimitDifference]) {
        for difference in &mut *differences {
            let at = |file| line(file, &difference.joint, &difference.parameter);
            let [found, expected] = [self.found, self.expected].map(at);
            (difference.line, difference.elsewhere) = found;
            (difference.expected_line, difference.expected_elsewhere) = expected;
        }
        let Some(file) = self.found else { return };
        // A placeholder is no value to write.
        let set = |of: &LimitDifference| {
            let expected = of.expected.filter(|_| of.detail != UNIFORM_THERE);
            expected.map_or_else(Vec::new, |value| file.set_limit(&of.joint, &of.parameter, value))
        };
        let edits: Vec<Vec<TextEdit>> = differences.iter().map(set).collect();
        let joints: Vec<String> = differences.iter().map(|of| of.joint.clone()).collect();
        for (difference, own) in differences.iter_mut().zip(&edits) {
            difference.file = Some(file.source().path.display().to_string());
            if !own.is_empty() {
                let of_joint = edits.iter().zip(&joints).filter(|(_, joint)| **joint == difference.joint);
                // All limits of a joint are one element: edits of one limit alone would leave the others wrong in
                // the suggested line.
                let all: Vec<TextEdit> = of_joint.flat_map(|(edits, _)| edits.iter().cloned()).collect();
                difference.changes = file.changed_lines(&all);
            }
        }
    }
}

/// The line of a parameter in the file of the model, and where it is if that is not the whole place.
fn line(
    file: Option<&dyn ParameterPlaces>,
    of: &str,
    parameter: &str,
) -> (Option<usize>, Option<PlaceElsewhere>) {
    let placed = file.and_then(|file| Some((file.source(), file.parameter(of, parameter)?)));
    placed.map_or((None, None), |(file, at)| (at.line_in(file), at.elsewhere(file)))
}

/// Corrected parameters as they should be written: values that differ from the written ones by rounding alone keep the written
/// digits, and values that differ from zero by rounding alone become zero.
pub(super) fn without_rounding(written: Option<&Inertial>, corrected: &Inertial) -> Inertial {
    let nothing = Inertial::nothing();
    let written = written.unwrap_or(&nothing);
    let kept = |old: f64, new: f64, size: f64| match new {
        // Before the comparison with zero, so that a written tiny value is kept rather than cleared.
        _ if (old - new).abs() <= SAME_VALUE * size => old,
        _ if new.abs() <= ZERO_VALUE * size => 0.0,
        _ => new,
    };
    let mass = written.mass_kg.abs().max(corrected.mass_kg.abs());
    let length = corrected.com_m.amax();
    let mut parameters = Inertial {
        mass_kg: kept(written.mass_kg, corrected.mass_kg, mass),
        com_m: written.com_m.zip_map(&corrected.com_m, |old, new| kept(old, new, length)),
        ..*corrected
    };
    let size = corrected.tensor_kg_m2.amax();
    // Of axes that turn by rounding alone the written angles are kept.
    parameters.tensor_kg_m2 = if (written.link_from_axes - corrected.link_from_axes).amax() <= SAME_VALUE {
        parameters.link_from_axes = written.link_from_axes;
        written.tensor_kg_m2.zip_map(&corrected.tensor_kg_m2, |old, new| kept(old, new, size))
    } else {
        corrected.tensor_kg_m2.map(|new| kept(0.0, new, size))
    };
    // Rounded entry by entry, the two halves could differ; the upper one decides.
    parameters.tensor_kg_m2 = Matrix3::from_fn(|row, column| {
        let at = if row <= column { (row, column) } else { (column, row) };
        parameters.tensor_kg_m2[at]
    });
    parameters
}
