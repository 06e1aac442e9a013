//! Why recorded poses are not where the model puts them: the clock, the tool, the base, the zero of a joint, or the geometry.
//!
//! Each is fitted alone to the poses, in the order from what is changed most easily; the first that omits four fifths of the
//! distance is the cause. A constant in the frame of the tool is the tool, a constant in that of the base the base, and what is
//! proportional to the velocity a clock.

use congruent_agreement::compare::Model;
use congruent_calibration::{
    CalibrationOptions, calibrate,
    measurements::{MeasuredRow, WrittenOrientation},
    report::CalibrationReport,
};
use congruent_description::RobotDescription;
use congruent_input::display::{angle, length, quantity};
use congruent_monitors::{ComparedPoses, verdict::Status};
use congruent_results::report::{Causes, explain};
use congruent_scenario::{CheckKind, PoseOrigin};
use congruent_twin::{Outcome, Run, RunSetup};
use nalgebra::Isometry3;

use super::{
    paired::{OFFSETS_S, PairedPose, pairs},
    pose_clock::{PositionsOverOffsets, pose_clock},
    replayed::Replayed,
};

/// With the cause, at most this share of the distance remains.
const LEFT: f64 = 0.2;
/// Fewest poses of which a cause is named.
const FEWEST: usize = 10;

/// Causes of failed checks of a run, those of recorded poses among them, which become notes of their check.
pub fn explain_recorded(run: &mut Run<'_>, outcome: &mut Outcome) -> Causes {
    let setup = run.setup();
    let failed = outcome
        .checks
        .iter_mut()
        .find(|check| check.check == CheckKind::Pose && check.status == Status::Fail);
    if let (Some(check), Some(_)) = (failed, &setup.recorded) {
        let limit_m = check.measures.first().map_or(f64::INFINITY, |measure| measure.limit);
        // Before the other remarks: it is what to do.
        check.notes.splice(0..0, causes(setup, limit_m));
    }
    explain(run, outcome)
}

/// A sentence for each of the poses that are beyond the limit.
fn causes(setup: &RunSetup, limit_m: f64) -> Vec<String> {
    let Some((source, recorded)) = setup.scenario.source.as_ref().zip(setup.recorded.as_ref()) else {
        return Vec::new();
    };
    let replayed = Replayed { description: &setup.description, scenario: &setup.scenario };
    let Ok(pairs) = pairs(&replayed, &source.pose) else { return Vec::new() };
    let each = recorded.poses.iter().zip(&pairs);
    let cause = |(compared, pairs): (&ComparedPoses, &Vec<PairedPose>)| {
        let explained = Explained { description: &setup.description, compared, pairs };
        // A pose that is computed by another URDF differs by that URDF: `check --against` names the difference.
        (compared.origin != PoseOrigin::Derived).then(|| explained.cause(limit_m)).flatten()
    };
    each.filter_map(cause).collect()
}

/// The poses of one target.
struct Explained<'a> {
    description: &'a RobotDescription,
    compared: &'a ComparedPoses,
    pairs: &'a [PairedPose],
}

/// A pose with what the model says of it.
struct ModelledPose {
    positions: PositionsOverOffsets,
    row: MeasuredRow,
}

impl Explained<'_> {
    fn cause(&self, limit_m: f64) -> Option<String> {
        let poses = self.modelled();
        if poses.len() < FEWEST {
            return None;
        }
        let largest_m = poses.iter().map(|pose| pose.positions.distance_m()).fold(0.0, f64::max);
        if largest_m <= limit_m {
            return None;
        }
        let positions: Vec<PositionsOverOffsets> = poses.iter().map(|pose| pose.positions.clone()).collect();
        let squares = positions.iter().map(|at| at.distance_m() * at.distance_m()).sum::<f64>();
        #[expect(clippy::cast_precision_loss, reason = "some hundred")]
        let before_m = (squares / positions.len() as f64).sqrt();
        let clock = pose_clock(&positions);
        let rows: Vec<MeasuredRow> = poses.into_iter().map(|pose| pose.row).collect();
        let name = &self.compared.name;
        let [before, after] = [before_m, clock.rms_m].map(length);
        if clock.rms_m <= LEFT * before_m {
            let offset = quantity(clock.offset_s, "s");
            return Some(format!(
                "cause ({name}, distance {before} rms): the clock: with offset_s = {offset} it is {after}"
            ));
        }
        let found = self.of_frames(&rows, before_m).or_else(|| self.of_arm(&rows, before_m));
        Some(match found {
            Some(cause) => format!("cause ({name}, distance {before} rms): {cause}"),
            None => format!(
                "no cause found ({name}, distance {before} rms): neither the clock nor base, tool, a joint's zero or the table explains it"
            ),
        })
    }

    fn modelled(&self) -> Vec<ModelledPose> {
        let Ok(mut model) = Model::new(self.description) else { return Vec::new() };
        let tip_from_tcp = self.description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
        let middle = OFFSETS_S.len() / 2;
        let mut modelled = Vec::with_capacity(self.pairs.len());
        for (at, pair) in self.pairs.iter().enumerate() {
            let mut by_model = Vec::with_capacity(OFFSETS_S.len());
            for q in &pair.q {
                let Ok(poses) = model.root_from_links(q) else { break };
                by_model.push(self.compared.frame_from_target(poses).translation.vector);
            }
            let Ok(poses) = model.root_from_links(&pair.q[middle]) else { continue };
            let root_from = |link: congruent_description::LinkIndex| poses[link.get()].to_isometry();
            let root_from_frame = root_from(self.compared.from_link) * self.compared.link_from_frame;
            let root_from_target = root_from(self.compared.link) * self.compared.link_from_target;
            let target_from_tcp = root_from_target.inverse() * root_from(self.description.tip) * tip_from_tcp;
            let base_from_tcp = root_from(self.description.base).inverse()
                * root_from_frame
                * pair.frame_from_target
                * target_from_tcp;
            if by_model.len() == OFFSETS_S.len() {
                let recorded = pair.frame_from_target.translation.vector;
                modelled.push(ModelledPose {
                    positions: PositionsOverOffsets { time_s: pair.time_s, by_model, recorded },
                    row: self.row(at, pair, &base_from_tcp),
                });
            }
        }
        modelled
    }

    fn row(&self, at: usize, pair: &PairedPose, base_from_tcp: &Isometry3<f64>) -> MeasuredRow {
        let rotation = base_from_tcp.rotation.quaternion();
        let wxyz = [rotation.w, rotation.i, rotation.j, rotation.k];
        MeasuredRow {
            line: at + 1,
            q: pair.q[OFFSETS_S.len() / 2].clone(),
            tip_in_base_m: [0, 1, 2].map(|axis| Some(base_from_tcp.translation.vector[axis])),
            orientation: (!self.compared.position_only).then_some(WrittenOrientation::QuaternionWxyz(wxyz)),
        }
    }

    /// The tool, or the base.
    fn of_frames(&self, rows: &[MeasuredRow], before_m: f64) -> Option<String> {
        let frame = |group: &str, what: &str| {
            let report = self.fitted(rows, &[group])?;
            let left_m = report.least_squares.residuals.rms_m;
            let values = values(&report, "");
            (left_m <= LEFT * before_m).then(|| format!("{what}: with {values} it is {}", length(left_m)))
        };
        frame("tool", "the tool").or_else(|| frame("base", "the base"))
    }

    /// The zero of one joint, both frames, or the table.
    fn of_arm(&self, rows: &[MeasuredRow], before_m: f64) -> Option<String> {
        let zeros = self.fitted(rows, &["zero-offsets"])?;
        let names: Vec<&str> = zeros.parameters.iter().map(|of| of.name.as_str()).collect();
        let alone = names.into_iter().filter_map(|name| {
            let report = self.fitted(rows, &[name])?;
            Some((report.least_squares.residuals.rms_m, values(&report, "")))
        });
        if let Some((left_m, values)) =
            alone.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|of| of.0 <= LEFT * before_m)
        {
            return Some(format!("the zero of one joint: with {values} it is {}", length(left_m)));
        }
        for (free, what) in [
            (&["base", "tool"][..], "base and tool together"),
            (&["all"][..], "the geometry of the arm, with base and tool"),
        ] {
            let left_m = self.fitted(rows, free)?.least_squares.residuals.rms_m;
            if left_m <= LEFT * before_m {
                let left = length(left_m);
                return Some(format!(
                    "{what}: corrections leave {left}; `calibrate` on still poses names them"
                ));
            }
        }
        None
    }

    fn fitted(&self, rows: &[MeasuredRow], free: &[&str]) -> Option<CalibrationReport> {
        let free = free.iter().map(|&word| word.to_owned()).collect();
        let options = CalibrationOptions { free, suggestions: 0, ..CalibrationOptions::default() };
        calibrate(self.description, rows, &options).ok()
    }
}

/// The corrections that matter, for a sentence.
fn values(report: &CalibrationReport, empty: &str) -> String {
    let matter = report.parameters.iter().filter(|of| of.significant);
    let one = |of: &congruent_calibration::report::EstimatedCorrection| {
        let value = if of.unit == congruent_calibration::estimation::ParameterUnit::Angle {
            angle(of.correction)
        } else {
            length(of.correction)
        };
        format!("{} {value}", of.name)
    };
    let listed: Vec<String> = matter.map(one).collect();
    if listed.is_empty() { empty.to_owned() } else { listed.join(", ") }
}
