//! Reported velocities against the change of the reported positions: by which factor they differ, and by how much they are late.
//!
//! Both are means over blocks of some samples. A velocity in deg/s has the factor 57.3, one of the wrong sign -1. A lag is no
//! failure: drivers filter their velocities.

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
/// Blocks by which reported velocities are late at most: 0.5 s.
const MOST_LAG: usize = 25;
/// A joint of which the root mean square of the velocity over all blocks is smaller is not judged, rad/s or m/s. Kind: judgement;
/// noise of encoders is below it.
const SLOWEST: f64 = 0.01;
/// Blocks that a joint needs.
const FEWEST: u64 = 50;

/// The sums of one joint at each lag.
#[derive(Debug, Clone, Default)]
struct LagSums {
    /// Of the products of reported and computed velocities, and of the squares of either.
    product: [f64; MOST_LAG],
    computed: [f64; MOST_LAG],
    reported: [f64; MOST_LAG],
    blocks: u64,
    squares: f64,
}

/// How the velocities of a joint are reported.
#[derive(Debug, Clone, Copy)]
struct ReportedVelocity {
    factor: f64,
    lag_s: f64,
}

/// The samples of the block in the making, of all joints.
#[derive(Debug)]
struct VelocityBlock {
    from_s: f64,
    q: Vec<f64>,
    sum_qd: Vec<f64>,
    samples: f64,
}

pub(crate) struct VelocityMonitor {
    sums: Vec<LagSums>,
    block: Option<VelocityBlock>,
    /// Velocities of all joints in the last blocks, the latest first.
    computed: VecDeque<Vec<f64>>,
    block_s: f64,
    blocks: u64,
    has_velocities: bool,
    factor: Watch,
    found: Vec<Option<ReportedVelocity>>,
}

impl VelocityMonitor {
    pub(crate) fn new(check: &VelocityCheck, context: &CheckContext<'_>) -> Self {
        let dof = context.dof();
        let limit = check.factor.unwrap_or(FACTOR);
        Self {
            sums: vec![LagSums::default(); dof],
            block: None,
            computed: VecDeque::with_capacity(MOST_LAG + 1),
            block_s: 0.0,
            blocks: 0,
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
        let mut computed = if self.computed.len() == MOST_LAG {
            self.computed.pop_back().unwrap_or_default()
        } else {
            Vec::with_capacity(block.q.len())
        };
        computed.clear();
        computed.extend(measured.q.iter().zip(&block.q).map(|(q, before)| (q - before) / length_s));
        self.computed.push_front(computed);
        for (joint, sums) in self.sums.iter_mut().enumerate() {
            let reported = block.sum_qd[joint] / block.samples;
            if !reported.is_finite() {
                continue;
            }
            self.has_velocities = true;
            sums.blocks += 1;
            sums.squares += self.computed[0][joint] * self.computed[0][joint];
            for (lag, computed) in self.computed.iter().enumerate() {
                sums.product[lag] += reported * computed[joint];
                sums.computed[lag] += computed[joint] * computed[joint];
                sums.reported[lag] += reported * reported;
            }
        }
        block.from_s = sample.time_s;
        block.q.copy_from_slice(measured.q);
        block.sum_qd.fill(0.0);
        block.samples = 0.0;
    }

    fn begin_block(&mut self, sample: &Sample<'_>) {
        let q = &sample.joints.measured.q;
        self.computed.clear();
        let sum_qd = vec![0.0; q.len()];
        self.block = Some(VelocityBlock { from_s: sample.time_s, q: q.to_vec(), sum_qd, samples: 0.0 });
    }

    #[expect(clippy::cast_precision_loss, reason = "no log has 2^52 blocks")]
    fn judge(&mut self, sample: &Sample<'_>) {
        let block_s = self.block_s / self.blocks.max(1) as f64;
        for (joint, sums) in self.sums.iter().enumerate() {
            let rms = (sums.squares / sums.blocks.max(1) as f64).sqrt();
            if sums.blocks < FEWEST || rms < SLOWEST {
                continue;
            }
            let found = sums.best(block_s);
            self.found[joint] = Some(found);
            self.factor.observe((found.factor - 1.0).abs(), joint, sample);
        }
    }
}

impl LagSums {
    /// The factor at the lag at which both agree best.
    #[expect(clippy::cast_precision_loss, reason = "a small number")]
    fn best(&self, block_s: f64) -> ReportedVelocity {
        let agreement = |lag: usize| {
            let size = (self.computed[lag] * self.reported[lag]).sqrt();
            if size > 0.0 { self.product[lag].abs() / size } else { 0.0 }
        };
        let best = (0..MOST_LAG).max_by(|&a, &b| agreement(a).total_cmp(&agreement(b))).unwrap_or_default();
        // Between the blocks by the parabola through the best and its neighbours.
        let shift = match best {
            0 => 0.0,
            _ if best + 1 == MOST_LAG => 0.0,
            _ => {
                let [before, at, after] = [best - 1, best, best + 1].map(agreement);
                let bend = before - 2.0 * at + after;
                if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 }
            }
        };
        let factor = self.product[best] / self.computed[best];
        ReportedVelocity { factor, lag_s: (best as f64 + shift) * block_s }
    }
}

impl Monitor for VelocityMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        if sample.since_s.is_none() {
            self.begin_block(sample);
        }
        let qd = sample.joints.measured.qd;
        if let Some(block) = self.block.as_mut().filter(|block| block.sum_qd.len() == qd.len()) {
            block.sum_qd.iter_mut().zip(qd).for_each(|(sum, qd)| *sum += qd);
            block.samples += 1.0;
            if sample.time_s - block.from_s >= BLOCK_S {
                self.end_block(sample);
            }
        }
        if sample.is_last {
            self.judge(sample);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let name = |joint: usize| names.joints[joint].clone();
        let late = |(joint, found): (usize, &Option<ReportedVelocity>)| {
            let ReportedVelocity { factor, lag_s } = (*found)?;
            let late =
                if lag_s >= BLOCK_S { format!(", {} late", quantity(lag_s, "s")) } else { String::new() };
            let is_noted = !late.is_empty() || (factor - 1.0).abs() > self.factor.limit();
            is_noted.then(|| {
                format!("{}: {} times the change of its position{late}", name(joint), quantity(factor, ""))
            })
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
