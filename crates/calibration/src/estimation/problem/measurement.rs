//! One measured pose or point of the tip, and its residual against a model.

use congruent_description::ChainQ;
use congruent_kinematics::{Pose, rotation_log};
use nalgebra::{Matrix3, Vector3};

use super::noise::Noise;

/// What was measured at one configuration.
///
/// | field | shape | unit | frame |
/// |---|---|---|---|
/// | `q` | n | rad, m | joints of the chain |
/// | `tip_in_base_m` | 3 | m | base; `None` for a coordinate that was not measured |
/// | `base_from_tip` | 3 x 3 | 1 | orientation, if it was measured |
/// | `camera_from_target` | SE(3) | m | what a camera at the tip saw; the two above are then of the target |
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// Joint positions as the robot reported them.
    pub q: ChainQ,
    /// Measured position of the tip.
    pub tip_in_base_m: [Option<f64>; 3],
    /// Measured orientation of the tip.
    pub base_from_tip: Option<Matrix3<f64>>,
    /// Pose of the target that was measured, in the tip; `None` if it is the tip itself.
    pub camera_from_target: Option<Pose>,
}

impl Measurement {
    /// Number of measured coordinates of the position.
    pub fn position_count(&self) -> usize {
        self.tip_in_base_m.iter().flatten().count()
    }

    /// Number of measured components of the orientation.
    pub fn orientation_count(&self) -> usize {
        if self.base_from_tip.is_some() { 3 } else { 0 }
    }

    /// Number of measured components, of position and orientation.
    pub fn component_count(&self) -> usize {
        self.position_count() + self.orientation_count()
    }

    /// The modelled pose of what was measured, for that of the tip.
    pub fn base_from_target(&self, base_from_tip: &Pose) -> Pose {
        self.camera_from_target.map_or(*base_from_tip, |seen| *base_from_tip * seen)
    }

    /// The point whose velocity is the derivative of the position residual, for the modelled pose of what was measured.
    ///
    /// A camera's target is taken where it was measured: a turn about that point does not change the distance from it, so the gradient
    /// is the same, and turns that no row shows have exactly no effect, however far the model is off.
    pub(in crate::estimation) fn moved_point(&self, base_from_target: &Pose) -> Vector3<f64> {
        let measured = self.camera_from_target.map(|_| self.tip_in_base_m.map(Option::unwrap_or_default));
        measured.map_or(base_from_target.translation, Vector3::from)
    }

    /// The pose or point of the target in the camera at the tip, as if that camera were the base; `None` if there is none.
    pub(in crate::estimation) fn in_the_camera(&self) -> Option<Self> {
        let seen = self.camera_from_target?;
        Some(Self {
            q: self.q.clone(),
            tip_in_base_m: <[f64; 3]>::from(seen.translation).map(Some),
            base_from_tip: self.base_from_tip.and(Some(seen.rotation)),
            camera_from_target: None,
        })
    }

    /// Residual of this measurement at a modelled pose of the tip: measured minus modelled.
    pub fn residual(&self, base_from_tip: &Pose) -> PoseResidual {
        let modelled = self.base_from_target(base_from_tip);
        let along =
            |at: usize| self.tip_in_base_m[at].map_or(0.0, |measured| measured - modelled.translation[at]);
        let orientation_rad = self.base_from_tip.map_or(Vector3::zeros(), |measured| {
            // measured = exp([e]) modelled, so e is a rotation vector in the base, like the position residual.
            rotation_log(&(measured * modelled.rotation.transpose()))
        });
        PoseResidual { position_m: Vector3::new(along(0), along(1), along(2)), orientation_rad }
    }
}

/// Measured minus modelled, in the base; 0 in components that were not measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseResidual {
    /// Difference of the positions.
    pub position_m: Vector3<f64>,
    /// The rotation from the modelled to the measured orientation, axis times angle.
    pub orientation_rad: Vector3<f64>,
}

impl PoseResidual {
    /// Squared norm in units of the noise.
    pub(in crate::estimation) fn whitened_squared(&self, noise: &Noise) -> f64 {
        self.position_m.norm_squared() / noise.position_m.powi(2)
            + self.orientation_rad.norm_squared() / noise.orientation_rad.powi(2)
    }
}
