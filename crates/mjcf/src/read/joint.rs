//! Joints: their axes in the body, ranges and terms, and which combinations a body may have.

use nalgebra::{Point3, Unit, Vector3};

use congruent_input::Capability;

use super::{
    attributes::MjAttributes,
    names::MjNamed,
    reader::{MjContext, MjReader},
};
use crate::{
    codes,
    defaults::MjClass,
    document::MjElement,
    model::{MjEffort, MjJoint, MjJointKind, MjName, MjWritten},
};

/// Shorter axes have no direction. Source: MuJoCo 4.0 refuses 1e-12 and takes 1e-6.
const SHORTEST_AXIS: f64 = 1e-10;
/// Most degrees of freedom of a body.
const MOST_FREEDOM: usize = 6;
/// A free joint by its own element takes no defaults.
static NO_DEFAULTS: MjClass = MjClass::none();

impl<'s> MjReader<'s, '_> {
    pub(super) fn joint(&mut self, element: &'s MjElement, context: &MjContext<'s>, body: usize) {
        let is_free_joint = element.tag == "freejoint";
        let class = if is_free_joint { &NO_DEFAULTS } else { self.class(element, context) };
        let attributes = MjAttributes::with_class(element, class);
        let kind = if is_free_joint { MjJointKind::Free } else { kind(&attributes) };
        let settings = &self.scope(context.attachment).settings;
        // Positions of a slide are lengths, whatever the unit of angles.
        let is_angle = matches!(kind, MjJointKind::Hinge | MjJointKind::Ball);
        let position = |written: f64| if is_angle { settings.angle(written) } else { written };
        let index = self.model.joints.len();
        let name = self.named(MjNamed::Joint, element, context, index);
        let number = index - self.model.bodies[body].joints.start + 1;
        let owner = &self.model.bodies[body].name;
        let name = MjName {
            is_written: name.is_some(),
            text: name.unwrap_or_else(|| format!("joint {number} of {owner}")),
        };
        let limits = MjLimits { attributes, name: &name.text, has_auto: settings.has_auto_limits };
        let range = if kind == MjJointKind::Free {
            None
        } else {
            self.limited(&limits, "range", "limited").map(|range| range.map(|range| range.map(position)))
        };
        let actuator_force_range = if matches!(kind, MjJointKind::Hinge | MjJointKind::Slide) {
            self.limited(&limits, "actuatorfrcrange", "actuatorfrclimited")
        } else {
            None
        };
        if let Some(range) = range.as_ref().filter(|range| kind == MjJointKind::Ball && range.value[0] != 0.0)
        {
            let message = format!("joint \"{name}\": range of a ball joint must begin with 0");
            let place = range.place.as_ref();
            let fault = place.map_or_else(
                || element.fault(codes::mjcf::RANGE, &message),
                |place| place.fault(codes::mjcf::RANGE, &message),
            );
            self.diagnostics.push(fault);
        }
        let armature = self.armature(element, &attributes, &name.text);
        self.springdamper(&attributes, &name.text);
        let axis_in_body = self.axis(&attributes, kind, &name.text, context);
        let frame = context.body_from_frame;
        self.model.joints.push(MjJoint {
            pos_in_body: attributes.array("pos", [0.0; 3]).map(|pos| frame * Point3::from(pos)),
            axis_in_body,
            range,
            reference: attributes.number("ref", 0.0).map(position),
            damping: attributes.array("damping", [0.0; 3]),
            friction_loss: attributes.number("frictionloss", 0.0),
            armature,
            stiffness: attributes.array("stiffness", [0.0; 3]),
            spring_reference: attributes.number("springref", 0.0).map(position),
            actuator_force_range,
            effort: MjEffort::Unactuated,
            notation: self.notation(context),
            place: element.place(),
            name,
            body,
            kind,
        });
    }

    /// The inertia of the rotor; with one below 0 a joint may have no inertia.
    fn armature(
        &mut self,
        element: &'s MjElement,
        attributes: &MjAttributes<'_>,
        name: &str,
    ) -> MjWritten<f64> {
        let armature = attributes.number("armature", 0.0);
        if armature.value < 0.0 {
            let message = format!("joint \"{name}\": armature {} is negative", armature.value);
            let found = element.fault_at("armature", codes::mjcf::JOINT, message);
            self.diagnostics.push(found.needed_by(Some(Capability::Physics)));
        }
        armature
    }

    fn axis(
        &mut self,
        attributes: &MjAttributes<'_>,
        kind: MjJointKind,
        name: &str,
        context: &MjContext<'s>,
    ) -> MjWritten<Unit<Vector3<f64>>> {
        let written = attributes.array("axis", [0.0, 0.0, 1.0]).map(Vector3::from);
        let frame = context.body_from_frame;
        let unit = Unit::try_new(written.value, SHORTEST_AXIS);
        if unit.is_none() && matches!(kind, MjJointKind::Hinge | MjJointKind::Slide) {
            let message = format!("joint \"{name}\": the axis has the length 0");
            let found = attributes.find("axis");
            let fault = found.map_or_else(
                || attributes.element.fault(codes::mjcf::AXIS, &message),
                |found| found.attribute.fault(codes::mjcf::AXIS, &message),
            );
            self.diagnostics.push(fault.with_help("axis=\"0 0 1\" is the z axis of the body"));
        }
        written.map(|_| Unit::new_unchecked(frame.rotation * unit.unwrap_or(Vector3::z_axis()).into_inner()))
    }

    /// A spring by time constant and damping ratio needs the inertia of all that the joint carries.
    fn springdamper(&mut self, attributes: &MjAttributes<'_>, name: &str) {
        let Some(found) = attributes.find("springdamper") else { return };
        if found.array([0.0; 2]).value.iter().all(|number| *number > 0.0) {
            let message = format!(
                "joint \"{name}\": springdamper is not read, so its stiffness and damping are not known"
            );
            let warning = found.place().warning(codes::mjcf::UNSUPPORTED, message);
            let warning = warning.needed_by(Some(Capability::Physics));
            self.diagnostics.push(warning.with_help("write stiffness and damping"));
        }
    }

    /// A range that holds: by its keyword, or with autolimits by its presence.
    pub(super) fn limited(
        &mut self,
        limits: &MjLimits<'_>,
        key: &str,
        keyword: &str,
    ) -> Option<MjWritten<[f64; 2]>> {
        let MjLimits { attributes, name, has_auto } = limits;
        let owner = || format!("{} \"{name}\"", attributes.element.tag);
        let found = attributes.find(key);
        let written = found.map(|found| found.array([0.0; 2]));
        let is_in_order = written.as_ref().is_some_and(|range| range.value[0] < range.value[1]);
        match (attributes.text(keyword), found) {
            (Some("true"), _) if is_in_order => written,
            (Some("true"), found) => {
                let message = match &written {
                    Some(MjWritten { value: [low, high], .. }) => {
                        format!("{}: {key} is {low} to {high}, the first must be below the second", owner())
                    }
                    None => format!("{}: {keyword} is \"true\" without {key}", owner()),
                };
                let at = found.or(attributes.find(keyword));
                let fault = at.map_or_else(
                    || attributes.element.fault(codes::mjcf::RANGE, &message),
                    |found| found.attribute.fault(codes::mjcf::RANGE, &message),
                );
                self.diagnostics.push(fault);
                None
            }
            (Some("false"), _) | (_, None) => None,
            (_, Some(found)) if !has_auto => {
                // 0 0 is MuJoCo's own default, which it cannot distinguish from one that is written.
                if found.array([0.0; 2]).value.iter().any(|limit| *limit != 0.0) {
                    let message =
                        format!("{} has {key} without {keyword}, and autolimits is \"false\"", owner());
                    let help = format!("write {keyword}=\"true\" or \"false\", or remove autolimits");
                    self.diagnostics.push(found.attribute.fault(codes::mjcf::RANGE, message).with_help(help));
                }
                None
            }
            (_, Some(found)) if !is_in_order => {
                let [low, high] = found.array([0.0; 2]).value;
                let message = format!("{}: {key} is {low} to {high}, so MuJoCo ignores it", owner());
                let help = "the first number is below the second in a range that limits";
                self.diagnostics.push(found.place().warning(codes::mjcf::RANGE, message).with_help(help));
                None
            }
            _ => written,
        }
    }

    /// Refuses combinations of joints that MuJoCo refuses.
    pub(super) fn check_joints(&mut self, body: usize) {
        let owner = &self.model.bodies[body];
        let joints = self.model.joints_of(body);
        let fault = |joint: &MjJoint, what: &str| {
            let message = format!("body \"{}\": {what}", owner.name);
            joint.place.fault(codes::mjcf::JOINT, message)
        };
        let mut found = Vec::new();
        let freedom: usize = joints.iter().map(|joint| joint.kind.degrees_of_freedom()).sum();
        let free = joints.iter().find(|joint| joint.kind == MjJointKind::Free);
        let ball = joints.iter().position(|joint| joint.kind == MjJointKind::Ball);
        if let Some(free) = free.filter(|_| joints.len() > 1) {
            found.push(
                fault(free, "a free joint is beside other joints").with_help("keep the free joint alone"),
            );
        } else if let Some(free) = free.filter(|_| owner.parent != Some(0)) {
            let help = "only children of the world move freely; use other joints";
            found.push(fault(free, "a free joint is below another body").with_help(help));
        } else if let Some(last) = joints.last().filter(|_| freedom > MOST_FREEDOM) {
            found.push(fault(
                last,
                &format!("its joints have {freedom} degrees of freedom, limit <= {MOST_FREEDOM}"),
            ));
        } else if let Some(ball) = ball {
            let turns = |joint: &&MjJoint| matches!(joint.kind, MjJointKind::Ball | MjJointKind::Hinge);
            if let Some(second) = joints[ball + 1..].iter().find(turns) {
                found.push(fault(second, "a ball joint is followed by a joint that turns"));
            }
        }
        self.diagnostics.extend(found);
    }
}

fn kind(attributes: &MjAttributes<'_>) -> MjJointKind {
    match attributes.text("type") {
        Some("free") => MjJointKind::Free,
        Some("ball") => MjJointKind::Ball,
        Some("slide") => MjJointKind::Slide,
        _ => MjJointKind::Hinge,
    }
}

/// An element with ranges.
pub(super) struct MjLimits<'a> {
    pub(super) attributes: MjAttributes<'a>,
    pub(super) name: &'a str,
    /// Whether a range holds by its presence.
    pub(super) has_auto: bool,
}
