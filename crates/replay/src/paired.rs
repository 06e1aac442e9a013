//! Poses of a log with the joint positions around their instants.

use std::collections::BTreeMap;

use congruent_description::RobotQ;
use congruent_input::{Diagnostic, Findings};
use congruent_scenario::{LoggedPoseSettings, Scenario};
use congruent_twin::{
    RunSetup,
    source::{Advance, JointStateSource, RecordedSource},
};
use nalgebra::Isometry3;

use super::replayed::Replayed;

/// Offsets of the clock of the poses at which joint positions are kept, s: one every 25 ms. Kind: choice; between three of them the
/// path of a fast arm is a parabola within some um.
pub(super) const OFFSETS_S: [f64; 25] = [
    -0.3, -0.275, -0.25, -0.225, -0.2, -0.175, -0.15, -0.125, -0.1, -0.075, -0.05, -0.025, 0.0, 0.025, 0.05,
    0.075, 0.1, 0.125, 0.15, 0.175, 0.2, 0.225, 0.25, 0.275, 0.3,
];
/// Poses that are kept of each topic, evenly over the log.
const MOST_PAIRS: f64 = 400.0;

/// A pose, and the joint positions at its instant with each of the offsets.
#[derive(Debug, Clone)]
pub(super) struct PairedPose {
    pub(super) time_s: f64,
    pub(super) frame_from_target: Isometry3<f64>,
    pub(super) q: Vec<RobotQ>,
}

/// A pose whose joint positions are not all known yet.
struct OpenPair {
    pair: PairedPose,
    known: usize,
}

/// The pairs of each of the poses, from one pass over the log.
///
/// # Errors
/// The log cannot be read, or does not have the joints.
pub(super) fn pairs(
    replayed: &Replayed<'_>,
    poses: &[LoggedPoseSettings],
) -> Result<Vec<Vec<PairedPose>>, Findings> {
    let mut scenario = Scenario { check: Vec::new(), ..replayed.scenario.clone() };
    let Some(source) = &mut scenario.source else { return Ok(Vec::new()) };
    let at = |pose: &LoggedPoseSettings, offset_s: f64| LoggedPoseSettings {
        offset_s: pose.offset_s + offset_s,
        ..pose.clone()
    };
    source.pose = poses.iter().flat_map(|pose| OFFSETS_S.map(|offset_s| at(pose, offset_s))).collect();
    let setup = RunSetup::new(scenario, replayed.description.clone())?;
    let Some(recorded) = &setup.recorded else { return Ok(Vec::new()) };
    let refused = |error: congruent_twin::source::SourceError| {
        Findings::from(Diagnostic::error(crate::codes::replay::READ, error.to_string()))
    };
    let robot = &setup.description.robot;
    let mut source = RecordedSource::new(recorded, robot, &setup.start).map_err(refused)?;
    let slot_s = (recorded.survey.duration_s / MOST_PAIRS).max(1e-9);
    let mut open: Vec<BTreeMap<i64, OpenPair>> = poses.iter().map(|_| BTreeMap::new()).collect();
    loop {
        while let Some(pose) = source.next_pose() {
            let (of, offset) = (pose.of / OFFSETS_S.len(), pose.of % OFFSETS_S.len());
            let time_s = pose.time_s - OFFSETS_S[offset];
            #[expect(clippy::cast_possible_truncation, reason = "the cast of floats saturates")]
            let slot = (time_s / slot_s).floor() as i64;
            let entry = open[of].entry(slot).or_insert_with(|| OpenPair {
                pair: PairedPose {
                    time_s,
                    frame_from_target: pose.frame_from_target,
                    q: vec![pose.q.clone(); OFFSETS_S.len()],
                },
                known: 0,
            });
            // Of the poses in a slot the first counts, at each offset.
            if (entry.pair.time_s - time_s).abs() < SAME_S {
                entry.pair.q[offset].copy_from_slice(pose.q);
                entry.known += 1;
            }
        }
        if source.advance(0.0).map_err(refused)? == Advance::End {
            break;
        }
    }
    let whole = |of: BTreeMap<i64, OpenPair>| {
        of.into_values().filter(|open| open.known == OFFSETS_S.len()).map(|open| open.pair).collect()
    };
    Ok(open.into_iter().map(whole).collect())
}

/// Times that differ by less are those of one pose, s: the rounding of adding an offset.
const SAME_S: f64 = 1e-9;
