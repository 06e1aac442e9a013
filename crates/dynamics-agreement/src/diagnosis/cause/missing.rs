//! Parameters that a file does not have, so that zeros or placeholders take their place. These are the evidence; the right
//! values are free. If the reference is assumed to be wrong, its importer has dropped the parameters.

use nalgebra::{Matrix3, Vector3};

use super::common_mistake::CommonMistake;
use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        free::FreeParameters,
        hypothesis::{Change, DynamicsHypothesis, DynamicsPlace},
    },
    model::{DynamicsModel, Inertial},
    thresholds::{PLACEHOLDER, ZERO_VALUE},
};

const PLACEHOLDERS: [(&str, f64); 3] = [("identity", 1.0), ("tenth", 0.1), ("milli", 0.001)];

/// Mistakes of an importer that drops parameters of a link.
pub(super) fn importer_mistakes<'a>() -> Vec<CommonMistake<'a>> {
    let mut mistakes = vec![
        CommonMistake::new(DynamicsCause::ComMissing, "", |parameters| Inertial {
            com_m: Vector3::zeros(),
            ..*parameters
        }),
        CommonMistake::new(DynamicsCause::ProductsMissing, "", |parameters| Inertial {
            tensor_kg_m2: Matrix3::from_diagonal(&parameters.tensor_kg_m2.diagonal()),
            ..*parameters
        }),
        CommonMistake::new(DynamicsCause::InertiaMissing, "", |parameters| Inertial {
            tensor_kg_m2: Matrix3::zeros(),
            ..*parameters
        }),
        CommonMistake::new(DynamicsCause::InertialLeftOut, "", |_| Inertial::nothing()),
    ];
    for (name, moment) in PLACEHOLDERS {
        mistakes.push(CommonMistake::new(DynamicsCause::InertiaPlaceholder, name, move |parameters| {
            Inertial {
                tensor_kg_m2: Matrix3::from_diagonal_element(moment),
                link_from_axes: Matrix3::identity(),
                ..*parameters
            }
        }));
    }
    mistakes
}

/// Hypotheses about parameters of a link that the file does not have.
pub(super) fn link_hypotheses(
    model: &DynamicsModel,
    reference: Option<&DynamicsModel>,
    link: usize,
) -> Vec<DynamicsHypothesis> {
    let free = |cause, detail: &str, free| {
        DynamicsHypothesis::new(
            cause,
            detail,
            DynamicsPlace::Links(vec![link]),
            Change::FreeLink { link, free },
        )
    };
    let Some(parameters) = &model.inertials[link] else {
        let missing = free(DynamicsCause::InertialMissing, "", FreeParameters::Inertial).missing();
        return if could_have_inertial(model, reference, link) { vec![missing] } else { Vec::new() };
    };
    let mut hypotheses = Vec::new();
    let tensor = &parameters.tensor_kg_m2;
    let off_diagonal = tensor - Matrix3::from_diagonal(&tensor.diagonal());
    let largest = tensor.amax();
    // An origin at zero is evidence that the element was left out, not proof: the values stay free and count as
    // such.
    if parameters.com_m.amax() <= ZERO_VALUE {
        hypotheses.push(free(DynamicsCause::ComMissing, "", FreeParameters::Com));
    }
    if largest == 0.0 {
        hypotheses.push(free(DynamicsCause::InertiaMissing, "", FreeParameters::Inertia).missing());
    // A tensor of zeros has no products either; the inertia as a whole is missing then.
    } else if off_diagonal.amax() <= ZERO_VALUE * largest {
        hypotheses.push(free(DynamicsCause::ProductsMissing, "", FreeParameters::Products));
        if is_placeholder(tensor) {
            let name = PLACEHOLDERS.iter().find(|(_, moment)| is_near(largest, *moment));
            let detail = name.map_or("", |(name, _)| name);
            hypotheses
                .push(free(DynamicsCause::InertiaPlaceholder, detail, FreeParameters::Inertia).missing());
        }
    }
    hypotheses
}

/// A mass at the end of the chain on a link that has none in the other description: a payload, whatever its form.
pub(super) fn only_here(
    model: &DynamicsModel,
    reference: &DynamicsModel,
    link: usize,
) -> Option<DynamicsHypothesis> {
    let there = reference.frames.find_link(model.frames.link_name(link))?;
    let is_only_here = model.inertials[link].is_some() && reference.inertials[there].is_none();
    (is_only_here && model.frames.is_at_tip(link)).then(|| {
        let change = Change::Links(vec![(link, Inertial::nothing())]);
        DynamicsHypothesis::new(DynamicsCause::Payload, "", DynamicsPlace::Links(vec![link]), change)
    })
}

/// Whether a link without an inertial could lack one: links without mass are normal on a body that has some, unless they have a
/// shape, or the other description has an inertial for them.
fn could_have_inertial(model: &DynamicsModel, reference: Option<&DynamicsModel>, link: usize) -> bool {
    let place = &model.frames.links[link];
    let Some(body) = place.body else { return false };
    let there = reference.and_then(|other| other.inertials[other.frames.find_link(&place.name)?]);
    if there.is_some() {
        return true;
    }
    let mut others = model.frames.links_of(body);
    place.has_shape
        || (model.frames.joints[body].link == link && others.all(|other| model.inertials[other].is_none()))
}

/// Whether a tensor is a power of ten times the identity, as placeholders are.
fn is_placeholder(tensor: &Matrix3<f64>) -> bool {
    let moment = tensor[(0, 0)];
    let is_even = (tensor - Matrix3::from_diagonal_element(moment)).amax() <= PLACEHOLDER * moment;
    // By powers of ten only: an even tensor of another value may be that of a ball.
    is_even && moment > 0.0 && (-12..=3).any(|exponent| is_near(moment, 10_f64.powi(exponent)))
}

fn is_near(value: f64, expected: f64) -> bool {
    (value - expected).abs() <= PLACEHOLDER * expected
}
