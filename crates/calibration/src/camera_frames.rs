//! Where camera and target are, how well that is known, and how both could be moved together without any row showing it.

use congruent_description::RobotDescription;
use congruent_kinematics::{Pose, ReportedPose, rotation_log};
use nalgebra::{DMatrix, Vector3};
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    camera::CameraMount,
    chain::NominalChain,
    estimation::{CorrectedChain, Displacements, FixedParameter},
};

/// Step of the derivatives of a pose. Unit: m and rad; kind: cube root of the rounding of a double, where both errors of a central
/// difference are alike.
const STEP: f64 = 1e-5;
/// A frame moves with what no row shows if one unit of it moves the frame by more than this, per unit of both. Kind: judgement: a
/// correlation omits shares below 0.01.
const MOVES: f64 = 0.03;

/// Camera and target with the recommended estimate. The other corrections are right together with these.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CameraFrames {
    /// Where the camera is mounted.
    pub mount: CameraMount,
    /// The camera: on link `tip` in the hand, otherwise on link `base`.
    pub camera: FrameOnLink,
    /// The target: on link `base` if the camera is in the hand, otherwise on link `tip`.
    pub target: FrameOnLink,
    /// Whether orientations of the target were measured; otherwise its orientation here is arbitrary.
    pub has_orientation: bool,
    /// How camera and target could be moved together without any row showing it; left out if they are determined.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub undetermined: Vec<SharedMotion>,
}

impl CameraFrames {
    /// How camera and target could be moved: `camera and target can be shifted together along [0.00, 0.00, 1.00] of tool0`.
    pub fn undetermined_in_words(&self) -> String {
        let motion = |motion: &SharedMotion| {
            let how = if motion.is_turn { "turned together about" } else { "shifted together along" };
            let number = |value: f64| format!("{value:.2}").replace("-0.00", "0.00");
            format!("{how} [{}] of {}", motion.direction.map(number).join(", "), motion.link)
        };
        let motions: Vec<String> = self.undetermined.iter().map(motion).collect();
        format!("camera and target can be {}, with the same residuals", motions.join(" and "))
    }
}

/// A frame that is fixed to a link.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FrameOnLink {
    /// Name of the link.
    pub link: String,
    /// Pose of the frame in the link.
    pub link_from_frame: ReportedPose,
    /// Standard deviations of its position along the axes of the link, m; left out if they are not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_deviation_m: Option<[f64; 3]>,
    /// Standard deviations of its orientation as turns about the axes of the link, rad; left out if they are not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation_deviation_rad: Option<[f64; 3]>,
}

/// A motion of the camera, and with it of the target, that no row shows.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SharedMotion {
    /// Whether the camera turns; otherwise it is shifted.
    pub is_turn: bool,
    /// The axis of the turn, or the direction of the shift, in the link of the camera. Unit length.
    pub direction: [f64; 3],
    /// That link.
    pub link: String,
}

/// An estimate of camera and target together with corrections of the arm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CameraEstimate<'a> {
    pub(crate) mount: CameraMount,
    pub(crate) description: &'a RobotDescription,
    pub(crate) nominal: &'a NominalChain<'a>,
    pub(crate) chain: &'a CorrectedChain,
    pub(crate) corrections: &'a [f64],
    /// The estimated corrections with their covariance, if the noise is known.
    pub(crate) covariance: Option<(&'a [usize], &'a DMatrix<f64>)>,
    pub(crate) fixed: &'a [FixedParameter],
    pub(crate) has_orientation: bool,
}

/// A rate of a frame: of its origin, and of its orientation, both in its link.
#[derive(Debug, Clone, Copy)]
struct FrameRate {
    linear: Vector3<f64>,
    angular: Vector3<f64>,
}

impl CameraEstimate<'_> {
    pub(crate) fn frames(&self) -> CameraFrames {
        let links = match self.mount {
            CameraMount::EyeInHand => [self.description.tip, self.description.base],
            CameraMount::EyeToHand => [self.description.base, self.description.tip],
        };
        let deviations = self.deviations();
        let poses = self.poses(self.corrections);
        let [camera, target] = [0, 1].map(|of| FrameOnLink {
            link: self.description.robot.link(links[of]).name.clone(),
            link_from_frame: ReportedPose::from(&poses[of]),
            position_deviation_m: deviations.map(|each| each[of][0]),
            orientation_deviation_rad: deviations
                .map(|each| each[of][1])
                .filter(|_| of == 0 || self.has_orientation),
        });
        let undetermined = self.undetermined(&camera.link);
        CameraFrames {
            mount: self.mount,
            camera,
            target,
            has_orientation: self.has_orientation,
            undetermined,
        }
    }

    /// Of camera and target in their links, with these corrections.
    fn poses(&self, corrections: &[f64]) -> [Pose; 2] {
        let moved = Displacements::new(self.chain, corrections);
        let on_base = moved.base.inverse();
        let on_tip = self.nominal.tip_from_measured(&moved.tool);
        match self.mount {
            CameraMount::EyeInHand => [on_tip, on_base],
            CameraMount::EyeToHand => [on_base, on_tip],
        }
    }

    /// Rates of camera and target as the corrections change in this direction.
    fn rates(&self, direction: &[(usize, f64)]) -> [FrameRate; 2] {
        let at = |step: f64| {
            let mut corrections = self.corrections.to_vec();
            for &(at, rate) in direction {
                corrections[at] += step * rate;
            }
            self.poses(&corrections)
        };
        let (before, after) = (at(-STEP), at(STEP));
        [0, 1].map(|of| {
            let turn = rotation_log(&(after[of].rotation * before[of].rotation.transpose()));
            FrameRate {
                linear: (after[of].translation - before[of].translation) / (2.0 * STEP),
                angular: turn / (2.0 * STEP),
            }
        })
    }

    /// Standard deviations of position and orientation, of the camera and of the target.
    fn deviations(&self) -> Option<[[[f64; 3]; 2]; 2]> {
        let (kept, covariance) = self.covariance?;
        let rates: Vec<[FrameRate; 2]> = kept.iter().map(|&at| self.rates(&[(at, 1.0)])).collect();
        let deviation = |of: usize, part: fn(&FrameRate) -> Vector3<f64>| {
            [0, 1, 2].map(|axis| {
                let rate = |at: usize| part(&rates[at][of])[axis];
                let terms = (0..kept.len()).flat_map(|a| (0..kept.len()).map(move |b| (a, b)));
                terms.map(|(a, b)| rate(a) * covariance[(a, b)] * rate(b)).sum::<f64>().max(0.0).sqrt()
            })
        };
        let both = [0, 1].map(|of| [deviation(of, |rate| rate.linear), deviation(of, |rate| rate.angular)]);
        both.as_flattened().as_flattened().iter().all(|each| each.is_finite()).then_some(both)
    }

    /// Along each correction of a frame that is fixed, together with those that it is correlated with, no row changes.
    fn undetermined(&self, camera_link: &str) -> Vec<SharedMotion> {
        let parameters = self.chain.parameters();
        let of_frames = self.fixed.iter().filter(|each| parameters[each.parameter].entry.is_of_frame());
        let motion = |fixed: &FixedParameter| {
            let others = fixed.correlated_with.iter().map(|&(at, rate)| (at, -rate));
            let direction: Vec<(usize, f64)> = [(fixed.parameter, 1.0)].into_iter().chain(others).collect();
            let [camera, target] = self.rates(&direction);
            // A target of points has no orientation that could be wrong.
            let of_target =
                target.linear.norm() + if self.has_orientation { target.angular.norm() } else { 0.0 };
            let is_turn = camera.angular.norm() > MOVES;
            let moved = if is_turn { camera.angular } else { camera.linear };
            let is_moved = moved.norm() > MOVES || of_target > MOVES;
            is_moved.then(|| SharedMotion {
                is_turn,
                direction: moved.normalize().into(),
                link: camera_link.to_owned(),
            })
        };
        of_frames.filter_map(motion).collect()
    }
}
