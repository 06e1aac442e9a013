//! The effort that the motion needs by inverse dynamics, minus the effort that the drives report.

use congruent_description::{JointKind, LinkIndex, Robot, RobotQ};
use congruent_dynamics::{BodyTree, DynamicsBuffer, DynamicsError, JointMotionState};
use congruent_monitors::{ActuatorLimits, RunDynamics};
use congruent_proximity::{Clearance, MovingBodies};
use nalgebra::Isometry3;

use super::{fit::Window, observed::ObservedRun};

/// Residuals below this part of the largest effort of the joint are the truncation error of the engine's step, proportional to its
/// length. Worst seen without fault, beyond the part that `CHANGES` covers: 0.0018, in steps of 1 ms, on UR5e and Panda in random
/// moves of 1 rad in 1 s.
const STEP_PART: f64 = 0.02;
/// The same for the largest effort of any joint, whose motion the others feel. Worst seen 1.6e-4.
const COUPLED_PART: f64 = 1e-3;
/// The same for the largest declared dry friction of any joint, which the solver of the engine approaches. Kind: solver. Worst
/// seen without fault: 0.036, in arms of seven joints with friction that move with soft gains.
const FRICTION_PART: f64 = 0.05;
/// In a step in which any actuator is at a limit, this part of the effort of a joint, and of the largest of any. Kind:
/// engineering. Worst seen without fault: 0.1; an actuator that exerts nothing, or works against a brake, is off by 1.
const LIMITED_PART: f64 = 0.3;
const LIMITED_COUPLED: f64 = 0.02;
/// Truncation error of a step as a multiple of the change of the needed effort in it.
const CHANGES: f64 = 3.0;
/// Rounding of second differences, N m: 1e-15 rad over 1e-6 s^2, times 10 kg m^2.
const SMALLEST: f64 = 1e-6;
/// Fewer residuals that are off are the ringing after an impact, not a fault.
const FEWEST: usize = 40;

/// Whether the missing effort of a joint counts in steps in which dry friction may hold it: only a lower bound of it is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum HeldSamples {
    Counts,
    LeftOut,
}

/// When residuals are above their threshold: a range of residuals, and the samples with the fault that causes them.
#[derive(Debug, Clone, Copy)]
pub(super) struct OffWindow {
    pub(super) residuals: Window,
    pub(super) samples: Window,
    /// Threshold without the part that is proportional to the change in a step, N m or N.
    threshold: f64,
    /// Number of residuals before the joint came to a limit.
    usable: usize,
}

impl OffWindow {
    /// From the first to the last of `usable` residuals of a joint that are more than the length of a step makes them, those
    /// in which friction holds it included or not. If hardly any follow, the fault lasts to the end of the run as far as is
    /// known.
    pub(super) fn above_threshold(
        usable: &[Residual],
        samples: usize,
        joint: usize,
        held: HeldSamples,
    ) -> Option<Self> {
        let largest =
            |joint: usize| usable.iter().map(|residual| residual.effort[joint].abs()).fold(0.0, f64::max);
        let joints = usable.first()?.effort.len();
        let of_any = (0..joints).map(largest).fold(0.0, f64::max);
        let friction = FRICTION_PART * usable.first()?.friction;
        // The largest of the causes, each of which makes a residual by itself; what grows with the change of a step
        // is added below.
        let threshold = SMALLEST.max(STEP_PART * largest(joint)).max(COUPLED_PART * of_any).max(friction);
        let is_off = |index: usize| {
            let residual = &usable[index];
            let counts = held == HeldSamples::Counts || !residual.is_held[joint];
            let limited =
                if residual.is_limited { residual.of_limits(joint) + LIMITED_COUPLED * of_any } else { 0.0 };
            counts && residual.missing[joint].abs() > threshold + CHANGES * residual.change[joint] + limited
        };
        let residuals = Window::spanning(usable.len(), is_off)?;
        let off = residuals.samples().filter(|&index| is_off(index)).count();
        // A joint that friction holds is stuck only if most samples lack more than that friction: a brake holds all the time,
        // while a joint slides at single samples.
        let is_held =
            residuals.samples().any(|index| held == HeldSamples::Counts && usable[index].is_held[joint]);
        if off < FEWEST || (is_held && 2 * off < residuals.len()) {
            return None;
        }
        let samples = samples_of(residuals, usable, samples);
        Some(Self { residuals, samples, threshold, usable: usable.len() })
    }

    /// Whether the window ends before the run because the fault does: it would show in enough of what follows. `expected` is
    /// what would be missing of the joint with the fault.
    pub(super) fn ends(self, all: &[Residual], joint: usize, expected: impl Fn(&Residual) -> f64) -> bool {
        /// So far above what counts as off a fault shows in every sample.
        const CLEARLY: f64 = 2.0;
        let would_show = |residual: &&Residual| {
            let off = self.threshold + CHANGES * residual.change[joint];
            !residual.is_held[joint] && expected(residual).abs() > CLEARLY * off
        };
        let after = all.get(self.residuals.end..self.usable).unwrap_or_default();
        after.iter().filter(would_show).take(FEWEST).count() == FEWEST
    }

    /// The residuals before the joint came to a limit.
    pub(super) fn usable(self, all: &[Residual]) -> &[Residual] {
        &all[..self.usable]
    }

    /// How much of the squared deviation of a residual of a joint a fault explains that lets `expected` be missing, in units
    /// of the smallest deviation that counts as off. None in steps of which the effort is not known.
    pub(super) fn evidence(self, residual: &Residual, joint: usize, expected: f64) -> f64 {
        if residual.is_held[joint] || residual.is_limited {
            return 0.0;
        }
        // e^2 - (e - m)^2, by which the fault lowers the sum of squares.
        let explained = expected * (2.0 * residual.missing[joint] - expected);
        explained / (self.threshold + CHANGES * residual.change[joint]).powi(2)
    }

    /// The same over other residuals.
    pub(super) fn over(self, residuals: Window, all: &[Residual], samples: usize) -> Self {
        Self { residuals, samples: samples_of(residuals, self.usable(all), samples), ..self }
    }

    /// The window of another, with the threshold of this joint.
    pub(super) fn in_place_of(self, other: Self) -> Self {
        Self { residuals: other.residuals, samples: other.samples, ..self }
    }

    /// From the first of both to the last.
    pub(super) fn with(self, other: Self) -> Self {
        let both = |a: Window, b: Window| Window { first: a.first.min(b.first), end: a.end.max(b.end) };
        Self {
            residuals: both(self.residuals, other.residuals),
            samples: both(self.samples, other.samples),
            ..self
        }
    }
}

/// The samples of a fault that shows in a window of residuals.
fn samples_of(residuals: Window, usable: &[Residual], samples: usize) -> Window {
    // With too few residuals after the window the end of the fault cannot be known: it lasts to the end of the run.
    let lasts = usable.len() - residuals.end < FEWEST;
    let end = if lasts { samples } else { usable[residuals.end].sample };
    // An effort acts in the step before the sample that shows it.
    Window { first: usable[residuals.first].sample - 1, end }
}

/// One sample with its motion and its residual.
#[derive(Debug, Clone)]
pub(super) struct Residual {
    /// The kept sample at the end of the step.
    pub(super) sample: usize,
    /// At the beginning of the step.
    pub(super) q: RobotQ,
    /// Before the step, and after it.
    pub(super) qd: [Vec<f64>; 2],
    pub(super) qdd: Vec<f64>,
    pub(super) effort: Vec<f64>,
    /// Needed minus reported effort, by joint, with what its followers need; for a joint at rest the part that dry friction does not explain.
    pub(super) missing: Vec<f64>,
    /// Whether dry friction may hold the joint, with any effort up to its own: what is missing is then at least this much.
    pub(super) is_held: Vec<bool>,
    /// Whether any actuator is at its largest effort or speed, which may take a part of the step: its effort is then not that
    /// of the whole step, and the others feel it.
    is_limited: bool,
    /// Largest declared dry friction of any joint.
    friction: f64,
    /// Whether the effort that was reported has arrived.
    is_known: bool,
    /// How much the needed effort has changed since the residual before, by joint.
    change: Vec<f64>,
}

impl Residual {
    /// Largest residual of a joint in a step in which an actuator is at a limit, without the coupling of other joints.
    fn of_limits(&self, joint: usize) -> f64 {
        LIMITED_PART * self.effort[joint].abs()
    }

    /// The deviation that a joint may have in this step by its motion alone: it changes fast, or an actuator is at a limit.
    fn of_motion(&self, joint: usize) -> f64 {
        CHANGES * self.change[joint] + if self.is_limited { self.of_limits(joint) } else { 0.0 }
    }

    /// Whether any actuator is at its largest effort or speed.
    fn is_at(&self, limits: &[ActuatorLimits]) -> bool {
        /// Nearer to a limit than this part of it is at it. Kind: engineering.
        const AT_LIMIT: f64 = 1e-3;
        let reaches = |value: f64, limit: f64| value.abs() >= (1.0 - AT_LIMIT) * limit;
        limits.iter().enumerate().any(|(joint, limit)| {
            let speeds = self.qd.iter().map(|qd| qd[joint]);
            reaches(self.effort[joint], limit.effort) || speeds.into_iter().any(|qd| reaches(qd, limit.speed))
        })
    }
}

/// Whether a large fault of a joint would not show in most steps.
pub(super) fn is_blind(residuals: &[Residual], joint: usize) -> bool {
    /// A deviation of this part of the largest effort of the joint is that of a large fault. Kind: engineering.
    const LARGE: f64 = 0.3;
    let largest = residuals.iter().map(|residual| residual.effort[joint].abs()).fold(0.0, f64::max);
    let hidden = residuals.iter().filter(|residual| residual.of_motion(joint) > LARGE * largest).count();
    2 * hidden > residuals.len()
}

/// The mean change of the needed effort from residual to residual in a neighbourhood, which a single zero does not hide.
fn find_changes(residuals: &mut [Residual], dof: usize) {
    /// Residuals on either side.
    const NEAR: usize = 20;
    let needed = |of: &Residual, joint: usize| of.missing[joint] + of.effort[joint];
    for joint in 0..dof {
        let follows = |pair: &[Residual]| pair[0].sample + 1 == pair[1].sample;
        let step = |pair: &[Residual]| (needed(&pair[1], joint) - needed(&pair[0], joint)).abs();
        let pairs = residuals.windows(2);
        let steps: Vec<f64> = pairs.map(|pair| if follows(pair) { step(pair) } else { 0.0 }).collect();
        for (index, residual) in residuals.iter_mut().enumerate() {
            let near = &steps[index.saturating_sub(NEAR)..(index + NEAR).min(steps.len())];
            #[expect(clippy::cast_precision_loss, reason = "they are few")]
            let mean = near.iter().sum::<f64>() / near.len().max(1) as f64;
            residual.change[joint] = mean;
        }
    }
}

/// The residuals of all samples with two kept ones before them; empty if the drives report no effort at all.
///
/// # Errors
/// [`DynamicsError`] if the robot has no dynamics.
pub(super) fn residuals(
    observed: &ObservedRun<'_>,
    mut declared: RunDynamics<'_>,
    limits: &[ActuatorLimits],
) -> Result<Vec<Residual>, DynamicsError> {
    let mut found: Vec<Residual> = Vec::new();
    for sample in 2..observed.samples() {
        if !observed.are_consecutive(sample - 2, sample - 1) || !observed.are_consecutive(sample - 1, sample)
        {
            continue;
        }
        // Payloads at the beginning of the step, as the physics takes them.
        let (tree, buffer) = declared.at(observed.times_s[sample - 1]);
        found.push(residual(observed, sample, tree, buffer)?);
    }
    find_changes(&mut found, observed.robot.dof());
    // Only now: changes are those from step to step, also across samples without a report.
    found.retain(|residual| residual.is_known);
    for residual in &mut found {
        residual.is_limited = residual.is_at(limits);
    }
    // Without any effort the drives report none, and everything would be missing.
    let is_driven = found.iter().any(|residual| residual.effort.iter().any(|effort| effort.abs() > 0.0));
    Ok(if is_driven { found } else { Vec::new() })
}

fn residual(
    observed: &ObservedRun<'_>,
    sample: usize,
    tree: &BodyTree,
    buffer: &mut DynamicsBuffer,
) -> Result<Residual, DynamicsError> {
    let step_s = observed.clock.step_s;
    let position = |sample: usize| observed.q.iter().map(move |q| q[sample]);
    let speed = |sample: usize| -> Vec<f64> {
        position(sample).zip(position(sample - 1)).map(|(after, before)| (after - before) / step_s).collect()
    };
    let qd = [speed(sample - 1), speed(sample)];
    let qdd: Vec<f64> = qd[0].iter().zip(&qd[1]).map(|(before, after)| (after - before) / step_s).collect();
    let q: RobotQ = position(sample - 1).collect();
    let mut residual = vec![0.0; q.len()];
    // The engine takes velocity products half from before the step and half from after it, and what resists a joint from
    // after it.
    let mean: Vec<f64> =
        qd[0].iter().zip(&qd[1]).map(|(before, after)| f64::midpoint(*before, *after)).collect();
    tree.inverse_into(&JointMotionState { q: &q, qd: &mean, qdd: &qdd }, buffer, &mut residual)?;
    for (joint, resistance) in tree.resistances().iter().enumerate() {
        residual[joint] += resistance.damping * (qd[1][joint] - mean[joint]);
    }
    for follower in &observed.followers {
        residual[follower.master] += follower.ratio * std::mem::take(&mut residual[follower.joint]);
    }
    let change = vec![0.0; q.len()];
    let (effort, is_known) = match observed.effort(sample) {
        Some(effort) => (effort.to_vec(), true),
        // The needed effort, so that nothing is missing; the sample is taken out later.
        None => (residual.clone(), false),
    };
    residual.iter_mut().zip(&effort).for_each(|(residual, effort)| *residual -= effort);
    let friction = tree.resistances().iter().map(|resistance| resistance.friction).fold(0.0, f64::max);
    let rest_speed = REST_SPEED.max(REST_PART * qd[1].iter().map(|qd| qd.abs()).fold(0.0, f64::max));
    let mut is_held = vec![false; q.len()];
    let mut frictions: Vec<f64> = tree.resistances().iter().map(|resistance| resistance.friction).collect();
    for follower in &observed.followers {
        frictions[follower.master] += follower.ratio.abs() * std::mem::take(&mut frictions[follower.joint]);
    }
    for (joint, &friction) in frictions.iter().enumerate() {
        is_held[joint] = friction > 0.0 && is_at_rest([qd[0][joint], qd[1][joint]], rest_speed);
        if is_held[joint] {
            residual[joint] = not_held(residual[joint], friction, mean[joint]);
        }
    }
    Ok(Residual {
        sample,
        q,
        qd,
        qdd,
        effort,
        missing: residual,
        is_held,
        is_limited: false,
        friction,
        is_known,
        change,
    })
}

/// A joint slower than this, rad/s or m/s, is at rest: dry friction holds it. Kind: solver; the engine lets it creep.
const REST_SPEED: f64 = 1e-4;

/// The same as a part of the speed of the fastest joint, whose motion makes the others creep. Worst seen 4e-4.
const REST_PART: f64 = 1e-3;

/// Whether a joint is at rest in a step, or reverses in it; below the speed `rest_speed` it is at rest.
fn is_at_rest([before, after]: [f64; 2], rest_speed: f64) -> bool {
    before * after <= 0.0 || before.abs().max(after.abs()) < rest_speed
}

/// The part of a residual that dry friction at rest does not explain; the residual was computed with sliding friction, which is
/// taken out first.
fn not_held(residual: f64, friction: f64, speed: f64) -> f64 {
    let of_speed = if speed == 0.0 { 0.0 } else { friction.copysign(speed) };
    let without = residual - of_speed;
    (without.abs() - friction).max(0.0).copysign(without)
}

/// The link that names the body of a link, and the pose of the link in it.
pub(super) fn body_of(robot: &Robot, mut link: LinkIndex) -> (LinkIndex, Isometry3<f64>) {
    let mut body_from_link = Isometry3::identity();
    while let Some(joint) = robot.parent_joint(link) {
        let joint = robot.joint(joint);
        if joint.kind != JointKind::Fixed {
            break;
        }
        body_from_link = joint.parent_from_joint * body_from_link;
        link = joint.parent;
    }
    (link, body_from_link)
}

/// A smaller distance counts as contact: a link at 2 m/s moves as far in a step of 1 ms.
const TOUCHING_M: f64 = 2e-3;

/// The first kept sample in which a link touches an obstacle: from then on efforts are not those of its motion alone.
pub(super) fn first_contact(
    observed: &ObservedRun<'_>,
    bodies: &mut MovingBodies<'_>,
    clearance: &mut Clearance,
) -> Option<usize> {
    let links = observed.robot.links().len();
    let pairs = clearance.pairs().enumerate();
    let with_obstacle: Vec<(usize, usize)> =
        pairs.map(|(index, pair)| (index, pair.a.max(pair.b))).filter(|(_, b)| *b >= links).collect();
    if with_obstacle.is_empty() {
        return None;
    }
    (0..observed.samples()).find(|&sample| {
        let root_from_links = observed.store.sample(sample).root_from_links;
        bodies.advance(observed.times_s[sample], |link| root_from_links[link.get()]);
        bodies.move_in(clearance);
        clearance.move_links(root_from_links);
        // A carried body has no contact forces: the physics takes it out of contact while it is carried.
        let is_carried = |subject| bodies.poses().any(|(body, _, now)| now && links + body == subject);
        with_obstacle.iter().any(|&(pair, obstacle)| {
            !is_carried(obstacle) && clearance.measure_below(pair, TOUCHING_M).is_some()
        })
    })
}
