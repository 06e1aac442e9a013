//! Other readings of a file of measurements: slips of units, order and frame that are common, each tried
//! where the free corrections explain nothing.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::{
    LikelyReason,
    reach_scale::{LARGE_CORRECTION, Left, ReachScale},
};
use crate::{
    chain::{Motion, NominalChain},
    computed::measurement,
    estimation::{
        CorrectedChain, Loss, Noise, Problem, fit, fit_robustly, fit_with_estimated_noise, identify,
    },
    free,
    measurements::{MeasuredRow, WrittenOrientation},
    options::CalibrationOptions,
};

/// Millimetres in a metre.
const KILO: f64 = 1e3;
/// Degrees in a radian.
const DEGREES: f64 = 180.0 / PI;
/// A reading is likely where it leaves less than this share of what is left without it.
const MUCH_BETTER: f64 = 0.1;
/// A later reading of the list must leave less than this share of what an earlier one does: more free
/// corrections always leave a little less.
const BETTER: f64 = 0.5;

/// So many rows tell whether a reading is worth all of them.
const SOME_ROWS: usize = 60;

/// A row read differently; `None` where the reading does not apply to it.
type Reread<'a> = Box<dyn Fn(&MeasuredRow) -> Option<MeasuredRow> + 'a>;

/// One way in which the file may be meant.
struct Reading<'a> {
    /// A clause that follows "if".
    what: String,
    reread: Reread<'a>,
    /// Groups of corrections that are free besides those that were asked for.
    free: &'static [&'static str],
}

/// What is wrong with the file as it is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Doubt {
    /// So large a share of the reach is left.
    Left(f64),
    /// So large corrections are needed, as a share of the reach or as an angle.
    Size(f64),
}

/// What an estimate under a reading comes to.
#[derive(Debug, Clone, Copy)]
struct Tried {
    left: Left,
    size: f64,
    /// Whether a frame is free besides: what it turns, a joint's zero may turn as well, and as far.
    is_of_a_frame: bool,
}

impl Doubt {
    /// By little that is left and small corrections: an arm that shrinks to nothing leaves nothing of
    /// positions in millimetres.
    fn is_settled_by(self, tried: &Tried) -> bool {
        let is_small = tried.size < LARGE_CORRECTION;
        let is_settled = match self {
            Self::Left(share) => {
                tried.left.share() < MUCH_BETTER * share && (is_small || tried.is_of_a_frame)
            }
            Self::Size(size) => tried.size < MUCH_BETTER * size && is_small,
        };
        is_settled && !tried.left.is_large()
    }
}

/// The reading that settles the doubt, if there is one: of several the one that leaves least, and of nearly
/// equal ones the first of the list.
pub(super) fn likely_reason(
    nominal: &NominalChain<'_>,
    rows: &[MeasuredRow],
    options: &CalibrationOptions,
    doubt: Doubt,
) -> Option<LikelyReason> {
    let mut best: Option<(String, Left)> = None;
    for reading in readings(nominal) {
        let tried = tried(nominal, rows, options, &reading).filter(|tried| doubt.is_settled_by(tried));
        let Some(Tried { left, .. }) = tried else { continue };
        if best.as_ref().is_none_or(|(_, best)| left.share() < BETTER * best.share()) {
            best = Some((reading.what, left));
        }
    }
    best.map(|(what, Left { rms_m, rms_rad, .. })| LikelyReason { what, rms_m, rms_rad })
}

/// A robust estimate under a reading; `None` where the reading does not apply, or leaves half of the rows
/// far off.
fn tried(
    nominal: &NominalChain<'_>,
    rows: &[MeasuredRow],
    options: &CalibrationOptions,
    reading: &Reading<'_>,
) -> Option<Tried> {
    let rows: Vec<MeasuredRow> = rows.iter().map(|row| (reading.reread)(row)).collect::<Option<_>>()?;
    let more = reading.free.iter().map(|&group| group.to_owned());
    let free: Vec<String> = options.free.iter().cloned().chain(more).collect();
    let parameters = free::parameters(nominal, &free, &options.hold).ok()?;
    let measurements: Vec<_> = rows.iter().map(|row| measurement(nominal, row)).collect();
    let chain = CorrectedChain::new(nominal.chain.clone(), parameters);
    let problem = Problem { chain: &chain, measurements: &measurements };
    let kept = identify(&problem, options.threshold).kept;
    if problem.redundancy(&kept) == 0 {
        return None;
    }
    let reach_scale = ReachScale::of(&problem);
    // Estimates that explain nothing converge slowly, so half of some rows must come near at once.
    let step = measurements.len().div_ceil(SOME_ROWS);
    let some: Vec<_> = measurements.iter().step_by(step).cloned().collect();
    let alike = Noise { position_m: 1.0, orientation_rad: 1.0 / problem.reach_m() };
    let first = fit(&Problem { chain: &chain, measurements: &some }, &kept, alike);
    if reach_scale.of_median_row(&first.residuals).is_large() {
        return None;
    }
    let plain = fit_with_estimated_noise(&problem, &kept);
    let robust = fit_robustly(&problem, &kept, Loss::Tukey, (&plain, None));
    let left = reach_scale.left(&robust.fit.residuals, &robust.outliers);
    let size = reach_scale.size_of(&chain, &robust.fit.corrections);
    Some(Tried { left, size, is_of_a_frame: !reading.free.is_empty() })
}

fn readings<'a>(nominal: &NominalChain<'a>) -> Vec<Reading<'a>> {
    let plain = |what: &str, reread: Reread<'a>| Reading { what: what.to_owned(), reread, free: &[] };
    let (turning, sliding) =
        (nominal.coordinates_of(Motion::Turning), nominal.coordinates_of(Motion::Sliding));
    let mut readings = vec![
        plain("the measured positions under mm were metres", positions(KILO)),
        plain("the measured positions under m were millimetres", positions(1.0 / KILO)),
        plain("the joint angles under deg were radians", joints(turning.clone(), DEGREES)),
        plain("the joint angles under rad were degrees", joints(turning, 1.0 / DEGREES)),
        plain("the sliding joints under mm were metres", joints(sliding.clone(), KILO)),
        plain("the sliding joints under m were millimetres", joints(sliding, 1.0 / KILO)),
        plain("the figures under qw, qx, qy, qz were x, y, z, w", quaternions(|[x, y, z, w]| [w, x, y, z])),
        plain("the figures under qx, qy, qz, qw were w, x, y, z", quaternions(|[z, w, x, y]| [w, x, y, z])),
        plain("roll, pitch and yaw under deg were radians", rpy(|rpy| rpy.map(|angle| angle * DEGREES))),
        plain("roll, pitch and yaw under rad were degrees", rpy(|rpy| rpy.map(|angle| angle / DEGREES))),
        plain("roll, pitch and yaw were about the moving axes, in that order", moving_axes()),
        plain("the orientations were those of the base in the tip", inverse_orientation()),
        plain("the poses were those of the base in the tip", inverse_pose()),
    ];
    for (name, &coordinate) in nominal.joint_names().into_iter().zip(&nominal.coordinates) {
        let what = format!("{name} counted the other way");
        readings.push(Reading { what, reread: joints(vec![coordinate], -1.0), free: &[] });
    }
    let as_it_is = || -> Reread<'a> { Box::new(|row| Some(row.clone())) };
    let frames: [(&str, &'static [&'static str]); 3] = [
        ("the base were free too (--free base)", &["base"]),
        ("the tool were free too (--free tool)", &["tool"]),
        ("base and tool were free too (--free base,tool)", &["base", "tool"]),
    ];
    readings.extend(frames.map(|(what, free)| Reading { what: what.to_owned(), reread: as_it_is(), free }));
    readings
}

fn positions<'a>(factor: f64) -> Reread<'a> {
    Box::new(move |row| {
        let tip_in_base_m = row.tip_in_base_m.map(|coordinate| coordinate.map(|figure| figure * factor));
        row.tip_in_base_m.iter().any(Option::is_some).then(|| MeasuredRow { tip_in_base_m, ..row.clone() })
    })
}

fn joints<'a>(coordinates: Vec<usize>, factor: f64) -> Reread<'a> {
    Box::new(move |row| {
        let mut row = row.clone();
        for &coordinate in &coordinates {
            row.q[coordinate] *= factor;
        }
        (!coordinates.is_empty()).then_some(row)
    })
}

fn quaternions<'a>(reorder: fn([f64; 4]) -> [f64; 4]) -> Reread<'a> {
    Box::new(move |row| match row.orientation {
        Some(WrittenOrientation::QuaternionWxyz(figures)) => {
            let orientation = Some(WrittenOrientation::QuaternionWxyz(reorder(figures)));
            Some(MeasuredRow { orientation, ..row.clone() })
        }
        _ => None,
    })
}

fn rpy<'a>(change: fn([f64; 3]) -> [f64; 3]) -> Reread<'a> {
    Box::new(move |row| match row.orientation {
        Some(WrittenOrientation::RpyRad(figures)) => {
            let orientation = Some(WrittenOrientation::RpyRad(change(figures)));
            Some(MeasuredRow { orientation, ..row.clone() })
        }
        _ => None,
    })
}

/// `Rx(roll) Ry(pitch) Rz(yaw)`.
fn moving_axes<'a>() -> Reread<'a> {
    Box::new(|row| match row.orientation {
        Some(WrittenOrientation::RpyRad([roll, pitch, yaw])) => {
            let about = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
            let rotation = about(Vector3::x_axis(), roll)
                * about(Vector3::y_axis(), pitch)
                * about(Vector3::z_axis(), yaw);
            Some(with_rotation(row, rotation.into_inner()))
        }
        _ => None,
    })
}

fn inverse_orientation<'a>() -> Reread<'a> {
    Box::new(|row| Some(with_rotation(row, row.orientation?.base_from_tip().transpose())))
}

fn inverse_pose<'a>() -> Reread<'a> {
    Box::new(|row| {
        let [Some(x), Some(y), Some(z)] = row.tip_in_base_m else { return None };
        let base_from_tip = row.orientation?.base_from_tip().transpose();
        let tip_in_base_m = base_from_tip * -Vector3::new(x, y, z);
        let tip_in_base_m = <[f64; 3]>::from(tip_in_base_m).map(Some);
        Some(MeasuredRow { tip_in_base_m, ..with_rotation(row, base_from_tip) })
    })
}

fn with_rotation(row: &MeasuredRow, base_from_tip: Matrix3<f64>) -> MeasuredRow {
    let (roll, pitch, yaw) = Rotation3::from_matrix_unchecked(base_from_tip).euler_angles();
    MeasuredRow { orientation: Some(WrittenOrientation::RpyRad([roll, pitch, yaw])), ..row.clone() }
}
