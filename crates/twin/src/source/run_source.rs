//! The source of a run, where it is computed.

use std::ops::{Deref, DerefMut};

use super::{
    ahead::{SourceAhead, SourceThread, ahead_of},
    joint_states::JointStateSource,
    simulation::SimulationSource,
};

/// A source of joint states. Only the run's own simulation is known to work on another thread.
pub(crate) enum RunSource<'a> {
    Simulation(Box<SimulationSource<'a>>),
    /// Of somebody else.
    Given(Box<dyn JointStateSource + 'a>),
    /// The simulation, as another thread computes it.
    Ahead(Box<SourceAhead>),
}

impl<'a> RunSource<'a> {
    /// Takes the states of a simulation, now at `time_s`, from a thread that has yet to begin; returns both. `None` for another source.
    pub(crate) fn compute_ahead(
        &mut self,
        time_s: f64,
        links: usize,
    ) -> Option<(Box<SimulationSource<'a>>, SourceThread)> {
        let Self::Simulation(simulation) = self else { return None };
        let (ahead, thread) = ahead_of(simulation, time_s, links);
        match std::mem::replace(self, Self::Ahead(Box::new(ahead))) {
            Self::Simulation(simulation) => Some((simulation, thread)),
            Self::Given(_) | Self::Ahead(_) => None,
        }
    }
}

impl<'a> Deref for RunSource<'a> {
    type Target = dyn JointStateSource + 'a;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Simulation(source) => &**source,
            Self::Given(source) => &**source,
            Self::Ahead(source) => &**source,
        }
    }
}

impl DerefMut for RunSource<'_> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        match self {
            Self::Simulation(source) => &mut **source,
            Self::Given(source) => &mut **source,
            Self::Ahead(source) => &mut **source,
        }
    }
}
