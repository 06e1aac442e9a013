//! What the digits of a model leave open: small motions in the parent links of joints, and the most that other values are off.

use congruent_mjcf::{
    MjBody, MjBodyRounding, MjInertial, MjJoint, MjJointKind, MjJointRounding, MjModel, MjValueRounding,
};
use congruent_robot::{Inertia, InertiaRounding, JointLimit, JointValueRounding, SmallMotion};
use nalgebra::{Isometry3, Vector3};

/// Half of the last place of all numbers that place the bodies and joints of a model.
pub(super) struct ModelRounding {
    bodies: Vec<MjBodyRounding>,
    /// For each frame the motions of what is in it, in the body around it, with those of the frames around it.
    frames: Vec<Vec<SmallMotion>>,
    joints: Vec<MjJointRounding>,
}

impl ModelRounding {
    pub(super) fn new(model: &MjModel) -> Self {
        let mut frames: Vec<Vec<SmallMotion>> = Vec::new();
        for (frame, rounding) in model.frames.iter().zip(model.frame_roundings()) {
            let around = &frame.notation.body_from_frame;
            let own = motions(&rounding, &frame.pos.value).map(|motion| motion.expressed_in(around));
            let outer = frame.outer.map_or_else(Vec::new, |outer| frames[outer].clone());
            frames.push(own.chain(outer).collect());
        }
        Self { bodies: model.body_roundings(), frames, joints: model.joint_roundings() }
    }

    /// The motions of a body in its parent.
    pub(super) fn of_body(&self, body: &MjBody, index: usize) -> Vec<SmallMotion> {
        let own = motions(&self.bodies[index], &body.pos.value);
        let own = own.map(|motion| motion.expressed_in(&body.notation.body_from_frame));
        let of_frames = body.frame.into_iter().flat_map(|frame| &self.frames[frame]);
        own.chain(of_frames.copied()).collect()
    }

    /// The motions of the axis of a joint in the link before it.
    pub(super) fn of_joint(
        &self,
        joint: &MjJoint,
        index: usize,
        before_from_body: &Isometry3<f64>,
    ) -> Vec<SmallMotion> {
        let MjJointRounding { pos_m, axis } = &self.joints[index];
        let frame = &joint.notation.body_from_frame;
        let axis_in_frame = frame.rotation.inverse() * joint.axis_in_body.value;
        let point = joint.pos_in_body.value.coords;
        let open = axis.iter().enumerate().filter(|(_, half)| **half > 0.0);
        let tilts = open.map(|(at, half)| {
            let tilt = axis_in_frame.cross(&Vector3::ith(at, *half));
            SmallMotion::turn(frame.rotation * tilt, &point)
        });
        let is_point = joint.kind == MjJointKind::Hinge;
        let moved = shifts(pos_m).filter(|_| is_point).map(|shift| shift.expressed_in(frame));
        moved.chain(tilts).map(|motion| motion.expressed_in(before_from_body)).collect()
    }
}

/// What the digits of an `<inertial>` leave open in the inertia that a link has from it.
pub(super) fn of_inertial(inertial: &MjInertial) -> InertiaRounding {
    let written = Inertia {
        mass_kg: inertial.mass.value,
        link_from_inertial: inertial.body_from_inertial,
        tensor_kg_m2: inertial.inertia.value,
    };
    let of = inertial.rounding();
    let body_from_frame = inertial.notation.body_from_frame.rotation;
    let com_m = body_from_frame.to_rotation_matrix().matrix().abs() * of.pos_m;
    let turns: Vec<Vector3<f64>> = of.turns_rad.iter().map(|turn| body_from_frame * turn).collect();
    InertiaRounding::of_written(&written, of.mass_kg, com_m, &of.inertia_kg_m2, &turns)
}

/// What the digits of limits and losses leave open.
pub(super) fn of_values(joint: &MjJoint) -> JointValueRounding {
    let MjValueRounding { range: [lower, upper], effort, terms: [damping, friction, armature] } =
        joint.value_rounding();
    let limit = JointLimit { lower, upper, effort: Some(effort), ..JointLimit::default() };
    JointValueRounding { limit, damping, friction, armature }
}

/// The motions of a pose whose origin is at `pos`.
fn motions(rounding: &MjBodyRounding, pos: &Vector3<f64>) -> impl Iterator<Item = SmallMotion> {
    let turns = rounding.turns_rad.iter().map(|turn| SmallMotion::turn(*turn, pos));
    shifts(&rounding.pos_m).chain(turns)
}

fn shifts(pos_m: &[f64; 3]) -> impl Iterator<Item = SmallMotion> {
    let open = pos_m.iter().enumerate().filter(|(_, half)| **half > 0.0);
    open.map(|(at, half)| SmallMotion::shift(Vector3::ith(at, *half)))
}
