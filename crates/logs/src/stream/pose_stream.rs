//! Poses of one selection, each at its own time.

use super::selection::SelectedPoses;
use crate::event::LoggedPose;

/// A pose of a log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StreamedPose {
    /// Number of the selection that it belongs to.
    pub selection: usize,
    /// Time from the origin on, with the offset of the selection, s.
    pub time_s: f64,
    /// Position of the target in the frame of the poses, m.
    pub target_in_frame_m: [f64; 3],
    /// Rotation from the target to the frame, scalar first, of norm 1.
    pub frame_from_target_wxyz: [f64; 4],
}

/// How many poses of a selection were taken, and why others were not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PoseCounts {
    /// Poses that were given.
    pub taken: u64,
    /// Poses with a value that is not finite, or without a rotation.
    pub not_finite: u64,
    /// Poses at the time of the one before.
    pub repeated: u64,
}

/// The poses of one selection so far.
#[derive(Debug)]
pub(super) struct PoseSeries {
    selection: SelectedPoses,
    before_s: f64,
    pub(super) counts: PoseCounts,
}

impl PoseSeries {
    pub(super) fn new(selection: SelectedPoses) -> Self {
        Self { selection, before_s: f64::NAN, counts: PoseCounts::default() }
    }

    pub(super) fn is_of(&self, topic: &str, pose: &LoggedPose) -> bool {
        let SelectedPoses { topic: wanted, frame, child, .. } = &self.selection;
        wanted == topic && *frame == pose.frame && *child == pose.child
    }

    /// The pose at its time, if it is one; `time_s` is that of its message.
    pub(super) fn take(&mut self, selection: usize, time_s: f64, pose: &LoggedPose) -> Option<StreamedPose> {
        let norm = pose.frame_from_child_wxyz.iter().map(|part| part * part).sum::<f64>().sqrt();
        let is_position = pose.child_in_frame_m.iter().all(|part| part.is_finite());
        if !is_position || !norm.is_finite() || norm < SMALLEST_NORM {
            self.counts.not_finite += 1;
            return None;
        }
        #[expect(clippy::float_cmp, reason = "the time of one message")]
        if time_s == self.before_s {
            self.counts.repeated += 1;
            return None;
        }
        self.before_s = time_s;
        self.counts.taken += 1;
        let SelectedPoses { offset_s, drift, .. } = self.selection;
        Some(StreamedPose {
            selection,
            time_s: time_s + offset_s + drift * time_s,
            target_in_frame_m: pose.child_in_frame_m,
            frame_from_target_wxyz: pose.frame_from_child_wxyz.map(|part| part / norm),
        })
    }
}

/// A quaternion of a smaller norm is no rotation: drivers publish zeros before they have a pose.
const SMALLEST_NORM: f64 = 0.5;
