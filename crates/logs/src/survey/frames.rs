//! The frames of poses and of TF.

use std::{
    collections::BTreeSet,
    hash::{DefaultHasher, Hash, Hasher},
};

use super::{clock::MessageSum, report::FramePair};
use crate::event::LoggedPose;

/// Most frames of a topic that are listed.
const MOST_FRAMES: usize = 100;

/// The frames of a topic so far.
#[derive(Debug, Default)]
pub(super) struct FramesTrack {
    pairs: BTreeSet<FramePair>,
}

impl FramesTrack {
    pub(super) fn take(&mut self, pose: &LoggedPose) {
        if self.pairs.len() == MOST_FRAMES {
            return;
        }
        let is_known = self.pairs.iter().any(|pair| pair.frame == pose.frame && pair.child == pose.child);
        if !is_known {
            self.pairs.insert(FramePair { frame: pose.frame.clone(), child: pose.child.clone() });
        }
    }

    pub(super) fn report(&self) -> Vec<FramePair> {
        self.pairs.iter().cloned().collect()
    }
}

pub(super) fn pose_sum(pose: &LoggedPose) -> MessageSum {
    let (mut about, mut values) = (DefaultHasher::new(), DefaultHasher::new());
    (&pose.frame, &pose.child).hash(&mut about);
    let numbers = pose.child_in_frame_m.iter().chain(&pose.frame_from_child_wxyz);
    numbers.for_each(|value| value.to_bits().hash(&mut values));
    MessageSum { about: about.finish(), values: values.finish() }
}
