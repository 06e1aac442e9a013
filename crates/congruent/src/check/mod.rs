//! `check`: the geometry of a robot's sources, then its dynamics.

mod against;
mod declared;
mod physics;
mod suite;

use std::sync::Arc;

use congruent_agreement::compare::{Agreement, CheckError, CheckOptions, CheckReport, NotAsked};
use congruent_description::{Diagnostic, Finding, RobotDescription};
use congruent_dynamics_agreement::{
    CompareError, DynamicsReport, FigurePlaces, Frames, NamedSide, Side, certify, compare,
};
use congruent_kinematics::LinkPoses;
use schemars::JsonSchema;
use serde::Serialize;

pub use against::OtherDescription;
pub use declared::DeclaredSource;
pub use suite::check_suite;

use crate::with_physics::simulated_poses;

/// The answer of `congruent check` for one robot.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "CheckReport")]
pub struct RobotCheck {
    /// Poses of table, URDF, screws and physics. Its `verdict` and `not_asked` are those of the whole check.
    #[serde(flatten)]
    pub geometry: CheckReport,
    /// The other description, of --against.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub against: Option<OtherDescription>,
    /// The dynamics that the robot file declares.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub declared_dynamics: Option<DeclaredSource>,
    /// The comparison of masses, inertias, joint terms, gravity and limits that matters most: the first that disagrees;
    /// if all agree that of two descriptions, and without a second one that of the URDF and the physics. `null` if none
    /// could be made.
    pub dynamics: Option<DynamicsReport>,
    /// The other comparisons of dynamics.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub other_dynamics: Vec<DynamicsReport>,
}

impl RobotCheck {
    /// All comparisons of dynamics.
    pub fn all_dynamics(&self) -> impl Iterator<Item = &DynamicsReport> {
        self.dynamics.iter().chain(&self.other_dynamics)
    }
}

/// Compares table, URDF chain, screws and the physics twin of a robot, first their poses and then their dynamics. A robot
/// that cannot be simulated is compared without the physics, and the report says why.
///
/// # Errors
/// [`CheckError`] if a source rejects the robot.
pub fn check(description: &RobotDescription, options: &CheckOptions) -> Result<RobotCheck, CheckError> {
    checked(description, None, options)
}

/// The same, and the URDF with the URDF of another description of the robot.
///
/// Dynamics is compared if the two are the same chain: the same moving joints by name, at the same poses.
///
/// # Errors
/// As [`check`].
pub fn check_against(
    description: &RobotDescription,
    other: &RobotDescription,
    options: &CheckOptions,
) -> Result<RobotCheck, CheckError> {
    checked(description, Some(other), options)
}

fn checked(
    description: &RobotDescription,
    other: Option<&RobotDescription>,
    options: &CheckOptions,
) -> Result<RobotCheck, CheckError> {
    let mut poses = simulated_poses(description);
    let is_simulated = poses.is_ok();
    let poses = poses.as_mut().map(|poses| poses as &mut dyn LinkPoses).map_err(|found| found.clone());
    let mut geometry = congruent_agreement::compare::check(description, poses, options)?;
    let mut compared = Vec::new();
    let against = match other {
        Some(other) => {
            let (against, dynamics) = against::compared(&mut geometry, (description, other), options)?;
            compared.extend(dynamics);
            Some(against)
        }
        None => None,
    };
    let mut declared_dynamics = None;
    if let Some(declared) = &description.dynamics {
        match declared::compared(description, declared, options.seed) {
            Ok((source, report)) => {
                declared_dynamics = Some(source);
                compared.push(report);
            }
            Err(error) => {
                let finding = Diagnostic::error("check::declared_dynamics", error.to_string());
                geometry.not_asked.push(not_asked("declared_dynamics", &finding));
            }
        }
    }
    if is_simulated {
        match physics::compared(description, options.seed) {
            Ok(report) => compared.push(report),
            Err(finding) => geometry.not_asked.push(not_asked("simulated_dynamics", &finding)),
        }
    }
    // A comparison that disagrees comes first; the order is otherwise kept.
    compared.sort_by_key(DynamicsReport::agrees);
    let is_same = against.as_ref().is_none_or(|against| against.dynamics_not_compared.is_none());
    if !is_same || compared.iter().any(|report| !report.agrees()) {
        geometry.verdict = Agreement::Disagree;
    } else if geometry.verdict == Agreement::NothingCompared && !compared.is_empty() {
        geometry.verdict = Agreement::Agree;
    }
    let mut compared = compared.into_iter();
    let (dynamics, other_dynamics) = (compared.next(), compared.collect());
    Ok(RobotCheck { geometry, against, declared_dynamics, dynamics, other_dynamics })
}

fn not_asked(source: &'static str, finding: &Diagnostic) -> NotAsked {
    NotAsked { source, findings: vec![Finding::from(finding)] }
}

/// Compares two descriptions of one chain, with the certificates if they disagree.
fn two_descriptions(
    candidate: &NamedSide<'_>,
    reference: &NamedSide<'_>,
    seed: u64,
) -> Result<DynamicsReport, CompareError> {
    let mut report = compare(candidate, reference, seed)?;
    if !report.has_same_torques() {
        report.certificates = Some(certify(candidate, reference, seed)?);
    }
    Ok(report)
}

/// What the URDF of a description says; a figure may be mistaken for one in a frame of the table.
fn urdf_side(description: &RobotDescription) -> Side {
    let robot = &description.robot;
    let mut frames = Frames::new(robot);
    for (row, (link, link_from_dh)) in (1..).zip(declared::link_from_dh_frames(description)) {
        let mut link_from_frame = vec![None; robot.links().len()];
        link_from_frame[link] = Some(link_from_dh);
        frames = frames.with_other_frame(&format!("dh{row}"), link_from_frame);
    }
    Side::with_frames(robot, Arc::new(frames))
}

/// Where the URDF of a description says figures.
fn urdf_places(description: &RobotDescription) -> Option<&dyn FigurePlaces> {
    description.places.urdf.as_ref().map(|places| places as &dyn FigurePlaces)
}
