//! How far the values of each joint and the errors of each link went in the whole run: what the layout shows follows from
//! that.

use congruent_kinematics::PoseError;
use congruent_monitors::Sample;

/// The smallest and the largest of some values.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ValueRange {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

impl ValueRange {
    /// Without a value: any value replaces both ends.
    const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    fn include(&mut self, value: Option<f64>) {
        if let Some(value) = value.filter(|value| value.is_finite()) {
            *self = self.union(Self { low: value, high: value });
        }
    }

    /// The extent of both.
    pub(crate) fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The distance between the ends; 0 if there is no value.
    pub(crate) fn width(self) -> f64 {
        (self.high - self.low).max(0.0)
    }
}

/// The extents of one joint, rad or m.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointExtents {
    /// The smallest and the largest position.
    pub(crate) position: ValueRange,
    /// The smallest and the largest velocity.
    pub(crate) velocity: ValueRange,
    /// The smallest and the largest effort.
    pub(crate) effort: ValueRange,
    /// The smallest and the largest difference of the true position from the commanded one.
    pub(crate) deviation: ValueRange,
    /// Whether the measured position was another than the true one.
    pub(crate) is_misread: bool,
}

/// The extents of all joints and links.
#[derive(Debug)]
pub(crate) struct Extents {
    /// In the order of configuration vectors.
    pub(crate) joints: Vec<JointExtents>,
    /// The largest errors of each link.
    pub(crate) links: Vec<PoseError>,
}

impl Extents {
    /// Extents before the first sample.
    pub(crate) fn new(joints: usize, links: usize) -> Self {
        let [position, velocity, effort, deviation] = [ValueRange::NONE; 4];
        let joint = JointExtents { position, velocity, effort, deviation, is_misread: false };
        Self { joints: vec![joint; joints], links: vec![PoseError::default(); links] }
    }

    /// Takes a recorded sample.
    pub(crate) fn include(&mut self, sample: &Sample<'_>) {
        let state = sample.joints.state();
        let (measured, commanded) =
            (sample.joints.measured.q, sample.joints.setpoint.map_or(&[][..], |setpoint| &setpoint.q[..]));
        for (index, joint) in self.joints.iter_mut().enumerate() {
            let q = state.q[index];
            joint.position.include(Some(q));
            joint.velocity.include(state.qd.get(index).copied());
            joint.effort.include(state.effort.get(index).copied());
            joint.deviation.include(commanded.get(index).map(|commanded| q - commanded));
            // Any difference: an encoder without a fault reports the true position bit for bit.
            joint.is_misread |= (measured[index] - q).abs() > 0.0;
        }
        for (largest, error) in self.links.iter_mut().zip(sample.errors) {
            largest.position_m = largest.position_m.max(error.position_m);
            largest.orientation_rad = largest.orientation_rad.max(error.orientation_rad);
        }
    }
}
