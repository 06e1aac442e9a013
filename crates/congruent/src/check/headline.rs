//! The first line of a check: the answer in the words of the question, the largest difference, and the cause.

use std::fmt::{self, Write};

use congruent_agreement::{
    SourcePair,
    compare::{Agreement, CheckReport, Comparison, Grade, NotCompared},
};
use congruent_description::codes::chain::TABLE_DROPPED;
use congruent_dynamics_agreement::{DynamicsVerdict, ParameterDifference};
use congruent_input::display::{counted, listed};
use congruent_kinematics::PoseError;

use super::{
    against::OtherDescription,
    cause_in_words::{and_more, at_most, cause, frames_elsewhere, place, unknown},
    change_answer::answer_of_change,
    declared::DeclaredSource,
    dynamics_in_words::other_torques,
    judged_by::{allowed, beyond_rounding, judged_by, poses_judged_by, tolerance_in_words},
    loaded_words::in_words_of,
    mapped_answer::{after_mapping, which_joints},
    mapped_joints::ends_not_compared,
    own_model::ONE_MODEL,
    robot_check::RobotCheck,
};

/// The answer of a check in a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Headline {
    /// The answer in capitals: `SAME ROBOT`, `DIFFERENT`.
    pub answer: String,
    /// What it is about, how large the difference is, and its cause: what follows the answer, with the punctuation
    /// between the two.
    pub details: String,
}

impl fmt::Display for Headline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.answer, self.details)
    }
}

impl Headline {
    fn new(answer: impl Into<String>, details: impl Into<String>) -> Self {
        Self { answer: answer.into(), details: details.into() }
    }
}

impl RobotCheck {
    /// The answer as `check` and its page give it: whether the descriptions are the same robot, by which sources, and how
    /// far they differ and why; and what it does not cover.
    pub fn headline(&self) -> Headline {
        let mut headline = self.answer();
        let mut warnings = self.geometry.warnings.iter();
        if let Some(dropped) = warnings.find(|warning| warning.code == TABLE_DROPPED.name) {
            let _ = write!(headline.details, "; {}", dropped.message);
        }
        let mapping = self.against.as_ref().and_then(|against| against.mapping.as_ref());
        if let Some(ends) = mapping.and_then(ends_not_compared) {
            let _ = write!(headline.details, "; {ends}");
        }
        if let Some(force) = self.first_force_not_compared() {
            let _ = write!(headline.details, "; not compared: {force}");
        }
        if let Some(value) = self.first_value_without_effect() {
            let _ = write!(headline.details, "; without effect on torques: {value}");
        }
        if !self.geometry.chain.set_values.is_empty() {
            let _ = write!(headline.details, "; --set {}", self.geometry.chain.set_values.join(", "));
        }
        if let Some(file) = &self.itself {
            let _ = write!(headline.details, "; --against names {file}, the robot's own file");
        }
        if self.fails_by_lint() {
            let findings = counted(self.lint.findings(), "finding");
            let _ = write!(headline.details, "; --strict: {findings} of lint");
        }
        if self.fails_without_second() {
            headline.details += "; --strict: a second description is missing";
        }
        let Headline { answer, details } = headline;
        let [answer, details] = [answer, details].map(|text| in_words_of(self.loaded(), text));
        Headline { answer, details }
    }

    fn answer(&self) -> Headline {
        let report = &self.geometry;
        if let Some((answer, details)) = answer_of_change(self) {
            return Headline::new(answer, details);
        }
        if let Some((other, why)) = self.other_chain() {
            let advice = other.common_tip.as_ref().map_or_else(String::new, |tip| {
                format!(". To compare the joints up to link \"{tip}\" alone: --tip {tip}")
            });
            let details = format!("{why}; poses and torques of {} were not compared{advice}", other.file);
            if report.poses_disagree() {
                let own = different_poses(self);
                return Headline { details: format!("{}. Other joints: {details}", own.details), ..own };
            }
            return Headline::new("DIFFERENT JOINTS", format!(": {details}"));
        }
        if let Some((answer, details)) = after_mapping(self) {
            return Headline::new(answer, details);
        }
        if report.verdict == Agreement::NothingCompared {
            let is_alone = |of: &&NotCompared| of.findings.iter().any(|of| of.message == ONE_MODEL);
            let why = match report.not_asked.iter().find(is_alone) {
                Some(_) => "the table or the screws are the robot, and there is no second description",
                None => Agreement::why_nothing(&report.chain),
            };
            return Headline::new("NOTHING COMPARED", format!(": {why}"));
        }
        if report.poses_disagree() {
            return different_poses(self);
        }
        if report.verdict == Agreement::Disagree {
            return different_dynamics(self);
        }
        let (answer, extent) = (self.agreeing_answer(), extent(self));
        let (same, rest) = answer.split_at(answer.find(',').unwrap_or(answer.len()));
        if report.grade != Some(Grade::SameWithinDigits) || !report.is_judged_by_digits() {
            let of_other = self.against.as_ref().map_or(0, |against| against.values_within_digits.len());
            let declared = self.declared_dynamics.as_ref().map_or(0, |of| of.values_within_digits.len());
            let rounded = of_other + declared;
            if rounded > 0 {
                let values = counted(rounded, "value");
                let found = format!("{}; rounded: {values} of masses, inertias and limits", agreeing(report));
                return Headline::new(same, format!("{extent} within the digits written{rest}. {found}"));
            }
            // What was compared is said behind it, and not behind what was not.
            return Headline::new(format!("{same}{extent}{rest}"), format!(". {}", agreeing(report)));
        }
        let written = report.comparisons.iter().filter(|of| of.name.is_written());
        let by_digits =
            written.max_by(|one, other| one.worst.error.position_m.total_cmp(&other.worst.error.position_m));
        let pair = by_digits.map_or([""; 2], sources).join(" against ");
        let found = beyond_rounding(report.worst.error);
        let allowed = report.allowed_by_digits.map_or_else(String::new, |allowed| {
            format!("; the digits could explain {}", beyond_rounding(allowed))
        });
        let at = counted(report.configurations, "configuration");
        let by =
            if report.tolerance_is_declared { judged_by(report) } else { "no tolerance declared".to_owned() };
        let details = format!(
            "{extent} within the digits written (up to {found} apart{allowed}){rest}. {pair} at {at}; {by}"
        );
        Headline::new(same, details)
    }

    /// The answer if everything that was compared agrees. Physics and screws are made of the URDF: they are no second
    /// description.
    fn agreeing_answer(&self) -> &'static str {
        let has_geometry = self.geometry.table_compared || self.against.is_some();
        let has_dynamics =
            self.dynamics_of_descriptions().any(|of| of.verdict != DynamicsVerdict::NotCompared);
        match (has_geometry, has_dynamics) {
            (true, true) if self.first_force_not_compared().is_some() => {
                "SAME ROBOT, FORCES COMPARED IN PART"
            }
            (true, true) if self.is_stated_once("mass") || self.is_stated_once("centre of mass") => {
                "SAME ROBOT, MASSES COMPARED IN PART"
            }
            (true, true) if self.is_stated_once("inertia") => "SAME ROBOT, INERTIA NOT COMPARED",
            (true, true) if self.is_stated_once("damping") => "SAME ROBOT, LOSSES NOT COMPARED",
            (true, true) => "SAME ROBOT",
            (true, false) => "SAME GEOMETRY, DYNAMICS NOT COMPARED",
            (false, true) => "SAME DYNAMICS, GEOMETRY NOT COMPARED",
            (false, false) => "NO SECOND DESCRIPTION",
        }
    }

    /// The first of the forces that the two have otherwise and that are in no torque; `None` for a revision, whose answer has them.
    fn first_force_not_compared(&self) -> Option<&String> {
        let against = self.against.as_ref().filter(|_| self.change.is_none())?;
        against.forces_not_compared.first()
    }

    /// The first value that differs without an effect on any torque, as the mass of a link that only turns about a vertical axis through its
    /// centre of mass; `None` if something else differs, too, or for a revision, whose answer has it.
    fn first_value_without_effect(&self) -> Option<String> {
        let agrees = self.geometry.verdict == Agreement::Agree && self.change.is_none();
        self.dynamics_of_descriptions().filter(|_| agrees).find_map(|report| {
            // A zero that only one of the two writes is no difference.
            let differs =
                |of: &ParameterDifference| (of.found.unwrap_or(0.0) - of.expected.unwrap_or(0.0)).abs() > 0.0;
            let is_alone = |of: &&ParameterDifference| {
                of.below_resolution.is_none() && of.cancelled.is_none() && differs(of)
            };
            let mut hidden: Vec<&ParameterDifference> =
                report.hidden_differences.iter().filter(is_alone).collect();
            // A mass is what people know of a link.
            hidden.sort_by_key(|of| (of.parameter != "mass", of.found.is_none() || of.expected.is_none()));
            let first = hidden.first()?;
            let first =
                report.sides.files().map_or_else(|| first.sentence(), |files| first.sentence_in(files));
            Some(first + &and_more(hidden.len() - 1))
        })
    }

    /// Whether the other description, or the robot file if that is the only second source of dynamics, says nothing of this kind
    /// about some of the joints.
    fn is_stated_once(&self, parameter: &str) -> bool {
        let lacks = |of: &[String]| of.iter().any(|it| it.starts_with(parameter));
        if self.against.is_some() {
            return self.dynamics_of_descriptions().any(|report| lacks(&report.not_stated));
        }
        let declared = self.declared_dynamics.as_ref();
        parameter != "damping" && declared.is_some_and(|of: &DeclaredSource| lacks(&of.not_declared))
    }
}

/// The part of the robot that was compared, if it is not all of it.
fn extent(check: &RobotCheck) -> String {
    let report = &check.geometry;
    let (all, of_chain) = (report.robot_joints, report.chain.joints.len());
    match &check.against {
        Some(against) if !against.joints_left_out.is_empty() => {
            let compared = all.saturating_sub(against.joints_left_out.len());
            format!(" in {compared} of {all} joints (those that move the tip)")
        }
        Some(OtherDescription { mapping: Some(mapping), .. })
            if !mapping.left_out.is_empty() || !mapping.other_left_out.is_empty() =>
        {
            let (compared, all) = (mapping.compared_joints(), mapping.all_joints());
            format!(" in {compared} of {all} joints ({})", which_joints(mapping))
        }
        Some(against) if against.links_not_found.contains(&report.chain.tip) => {
            format!(" without the tip \"{}\" (in one file alone)", report.chain.tip)
        }
        None if report.table_compared && of_chain < all => {
            format!(" in {of_chain} of {all} joints (those of the table)")
        }
        _ => String::new(),
    }
}

/// The sources that agree, and the bound of their difference.
fn agreeing(report: &CheckReport) -> String {
    let sources = listed(&sources_of(report));
    let tolerance = tolerance_in_words(report);
    match certified(report) {
        Some(bound) => {
            format!("{sources} agree over the whole joint range (difference {}, {tolerance})", at_most(bound))
        }
        None => format!(
            "{sources} agree at {} (difference {}, {tolerance})",
            counted(report.configurations, "configuration"),
            at_most(report.worst.error)
        ),
    }
}

/// The bound over the whole joint range, if every pair has one within the tolerance.
fn certified(report: &CheckReport) -> Option<PoseError> {
    let has_bound = |pair: &Comparison| {
        let of_physics = [SourcePair::ModelSimulation, SourcePair::UrdfSimulation];
        let mut named = report.certificates.iter();
        named.any(|of| {
            of.name == pair.name || (of_physics.contains(&of.name) && of_physics.contains(&pair.name))
        })
    };
    let mut compared = report.comparisons.iter().filter(|of| of.name != SourcePair::PoeUrdf);
    let bounds = report.certificates.iter().map(|of| Some(of.brackets.as_ref()?.bounds()));
    let bounds: Option<Vec<PoseError>> = bounds.collect();
    let bound = bounds?.into_iter().fold(PoseError::default(), PoseError::larger);
    (compared.all(has_bound) && bound.is_within(&report.tolerance)).then_some(bound)
}

/// Poses differ: by how much, and why.
fn different_poses(check: &RobotCheck) -> Headline {
    let report = &check.geometry;
    let differ = report.comparisons.iter().filter(|comparison| comparison.verdict == Agreement::Disagree);
    let of_pair = |comparison: &Comparison| {
        let [a, b] = sources(comparison);
        let allowed = if comparison.name.is_written() { allowed(report) } else { String::new() };
        let worst = &comparison.worst;
        format!("{} at {} ({a} against {b}{allowed})", beyond_rounding(worst.error), worst.link)
    };
    let pairs: Vec<String> = differ.map(of_pair).collect();
    let judged = poses_judged_by(check);
    let found = format!("by up to {}; {judged}", pairs.join(", "));
    if report.grade == Some(Grade::SameWithinDigits) {
        let advice = by_rounding_alone(check);
        return Headline::new("DIFFERENT", format!(" by rounding alone, {found}: {advice}"));
    }
    let elsewhere = || frames_elsewhere(&check.against.as_ref()?.links_in_other_frames);
    let cause = match (check.diagnosis(), on_other_link(check)) {
        (Some(diagnosis), joint) if diagnosis.is_explained() || joint.is_none() => cause(diagnosis),
        (_, Some(joint)) => format!("Cause: {joint}"),
        (_, None) => elsewhere().unwrap_or_else(unknown),
    };
    Headline::new("DIFFERENT", format!(", {found}. {cause}{}", other_torques(check)))
}

/// The first joint that hangs on another link in the other description, which no value of a joint explains.
fn on_other_link(check: &RobotCheck) -> Option<String> {
    let joints = &check.against.as_ref()?.joints_on_other_links;
    Some(joints.first()?.clone() + &and_more(joints.len() - 1))
}

/// What to do about a tolerance that is finer than the digits of the table.
fn by_rounding_alone(check: &RobotCheck) -> String {
    let report = &check.geometry;
    let removed = if report.requested_tolerance.is_some() {
        "without --tolerance".to_owned()
    } else {
        format!(
            "the declared tolerance is finer than the digits of the table; without it{}",
            place(Some(&report.file), check.tolerance_line)
        )
    };
    format!("{removed} the digits decide")
}

/// Poses agree, but masses, friction, gravity or limits do not.
fn different_dynamics(check: &RobotCheck) -> Headline {
    let has_geometry = check.geometry.table_compared || check.against.is_some();
    let same = if has_geometry { "SAME GEOMETRY, " } else { "" };
    let not_compared = check.against.as_ref().and_then(|of| of.dynamics_not_compared.as_ref());
    if let Some(why) = not_compared {
        let answer = if check.is_unreadable() { "DYNAMICS NOT READ" } else { "DIFFERENT DYNAMICS" };
        return Headline::new(format!("{same}{answer}"), format!(": {why}"));
    }
    if let Some(ranges) = check.against.as_ref().and_then(|of| of.ranges_differ.as_ref()) {
        return Headline::new(format!("{same}DIFFERENT JOINT LIMITS"), format!(": {ranges}"));
    }
    let Some(report) = check.all_dynamics().find(|report| !report.agrees()) else {
        return Headline::new("DIFFERENT", String::new());
    };
    if !report.has_same_torques() {
        return Headline::new(
            format!("{same}DIFFERENT DYNAMICS"),
            format!(": {}{}", check.cause_of_torques(report), check.other_limits(report)),
        );
    }
    let same = match (has_geometry, report.verdict == DynamicsVerdict::NotCompared) {
        (_, true) => same,
        (true, false) => "SAME GEOMETRY AND DYNAMICS, ",
        (false, false) => "SAME DYNAMICS, ",
    };
    Headline::new(format!("{same}DIFFERENT JOINT LIMITS"), check.limits(report))
}

/// The two sources of a comparison, as its title names them.
fn sources(comparison: &Comparison) -> [&'static str; 2] {
    let (first, second) = comparison.title.split_once(" against ").unwrap_or((comparison.title, ""));
    let short = |source: &'static str| {
        let source = source.strip_suffix(" chain").unwrap_or(source);
        source.strip_suffix(" (POE)").unwrap_or(source)
    };
    [first, second].map(short)
}

/// The sources that were compared: descriptions first, then the physics. Screws that are made of the URDF are no source.
fn sources_of(report: &CheckReport) -> Vec<&'static str> {
    let counts = |of: &&Comparison| of.name != SourcePair::PoeUrdf;
    let mut named: Vec<&str> = Vec::new();
    for source in report.comparisons.iter().filter(counts).flat_map(sources) {
        // "its URDF" has a name already.
        if !named.contains(&source) && source != "physics" && !source.starts_with("its ") {
            named.push(source);
        }
    }
    let has_physics = report.comparisons.iter().flat_map(sources).any(|source| source == "physics");
    named.extend(has_physics.then_some("physics"));
    named
}
