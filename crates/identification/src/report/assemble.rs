//! From what was identified to its report.

use congruent_description::{Robot, RobotDescription};
use congruent_dynamics::SpatialInertia;

use super::{
    identification_report::{
        BodyReport, EffortReport, IdentificationReport, IdentificationVerdict, IdentifiedJointReport,
        IndistinctTerms, TermReport, TorqueConstant, ValueWithError,
    },
    lines::lines,
    names::{kind, link_name, name, term_unit},
};
use crate::{
    effort_kind::{EffortKind, RecognisedEffort},
    identified::{IdentifiedBody, IdentifiedJoint, IdentifiedParameters},
    smoothing::Smoothing,
    unknowns::JointUnknown,
};

/// An identification, to be reported.
#[derive(Debug, Clone, Copy)]
pub struct IdentificationParts<'a> {
    /// The robot.
    pub description: &'a RobotDescription,
    /// Path of the log.
    pub log: &'a str,
    /// How the efforts look by themselves.
    pub recognised: &'a RecognisedEffort,
    /// What they were taken to be.
    pub kind: EffortKind,
    /// Whether the caller said so.
    pub is_declared: bool,
    /// The torque for a unit of effort that the caller gave, of each driven joint.
    pub given_constants: &'a [Option<f64>],
    /// The window.
    pub smoothing: Smoothing,
    /// Whether instants at rest were taken.
    pub is_still: bool,
    /// Instants that were used.
    pub instants: usize,
    /// Joints that the log does not have.
    pub held: &'a [String],
    /// The frame of the payload.
    pub payload_frame: &'a str,
    /// What was identified.
    pub identified: &'a IdentifiedParameters,
}

/// The report of an identification.
pub fn identification_report(of: &IdentificationParts<'_>) -> IdentificationReport {
    let IdentificationParts { description, identified, .. } = *of;
    let robot = &description.robot;
    let is_better = identified.is_better;
    IdentificationReport {
        file: description.path.display().to_string(),
        robot: description.name.clone(),
        log: of.log.to_owned(),
        verdict: if is_better { IdentificationVerdict::Better } else { IdentificationVerdict::NotBetter },
        effort: effort(of),
        half_window_s: of.smoothing.half_window_s,
        is_of_still_poses: of.is_still,
        instants: of.instants,
        joints_not_in_log: of.held.to_vec(),
        effort_delay_s: identified.delay_s.map(|(delay_s, _)| delay_s),
        effort_delay_error_s: identified.delay_s.map(|(_, error_s)| error_s),
        joints: identified.joints.iter().map(|joint| reported(robot, joint)).collect(),
        indistinct: identified
            .indistinct
            .iter()
            .map(|of| IndistinctTerms { joint: name(robot, of.joint), kept: of.term, like: of.from.clone() })
            .collect(),
        payload: identified.payload.as_ref().map(|payload| body(robot, payload, of.payload_frame)),
        bodies: identified.bodies.iter().map(|of| body(robot, of, &link_name(robot, of.joint))).collect(),
        known_combinations: identified.known_combinations[0],
        free_inertial_parameters: identified.known_combinations[1],
        lines: is_better.then(|| lines(description, identified, of.payload_frame)),
        written: Vec::new(),
        warnings: Vec::new(),
    }
}

fn reported(robot: &Robot, joint: &IdentifiedJoint) -> IdentifiedJointReport {
    let kind = kind(robot, joint.joint);
    let terms = joint.terms.iter().map(|(term, value)| TermReport {
        term: *term,
        value: ValueWithError {
            value: value.value,
            standard_error: value.standard_error,
            nominal: value.nominal,
            unit: term_unit(*term, kind),
        },
        is_significant: value.value.abs() >= SIGNIFICANT * value.standard_error,
    });
    IdentifiedJointReport {
        joint: name(robot, joint.joint),
        instants: joint.held_out.rows,
        effort_rms: joint.held_out.effort,
        before_rms: joint.held_out.before,
        after_rms: joint.held_out.after,
        alike: joint.noise.alike,
        unit: term_unit(JointUnknown::Offset, kind),
        terms: terms.collect(),
    }
}

/// Standard errors from which on a value differs from zero. Kind: choice, as usual.
const SIGNIFICANT: f64 = 2.0;

fn body(robot: &Robot, of: &IdentifiedBody, frame: &str) -> BodyReport {
    let center = |inertia: &SpatialInertia| -> Option<[f64; 3]> {
        (inertia.mass_kg > 0.0).then(|| (inertia.first_moment_kg_m / inertia.mass_kg).into())
    };
    let about_center = of.inertia.to_link();
    let tensor = about_center.map_or_else(nalgebra::Matrix3::zeros, |inertia| inertia.tensor_kg_m2);
    BodyReport {
        joint: name(robot, of.joint),
        frame: frame.to_owned(),
        mass: ValueWithError {
            value: of.inertia.mass_kg,
            standard_error: of.mass_error_kg,
            nominal: of.nominal.mass_kg,
            unit: "kg",
        },
        center_m: center(&of.inertia).unwrap_or_default(),
        center_error_m: of.center_error_m,
        nominal_center_m: center(&of.nominal),
        inertia_kg_m2: [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|at| tensor[at]),
        inertia_error_kg_m2: of.tensor_error_kg_m2,
    }
}

fn effort(of: &IdentificationParts<'_>) -> EffortReport {
    let robot = &of.description.robot;
    let [left_as_torque, left_as_torque_without_gravity, left_as_current] = of.recognised.left;
    let constant = |(row, joint): (usize, &IdentifiedJoint)| {
        let fitted = of.recognised.factors[row];
        let given = of.given_constants.get(row).copied().flatten();
        TorqueConstant {
            joint: name(robot, joint.joint),
            value: given.or(fitted.map(|(factor, _)| factor)),
            standard_error: if given.is_some() { None } else { fitted.map(|(_, error)| error) },
            unit: if kind(robot, joint.joint).is_angular() { "N m/A" } else { "N/A" },
        }
    };
    let constants = of.identified.joints.iter().enumerate().map(constant);
    EffortReport {
        kind: of.kind,
        is_declared: of.is_declared,
        left_as_torque,
        left_as_torque_without_gravity,
        left_as_current,
        torque_constants: if of.kind == EffortKind::Current { constants.collect() } else { Vec::new() },
    }
}
