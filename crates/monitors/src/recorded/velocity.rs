//! Reported velocities against the change of the reported positions: by which factor they differ, and by how much they are late.
//!
//! Both are means over blocks of some samples. A velocity in deg/s has the factor 57.3, one of the wrong sign -1. A lag is no
//! failure: drivers filter their velocities.
//!
//! A velocity is that of an instant, a change of position that of the time between two. The mean of the velocities at both ends
//! (trapezoid) is smaller than the change by `x / tan(x)` for a motion that turns by `2 x` of its phase from sample to sample: the
//! factor is corrected by it, and a motion that turns too far is not judged.

use std::collections::VecDeque;

use congruent_input::{Quantity, SiUnit, display::quantity};
use congruent_scenario::VelocityCheck;

use crate::{
    CheckContext, Names,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::Bound,
    watch::Watch,
};

/// Default for the difference of the factor from 1. Kind: measured; drivers that filter reach 0.05, and units and signs are far beyond.
pub(crate) const FACTOR: f64 = 0.2;
/// Shortest block, s: positions of six digits differ too little from one sample to the next.
const BLOCK_S: f64 = 0.02;
/// Rounding of times, s.
const ROUNDING_S: f64 = 1e-6;
/// Time by which reported velocities are late at most, and early, s. Kind: choice; filters of drivers are within it. In a longer time
/// an arm may swing back, and its velocity with the wrong sign agrees as well.
const LATEST_S: f64 = 0.5;
const EARLIEST_S: f64 = 0.1;
/// Likewise in blocks of the shortest length.
const MOST_LAG: usize = 25;
const MOST_LEAD: usize = 5;
const LAGS: usize = MOST_LEAD + MOST_LAG;
/// A joint of which the root mean square of the velocity over all blocks is smaller is not judged, rad/s or m/s. Kind: judgement;
/// noise of encoders is below it.
const SLOWEST: f64 = 0.01;
/// Correlation of the velocities of two blocks that follow each other from which on samples show a motion: six of a period. Kind:
/// measured; moves from rest to rest have a factor of 0.97 at 0.5, of 0.92 at 0.38 and of 0.67 at 0.1.
const RESOLVED: f64 = 0.5;
/// Error of the factor that samples too far apart do not have: a sign, a unit, velocities that are all 0. Kind: judgement; they make
/// the factor smaller, to 0.5 where it was seen.
const UNMISTAKABLE: f64 = 1.0;
/// Blocks that a joint needs.
const FEWEST: u64 = 50;

/// The sums of one joint at each lag.
#[derive(Debug, Clone, Default)]
struct LagSums {
    /// Of the products of reported and computed velocities, and of the squares of either.
    product: [f64; LAGS],
    computed: [f64; LAGS],
    reported: [f64; LAGS],
    blocks: u64,
    squares: f64,
    /// Of the products of the computed velocities of two blocks that follow each other, and of the squares of the later one.
    successive: f64,
    successive_squares: f64,
}

/// How the velocities of a joint are reported.
#[derive(Debug, Clone, Copy)]
struct ReportedVelocity {
    factor: f64,
    lag_s: f64,
}

/// What is known of the velocities of a joint.
#[derive(Debug, Clone, Copy)]
enum VelocityFinding {
    Judged(ReportedVelocity),
    /// Samples are too far apart for its motion.
    Unresolved,
}

/// The mean length of blocks, and the mean number of samples in one.
#[derive(Debug, Clone, Copy)]
struct BlockLength {
    block_s: f64,
    samples: f64,
}

/// The samples of the block in the making, of all joints.
#[derive(Debug)]
struct VelocityBlock {
    from_s: f64,
    q: Vec<f64>,
    /// Integral of the reported velocities, and those of the sample before.
    travel: Vec<f64>,
    before_qd: Vec<f64>,
    samples: u64,
}

pub(crate) struct VelocityMonitor {
    sums: Vec<LagSums>,
    block: Option<VelocityBlock>,
    /// Velocities of all joints in the last blocks, computed and reported, the latest first.
    last: VecDeque<[Vec<f64>; 2]>,
    block_s: f64,
    blocks: u64,
    samples: u64,
    has_velocities: bool,
    factor: Watch,
    found: Vec<Option<VelocityFinding>>,
}

impl VelocityMonitor {
    pub(crate) fn new(check: &VelocityCheck, context: &CheckContext<'_>) -> Self {
        let dof = context.dof();
        let limit = check.factor.unwrap_or(FACTOR);
        Self {
            sums: vec![LagSums::default(); dof],
            block: None,
            last: VecDeque::with_capacity(MOST_LAG + 1),
            block_s: 0.0,
            blocks: 0,
            samples: 0,
            has_velocities: false,
            factor: Watch::new(Quantity::VelocityFactorError, SiUnit::Ratio, Bound::AtMost, limit, dof),
            found: vec![None; dof],
        }
    }

    /// Ends a block at this sample.
    fn end_block(&mut self, sample: &Sample<'_>) {
        let measured = sample.joints.measured;
        let Some(block) = &mut self.block else { return };
        let length_s = sample.time_s - block.from_s;
        self.blocks += 1;
        self.block_s += length_s;
        self.samples += std::mem::take(&mut block.samples);
        let reused = if self.last.len() == MOST_LAG { self.last.pop_back() } else { None };
        let [mut computed, mut reported] = reused.unwrap_or_default();
        computed.clear();
        computed.extend(measured.q.iter().zip(&block.q).map(|(q, before)| (q - before) / length_s));
        reported.clear();
        reported.extend(block.travel.iter().map(|travel| travel / length_s));
        self.last.push_front([computed, reported]);
        for (joint, sums) in self.sums.iter_mut().enumerate() {
            self.has_velocities |= sums.take(joint, &self.last);
        }
        block.from_s = sample.time_s;
        block.q.copy_from_slice(measured.q);
        block.travel.fill(0.0);
    }

    fn begin_block(&mut self, sample: &Sample<'_>) {
        let measured = sample.joints.measured;
        self.last.clear();
        let travel = vec![0.0; measured.q.len()];
        let (q, before_qd) = (measured.q.to_vec(), measured.qd.to_vec());
        self.block = Some(VelocityBlock { from_s: sample.time_s, q, travel, before_qd, samples: 0 });
    }

    /// Adds the time since the sample before to the block.
    fn go_on(&mut self, sample: &Sample<'_>) {
        let (Some(block), Some(since_s)) = (&mut self.block, sample.since_s) else { return };
        block.samples += 1;
        for ((travel, before), qd) in
            block.travel.iter_mut().zip(&mut block.before_qd).zip(sample.joints.measured.qd)
        {
            *travel += 0.5 * (*before + qd) * since_s;
            *before = *qd;
        }
        // Times have their rounding: blocks of equal samples are to be equally long.
        if sample.time_s - block.from_s >= BLOCK_S - ROUNDING_S {
            self.end_block(sample);
        }
    }

    #[expect(clippy::cast_precision_loss, reason = "no log has 2^52 blocks")]
    fn judge(&mut self, sample: &Sample<'_>) {
        let blocks = self.blocks.max(1) as f64;
        let length =
            BlockLength { block_s: self.block_s / blocks, samples: (self.samples as f64 / blocks).max(1.0) };
        for (joint, sums) in self.sums.iter().enumerate() {
            let rms = (sums.squares / sums.blocks.max(1) as f64).sqrt();
            if sums.blocks < FEWEST || rms < SLOWEST {
                continue;
            }
            let found = sums.best(length);
            let error = (found.factor - 1.0).abs();
            if sums.correlation() < RESOLVED && error < UNMISTAKABLE {
                self.found[joint] = Some(VelocityFinding::Unresolved);
                continue;
            }
            self.found[joint] = Some(VelocityFinding::Judged(found));
            self.factor.observe(error, joint, sample);
        }
    }
}

impl LagSums {
    /// Takes the last block of a joint with those before it; returns whether its velocity is reported.
    fn take(&mut self, joint: usize, last: &VecDeque<[Vec<f64>; 2]>) -> bool {
        let [computed, reported] = [0, 1].map(|kind| last[0][kind][joint]);
        if !reported.is_finite() {
            return false;
        }
        self.blocks += 1;
        self.squares += computed * computed;
        if let Some([before, _]) = last.get(1) {
            self.successive += computed * before[joint];
            self.successive_squares += computed * computed;
        }
        for (lag, [before_computed, before_reported]) in last.iter().enumerate() {
            self.add(MOST_LEAD + lag, reported, before_computed[joint]);
            if (1..=MOST_LEAD).contains(&lag) {
                self.add(MOST_LEAD - lag, before_reported[joint], computed);
            }
        }
        true
    }

    fn add(&mut self, lag: usize, reported: f64, computed: f64) {
        if let Some(product) = self.product.get_mut(lag).filter(|_| reported.is_finite()) {
            *product += reported * computed;
            self.computed[lag] += computed * computed;
            self.reported[lag] += reported * reported;
        }
    }

    /// How far the velocity of a block is that of the one before: 1 of a motion that is slow beside the blocks.
    fn correlation(&self) -> f64 {
        if self.successive_squares > 0.0 { self.successive / self.successive_squares } else { 1.0 }
    }

    /// By what the trapezoid makes mean velocities smaller: `x / tan(x)` with half the phase `x` between two samples.
    fn trapezoid(&self, length: BlockLength) -> f64 {
        // Below the bound the joint is not judged, and the tangent would grow without one.
        let half_phase = libm::acos(self.correlation().clamp(RESOLVED, 1.0)) / 2.0 / length.samples;
        if half_phase > 0.0 { half_phase / libm::tan(half_phase) } else { 1.0 }
    }

    /// The factor at the lag at which both agree best.
    #[expect(clippy::cast_precision_loss, reason = "a small number")]
    fn best(&self, length: BlockLength) -> ReportedVelocity {
        let BlockLength { block_s, .. } = length;
        let agreement = |lag: usize| {
            let size = (self.computed[lag] * self.reported[lag]).sqrt();
            if size > 0.0 { self.product[lag].abs() / size } else { 0.0 }
        };
        // Without a lag, unless another one is better.
        let lag_s = |lag: usize| (lag as f64 - MOST_LEAD as f64) * block_s;
        let range = -EARLIEST_S - ROUNDING_S..=LATEST_S + ROUNDING_S;
        let lags = (0..LAGS).filter(|&lag| range.contains(&lag_s(lag)));
        let best = lags.max_by(|&a, &b| agreement(a).total_cmp(&agreement(b))).unwrap_or(MOST_LEAD);
        let best = if agreement(best) > agreement(MOST_LEAD) { best } else { MOST_LEAD };
        // Between the blocks by the parabola through the best and its neighbours.
        let shift = match best {
            0 => 0.0,
            _ if best + 1 == LAGS => 0.0,
            _ => {
                let [before, at, after] = [best - 1, best, best + 1].map(agreement);
                let bend = before - 2.0 * at + after;
                if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 }
            }
        };
        let factor = self.product[best] / self.computed[best] / self.trapezoid(length);
        if self.reported[MOST_LEAD] == 0.0 {
            return ReportedVelocity { factor: 0.0, lag_s: 0.0 };
        }
        ReportedVelocity { factor, lag_s: lag_s(best) + shift * block_s }
    }
}

impl Monitor for VelocityMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        let measured = sample.joints.measured;
        if measured.qd.len() != measured.q.len() {
            // Velocities that begin later in the log begin a block there.
            self.block = None;
        } else if sample.since_s.is_none() || self.block.is_none() {
            self.begin_block(sample);
        } else {
            self.go_on(sample);
        }
        if sample.is_last {
            self.end(sample);
        }
    }

    fn end(&mut self, sample: &Sample<'_>) {
        self.judge(sample);
    }

    fn finish(&self, names: &Names) -> Observed {
        let name = |joint: usize| names.joints[joint].clone();
        let late = |(joint, found): (usize, &Option<VelocityFinding>)| {
            let VelocityFinding::Judged(ReportedVelocity { factor, lag_s }) = (*found)? else {
                return Some(format!(
                    "{}: not judged, its samples are too far apart for its motion",
                    name(joint)
                ));
            };
            if factor == 0.0 {
                return Some(format!("{}: all reported velocities are 0", name(joint)));
            }
            let late = match lag_s {
                lag_s if lag_s.abs() < BLOCK_S / 2.0 => String::new(),
                lag_s if lag_s > 0.0 => format!(", {} late", quantity(lag_s, "s")),
                lag_s => format!(", {} early", quantity(-lag_s, "s")),
            };
            let is_noted = !late.is_empty() || (factor - 1.0).abs() > self.factor.limit();
            let times = quantity(factor, "");
            is_noted.then(|| format!("{}: {times} times the change of its position{late}", name(joint)))
        };
        let mut notes: Vec<String> = self.found.iter().enumerate().filter_map(late).collect();
        if !self.has_velocities {
            notes.push("the source of joint states has no velocities".to_owned());
        }
        Observed {
            samples: if self.has_velocities { self.blocks } else { 0 },
            measures: vec![self.factor.measure(&names.joints, name)],
            notes,
            ..Observed::default()
        }
    }

    fn has_failed(&self) -> bool {
        self.factor.is_violated()
    }
}
