//! `--camera`: rows that a camera measured, and the poses of camera and target that are free with it.

use congruent::calibration::{CAMERA_GROUPS, CameraMount};

use crate::input::named;

/// The camera that measured the rows.
#[derive(Debug, clap::Args)]
pub(super) struct CameraArgument {
    /// The rows are poses (or points) of a target in the frame of a camera. eye-in-hand: the camera is on the tip and the target
    /// fixed to the base; eye-to-hand: the camera is beside the robot and the target is on the tip. Frees the poses of
    /// both, as the groups base and tool.
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
