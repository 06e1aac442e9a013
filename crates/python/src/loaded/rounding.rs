//! What 32-bit numbers of an engine leave open, in the same terms as the digits of a file.

use congruent::{
    description::{InertiaRounding, Joint, JointLimit, JointRounding, JointValueRounding, Link, SmallMotion},
    nalgebra::Vector3,
};

/// How far a value may be off that an engine has computed in 32-bit numbers, as a share of it: 4 halves of the last place. Kind:
/// rounding; importers compose a few transforms.
const SINGLE: f64 = 4.0 / (1 << 24) as f64;
/// Values of this size are added where small ones come out, m: lengths of arms. Kind: choice.
const ARM_M: f64 = 1.0;

/// The joint with what 32-bit numbers leave open.
pub(super) fn rounded_joint(joint: Joint) -> Joint {
    let at = joint.parent_from_joint.translation.vector;
    let half_m = SINGLE * at.norm().max(ARM_M);
    let axes = [0, 1, 2].map(|axis| Vector3::ith(axis, 1.0));
    let shifts = axes.iter().map(|axis| SmallMotion::shift(axis * half_m));
    let turns = axes.iter().map(|axis| SmallMotion::turn(axis * SINGLE, &at));
    let rounding = JointRounding { origin: shifts.chain(turns).collect(), ..JointRounding::default() };
    let half = |value: f64| SINGLE * value.abs();
    let limit = joint.limit.unwrap_or_default();
    let of_limit = JointLimit {
        lower: half(limit.lower),
        upper: half(limit.upper),
        effort: limit.effort.map(half),
        velocity: limit.velocity.map(half),
        ..JointLimit::default()
    };
    let value_rounding = JointValueRounding {
        limit: of_limit,
        damping: half(joint.damping),
        friction: half(joint.friction),
        armature: joint.armature.map(half).unwrap_or_default(),
    };
    Joint { rounding, value_rounding, ..joint }
}

/// The link with what 32-bit numbers leave open.
pub(super) fn rounded_link(link: Link) -> Link {
    let Some(inertia) = &link.inertia else { return link };
    let point = inertia.link_from_inertial.translation.vector;
    let inertia_rounding = InertiaRounding {
        mass_kg: SINGLE * inertia.mass_kg.abs(),
        com_m: Vector3::repeat(SINGLE * point.norm()),
        tensor_kg_m2: inertia.tensor_kg_m2.map(|_| SINGLE * inertia.tensor_kg_m2.norm()),
    };
    Link { inertia_rounding, ..link }
}
