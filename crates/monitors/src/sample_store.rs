//! A bounded number of samples of a run: all of a short one, evenly spread ones of a long one. Allocated once.

use nalgebra::Isometry3;

use crate::{delivered_effort::DeliveredEffort, sample::Sample};

/// Samples that are kept at most: 8 s in steps of 1 ms, 7 MB for an arm with twelve links.
const CAPACITY: usize = 8192;
/// Samples that are kept one after another, so that accelerations can be computed.
const CONSECUTIVE: u64 = 4;
/// Distance of kept groups after the store is full for the first time.
const FIRST_STRIDE: u64 = 8;

/// The kept samples of a run, in the order of time.
#[derive(Debug, Clone)]
pub struct SampleStore {
    dof: usize,
    links: usize,
    capacity: usize,
    stride: u64,
    steps: Vec<u64>,
    /// For each sample: measured positions, speeds and efforts, setpoint positions.
    numbers: Vec<f64>,
    poses: Vec<Isometry3<f64>>,
    /// For each joint what its actuator delivered of the commanded effort, in all samples of the run.
    delivered: Vec<DeliveredEffort>,
}

/// One kept sample, borrowed from the store.
#[derive(Debug, Clone, Copy)]
pub struct StoredSample<'a> {
    /// Measured positions of the movable joints, rad or m.
    pub q: &'a [f64],
    /// Measured efforts, N m or N; NaN if the source knows none.
    pub effort: &'a [f64],
    /// Commanded positions; NaN if the source knows none.
    pub setpoint: &'a [f64],
    /// Poses of the links in the root link's frame.
    pub root_from_links: &'a [Isometry3<f64>],
}

impl SampleStore {
    /// An empty store for a run of `steps` steps, if their number is known.
    pub fn new(dof: usize, links: usize, steps: Option<u64>) -> Self {
        let steps = steps.and_then(|steps| usize::try_from(steps).ok());
        let samples = steps.unwrap_or(usize::MAX).saturating_add(1);
        Self::with_capacity(dof, links, CAPACITY.min(samples))
    }

    fn with_capacity(dof: usize, links: usize, capacity: usize) -> Self {
        Self {
            dof,
            links,
            capacity,
            stride: 1,
            steps: Vec::with_capacity(capacity),
            numbers: Vec::with_capacity(3 * dof * capacity),
            poses: Vec::with_capacity(links * capacity),
            delivered: vec![DeliveredEffort::default(); dof],
        }
    }

    /// Takes a sample, or omits it.
    pub fn take(&mut self, sample: &Sample<'_>) {
        self.compare_efforts(sample);
        if !self.keeps(sample.step) {
            return;
        }
        if self.steps.len() == self.capacity {
            self.thin_out();
            // With the longer stride this sample may be one that is not kept.
            if !self.keeps(sample.step) {
                return;
            }
        }
        self.steps.push(sample.step);
        let measured = &sample.joints.measured;
        self.numbers.extend_from_slice(measured.q);
        self.extend_or_fill(measured.effort);
        self.extend_or_fill(sample.joints.setpoint.map_or(&[], |setpoint| setpoint.q));
        self.poses.extend_from_slice(sample.twin);
    }

    /// Also of samples that are not kept: an actuator may lack effort in a few steps only.
    fn compare_efforts(&mut self, sample: &Sample<'_>) {
        // No step leads to the first sample.
        if sample.step == 0 {
            return;
        }
        let commanded = sample.joints.setpoint.map_or(&[][..], |setpoint| setpoint.effort);
        // Without a source of both efforts the lists are empty, and nothing is known.
        let both = commanded.iter().zip(sample.joints.state().effort);
        for (seen, (commanded, delivered)) in self.delivered.iter_mut().zip(both) {
            seen.observe(*commanded, *delivered, sample.step);
        }
    }

    /// What the actuator of a joint delivered of the commanded effort, in all samples of the run.
    pub fn delivered(&self, joint: usize) -> &DeliveredEffort {
        &self.delivered[joint]
    }

    /// Adds one number for each joint; NaN if the source has none.
    fn extend_or_fill(&mut self, numbers: &[f64]) {
        if numbers.len() == self.dof {
            self.numbers.extend_from_slice(numbers);
        } else {
            self.numbers.extend(std::iter::repeat_n(f64::NAN, self.dof));
        }
    }

    fn keeps(&self, step: u64) -> bool {
        // Groups, not single samples: accelerations are second differences of positions, which need neighbours in
        // time.
        self.stride == 1 || step % self.stride < CONSECUTIVE
    }

    /// Drops every second group, in place: a long run needs no more memory than a short one, and the groups stay evenly spaced.
    fn thin_out(&mut self) {
        self.stride = if self.stride == 1 { FIRST_STRIDE } else { 2 * self.stride };
        let (width, links) = (3 * self.dof, self.links);
        let mut kept = 0;
        for index in 0..self.steps.len() {
            if self.keeps(self.steps[index]) {
                self.steps[kept] = self.steps[index];
                self.numbers.copy_within(width * index..width * (index + 1), width * kept);
                self.poses.copy_within(links * index..links * (index + 1), links * kept);
                kept += 1;
            }
        }
        self.steps.truncate(kept);
        self.numbers.truncate(width * kept);
        self.poses.truncate(links * kept);
    }

    /// The numbers of the steps of all kept samples.
    pub fn steps(&self) -> &[u64] {
        &self.steps
    }

    /// The kept sample of an index of [`SampleStore::steps`].
    pub fn sample(&self, index: usize) -> StoredSample<'_> {
        let numbers = &self.numbers[3 * self.dof * index..][..3 * self.dof];
        let (q, rest) = numbers.split_at(self.dof);
        let (effort, setpoint) = rest.split_at(self.dof);
        let root_from_links = &self.poses[self.links * index..][..self.links];
        StoredSample { q, effort, setpoint, root_from_links }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_run_is_kept_thinly_in_groups() {
        let mut store = SampleStore::with_capacity(1, 0, 64);
        for step in 0..1000_u64 {
            if store.keeps(step) {
                if store.steps.len() == store.capacity {
                    store.thin_out();
                }
                if store.keeps(step) {
                    store.steps.push(step);
                    #[expect(clippy::cast_precision_loss, reason = "small")]
                    store.numbers.extend([step as f64; 3]);
                }
            }
        }
        assert!(store.steps.len() <= 64 && store.steps.len() > 20, "{}", store.steps.len());
        assert!(*store.steps.last().unwrap() > 900 && store.steps[..4] == [0, 1, 2, 3]);
        for (index, &step) in store.steps.iter().enumerate() {
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let expected = step as f64;
            assert!((store.sample(index).q[0] - expected).abs() < f64::EPSILON);
        }
    }
}
