//! The tree of bodies: frames are composed into what they contain, replicas are made.

use congruent_input::Capability;
use nalgebra::{Isometry3, Translation3, Vector3};

use super::{
    attributes::MjAttributes,
    names::MjNamed,
    orientation::{MjWrittenPose, from_euler},
    reader::{MjContext, MjReader},
    scope::MjScope,
};
use crate::{
    codes,
    document::MjElement,
    model::{MjBody, MjFrame, MjName},
};

/// A body that is read after the other contents of its parent, so that the parts of each body are together.
pub(super) struct MjPending<'s> {
    pub(super) element: &'s MjElement,
    pub(super) context: MjContext<'s>,
}

impl<'s> MjReader<'s, '_> {
    /// The world and all below it.
    pub(super) fn world(&mut self, scope: &'s MjScope) -> Option<()> {
        let context = MjContext {
            attachment: 0,
            replica: String::new(),
            class: None,
            body_from_frame: Isometry3::identity(),
            frame: None,
            depth: 0,
        };
        let mut bodies = Vec::new();
        for section in scope.root.all("worldbody") {
            self.contents(section, &context, 0, &mut bodies)?;
        }
        self.close(0);
        self.bodies(bodies, 0)
    }

    /// Reads what is directly in a body or a frame of it, and gathers the bodies.
    pub(super) fn contents(
        &mut self,
        parent: &'s MjElement,
        context: &MjContext<'s>,
        body: usize,
        bodies: &mut Vec<MjPending<'s>>,
    ) -> Option<()> {
        self.check_depth(context.depth, parent)?;
        for element in &parent.children {
            self.count(element)?;
            match element.tag.as_str() {
                "joint" | "freejoint" | "inertial" if body == 0 => {
                    let message = format!("<{}> is in the world, which does not move", element.tag);
                    let fault = element.fault(codes::mjcf::PLACEMENT, message);
                    self.diagnostics.push(fault.with_help("put it into a <body>"));
                }
                "joint" | "freejoint" => self.joint(element, context, body),
                "inertial" => self.inertial(element, context, body),
                "geom" => self.geom(element, context, body),
                "site" => self.site(element, context, body),
                "body" => bodies.push(MjPending { element, context: context.clone() }),
                "frame" => self.frame(element, context, body, bodies)?,
                "replicate" => self.replicate(element, context, body, bodies)?,
                "attach" => self.attached(element, context, body, bodies)?,
                "plugin" | "flexcomp" => self.unread(element),
                // Cameras and lights have no part in the motion.
                _ => {}
            }
        }
        Some(())
    }

    /// Reads bodies whose parent is complete.
    fn bodies(&mut self, bodies: Vec<MjPending<'s>>, parent: usize) -> Option<()> {
        for (number, pending) in bodies.into_iter().enumerate() {
            self.body(&pending, parent, number + 1)?;
        }
        Some(())
    }

    fn body(&mut self, pending: &MjPending<'s>, parent: usize, number: usize) -> Option<()> {
        let MjPending { element, context } = pending;
        let settings = &self.scope(context.attachment).settings;
        let attributes = MjAttributes::own(element);
        let pose = MjWrittenPose::read(&attributes, settings, self.diagnostics);
        let index = self.model.bodies.len();
        let name = self.named(MjNamed::Body, element, context, index);
        self.check_childclass(element, context.attachment);
        let is_mocap = attributes.is_true("mocap");
        let parent_name = &self.model.bodies[parent].name;
        self.model.bodies.push(MjBody {
            name: MjName {
                is_written: name.is_some(),
                text: name.unwrap_or_else(|| format!("body {number} of {parent_name}")),
            },
            parent: Some(parent),
            parent_from_body: context.body_from_frame * pose.isometry(),
            pos: pose.pos,
            orientation: pose.orientation,
            notation: self.notation(context),
            frame: context.frame,
            joints: self.model.joints.len()..self.model.joints.len(),
            geoms: self.model.geoms.len()..self.model.geoms.len(),
            sites: self.model.sites.len()..self.model.sites.len(),
            inertial: None,
            inertia_rules: settings.inertia,
            gravcomp: attributes.number("gravcomp", 0.0),
            is_mocap,
            place: element.place(),
        });
        let inside = MjContext {
            body_from_frame: Isometry3::identity(),
            frame: None,
            depth: context.depth + 1,
            ..context.with_class_of(element)
        };
        let mut bodies = Vec::new();
        self.contents(element, &inside, index, &mut bodies)?;
        self.close(index);
        self.check_joints(index);
        if is_mocap && (parent != 0 || !self.model.joints_of(index).is_empty()) {
            let message = format!(
                "{} is a mocap body, so it must be a child of the world without joints",
                element.label()
            );
            self.diagnostics.push(element.fault_at("mocap", codes::mjcf::JOINT, message));
        }
        self.bodies(bodies, index)
    }

    /// Notes where the parts of a body end.
    fn close(&mut self, body: usize) {
        let model = &mut self.model;
        let found = &mut model.bodies[body];
        found.joints.end = model.joints.len();
        found.geoms.end = model.geoms.len();
        found.sites.end = model.sites.len();
    }

    pub(super) fn frame(
        &mut self,
        element: &'s MjElement,
        context: &MjContext<'s>,
        body: usize,
        bodies: &mut Vec<MjPending<'s>>,
    ) -> Option<()> {
        if let Some(key) =
            ["scale", "massscale", "scaling"].into_iter().find(|key| element.text(key).is_some())
        {
            let message = format!("{} scales what is in it, which is not read", element.label());
            let fault = element.fault_at(key, codes::mjcf::UNSUPPORTED, message);
            self.diagnostics.push(fault.with_help("write the scaled values out"));
        }
        let settings = &self.scope(context.attachment).settings;
        let pose = MjWrittenPose::read(&MjAttributes::own(element), settings, self.diagnostics);
        self.named(MjNamed::Frame, element, context, 0);
        self.check_childclass(element, context.attachment);
        let inside = MjContext {
            frame: Some(self.model.frames.len()),
            depth: context.depth + 1,
            ..context.with_class_of(element).moved(pose.isometry())
        };
        let MjWrittenPose { pos, orientation } = pose;
        let notation = self.notation(context);
        self.model.frames.push(MjFrame { outer: context.frame, pos, orientation, notation });
        self.contents(element, &inside, body, bodies)
    }

    /// The copies: each is moved from the one before by offset and angles.
    fn replicate(
        &mut self,
        element: &'s MjElement,
        context: &MjContext<'s>,
        body: usize,
        bodies: &mut Vec<MjPending<'s>>,
    ) -> Option<()> {
        let attributes = MjAttributes::own(element);
        let settings = &self.scope(context.attachment).settings;
        let count = attributes.integer("count", 0);
        if count < 1 {
            let message = format!("<replicate> with the count {count} makes no copy");
            let found = element.warning(codes::mjcf::REPLICATE, message);
            self.diagnostics.push(found.with_help("count must be at least 1, or remove the element"));
            return Some(());
        }
        self.check_childclass(element, context.attachment);
        let angles = attributes.array("euler", [0.0; 3]).value.map(|angle| settings.angle(angle));
        let offset = Vector3::from(attributes.array("offset", [0.0; 3]).value);
        let step =
            Isometry3::from_parts(Translation3::from(offset), from_euler(angles, settings.euler_sequence));
        let (separator, digits) = (attributes.text("sep").unwrap_or_default(), count.to_string().len());
        let mut pose = Isometry3::identity();
        for number in 0..count {
            self.count(element)?;
            let copy = MjContext {
                replica: format!("{separator}{number:0digits$}{}", context.replica),
                depth: context.depth + 1,
                ..context.with_class_of(element).moved(pose)
            };
            self.contents(element, &copy, body, bodies)?;
            pose *= step;
        }
        Some(())
    }

    /// Reports a part that is not read and that moves or weighs something.
    pub(super) fn unread(&mut self, element: &MjElement) {
        let message = format!("{} is not read", element.label());
        let found = element.warning(codes::mjcf::UNSUPPORTED, message).needed_by(Some(Capability::Physics));
        self.diagnostics.push(found.one_of("elements are not read", element.label()));
    }
}
