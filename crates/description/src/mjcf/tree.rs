//! Bodies to links, with the links that are needed between them.
//!
//! A joint of MuJoCo turns its body about an axis that may be beside the body's origin, and several joints may act on one body in
//! turn. In a [`Robot`](crate::Robot) the origin of a link is on the axis of its one joint, so such a body gets massless links
//! before it. At position `ref` a body is where the file puts it.

use congruent_input::{Capability, Diagnostic, Diagnostics, units::LARGEST};
use congruent_mjcf::{MjBody, MjJoint, MjJointKind, MjModel, codes::mjcf::NUMBER};
use congruent_robot::{JointKind, JointParts, JointRounding, Link};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::{joint, names::TakenNames, placed::placed, rounding::ModelRounding};
use crate::codes;

/// Links and joints so far, in the order of bodies.
pub(super) struct RobotParts {
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<JointParts>,
    /// The name of the link of each body.
    pub(super) body_links: Vec<String>,
    /// Where the link of each body is in `links`.
    pub(super) body_positions: Vec<usize>,
    /// Where each joint of the model is in `joints`; `None` if it does not move here.
    pub(super) joint_positions: Vec<Option<usize>>,
    link_names: TakenNames,
    joint_names: TakenNames,
}

impl RobotParts {
    pub(super) fn from_model(model: &MjModel, diagnostics: &mut Diagnostics) -> Self {
        let mut link_names = TakenNames::of_file(model.bodies.iter().map(|body| &body.name));
        let body_links = model.bodies.iter().map(|body| link_names.take(&body.name)).collect();
        let mut parts = Self {
            links: Vec::new(),
            joints: Vec::new(),
            body_links,
            body_positions: Vec::new(),
            joint_positions: vec![None; model.joints.len()],
            link_names,
            joint_names: TakenNames::of_file(model.joints.iter().map(|joint| &joint.name)),
        };
        let moving_below = moving_below(model);
        let roundings = ModelRounding::new(model);
        for (index, body) in model.bodies.iter().enumerate() {
            refuse_far(body, model.joints_of(index), diagnostics);
            cut_joints(model, index, &moving_below, diagnostics);
            parts.add_body(model, index, &roundings);
        }
        parts
    }

    /// The links and joints of one body.
    fn add_body(&mut self, model: &MjModel, index: usize, roundings: &ModelRounding) {
        let body = &model.bodies[index];
        let link = self.body_links[index].clone();
        let Some(parent) = body.parent else { return self.push_body(link) };
        let moving: Vec<usize> =
            body.joints.clone().filter(|&joint| moves(model.joints[joint].kind)).collect();
        let mut before = self.body_links[parent].clone();
        let mut before_from_body = body.parent_from_body;
        for (at, &number) in moving.iter().enumerate() {
            let of = &model.joints[number];
            let axis_from_body = Translation3::from(-point_of_axis(of));
            let is_beside = axis_from_body.vector != Vector3::zeros();
            let child = match moving.get(at + 1) {
                Some(&next) => self.link_names.make(format!("{link} (before {})", model.joints[next].name)),
                None if is_beside => self.link_names.make(format!("{link} (axis of {})", of.name)),
                None => link.clone(),
            };
            let parent_from_joint = before_from_body * axis_from_body.inverse() * from_zero(of);
            let name = self.joint_names.take(&of.name);
            let mut frame = JointParts::new(&name, JointKind::Fixed, &before, &child, parent_from_joint);
            frame.joint.rounding = JointRounding {
                origin: if at == 0 { roundings.of_body(body, index) } else { Vec::new() },
                axis: roundings.of_joint(of, number, &before_from_body),
                ..JointRounding::default()
            };
            self.joint_positions[number] = Some(self.joints.len());
            self.joints.push(joint::with_values(frame, model, number));
            if child != link {
                self.links.push(Link { name: child.clone(), ..Link::default() });
            }
            before = child;
            before_from_body = axis_from_body.into();
        }
        if before != link {
            let origin = if moving.is_empty() { roundings.of_body(body, index) } else { Vec::new() };
            let fixed = self.push_fixed(&before, &link, before_from_body);
            fixed.joint.rounding.origin = origin;
        }
        self.push_body(link);
    }

    fn push_body(&mut self, name: String) {
        self.body_positions.push(self.links.len());
        self.links.push(Link { name, ..Link::default() });
    }

    /// A frame that is fixed to a link, under a name that is free.
    pub(super) fn push_frame(&mut self, parent: &str, wanted: &str, parent_from_frame: Isometry3<f64>) {
        let prefix = if self.link_names.has(wanted) { "site:" } else { "" };
        let name = self.link_names.make(format!("{prefix}{wanted}"));
        self.push_fixed(parent, &name, parent_from_frame);
        self.links.push(Link { name, ..Link::default() });
    }

    fn push_fixed(
        &mut self,
        parent: &str,
        child: &str,
        parent_from_child: Isometry3<f64>,
    ) -> &mut JointParts {
        let name = self.joint_names.make(format!("{child} (fixed)"));
        self.joints.push(JointParts::new(&name, JointKind::Fixed, parent, child, parent_from_child));
        self.joints.last_mut().expect("it was pushed")
    }

    /// The link of a body.
    pub(super) fn link_of_body(&mut self, body: usize) -> &mut Link {
        &mut self.links[self.body_positions[body]]
    }
}

fn moves(kind: MjJointKind) -> bool {
    matches!(kind, MjJointKind::Hinge | MjJointKind::Slide)
}

/// A point of the axis in the body; a slide has none of its own.
pub(super) fn point_of_axis(joint: &MjJoint) -> Vector3<f64> {
    match joint.kind {
        MjJointKind::Hinge => joint.pos_in_body.value.coords,
        _ => Vector3::zeros(),
    }
}

/// The motion from position 0 to the written pose, backwards: with it before the joint, the body is as written at `ref`.
fn from_zero(joint: &MjJoint) -> Isometry3<f64> {
    let (axis, reference) = (joint.axis_in_body.value, joint.reference.value);
    match joint.kind {
        // Not even a rounding of the pose where there is no `ref`.
        _ if reference == 0.0 => Isometry3::identity(),
        MjJointKind::Slide => Translation3::from(axis.into_inner() * -reference).into(),
        _ => Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_axis_angle(&axis, -reference),
        ),
    }
}

/// For each body whether a body below it moves against it.
fn moving_below(model: &MjModel) -> Vec<bool> {
    let mut is_moving = vec![false; model.bodies.len()];
    // Parents are before their children, so from the end each body is complete when its parent takes it over.
    for index in (1..model.bodies.len()).rev() {
        let own = model.joints_of(index).iter().any(|joint| moves(joint.kind));
        if let Some(parent) = model.bodies[index].parent {
            is_moving[parent] |= own || is_moving[index];
        }
    }
    is_moving
}

/// Free and ball joints, which a robot does not have: the body is fixed where the file puts it, if nothing depends on it.
fn cut_joints(model: &MjModel, index: usize, is_moving_below: &[bool], diagnostics: &mut Diagnostics) {
    for (at, joint) in model.joints_of(index).iter().enumerate() {
        let (name, body) = (&joint.name, &model.bodies[index].name);
        let found = match joint.kind {
            MjJointKind::Hinge | MjJointKind::Slide => continue,
            MjJointKind::Free => {
                let message =
                    format!("body \"{body}\" is free; it is fixed here at the pose that the file gives it");
                Diagnostic::warning(codes::mjcf::FREE, message).one_of(
                    "bodies are free; they are fixed here at the poses that the file gives them",
                    &body.text,
                )
            }
            MjJointKind::Ball
                if is_moving_below[index]
                    || model.joints_of(index)[at + 1..].iter().any(|of| moves(of.kind)) =>
            {
                let message = format!(
                    "joint \"{name}\" of body \"{body}\" is a ball joint, and joints that move follow it"
                );
                let help = "replace it by three hinges in the same body";
                Diagnostic::error(codes::mjcf::BALL, message).with_help(help)
            }
            MjJointKind::Ball => {
                let message =
                    format!("joint \"{name}\" of body \"{body}\" is a ball joint; the body is fixed here");
                Diagnostic::warning(codes::mjcf::BALL, message)
                    .one_of("joints are ball joints; their bodies are fixed here", &name.text)
                    .needed_by(Some(Capability::Physics))
                    .with_help("replace it by three hinges in the same body")
            }
        };
        diagnostics.push(placed(found, &joint.place));
    }
}

/// Refuses positions of which poses would lose their digits, or overflow.
fn refuse_far(body: &MjBody, joints: &[MjJoint], diagnostics: &mut Diagnostics) {
    let own = body.parent_from_body.translation.vector.amax();
    let of_joint = |joint: &MjJoint| {
        let slide = if joint.kind == MjJointKind::Slide { joint.reference.value.abs() } else { 0.0 };
        joint.pos_in_body.value.coords.amax().max(slide)
    };
    let far = [("body", &body.name, own, &body.place)]
        .into_iter()
        .chain(joints.iter().map(|joint| ("joint", &joint.name, of_joint(joint), &joint.place)))
        .filter(|(_, _, far_m, _)| far_m.is_nan() || *far_m > LARGEST);
    for (what, name, far_m, place) in far {
        let message = format!("{what} \"{name}\" is {far_m:e} m away, limit <= {LARGEST:e} m");
        diagnostics.push(placed(Diagnostic::error(NUMBER, message), place));
    }
}
