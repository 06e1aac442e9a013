//! The comparison of model, URDF and physics without motion: are they the same robot?

use congruent_description::{
    Diagnostic, Finding, JointValues, RobotDescription, RobotQ, Tolerance, display::quantity,
};
use congruent_kinematics::{
    KinematicsError, LinkPoses, Pose, PoseError, ScrewChain, ScrewTree, UrdfTree, sample_configurations,
};

use super::{
    basics::basics,
    certificate::{Brackets, ReportedCertificate, certificates, worst},
    check_report::{
        Agreement, CheckReport, Comparison, DifferenceAt, LinkDifference, NotAsked, TipDifference,
        WorstDifference,
    },
    error::CheckError,
    identified::IdentifiedChain,
    model::{Model, PoseSource},
};
use crate::{
    report::{ReportedDiagnosis, diagnose_models},
    source_pair::SourcePair,
};

/// Further configurations of a check, besides zero, single axes, and limits.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CheckOptions {
    /// Seed of the random configurations.
    pub seed: u64,
    /// Configurations at which the report has the difference.
    pub configurations: Vec<RobotQ>,
}

/// Number of random configurations of a check.
pub const RANDOM_CONFIGURATIONS: usize = 200;

/// Compares model, URDF chain, screws and physics.
///
/// The verdict on the model depends on link `tip`, whose constants are declared. Links in between are
/// compared with a fitted constant and only shown; they follow from the tip: two chains that agree at the
/// tip for every configuration have the same axes.
///
/// `physics` may be the findings for which it cannot be asked: the others are compared, and the report says so.
///
/// # Errors
/// [`CheckError`] if a source rejects the robot.
pub fn check(
    description: &RobotDescription,
    physics: Result<&mut dyn LinkPoses, Vec<Diagnostic>>,
    options: &CheckOptions,
) -> Result<CheckReport, CheckError> {
    let Compared { mut report, identified, configurations } = compared(description, physics, options)?;
    // What is left of sources that agree is the rounding of the identified screws: it has no cause.
    let diagnosed: &[RobotQ] = if report.verdict == Agreement::Agree { &[] } else { &configurations };
    report.set_diagnoses(diagnose_models(description, identified.as_ref(), diagnosed));
    Ok(report)
}

/// A report without a diagnosis, and what a diagnosis starts from.
pub(super) struct Compared {
    pub(super) report: CheckReport,
    /// The chain of the physics.
    pub(super) identified: Option<ScrewChain>,
    /// The configurations that were compared.
    pub(super) configurations: Vec<RobotQ>,
}

/// The comparisons of [`check`], without the cause of a difference.
pub(super) fn compared(
    description: &RobotDescription,
    physics: Result<&mut dyn LinkPoses, Vec<Diagnostic>>,
    options: &CheckOptions,
) -> Result<Compared, CheckError> {
    let robot = &description.robot;
    resolved(description, &options.configurations)?;
    let mut configurations = sample_configurations(robot, options.seed, RANDOM_CONFIGURATIONS);
    let Physics { source, identified, certificates, not_asked } =
        Physics::new(description, physics, &configurations)?;
    let mut sources = LinkPoseSources::new(description, source)?;
    // The worst configurations of the certificates count for the verdict: random ones seldom find them.
    let brackets = certificates.iter().filter_map(|certificate| certificate.brackets.as_ref());
    configurations.extend(brackets.flat_map(|brackets| brackets.attained_at(robot)));
    let mut running = running(description, &sources);
    let requested_from = configurations.len();
    configurations.extend_from_slice(&options.configurations);
    let mut requested = Vec::with_capacity(options.configurations.len());
    for (index, q) in configurations.iter().enumerate() {
        sources.evaluate(q)?;
        let here = running.iter_mut().map(|comparison| comparison.observe(index, &sources));
        let error = here.fold(PoseError::default(), PoseError::larger);
        if index >= requested_from {
            let (q, tip) = (JointValues::of_robot(robot, q), sources.tips(description));
            requested.push(DifferenceAt { q, error, tip });
        }
    }
    let comparisons: Vec<Comparison> =
        running.iter().map(|comparison| comparison.finish(description, &configurations)).collect();
    let brackets = worst(&certificates);
    let report = CheckReport {
        file: description.path.display().to_string(),
        robot: robot.name().to_owned(),
        chain: description.reported_chain(),
        table_compared: description.dh.is_some(),
        verdict: verdict(&comparisons),
        worst: worst_of(&comparisons, &description.tolerance),
        tolerance: description.tolerance,
        replaced_tolerance: None,
        configurations: configurations.len(),
        seed: options.seed,
        comparisons,
        at_configurations: requested,
        basics: basics(description, &configurations)?,
        certificate: brackets.as_ref().map(Brackets::bounds),
        certificate_bracket: brackets,
        certificates,
        diagnosis: Vec::new(),
        indistinguishable: Vec::new(),
        diagnoses: Vec::new(),
        not_asked,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    };
    Ok(Compared { report, identified, configurations })
}

impl CheckReport {
    /// Sets the diagnoses; the first one with a cause is that of the report.
    pub(super) fn set_diagnoses(&mut self, diagnoses: Vec<ReportedDiagnosis>) {
        let named = diagnoses.iter().find(|diagnosis| !diagnosis.causes.is_empty());
        self.diagnosis = named.map(|diagnosis| diagnosis.causes.clone()).unwrap_or_default();
        self.indistinguishable =
            named.map(|diagnosis| diagnosis.indistinguishable.clone()).unwrap_or_default();
        self.diagnoses = diagnoses;
    }
}

/// Refuses positions so large that numbers of their size are further apart than the tolerance.
fn resolved(description: &RobotDescription, configurations: &[RobotQ]) -> Result<(), CheckError> {
    let (robot, tolerance) = (&description.robot, &description.tolerance);
    for (number, q) in (1..).zip(configurations) {
        for (&joint, &position) in robot.movable_joints().iter().zip(q.iter()) {
            let joint = robot.joint(joint);
            let spacing = position.abs().next_up() - position.abs();
            let most = if joint.kind.is_angular() { tolerance.orientation_rad } else { tolerance.position_m };
            if spacing > most {
                let unit = joint.kind.unit();
                let (joint, what) =
                    (joint.name.clone(), [position, spacing, most].map(|it| quantity(it, unit)));
                return Err(CheckError::Unresolved { number, joint, what });
            }
        }
    }
    Ok(())
}

/// The physics and what is known of its chain, or why it was not asked.
struct Physics<'a> {
    source: Option<&'a mut dyn LinkPoses>,
    identified: Option<ScrewChain>,
    certificates: Vec<ReportedCertificate>,
    not_asked: Vec<NotAsked>,
}

impl<'a> Physics<'a> {
    fn new(
        description: &RobotDescription,
        physics: Result<&'a mut dyn LinkPoses, Vec<Diagnostic>>,
        configurations: &[RobotQ],
    ) -> Result<Self, CheckError> {
        let source = match physics {
            Ok(source) => source,
            Err(findings) => {
                let findings = findings.iter().map(Finding::from).collect();
                let not_asked = vec![NotAsked { source: "simulation", findings }];
                let certificates = certificates(description, None)?;
                return Ok(Self { source: None, identified: None, certificates, not_asked });
            }
        };
        let identified = IdentifiedChain::new(description, &mut *source, configurations)?;
        let certificates = certificates(description, Some((&identified, &mut *source)))?;
        let identified = Some(identified.chain);
        Ok(Self { source: Some(source), identified, certificates, not_asked: Vec::new() })
    }
}

/// The comparisons of the sources that were asked.
fn running(description: &RobotDescription, sources: &LinkPoseSources<'_>) -> Vec<RunningComparison> {
    let mut running = Vec::new();
    if description.dh.is_some() {
        let decides = |source| source == PoseSource::Dh;
        let sources = sources.model.sources();
        running.push(RunningComparison::new(SourcePair::ModelUrdf, model_urdf, sources, decides));
    }
    let urdf = vec![PoseSource::Urdf; description.robot.links().len()];
    let all = |_| true;
    running.push(RunningComparison::new(SourcePair::PoeUrdf, poe_urdf, &urdf, all));
    if sources.physics.is_some() {
        running.push(RunningComparison::new(SourcePair::UrdfSimulation, urdf_simulation, &urdf, all));
    }
    running
}

/// Screws are made from the URDF chain: alone they show that two computations agree, not two descriptions.
pub(super) fn verdict(comparisons: &[Comparison]) -> Agreement {
    if comparisons.iter().any(|comparison| comparison.verdict != Agreement::Agree) {
        Agreement::Disagree
    } else if comparisons.iter().any(|comparison| comparison.name != SourcePair::PoeUrdf) {
        Agreement::Agree
    } else {
        Agreement::NothingCompared
    }
}

/// The largest difference of all comparisons, separately in position and in orientation; link and configuration are
/// those of the position, unless the orientation alone is beyond the tolerance.
pub(super) fn worst_of(comparisons: &[Comparison], tolerance: &Tolerance) -> WorstDifference {
    let errors = comparisons.iter().map(|comparison| comparison.worst.error);
    let error = errors.fold(PoseError::default(), PoseError::larger);
    let is_turned_only = is_turned_only(&error, tolerance);
    let size = |error: &PoseError| if is_turned_only { error.orientation_rad } else { error.position_m };
    let mut worst = &comparisons.first().expect("screws are always compared with the URDF").worst;
    for Comparison { worst: other, .. } in comparisons {
        if !(size(&worst.error).is_nan() || size(&other.error) <= size(&worst.error)) {
            worst = other;
        }
    }
    WorstDifference { error, ..worst.clone() }
}

/// Whether the orientation alone is beyond the tolerance, so that its place is the one to name.
fn is_turned_only(worst: &PoseError, tolerance: &Tolerance) -> bool {
    worst.position_m <= tolerance.position_m && !worst.is_within(tolerance)
}

/// Poses of all links at one configuration, by each source.
struct LinkPoseSources<'a> {
    model: Model,
    urdf: UrdfTree,
    screws: ScrewTree,
    physics: Option<&'a mut dyn LinkPoses>,
    by_urdf: Vec<Pose>,
    by_screws: Vec<Pose>,
    by_physics: Vec<Pose>,
}

impl<'a> LinkPoseSources<'a> {
    fn new(
        description: &RobotDescription,
        physics: Option<&'a mut dyn LinkPoses>,
    ) -> Result<Self, KinematicsError> {
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

    fn evaluate(&mut self, q: &RobotQ) -> Result<(), CheckError> {
        self.model.root_from_links(q)?;
        self.urdf.root_from_links_into(q, &mut self.by_urdf)?;
        self.screws.root_from_links_into(q, &mut self.by_screws)?;
        if let Some(physics) = &mut self.physics {
            physics.root_from_links_into(q, &mut self.by_physics)?;
        }
        Ok(())
    }
}

impl LinkPoseSources<'_> {
    /// The tip by each two sources that describe the robot, at the configuration of the last evaluation.
    fn tips(&self, description: &RobotDescription) -> Vec<TipDifference> {
        let (base, tip) = (description.base.get(), description.tip.get());
        // The base is placed by the URDF, which places the table.
        let in_base = |links: &[Pose], base: &Pose| base.inverse() * links[tip];
        let by_urdf = in_base(&self.by_urdf, &self.by_urdf[base]);
        let between = |pair, first: Pose, second: Pose| TipDifference {
            pair,
            first: (&first).into(),
            second: (&second).into(),
            error: PoseError::between(&first, &second),
        };
        let model = description.dh.as_ref().map(|_| in_base(self.model.latest(), &self.by_urdf[base]));
        let model = model.map(|by_model| between(SourcePair::ModelUrdf, by_model, by_urdf));
        let physics = self.physics.as_ref().map(|_| in_base(&self.by_physics, &self.by_physics[base]));
        let physics = physics.map(|by_physics| between(SourcePair::UrdfSimulation, by_urdf, by_physics));
        model.into_iter().chain(physics).collect()
    }
}

/// The difference of two sources at a link.
type Difference = fn(&LinkPoseSources<'_>, usize) -> PoseError;

fn model_urdf(sources: &LinkPoseSources<'_>, link: usize) -> PoseError {
    PoseError::between(&sources.model.latest()[link], &sources.by_urdf[link])
}

fn poe_urdf(sources: &LinkPoseSources<'_>, link: usize) -> PoseError {
    PoseError::between(&sources.by_screws[link], &sources.by_urdf[link])
}

fn urdf_simulation(sources: &LinkPoseSources<'_>, link: usize) -> PoseError {
    PoseError::between(&sources.by_urdf[link], &sources.by_physics[link])
}

/// One comparison with the worst differences so far.
struct RunningComparison {
    pair: SourcePair,
    difference: Difference,
    sources: Vec<PoseSource>,
    /// Whether a link decides the verdict.
    decides: Vec<bool>,
    worst: Vec<PoseError>,
    /// Link and configuration of the largest distance, of the links that decide.
    furthest: (usize, usize),
    /// The same of the largest angle.
    most_turned: (usize, usize),
}

impl RunningComparison {
    fn new(
        pair: SourcePair,
        difference: Difference,
        sources: &[PoseSource],
        decides: impl Fn(PoseSource) -> bool,
    ) -> Self {
        let decides: Vec<bool> = sources.iter().map(|&source| decides(source)).collect();
        let first = decides.iter().position(|&decides| decides).expect("the tip or every link decides");
        Self {
            pair,
            difference,
            sources: sources.to_vec(),
            worst: vec![PoseError::default(); sources.len()],
            decides,
            furthest: (first, 0),
            most_turned: (first, 0),
        }
    }

    /// Adds one configuration; returns the largest difference there of the links that decide.
    fn observe(&mut self, configuration: usize, sources: &LinkPoseSources<'_>) -> PoseError {
        let mut here = PoseError::default();
        for link in 0..self.worst.len() {
            let error = (self.difference)(sources, link);
            if self.decides[link] {
                here = here.larger(error);
                if error.position_m > self.worst[self.furthest.0].position_m {
                    self.furthest = (link, configuration);
                }
                if error.orientation_rad > self.worst[self.most_turned.0].orientation_rad {
                    self.most_turned = (link, configuration);
                }
            }
            self.worst[link] = self.worst[link].larger(error);
        }
        here
    }

    fn finish(&self, description: &RobotDescription, configurations: &[RobotQ]) -> Comparison {
        let robot = &description.robot;
        let deciding = || self.worst.iter().zip(&self.decides).filter(|(_, decides)| **decides);
        let worst = deciding().fold(PoseError::default(), |worst, (error, _)| worst.larger(*error));
        let agrees = worst.is_within(&description.tolerance);
        let is_turned_only = is_turned_only(&worst, &description.tolerance);
        let (link, configuration) = if is_turned_only { self.most_turned } else { self.furthest };
        let links = robot.links().iter().zip(&self.sources).zip(&self.worst);
        Comparison {
            name: self.pair,
            title: self.pair.title(),
            verdict: if agrees { Agreement::Agree } else { Agreement::Disagree },
            worst: WorstDifference {
                error: worst,
                link: robot.links()[link].name.clone(),
                at: JointValues::of_robot(robot, &configurations[configuration]),
            },
            links: links
                .map(|((link, &source), worst)| LinkDifference {
                    link: link.name.clone(),
                    source,
                    error: *worst,
                })
                .collect(),
        }
    }
}
