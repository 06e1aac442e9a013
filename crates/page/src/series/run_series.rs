//! What a run shows over time: errors of all links, all joints, distances, the path of the TCP, and both arms where they
//! differ most. Memory is bounded, and after the first sample nothing is allocated.

use congruent_description::{LinkIndex, RobotDescription, Tolerance};
use congruent_kinematics::{Pose, PoseError};
use congruent_monitors::{JointSample, Sample};
use nalgebra::{Isometry3, Point3};

use super::{buckets::Buckets, check_values::CheckValues, distances::NearestOverTime, plots::Floats};

/// Most buckets of a series. Each has up to two values: a wide screen has no more points.
const MOST_BUCKETS: usize = 750;
/// Most values of all series together: in base64, 2.4 MB.
const MOST_VALUES: usize = 450_000;
/// Points of the TCP's path.
const MOST_POINTS: usize = 400;

/// Quantities of a joint that are kept over time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum JointQuantity {
    Position,
    Setpoint,
    Measured,
    Velocity,
    Effort,
    /// Setpoint minus true position. Unit: rad or m.
    TrackingError,
}

const JOINT_QUANTITIES: [JointQuantity; 6] = [
    JointQuantity::Position,
    JointQuantity::Setpoint,
    JointQuantity::Measured,
    JointQuantity::Velocity,
    JointQuantity::Effort,
    JointQuantity::TrackingError,
];

impl JointQuantity {
    /// The value of a joint; NaN if the source does not know it.
    fn of(self, joints: &JointSample<'_>, joint: usize) -> f64 {
        let known = |values: &[f64]| values.get(joint).copied().unwrap_or(f64::NAN);
        let setpoint = || joints.setpoint.map_or(f64::NAN, |setpoint| setpoint.q[joint]);
        match self {
            Self::Position => joints.state().q[joint],
            Self::Setpoint => setpoint(),
            // Of a source without the truth they are the position.
            Self::Measured => joints.truth.map_or(f64::NAN, |_| joints.measured.q[joint]),
            Self::Velocity => known(joints.state().qd),
            Self::Effort => known(joints.state().effort),
            Self::TrackingError => setpoint() - joints.state().q[joint],
        }
    }
}

/// Poses of all links by model and by twin, where they differ most.
#[derive(Debug)]
pub(crate) struct LargestDifference {
    /// Which of two differences is larger: the position error that is beyond its limit, then the larger of both errors, each
    /// divided by its limit.
    rank: [f64; 2],
    pub(crate) time_s: f64,
    pub(crate) link: usize,
    pub(crate) error: PoseError,
    pub(crate) model: Vec<Pose>,
    pub(crate) twin: Vec<Isometry3<f64>>,
}

/// Everything of a run over time.
#[derive(Debug)]
pub(crate) struct RunSeries {
    links: usize,
    joints: usize,
    tolerance: Tolerance,
    tip: LinkIndex,
    tip_from_tcp: Isometry3<f64>,
    buckets: Buckets,
    pub(crate) nearest: NearestOverTime,
    /// What the checks measured.
    pub(crate) checked: CheckValues,
    pub(crate) tcp_path: DrawnPath,
    pub(crate) largest: LargestDifference,
}

impl RunSeries {
    /// Series before the first sample of a run.
    pub(crate) fn new(
        description: &RobotDescription,
        tolerance: Tolerance,
        nearest: NearestOverTime,
    ) -> Self {
        let robot = &description.robot;
        let (links, joints) = (robot.links().len(), robot.dof());
        let series = 2 * links + JOINT_QUANTITIES.len() * joints;
        Self {
            links,
            joints,
            tolerance,
            tip: description.tip,
            tip_from_tcp: description.tip_from_tcp.unwrap_or_else(Isometry3::identity),
            buckets: Buckets::new(series, MOST_BUCKETS.min(MOST_VALUES / (2 * series))),
            nearest,
            checked: CheckValues::default(),
            tcp_path: DrawnPath::default(),
            largest: LargestDifference {
                rank: [f64::NEG_INFINITY; 2],
                time_s: 0.0,
                link: 0,
                error: PoseError::default(),
                model: vec![Pose::identity(); links],
                twin: vec![Isometry3::identity(); links],
            },
        }
    }

    /// Takes the sample of one instant into every series.
    pub(crate) fn push(&mut self, sample: &mut Sample<'_>, description: &RobotDescription) {
        let time_s = sample.time_s;
        let (errors, joints, dof) = (sample.errors, &sample.joints, self.joints);
        let of_links = errors.iter().map(|error| error.position_m);
        let of_links = of_links.chain(errors.iter().map(|error| error.orientation_rad));
        // The order of the series: errors by link, then each quantity by joint. `error` and `series_of` compute
        // their indices from it.
        let of_joints = JOINT_QUANTITIES
            .into_iter()
            .flat_map(|quantity| (0..dof).map(move |joint| quantity.of(joints, joint)));
        self.buckets.push(time_s, of_links.chain(of_joints));
        let root_from_tcp = sample.twin[self.tip.get()] * self.tip_from_tcp;
        self.tcp_path.push(root_from_tcp.translation.vector.into());
        self.keep_largest(sample);
        self.checked.push(time_s, sample.values);
        self.nearest.observe(sample, description);
    }

    fn keep_largest(&mut self, sample: &Sample<'_>) {
        let Tolerance { position_m, orientation_rad } = self.tolerance;
        // Position errors within the tolerance rank alike (1.0): their rounding must not hide an orientation error.
        let rank = |error: &PoseError| {
            let [position, orientation] =
                [error.position_m / position_m, error.orientation_rad / orientation_rad];
            [position.max(1.0), position.max(orientation)]
        };
        for (link, error) in sample.errors.iter().enumerate() {
            if rank(error) > self.largest.rank {
                let largest = &mut self.largest;
                (largest.rank, largest.time_s) = (rank(error), sample.time_s);
                (largest.link, largest.error) = (link, *error);
                // Copied into memory that `new` has allocated, since this happens within the run.
                largest.model.copy_from_slice(sample.model);
                largest.twin.copy_from_slice(sample.twin);
            }
        }
    }

    /// Closes the open buckets: no sample follows.
    pub(crate) fn finish(&mut self) {
        self.buckets.finish();
        self.checked.finish();
    }

    pub(crate) fn times_s(&self) -> Floats {
        Floats(self.buckets.times_s())
    }

    /// Position errors of a link; with the largest.
    pub(crate) fn position_error(&self, link: usize) -> Option<(Floats, f32)> {
        self.error(link)
    }

    /// Orientation errors of a link; with the largest.
    pub(crate) fn orientation_error(&self, link: usize) -> Option<(Floats, f32)> {
        self.error(self.links + link)
    }

    fn error(&self, series: usize) -> Option<(Floats, f32)> {
        let (_, largest) = self.buckets.range(series)?;
        Some((Floats(self.buckets.values(series)), largest))
    }

    /// Values of a joint; `None` if there are none.
    pub(crate) fn joint_values(&self, quantity: JointQuantity, joint: usize) -> Option<Floats> {
        let series = self.series_of(quantity, joint);
        self.buckets.range(series).map(|_| Floats(self.buckets.values(series)))
    }

    /// Smallest and largest value of a joint.
    pub(crate) fn range_of_joint(&self, quantity: JointQuantity, joint: usize) -> Option<(f32, f32)> {
        self.buckets.range(self.series_of(quantity, joint))
    }

    fn series_of(&self, quantity: JointQuantity, joint: usize) -> usize {
        2 * self.links + quantity as usize * self.joints + joint
    }
}

/// A path of which every `stride`-th point is kept.
#[derive(Debug)]
pub(crate) struct DrawnPath {
    points: Vec<Point3<f64>>,
    stride: u64,
    pushed: u64,
    last: Point3<f64>,
}

impl Default for DrawnPath {
    fn default() -> Self {
        Self { points: Vec::with_capacity(MOST_POINTS), stride: 1, pushed: 0, last: Point3::origin() }
    }
}

impl DrawnPath {
    fn push(&mut self, point: Point3<f64>) {
        self.last = point;
        if self.pushed.is_multiple_of(self.stride) {
            if self.points.len() == MOST_POINTS {
                // Full: every second point goes and every second sample is taken from now on, so that the spacing
                // stays even. The first point stays.
                let mut at = 0;
                self.points.retain(|_| {
                    at += 1;
                    at % 2 == 1
                });
                self.stride *= 2;
            }
            self.points.push(point);
        }
        self.pushed += 1;
    }

    /// The points, the last one of the path included.
    pub(crate) fn points(&self) -> Vec<Point3<f64>> {
        self.points.iter().copied().chain((self.pushed > 0).then_some(self.last)).collect()
    }
}
