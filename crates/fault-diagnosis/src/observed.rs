//! Positions of the twin's joints by the poses of its links, against the readings of the encoders.

use congruent_description::{Joint, JointIndex, JointKind, Robot};
use congruent_input::SiUnit;
use congruent_monitors::{RunClock, SampleStore};
use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::{
    fit::Window,
    noise::{self, Uncertainty},
};

/// Smaller motions count as rest, rad and m: a servo settles by as much after a motion.
const SLOW: f64 = 1e-3;
/// A joint nearer to its limit than this may be held by its stop, rad and m.
const AT_LIMIT: f64 = 1e-4;

/// Largest position that is used, rad and m: beyond it a simulation is unstable, and rounding exceeds that of the poses.
const FARTHEST: f64 = 1e5;

/// All kept samples as series over time, joint by joint.
#[derive(Debug, Clone)]
pub(super) struct ObservedRun<'a> {
    pub(super) store: &'a SampleStore,
    pub(super) robot: &'a Robot,
    pub(super) clock: &'a RunClock,
    pub(super) times_s: Vec<f64>,
    /// Positions by the poses of the links: by joint, then by sample.
    pub(super) q: Vec<Vec<f64>>,
    /// Measured positions: by joint, then by sample.
    pub(super) measured: Vec<Vec<f64>>,
    /// Measured positions minus those by the poses: by joint, then by sample.
    pub(super) error: Vec<Vec<f64>>,
    /// Setpoints: by joint, then by sample.
    pub(super) setpoint: Vec<Vec<f64>>,
    /// How far the readings of each joint may be from its position without a fault.
    pub(super) uncertainty: Vec<Uncertainty>,
    /// Which samples have a reading of their own, and not the one before once more.
    pub(super) is_used: Vec<bool>,
    /// The joints that follow another.
    pub(super) followers: Vec<Follower>,
    /// Readings of a time, and the efforts with them, arrive this many steps late in a window of samples.
    pub(super) late: Option<(Window, usize)>,
}

/// A joint that follows another: it has no drive, and by virtual work what moves it takes acts at its master, multiplied by the ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Follower {
    pub(super) joint: usize,
    pub(super) master: usize,
    pub(super) ratio: f64,
}

impl Follower {
    /// The followers among the joints of a robot.
    fn all(robot: &Robot) -> Vec<Self> {
        let follower = |(joint, index): (usize, &JointIndex)| {
            let mimic = robot.joint(*index).mimic?;
            Some(Self { joint, master: robot.coordinate(mimic.master)?, ratio: mimic.multiplier })
        };
        robot.movable_joints().iter().enumerate().filter_map(follower).collect()
    }
}

impl<'a> ObservedRun<'a> {
    pub(super) fn new(store: &'a SampleStore, robot: &'a Robot, clock: &'a RunClock) -> Self {
        let is_usable = |&sample: &usize| store.sample(sample).q.iter().all(|q| q.abs() < FARTHEST);
        let samples = (0..store.steps().len()).take_while(is_usable).count();
        let series = |of: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
            (0..robot.dof()).map(|joint| (0..samples).map(|sample| of(joint, sample)).collect()).collect()
        };
        let measured = series(&|joint, sample| store.sample(sample).q[joint]);
        let setpoint = series(&|joint, sample| store.sample(sample).setpoint[joint]);
        let mut q = series(&|coordinate, sample| {
            let joint = robot.joint(robot.movable_joints()[coordinate]);
            joint_position(joint, &joint_motion(joint, store.sample(sample).root_from_links))
        });
        // Poses know an angle up to whole turns only; encoders count them.
        for ((q, measured), &joint) in q.iter_mut().zip(&measured).zip(robot.movable_joints()) {
            if robot.joint(joint).kind.is_angular() {
                unwind(q, measured, store.steps());
            }
        }
        let minus = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| a - b).collect();
        let error = measured.iter().zip(&q).map(minus).collect();
        let times_s = store.steps()[..samples].iter().map(|&step| clock.time_s(step)).collect();
        let (uncertainty, is_used) = (Vec::new(), vec![true; samples]);
        let mut observed = Self {
            store,
            robot,
            clock,
            times_s,
            q,
            measured,
            error,
            setpoint,
            uncertainty,
            is_used,
            followers: Follower::all(robot),
            late: None,
        };
        observed.uncertainty = observed.uncertainties();
        observed
    }

    fn uncertainties(&self) -> Vec<Uncertainty> {
        let all = 0..self.robot.dof();
        let resolutions: Vec<Option<f64>> =
            all.clone().map(|joint| noise::resolution(&self.q[joint], &self.measured[joint])).collect();
        // The resolution of a reading that never changes is unknown: the coarsest of the other encoders is assumed, so that an
        // error within it is not reported as a fault.
        let coarsest = resolutions.iter().flatten().copied().fold(0.0, f64::max);
        all.map(|joint| {
            let measured = &self.measured[joint];
            let resolution =
                resolutions[joint].unwrap_or(if spread(measured) > 0.0 { 0.0 } else { coarsest });
            let repeats = |sample: usize| measured[sample].to_bits() == measured[sample - 1].to_bits();
            let is_in_triple = |sample: usize| {
                self.are_consecutive(sample - 2, sample - 1)
                    && self.are_consecutive(sample - 1, sample)
                    && (resolution > 0.0 || !(repeats(sample) || repeats(sample - 1)))
            };
            // Rounding to steps makes second differences of up to two steps, which look like noise: only larger ones are noise.
            let noise = noise::noise(&self.error[joint], is_in_triple);
            let noise = if noise > resolution / 2.0 { noise } else { 0.0 };
            Uncertainty { noise, resolution }
        })
        .collect()
    }

    /// Samples with a reading of their own.
    pub(super) fn used(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.samples()).filter(|&sample| self.is_used[sample])
    }

    /// The efforts that the drives report of a sample; `None` if the report is not among the kept samples.
    pub(super) fn effort(&self, sample: usize) -> Option<&'a [f64]> {
        let arrived = match self.late {
            Some((window, steps)) if window.samples().contains(&(sample + steps)) => sample + steps,
            Some((window, _)) if window.samples().contains(&sample) => return None,
            _ => sample,
        };
        // Kept samples have gaps: `arrived` has to be that many steps later in the run, not only in the list.
        let is_direct = self.store.steps()[arrived] - self.store.steps()[sample]
            == u64::try_from(arrived - sample).unwrap_or(u64::MAX);
        (is_direct && self.is_used[arrived]).then(|| self.store.sample(arrived).effort)
    }

    pub(super) fn samples(&self) -> usize {
        self.times_s.len()
    }

    /// Name of a movable joint.
    pub(super) fn name(&self, coordinate: usize) -> String {
        self.joint(coordinate).name.clone()
    }

    /// Unit of a coordinate.
    pub(super) fn unit(&self, coordinate: usize) -> SiUnit {
        self.joint(coordinate).kind.si_unit()
    }

    fn joint(&self, coordinate: usize) -> &Joint {
        self.robot.joint(self.robot.movable_joints()[coordinate])
    }

    /// Joints with an encoder and a drive of their own.
    pub(super) fn independent_joints(&self) -> Vec<usize> {
        (0..self.robot.dof()).filter(|&coordinate| self.joint(coordinate).mimic.is_none()).collect()
    }

    /// Times of a window: of its first sample, and of the one after its last if the run goes on.
    pub(super) fn times(&self, window: Window) -> (f64, Option<f64>) {
        (self.times_s[window.first], self.times_s.get(window.end).copied())
    }

    /// The same for a fault that shows only while one of some joints moves: if all of them rest after the window, its end
    /// is not known.
    pub(super) fn times_in_motion(&self, window: Window, joints: &[usize]) -> (f64, Option<f64>) {
        let (from_s, until_s) = self.times(window);
        let moves = |joint: &usize| spread(&self.q[*joint][window.end..]) > SLOW;
        (from_s, until_s.filter(|_| joints.iter().any(moves)))
    }

    /// Number of samples before a joint first is at a limit, or beyond it.
    pub(super) fn samples_before_limit(&self, coordinate: usize) -> usize {
        let Some((lower, upper)) = self.joint(coordinate).position_range() else { return self.samples() };
        let q = &self.q[coordinate];
        let is_free = |q: f64| q > lower + AT_LIMIT && q < upper - AT_LIMIT;
        q.iter().position(|&q| !is_free(q)).unwrap_or(q.len())
    }

    /// Whether two kept samples follow each other in the run.
    pub(super) fn are_consecutive(&self, first: usize, second: usize) -> bool {
        let steps = self.store.steps();
        steps[first] + 1 == steps[second]
    }

    /// The pose of a link relative to its nominal pose on its parent: the identity for a twin without faults. For a link behind
    /// a moving joint, the position of the joint is `q`, or the one by the poses.
    pub(super) fn displacement(&self, link: usize, sample: usize, q: Option<&[f64]>) -> Isometry3<f64> {
        let root_from_links = self.store.sample(sample).root_from_links;
        let Some(index) = self.robot.link_indices().nth(link).and_then(|link| self.robot.parent_joint(link))
        else {
            return root_from_links[link];
        };
        let joint = self.robot.joint(index);
        let motion = joint_motion(joint, root_from_links);
        let q = self.robot.coordinate(index).map_or(0.0, |coordinate| match q {
            Some(q) => q[coordinate],
            None => self.q[coordinate][sample],
        });
        expected_motion(joint, q).inverse() * motion
    }
}

/// Largest minus smallest value.
pub(super) fn spread(values: &[f64]) -> f64 {
    let (low, high) = values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| (low.min(value), high.max(value)));
    (high - low).max(0.0)
}

/// Pose of the child of a joint in the joint's frame.
fn joint_motion(joint: &Joint, root_from_links: &[Isometry3<f64>]) -> Isometry3<f64> {
    let root_from_joint = root_from_links[joint.parent.get()] * joint.parent_from_joint;
    root_from_joint.inverse() * root_from_links[joint.child.get()]
}

fn expected_motion(joint: &Joint, q: f64) -> Isometry3<f64> {
    match joint.kind {
        JointKind::Fixed => Isometry3::identity(),
        JointKind::Prismatic => Translation3::from(joint.axis_in_joint.into_inner() * q).into(),
        _ => Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_axis_angle(&joint.axis_in_joint, q),
        ),
    }
}

/// The position of a joint, an angle in (-pi, pi].
fn joint_position(joint: &Joint, motion: &Isometry3<f64>) -> f64 {
    let axis = joint.axis_in_joint;
    if joint.kind == JointKind::Prismatic {
        return motion.translation.vector.dot(&axis);
    }
    // The unit quaternion is (cos t/2, axis sin t/2): its component along the axis and its scalar give half of the angle.
    let half = libm::atan2(motion.rotation.imag().dot(&axis), motion.rotation.scalar());
    nearest_turn(2.0 * half, 0.0)
}

/// The angle that differs from this one by whole turns and is nearest to `near`.
fn nearest_turn(angle: f64, near: f64) -> f64 {
    angle + std::f64::consts::TAU * ((near - angle) / std::f64::consts::TAU).round()
}

/// Removes jumps by full turns: the first angle is the nearest to the measured one, and each other the nearest to the one before.
/// Between samples that are not consecutive, and if that agrees with the encoder, the expected angle is the one before plus the
/// change of the encoder.
fn unwind(angles: &mut [f64], measured: &[f64], steps: &[u64]) {
    /// Largest difference from the change of the encoder that counts as agreement, rad.
    const AS_MEASURED: f64 = 0.1;
    if let (Some(angle), Some(measured)) = (angles.first_mut(), measured.first()) {
        *angle = nearest_turn(*angle, *measured);
    }
    for sample in 1..angles.len() {
        let before = angles[sample - 1];
        let as_measured = before + measured[sample] - measured[sample - 1];
        let angle = nearest_turn(angles[sample], as_measured);
        let is_as_measured =
            steps[sample] > steps[sample - 1] + 1 || (angle - as_measured).abs() < AS_MEASURED;
        angles[sample] = if is_as_measured { angle } else { nearest_turn(angle, before) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_turns_between_kept_samples_are_those_of_the_encoder() {
        let positions: Vec<f64> = (0..200).map(|sample| 2.9 * f64::from(sample)).collect();
        let mut steps: Vec<u64> = (0..200).map(|sample| 8 * sample).collect();
        let wrapped: Vec<f64> = positions.iter().map(|&angle| nearest_turn(angle, 0.0)).collect();
        let largest = |joint_position: &[f64]| {
            joint_position.iter().zip(&positions).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        // Drift and offset of an encoder do not become turns.
        for rate in [0.0, 0.01, -0.01] {
            let measured: Vec<f64> =
                positions.iter().zip(0_u32..).map(|(q, at)| q + 1.0 + rate * f64::from(at)).collect();
            let mut joint_position = wrapped.clone();
            unwind(&mut joint_position, &measured, &steps);
            assert!(largest(&joint_position) < 1e-9, "{}", largest(&joint_position));
        }
        // An encoder that jumps by more than half a turn from one step to the next does not turn the joint.
        steps = (0..200).collect();
        let jumps: Vec<f64> =
            positions.iter().enumerate().map(|(at, q)| q + if at < 100 { 0.0 } else { 3.5 }).collect();
        let mut joint_position = wrapped;
        unwind(&mut joint_position, &jumps, &steps);
        assert!(largest(&joint_position) < 1e-9, "{}", largest(&joint_position));
    }
}
