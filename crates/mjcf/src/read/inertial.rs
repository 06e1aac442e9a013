//! Mass and inertia that a body states, and which of them no body has.

use congruent_input::Diagnostic;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use super::{
    attributes::MjAttributes,
    orientation::MjWrittenPose,
    reader::{MjContext, MjReader},
};
use crate::{
    codes,
    document::MjElement,
    grammar::ORIENTATIONS,
    inertia::{is_possible, moments},
    model::{MjBody, MjInertial, MjWritten},
};

impl<'s> MjReader<'s, '_> {
    pub(super) fn inertial(&mut self, element: &'s MjElement, context: &MjContext<'s>, body: usize) {
        if self.model.bodies[body].inertial.is_some() {
            let message = format!("body \"{}\" has a second <inertial>", self.model.bodies[body].name);
            self.diagnostics.push(element.fault(codes::mjcf::REPEATED_ELEMENT, message));
            return;
        }
        let settings = &self.scope(context.attachment).settings;
        let attributes = MjAttributes::own(element);
        let mut pose = MjWrittenPose::read(&attributes, settings, self.diagnostics);
        let inertia = inertia(&attributes);
        self.check_inertial(&attributes, body, &inertia.value);
        if attributes.find("fullinertia").is_some() {
            // Its axes are those of the frame in which it is written.
            pose.orientation = MjWritten::unwritten(UnitQuaternion::identity());
        }
        let inertial = MjInertial {
            mass: attributes.number("mass", 0.0),
            body_from_inertial: context.body_from_frame * pose.isometry(),
            pos: pose.pos,
            orientation: pose.orientation,
            inertia,
            notation: self.notation(context),
            place: element.place(),
        };
        self.model.bodies[body].inertial = Some(inertial);
    }

    fn check_inertial(&mut self, attributes: &MjAttributes<'_>, body: usize, inertia: &Matrix3<f64>) {
        let rules = self.model.bodies[body].inertia_rules;
        let owner = format!("body \"{}\"", self.model.bodies[body].name);
        let (diagonal, full) = (attributes.find("diaginertia"), attributes.find("fullinertia"));
        let Some(given) = full.or(diagonal) else { return };
        let fault = |message: String| given.attribute.fault(codes::mjcf::INERTIAL, message);
        if full.is_some() && diagonal.is_some() {
            let message = format!("{owner} gives its inertia twice: diaginertia and fullinertia");
            self.diagnostics.push(fault(message).with_help("keep one of them"));
            return;
        }
        let turned = ORIENTATIONS.into_iter().find(|key| attributes.find(key).is_some());
        if let Some(key) = turned.filter(|_| full.is_some()) {
            let message = format!("{owner} has fullinertia beside {key}: its axes are those of the body");
            let help = format!("remove {key}, or write diaginertia, the moments about the axes of {key}");
            self.diagnostics.push(fault(message).with_help(help));
            return;
        }
        let found = moments(inertia);
        let least = found.min();
        if full.is_some() && least <= 0.0 && rules.least_moment_kg_m2 <= 0.0 {
            let message =
                format!("{owner}: fullinertia has the principal moment {least:.3e} kg m^2, limit > 0");
            let help = "the order is ixx iyy izz ixy ixz iyz, another one than in a URDF";
            self.diagnostics.push(fault(message).with_help(help));
            return;
        }
        let bounded = found.map(|moment| moment.max(rules.least_moment_kg_m2));
        // The moments of fullinertia come from an iteration, whose rounding must not refuse a flat body.
        let slack = if full.is_some() { ROUNDING_OF_MOMENTS * bounded.max() } else { 0.0 };
        if !rules.is_balanced && !is_possible(&bounded, slack) {
            let message = format!("{owner}: {}", impossible(&bounded));
            let help = "balanceinertia=\"true\" of <compiler> replaces all three by their mean, or correct the values";
            self.diagnostics.push(fault(message).with_help(help));
        }
    }
}

/// Relative. Kind: rounding of the principal moments of a symmetric matrix of three rows, some eps.
const ROUNDING_OF_MOMENTS: f64 = 1e-14;

/// Which moment exceeds the sum of the others.
fn impossible(moments: &Vector3<f64>) -> String {
    let (index, largest) = moments.argmax();
    let others = moments.sum() - moments[index];
    format!("the moment {largest} kg m^2 exceeds the sum of the other two, {others} kg m^2")
}

fn inertia(attributes: &MjAttributes<'_>) -> MjWritten<Matrix3<f64>> {
    if let Some(full) = attributes.find("fullinertia") {
        return full
            .array([0.0; 6])
            .map(|[xx, yy, zz, xy, xz, yz]| Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz));
    }
    attributes.array("diaginertia", [0.0; 3]).map(|moments| Matrix3::from_diagonal(&Vector3::from(moments)))
}

/// The error of a body that moves without mass.
pub(super) fn massless(body: &MjBody) -> Diagnostic {
    let message = format!(
        "body \"{}\" moves, but neither it nor a body that is fixed to it has mass and inertia",
        body.name
    );
    let place = body.inertial.as_ref().map_or(&body.place, |inertial| &inertial.place);
    place.fault(codes::mjcf::MASSLESS, message).with_help(
        "give it an <inertial> with mass and diaginertia, or a geom with a density in a group of inertiagrouprange",
    )
}
