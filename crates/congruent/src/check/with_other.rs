//! A robot with another description: which parts of the two are compared, in which variables, and the comparison.

use std::cmp::Ordering;

use congruent_agreement::{
    SourcePair,
    compare::{CheckError, CheckOptions, CheckReport, Grade},
};
use congruent_description::{RobotDescription, Tolerance};
use congruent_dynamics_agreement::{DynamicsReport, LimitCause};
use congruent_input::{Diagnostic, Finding, display::listed};
use congruent_kinematics::PoseError;
use congruent_mapping::{driven_as_in, other_joint};

use super::{
    against::{OtherDescription, compared},
    mapped::MappedPair,
    mapped_joints::mapped_joints,
    narrowed::NarrowedPair,
    own_model::placed_as_in,
    reported_mapping::{RangeInVariable, ReportedMapping},
};
use crate::codes;

/// Variables that explain this much of a difference without a cause are the better reading. Kind: choice.
const MOST_LEFT: f64 = 0.1;

/// The comparison with another description.
pub(super) struct WithOther {
    pub(super) against: OtherDescription,
    pub(super) dynamics: Option<DynamicsReport>,
    /// The two as they were compared: the parts that `--tip` names, the other in the variables of the robot.
    pub(super) description: RobotDescription,
    pub(super) other: RobotDescription,
    /// The options with the requested configurations in the joints that are compared.
    pub(super) options: CheckOptions,
}

/// Compares the two and adds their poses to `geometry`.
pub(super) fn with_other(
    geometry: &mut CheckReport,
    description: &RobotDescription,
    other: &RobotDescription,
    options: &CheckOptions,
) -> Result<WithOther, CheckError> {
    let (mut own, mut there, mut own_options) = (description.clone(), other.clone(), options.clone());
    let (mut left_out, mut mapping) = (Vec::new(), None);
    let mut narrowed = NarrowedPair::new(description, other, options);
    // Joints to the tip with the same names need no mapping: the others, which are left out, need no partner.
    let needs_none = |pair: &NarrowedPair| {
        description.mapping.is_none() && other_joint(&pair.description.robot, &pair.other.robot).is_none()
    };
    if !narrowed.as_ref().is_some_and(needs_none) {
        let in_own = in_own_variables(description, other, options).map_err(CheckError::Mapping)?;
        if let Some(pair) = in_own {
            narrowed = NarrowedPair::new(&pair.description, &pair.other, &pair.options);
            (own, there, own_options) = (pair.description, pair.other, pair.options);
            mapping = Some(pair.report);
        }
    }
    if let Some(pair) = narrowed {
        (own, there, own_options) = (pair.description, pair.other, pair.options);
        left_out = pair.left_out;
        // A table and screws are compared whole: what the other moves in addition is no part of the answer.
        if description.own_model().is_some() {
            left_out.retain(|name| description.robot.find_joint(name).is_some());
        }
    }
    // Again, now that joints have the same names.
    own = placed_as_in(&own, &there).unwrap_or(own);
    there = placed_as_in(&there, &own).unwrap_or(there);
    let (robot, driven_otherwise) = driven_as_in(&own.robot, &there.robot);
    there.robot = robot;
    let (before, as_written) = (geometry.clone(), there.clone());
    let (mut against, mut dynamics) = compared(geometry, &own, &mut there, &own_options)?;
    against.joints_left_out = left_out;
    against.mapping = mapping.map(|mapping| mapping.with_worst(geometry));
    if against.mapping.is_none()
        && against.dynamics_not_compared.is_some()
        && let Some(mut pair) = MappedPair::of_other_variables(&own, &as_written, &own_options)
        && PairReading::may_be_other(geometry, &pair.report)
    {
        let (mut in_variables, mut mapped) = (against.clone(), before);
        let found = in_same_variables(&mut in_variables, &mut mapped, &mut pair)?;
        let reading = PairReading::simpler([geometry, &mapped], &in_variables, &pair.report);
        if reading != PairReading::AsWritten {
            (against, dynamics) = (in_variables, found);
            against.mapping = against.mapping.map(|mapping| mapping.with_difference_as_written(geometry));
        }
        if reading == PairReading::Mapped {
            *geometry = mapped;
            (own, there, own_options) = (pair.description, pair.other, pair.options);
        }
    }
    if let (Some(mapping), Some(report)) = (&against.mapping, &mut dynamics) {
        add_written_ends(report, mapping);
    }
    add_what_is_known(geometry, other, &against, &driven_otherwise);
    if against.is_equal_after_mapping() {
        geometry.grade = Some(Grade::EqualAfterMapping);
    } else if !against.values_within_digits.is_empty() {
        geometry.grade = geometry.grade.max(Some(Grade::SameWithinDigits));
    }
    Ok(WithOther { against, dynamics, description: own, other: there, options: own_options })
}

/// Adds to the comparison what is known of the other description: its precision and what is suspicious in it.
fn add_what_is_known(
    geometry: &mut CheckReport,
    other: &RobotDescription,
    against: &OtherDescription,
    driven_otherwise: &[String],
) {
    if let Some(Tolerance { position_m, orientation_rad }) = other.loaded {
        geometry.add_residual_of_other(PoseError { position_m, orientation_rad });
    }
    geometry.warnings.extend(other.warnings.iter().map(Finding::from));
    geometry.warnings.extend(driven_by_another(&against.file, driven_otherwise).iter().map(Finding::from));
    geometry.warnings.extend(undeclared(against).iter().map(Finding::from));
}

/// Two descriptions in the joints of the first, as its file declares or as names and axes show; `None` if all joints have
/// the same names and links, or nothing in common.
fn in_own_variables(
    description: &RobotDescription,
    other: &RobotDescription,
    options: &CheckOptions,
) -> Result<Option<MappedPair>, String> {
    let declared = MappedPair::declared(description, other, options)?;
    let has_other_names = || other_joint(&description.robot, &other.robot).is_some();
    Ok(declared.or_else(|| {
        if has_other_names() {
            MappedPair::of_other_names(description, other, options)
        } else {
            MappedPair::of_exchanged_names(description, other, options)
        }
    }))
}

/// The dynamics of two descriptions with the same joints by name in the same variables, where poses are compared in the
/// variables that both files write. Adds the mapping to `against`.
fn in_same_variables(
    against: &mut OtherDescription,
    geometry: &mut CheckReport,
    pair: &mut MappedPair,
) -> Result<Option<DynamicsReport>, CheckError> {
    let (mapped, dynamics) = compared(geometry, &pair.description, &mut pair.other, &pair.options)?;
    against.mapping = Some(ReportedMapping::with_worst(pair.report.clone(), geometry));
    against.dynamics_not_compared = mapped.dynamics_not_compared;
    against.is_unreadable = mapped.is_unreadable;
    against.links_in_other_frames = mapped.links_in_other_frames;
    against.fused_links = mapped.fused_links;
    against.values_within_digits = mapped.values_within_digits;
    Ok(dynamics)
}

/// In which variables two descriptions with the same joints by name are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PairReading {
    /// As both files write them: the causes there are fewer than joints have another variable.
    AsWritten,
    /// As both files write them, since causes name the directions and zeros that make the two equal.
    Conventions,
    /// In the variables that the joints have in common.
    Mapped,
}

impl PairReading {
    /// Whether another reading may have fewer statements: not if fewer causes explain the difference than variables differ.
    fn may_be_other(written: &CheckReport, mapping: &ReportedMapping) -> bool {
        let explained = Self::ranges(mapping, RangeInVariable::Explained);
        causes(written).is_none_or(|causes| causes + explained >= Self::differing(mapping))
    }

    /// How many joints have another variable, and another range for it than both files write, with a turned base as one more.
    fn differing(mapping: &ReportedMapping) -> usize {
        mapping.joints.iter().filter(|of| !of.has_same_variable()).count()
            + Self::ranges(mapping, RangeInVariable::Contradicted)
            + usize::from(mapping.turn_of_base_rad().is_some())
    }

    fn ranges(mapping: &ReportedMapping, which: RangeInVariable) -> usize {
        mapping.joints.iter().filter(|of| of.range == which).count()
    }

    /// The reading with fewer statements: causes, joints with another variable, and ranges that differ.
    fn simpler(
        [written, mapped]: [&CheckReport; 2],
        against: &OtherDescription,
        mapping: &ReportedMapping,
    ) -> Self {
        let differing = Self::differing(mapping);
        let Some(causes) = self::causes(written) else {
            // Without a cause in either, what they are apart decides.
            let is_nearer = mapped.worst.error.position_m < MOST_LEFT * written.worst.error.position_m;
            let has_answer = against.is_equal_after_mapping() || is_nearer || self::causes(mapped).is_some();
            return if has_answer { Self::Mapped } else { Self::AsWritten };
        };
        let is_equal = against.is_equal_after_mapping();
        let rest = if is_equal { Some(0) } else { self::causes(mapped) };
        let as_written = causes + Self::ranges(mapping, RangeInVariable::Explained);
        match rest.map_or(Ordering::Less, |rest| as_written.cmp(&(differing + rest))) {
            Ordering::Greater => Self::Mapped,
            Ordering::Equal if is_equal => Self::Conventions,
            Ordering::Equal if mapping.is_by_convention() => Self::Mapped,
            Ordering::Less | Ordering::Equal => Self::AsWritten,
        }
    }
}

/// The ends of ranges as the other file writes them, where a joint has another direction or zero there.
fn add_written_ends(report: &mut DynamicsReport, mapping: &ReportedMapping) {
    for limit in report.limits.iter_mut().filter(|of| of.cause == LimitCause::PositionLimit) {
        let joint = mapping.joints.iter().find(|of| of.joint == limit.joint && !of.has_same_variable());
        limit.expected_as_written =
            joint.zip(limit.expected).map(|(of, expected)| f64::from(of.sign) * expected + of.offset);
    }
}

/// How many faults explain the difference of two descriptions; `None` if nothing does.
fn causes(geometry: &CheckReport) -> Option<usize> {
    let mut others = geometry.diagnoses.iter().filter(|of| of.name == SourcePair::UrdfOther);
    others.find(|of| of.is_explained())?.named_cause().map(|cause| cause.faults().len())
}

/// That coupled joints are driven at another one of them, which changes no motion but what is commanded.
fn driven_by_another(file: &str, joints: &[String]) -> Option<Diagnostic> {
    let names: Vec<&str> = joints.iter().map(String::as_str).collect();
    let follow = if joints.len() == 1 {
        "drives the joint that it follows here"
    } else {
        "drive those that they follow here"
    };
    let message = format!(
        "{file}: {} {follow}: the coupling is compared, not which joint is commanded",
        listed(&names)
    );
    (!joints.is_empty()).then(|| Diagnostic::warning(codes::check::MAPPING, message))
}

/// That joints are called or counted otherwise, with the lines that declare it, if nothing does.
fn undeclared(against: &OtherDescription) -> Option<Diagnostic> {
    let mapping = against.mapping.as_ref().filter(|mapping| !mapping.is_declared)?;
    let message = format!("{}: {}", against.file, mapped_joints(mapping));
    let help = format!(
        "if this is meant, declare it in the robot file, robot.toml, which `congruent new robot` writes:\n{}",
        mapping.lines.join("\n")
    );
    Some(Diagnostic::warning(codes::check::MAPPING, message).with_help(help))
}
