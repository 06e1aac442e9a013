//! The geometry of a robot's sources, then its dynamics.

use std::iter::once;

use congruent_agreement::{
    SourcePair,
    compare::{
        Agreement, CheckError, CheckOptions, CheckReport, ComparedSource, DifferencesAt, Grade, NotCompared,
    },
};
use congruent_description::{DynamicsTable, InertialFrame, Link, RobotDescription};
use congruent_dynamics_agreement::DynamicsReport;
use congruent_input::Diagnostic;
use congruent_kinematics::LinkPoses;
use congruent_lint_report::{LintSummary, lint_robot};

use super::{
    against::OtherDescription,
    change::RevisionChange,
    declared::{self, DeclaredSource},
    itself::{add_itself, is_itself},
    model_frames::unreadable_value,
    own_model::{ONE_MODEL, diagnose_by_table, placed_as_in, without_own_table},
    own_screws::diagnose_by_screw,
    physics,
    poses_of_other::PosesOfOther,
    robot_check::RobotCheck,
    table_of_other::add_table_of_other,
    titles::entitle,
    with_other::with_other,
};
use crate::{codes, with_physics::simulated_poses};

/// Compares table, URDF chain, screws and the physics twin of a robot, first their poses and then their dynamics. A robot
/// that cannot be simulated is compared without the physics, and the report says why.
///
/// # Errors
/// [`CheckError`] if a source rejects the robot.
pub fn check(description: &RobotDescription, options: &CheckOptions) -> Result<RobotCheck, CheckError> {
    checked(description, None, options)
}

/// Like [`check`], and also compares the URDF with that of another description of the robot.
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
    let itself = other.filter(|other| is_itself(description, other));
    let other = other.filter(|_| itself.is_none());
    // A table or screws that are the robot get the links of the other description, and are no second source by themselves.
    let written = [description, other.unwrap_or(description)];
    let owned = other
        .and_then(|other| placed_as_in(description, other))
        .or_else(|| description.own_model().map(|_| without_own_table(description)));
    let description = owned.as_ref().unwrap_or(description);
    let other_owned = other.and_then(|other| placed_as_in(other, description));
    let other = other_owned.as_ref().or(other);
    let mut check = checked_in_links(description, other, written, options)?;
    if let Some(itself) = itself {
        add_itself(&mut check.geometry, itself);
        check.itself = Some(itself.path.display().to_string());
    }
    let mapping = check.against.as_ref().and_then(|against| against.mapping.as_ref());
    check.change = RevisionChange::new(written[0], written[1], mapping, options.seed)?;
    // A tool that is declared elsewhere moves no link, and a frame that is gone is missed by whoever names it.
    if check.change.as_ref().is_some_and(|change| change.decides(&check.geometry.tolerance)) {
        check.geometry.verdict = Agreement::Disagree;
    }
    if description.own_model().is_some() {
        // It has no masses, so the physics is no source that is missing.
        check.geometry.not_asked.retain(|of| of.source != ComparedSource::Simulation);
    }
    Ok(check)
}

/// The same of descriptions whose links have the frames in which they are compared; `written` are the two as their files have
/// them.
fn checked_in_links(
    description: &RobotDescription,
    other: Option<&RobotDescription>,
    written: [&RobotDescription; 2],
    options: &CheckOptions,
) -> Result<RobotCheck, CheckError> {
    let mut poses = simulated_poses(description);
    let is_simulated = poses.is_ok();
    let poses = poses.as_mut().map(|poses| poses as &mut dyn LinkPoses).map_err(|found| found.clone());
    let mut geometry = congruent_agreement::compare::check(description, poses, options)?;
    let mut compared = Vec::new();
    // First, since it adds to the geometry on which the verdicts of dynamics below depend.
    let mut with_other =
        other.map(|other| with_other(&mut geometry, description, other, options)).transpose()?;
    if let Some(of) = &with_other {
        diagnose_own_model(&mut geometry, written, [&of.description, &of.other], &of.options)?;
        add_table_of_other(&mut geometry, written, options)?;
    }
    entitle(&mut geometry, written[0], other.map(|_| written[1]));
    compared.extend(with_other.as_mut().and_then(|of| of.dynamics.take()));
    let (own, own_options) =
        with_other.as_ref().map_or((description, options), |of| (&of.description, &of.options));
    let there = with_other.as_ref().map(|of| &of.other);
    let at_configurations = at_configurations(own, there, &geometry, own_options)?;
    let declared_dynamics = add_declared(&mut geometry, &mut compared, description, options.seed);
    if is_simulated {
        match physics::compared(description, options.seed) {
            Ok(report) => compared.push(report),
            Err(finding) => {
                geometry.not_asked.push(NotCompared::because(ComparedSource::SimulatedDynamics, &finding));
            }
        }
    }
    if other.is_none() {
        geometry.not_asked.extend(stated_once(description, &geometry, &compared));
    }
    // A comparison that disagrees comes first; the order is otherwise kept.
    compared.sort_by_key(DynamicsReport::agrees);
    let against = with_other.as_ref().map(|of| &of.against);
    geometry.verdict = verdict(&geometry, against, &compared);
    geometry.grade = geometry.grade.filter(|_| geometry.verdict != Agreement::NothingCompared);
    let mut compared = compared.into_iter();
    let (dynamics, other_dynamics) = (compared.next(), compared.collect());
    let is_mapped = against.is_some_and(|against| against.mapping.is_some());
    let (against, mapped) = with_other.map(|of| (of.against, [of.description, of.other])).unzip();
    Ok(RobotCheck {
        geometry,
        at_configurations,
        against,
        change: None,
        declared_dynamics,
        dynamics,
        other_dynamics,
        mapped: mapped.filter(|_| is_mapped).map(Box::new),
        lint: LintSummary::from_reports(once(description).chain(other).map(lint_robot)),
        itself: None,
        tolerance_line: description.places.robot_file.as_ref().and_then(|places| places.tolerance_line()),
        fix: None,
    })
}

/// Adds the comparison with the dynamics that the robot file declares, or why there is none.
fn add_declared(
    geometry: &mut CheckReport,
    compared: &mut Vec<DynamicsReport>,
    description: &RobotDescription,
    seed: u64,
) -> Option<DeclaredSource> {
    match compared_with_declared(description, description.dynamics.as_ref()?, geometry, seed) {
        Ok((source, report)) => {
            if !source.values_within_digits.is_empty() {
                geometry.grade = geometry.grade.max(Some(Grade::SameWithinDigits));
            }
            compared.push(report);
            Some(source)
        }
        Err(finding) => {
            geometry.not_asked.push(NotCompared::because(ComparedSource::DeclaredDynamics, &finding));
            None
        }
    }
}

/// Names a difference from a table or screws that are the robot by their rows. `compared` are the two
/// in the same variables.
fn diagnose_own_model(
    geometry: &mut CheckReport,
    written: [&RobotDescription; 2],
    compared: [&RobotDescription; 2],
    options: &CheckOptions,
) -> Result<(), CheckError> {
    // A row of a table comes before a screw: its entries are what a data sheet has.
    if !diagnose_by_table(geometry, written, compared, options)? {
        diagnose_by_screw(geometry, written, compared);
    }
    Ok(())
}

/// What only one description states, if there is no other. Physics and screws are made of the URDF: they are no second
/// source.
fn stated_once(
    description: &RobotDescription,
    geometry: &CheckReport,
    dynamics: &[DynamicsReport],
) -> Vec<NotCompared> {
    let mut missing = Vec::new();
    let is_own_model = description.own_model().is_some();
    if geometry.chain.joints.is_empty() {
        return missing;
    }
    let because =
        |source, why| NotCompared::because(source, &Diagnostic::warning(codes::check::NO_SECOND_SOURCE, why));
    if !geometry.table_compared {
        let why = if is_own_model {
            ONE_MODEL
        } else {
            "there is one description: a table ([dh] in robot.toml) or --against gives a second one"
        };
        missing.push(because(ComparedSource::Geometry, why));
    }
    let is_declared = geometry.not_asked.iter().any(|of| of.source == ComparedSource::DeclaredDynamics);
    if !is_own_model && !is_declared && dynamics.iter().all(DynamicsReport::is_of_physics) {
        let has_mass = |link: &Link| link.inertia.is_some_and(|of| of.mass_kg > 0.0);
        let why = if description.robot.links().iter().any(has_mass) {
            "masses, friction and gravity are stated once: [[inertial]] in robot.toml or --against gives a second \
             source"
        } else {
            "no file states a mass"
        };
        missing.push(because(ComparedSource::Dynamics, why));
    }
    missing
}

/// The verdict of poses and dynamics together.
fn verdict(
    geometry: &CheckReport,
    against: Option<&OtherDescription>,
    dynamics: &[DynamicsReport],
) -> Agreement {
    let is_same = against.is_none_or(|against| {
        let is_declared = against.mapping.as_ref().is_none_or(|mapping| mapping.is_declared);
        is_declared && against.dynamics_not_compared.is_none() && against.ranges_differ.is_none()
    });
    let poses = geometry.verdict;
    if !is_same || dynamics.iter().any(|report| !report.agrees()) {
        return Agreement::Disagree;
    }
    let is_compared = poses != Agreement::NothingCompared || !dynamics.is_empty();
    let together = if is_compared && poses != Agreement::Disagree { Agreement::Agree } else { poses };
    // Links that hang together agree at every configuration, of which there is one.
    let is_rigid = against.is_none() && geometry.chain.joints.is_empty();
    if together == Agreement::Agree && is_rigid { Agreement::NothingCompared } else { together }
}

/// The dynamics of the URDF against those that the robot file declares, or why the two were not compared.
fn compared_with_declared(
    description: &RobotDescription,
    declared: &DynamicsTable,
    geometry: &CheckReport,
    seed: u64,
) -> Result<(DeclaredSource, DynamicsReport), Diagnostic> {
    // A value that cannot be read was taken as 0 and would appear as a difference.
    let readable = unreadable_value(description).map_or(Ok(()), Err);
    let compared = readable.and_then(|()| comparable(declared, geometry)).and_then(|()| {
        let of_table = geometry.allowed_if_by_digits().unwrap_or_default();
        declared::compared(description, declared, of_table, seed).map_err(|error| error.to_string())
    });
    compared.map_err(|why| Diagnostic::error(codes::check::DECLARED_DYNAMICS, why))
}

/// The differences at requested configurations, by the sources that the comparison had.
fn at_configurations(
    description: &RobotDescription,
    other: Option<&RobotDescription>,
    geometry: &CheckReport,
    options: &CheckOptions,
) -> Result<Option<DifferencesAt>, CheckError> {
    if options.configurations.is_empty() {
        return Ok(None);
    }
    let physics = simulated_poses(description).ok().map(|poses| Box::new(poses) as Box<dyn LinkPoses>);
    let differences = DifferencesAt::new(description, physics, &options.configurations)?;
    let is_compared = geometry.comparisons.iter().any(|of| of.name == SourcePair::UrdfOther);
    Ok(Some(match other.filter(|_| is_compared) {
        Some(other) => {
            let poses = PosesOfOther::with_mimics(&description.robot, &other.robot)
                .with_free_frames(description, &other.robot)?;
            differences.with_other(description, Box::new(poses))?
        }
        None => differences,
    }))
}

/// Whether there is anything to compare, and if parameters are in frames of the table, whether these are those of the
/// URDF: a wrong row would be taken for wrong masses.
fn comparable(declared: &DynamicsTable, geometry: &CheckReport) -> Result<(), String> {
    if declared.inertials.is_empty() && declared.gravity_in_base_m_s2.is_none() {
        return Err("[dynamics] of the robot file declares neither gravity nor an [[inertial]]: there is nothing to compare".to_owned());
    }
    let uses_table = declared.inertials.iter().any(|of| matches!(of.frame, InertialFrame::Dh(_)));
    let mut table = geometry.comparisons.iter().filter(|of| of.name == SourcePair::ModelUrdf);
    if uses_table && table.any(|of| of.verdict == Agreement::Disagree) {
        return Err(
            "its parameters are in frames of the table, which disagrees with the URDF: correct the table first"
                .to_owned(),
        );
    }
    Ok(())
}
