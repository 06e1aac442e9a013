//! Damping, dry friction and armature.

use congruent_dynamics::JointResistance;

use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        hypothesis::{Change, FaultySide, Hypothesis, Place},
    },
    side::{JointTerm, Side},
    thresholds::SAME_VALUE,
};

/// What physics engines give joints without damping, in N m s/rad.
const DEFAULT_DAMPING: f64 = 0.1;

pub(super) fn hypotheses(side: &Side, faulty: FaultySide) -> Vec<Hypothesis> {
    let mut all = slips(side, faulty);
    let n = side.frames.dof();
    for (term, cause) in JointTerm::ALL.into_iter().zip([
        DynamicsCause::Damping,
        DynamicsCause::Friction,
        DynamicsCause::Armature,
    ]) {
        let free = |detail: &str, place, groups| {
            Hypothesis::new(cause, detail, place, Change::FreeJoints { term, groups })
        };
        for joint in 0..n {
            all.push(free("", Place::Joints(vec![joint]), vec![vec![joint]]));
        }
        if n > 1 {
            all.push(free("same", Place::AllJoints, vec![(0..n).collect()]));
            all.push(free("each", Place::AllJoints, (0..n).map(|joint| vec![joint]).collect()));
        }
    }
    all
}

fn slips(side: &Side, faulty: FaultySide) -> Vec<Hypothesis> {
    let n = side.frames.dof();
    let mut all = Vec::new();
    let mut everywhere = |cause, detail: &str, change: &dyn Fn(usize, JointResistance) -> JointResistance| {
        let changed: Vec<JointResistance> =
            (0..n).map(|joint| change(joint, side.resistances[joint])).collect();
        if changed != side.resistances {
            all.push(Hypothesis::new(cause, detail, Place::AllJoints, Change::Joints(changed)));
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
            // Dry friction that was written as damping leaves none where it belongs.
            if side.resistances.iter().all(|of| of.friction == 0.0) {
                everywhere(DynamicsCause::FrictionAsDamping, "", &|_, of| JointResistance {
                    damping: 0.0,
                    friction: of.damping,
                    ..of
                });
            }
            all.extend(left_out(side));
        }
        FaultySide::Reference => {
            everywhere(DynamicsCause::JointTermsMissing, "", &|_, _| JointResistance::default());
            everywhere(DynamicsCause::DampingMissing, "", &|_, of| JointResistance { damping: 0.0, ..of });
            everywhere(DynamicsCause::FrictionMissing, "", &|_, of| JointResistance { friction: 0.0, ..of });
            everywhere(DynamicsCause::FrictionAsDamping, "", &|_, of| JointResistance {
                damping: of.friction,
                friction: 0.0,
                ..of
            });
            everywhere(DynamicsCause::DampingDefault, "0.1", &|joint, of| JointResistance {
                damping: if side.frames.joints[joint].is_angular { DEFAULT_DAMPING } else { of.damping },
                ..of
            });
        }
    }
    for first in 0..n {
        for second in first + 1..n {
            if side.resistances[first] != side.resistances[second] {
                let mut changed = side.resistances.clone();
                changed.swap(first, second);
                let place = Place::Joints(vec![first, second]);
                all.push(Hypothesis::new(DynamicsCause::JointsSwapped, "", place, Change::Joints(changed)));
            }
        }
    }
    all
}

/// Terms that the file has nowhere, or only by default: each joint has a free number. Zeros are a name, no discount.
fn left_out(side: &Side) -> Vec<Hypothesis> {
    let n = side.frames.dof();
    let all = |is: &dyn Fn(&JointResistance) -> bool| side.resistances.iter().all(is);
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
        Hypothesis::new(cause, detail, Place::AllJoints, change)
    };
    names.into_iter().map(hypothesis).collect()
}

/// All terms that the other description has, if this one has none at all and the other both damping and dry friction.
pub(in crate::diagnosis) fn all_left_out(side: &Side, reference: &Side) -> Option<Hypothesis> {
    let has = |term: fn(&JointResistance) -> f64| reference.resistances.iter().any(|of| term(of) != 0.0);
    let is_left_out = side.resistances.iter().all(|of| *of == JointResistance::default())
        && side.resistances.len() == reference.resistances.len()
        && has(|of| of.damping)
        && has(|of| of.friction);
    let change = || Change::Joints(reference.resistances.clone());
    is_left_out.then(|| Hypothesis::new(DynamicsCause::JointTermsMissing, "", Place::AllJoints, change()))
}

/// Written values are so many times the right ones.
fn factor_of(faulty: FaultySide, factor: f64) -> f64 {
    match faulty {
        FaultySide::Candidate => factor,
        FaultySide::Reference => factor.recip(),
    }
}
