//! The digits that inertials, limits and losses are written with.

use congruent_input::{
    TypedNumber, axes_of_rpy_fixed_xyz, half_places, half_places_of_point, half_places_of_values,
    units::{Unit, UnitSystem},
};
use congruent_robot::{Inertia, InertiaRounding, JointKind, JointLimit, JointValueRounding};
use nalgebra::{Matrix3, Vector3};
use roxmltree::Node;

use super::node::element;

/// Moments as `<inertia>` names them.
const MOMENTS: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];

/// What the digits of an `<inertial>` leave open.
pub(super) fn of_inertia(inertial: Node<'_, '_>, inertia: &Inertia) -> InertiaRounding {
    let mass = half_places_of_values(&[value(inertial, "mass", "value")])[0];
    let com = three(value(inertial, "origin", "xyz"), half_places_of_point);
    let [xx, xy, xz, yy, yz, zz] = half_places_of_values(&MOMENTS.map(|key| value(inertial, "inertia", key)))
        .try_into()
        .expect("one half place for each moment");
    let moments = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let axes = axes_of_rpy_fixed_xyz(inertia.link_from_inertial.rotation.to_rotation_matrix().matrix());
    let angles = three(value(inertial, "origin", "rpy"), |numbers| half_places(Unit::Angle, numbers));
    let turns: Vec<Vector3<f64>> = axes.iter().zip(&angles).map(|(axis, half)| axis * *half).collect();
    InertiaRounding::of_written(inertia, mass, com, &moments, &turns)
}

/// What the digits of `<limit>` and `<dynamics>` leave open.
pub(super) fn of_joint(joint: Node<'_, '_>, kind: JointKind) -> JointValueRounding {
    let half = |part: &str, key: &str| half_places_of_values(&[value(joint, part, key)])[0];
    let limit = |key: &str| Some(half("limit", key));
    let unit = if kind.is_angular() { Unit::Angle } else { Unit::Length };
    let ends = ["lower", "upper"].map(|key| value(joint, "limit", key));
    let halves = half_places(unit, &ends.map(typed));
    // As 2.9 for 2.90, whatever the other end has.
    let [lower, upper] = [0, 1].map(|at| halves[at].max(half_places_of_values(&[ends[at]])[0]));
    let has_deceleration = !value(joint, "limit", "deceleration").is_empty();
    JointValueRounding {
        limit: JointLimit {
            lower,
            upper,
            velocity: limit("velocity"),
            effort: limit("effort"),
            acceleration: limit("acceleration"),
            // One that is not given is the acceleration.
            deceleration: limit(if has_deceleration { "deceleration" } else { "acceleration" }),
            jerk: limit("jerk"),
        },
        damping: half("dynamics", "damping"),
        friction: half("dynamics", "friction"),
        armature: 0.0,
    }
}

/// The text of an attribute of a part; empty if there is none.
fn value<'a>(owner: Node<'a, '_>, part: &str, attribute: &str) -> &'a str {
    element(owner, part).and_then(|of| of.attribute(attribute)).unwrap_or_default().trim()
}

/// The half places of three numbers by a rule; 0 for those that are missing.
fn three(text: &str, rule: impl Fn(&[TypedNumber<'_>]) -> Vec<f64>) -> Vector3<f64> {
    let numbers: Vec<TypedNumber<'_>> = text.split_whitespace().take(3).map(typed).collect();
    let halves = rule(&numbers);
    Vector3::from_fn(|at, _| halves.get(at).copied().unwrap_or_default())
}

fn typed(text: &str) -> TypedNumber<'_> {
    TypedNumber { text, units: UnitSystem::Si }
}

#[cfg(test)]
mod tests {
    use crate::parse_urdf;

    /// Half places by hand; the turn of a tensor by a small angle `t` about z changes `ixy` by `t (ixx - iyy)`.
    #[test]
    fn half_of_each_last_place_is_read() {
        let robot = parse_urdf(
            "<robot name='r'><link name='a'/><link name='b'><inertial><mass value='1.25'/>
             <origin xyz='0.1 0.0625 0' rpy='0 0 1.571'/>
             <inertia ixx='0.0345' iyy='0.0145' izz='0.03' ixy='0' ixz='0' iyz='0'/></inertial></link>
             <joint name='j' type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>
             <limit lower='-1.5708' upper='2.9' effort='35' velocity='3.14159'/><dynamics damping='0.05'/></joint></robot>",
        )
        .unwrap();
        let link = &robot.link(robot.find_link("b").unwrap()).inertia_rounding;
        assert_eq!((link.mass_kg, link.com_m), (5e-3, [5e-4, 5e-5, 5e-5].into()));
        let tensor = &link.tensor_kg_m2;
        assert!((tensor[(0, 1)] - (5e-5 + 5e-4 * 0.02)).abs() < 1e-7, "{tensor}");
        assert!((tensor[(2, 2)] - 5e-5).abs() < 1e-12, "{tensor}");
        let of_joint = &robot.joints()[0].value_rounding;
        assert!((of_joint.limit.lower - 5e-5).abs() + (of_joint.limit.upper - 5e-3).abs() < 1e-12);
        assert_eq!((of_joint.limit.effort, of_joint.limit.velocity), (Some(5e-2), Some(5e-6)));
        assert_eq!((of_joint.damping, of_joint.friction), (5e-5, 0.0));
    }
}
