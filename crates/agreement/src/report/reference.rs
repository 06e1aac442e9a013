//! Messages about joints of the URDF: one that the model omits, angles in another order, and rounded ones.

use std::{f64::consts::FRAC_PI_2, sync::Arc};

use congruent_input::display::angle;
use congruent_kinematics::rotation_log;

use super::{
    content::Fault,
    fault_message::{FaultContext, FaultMessage, FileLocation, off_by},
    joint_advice::{JointAttribute, advise_together, edits_of},
    joint_parts::{origin_attributes, origin_fault, shift, turn},
    values::ReportedValue,
};
use crate::diagnosis::{Cause, ModelPair, thresholds::ROUNDED_QUARTER_RAD};

impl FaultContext<'_> {
    pub(super) fn reference_joints(&self, joints: &[usize]) -> FaultMessage {
        if let (Cause::JointOrigin, &[joint]) = (self.fault.cause, joints) {
            return self.joint_origin(joint);
        }
        let names: Vec<String> = joints.iter().map(|&joint| self.names.chain_joint(joint)).collect();
        let listed = names.join("\", \"");
        let rotation =
            |models: &ModelPair, joint: usize| models.reference.joints[joint].parent_from_joint.rotation;
        let turn = |joint: usize| {
            rotation_log(&(rotation(self.after, joint).transpose() * rotation(self.before, joint))).norm()
        };
        let most = joints.iter().map(|&joint| turn(joint)).fold(0.0, f64::max);
        let mut fault = Fault::default();
        let (message, suggestion) = match self.fault.cause {
            Cause::FixedJointDropped => (
                format!("the model does not have the fixed joint \"{listed}\" of the URDF"),
                format!(
                    "write the <origin> of \"{listed}\" into base_from_dh0 or dhn_from_tip, or declare another base or tip"
                ),
            ),
            Cause::RpyOrder => (
                format!("the rpy of joint \"{listed}\" has another order in the URDF than in the model"),
                format!("check the rpy of joint \"{listed}\": a URDF means R = Rz(yaw) Ry(pitch) Rx(roll)"),
            ),
            _ => {
                fault.parameter = Some("rpy".to_owned());
                fault.value = Some(most);
                self.rounded(&names, most)
            }
        };
        let location = self.names.urdf.as_ref().and_then(|urdf| {
            Some(FileLocation { source: Arc::clone(urdf.source()), span: urdf.joint_origin(names.first()?)? })
        });
        match <[String; 1]>::try_from(names) {
            Ok([name]) => fault.joint = Some(name),
            Err(names) => fault.joints = names,
        }
        FaultMessage { fault: Fault { suggestion, ..fault }, message, location }
    }

    /// An `<origin>` of the URDF that is off, with the line to write there.
    fn joint_origin(&self, joint: usize) -> FaultMessage {
        let name = self.names.chain_joint(joint);
        let pose = |models: &ModelPair| models.reference.joints[joint].parent_from_joint;
        let (found, expected) = (pose(self.before).to_isometry(), pose(self.after).to_isometry());
        let urdf = self.names.urdf;
        let written = |attribute: &str| urdf?.joint_attribute(&name, "origin", attribute);
        let attributes = origin_attributes([&found, &expected], self.slack, written);
        let words = |value: fn(&JointAttribute) -> &str| {
            let words = attributes.iter().map(|of| format!("{}=\"{}\"", of.name, value(of)));
            words.collect::<Vec<_>>().join(" ")
        };
        let [was, is] = [words(|of| &of.found), words(|of| &of.expected)];
        let origin = origin_fault(&found, &expected);
        let off = off_by(shift(&origin), turn(&origin));
        let message = format!("<origin> of joint \"{name}\" in the URDF: {was}, expected {is}, off by {off}");
        let location = urdf.and_then(|urdf| {
            Some(FileLocation { source: Arc::clone(urdf.source()), span: urdf.joint_origin(&name)? })
        });
        let fault = Fault {
            parameter: Some(attributes.iter().map(|of| of.name).collect::<Vec<_>>().join(", ")),
            suggestion: format!("write {is} in the <origin> of joint \"{name}\" of the URDF"),
            found: Some(ReportedValue::Text(was)),
            expected: Some(ReportedValue::Text(is)),
            joint: Some(name.clone()),
            ..origin
        };
        // Without its place until the lines are known, so that they name their file: others are of the robot file.
        let mut message = FaultMessage { fault, message, location: None };
        if let Some(urdf) = urdf {
            let edits = edits_of(urdf, &name, "origin", &attributes);
            advise_together(std::slice::from_mut(&mut message), &[edits], urdf);
        }
        FaultMessage { location, ..message }
    }

    /// Quarter turns that the URDF rounds, each with its line, and how it would write them.
    fn rounded(&self, names: &[String], most_rad: f64) -> (String, String) {
        let (mut found, mut expected) = (Vec::new(), Vec::new());
        for name in names {
            let Some((rpy, line)) = self.names.urdf.as_ref().and_then(|urdf| urdf.joint_rpy(name)) else {
                continue;
            };
            found.push(format!("rpy=\"{rpy}\" of joint \"{name}\" in line {line}"));
            expected.push(format!("rpy=\"{}\" in line {line}", with_exact_quarters(&rpy)));
        }
        let most = angle(most_rad);
        let message = format!(
            "the URDF has rounded quarter turns (1.5708, not 1.5707963267948966), off by up to {most}: {}",
            found.join(", ")
        );
        (message, format!("in the URDF: {}", expected.join(", ")))
    }
}

/// Angles of a URDF with all digits of those that are rounded quarter turns.
fn with_exact_quarters(rpy: &str) -> String {
    let exact = |word: &str| {
        let quarters = (word.parse::<f64>().ok()? / FRAC_PI_2).round() * FRAC_PI_2;
        let off = word.parse::<f64>().ok()? - quarters;
        // Adding 0.0 turns -0 into 0, which is how a person writes it.
        (off.abs() < ROUNDED_QUARTER_RAD).then(|| (quarters + 0.0).to_string())
    };
    rpy.split_whitespace()
        .map(|word| exact(word).unwrap_or_else(|| word.to_owned()))
        .collect::<Vec<_>>()
        .join(" ")
}
