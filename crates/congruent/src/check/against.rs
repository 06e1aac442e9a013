//! A robot against another description of it: first the geometry, then, if the two are the same chain, the dynamics.

use congruent_agreement::{
    SourcePair,
    compare::{Agreement, CheckError, CheckOptions, CheckReport, ComparedSource, Comparison, NotCompared},
};
use congruent_description::{ChainEnd, JointIndex, Robot, RobotDescription, Tolerance};
use congruent_dynamics_agreement::{
    CompareError, DynamicsModel, DynamicsReport, NamedModel, compare, without_one_sided_armature,
};
use congruent_input::{Capability, Diagnostic, Finding, RevisionName, display::position, nearest};
use congruent_kinematics::PoseError;
use congruent_mapping::{
    DigitsOfFrames, common_tip, is_same_value, other_joint, with_masses_at_links_of,
    with_values_within_digits,
};
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    cause_in_words::and_more,
    forces_not_compared::forces_not_compared,
    itself::has_one_file,
    loaded_words::LoadedKind,
    model_frames::{two_descriptions, unreadable_value, urdf_model, urdf_places},
    other_parents::other_parents,
    poses_of_other::PosesOfOther,
    reported_mapping::ReportedMapping,
    same_chain::{misplaced_joint, moved_alike, nearly_same, tolerated, within_small_fault},
};
use crate::codes;

/// The other description of a robot.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct OtherDescription {
    /// Its robot file, or its URDF if there is none.
    pub file: String,
    /// What it is if it is no file: what a program has loaded, or the poses of a function.
    #[serde(skip)]
    pub loaded: Option<LoadedKind>,
    /// Name of the robot there.
    pub robot: String,
    /// Why the two dynamics are not compared, or no more than masses, losses and limits, with the first joint that differs; `null` if
    /// they are.
    pub dynamics_not_compared: Option<String>,
    /// Whether they are not compared because a value of masses or losses cannot be read.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_unreadable: bool,
    /// If one of the two is a table or screws, without dynamics to compare: the joints whose ranges both state and that
    /// differ.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ranges_differ: Option<String>,
    /// Links that both files move alike, though their frames lie elsewhere in them: dynamics is compared in the frames of
    /// this description.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub links_in_other_frames: Vec<String>,
    /// Joints that do not move the tip which the caller named: they are not compared, and neither is what they carry.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joints_left_out: Vec<String>,
    /// Joints that hang on another link there, each with the lines of both.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joints_on_other_links: Vec<String>,
    /// If the two have other joints: the last link up to which they have the same ones, for --tip.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub common_tip: Option<String>,
    /// The joints of the other description in terms of this robot, if they have other names, directions or zeros, or if one
    /// of the two has further joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mapping: Option<ReportedMapping>,
    /// Links of this description that the other lacks: their frames are not compared.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub links_not_found: Vec<String>,
    /// Links that one of the two has as one, each with those that are fixed to it in the other: their masses are compared as the
    /// sum.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fused_links: Vec<String>,
    /// Springs, gravity and loops of an MJCF that the two have otherwise: they have no part in the torques that are compared.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub forces_not_compared: Vec<String>,
    /// Masses, inertias, limits and losses that differ by no more than the digits that they are written with, which is no
    /// difference: `forearm_link: mass`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub values_within_digits: Vec<String>,
}

impl OtherDescription {
    /// Whether the poses agree once the joints have the names, directions and zeros of this description, and nothing declares
    /// these.
    pub(super) fn is_equal_after_mapping(&self) -> bool {
        let mapping = self.mapping.as_ref().filter(|mapping| !mapping.is_declared);
        mapping.and_then(|of| of.verdict) == Some(Agreement::Agree)
    }

    /// What names alone show: what the other description lacks.
    fn before_comparison(
        description: &RobotDescription,
        other: &RobotDescription,
        poses: &PosesOfOther,
    ) -> Self {
        let robot = &description.robot;
        let other_joint = other_joint(robot, &other.robot);
        let common_tip = other_joint.as_ref().and_then(|_| common_tip(description, &other.robot));
        let lacking = poses.lacking(robot).map(|link| robot.link(link).name.clone());
        Self {
            file: other.path.display().to_string(),
            loaded: other.is_loaded().then(|| match other.own_model() {
                Some(_) => LoadedKind::Poses,
                None => LoadedKind::Model,
            }),
            robot: other.name.clone(),
            dynamics_not_compared: other_joint.or_else(|| missing_tip(description, &other.robot, poses)),
            is_unreadable: false,
            ranges_differ: None,
            links_in_other_frames: Vec::new(),
            joints_left_out: Vec::new(),
            joints_on_other_links: other_parents([description, other]),
            mapping: None,
            common_tip,
            links_not_found: lacking.collect(),
            fused_links: Vec::new(),
            forces_not_compared: forces_not_compared(description, other),
            values_within_digits: Vec::new(),
        }
    }
}

/// Adds the comparison of geometry to the report, and compares dynamics if the two are the same chain. The other description gets
/// the values of this one where they differ within their digits.
pub(super) fn compared(
    geometry: &mut CheckReport,
    description: &RobotDescription,
    other: &mut RobotDescription,
    options: &CheckOptions,
) -> Result<(OtherDescription, Option<DynamicsReport>), CheckError> {
    let poses = PosesOfOther::new(&description.robot, &other.robot);
    let mut against = OtherDescription::before_comparison(description, other, &poses);
    if against.dynamics_not_compared.is_some() {
        return Ok((against, None));
    }
    let mut poses = poses.with_free_frames(description, &other.robot)?;
    // Joints as if all were driven; how mimic joints follow is compared after it, with them following.
    geometry.add_other(description, other, &mut poses, options)?;
    let mut tolerance = tolerated(description, geometry);
    // Torques in the same joints need the same axes. Frames that only lie elsewhere in links that move alike are no
    // obstacle.
    let mut misplaced = misplaced_joint(&description.robot, geometry, &tolerance);
    let in_other_frames = if misplaced.is_some() || poses.has_free_frames() {
        moved_alike([&description.robot, &other.robot], &tolerance, options.seed)?
    } else {
        Vec::new()
    };
    let mut as_written = None;
    if RevisionName::of(&other.path).is_none() {
        against.fused_links = adopt_places_of_masses(description, other);
        let (names, written) = adopt_rounded_values(geometry, description, other);
        as_written = (!names.is_empty()).then_some(written);
        against.values_within_digits = names;
    }
    geometry.add_mimics(description, other, &mut poses, options)?;
    if misplaced.is_some() && in_other_frames.is_empty() {
        // Behind an origin that is a little off, links have the masses that both files write in their frames.
        tolerance = within_small_fault(description);
        misplaced = misplaced_joint(&description.robot, geometry, &tolerance);
        if misplaced.is_some() {
            against.dynamics_not_compared = misplaced;
            let dynamics = masses_alone([description, other], options.seed);
            return Ok((against, dynamics));
        }
    }
    let frames = PlacedFrames { tolerance, misplaced, in_other_frames };
    let dynamics = dynamics_of(geometry, &mut against, [description, other], frames.clone(), options.seed);
    if let Some((written, report)) = as_written.zip(dynamics.as_ref())
        && !report.has_same_torques()
    {
        // Masses that are split otherwise between links compensate to all digits: with a part of them adopted they do not.
        let rounded = std::mem::replace(&mut other.robot, written);
        let (mut geometry, mut exact) = (geometry.clone(), against.clone());
        let found = dynamics_of(&mut geometry, &mut exact, [description, other], frames, options.seed);
        if found.as_ref().is_some_and(DynamicsReport::has_same_torques) {
            exact.values_within_digits.clear();
            return Ok((exact, found));
        }
        other.robot = rounded;
    }
    Ok((against, dynamics))
}

/// Where the links of two descriptions lie that are the same chain.
#[derive(Clone)]
struct PlacedFrames {
    tolerance: Tolerance,
    /// The first joint whose link lies elsewhere, in words.
    misplaced: Option<String>,
    /// Links that move alike, with frames elsewhere in them.
    in_other_frames: Vec<String>,
}

/// The comparison of the dynamics of two descriptions of one chain; without one, `against` or `geometry` says why.
fn dynamics_of(
    geometry: &mut CheckReport,
    against: &mut OtherDescription,
    [description, other]: [&RobotDescription; 2],
    PlacedFrames { tolerance, misplaced, in_other_frames }: PlacedFrames,
    seed: u64,
) -> Option<DynamicsReport> {
    if let Some(of) = no_masses([description, other]).or_else(|| one_urdf([description, other])) {
        geometry.not_asked.push(of);
        against.ranges_differ = ranges_differ(&description.robot, other);
        return None;
    }
    against.dynamics_not_compared = [description, other].into_iter().find_map(unreadable_value);
    against.is_unreadable = against.dynamics_not_compared.is_some();
    if against.is_unreadable {
        return None;
    }
    let ([found, mut expected], armature_of) = compared_models([description, other], &tolerance);
    if !in_other_frames.is_empty() {
        // The written numbers are equal and only the frames differ: the fault is in the geometry, which is reported
        // already.
        let is_written_alike =
            expected.inertials == found.inertials && expected.resistances == found.resistances;
        let is_fault_of_frames = misplaced.is_some() && is_written_alike;
        let Some(in_frames) = expected.in_frames_of(&found).filter(|_| !is_fault_of_frames) else {
            against.dynamics_not_compared = misplaced;
            return None;
        };
        expected = in_frames;
    }
    against.links_in_other_frames = in_other_frames;
    let (files, models) = (files([description, other]), [found, expected]);
    let [candidate, reference] = named_models([description, other], &files, &models);
    match two_descriptions(&candidate, &reference, seed) {
        Ok(report) => Some(DynamicsReport { armature_stated_by: armature_of, ..report }),
        // No difference of the two: the poses agree.
        Err(error @ CompareError::NoJoint) => {
            let finding = Diagnostic::error(codes::check::OTHER_DYNAMICS, error.to_string());
            geometry.not_asked.push(NotCompared::because(ComparedSource::OtherDynamics, &finding));
            None
        }
        Err(error) => {
            against.dynamics_not_compared = Some(error.to_string());
            None
        }
    }
}

/// The masses, losses and limits of two descriptions of other chains, as if the links of one name had one centre of mass and one
/// tensor: what both say of these is in frames that lie elsewhere. `None` if nothing of them differs.
fn masses_alone(descriptions: [&RobotDescription; 2], seed: u64) -> Option<DynamicsReport> {
    let is_unreadable = || descriptions.into_iter().any(|of| unreadable_value(of).is_some());
    if no_masses(descriptions).or_else(|| one_urdf(descriptions)).is_some() || is_unreadable() {
        return None;
    }
    let anywhere = Tolerance { position_m: f64::INFINITY, orientation_rad: f64::INFINITY };
    let ([found, expected], _) = compared_models(descriptions, &anywhere);
    let expected = expected.with_tensors_of(&found);
    let (files, models) = (files(descriptions), [found, expected]);
    let [candidate, reference] = named_models(descriptions, &files, &models);
    compare(&candidate, &reference, seed).ok().filter(|report| !report.agrees())
}

/// Gives the other description the masses of each body at the links where this one has them, and names the bodies where that
/// makes a difference.
fn adopt_places_of_masses(own: &RobotDescription, there: &mut RobotDescription) -> Vec<String> {
    let (robot, fused) = with_masses_at_links_of([&own.robot, &there.robot]);
    let names = [there.base, there.tip].map(|link| there.robot.link(link).name.clone());
    let [base, tip] = names.map(|name| robot.find_link(&name).unwrap_or(robot.root()));
    // A link that has the mass that its file writes is where the file says it.
    let mass_kg = |of: &Robot, name: &String| of.link(of.find_link(name)?).inertia.map(|of| of.mass_kg);
    let is_written = |name: &&String| {
        let both = mass_kg(&robot, name).zip(mass_kg(&there.robot, name));
        both.is_some_and(|(moved, written)| is_same_value(moved, written))
    };
    let links = fused.iter().flat_map(|of| of.with.iter().chain([&of.link]));
    // Nor has one a value there that has lost its mass.
    let names = there.robot.links().iter().map(|link| &link.name);
    let lost = names.filter(|name| mass_kg(&robot, name).is_none() && mass_kg(&there.robot, name).is_some());
    let links: Vec<String> = links.filter(|name| !is_written(name)).chain(lost).cloned().collect();
    there.places = std::mem::take(&mut there.places).without_links(&links);
    (there.robot, there.base, there.tip) = (robot, base, tip);
    fused.iter().map(|of| format!("{} with {}", of.link, of.with.join(", "))).collect()
}

/// Gives the other description the values of this one where they differ within the digits of both. Returns their names, and the robot
/// as it was written.
fn adopt_rounded_values(
    geometry: &CheckReport,
    own: &RobotDescription,
    there: &mut RobotDescription,
) -> (Vec<String>, Robot) {
    // What digits, or a small difference of poses, turn and shift a frame by, they turn and shift the inertia in it by.
    let is_other = |of: &&Comparison| of.name == SourcePair::UrdfOther;
    let compared = geometry.comparisons.iter().filter(is_other);
    let moved = compared.filter(|of| geometry.is_judged_by_digits() || of.verdict == Agreement::Disagree);
    let nearly = nearly_same(own);
    let links: Vec<PoseError> = moved.flat_map(|of| &of.links).map(|link| link.error).collect();
    let near = links.iter().filter(|error| error.is_within(&nearly)).map(|error| error.position_m);
    let turns =
        links.iter().map(|error| error.orientation_rad).filter(|turn| *turn <= nearly.orientation_rad);
    let apart =
        PoseError { position_m: near.fold(0.0, f64::max), orientation_rad: turns.fold(0.0, f64::max) };
    let open = geometry.allowed_if_by_digits().unwrap_or_default();
    let of_frames = DigitsOfFrames { apart, along_axis_m: open.position_m };
    let (robot, names) = with_values_within_digits([&own.robot, &there.robot], of_frames);
    (names, std::mem::replace(&mut there.robot, robot))
}

/// The dynamics of two descriptions, without armatures that only one of the two states, and the file that states them.
fn compared_models(
    descriptions: [&RobotDescription; 2],
    tolerance: &Tolerance,
) -> ([DynamicsModel; 2], Option<String>) {
    let [description, other] = descriptions;
    let mut found = urdf_model(description);
    let mut expected = urdf_model(other).with_tolerated_places_of(&found, tolerance);
    // What an engine adds to the inertia of a joint moves the robot otherwise than its file says, which has none.
    let armature_of = if other.is_loaded() {
        None
    } else {
        without_one_sided_armature(descriptions.map(|of| &of.robot), [&mut found, &mut expected])
    };
    ([found, expected], armature_of.map(|at| descriptions[at].urdf_path.display().to_string()))
}

/// Two models with the names and places of their files.
fn named_models<'a>(
    descriptions: [&'a RobotDescription; 2],
    files: &'a [String; 2],
    models: &'a [DynamicsModel; 2],
) -> [NamedModel<'a>; 2] {
    let named = |of: usize| {
        let places = urdf_places(descriptions[of]);
        NamedModel { name: &files[of], model: &models[of], places }
    };
    [0, 1].map(named)
}

fn files(descriptions: [&RobotDescription; 2]) -> [String; 2] {
    descriptions.map(|of| of.urdf_path.display().to_string())
}

/// Why torques of a table or screws are not compared: they have no masses, which is no difference of the two.
fn no_masses(descriptions: [&RobotDescription; 2]) -> Option<NotCompared> {
    let own = descriptions.into_iter().find(|of| of.own_model().is_some())?;
    let findings = if own.is_loaded() {
        let why = format!("{}: poses say nothing of masses, losses and limits", own.path.display());
        vec![Finding::from(&Diagnostic::warning(codes::check::NO_SECOND_SOURCE, why))]
    } else {
        own.check_capability(Capability::Physics).err()?.iter().map(Finding::from).collect()
    };
    Some(NotCompared { source: ComparedSource::Dynamics, findings })
}

/// That the two have their masses and limits from one file, which are the same as themselves.
fn one_urdf(descriptions: [&RobotDescription; 2]) -> Option<NotCompared> {
    has_one_file(descriptions).then(|| {
        let why = format!(
            "both descriptions name {}: it has one set of masses",
            descriptions[0].urdf_path.display()
        );
        let finding = Diagnostic::warning(codes::check::NO_SECOND_SOURCE, why);
        NotCompared::because(ComparedSource::OtherDynamics, &finding)
    })
}

/// Joints whose ranges both descriptions state, and state otherwise: the first, and how many there are.
fn ranges_differ(robot: &Robot, other: &RobotDescription) -> Option<String> {
    let of_joint = |&joint: &JointIndex| {
        let joint = robot.joint(joint);
        let there = other.robot.joint(other.robot.find_joint(&joint.name)?);
        let [own, there] = [joint.position_range()?, there.position_range()?];
        if is_same_value(own.0, there.0) && is_same_value(own.1, there.1) {
            return None;
        }
        let unit = joint.kind.unit();
        let [own, there] = [own, there]
            .map(|(lower, upper)| format!("{} to {}", position(lower, unit), position(upper, unit)));
        Some(format!("{}: range {own}, {there} in {}", joint.name, other.path.display()))
    };
    let mut found = robot.movable_joints().iter().filter_map(of_joint);
    let first = found.next()?;
    Some(first + &and_more(found.count()))
}

/// The tip, if the other description lacks it and nobody but the caller can say which link is meant: what the check is
/// asked about would not be compared.
fn missing_tip(description: &RobotDescription, other: &Robot, poses: &PosesOfOther) -> Option<String> {
    let robot = &description.robot;
    let is_missing = poses.lacking(robot).any(|link| link == description.tip);
    let is_asked = description.chain_ends.tip != ChainEnd::Chosen || robot.dof() == 0;
    let tip = &robot.link(description.tip).name;
    let nearest = nearest(tip, other.links().iter().map(|link| link.name.as_str()));
    let meant = nearest.map_or_else(String::new, |name| format!("; did you mean \"{name}\"?"));
    (is_missing && is_asked)
        .then(|| format!("the other description has no link \"{tip}\", which is the tip{meant}"))
}
