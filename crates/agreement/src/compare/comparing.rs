//! The comparisons of a check while they run: the poses of all links by each source, at one configuration after the
//! other.

use congruent_description::{JointValues, RobotDescription, RobotQ, Tolerance};
use congruent_kinematics::{KinematicsError, LinkPoses, Pose, PoseError, ScrewTree, UrdfTree};

use super::{
    check_report::{Agreement, Comparison, LinkDifference, TipDifference, WorstDifference},
    error::CheckError,
    model::{Model, PoseSource},
};
use crate::source_pair::SourcePair;

/// All sources of a check, and the largest differences so far.
pub(super) struct Comparing<'a> {
    sources: LinkPoseSources<'a>,
    running: Vec<RunningComparison>,
}

impl<'a> Comparing<'a> {
    /// Nothing is compared yet; `physics` may be any source of link poses to compare with the URDF.
    pub(super) fn new(
        description: &RobotDescription,
        physics: Option<Box<dyn LinkPoses + 'a>>,
    ) -> Result<Self, KinematicsError> {
        let sources = LinkPoseSources::new(description, physics)?;
        Ok(Self { running: running(description, &sources), sources })
    }

    /// Adds one configuration; returns the largest difference there of the links that decide.
    pub(super) fn observe(&mut self, index: usize, q: &RobotQ) -> Result<PoseError, CheckError> {
        self.sources.evaluate(q)?;
        let here = self.running.iter_mut().map(|comparison| comparison.observe(index, &self.sources));
        Ok(here.fold(PoseError::default(), PoseError::larger))
    }

    /// The tip by each two sources that describe the robot, at the configuration of the last observation.
    pub(super) fn tips(&self, description: &RobotDescription) -> Vec<TipDifference> {
        self.sources.tips(description)
    }

    /// The configurations of the largest differences, by the index of their observation.
    pub(super) fn worst_at(&self) -> impl Iterator<Item = usize> + '_ {
        self.running.iter().flat_map(|comparison| [comparison.furthest.1, comparison.most_turned.1])
    }

    /// The finished comparisons; `at` gives the configuration of an observation.
    pub(super) fn finish(
        &self,
        description: &RobotDescription,
        at: impl Fn(usize) -> RobotQ,
    ) -> Vec<Comparison> {
        self.running.iter().map(|comparison| comparison.finish(description, &at)).collect()
    }
}

/// The comparisons of all sources that there are.
fn running(description: &RobotDescription, sources: &LinkPoseSources<'_>) -> Vec<RunningComparison> {
    let mut running = Vec::new();
    if description.dh.is_some() {
        // Links with a fitted constant do not decide: their constant would hide an error at zero, and the tip,
        // whose constants are declared, has all errors of the rows.
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

/// Whether the orientation alone is beyond the tolerance, so that its place is the one to name.
pub(super) fn is_turned_only(worst: &PoseError, tolerance: &Tolerance) -> bool {
    worst.position_m <= tolerance.position_m && !worst.is_within(tolerance)
}

/// Poses of all links at one configuration, by each source.
struct LinkPoseSources<'a> {
    model: Model,
    urdf: UrdfTree,
    screws: ScrewTree,
    physics: Option<Box<dyn LinkPoses + 'a>>,
    by_urdf: Vec<Pose>,
    by_screws: Vec<Pose>,
    by_physics: Vec<Pose>,
}

impl<'a> LinkPoseSources<'a> {
    fn new(
        description: &RobotDescription,
        physics: Option<Box<dyn LinkPoses + 'a>>,
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
        // Relative to the base, as a table gives it. The base of the table is placed by the URDF.
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
type LinkErrorFn = fn(&LinkPoseSources<'_>, usize) -> PoseError;

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
    difference: LinkErrorFn,
    sources: Vec<PoseSource>,
    /// Whether a link decides the verdict.
    decides: Vec<bool>,
    worst: Vec<PoseError>,
    /// Link and configuration of the largest distance, of the links that decide.
    furthest: (usize, usize),
    /// Link and configuration of the largest angle, of the links that decide.
    most_turned: (usize, usize),
}

impl RunningComparison {
    fn new(
        pair: SourcePair,
        difference: LinkErrorFn,
        sources: &[PoseSource],
        decides: impl Fn(PoseSource) -> bool,
    ) -> Self {
        let decides: Vec<bool> = sources.iter().map(|&source| decides(source)).collect();
        // Some link has to be named even if all agree exactly.
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
                // Before `worst` of this link is updated below: the comparison is with the largest so far.
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

    fn finish(&self, description: &RobotDescription, at: impl Fn(usize) -> RobotQ) -> Comparison {
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
                at: JointValues::for_movable_joints(robot, &at(configuration)),
                at_in_other: JointValues::default(),
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
