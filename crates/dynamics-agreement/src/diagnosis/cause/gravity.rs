//! Hypotheses about the direction and magnitude of gravity.

use nalgebra::Vector3;

use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        hypothesis::{Change, DynamicsHypothesis, DynamicsPlace, FaultySide},
    },
    model::DynamicsModel,
};

/// Magnitudes that are in use, in m/s^2.
const MAGNITUDES: [(&str, f64); 3] = [("9.80665", 9.80665), ("9.81", 9.81), ("9.8", 9.8)];
const AXES: [&str; 6] = ["x", "y", "z", "-x", "-y", "-z"];

pub(super) fn hypotheses(model: &DynamicsModel, faulty: FaultySide) -> Vec<DynamicsHypothesis> {
    let gravity = model.gravity_m_s2;
    let size = gravity.norm();
    let mistake = |cause, detail: &str, gravity| {
        DynamicsHypothesis::new(cause, detail, DynamicsPlace::Gravity, Change::Gravity(gravity))
    };
    let free = |cause, detail: &str, along| {
        DynamicsHypothesis::new(cause, detail, DynamicsPlace::Gravity, Change::FreeGravity(along))
    };
    let every_axis = (0..3).map(|axis| Vector3::ith(axis, 1.0)).collect();
    // Without a magnitude there is neither a sign nor a direction that could be wrong.
    if size == 0.0 {
        return vec![free(DynamicsCause::GravityMissing, "", every_axis).missing()];
    }
    let mut all = vec![mistake(DynamicsCause::GravitySign, "", -gravity)];
    if faulty == FaultySide::Reference {
        all.push(mistake(DynamicsCause::GravityMissing, "", Vector3::zeros()));
    }
    for (index, name) in AXES.into_iter().enumerate() {
        let sign = if index < 3 { size } else { -size };
        let along = Vector3::ith(index % 3, sign);
        // The direction as it is explains nothing, and its opposite is the sign, which is named already.
        if (along - gravity).norm() > size * 1e-9 && (along + gravity).norm() > size * 1e-9 {
            all.push(mistake(DynamicsCause::GravityDirection, name, along));
        }
    }
    for (name, magnitude) in MAGNITUDES {
        // 9.81 and 9.8 differ by 1e-2: whatever is nearer than 1e-9 is the same magnitude.
        if (magnitude - size).abs() > 1e-9 {
            all.push(mistake(DynamicsCause::GravityMagnitude, name, gravity * (magnitude / size)));
        }
    }
    // The free magnitude (one parameter) before the free vector (three): the fit with fewer parameters is named.
    all.push(free(DynamicsCause::GravityMagnitude, "", vec![gravity / size]));
    all.push(free(DynamicsCause::GravityDirection, "", every_axis));
    all
}
