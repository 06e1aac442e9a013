//! Actuators: their limits, and the effort that they have together at a joint.

use super::{
    attributes::MjAttributes,
    constraint::{MjInstance, MjReference},
    joint::MjLimits,
    names::MjNamed,
    reader::MjReader,
};
use crate::{
    codes,
    document::MjElement,
    model::{MjActuator, MjEffort, MjTarget, MjWritten},
};

/// What the values of an actuator are read from: the same for all its copies.
struct MjDrive {
    gear: MjWritten<f64>,
    force_range: Option<MjWritten<[f64; 2]>>,
    control_range: Option<MjWritten<[f64; 2]>>,
    gain: Option<f64>,
    armature: f64,
    damping: f64,
}

impl MjReader<'_, '_> {
    pub(super) fn actuators(&mut self, attachment: usize) -> Option<()> {
        for element in self.scope(attachment).root.in_sections("actuator") {
            let targets = [
                ("joint", MjNamed::Joint),
                ("jointinparent", MjNamed::Joint),
                ("tendon", MjNamed::Tendon),
                ("site", MjNamed::Site),
                ("slidersite", MjNamed::Site),
                ("cranksite", MjNamed::Site),
                ("body", MjNamed::Body),
            ];
            let Some((key, kind)) = targets.into_iter().find(|(key, _)| element.text(key).is_some()) else {
                let message = format!("actuator {} has no target", element.label());
                let fault = element.fault(codes::mjcf::ACTUATOR, message);
                self.diagnostics.push(fault.with_help("name a joint, tendon, site or body"));
                continue;
            };
            let reference = MjReference { element, key, kind };
            for instance in self.instances(attachment, element, &[reference]) {
                self.count(element)?;
                self.actuator(element, attachment, kind, &instance);
            }
        }
        Some(())
    }

    fn actuator(&mut self, element: &MjElement, attachment: usize, kind: MjNamed, instance: &MjInstance) {
        let index = instance.indices[0];
        let target = match kind {
            MjNamed::Joint => MjTarget::Joint(index),
            MjNamed::Tendon => MjTarget::Tendon(index),
            _ => MjTarget::Other,
        };
        let name = self.name_of(MjNamed::Actuator, element, attachment, &instance.replica);
        let mut drive = self.drive(element, attachment, &name);
        let attributes = self.attributes(element, attachment);
        self.inherit_range(&attributes, target, &mut drive.control_range);
        self.model.actuators.push(MjActuator {
            name,
            kind: element.tag.clone(),
            target,
            gear: drive.gear,
            force_range: drive.force_range,
            control_range: drive.control_range,
            gain: drive.gain,
            armature: drive.armature,
            damping: drive.damping,
            place: element.place(),
        });
    }

    fn drive(&mut self, element: &MjElement, attachment: usize, name: &str) -> MjDrive {
        let attributes = self.attributes(element, attachment);
        let has_auto = self.scope(attachment).settings.has_auto_limits;
        let limits = MjLimits { attributes, name, has_auto };
        let mut force_range = self.limited(&limits, "forcerange", "forcelimited");
        let control_range = self.limited(&limits, "ctrlrange", "ctrllimited");
        // A motor with a model of its current states the largest torque instead.
        if let Some(saturation) = attributes.find("saturation").filter(|_| element.tag == "dcmotor") {
            let largest = saturation.array([0.0; 3]).map(|[torque, ..]| [-torque, torque]);
            force_range = Some(largest).filter(|range| range.value[1] > 0.0);
        }
        let gear = attributes.array("gear", [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]).map(|[first, ..]| first);
        let reflected = gear.value * gear.value;
        let [damping, ..] = attributes.array("damping", [0.0; 3]).value;
        MjDrive {
            gain: self.gain(&attributes, attachment),
            armature: attributes.number("armature", 0.0).value * reflected,
            damping: damping * reflected,
            gear,
            force_range,
            control_range,
        }
    }

    /// Force per control of an actuator whose force is proportional to it.
    fn gain(&self, attributes: &MjAttributes<'_>, attachment: usize) -> Option<f64> {
        let element = attributes.element;
        match element.tag.as_str() {
            "motor" => Some(1.0),
            "general" => {
                let class = self.scope(attachment).classes.get(element.text("class"));
                let of_class = class.and_then(|class| class.actuator_kind());
                let is_plain = |key: &str, plain: &str| attributes.text(key).is_none_or(|word| word == plain);
                let is_proportional = matches!(of_class, None | Some("general" | "motor"))
                    && is_plain("gaintype", "fixed")
                    && is_plain("biastype", "none")
                    && is_plain("dyntype", "none");
                is_proportional.then(|| attributes.array("gainprm", [1.0]).value[0])
            }
            _ => None,
        }
    }

    /// `inheritrange`: the control of a position servo has the range of its joint, times this about its middle.
    fn inherit_range(
        &mut self,
        attributes: &MjAttributes<'_>,
        target: MjTarget,
        control_range: &mut Option<MjWritten<[f64; 2]>>,
    ) {
        let Some(found) = attributes.find("inheritrange").filter(|_| attributes.element.tag == "position")
        else {
            return;
        };
        let [share] = found.array([0.0]).value;
        let MjTarget::Joint(joint) = target else { return };
        if share <= 0.0 {
            return;
        }
        let joint = &self.model.joints[joint];
        let Some(range) = &joint.range else {
            let message = format!("inheritrange of an actuator whose joint \"{}\" has no range", joint.name);
            let fault = found.attribute.fault(codes::mjcf::ACTUATOR, message);
            self.diagnostics.push(fault.with_help("give the joint a range, or the actuator a ctrlrange"));
            return;
        };
        let [low, high] = range.value;
        let (middle, half) = (f64::midpoint(low, high), share * (high - low) / 2.0);
        *control_range =
            Some(MjWritten { value: [middle - half, middle + half], place: range.place.clone() });
    }

    /// What the actuators of each joint can do together.
    pub(super) fn sum_efforts(&mut self) {
        let mut efforts = vec![MjEffort::Unactuated; self.model.joints.len()];
        for actuator in &self.model.actuators {
            match actuator.target {
                MjTarget::Joint(joint) => efforts[joint] = added(efforts[joint].clone(), actuator),
                MjTarget::Tendon(tendon) => {
                    for &(joint, _) in &self.model.tendons[tendon].joints {
                        efforts[joint] = MjEffort::ThroughTendon;
                    }
                }
                MjTarget::Other => {}
            }
        }
        for (joint, effort) in self.model.joints.iter_mut().zip(efforts) {
            joint.effort = capped(effort, joint.actuator_force_range.as_ref());
        }
    }
}

/// The effort with that of another actuator.
fn added(effort: MjEffort, actuator: &MjActuator) -> MjEffort {
    let Some(own) = actuator.effort_range() else {
        return if effort == MjEffort::ThroughTendon { effort } else { MjEffort::Unlimited };
    };
    match effort {
        MjEffort::Unactuated => {
            MjEffort::Within { range: own.value, places: own.place.into_iter().collect() }
        }
        MjEffort::Within { range: [low, high], mut places } => {
            places.extend(own.place);
            MjEffort::Within { range: [low + own.value[0], high + own.value[1]], places }
        }
        other => other,
    }
}

/// The effort within the limits of the joint itself, which hold for every actuator, also through a tendon.
fn capped(effort: MjEffort, limits: Option<&MjWritten<[f64; 2]>>) -> MjEffort {
    let Some(MjWritten { value: [low, high], place }) = limits else { return effort };
    match effort {
        MjEffort::Within { range, mut places } => {
            if range[0] < *low || range[1] > *high {
                places.extend(place.clone());
            }
            MjEffort::Within { range: [range[0].clamp(*low, *high), range[1].clamp(*low, *high)], places }
        }
        // Without an actuator it is the limit of any that is added: so MuJoCo saves the effort of a URDF.
        MjEffort::Unactuated | MjEffort::Unlimited | MjEffort::ThroughTendon => {
            MjEffort::Within { range: [*low, *high], places: place.iter().cloned().collect() }
        }
    }
}
