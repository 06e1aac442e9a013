//! How far the values of each joint and the errors of each link went in the whole run: what the layout shows follows from
//! that.

use congruent_kinematics::PoseError;
use congruent_monitors::Sample;

/// The extents of one joint, rad or m.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointExtents {
    /// The smallest and the largest position.
    pub(crate) position: (f64, f64),
    /// The smallest and the largest velocity.
    pub(crate) velocity: (f64, f64),
    /// The smallest and the largest effort.
    pub(crate) effort: (f64, f64),
    /// The smallest and the largest difference of the true position from the commanded one.
    pub(crate) deviation: (f64, f64),
    /// Whether the measured position was another than the true one.
    pub(crate) is_misread: bool,
}

/// Range without a value: any value replaces both ends.
const NONE: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

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
        let joint =
            JointExtents { position: NONE, velocity: NONE, effort: NONE, deviation: NONE, is_misread: false };
        Self { joints: vec![joint; joints], links: vec![PoseError::default(); links] }
    }

    /// Takes a recorded sample.
    pub(crate) fn include(&mut self, sample: &Sample<'_>) {
        let truth = &sample.joints.truth;
        let (measured, commanded) =
            (sample.joints.measured.q, sample.joints.setpoint.map_or(&[][..], |setpoint| &setpoint.q[..]));
        for (index, joint) in self.joints.iter_mut().enumerate() {
            let q = truth.q[index];
            widen(&mut joint.position, Some(q));
            widen(&mut joint.velocity, truth.qd.get(index).copied());
            widen(&mut joint.effort, truth.effort.get(index).copied());
            widen(&mut joint.deviation, commanded.get(index).map(|commanded| q - commanded));
            // Any difference: an encoder without a fault reports the true position bit for bit.
            joint.is_misread |= (measured[index] - q).abs() > 0.0;
        }
        for (largest, error) in self.links.iter_mut().zip(sample.errors) {
            largest.position_m = largest.position_m.max(error.position_m);
            largest.orientation_rad = largest.orientation_rad.max(error.orientation_rad);
        }
    }
}

fn widen((low, high): &mut (f64, f64), value: Option<f64>) {
    if let Some(value) = value.filter(|value| value.is_finite()) {
        (*low, *high) = (low.min(value), high.max(value));
    }
}

/// The distance between the ends of a range; 0 if it is empty.
pub(crate) fn width((low, high): (f64, f64)) -> f64 {
    (high - low).max(0.0)
}
