//! `--camera`: rows that a camera measured, and the poses of camera and target that are free with it.

#![expect(clippy::doc_markdown, reason = "the comments are printed as help, where backticks are noise")]

use congruent::calibration::{CAMERA_GROUPS, CameraMount};

use crate::input::named;

/// The camera that measured the rows.
#[derive(Debug, clap::Args)]
pub(super) struct CameraArgument {
    /// The rows are poses (or points) of a target in the frame of a camera, camera_from_target. eye-in-hand: the camera is on the
    /// tip (its pose is the group tool) and the target is fixed to the base (group base, as the base in the target);
    /// eye-to-hand: the camera is beside the robot (group base, as the base in the camera) and the target on the tip (group tool).
    /// Both groups are free.
    #[arg(long, value_name = "MOUNT", requires = "measurements", value_parser = named::<CameraMount>())]
    camera: Option<CameraMount>,
}

impl CameraArgument {
    pub(super) fn mount(&self) -> Option<CameraMount> {
        self.camera
    }

    /// The free corrections: those that are given, and the poses of camera and target if there is a camera.
    pub(super) fn free(&self, given: &[String]) -> Vec<String> {
        let of_camera = CAMERA_GROUPS.into_iter().filter(|_| self.camera.is_some());
        let missing = of_camera.filter(|group| !given.iter().any(|each| each == group || each == "all"));
        missing.map(str::to_owned).chain(given.iter().cloned()).collect()
    }
}
