//! The order of explanations, and which of them say the same.

use congruent_dynamics::JointResistance;

use super::{
    cause_names::DynamicsCause,
    fit::{Corrected, Fit},
    hypothesis::Place,
};
use crate::{
    side::{BodyLaw, Inertial, JointTerm, Side},
    thresholds::{FILE_DIGITS, PRICE_OF_MISSING, PRICE_OF_PART, SAME_VALUE},
};

/// One or several hypotheses that together leave nothing.
#[derive(Debug, Clone)]
pub(crate) struct Exact {
    pub(crate) parts: Vec<Fit>,
    pub(crate) corrected: Corrected,
    pub(crate) law_broken: Option<(usize, BodyLaw)>,
    /// Whether a parameter is named that is the same in both descriptions.
    pub(crate) contradicted: bool,
    pub(crate) price: f64,
}

impl Exact {
    pub(crate) fn new(parts: Vec<Fit>, side: &Side, reference: Option<&Side>) -> Self {
        let mut corrected = Corrected::default();
        for part in &parts {
            // A later part corrects what the earlier ones leave.
            for (link, parameters) in &part.corrected.links {
                match corrected.links.iter_mut().find(|(before, _)| before == link) {
                    Some((_, before)) => *before = *parameters,
                    None => corrected.links.push((*link, *parameters)),
                }
            }
            corrected.gravity = corrected.gravity.or(part.corrected.gravity);
            if let Some(joints) = &part.corrected.joints {
                let before = corrected.joints.take().unwrap_or_else(|| side.resistances.clone());
                let changed = joints.iter().zip(&side.resistances).zip(before);
                corrected.joints =
                    Some(changed.map(|((new, old), before)| added(new, old, before)).collect());
            }
        }
        let law_broken = corrected.law_broken(side);
        let contradicted = reference.is_some_and(|reference| is_contradicted(side, reference, &corrected));
        let more = f64::from(u32::try_from(parts.len() - 1).unwrap_or(u32::MAX));
        let price = parts.iter().map(Fit::price).sum::<f64>() + PRICE_OF_PART * more;
        Self { parts, corrected, law_broken, contradicted, price }
    }

    /// Whether gravity or an armature is named that both descriptions have alike, as two URDFs have no armature and the
    /// same gravity, or an armature that is negative.
    pub(super) fn is_impossible(&self, side: &Side, reference: Option<&Side>) -> bool {
        let same_gravity = reference.is_some_and(|reference| reference.gravity_m_s2 == side.gravity_m_s2);
        if self.corrected.gravity.is_some() && same_gravity {
            return true;
        }
        let armature = |of: &Side, joint: usize| of.resistances[joint].armature;
        self.corrected.joints.iter().flatten().enumerate().any(|(joint, new)| {
            let old = armature(side, joint);
            let there = reference.and_then(|reference| {
                Some(armature(reference, reference.frames.find_joint(side.frames.joint_name(joint))?))
            });
            let is_alike = there.is_some_and(|there| is_equal(there, old));
            !is_equal(new.armature, old) && (is_alike || new.armature < 0.0)
        })
    }

    /// Free numbers that torque shows, those that the file lacks among them.
    pub(super) fn free_numbers(&self) -> usize {
        self.parts.iter().map(|part| part.rank).sum()
    }

    /// The left norm, of the part that was fitted last.
    pub(crate) fn left(&self) -> f64 {
        self.parts.last().map_or(0.0, |part| part.left)
    }

    /// Smaller is first; prices are halves.
    pub(super) fn rank(&self) -> Rank<'_> {
        let hypotheses = || self.parts.iter().map(|part| &part.hypothesis);
        let extents = hypotheses().map(|hypothesis| hypothesis.place.extent());
        #[expect(clippy::cast_possible_truncation, reason = "a few free numbers")]
        let halves = (self.price * 2.0).round() as i64;
        Rank {
            contradicted: self.contradicted,
            no_body: self.law_broken.is_some(),
            halves,
            extent: extents.fold(0, usize::saturating_add),
            causes: hypotheses().map(|hypothesis| hypothesis.cause).collect(),
            places: hypotheses().map(|hypothesis| &hypothesis.place).collect(),
        }
    }

    /// Whether two explanations end at the same parameters.
    pub(super) fn has_parameters_of(&self, other: &Self, side: &Side) -> bool {
        let links = |a: &Corrected, b: &Corrected| {
            a.links.iter().all(|(link, parameters)| {
                let there =
                    b.links.iter().find(|(other, _)| other == link).map(|(_, parameters)| *parameters);
                let there = there.or(side.inertials[*link]).unwrap_or_else(Inertial::nothing);
                is_same(parameters, &there)
            })
        };
        let joints = |of: &Corrected| of.joints.clone().unwrap_or_else(|| side.resistances.clone());
        let gravity = |of: &Corrected| of.gravity.unwrap_or(side.gravity_m_s2);
        let (a, b) = (&self.corrected, &other.corrected);
        let close = |a: f64, b: f64| (a - b).abs() <= SAME_VALUE * a.abs().max(b.abs()).max(SAME_VALUE);
        let same_joints = joints(a).iter().zip(joints(b)).all(|(a, b)| {
            close(a.damping, b.damping) && close(a.friction, b.friction) && close(a.armature, b.armature)
        });
        let same_gravity = (gravity(a) - gravity(b)).norm() <= SAME_VALUE * side.gravity_m_s2.norm();
        links(a, b) && links(b, a) && same_joints && same_gravity
    }
}

/// The order of explanations.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Rank<'a> {
    contradicted: bool,
    no_body: bool,
    halves: i64,
    extent: usize,
    causes: Vec<DynamicsCause>,
    places: Vec<&'a Place>,
}

impl Corrected {
    /// The first link that would be no body, and the law that it breaks.
    pub(crate) fn law_broken(&self, side: &Side) -> Option<(usize, BodyLaw)> {
        let mut links = self.links.iter();
        links.find_map(|(link, parameters)| Some((*link, law_broken(side, *link, parameters)?)))
    }
}

impl Fit {
    /// Whether more than rounding of a link's parameters is corrected, or anything else.
    pub(super) fn is_more_than_rounding(&self, side: &Side) -> bool {
        let is_same = |(link, parameters): &(usize, Inertial)| {
            side.inertials[*link].is_some_and(|written| is_same(&written, parameters))
        };
        let is_of_links = self.corrected.joints.is_none() && self.corrected.gravity.is_none();
        !(is_of_links && self.corrected.links.iter().all(is_same))
    }

    /// Takes in what a later stage corrects at the same place: the name stays if only the digits of the file are other,
    /// as those of a mass in pounds.
    pub(super) fn refined_by(&mut self, later: Self, side: &Side) {
        let [before, after] = [&*self, &later].map(|fit| fit.corrected.side(side));
        let close = |a: Option<Inertial>, b: Option<Inertial>| match (a, b) {
            (Some(a), Some(b)) => Differences::above(FILE_DIGITS, &a, &b) == Differences([false; 3]),
            _ => true,
        };
        let mut links = later.corrected.links.iter().map(|(link, _)| *link);
        if later.corrected.joints.is_none()
            && links.all(|link| close(before.inertials[link], after.inertials[link]))
        {
            self.corrected = later.corrected;
        } else {
            *self = later;
        }
    }

    /// Free numbers that torque shows, or less if the file lacks the parameter.
    pub(super) fn price(&self) -> f64 {
        if self.hypothesis.is_missing {
            return PRICE_OF_MISSING;
        }
        f64::from(u32::try_from(self.rank).unwrap_or(u32::MAX))
    }
}

/// Exactly, as parameters that nobody has touched are.
fn is_equal(a: f64, b: f64) -> bool {
    a.total_cmp(&b).is_eq()
}

/// What one correction changes, on top of what another one did.
fn added(new: &JointResistance, old: &JointResistance, before: JointResistance) -> JointResistance {
    let mut sum = before;
    for term in JointTerm::ALL {
        if !is_equal(term.of(new), term.of(old)) {
            term.set(&mut sum, term.of(new));
        }
    }
    sum
}

/// The law that corrected parameters break; parameters that the correction leaves as they are written are not judged.
fn law_broken(side: &Side, link: usize, parameters: &Inertial) -> Option<BodyLaw> {
    let broken = parameters.law_broken(side.frames.reach_m)?;
    let keeps_tensor =
        side.inertials[link].is_some_and(|written| written.tensor_kg_m2 == parameters.tensor_kg_m2);
    (broken == BodyLaw::Mass || !keeps_tensor).then_some(broken)
}

/// Whether a correction changes a parameter that is the same in both descriptions.
fn is_contradicted(side: &Side, reference: &Side, corrected: &Corrected) -> bool {
    let links = corrected.links.iter().any(|(link, parameters)| {
        let name = side.frames.link_name(*link);
        let Some(other) = reference.frames.find_link(name) else { return false };
        let written = side.inertials[*link];
        let (Some(written), Some(other)) = (written, reference.inertials[other]) else {
            return written.is_none() && reference.inertials[other].is_none();
        };
        Differences::between(&written, parameters)
            .change_what_is_equal(Differences::between(&written, &other))
    });
    let joints = corrected.joints.iter().flatten().enumerate().any(|(joint, new)| {
        let name = side.frames.joint_name(joint);
        let Some(other) = reference.frames.find_joint(name) else { return false };
        let (old, other) = (&side.resistances[joint], &reference.resistances[other]);
        let changes = |new: f64, old: f64, other: f64| !is_equal(new, old) && is_equal(old, other);
        changes(new.damping, old.damping, other.damping)
            || changes(new.friction, old.friction, other.friction)
            || changes(new.armature, old.armature, other.armature)
    });
    links || joints
}

/// Which of a link's parameters differ: mass, centre of mass, tensor.
#[derive(Clone, Copy, PartialEq)]
struct Differences([bool; 3]);

impl Differences {
    fn between(a: &Inertial, b: &Inertial) -> Self {
        Self::above(SAME_VALUE, a, b)
    }

    fn above(share: f64, a: &Inertial, b: &Inertial) -> Self {
        let differs = |difference: f64, size: f64| difference > share * size;
        let tensors = [a.tensor_in_link(), b.tensor_in_link()];
        Self([
            differs((a.mass_kg - b.mass_kg).abs(), a.mass_kg.abs().max(b.mass_kg.abs())),
            differs((a.com_m - b.com_m).amax(), a.com_m.amax().max(b.com_m.amax())),
            differs((tensors[0] - tensors[1]).amax(), tensors[0].amax().max(tensors[1].amax())),
        ])
    }

    fn change_what_is_equal(self, real: Self) -> bool {
        self.0.into_iter().zip(real.0).any(|(named, real)| named && !real)
    }
}

/// Whether two parameters describe the same body.
fn is_same(a: &Inertial, b: &Inertial) -> bool {
    Differences::between(a, b) == Differences([false; 3])
}
