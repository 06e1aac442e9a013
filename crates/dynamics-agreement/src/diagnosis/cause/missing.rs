//! Parameters that a file does not have: zeros and placeholders stand there. The zeros are the evidence; what should
//! stand there is free. If the reference is taken to be wrong, it is the importer that put them there.

use nalgebra::{Matrix3, Vector3};

use super::slip::Slip;
use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        free::Free,
        hypothesis::{Change, Hypothesis, Place},
    },
    side::{Inertial, Side},
    thresholds::{PLACEHOLDER, ZERO_VALUE},
};

const PLACEHOLDERS: [(&str, f64); 3] = [("identity", 1.0), ("tenth", 0.1), ("milli", 0.001)];

/// What an importer leaves out.
pub(super) fn slips_of_importers<'a>() -> Vec<Slip<'a>> {
    let mut slips = vec![
        Slip::new(DynamicsCause::ComMissing, "", |parameters| Inertial {
            com_m: Vector3::zeros(),
            ..*parameters
        }),
        Slip::new(DynamicsCause::ProductsMissing, "", |parameters| Inertial {
            tensor_kg_m2: Matrix3::from_diagonal(&parameters.tensor_kg_m2.diagonal()),
            ..*parameters
        }),
        Slip::new(DynamicsCause::InertiaMissing, "", |parameters| Inertial {
            tensor_kg_m2: Matrix3::zeros(),
            ..*parameters
        }),
        Slip::new(DynamicsCause::InertialLeftOut, "", |_| Inertial::nothing()),
    ];
    for (name, moment) in PLACEHOLDERS {
        slips.push(Slip::new(DynamicsCause::InertiaPlaceholder, name, move |parameters| Inertial {
            tensor_kg_m2: Matrix3::from_diagonal_element(moment),
            link_from_axes: Matrix3::identity(),
            ..*parameters
        }));
    }
    slips
}

/// What a link's file lacks.
pub(super) fn of_link(side: &Side, reference: Option<&Side>, link: usize) -> Vec<Hypothesis> {
    let free = |cause, detail: &str, free| {
        Hypothesis::new(cause, detail, Place::Links(vec![link]), Change::FreeLink { link, free })
    };
    let Some(parameters) = &side.inertials[link] else {
        let missing = free(DynamicsCause::InertialMissing, "", Free::Inertial).missing();
        return if could_have_inertial(side, reference, link) { vec![missing] } else { Vec::new() };
    };
    let mut hypotheses = Vec::new();
    let tensor = &parameters.tensor_kg_m2;
    let off_diagonal = tensor - Matrix3::from_diagonal(&tensor.diagonal());
    let largest = tensor.amax();
    if parameters.com_m.amax() <= ZERO_VALUE {
        hypotheses.push(free(DynamicsCause::ComMissing, "", Free::Com));
    }
    if largest == 0.0 {
        hypotheses.push(free(DynamicsCause::InertiaMissing, "", Free::Inertia).missing());
    } else if off_diagonal.amax() <= ZERO_VALUE * largest {
        hypotheses.push(free(DynamicsCause::ProductsMissing, "", Free::Products));
        if is_placeholder(tensor) {
            let name = PLACEHOLDERS.iter().find(|(_, moment)| is_near(largest, *moment));
            let detail = name.map_or("", |(name, _)| name);
            hypotheses.push(free(DynamicsCause::InertiaPlaceholder, detail, Free::Inertia).missing());
        }
    }
    hypotheses
}

/// Frames without mass are normal on a body that has some, unless something is drawn there, or the other description
/// has an inertial there.
fn could_have_inertial(side: &Side, reference: Option<&Side>, link: usize) -> bool {
    let place = &side.frames.links[link];
    let Some(body) = place.body else { return false };
    let there = reference.and_then(|other| other.inertials[other.frames.find_link(&place.name)?]);
    if there.is_some() {
        return true;
    }
    let mut others = side.frames.links_of(body);
    place.has_shape
        || (side.frames.joints[body].link == link && others.all(|other| side.inertials[other].is_none()))
}

/// A power of ten times identity.
fn is_placeholder(tensor: &Matrix3<f64>) -> bool {
    let moment = tensor[(0, 0)];
    let is_even = (tensor - Matrix3::from_diagonal_element(moment)).amax() <= PLACEHOLDER * moment;
    is_even && moment > 0.0 && (-12..=3).any(|exponent| is_near(moment, 10_f64.powi(exponent)))
}

fn is_near(value: f64, expected: f64) -> bool {
    (value - expected).abs() <= PLACEHOLDER * expected
}
