//! The corrections of base and tool among those of a chain, and their values for given frames.

use congruent_kinematics::{EulerSet, Pose};

use super::frames::{BaseAndTool, WhichFrames};
use crate::estimation::model::{CorrectedChain, CorrectionEntry};

/// A smaller correction is rounding of the products of poses. Unit: m and rad.
const ROUNDING: f64 = 1e-12;

/// Indices of the corrections of base and tool; `None` for a frame that may not move in all six directions, since no closed
/// form holds some of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct FreeFrames {
    base: Option<[usize; 6]>,
    tool: Option<[usize; 6]>,
}

impl FreeFrames {
    /// `None` if neither frame is free.
    pub(super) fn of(chain: &CorrectedChain) -> Option<Self> {
        let all_six = |entry: CorrectionEntry| {
            let of_frame = chain.parameters().iter().enumerate().filter(|(_, each)| each.entry == entry);
            of_frame.map(|(at, _)| at).collect::<Vec<_>>().try_into().ok()
        };
        let free = Self { base: all_six(CorrectionEntry::Base), tool: all_six(CorrectionEntry::Tool) };
        (free.base.is_some() || free.tool.is_some()).then_some(free)
    }

    pub(super) fn which(&self) -> WhichFrames {
        WhichFrames { base: self.base.is_some(), tool: self.tool.is_some() }
    }

    /// The start of the chain with the corrections of these frames.
    pub(super) fn start(&self, chain: &CorrectedChain, frames: &BaseAndTool) -> Vec<f64> {
        let mut start = chain.start().to_vec();
        for (indices, pose) in [(self.base, &frames.measured_from_base), (self.tool, &frames.tip_from_target)]
        {
            let Some(indices) = indices else { continue };
            indices.into_iter().zip(corrections(pose)).for_each(|(at, value)| start[at] = value);
        }
        start
    }
}

/// The corrections of a frame in the order of its parameters: `x y z`, then `yaw pitch roll`, m and rad.
fn corrections(pose: &Pose) -> [f64; 6] {
    let [yaw, pitch, roll] = EulerSet::Zyx.angles(&pose.rotation).angles_rad;
    let [x, y, z] = pose.translation.into();
    // What nothing has moved is at nominal, and not some 1e-16 from it.
    [x, y, z, yaw, pitch, roll].map(|value| if value.abs() < ROUNDING { 0.0 } else { value })
}
