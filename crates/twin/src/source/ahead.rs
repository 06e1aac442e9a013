//! A source that is computed ahead of the run, on a thread of its own: the physics of the next samples and the checks of the
//! present one run at the same time. The samples are the same as without the thread, to the last bit, since nothing that a
//! check finds has an effect on the source; a run that a check may stop does not use this.

use std::sync::{
    atomic::{AtomicBool, Ordering},
    mpsc::{Receiver, Sender, SyncSender, channel, sync_channel},
};

use congruent_description::RobotQ;
use congruent_monitors::{ContactForce, JointSample, JointStateView, SetpointView, StepForces};
use congruent_motion::SlowedMotion;
use nalgebra::Isometry3;

use super::{
    joint_states::{Advance, JointStateSource, SimulatedRobot, SourceError},
    simulation::SimulationSource,
};

/// Samples that are passed on together: waking the other thread takes as long as a step of the physics.
const BATCH: usize = 32;
/// Batches that wait at most. Kind: choice; with fewer a recording that is written now and then makes the physics wait.
const WAITING: usize = 8;

/// The state of a source at one instant.
#[derive(Debug, Default)]
struct SourceState {
    time_s: f64,
    is_last: bool,
    truth: OwnedJoints,
    measured: OwnedJoints,
    setpoint: Option<OwnedSetpoint>,
    root_from_links: Vec<Isometry3<f64>>,
    knows_poses: bool,
    forces: StepForces,
    contact_forces: Vec<ContactForce>,
    slowed: Vec<SlowedMotion>,
}

#[derive(Debug, Default)]
struct OwnedJoints {
    q: RobotQ,
    qd: Vec<f64>,
    effort: Vec<f64>,
}

#[derive(Debug, Default)]
struct OwnedSetpoint {
    joints: OwnedJoints,
    qdd: Vec<f64>,
}

impl OwnedJoints {
    fn copy(&mut self, q: &RobotQ, qd: &[f64], effort: &[f64]) {
        // `clone_from` of positions allocates, and only the first use has another length.
        if self.q.len() == q.len() {
            self.q.copy_from_slice(q);
        } else {
            self.q = q.clone();
        }
        copy(&mut self.qd, qd);
        copy(&mut self.effort, effort);
    }

    fn view(&self) -> JointStateView<'_> {
        JointStateView { q: &self.q, qd: &self.qd, effort: &self.effort }
    }
}

/// Into memory that is there from the second use of a state on.
fn copy<T: Copy>(to: &mut Vec<T>, from: &[T]) {
    to.clear();
    to.extend_from_slice(from);
}

impl SourceState {
    fn take(&mut self, source: &SimulationSource<'_>, time_s: f64, links: usize) {
        let JointSample { truth, measured, setpoint, .. } = source.joints();
        (self.time_s, self.is_last) = (time_s, source.is_last());
        let truth = truth.unwrap_or(measured);
        self.truth.copy(truth.q, truth.qd, truth.effort);
        self.measured.copy(measured.q, measured.qd, measured.effort);
        match setpoint {
            Some(SetpointView { q, qd, qdd, effort }) => {
                let owned = self.setpoint.get_or_insert_default();
                owned.joints.copy(q, qd, effort);
                copy(&mut owned.qdd, qdd);
            }
            None => self.setpoint = None,
        }
        self.root_from_links.resize(links, Isometry3::identity());
        self.knows_poses = source.root_from_links_into(&mut self.root_from_links);
        self.forces = source.step_forces();
        copy(&mut self.contact_forces, source.contact_forces());
        // Motions are added one by one, and stay.
        if self.slowed.len() != source.slowed().len() {
            self.slowed = source.slowed().to_vec();
        }
    }
}

/// States of consecutive instants; memory goes back and forth between the threads.
#[derive(Debug)]
struct StateBatch {
    states: Vec<SourceState>,
    len: usize,
    /// Why no state follows, if the source has failed.
    failure: Option<SourceError>,
}

impl StateBatch {
    fn new() -> Self {
        let states = std::iter::repeat_with(SourceState::default).take(BATCH).collect();
        Self { states, len: 0, failure: None }
    }
}

/// The end of the thread that computes.
#[derive(Debug)]
pub(crate) struct SourceThread {
    batches: SyncSender<StateBatch>,
    used: Receiver<StateBatch>,
    links: usize,
}

impl SourceThread {
    /// Computes until the end, until the source fails, or until the run wants no more. `interrupt` ends it early if set: the run
    /// then still takes all that was computed.
    pub(crate) fn compute(self, source: &mut SimulationSource<'_>, interrupt: Option<&AtomicBool>) {
        let ends = |source: &SimulationSource<'_>| {
            source.is_last() || interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed))
        };
        while !ends(source) {
            let mut batch = self.used.try_recv().unwrap_or_else(|_| StateBatch::new());
            batch.len = 0;
            while batch.len < BATCH && batch.failure.is_none() && !ends(source) {
                let time_s = source.next_s();
                match source.advance(time_s) {
                    Ok(_) => {
                        batch.states[batch.len].take(source, time_s, self.links);
                        batch.len += 1;
                    }
                    Err(error) => batch.failure = Some(error),
                }
            }
            let has_failed = batch.failure.is_some();
            if self.batches.send(batch).is_err() || has_failed {
                return;
            }
        }
    }
}

/// The end of the run: a source whose next states another thread computes.
#[derive(Debug)]
pub(crate) struct SourceAhead {
    batches: Receiver<StateBatch>,
    used: Sender<StateBatch>,
    batch: StateBatch,
    /// Index of the present state in the batch.
    at: usize,
    /// The batch after this one, if it has arrived already.
    next: Option<StateBatch>,
}

/// Both ends, at the present instant of a source of a robot with this number of links.
pub(super) fn ahead_of(
    source: &SimulationSource<'_>,
    time_s: f64,
    links: usize,
) -> (SourceAhead, SourceThread) {
    let (to_run, batches) = sync_channel(WAITING);
    let (used, from_run) = channel();
    let mut batch = StateBatch::new();
    batch.states[0].take(source, time_s, links);
    batch.len = 1;
    let ahead = SourceAhead { batches, used, batch, at: 0, next: None };
    (ahead, SourceThread { batches: to_run, used: from_run, links })
}

impl SourceAhead {
    fn now(&self) -> &SourceState {
        &self.batch.states[self.at]
    }

    /// Ends the thread, which then cannot pass on what it computes.
    pub(crate) fn end(&mut self) {
        self.batches = sync_channel(0).1;
    }

    /// Waits for the next state, or the failure in its place; returns whether there is one.
    pub(crate) fn has_next(&mut self) -> bool {
        if self.at + 1 == self.batch.len && self.batch.failure.is_none() && self.next.is_none() {
            self.next = self.batches.recv().ok();
            return self.next.is_some();
        }
        true
    }
}

impl JointStateSource for SourceAhead {
    fn joints(&self) -> JointSample<'_> {
        let SourceState { truth, measured, setpoint, .. } = self.now();
        let setpoint = setpoint.as_ref().map(|OwnedSetpoint { joints, qdd }| SetpointView {
            q: &joints.q,
            qd: &joints.qd,
            qdd,
            effort: &joints.effort,
        });
        JointSample { truth: Some(truth.view()), measured: measured.view(), setpoint, recorded_effort: &[] }
    }

    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool {
        let state = self.now();
        root_from_links.copy_from_slice(&state.root_from_links);
        state.knows_poses
    }

    /// # Panics
    /// If there is no next state: see [`SourceAhead::has_next`].
    fn advance(&mut self, _wanted_s: f64) -> Result<Advance, SourceError> {
        assert!(self.has_next(), "the run asks whether there is a next state");
        if self.at + 1 < self.batch.len {
            self.at += 1;
            return Ok(Advance::At(self.now().time_s));
        }
        if let Some(next) = self.next.take_if(|next| next.len > 0) {
            let used = std::mem::replace(&mut self.batch, next);
            self.at = 0;
            // The thread may have ended: then nobody needs the memory.
            let _ = self.used.send(used);
            return Ok(Advance::At(self.now().time_s));
        }
        let failure = self.batch.failure.take().or_else(|| self.next.take()?.failure);
        Err(failure.expect("only a batch with a failure has no further state"))
    }

    fn is_last(&self) -> bool {
        self.now().is_last
    }

    fn simulated(&self) -> Option<&dyn SimulatedRobot> {
        Some(self)
    }
}

/// What the checks need of each sample; actuators and servos are those of the simulation, which comes back at the end.
impl SimulatedRobot for SourceAhead {
    fn step_forces(&self) -> StepForces {
        self.now().forces
    }

    fn contact_forces(&self) -> &[ContactForce] {
        &self.now().contact_forces
    }

    fn slowed(&self) -> &[SlowedMotion] {
        &self.now().slowed
    }
}
