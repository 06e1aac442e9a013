//! The run loop: a source of joint states, comparison with the model, clearance, checks and recording, one
//! sample after another. It does not know what the source is.

mod observer;
mod run_loop;

pub use observer::RunObserver;

use std::sync::atomic::AtomicBool;

use congruent_agreement::compare::Model;
use congruent_kinematics::{KinematicsError, Pose, PoseError, UrdfTree};
use congruent_monitors::{
    Interruption, Names, PoseChange, PoseSample, Recorder, RunningCheck, SameInput, Sample, SampleStore,
    StepForces, verdict::CheckValue,
};
use congruent_proximity::{Clearance, MovingBodies, PairChoice};
use nalgebra::Isometry3;
use sha2::{Digest, Sha256};

use crate::{
    outcome::RunError,
    same_poses::are_same,
    setup::RunSetup,
    source::{
        Advance, JointStateSource, RecordedSource, RunSource, SimulatedRobot, SimulationSource, SourcePose,
        longer_s,
    },
    stopping::Stopping,
};

/// A run in progress. [`Run::finish`] does all of it; the stages are public so that a benchmark can
/// time each of them.
pub struct Run<'a> {
    setup: &'a RunSetup,
    source: RunSource<'a>,
    /// Number of samples after the first.
    step: u64,
    /// Time of the first sample.
    start_s: f64,
    /// Time of the present sample.
    time_s: f64,
    /// Time from the sample before; `None` for the first, and after a gap.
    since_s: Option<f64>,
    model: Model,
    /// Of the instants of poses, if the source has some: that of the samples keeps its latest poses.
    model_of_poses: Option<Model>,
    /// Computes the poses of the links for a source that has joint states only.
    tree: UrdfTree,
    clearance: Clearance,
    bodies: MovingBodies<'a>,
    zones: Clearance,
    names: Names,
    root_from_links: Vec<Isometry3<f64>>,
    /// At the sample before.
    links_before: Vec<Isometry3<f64>>,
    /// What the poses of the model were computed from.
    modelled: SameInput,
    /// Whether poses of the model or of the twin differ from the sample before.
    change: PoseChange,
    by_tree: Vec<Pose>,
    errors: Vec<PoseError>,
    /// What the checks have measured at this instant.
    values: Vec<CheckValue>,
    hash: Sha256,
    store: SampleStore,
    /// The motion to rest, from the first violation of a check that stops the run.
    stopping: Option<Stopping>,
    /// Whether the run ends with the present sample.
    ends: bool,
    /// Set by whoever wants the run to end.
    interrupt: Option<&'a AtomicBool>,
    /// Whether the simulation may be computed ahead, on a thread of its own.
    may_compute_ahead: bool,
    /// Who answers each sample.
    observer: Option<Box<dyn RunObserver + 'a>>,
}

impl std::fmt::Debug for Run<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Run")
            .field("scenario", &self.setup.scenario.name)
            .field("steps", &self.step)
            .finish_non_exhaustive()
    }
}

impl<'a> Run<'a> {
    /// A run of the log that the scenario names, or else of the simulation that it describes.
    ///
    /// # Errors
    /// [`RunError`] if the robot cannot be simulated, or the log cannot be read.
    pub fn new(setup: &'a RunSetup) -> Result<Self, RunError> {
        if let Some(recorded) = &setup.recorded {
            let source = RecordedSource::new(recorded, &setup.description.robot, &setup.start)?;
            return Self::with_source(setup, Box::new(source));
        }
        Self::new_with(setup, RunSource::Simulation(Box::new(SimulationSource::new(setup)?)))
    }

    /// A run whose joint states come from another source.
    ///
    /// # Errors
    /// [`RunError`] if the model does not fit the robot, or a collision shape has no hull.
    pub fn with_source(
        setup: &'a RunSetup,
        source: Box<dyn JointStateSource + 'a>,
    ) -> Result<Self, RunError> {
        Self::new_with(setup, RunSource::Given(source))
    }

    fn new_with(setup: &'a RunSetup, source: RunSource<'a>) -> Result<Self, RunError> {
        let robot = &setup.description.robot;
        let links = robot.links().len();
        let mobility = setup.mobility();
        let clearance =
            Clearance::with_moving(&setup.description, &setup.obstacles, &mobility, PairChoice::Usual)?;
        // With the hulls of the links, which take long to build for large meshes.
        let zones = clearance.before_zones(&setup.zones)?;
        Ok(Self {
            setup,
            step: 0,
            start_s: source.start_s(),
            time_s: source.start_s(),
            since_s: None,
            source,
            model: Model::new(&setup.description)?,
            model_of_poses: (!setup.poses().is_empty())
                .then(|| Model::new(&setup.description))
                .transpose()?,
            tree: UrdfTree::new(robot),
            names: Names::new(robot, &clearance, &zones),
            clearance,
            bodies: MovingBodies::new(&setup.bodies, &setup.obstacles),
            zones,
            root_from_links: vec![Isometry3::identity(); links],
            links_before: vec![Isometry3::identity(); links],
            modelled: SameInput::default(),
            change: PoseChange::Moved,
            by_tree: vec![Pose::identity(); links],
            errors: vec![PoseError::default(); links],
            values: Vec::new(),
            hash: Sha256::new(),
            store: SampleStore::new(robot.dof(), links, setup.clock.steps),
            stopping: None,
            ends: false,
            interrupt: None,
            may_compute_ahead: true,
            observer: None,
        })
    }

    /// The same run, which ends in order after the step in which `flag` is set, with [`RunError::Interrupted`].
    #[must_use]
    pub fn interrupted_by(mut self, flag: Option<&'a AtomicBool>) -> Self {
        self.interrupt = flag;
        self
    }

    /// The same run on the thread of the caller alone: for many runs at once, which need no second thread each.
    #[must_use]
    pub fn on_one_thread(mut self) -> Self {
        self.may_compute_ahead = false;
        self
    }

    /// The same run, of which `observer` sees each sample after its checks.
    #[must_use]
    pub fn observed_by(mut self, observer: Box<dyn RunObserver + 'a>) -> Self {
        self.observer = Some(observer);
        self
    }

    /// The checked scenario of this run.
    pub fn setup(&self) -> &'a RunSetup {
        self.setup
    }

    /// Whether the joint states are those of a simulation.
    pub fn is_simulated(&self) -> bool {
        self.source.simulated().is_some()
    }

    /// Names for the numbers of samples.
    pub fn names(&self) -> &Names {
        &self.names
    }

    /// The analytical model that the twin is compared with.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Samples that were kept for a diagnosis, and the distances that the run measures.
    pub fn samples_and_clearance(&mut self) -> (&SampleStore, &mut Clearance) {
        (&self.store, &mut self.clearance)
    }

    /// By how much the motions end later than planned, as far as it is known by now.
    fn longer_s(&self) -> f64 {
        self.source.simulated().map_or(0.0, |simulated| longer_s(simulated.slowed()))
    }

    /// Advances the source to its next sample; returns whether there is one.
    ///
    /// # Errors
    /// [`RunError::Source`] if the source fails.
    pub fn step(&mut self) -> Result<bool, RunError> {
        let wanted_s = self.setup.clock.time_s(self.step + 1);
        let mut is_after_gap = false;
        loop {
            match self.source.advance(wanted_s)? {
                Advance::At(time_s) => {
                    self.since_s = (!is_after_gap).then_some(time_s - self.time_s);
                    self.time_s = time_s;
                    self.step += 1;
                    return Ok(true);
                }
                Advance::Gap { .. } => is_after_gap = true,
                Advance::End => return Ok(false),
            }
        }
    }

    /// Poses of all links by the model and by the twin at this instant, and their differences.
    ///
    /// # Errors
    /// [`KinematicsError`] if the source gives no configuration of the robot.
    pub fn compare(&mut self) -> Result<(), KinematicsError> {
        std::mem::swap(&mut self.root_from_links, &mut self.links_before);
        let joints = self.source.joints();
        // Poses of the source come first: those of a simulation are its own kinematics, and comparing them is what a
        // twin is for.
        if !self.source.root_from_links_into(&mut self.root_from_links) {
            self.tree.root_from_links_into(joints.state().q, &mut self.by_tree)?;
            for (isometry, pose) in self.root_from_links.iter_mut().zip(&self.by_tree) {
                *isometry = pose.to_isometry();
            }
        }
        // The model gets what the encoders say, the twin is where the joints truly are: their difference is what
        // encoder faults cause.
        let is_modelled = self.modelled.repeats(0, [joints.measured.q]);
        if is_modelled && are_same(&self.root_from_links, &self.links_before) {
            self.change = PoseChange::AsBefore;
            return Ok(());
        }
        self.change = PoseChange::Moved;
        let model: &[Pose] = self.model.root_from_links(joints.measured.q)?;
        for ((error, model), twin) in self.errors.iter_mut().zip(model).zip(&self.root_from_links) {
            *error = PoseError::to_isometry(model, twin);
        }
        Ok(())
    }

    /// Passes this instant to all checks and to the recorder; returns whether the run ends with it.
    ///
    /// # Errors
    /// [`RunError::Recording`] if the recorder cannot write.
    pub fn observe(
        &mut self,
        checks: &mut [RunningCheck<'_>],
        recorder: &mut dyn Recorder,
    ) -> Result<bool, RunError> {
        self.observe_poses(checks)?;
        // Before the checks: they ask for distances at this instant.
        self.move_bodies();
        // A stop makes the run longer or shorter, and only `ends` below knows which sample is its last.
        let is_last = self.source.is_last() && self.stopping.is_none();
        let mut sample = self.sample();
        sample.is_last = is_last;
        let time_s = sample.time_s;
        for check in checks.iter_mut() {
            check.monitor.observe(&mut sample);
        }
        self.values.clear();
        for (check, running) in checks.iter().enumerate() {
            running.values(time_s, &mut |kind, of| self.values.push(CheckValue { check, kind, of }));
        }
        // The stop begins after the checks of its sample, so that the report names the instant of the violation.
        let ends = self.ends(checks);
        // Bits of the positions in a fixed byte order: equal hashes mean equal motions on any machine.
        for q in self.source.joints().state().q {
            self.hash.update(q.to_le_bytes());
        }
        let (mut sample, store) = self.sample_and_store();
        sample.is_last = ends;
        sample.violated_checks = checks.iter().filter(|check| check.monitor.has_failed()).count();
        store.take(&sample);
        recorder.record(&mut sample)?;
        self.ends = ends;
        self.answer(checks)?;
        Ok(ends)
    }

    /// Passes this instant and the checks to the observer.
    fn answer(&mut self, checks: &[RunningCheck<'_>]) -> Result<(), RunError> {
        let Some(mut observer) = self.observer.take() else { return Ok(()) };
        let names = std::mem::take(&mut self.names);
        let ends = self.ends;
        let mut sample = self.sample();
        sample.is_last = ends;
        sample.violated_checks = checks.iter().filter(|check| check.monitor.has_failed()).count();
        let answered = observer.observe(&mut sample, checks, &names);
        (self.names, self.observer) = (names, Some(observer));
        Ok(answered?)
    }

    /// What is between the sample before and the present one.
    fn interruption(&self) -> Option<Interruption> {
        if self.step == 0 || self.since_s.is_some() {
            return None;
        }
        Some(if self.source.begins_part() { Interruption::NewPart } else { Interruption::Gap })
    }

    /// Passes the poses up to this instant to all checks.
    fn observe_poses(&mut self, checks: &mut [RunningCheck<'_>]) -> Result<(), KinematicsError> {
        let Some(model) = &mut self.model_of_poses else { return Ok(()) };
        while let Some(SourcePose { of, time_s, frame_from_target, q }) = self.source.next_pose() {
            let root_from_links = model.root_from_links(q)?;
            let pose = PoseSample { of, time_s, frame_from_target, q, root_from_links };
            for check in checks.iter_mut() {
                check.monitor.observe_pose(&pose);
            }
        }
        Ok(())
    }

    /// Moves links and obstacles to where they are at this instant.
    fn move_bodies(&mut self) {
        // Bodies before links: a carried body needs the pose of its link now, and both take effect in `move_links`.
        self.bodies.advance(self.time_s, |link| self.root_from_links[link.get()]);
        self.bodies.move_in(&mut self.clearance);
        self.clearance.move_links(&self.root_from_links);
        self.zones.move_links(&self.root_from_links);
    }

    fn sample(&mut self) -> Sample<'_> {
        self.sample_and_store().0
    }

    /// This instant, as if more followed, and the store for the diagnosis.
    fn sample_and_store(&mut self) -> (Sample<'_>, &mut SampleStore) {
        let motions_s = self.setup.trajectory.duration_s() + self.longer_s();
        let simulated = self.source.simulated();
        let sample = Sample {
            step: self.step,
            time_s: self.time_s,
            since_s: self.since_s,
            left_out: self.source.left_out(),
            left_out_after: self.source.left_out_after(),
            interruption: self.interruption(),
            motions_s,
            change: self.change,
            is_last: false,
            is_stopping: self.stopping.is_some(),
            violated_checks: 0,
            joints: self.source.joints(),
            forces: simulated.map_or(StepForces::Unknown, SimulatedRobot::step_forces),
            contact_forces: simulated.map_or(&[], SimulatedRobot::contact_forces),
            model: self.model.latest(),
            twin: &self.root_from_links,
            values: &self.values,
            errors: &self.errors,
            clearance: &mut self.clearance,
            bodies: &self.bodies,
            zones: &mut self.zones,
        };
        (sample, &mut self.store)
    }

    /// Whether the run ends here: at its end, or where the arm is at rest after a violation. The first violation of a check
    /// that stops the run begins the motion to rest.
    fn ends(&mut self, checks: &[RunningCheck<'_>]) -> bool {
        let description = &self.setup.description;
        let root_from_tip = self.root_from_links[description.tip.get()];
        let root_from_tcp = description.tip_from_tcp.map_or(root_from_tip, |tcp| root_from_tip * tcp);
        let tcp_in_root = root_from_tcp.translation.vector;
        // Only the first violation starts a stop: a later one must not start it again from a slower state.
        if self.stopping.is_none() {
            let Some(check) = checks.iter().position(RunningCheck::stops) else {
                return self.source.is_last();
            };
            let q = self.source.joints().state().q.clone();
            let mut stopping = Stopping::new(check, self.step, self.time_s, q, tcp_in_root);
            stopping.can_stop = self.source.simulated_mut().is_some_and(SimulatedRobot::begin_stop);
            self.stopping = Some(stopping);
        }
        let joints = self.source.joints();
        self.stopping.as_mut().is_none_or(|stopping| stopping.ends(self.time_s, &joints, tcp_in_root))
    }
}
