//! Model against URDF against twin, without motion: are they the same robot? Why they are not is the
//! business of `ladder/`.

use congruent_description::{Finding, NamedValue, RobotDescription, Tolerance, as_map};
use congruent_kinematics::{
    KinematicsError, LinkPoses, LinkPosesError, Pose, PoseError, ScrewTree, UrdfTree, larger,
    probe_configurations,
};
use serde::Serialize;

use super::{
    basics::{Basics, basics},
    certificate::{Bounds, Brackets, ReportedCertificate, certificates, worst},
    identified::Probed,
    model::{Model, PoseSource},
};
use crate::report::{Ladder, ReportedAlternative, ReportedCause, climb};

/// Why two witnesses cannot be held against each other.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// A source of link poses refuses a configuration.
    #[error(transparent)]
    Source(#[from] LinkPosesError),
    /// The model does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
}

/// Whether witnesses tell of the same robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Agreement {
    /// Within tolerance at every configuration.
    Agree,
    /// Beyond tolerance somewhere.
    Disagree,
}

/// The largest differences with their places; the two need not be at the same configuration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Worst {
    /// Largest distance of the origins of a link.
    pub position_m: f64,
    /// Largest angle between the orientations of a link.
    pub orientation_rad: f64,
    /// The link that is furthest off in position.
    pub link: String,
    /// The configuration at which it is: every movable joint, rad or m.
    #[serde(serialize_with = "as_map")]
    pub at: Vec<NamedValue>,
}

/// Two witnesses against each other.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Which two: `model_urdf`, `poe_urdf` or `urdf_simulation`.
    pub name: &'static str,
    /// The same in words.
    pub title: &'static str,
    /// Whether the links that decide are within tolerance.
    pub verdict: Agreement,
    /// The worst over the links that decide.
    pub worst: Worst,
    /// The worst at each link.
    pub links: Vec<LinkDifference>,
}

/// The largest difference at one link.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LinkDifference {
    /// The link.
    pub link: String,
    /// Where the first witness's pose comes from.
    pub source: PoseSource,
    /// Largest distance of the origins.
    pub position_m: f64,
    /// Largest angle between the orientations.
    pub orientation_rad: f64,
}

/// The answer of `congruent check` for one robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckReport {
    /// Name of the robot.
    pub robot: String,
    /// Whether all witnesses agree.
    pub verdict: Agreement,
    /// The worst of all comparisons.
    pub worst: Worst,
    /// When two poses count as the same.
    pub tolerance: ReportedTolerance,
    /// Number of configurations: zero, single axes, random ones, limits, the worst of each certificate.
    pub configurations: usize,
    /// Seed of the random ones.
    pub seed: u64,
    /// Two witnesses at a time.
    pub comparisons: Vec<Comparison>,
    /// The worst of all comparisons at each configuration that was asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub at_configurations: Vec<DifferenceAt>,
    /// What a person tries first: zero, one axis at a time, whether the transforms are rigid.
    pub basics: Basics,
    /// How far models are apart at most, over the whole joint range: the largest of `certificates`.
    pub certificate: Option<Bounds>,
    /// The same with configurations that come near.
    pub certificate_bracket: Option<Brackets>,
    /// Two models of the chain at a time.
    pub certificates: Vec<ReportedCertificate>,
    /// The likeliest cause of a disagreement, then what comes next and leaves more: that of the
    /// first ladder that has one.
    pub diagnosis: Vec<ReportedCause>,
    /// Causes that leave as little as the first.
    pub indistinguishable: Vec<ReportedAlternative>,
    /// The agreement ladder between two models of the chain at a time.
    pub ladders: Vec<Ladder>,
    /// What was suspicious in the input.
    pub warnings: Vec<Finding>,
}

/// A tolerance as programs read it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ReportedTolerance {
    /// Distance of the origins.
    pub position_m: f64,
    /// Angle between the orientations.
    pub orientation_rad: f64,
}

/// How far witnesses are apart at one configuration that was asked for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DifferenceAt {
    /// The configuration: every movable joint, rad or m.
    #[serde(serialize_with = "as_map")]
    pub q: Vec<NamedValue>,
    /// Largest distance of the origins of a link that decides.
    pub position_m: f64,
    /// Largest angle between the orientations of such a link.
    pub orientation_rad: f64,
}

/// What a check asks beside zero, single axes, and limits.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CheckOptions {
    /// Seed of the random configurations.
    pub seed: u64,
    /// Further configuration vectors of the robot; the report has the difference at each.
    pub configurations: Vec<Vec<f64>>,
}

/// Random configurations of a check.
pub const RANDOM_CONFIGURATIONS: usize = 200;

/// Holds model, URDF chain, screws and physics against each other.
///
/// The model is judged at link `tip`, whose constants are declared; links between are compared
/// with a fitted constant, shown, and follow from the tip: two chains that agree at the tip for
/// every configuration have the same axes.
///
/// # Errors
/// [`CheckError`] where a witness refuses the robot.
pub fn check(
    description: &RobotDescription,
    physics: &mut dyn LinkPoses,
    options: &CheckOptions,
) -> Result<CheckReport, CheckError> {
    let robot = &description.robot;
    let mut configurations = probe_configurations(robot, options.seed, RANDOM_CONFIGURATIONS);
    let mut witnesses = Witnesses::new(description, physics)?;
    let probed = Probed::new(description, witnesses.physics, &configurations)?;
    let certificates = certificates(description, &probed, witnesses.physics)?;
    // What the certificates have found counts: a draw seldom meets the worst.
    let brackets = certificates.iter().filter_map(|certificate| certificate.brackets.as_ref());
    configurations.extend(brackets.flat_map(|brackets| brackets.attained_at(robot)));
    let mut tallies = Vec::new();
    if description.dh.is_some() {
        let decides = |source| source == PoseSource::Dh;
        let sources = witnesses.model.sources();
        tallies.push(Tally::new("model_urdf", "DH table against URDF chain", model_urdf, sources, decides));
    }
    let urdf = vec![PoseSource::Urdf; robot.links().len()];
    let all = |_| true;
    tallies.push(Tally::new("poe_urdf", "screws (POE) against URDF chain", poe_urdf, &urdf, all));
    tallies.push(Tally::new("urdf_simulation", "URDF chain against physics", urdf_simulation, &urdf, all));
    let asked_from = configurations.len();
    configurations.extend_from_slice(&options.configurations);
    let mut asked = Vec::with_capacity(options.configurations.len());
    for (index, q) in configurations.iter().enumerate() {
        witnesses.look(q)?;
        let here = tallies.iter_mut().map(|tally| tally.observe(index, &witnesses));
        let PoseError { position_m, orientation_rad } = here.fold(PoseError::default(), PoseError::larger);
        if index >= asked_from {
            asked.push(DifferenceAt { q: named(description, q), position_m, orientation_rad });
        }
    }
    let comparisons: Vec<Comparison> =
        tallies.iter().map(|tally| tally.finish(description, &configurations)).collect();
    let ladders = climb(description, &probed.chain, &configurations);
    let named = ladders.iter().find(|ladder| !ladder.diagnosis.is_empty());
    let agree = comparisons.iter().all(|comparison| comparison.verdict == Agreement::Agree);
    let brackets = worst(&certificates);
    let Tolerance { position_m, orientation_rad: angle } = description.tolerance;
    Ok(CheckReport {
        robot: robot.name().to_owned(),
        verdict: if agree { Agreement::Agree } else { Agreement::Disagree },
        worst: worst_of(&comparisons),
        tolerance: ReportedTolerance { position_m, orientation_rad: angle },
        configurations: configurations.len(),
        seed: options.seed,
        comparisons,
        at_configurations: asked,
        basics: basics(description, &configurations)?,
        certificate: brackets.as_ref().map(Brackets::bounds),
        certificate_bracket: brackets,
        certificates,
        diagnosis: named.map(|ladder| ladder.diagnosis.clone()).unwrap_or_default(),
        indistinguishable: named.map(|ladder| ladder.indistinguishable.clone()).unwrap_or_default(),
        ladders,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    })
}

/// The largest difference of all comparisons, position and orientation each for itself.
fn worst_of(comparisons: &[Comparison]) -> Worst {
    let larger = |a: Worst, b: Worst| {
        let orientation_rad = larger(a.orientation_rad, b.orientation_rad);
        let furthest = if a.position_m.is_nan() || b.position_m <= a.position_m { a } else { b };
        Worst { orientation_rad, ..furthest }
    };
    let worst = comparisons.iter().map(|comparison| comparison.worst.clone());
    worst.reduce(larger).expect("screws and physics are always held against the URDF")
}

/// All poses at one configuration, by each source.
struct Witnesses<'a> {
    model: Model,
    urdf: UrdfTree,
    screws: ScrewTree,
    physics: &'a mut dyn LinkPoses,
    by_urdf: Vec<Pose>,
    by_screws: Vec<Pose>,
    by_physics: Vec<Pose>,
}

impl<'a> Witnesses<'a> {
    fn new(description: &RobotDescription, physics: &'a mut dyn LinkPoses) -> Result<Self, KinematicsError> {
        let robot = &description.robot;
        let links = robot.links().len();
        Ok(Self {
            model: Model::new(description)?,
            urdf: UrdfTree::new(robot),
            screws: ScrewTree::new(robot),
            physics,
            by_urdf: vec![Pose::identity(); links],
            by_screws: vec![Pose::identity(); links],
            by_physics: vec![Pose::identity(); links],
        })
    }

    fn look(&mut self, q: &[f64]) -> Result<(), CheckError> {
        self.model.root_from_links(q)?;
        self.urdf.root_from_links_into(q, &mut self.by_urdf)?;
        self.screws.root_from_links_into(q, &mut self.by_screws)?;
        self.physics.root_from_links_into(q, &mut self.by_physics)?;
        Ok(())
    }
}

/// One pair of witnesses: their difference at a link.
type Difference = fn(&Witnesses<'_>, usize) -> PoseError;

fn model_urdf(witnesses: &Witnesses<'_>, link: usize) -> PoseError {
    PoseError::between(&witnesses.model.latest()[link], &witnesses.by_urdf[link])
}

fn poe_urdf(witnesses: &Witnesses<'_>, link: usize) -> PoseError {
    PoseError::between(&witnesses.by_screws[link], &witnesses.by_urdf[link])
}

fn urdf_simulation(witnesses: &Witnesses<'_>, link: usize) -> PoseError {
    PoseError::between(&witnesses.by_urdf[link], &witnesses.by_physics[link])
}

/// The worst of one comparison so far.
struct Tally {
    name: &'static str,
    title: &'static str,
    difference: Difference,
    sources: Vec<PoseSource>,
    /// Whether a link decides the verdict.
    decides: Vec<bool>,
    worst: Vec<PoseError>,
    /// Link and configuration furthest off in position, of those that decide.
    furthest: (usize, usize),
}

impl Tally {
    fn new(
        name: &'static str,
        title: &'static str,
        difference: Difference,
        sources: &[PoseSource],
        decides: impl Fn(PoseSource) -> bool,
    ) -> Self {
        let decides: Vec<bool> = sources.iter().map(|&source| decides(source)).collect();
        let first = decides.iter().position(|&decides| decides).expect("the tip or every link decides");
        Self {
            name,
            title,
            difference,
            sources: sources.to_vec(),
            worst: vec![PoseError::default(); sources.len()],
            decides,
            furthest: (first, 0),
        }
    }

    /// Looks at one configuration; gives the largest difference there of the links that decide.
    fn observe(&mut self, configuration: usize, witnesses: &Witnesses<'_>) -> PoseError {
        let mut here = PoseError::default();
        for link in 0..self.worst.len() {
            let error = (self.difference)(witnesses, link);
            if self.decides[link] {
                here = here.larger(error);
                if error.position_m > self.worst[self.furthest.0].position_m {
                    self.furthest = (link, configuration);
                }
            }
            self.worst[link] = self.worst[link].larger(error);
        }
        here
    }

    fn finish(&self, description: &RobotDescription, configurations: &[Vec<f64>]) -> Comparison {
        let robot = &description.robot;
        let deciding = || self.worst.iter().zip(&self.decides).filter(|(_, decides)| **decides);
        let worst = deciding().fold(PoseError::default(), |worst, (error, _)| worst.larger(*error));
        let PoseError { position_m, orientation_rad } = worst;
        let Tolerance { position_m: most_m, orientation_rad: most_rad } = description.tolerance;
        let agrees = position_m <= most_m && orientation_rad <= most_rad;
        let (link, configuration) = self.furthest;
        let links = robot.links().iter().zip(&self.sources).zip(&self.worst);
        Comparison {
            name: self.name,
            title: self.title,
            verdict: if agrees { Agreement::Agree } else { Agreement::Disagree },
            worst: Worst {
                position_m,
                orientation_rad,
                link: robot.links()[link].name.clone(),
                at: named(description, &configurations[configuration]),
            },
            links: links
                .map(|((link, &source), worst)| LinkDifference {
                    link: link.name.clone(),
                    source,
                    position_m: worst.position_m,
                    orientation_rad: worst.orientation_rad,
                })
                .collect(),
        }
    }
}

fn named(description: &RobotDescription, q: &[f64]) -> Vec<NamedValue> {
    let robot = &description.robot;
    let value = |(joint, &value): (&str, _)| NamedValue { joint: joint.to_owned(), value };
    robot.movable_joint_names().zip(q).map(value).collect()
}
