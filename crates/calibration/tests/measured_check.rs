//! Measured poses against a model: verdict, tolerance, frames that are fitted before, and what is refused.

#![expect(clippy::unwrap_used, reason = "a helper that fails fails its test")]

use std::path::Path;

use congruent_calibration::{
    MeasuredCheck, MeasuredCheckOptions, MeasuredVerdict, check_measured, measurements::MeasuredRow,
};
use congruent_description::{RequestedTolerance, RobotDescription, load_robot};
use congruent_input::Diagnostic;

/// Rounding of points within 4 m. Unit: m.
const ROUNDING_M: f64 = 1e-12;

/// Joint positions in deg and points in m of the planar arm of 0.6 m and 0.4 m, by hand; the third is 2 mm off along y.
const POINTS: [([f64; 2], [f64; 2]); 6] = [
    ([0.0, 0.0], [1.0, 0.0]),
    ([90.0, 0.0], [0.0, 1.0]),
    ([0.0, 90.0], [0.6, 0.402]),
    ([90.0, -90.0], [0.4, 0.6]),
    ([0.0, -90.0], [0.6, -0.4]),
    ([180.0, 90.0], [-0.6, -0.4]),
];

fn planar_arm() -> RobotDescription {
    load_robot(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/planar_2r")).unwrap()
}

/// The points as rows, each moved by `place`.
fn rows(place: impl Fn([f64; 2]) -> [f64; 3]) -> Vec<MeasuredRow> {
    let row = |(at, (deg, point)): (usize, &([f64; 2], [f64; 2]))| MeasuredRow {
        line: at + 2,
        q: deg.iter().map(|deg| deg.to_radians()).collect::<Vec<f64>>().into(),
        tip_in_base_m: place(*point).map(Some),
        orientation: None,
    };
    POINTS.iter().enumerate().map(row).collect()
}

fn check(rows: &[MeasuredRow], most_m: Option<f64>, free: &[&str]) -> Result<MeasuredCheck, Diagnostic> {
    let options = MeasuredCheckOptions {
        camera: None,
        tolerance: RequestedTolerance { position_m: most_m, orientation_rad: None },
        free: free.iter().map(|&word| word.to_owned()).collect(),
        threshold: 1e-3,
    };
    check_measured(&planar_arm(), Path::new("points.csv"), rows, &options)
}

#[test]
fn a_row_beyond_the_tolerance_decides() {
    let rows = rows(|[x, y]| [x, y, 0.0]);
    let found = check(&rows, Some(1e-3), &[]).unwrap();
    assert_eq!((found.verdict, found.rows, found.rows_beyond), (MeasuredVerdict::Disagree, 6, 1));
    assert_eq!((found.worst.row, found.worst.line), (3, 4));
    assert!((found.worst.position_m - 0.002).abs() < ROUNDING_M, "{:?}", found.worst);
    assert!((found.differences.rms_m - 0.002 / 6_f64.sqrt()).abs() < ROUNDING_M);
    let worst_q: Vec<f64> = found.worst_q.iter().map(|(_, value)| value).collect();
    assert_eq!(worst_q, [0.0, 90_f64.to_radians()]);
    assert_eq!(check(&rows, Some(3e-3), &[]).unwrap().verdict, MeasuredVerdict::Agree);
}

#[test]
fn a_base_that_is_elsewhere_is_fitted_and_the_row_that_is_off_stays_off() {
    // Turned by a quarter turn and 3 m, -2 m and 1 m away.
    let rows = rows(|[x, y]| [3.0 - y, x - 2.0, 1.0]);
    assert_eq!(check(&rows, Some(3e-3), &[]).unwrap().rows_beyond, 6);
    let found = check(&rows, Some(1e-3), &["base"]).unwrap();
    assert_eq!((found.verdict, found.rows_beyond, found.worst.row), (MeasuredVerdict::Disagree, 1, 3));
    let value = |name: &str| found.fitted.iter().find(|each| each.name == name).unwrap().value;
    // The row that is 2 mm off has little influence on a robust fit, and at most a sixth of it.
    let off = [value("base.x") - 3.0, value("base.y") + 2.0, value("base.z") - 1.0];
    assert!(off.iter().all(|off| off.abs() < 0.002 / 6.0), "{off:?}");
    assert!((value("base.yaw") - 90_f64.to_radians()).abs() < 1e-3);
    assert_eq!(check(&rows, Some(3e-3), &["base"]).unwrap().verdict, MeasuredVerdict::Agree);
}

#[test]
fn what_cannot_be_compared_is_refused_with_what_to_write() {
    let rows = rows(|[x, y]| [x, y, 0.0]);
    let help = |result: Result<MeasuredCheck, Diagnostic>| result.unwrap_err().help.unwrap_or_default();
    assert!(help(check(&rows, None, &[])).contains("--tolerance 1mm,"));
    assert!(help(check(&rows, Some(1e-3), &["base", "dh"])).contains("congruent calibrate"));
    assert!(help(check(&rows[..1], Some(1e-3), &["base", "tool"])).contains("more configurations"));
    assert!(check(&[], Some(1e-3), &[]).is_err());
}
