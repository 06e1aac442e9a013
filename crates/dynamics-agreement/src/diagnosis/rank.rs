//! The order of explanations, and which of them correct to the same parameters.

use std::ops::Range;

use congruent_description::principal_moments;
use congruent_dynamics::JointResistance;

use super::{
    cause_names::DynamicsCause,
    fit::{Corrected, FittedHypothesis},
    free::{ENTRIES, FreeParameters},
    hypothesis::{Change, DynamicsPlace},
};
use crate::{
    model::{BodyLaw, DynamicsModel, Inertial, JointTerm},
    thresholds::{COMPLEXITY_OF_MISSING, COMPLEXITY_PER_PART, FILE_DIGITS, SAME_VALUE},
};

/// One or several hypotheses that together have a residual within tolerance.
#[derive(Debug, Clone)]
pub(crate) struct ExactExplanation {
    pub(crate) parts: Vec<FittedHypothesis>,
    pub(crate) corrected: Corrected,
    pub(crate) law_broken: Option<(usize, BodyLaw)>,
    /// Whether it changes a parameter that is equal in both descriptions.
    pub(crate) contradicted: bool,
    pub(crate) complexity: f64,
}

impl ExactExplanation {
    pub(crate) fn new(
        parts: Vec<FittedHypothesis>,
        model: &DynamicsModel,
        reference: Option<&DynamicsModel>,
    ) -> Self {
        let mut corrected = Corrected::default();
        for part in &parts {
            // A later part was fitted after the earlier ones were corrected, so its values replace theirs.
            for (link, parameters) in &part.corrected.links {
                match corrected.links.iter_mut().find(|(before, _)| before == link) {
                    Some((_, before)) => *before = *parameters,
                    None => corrected.links.push((*link, *parameters)),
                }
            }
            corrected.gravity = corrected.gravity.or(part.corrected.gravity);
            if let Some(joints) = &part.corrected.joints {
                let before = corrected.joints.take().unwrap_or_else(|| model.resistances.clone());
                let changed = joints.iter().zip(&model.resistances).zip(before);
                // Term by term: of two corrections of one joint each changes only its own terms.
                corrected.joints =
                    Some(changed.map(|((new, old), before)| added(new, old, before)).collect());
            }
        }
        let law_broken = corrected.law_broken(model);
        let by_parameter = parts.iter().all(|part| part.hypothesis.change.determines_each_parameter());
        let judged = if by_parameter { &EACH[..] } else { &PARTS[..] };
        let contradicted = reference.is_some_and(|reference| {
            is_contradicted([model, reference], &corrected, judged)
                || parts.iter().any(|part| part.turns_into_another_tensor([model, reference]))
        });
        let more = f64::from(u32::try_from(parts.len() - 1).unwrap_or(u32::MAX));
        let complexity =
            parts.iter().map(FittedHypothesis::complexity).sum::<f64>() + COMPLEXITY_PER_PART * more;
        Self { parts, corrected, law_broken, contradicted, complexity }
    }

    /// Whether it changes gravity or an armature that is equal in both descriptions (two URDFs have no armature and the same
    /// gravity), or makes an armature negative.
    pub(super) fn is_impossible(&self, model: &DynamicsModel, reference: Option<&DynamicsModel>) -> bool {
        let same_gravity = reference.is_some_and(|reference| reference.gravity_m_s2 == model.gravity_m_s2);
        if self.corrected.gravity.is_some() && same_gravity {
            return true;
        }
        let armature = |of: &DynamicsModel, joint: usize| of.resistances[joint].armature;
        self.corrected.joints.iter().flatten().enumerate().any(|(joint, new)| {
            let old = armature(model, joint);
            let there = reference.and_then(|reference| {
                Some(armature(reference, reference.frames.find_joint(model.frames.joint_name(joint))?))
            });
            let is_alike = there.is_some_and(|there| is_equal(there, old));
            !is_equal(new.armature, old) && (is_alike || new.armature < 0.0)
        })
    }

    /// Whether the masses, centres of mass and tensors that it changes become those of `right`, up to the digits of a file: torques alone
    /// do not show which of several values is written there.
    pub(crate) fn gives_values_of(&self, right: &DynamicsModel, model: &DynamicsModel) -> bool {
        self.corrected.links.iter().all(|(link, corrected)| {
            let there = right.frames.find_link(model.frames.link_name(*link));
            let right = there.and_then(|there| right.inertials[there]).unwrap_or_else(Inertial::nothing);
            let written = model.inertials[*link].unwrap_or_else(Inertial::nothing);
            let LinkDifferences(changed) = LinkDifferences::between(&written, corrected);
            let LinkDifferences(wrong) = LinkDifferences::above(FILE_DIGITS, corrected, &right);
            changed.into_iter().zip(wrong).all(|(changed, wrong)| !(changed && wrong))
        })
    }

    /// Number of identifiable free parameters, those that the file lacks included.
    pub(super) fn free_numbers(&self) -> usize {
        self.parts.iter().map(|part| part.rank).sum()
    }

    /// Residual norm after all parts: that of the part which was fitted last.
    pub(crate) fn residual_norm(&self) -> f64 {
        self.parts.last().map_or(0.0, |part| part.residual_norm)
    }

    /// Key of the order of explanations, the smallest first.
    pub(super) fn rank(&self) -> GroupRank<'_> {
        let hypotheses = || self.parts.iter().map(|part| &part.hypothesis);
        let extents = hypotheses().map(|hypothesis| hypothesis.place.extent());
        #[expect(clippy::cast_possible_truncation, reason = "a few free numbers")]
        // An integer, because floats have no total order that could be derived; all complexities are multiples of
        // 0.5.
        let halves = (self.complexity * 2.0).round() as i64;
        GroupRank {
            contradicted: self.contradicted,
            no_body: self.law_broken.is_some(),
            halves,
            // The order of the fields is the order of preference: refuted by the other file, not a body,
            // complexity, extent, catalogue.
            extent: extents.fold(0, usize::saturating_add),
            causes: hypotheses().map(|hypothesis| hypothesis.cause).collect(),
            places: hypotheses().map(|hypothesis| &hypothesis.place).collect(),
        }
    }

    /// Whether two explanations have the same corrected parameters.
    pub(super) fn has_parameters_of(&self, other: &Self, model: &DynamicsModel) -> bool {
        let links = |a: &Corrected, b: &Corrected| {
            a.links.iter().all(|(link, parameters)| {
                let there =
                    b.links.iter().find(|(other, _)| other == link).map(|(_, parameters)| *parameters);
                let there = there.or(model.inertials[*link]).unwrap_or_else(Inertial::nothing);
                is_same_body(parameters, &there)
            })
        };
        let joints = |of: &Corrected| of.joints.clone().unwrap_or_else(|| model.resistances.clone());
        let gravity = |of: &Corrected| of.gravity.unwrap_or(model.gravity_m_s2);
        let (a, b) = (&self.corrected, &other.corrected);
        // Relative to the larger value, and absolute below `SAME_VALUE`: two zeros with rounding are equal.
        let close = |a: f64, b: f64| (a - b).abs() <= SAME_VALUE * a.abs().max(b.abs()).max(SAME_VALUE);
        let same_joints = joints(a).iter().zip(joints(b)).all(|(a, b)| {
            close(a.damping, b.damping) && close(a.friction, b.friction) && close(a.armature, b.armature)
        });
        let same_gravity = (gravity(a) - gravity(b)).norm() <= SAME_VALUE * model.gravity_m_s2.norm();
        // Both ways: a link that only one of the two corrects must be at its written values in the other.
        links(a, b) && links(b, a) && same_joints && same_gravity
    }
}

/// Key of the order of explanations: fields are compared from the first to the last.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct GroupRank<'a> {
    contradicted: bool,
    no_body: bool,
    halves: i64,
    extent: usize,
    causes: Vec<DynamicsCause>,
    places: Vec<&'a DynamicsPlace>,
}

impl Corrected {
    /// The first corrected link that is physically impossible, and the law that it breaks.
    pub(crate) fn law_broken(&self, model: &DynamicsModel) -> Option<(usize, BodyLaw)> {
        let mut links = self.links.iter();
        links.find_map(|(link, parameters)| Some((*link, law_broken(model, *link, parameters)?)))
    }
}

impl FittedHypothesis {
    /// Whether it turns the inertia of a link that has other principal moments in the other description. Of a link with few
    /// identifiable parameters some rotation nearly always gives the torques.
    fn turns_into_another_tensor(&self, [model, reference]: [&DynamicsModel; 2]) -> bool {
        let Change::FreeLink { link, free: FreeParameters::Rotation(_) } = self.hypothesis.change else {
            return false;
        };
        let there = reference.frames.find_link(model.frames.link_name(link));
        let there = there.and_then(|there| reference.inertials[there]);
        let Some((written, there)) = model.inertials[link].zip(there) else { return false };
        let [a, b] = [written, there].map(|of| principal_moments(&of.tensor_kg_m2));
        let size = a[2].abs().max(b[2].abs());
        a.iter().zip(b).any(|(a, b)| (a - b).abs() > FILE_DIGITS * size)
    }

    /// Whether the correction changes more than the rounding of link parameters.
    pub(super) fn is_more_than_rounding(&self, model: &DynamicsModel) -> bool {
        let is_same = |(link, parameters): &(usize, Inertial)| {
            model.inertials[*link].is_some_and(|written| is_same_body(&written, parameters))
        };
        let is_of_links = self.corrected.joints.is_none() && self.corrected.gravity.is_none();
        !(is_of_links && self.corrected.links.iter().all(is_same))
    }

    /// Merges the correction of a later stage at the same place: the cause is kept if only rounded digits change, as those of a
    /// mass in pounds.
    pub(super) fn refined_by(&mut self, later: Self, model: &DynamicsModel) {
        let [before, after] = [&*self, &later].map(|fit| fit.corrected.model(model));
        let close = |a: Option<Inertial>, b: Option<Inertial>| match (a, b) {
            (Some(a), Some(b)) => LinkDifferences::above(FILE_DIGITS, &a, &b) == LinkDifferences([false; 3]),
            _ => true,
        };
        let mut links = later.corrected.links.iter().map(|(link, _)| *link);
        // The name of the first stage is kept if the later one only restores digits; otherwise the first was an
        // approximation of it.
        if later.corrected.joints.is_none()
            && links.all(|link| close(before.inertials[link], after.inertials[link]))
        {
            self.corrected = later.corrected;
        } else {
            *self = later;
        }
    }

    /// Number of identifiable free parameters; `COMPLEXITY_OF_MISSING` if the file lacks them.
    pub(super) fn complexity(&self) -> f64 {
        if self.hypothesis.is_missing {
            return COMPLEXITY_OF_MISSING;
        }
        f64::from(u32::try_from(self.rank).unwrap_or(u32::MAX))
    }
}

/// Bitwise equality: parameters that no correction changed are copies.
fn is_equal(a: f64, b: f64) -> bool {
    a.total_cmp(&b).is_eq()
}

/// The terms that one correction changes, applied to the result of another one.
fn added(new: &JointResistance, old: &JointResistance, before: JointResistance) -> JointResistance {
    let mut sum = before;
    for term in JointTerm::ALL {
        if !is_equal(term.value_in(new), term.value_in(old)) {
            term.set(&mut sum, term.value_in(new));
        }
    }
    sum
}

/// The law that corrected parameters break; a tensor that the correction does not change is not judged.
fn law_broken(model: &DynamicsModel, link: usize, parameters: &Inertial) -> Option<BodyLaw> {
    // A link that loses its inertial is a frame, no body.
    if *parameters == Inertial::nothing() {
        return None;
    }
    let broken = parameters.law_broken(model.frames.reach_m)?;
    // A file with an impossible tensor is reported elsewhere; a correction of its mass is no worse for it.
    let keeps_tensor =
        model.inertials[link].is_some_and(|written| written.tensor_kg_m2 == parameters.tensor_kg_m2);
    (broken == BodyLaw::Mass || !keeps_tensor).then_some(broken)
}

/// Whether a correction changes what is equal in both descriptions; parameters that are `judged` together are equal if all
/// are.
fn is_contradicted(
    [model, reference]: [&DynamicsModel; 2],
    corrected: &Corrected,
    judged: &[Range<usize>],
) -> bool {
    let links = corrected.links.iter().any(|(link, parameters)| {
        let name = model.frames.link_name(*link);
        let Some(other) = reference.frames.find_link(name) else { return false };
        let written = model.inertials[*link];
        let (Some(written), Some(other)) = (written, reference.inertials[other]) else {
            return written.is_none() && reference.inertials[other].is_none();
        };
        let changed = ParameterDifferences::between(&written, parameters);
        let different = ParameterDifferences::between(&written, &other);
        changed.change_what_is_equal(&different, judged)
    });
    let joints = corrected.joints.iter().flatten().enumerate().any(|(joint, new)| {
        let name = model.frames.joint_name(joint);
        let Some(other) = reference.frames.find_joint(name) else { return false };
        let (old, other) = (&model.resistances[joint], &reference.resistances[other]);
        let changes = |new: f64, old: f64, other: f64| !is_equal(new, old) && is_equal(old, other);
        changes(new.damping, old.damping, other.damping)
            || changes(new.friction, old.friction, other.friction)
            || changes(new.armature, old.armature, other.armature)
    });
    links || joints
}

/// Which of a link's parameters differ: mass, centre of mass, tensor.
#[derive(Clone, Copy, PartialEq)]
struct LinkDifferences([bool; 3]);

impl LinkDifferences {
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
}

/// Which of a link's ten parameters differ: the mass, the centre of mass, the entries of the tensor in the link's axes.
struct ParameterDifferences([bool; 10]);

impl ParameterDifferences {
    fn between(a: &Inertial, b: &Inertial) -> Self {
        let parameters = |of: &Inertial| {
            let (c, tensor) = (of.com_m, of.tensor_in_link());
            let mut all = [of.mass_kg, c.x, c.y, c.z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            all[4..].copy_from_slice(&ENTRIES.map(|entry| tensor[entry]));
            all
        };
        let (a, b) = (parameters(a), parameters(b));
        let mut differ = [false; 10];
        for part in PARTS {
            // Relative to the largest of its part: a coordinate of zero has no size of its own.
            let size =
                a[part.clone()].iter().chain(&b[part.clone()]).fold(0.0_f64, |size, of| size.max(of.abs()));
            for at in part {
                differ[at] = (a[at] - b[at]).abs() > SAME_VALUE * size;
            }
        }
        Self(differ)
    }

    fn change_what_is_equal(&self, real: &Self, judged: &[Range<usize>]) -> bool {
        let any = |of: &Self, group: &Range<usize>| of.0[group.clone()].contains(&true);
        judged.iter().any(|group| any(self, group) && !any(real, group))
    }
}

/// Mass, centre of mass and tensor among the ten parameters.
const PARTS: [Range<usize>; 3] = [0..1, 1..4, 4..10];
/// Each of the ten parameters by itself.
const EACH: [Range<usize>; 10] = [0..1, 1..2, 2..3, 3..4, 4..5, 5..6, 6..7, 7..8, 8..9, 9..10];

/// Whether two parameters describe the same body.
pub(crate) fn is_same_body(a: &Inertial, b: &Inertial) -> bool {
    LinkDifferences::between(a, b) == LinkDifferences([false; 3])
}
