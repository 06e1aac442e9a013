//! Why recorded poses are not where the model puts them: the unit, the clock, the tool, the base, the zero of a joint, or the
//! geometry.
//!
//! Each is fitted to the poses, in the order from what is changed most easily; the first that omits four fifths of the distance is the
//! cause. A constant in the frame of the tool is the tool, a constant in that of the base the base, and what is proportional to the
//! velocity a clock. If the frames were fitted to the log, they are fitted again with each of the others.

use congruent_agreement::compare::Model;
use congruent_calibration::{
    CalibrationOptions, calibrate,
    estimation::ParameterUnit,
    measurements::MeasuredRow,
    report::{CalibrationReport, EstimatedCorrection},
};
use congruent_description::{LinkIndex, RobotDescription};
use congruent_input::display::{angle, length, quantity};
use congruent_monitors::{
    ComparedPoses,
    verdict::{CheckResult, Status},
};
use congruent_results::report::{AfterRun, explain};
use congruent_scenario::{CheckKind, PoseOrigin};
use congruent_twin::{Outcome, Run, RunSetup};
use nalgebra::Isometry3;

use super::{
    fitted::{orientation, over_offsets},
    paired::{OFFSETS_S, PairedPose, pairs},
    pose_fit::{PoseClock, PoseOverOffsets, PosesToFit, largest_offset_s},
    replayed::Replayed,
};

/// With the cause, at most this share of the distance remains.
const LEFT: f64 = 0.2;
/// Another one explains it as well if no more than so many times the distance remains.
const AS_WELL: f64 = 1.5;
/// Fewest poses of which a cause is named.
const FEWEST: usize = 10;
/// Rows of a calibration, evenly from the poses: many fits are made.
const MOST_ROWS: usize = 100;
/// Millimetres in a metre, and how near a ratio must be to it.
const MILLIMETRES: f64 = 1e3;
const NEAR: f64 = 0.05;

/// Causes of failed checks of a run, those of recorded poses among them, which become notes of their check.
pub fn explain_recorded(run: &mut Run<'_>, outcome: &mut Outcome) -> AfterRun {
    let setup = run.setup();
    let is_failed = |check: &&mut CheckResult| check.check == CheckKind::Pose && check.status == Status::Fail;
    let jump = jump(&outcome.checks);
    if let (Some(check), Some(_)) = (outcome.checks.iter_mut().find(is_failed), &setup.recorded) {
        let violated = check.measures.iter().filter(|measure| measure.first_violation.is_some());
        let moments = violated.flat_map(|measure| [&measure.first_violation, &measure.worst]);
        let beyond: Vec<String> = moments.flatten().map(|moment| moment.subject.clone()).collect();
        let causes = causes(setup, &beyond, jump.as_deref());
        // Before the other remarks: it is what to do.
        check.notes.splice(0..0, causes);
    }
    explain(run, outcome)
}

/// The jump of a joint that the check of jumps has found, which no constant error explains.
fn jump(checks: &[CheckResult]) -> Option<String> {
    let is_jump = |check: &&CheckResult| check.check == CheckKind::Step && check.status == Status::Fail;
    let measures = &checks.iter().find(is_jump)?.measures;
    let worst = measures.iter().find(|measure| measure.first_violation.is_some())?.worst.as_ref()?;
    Some(format!("{} jumped at {}, see the check step", worst.subject, quantity(worst.time_s, "s")))
}

/// A sentence for each of the poses that are beyond a limit.
fn causes(setup: &RunSetup, beyond: &[String], jump: Option<&str>) -> Vec<String> {
    let Some((source, recorded)) = setup.scenario.source.as_ref().zip(setup.recorded.as_ref()) else {
        return Vec::new();
    };
    let replayed = Replayed { description: &setup.description, scenario: &setup.scenario };
    let Ok(pairs) = pairs(&replayed, &source.pose) else { return Vec::new() };
    let cause = |(compared, pairs): (&ComparedPoses, &Vec<PairedPose>)| {
        let explained = ExplainedPoses { description: &setup.description, compared, pairs };
        // A pose that is computed by another URDF differs by that URDF: `check --against` names the difference.
        let is_asked = compared.origin != PoseOrigin::Derived && beyond.contains(&compared.name);
        is_asked.then(|| explained.cause(jump)).flatten()
    };
    let held = (!recorded.held.is_empty())
        .then(|| format!("not in the log, so taken to be at their start: {}", recorded.held.join(", ")));
    held.into_iter().chain(recorded.poses.iter().zip(&pairs).filter_map(cause)).collect()
}

/// The poses of one target.
struct ExplainedPoses<'a> {
    description: &'a RobotDescription,
    compared: &'a ComparedPoses,
    pairs: &'a [PairedPose],
}

/// A cause in words, and what remains with its correction.
struct Cause {
    what: String,
    left_m: f64,
    /// What follows the distance that remains.
    rest: String,
}

impl Cause {
    fn new(what: String, left_m: f64) -> Self {
        Self { what, left_m, rest: String::new() }
    }
}

/// What remains with some corrections.
struct RemainingError {
    rms_m: f64,
    /// Distances and angles, an angle times the reach of a wrist, m.
    size_m: f64,
    words: String,
}

impl ExplainedPoses<'_> {
    fn cause(&self, jump: Option<&str>) -> Option<String> {
        let poses = over_offsets(self.description, self.compared, self.pairs);
        if poses.len() < FEWEST {
            return None;
        }
        let name = &self.compared.name;
        if let Some(unit) = of_unit(&poses) {
            return Some(format!("cause ({name}): {unit}"));
        }
        let rows = self.rows();
        let before = self.remaining(&rows, &[])?;
        let found = self
            .of_clock(&poses, before.rms_m)
            .or_else(|| self.of_frames(&rows, &before))
            .or_else(|| self.of_arm(&rows, &before));
        let distance = length(before.rms_m);
        Some(match (found, jump) {
            (Some(Cause { what, left_m, rest }), _) => {
                let left = length(left_m);
                format!("cause ({name}): {what}; the distance falls from {distance} to {left} (rms){rest}")
            }
            (None, Some(jump)) => format!("likely cause ({name}, distance {distance} rms): {jump}"),
            (None, None) => format!(
                "no single cause found ({name}, distance {distance} rms): neither a clock within {}, the frames, the zero of one joint, nor \
                 the geometry",
                quantity(largest_offset_s(), "s")
            ),
        })
    }

    /// Measured poses of the tool centre point in the base.
    fn rows(&self) -> Vec<MeasuredRow> {
        let Ok(mut model) = Model::new(self.description) else { return Vec::new() };
        let tip_from_tcp = self.description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
        let every = self.pairs.len().div_ceil(MOST_ROWS).max(1);
        let row = |(at, pair): (usize, &PairedPose)| {
            let q = &pair.q[OFFSETS_S.len() / 2];
            let poses = model.root_from_links(q).ok()?;
            let root_from = |link: LinkIndex| poses[link.get()].to_isometry();
            let root_from_frame = root_from(self.compared.from_link) * self.compared.link_from_frame;
            let root_from_target = root_from(self.compared.link) * self.compared.link_from_target;
            let target_from_tcp = root_from_target.inverse() * root_from(self.description.tip) * tip_from_tcp;
            let base_from_root = root_from(self.description.base).inverse();
            let base_from_tcp = base_from_root * root_from_frame * pair.frame_from_target * target_from_tcp;
            Some(MeasuredRow {
                line: at + 1,
                q: q.clone(),
                tip_in_base_m: [0, 1, 2].map(|axis| Some(base_from_tcp.translation.vector[axis])),
                orientation: (!self.compared.position_only).then(|| orientation(&base_from_tcp)),
            })
        };
        self.pairs.iter().enumerate().step_by(every).filter_map(row).collect()
    }

    fn of_clock(&self, poses: &[PoseOverOffsets], before_m: f64) -> Option<Cause> {
        let clock = PosesToFit { poses, with_rotations: !self.compared.position_only }.fit().clock;
        let squares = |clock: &PoseClock| poses.iter().map(|at| at.distance_m(clock).powi(2)).sum::<f64>();
        let left_m = before_m * (squares(&clock) / squares(&PoseClock::default())).sqrt();
        let offset = quantity(self.compared.offset_s + clock.offset_s, "s");
        (clock.offset_s != 0.0 && left_m <= LEFT * before_m)
            .then(|| Cause::new(format!("the clock: write offset_s = {offset}"), left_m))
    }

    /// The tool or the base, unless they were fitted already.
    fn of_frames(&self, rows: &[MeasuredRow], before: &RemainingError) -> Option<Cause> {
        if self.compared.frames_are_fitted {
            return None;
        }
        let frames = [("the tool", "tool"), ("the base", "base")];
        let fitted = |(what, group): (&'static str, &str)| Some((what, self.remaining(rows, &[group])?));
        let is_enough = |(_, left): &(&str, RemainingError)| left.size_m <= LEFT * before.size_m;
        let (what, left) = frames.into_iter().filter_map(fitted).find(is_enough)?;
        let zero = self.of_zero(rows).filter(|zero| zero.size_m <= AS_WELL * left.size_m);
        let words = match zero {
            Some(zero) => format!(
                "either {what}, with the correction {}, or the zero of one joint, {}, which this log does not distinguish",
                left.words, zero.words
            ),
            None => format!("{what}, with the correction {}", left.words),
        };
        Some(Cause::new(words, left.rms_m))
    }

    /// The zero of one joint, both frames, or the table.
    fn of_arm(&self, rows: &[MeasuredRow], before: &RemainingError) -> Option<Cause> {
        let is_enough = |left: &RemainingError| left.size_m <= LEFT * before.size_m;
        let all = self.remaining(rows, &["all"]);
        if let Some(zero) = self.of_zero(rows).filter(is_enough) {
            let rest = all.filter(|all| all.size_m < LEFT * zero.size_m);
            let rest = rest.map(|all| format!(", with the whole geometry to {}", length(all.rms_m)));
            let cause =
                Cause::new(format!("the zero of one joint, with the correction {}", zero.words), zero.rms_m);
            return Some(Cause { rest: rest.unwrap_or_default(), ..cause });
        }
        if !self.compared.frames_are_fitted
            && let Some(left) = self.remaining(rows, &["base", "tool"]).filter(is_enough)
        {
            return Some(Cause::new(
                format!("base and tool together, with the corrections {}", left.words),
                left.rms_m,
            ));
        }
        let all = all.filter(is_enough)?;
        let what =
            "the geometry of the arm, with base and tool; `calibrate` names the corrections from still poses";
        Some(Cause::new(what.to_owned(), all.rms_m))
    }

    /// The joint whose zero alone explains most.
    fn of_zero(&self, rows: &[MeasuredRow]) -> Option<RemainingError> {
        let zeros = self.fitted(rows, &["zero-offsets"])?;
        let fixed = zeros.fixed.iter().map(|of| of.name.as_str());
        let names: Vec<&str> = zeros.parameters.iter().map(|of| of.name.as_str()).chain(fixed).collect();
        let alone = names
            .into_iter()
            .filter(|name| !is_of_frame(name))
            .filter_map(|name| self.remaining(rows, &[name]));
        alone.min_by(|a, b| a.size_m.total_cmp(&b.size_m))
    }

    /// The fit with these corrections free, and the frames if they were fitted to the log.
    fn fitted(&self, rows: &[MeasuredRow], free: &[&str]) -> Option<CalibrationReport> {
        let frames: &[&str] = if self.compared.frames_are_fitted { &["base", "tool"] } else { &[] };
        let free: Vec<String> = free.iter().chain(frames).map(|&word| word.to_owned()).collect();
        let free = if free.is_empty() { vec!["tool".to_owned()] } else { free };
        let options = CalibrationOptions { free, suggestions: 0, ..CalibrationOptions::default() };
        calibrate(self.description, rows, &options).ok()
    }

    /// What remains with these corrections; of none, what is there.
    fn remaining(&self, rows: &[MeasuredRow], free: &[&str]) -> Option<RemainingError> {
        const LENGTH_M: f64 = 0.3;
        let report = self.fitted(rows, free)?;
        let is_nominal = free.is_empty() && !self.compared.frames_are_fitted;
        let of = if is_nominal { report.nominal } else { report.least_squares.residuals };
        let size_m = libm::hypot(of.rms_m, LENGTH_M * of.rms_rad);
        let matter = report.parameters.iter().filter(|of| of.significant);
        let matter = matter.filter(|of| !(self.compared.frames_are_fitted && is_of_frame(&of.name)));
        let words: Vec<String> = matter.map(value_words).collect();
        Some(RemainingError { rms_m: of.rms_m, size_m, words: words.join(", ") })
    }
}

fn is_of_frame(name: &str) -> bool {
    name.starts_with("base.") || name.starts_with("tool.")
}

fn value_words(of: &EstimatedCorrection) -> String {
    let value = if of.unit == ParameterUnit::Angle { angle(of.correction) } else { length(of.correction) };
    format!("{} {value}", of.name)
}

/// Whether the recorded positions are in millimetres.
fn of_unit(poses: &[PoseOverOffsets]) -> Option<String> {
    let sum = |of: &dyn Fn(&PoseOverOffsets) -> f64| poses.iter().map(of).sum::<f64>();
    let recorded = sum(&|pose| pose.recorded.translation.vector.norm());
    let modelled = sum(&|pose| pose.by_model[OFFSETS_S.len() / 2].translation.vector.norm());
    let is_millimetre = (recorded / modelled / MILLIMETRES - 1.0).abs() < NEAR;
    is_millimetre.then(|| {
        "the unit: the positions are a thousand times as far as by the model, so they are in mm".to_owned()
    })
}
