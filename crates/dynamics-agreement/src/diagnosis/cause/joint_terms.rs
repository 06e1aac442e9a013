//! Hypotheses about damping, dry friction and armature of joints.

use congruent_dynamics::JointResistance;

use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        hypothesis::{Change, DynamicsHypothesis, DynamicsPlace, FaultySide},
    },
    model::{DynamicsModel, JointTerm},
    thresholds::SAME_VALUE,
};

/// Default damping of physics engines for joints without one, N m s/rad.
const DEFAULT_DAMPING: f64 = 0.1;

pub(super) fn hypotheses(model: &DynamicsModel, faulty: FaultySide) -> Vec<DynamicsHypothesis> {
    let mut all = mistakes(model, faulty);
    let n = model.frames.dof();
    for (term, cause) in JointTerm::ALL.into_iter().zip([
        DynamicsCause::Damping,
        DynamicsCause::Friction,
        DynamicsCause::Armature,
    ]) {
        let free = |detail: &str, place, groups| {
            DynamicsHypothesis::new(cause, detail, place, Change::FreeJoints { term, groups })
        };
        for joint in 0..n {
            all.push(free("", DynamicsPlace::Joints(vec![joint]), vec![vec![joint]]));
        }
        if n > 1 {
            all.push(free("same", DynamicsPlace::AllJoints, vec![(0..n).collect()]));
            all.push(free("each", DynamicsPlace::AllJoints, (0..n).map(|joint| vec![joint]).collect()));
        }
    }
    all
}

fn mistakes(model: &DynamicsModel, faulty: FaultySide) -> Vec<DynamicsHypothesis> {
    let n = model.frames.dof();
    let mut all = Vec::new();
    let mut everywhere = |cause, detail: &str, change: &dyn Fn(usize, JointResistance) -> JointResistance| {
        let changed: Vec<JointResistance> =
            (0..n).map(|joint| change(joint, model.resistances[joint])).collect();
        // A change that changes nothing, as of zeros, would explain nothing and only cost time.
        if changed != model.resistances {
            all.push(DynamicsHypothesis::new(
                cause,
                detail,
                DynamicsPlace::AllJoints,
                Change::Joints(changed),
            ));
        }
    };
    everywhere(DynamicsCause::DampingFrictionSwapped, "", &|_, of| JointResistance {
        damping: of.friction,
        friction: of.damping,
        ..of
    });
    for (detail, factor) in
        [("degrees", 180.0 / std::f64::consts::PI), ("radians", std::f64::consts::PI / 180.0)]
    {
        let factor = factor_of(faulty, factor);
        everywhere(DynamicsCause::DampingUnit, detail, &|_, of| JointResistance {
            damping: of.damping * factor,
            ..of
        });
    }
    match faulty {
        FaultySide::Candidate => {
            // If friction was written as damping, the file has no friction anywhere.
            if model.resistances.iter().all(|of| of.friction == 0.0) {
                everywhere(DynamicsCause::FrictionAsDamping, "", &|_, of| JointResistance {
                    damping: 0.0,
                    friction: of.damping,
                    ..of
                });
            }
            // The reference says which values are missing only through its torques: they are fitted.
            all.extend(left_out(model));
        }
        FaultySide::Reference => {
            // What was built from the file can lack values that the file has, so zeros are a complete hypothesis
            // here.
            everywhere(DynamicsCause::JointTermsMissing, "", &|_, _| JointResistance::default());
            everywhere(DynamicsCause::DampingMissing, "", &|_, of| JointResistance { damping: 0.0, ..of });
            everywhere(DynamicsCause::FrictionMissing, "", &|_, of| JointResistance { friction: 0.0, ..of });
            everywhere(DynamicsCause::FrictionAsDamping, "", &|_, of| JointResistance {
                damping: of.friction,
                friction: 0.0,
                ..of
            });
            everywhere(DynamicsCause::DampingDefault, "0.1", &|joint, of| JointResistance {
                // The engine's default is for angular joints alone.
                damping: if model.frames.joints[joint].is_angular { DEFAULT_DAMPING } else { of.damping },
                ..of
            });
        }
    }
    all.extend(exchanged(model));
    all
}

/// The terms of two joints exchanged, for each pair of joints that differ.
fn exchanged(model: &DynamicsModel) -> Vec<DynamicsHypothesis> {
    let n = model.frames.dof();
    let mut all = Vec::new();
    for first in 0..n {
        for second in first + 1..n {
            // Equal joints exchanged are the same robot.
            if model.resistances[first] != model.resistances[second] {
                let mut changed = model.resistances.clone();
                changed.swap(first, second);
                let place = DynamicsPlace::Joints(vec![first, second]);
                all.push(DynamicsHypothesis::new(
                    DynamicsCause::JointsSwapped,
                    "",
                    place,
                    Change::Joints(changed),
                ));
            }
        }
    }
    all
}

/// Terms that no joint of the file has, or all have by default: each joint has a free value. The zeros give the cause its name,
/// but no lower complexity.
fn left_out(model: &DynamicsModel) -> Vec<DynamicsHypothesis> {
    let n = model.frames.dof();
    let all = |is: &dyn Fn(&JointResistance) -> bool| model.resistances.iter().all(is);
    let is_default = |damping: f64| (damping - DEFAULT_DAMPING).abs() <= SAME_VALUE * DEFAULT_DAMPING;
    let mut names = Vec::new();
    if all(&|of| of.damping == 0.0) {
        names.push((DynamicsCause::DampingMissing, "", JointTerm::Damping));
    } else if all(&|of| is_default(of.damping)) {
        names.push((DynamicsCause::DampingDefault, "0.1", JointTerm::Damping));
    }
    if all(&|of| of.friction == 0.0) {
        names.push((DynamicsCause::FrictionMissing, "", JointTerm::Friction));
    }
    let groups: Vec<Vec<usize>> = (0..n).map(|joint| vec![joint]).collect();
    let hypothesis = |(cause, detail, term)| {
        let change = Change::FreeJoints { term, groups: groups.clone() };
        DynamicsHypothesis::new(cause, detail, DynamicsPlace::AllJoints, change)
    };
    names.into_iter().map(hypothesis).collect()
}

/// The terms of the other description, if this one has none at all and the other one has both damping and dry friction.
pub(in crate::diagnosis) fn all_left_out(
    model: &DynamicsModel,
    reference: &DynamicsModel,
) -> Option<DynamicsHypothesis> {
    let has = |term: fn(&JointResistance) -> f64| reference.resistances.iter().any(|of| term(of) != 0.0);
    let is_left_out = model.resistances.iter().all(|of| *of == JointResistance::default())
        && model.resistances.len() == reference.resistances.len()
        && has(|of| of.damping)
        && has(|of| of.friction);
    let change = || Change::Joints(reference.resistances.clone());
    is_left_out.then(|| {
        DynamicsHypothesis::new(DynamicsCause::JointTermsMissing, "", DynamicsPlace::AllJoints, change())
    })
}

/// The factor of a unit mistake as it applies to the candidate, which undoes it, or to the reference, which makes it.
fn factor_of(faulty: FaultySide, factor: f64) -> f64 {
    match faulty {
        FaultySide::Candidate => factor,
        FaultySide::Reference => factor.recip(),
    }
}
