//! Direction and magnitude of gravity.

use nalgebra::Vector3;

use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        hypothesis::{Change, FaultySide, Hypothesis, Place},
    },
    side::Side,
};

/// Magnitudes that are in use, in m/s^2.
const MAGNITUDES: [(&str, f64); 3] = [("9.80665", 9.80665), ("9.81", 9.81), ("9.8", 9.8)];
const AXES: [&str; 6] = ["x", "y", "z", "-x", "-y", "-z"];

pub(super) fn hypotheses(side: &Side, faulty: FaultySide) -> Vec<Hypothesis> {
    let gravity = side.gravity_m_s2;
    let size = gravity.norm();
    let slip = |cause, detail: &str, gravity| {
        Hypothesis::new(cause, detail, Place::Gravity, Change::Gravity(gravity))
    };
    let free = |cause, detail: &str, along| {
        Hypothesis::new(cause, detail, Place::Gravity, Change::FreeGravity(along))
    };
    let every_way = (0..3).map(|axis| Vector3::ith(axis, 1.0)).collect();
    if size == 0.0 {
        return vec![free(DynamicsCause::GravityMissing, "", every_way).missing()];
    }
    let mut all = vec![slip(DynamicsCause::GravitySign, "", -gravity)];
    if faulty == FaultySide::Reference {
        all.push(slip(DynamicsCause::GravityMissing, "", Vector3::zeros()));
    }
    for (index, name) in AXES.into_iter().enumerate() {
        let sign = if index < 3 { size } else { -size };
        let along = Vector3::ith(index % 3, sign);
        if (along - gravity).norm() > size * 1e-9 && (along + gravity).norm() > size * 1e-9 {
            all.push(slip(DynamicsCause::GravityDirection, name, along));
        }
    }
    for (name, magnitude) in MAGNITUDES {
        if (magnitude - size).abs() > 1e-9 {
            all.push(slip(DynamicsCause::GravityMagnitude, name, gravity * (magnitude / size)));
        }
    }
    all.push(free(DynamicsCause::GravityMagnitude, "", vec![gravity / size]));
    all.push(free(DynamicsCause::GravityDirection, "", every_way));
    all
}
