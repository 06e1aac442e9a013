//! Other interpretations of a file of measurements: common mistakes with units, order and frames, each tried if the free
//! corrections do not explain the measurements.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::{
    calibration_report::LikelyReason,
    residual_size::{LARGE_CORRECTION, ReachScale, ResidualSize},
};
use crate::{
    camera::{CAMERA_GROUPS, CameraMount, may_be_seen},
    chain::{JointMotionKind, NominalChain},
    computed::measurement,
    estimation::{
        CorrectedChain, Loss, Noise, Problem, align, fit, fit_robustly, fit_with_estimated_noise, identify,
    },
    free,
    measurements::{MeasuredRow, WrittenOrientation},
    options::CalibrationOptions,
};

/// Millimetres in a metre.
const KILO: f64 = 1e3;
/// Degrees in a radian.
const DEGREES: f64 = 180.0 / PI;
/// An interpretation is likely if its residual, or correction, is less than this share of that without it.
const MUCH_BETTER: f64 = 0.1;
/// The residual of a later interpretation of the list must be less than this share of that of an earlier one:
/// more free corrections always reduce it a little.
const BETTER: f64 = 0.5;

/// Number of rows on which an interpretation is tried before all rows are used.
const SOME_ROWS: usize = 60;

/// A row interpreted differently; `None` if the interpretation does not apply to it.
type Reinterpret<'a> = Box<dyn Fn(&MeasuredRow) -> Option<MeasuredRow> + 'a>;

/// One other interpretation of the file.
pub(super) struct Interpretation<'a> {
    /// The interpretation, as a clause after "if".
    condition: String,
    reinterpret: Reinterpret<'a>,
    /// Groups of corrections that are free in addition to those of the options.
    free: &'static [&'static str],
    /// Where the camera is, if one measured the rows.
    camera: Option<CameraMount>,
}

impl Interpretation<'_> {
    /// Positions that are longer by this factor.
    pub(super) fn scaled(factor: f64, camera: Option<CameraMount>) -> Self {
        Self { condition: String::new(), reinterpret: positions(factor), free: &[], camera }
    }
}

/// Why the file probably needs another interpretation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Misfit {
    /// The residual is this large, as a share of the reach or as an angle.
    Residual(f64),
    /// The corrections are this large, as a share of the reach or as an angle.
    Correction(f64),
}

/// An estimate under another interpretation.
#[derive(Debug, Clone, Copy)]
pub(super) struct InterpretedFit {
    pub(super) residual: ResidualSize,
    correction_size: f64,
    /// Whether a frame is free in addition: then a joint's zero may be as large as the rotation of the frame.
    is_of_a_frame: bool,
}

impl Misfit {
    /// Whether both residual and corrections are small: an arm that shrinks to nothing has small residuals on
    /// positions in millimetres.
    fn is_resolved_by(self, fit: &InterpretedFit) -> bool {
        let is_small = fit.correction_size < LARGE_CORRECTION;
        let is_resolved = match self {
            Self::Residual(share) => {
                fit.residual.share() < MUCH_BETTER * share && (is_small || fit.is_of_a_frame)
            }
            Self::Correction(size) => fit.correction_size < MUCH_BETTER * size && is_small,
        };
        is_resolved && !fit.residual.is_large()
    }
}

/// The interpretation that resolves the misfit, if there is one: of several the one with the smallest
/// residual, and of nearly equal ones the first of the list.
pub(super) fn likely_reason(
    nominal: &NominalChain<'_>,
    rows: &[MeasuredRow],
    options: &CalibrationOptions,
    misfit: Misfit,
) -> Option<LikelyReason> {
    let mut best: Option<(String, ResidualSize)> = None;
    for interpretation in interpretations(nominal, options) {
        let fit = interpreted_fit(nominal, rows, options, &interpretation);
        let Some(fit) = fit.filter(|fit| misfit.is_resolved_by(fit)) else { continue };
        // Later interpretations have more free corrections, which always reduce the residual a little: they must
        // be clearly better.
        if best.as_ref().is_none_or(|(_, best)| fit.residual.share() < BETTER * best.share()) {
            best = Some((interpretation.condition, fit.residual));
        }
    }
    best.map(|(condition, ResidualSize { rms_m, rms_rad, .. })| LikelyReason { condition, rms_m, rms_rad })
}

/// A robust estimate under another interpretation; `None` if the interpretation does not apply, or the
/// residuals of half of the rows are large.
pub(super) fn interpreted_fit(
    nominal: &NominalChain<'_>,
    rows: &[MeasuredRow],
    options: &CalibrationOptions,
    interpretation: &Interpretation<'_>,
) -> Option<InterpretedFit> {
    let rows: Vec<MeasuredRow> =
        rows.iter().map(|row| (interpretation.reinterpret)(row)).collect::<Option<_>>()?;
    let more = interpretation.free.iter().map(|&group| group.to_owned());
    let free: Vec<String> = options.free.iter().cloned().chain(more).collect();
    let parameters = free::parameters(nominal, &free, &options.hold).ok()?;
    may_be_seen(&rows, interpretation.camera).ok()?;
    let measurements: Vec<_> =
        rows.iter().map(|row| measurement(nominal, row, interpretation.camera)).collect();
    // Estimates that explain nothing converge slowly, so the median of some rows decides first.
    // Spread over the file rather than the first rows, which may be at neighbouring configurations.
    let step = measurements.len().div_ceil(SOME_ROWS).max(1);
    let some: Vec<_> = measurements.iter().step_by(step).cloned().collect();
    let at_nominal = CorrectedChain::new(nominal.chain.clone(), parameters);
    let chain = align(&at_nominal, &some, options.threshold);
    let problem = Problem { chain: &chain, measurements: &measurements };
    let kept = identify(&problem, options.threshold).kept;
    // Without redundancy every interpretation has a residual of zero.
    if problem.redundancy(&kept) == 0 {
        return None;
    }
    let reach_scale = ReachScale::for_problem(&problem);
    let alike = Noise { position_m: 1.0, orientation_rad: 1.0 / problem.reach_m() };
    let first = fit(&Problem { chain: &chain, measurements: &some }, &kept, alike);
    if reach_scale.median_residual_size(&first.residuals).is_large() {
        return None;
    }
    let plain = fit_with_estimated_noise(&problem, &kept);
    let robust = fit_robustly(&problem, &kept, Loss::Tukey, &plain, None);
    let residual = reach_scale.residual_size(&robust.fit.residuals, &robust.outliers);
    // Positions in a unit that makes all of them one point agree with any arm.
    if residual.rms_m > MUCH_BETTER * spread_m(&rows) {
        return None;
    }
    Some(InterpretedFit {
        residual,
        correction_size: reach_scale.correction_size(&chain, &robust.fit.corrections),
        is_of_a_frame: !interpretation.free.is_empty(),
    })
}

/// Root mean square distance of the measured positions from their middle, m; infinite if none were measured.
fn spread_m(rows: &[MeasuredRow]) -> f64 {
    let along = |at: usize| {
        let values: Vec<f64> = rows.iter().filter_map(|row| row.tip_in_base_m[at]).collect();
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 rows")]
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        (count > 0.0).then(|| values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count)
    };
    let squares: Vec<f64> = (0..3).filter_map(along).collect();
    if squares.is_empty() { f64::INFINITY } else { squares.iter().sum::<f64>().sqrt() }
}

/// Of the groups that the options free and a condition names, all are to be given.
fn interpretations<'a>(nominal: &NominalChain<'a>, options: &CalibrationOptions) -> Vec<Interpretation<'a>> {
    let plain = |condition: &str, reinterpret: Reinterpret<'a>| Interpretation {
        condition: condition.to_owned(),
        reinterpret,
        free: &[],
        camera: options.camera,
    };
    let [revolute, prismatic] =
        [JointMotionKind::Revolute, JointMotionKind::Prismatic].map(|motion| nominal.coordinates_of(motion));
    let mut all = vec![
        plain("the positions given as mm are in metres", positions(KILO)),
        plain("the positions given as m are in millimetres", positions(1.0 / KILO)),
        plain("the joint angles given as deg are in radians", joints(revolute.clone(), DEGREES)),
        plain("the joint angles given as rad are in degrees", joints(revolute, 1.0 / DEGREES)),
        plain("the prismatic joints given as mm are in metres", joints(prismatic.clone(), KILO)),
        plain("the prismatic joints given as m are in millimetres", joints(prismatic, 1.0 / KILO)),
        plain("the quaternions' qw, qx, qy, qz hold x, y, z, w", quaternions(|[x, y, z, w]| [w, x, y, z])),
        plain("the quaternions' qx, qy, qz, qw hold w, x, y, z", quaternions(|[z, w, x, y]| [w, x, y, z])),
        plain("roll, pitch and yaw given as deg are in radians", rpy(|rpy| rpy.map(|angle| angle * DEGREES))),
        plain("roll, pitch and yaw given as rad are in degrees", rpy(|rpy| rpy.map(|angle| angle / DEGREES))),
        plain("roll, pitch and yaw are about the moving axes, in that order", moving_axes()),
        plain("roll, pitch and yaw are a rotation vector (columns rx, ry, rz)", rotation_vectors()),
    ];
    match options.camera {
        None => {
            all.push(plain("the orientations are those of the base in the tip", inverse_orientation()));
            all.push(plain("the poses are those of the base in the tip", inverse_pose()));
        }
        // Inverse poses are the poses of the other mount, so the two cannot be distinguished.
        Some(mount) => {
            let (condition, camera) = other_mount(mount);
            let as_it_is: Reinterpret<'a> = Box::new(|row| Some(row.clone()));
            let condition = condition.to_owned();
            all.insert(
                0,
                Interpretation { condition, reinterpret: as_it_is, free: &[], camera: Some(camera) },
            );
            all.push(plain("the orientations are those of the camera in the target", inverse_orientation()));
        }
    }
    for (name, &coordinate) in nominal.joint_names().into_iter().zip(&nominal.coordinates) {
        let condition = format!("{name} is positive in the opposite direction");
        all.push(plain(&condition, joints(vec![coordinate], -1.0)));
    }
    all.extend(free_frames(options));
    all
}

/// The rows as they are, with frames free in addition.
fn free_frames<'a>(options: &CalibrationOptions) -> Vec<Interpretation<'a>> {
    let as_it_is = || -> Reinterpret<'a> { Box::new(|row| Some(row.clone())) };
    let frames: [(&str, &'static [&'static str]); 3] = [
        ("the pose of the base is free too", &["base"]),
        ("the pose of the tool is free too", &["tool"]),
        ("the poses of base and tool are free too", &["base", "tool"]),
    ];
    let mut all: Vec<Interpretation<'a>> = frames
        .map(|(condition, free)| {
            let groups: Vec<&str> =
                options.free.iter().map(String::as_str).chain(free.iter().copied()).collect();
            let condition = format!("{condition} (--free {})", groups.join(","));
            Interpretation { condition, reinterpret: as_it_is(), free, camera: options.camera }
        })
        .into();
    // A camera sees the inverse pose, and neither of its frames is known.
    all.extend(options.camera.is_none().then(|| Interpretation {
        condition:
            "they are poses of a target seen by a camera on the robot (--camera eye-in-hand)".to_owned(),
        reinterpret: as_it_is(),
        free: &CAMERA_GROUPS,
        camera: Some(CameraMount::EyeInHand),
    }));
    all
}

/// The other place of a camera, and what it means that it is there.
fn other_mount(mount: CameraMount) -> (&'static str, CameraMount) {
    match mount {
        CameraMount::EyeInHand => (
            "the camera is beside the robot (--camera eye-to-hand), or the rows are poses of the camera in the target",
            CameraMount::EyeToHand,
        ),
        CameraMount::EyeToHand => (
            "the camera is on the robot (--camera eye-in-hand), or the rows are poses of the camera in the target",
            CameraMount::EyeInHand,
        ),
    }
}

fn positions<'a>(factor: f64) -> Reinterpret<'a> {
    Box::new(move |row| {
        let tip_in_base_m = row.tip_in_base_m.map(|coordinate| coordinate.map(|value| value * factor));
        row.tip_in_base_m.iter().any(Option::is_some).then(|| MeasuredRow { tip_in_base_m, ..row.clone() })
    })
}

fn joints<'a>(coordinates: Vec<usize>, factor: f64) -> Reinterpret<'a> {
    Box::new(move |row| {
        let mut row = row.clone();
        for &coordinate in &coordinates {
            row.q[coordinate] *= factor;
        }
        (!coordinates.is_empty()).then_some(row)
    })
}

fn quaternions<'a>(reorder: fn([f64; 4]) -> [f64; 4]) -> Reinterpret<'a> {
    Box::new(move |row| match row.orientation {
        Some(WrittenOrientation::QuaternionWxyz(values)) => {
            let orientation = Some(WrittenOrientation::QuaternionWxyz(reorder(values)));
            Some(MeasuredRow { orientation, ..row.clone() })
        }
        _ => None,
    })
}

fn rpy<'a>(change: fn([f64; 3]) -> [f64; 3]) -> Reinterpret<'a> {
    Box::new(move |row| match row.orientation {
        Some(WrittenOrientation::RpyRad(values)) => {
            let orientation = Some(WrittenOrientation::RpyRad(change(values)));
            Some(MeasuredRow { orientation, ..row.clone() })
        }
        _ => None,
    })
}

/// `Rx(roll) Ry(pitch) Rz(yaw)`.
fn moving_axes<'a>() -> Reinterpret<'a> {
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

fn rotation_vectors<'a>() -> Reinterpret<'a> {
    Box::new(|row| match row.orientation {
        Some(WrittenOrientation::RpyRad(vector)) => {
            let orientation = Some(WrittenOrientation::RotationVectorRad(vector));
            Some(MeasuredRow { orientation, ..row.clone() })
        }
        _ => None,
    })
}

fn inverse_orientation<'a>() -> Reinterpret<'a> {
    Box::new(|row| Some(with_rotation(row, row.orientation?.base_from_tip().transpose())))
}

fn inverse_pose<'a>() -> Reinterpret<'a> {
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
