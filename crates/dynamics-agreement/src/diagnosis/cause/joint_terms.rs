//! Damping, dry friction and armature.

use congruent_dynamics::JointResistance;

use crate::{
    diagnosis::{
        cause_names::Cause,
        hypothesis::{Change, Hypothesis, Place, Suspect},
    },
    side::{JointTerm, Side},
};

/// What physics engines give joints without damping, in N m s/rad.
const DEFAULT_DAMPING: f64 = 0.1;

pub(super) fn hypotheses(side: &Side, suspect: Suspect) -> Vec<Hypothesis> {
    let mut all = slips(side, suspect);
    let n = side.frames.dof();
    for (term, cause) in JointTerm::ALL.into_iter().zip([Cause::Damping, Cause::Friction, Cause::Armature]) {
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

fn slips(side: &Side, suspect: Suspect) -> Vec<Hypothesis> {
    let n = side.frames.dof();
    let mut all = Vec::new();
    let mut everywhere = |cause, detail: &str, change: &dyn Fn(usize, JointResistance) -> JointResistance| {
        let changed: Vec<JointResistance> =
            (0..n).map(|joint| change(joint, side.resistances[joint])).collect();
        if changed != side.resistances {
            all.push(Hypothesis::new(cause, detail, Place::AllJoints, Change::Joints(changed)));
        }
    };
    everywhere(Cause::DampingFrictionSwapped, "", &|_, of| JointResistance {
        damping: of.friction,
        friction: of.damping,
        ..of
    });
    for (detail, factor) in
        [("degrees", 180.0 / std::f64::consts::PI), ("radians", std::f64::consts::PI / 180.0)]
    {
        let factor = suspect_factor(suspect, factor);
        everywhere(Cause::DampingUnit, detail, &|_, of| JointResistance {
            damping: of.damping * factor,
            ..of
        });
    }
    match suspect {
        Suspect::Candidate => {
            // Dry friction that was written as damping leaves none where it belongs.
            if side.resistances.iter().all(|of| of.friction == 0.0) {
                everywhere(Cause::FrictionAsDamping, "", &|_, of| JointResistance {
                    damping: 0.0,
                    friction: of.damping,
                    ..of
                });
            }
        }
        Suspect::Reference => {
            everywhere(Cause::JointTermsMissing, "", &|_, _| JointResistance::default());
            everywhere(Cause::DampingMissing, "", &|_, of| JointResistance { damping: 0.0, ..of });
            everywhere(Cause::FrictionMissing, "", &|_, of| JointResistance { friction: 0.0, ..of });
            everywhere(Cause::FrictionAsDamping, "", &|_, of| JointResistance {
                damping: of.friction,
                friction: 0.0,
                ..of
            });
            everywhere(Cause::DampingDefault, "0.1", &|joint, of| JointResistance {
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
                all.push(Hypothesis::new(Cause::JointsSwapped, "", place, Change::Joints(changed)));
            }
        }
    }
    all
}

/// Written values are so many times the right ones.
fn suspect_factor(suspect: Suspect, factor: f64) -> f64 {
    match suspect {
        Suspect::Candidate => factor,
        Suspect::Reference => factor.recip(),
    }
}
