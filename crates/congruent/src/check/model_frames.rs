//! The compared models: the dynamics of a URDF, and the poses of its links and of the frames of its table.

use std::{ops::Range, sync::Arc};

use congruent_description::{ParameterPlaces, RobotDescription, RobotQ};
use congruent_dynamics_agreement::{
    CompareError, DynamicsModel, DynamicsReport, Frames, NamedModel, certify, compare,
};
use congruent_input::{Diagnostic, line_column};
use congruent_kinematics::{DhChain, KinematicsError, Pose, UrdfTree};

/// Compares two descriptions of one chain, with the certificates if they disagree.
pub(super) fn two_descriptions(
    candidate: &NamedModel<'_>,
    reference: &NamedModel<'_>,
    seed: u64,
) -> Result<DynamicsReport, CompareError> {
    let mut report = compare(candidate, reference, seed)?;
    add_certificates(&mut report, candidate, reference, seed)?;
    Ok(report)
}

/// Adds the certificates to the comparison of two descriptions if they disagree; takes seconds for a long arm.
pub(super) fn add_certificates(
    report: &mut DynamicsReport,
    candidate: &NamedModel<'_>,
    reference: &NamedModel<'_>,
    seed: u64,
) -> Result<(), CompareError> {
    // Of long chains torques are not bounded.
    if !report.has_same_torques() && report.seen.is_some() {
        report.certificates = Some(certify(candidate, reference, seed)?);
    }
    Ok(())
}

/// The dynamics model of a URDF, with the frames of the table as alternatives: a parameter may be given in one of
/// them by mistake.
pub(super) fn urdf_model(description: &RobotDescription) -> DynamicsModel {
    let robot = &description.robot;
    let mut frames = Frames::new(robot);
    for (row, (link, link_from_dh)) in (1..).zip(link_from_dh_frames(description)) {
        let mut link_from_frame = vec![None; robot.links().len()];
        link_from_frame[link] = Some(link_from_dh);
        frames = frames.with_other_frame(&format!("dh{row}"), link_from_frame);
    }
    let mut model =
        DynamicsModel::with_frames(robot, Arc::new(frames)).with_accelerations(&description.accelerations);
    model.is_complete = description.is_loaded();
    model
}

/// The first value of masses, inertias, damping or friction that cannot be read, such as `nan`: without it there is
/// nothing to compare. With its file, line and value.
pub(super) fn unreadable_value(description: &RobotDescription) -> Option<String> {
    unreadable_inertial(description).or_else(|| unreadable_joint_term(description))
}

/// The first `<dynamics>` of a joint with a value that is not a number; it was read as 0.
fn unreadable_joint_term(description: &RobotDescription) -> Option<String> {
    let places = description.places.urdf.as_ref()?;
    let text = &places.source().text;
    let element = |start: usize| start..start + text[start..].find('>').unwrap_or(0);
    let joints = description.robot.joints().iter().filter_map(|joint| places.joint_dynamics(&joint.name));
    let elements: Vec<Range<usize>> = joints.map(|tag| element(tag.start)).collect();
    let of_dynamics = |found: &&Diagnostic| {
        let at = found.span.as_ref().map(|span| span.start);
        let is_there = at.is_some_and(|at| elements.iter().any(|element| element.contains(&at)));
        found.code == congruent_description::codes::urdf::NUMBER && found.stops.is_some() && is_there
    };
    let found = description.warnings.iter().find(of_dynamics)?;
    let (line, _) = line_column(text, found.span.as_ref()?.start);
    Some(format!("{}:{line}: {}", description.urdf_path.display(), found.message))
}

/// The first link whose `<inertial>` cannot be read, such as a mass that is not a number: without it there is nothing
/// to compare. With its file, line and value.
fn unreadable_inertial(description: &RobotDescription) -> Option<String> {
    let places = description.places.urdf.as_ref()?;
    let links = description.robot.links().iter().filter(|link| link.inertia.is_none());
    let link = links.map(|link| &link.name).find(|name| places.has_inertial(name))?;
    let of_link = format!("link \"{link}\"");
    let stopping = |found: &&Diagnostic| found.stops.is_some() && found.message.starts_with(&of_link);
    let found = description.warnings.iter().find(stopping);
    let what =
        found.map_or_else(|| format!("{of_link}: its <inertial> cannot be read"), |of| of.message.clone());
    let span = found.and_then(|found| found.span.clone()).or_else(|| places.inertial_part(link, "mass"))?;
    let (line, _) = line_column(&places.source().text, span.start);
    Some(format!("{}:{line}: {what}", description.urdf_path.display()))
}

/// Where the URDF or the MJCF of a description says parameters.
pub(super) fn urdf_places(description: &RobotDescription) -> Option<&dyn ParameterPlaces> {
    description.places.parameters()
}

/// Links and frames of the table, joints at zero.
pub(super) struct AtZero {
    root_from_links: Vec<Pose>,
    pub(super) root_from_base: Pose,
    /// Empty without a table.
    base_from_dh: Vec<Pose>,
}

impl AtZero {
    pub(super) fn new(description: &RobotDescription) -> Result<Self, KinematicsError> {
        let robot = &description.robot;
        let zero = RobotQ::zeros(robot.dof());
        let mut root_from_links = vec![Pose::identity(); robot.links().len()];
        UrdfTree::new(robot).root_from_links_into(&zero, &mut root_from_links)?;
        let mut base_from_dh = Vec::new();
        if let Some(table) = &description.dh {
            let chain = DhChain::new(table, robot);
            base_from_dh.resize(chain.joint_count() + 1, Pose::identity());
            chain.dh_frames_into(&zero, &mut base_from_dh)?;
        }
        let root_from_base = root_from_links[description.base.get()];
        Ok(Self { root_from_links, root_from_base, base_from_dh })
    }

    pub(super) fn link_from_dh(&self, link: usize, frame: usize) -> Pose {
        self.root_from_links[link].inverse() * self.root_from_base * self.base_from_dh[frame]
    }
}

/// For each row of the table the link of its joint, by number, and the row's frame in it; empty without a table.
fn link_from_dh_frames(description: &RobotDescription) -> Vec<(usize, Pose)> {
    let (Some(table), Ok(zero)) = (&description.dh, AtZero::new(description)) else { return Vec::new() };
    let links = table.rows.iter().map(|row| description.robot.joint(row.joint).child.get());
    (1..).zip(links).map(|(frame, link)| (link, zero.link_from_dh(link, frame))).collect()
}
