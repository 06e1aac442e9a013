//! Two or three poses are too few to hold some out: the answer says so, and does not contradict a comparison with the same rows.

#![expect(clippy::unwrap_used, reason = "a helper that fails fails its test")]

use std::path::Path;

use congruent_calibration::{
    CalibrationOptions, calibrate,
    measurements::MeasuredRow,
    report::{CalibrationReport, CalibrationVerdict},
};
use congruent_description::load_robot;

/// Joint positions of the planar arm of 0.6 m and 0.4 m, deg.
const POSITIONS_DEG: [[f64; 2]; 5] = [[0.0, 30.0], [40.0, -60.0], [-20.0, 80.0], [70.0, 20.0], [10.0, -90.0]];

/// The calibration of both zeros from so many points, by hand, of an arm whose second zero is 1 deg off.
fn from_points(count: usize) -> CalibrationReport {
    let arm = load_robot(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/planar_2r")).unwrap();
    let row = |(at, deg): (usize, &[f64; 2])| {
        let [first, second] = deg.map(f64::to_radians);
        let both = first + second + 1_f64.to_radians();
        MeasuredRow {
            line: at + 2,
            q: vec![first, second].into(),
            tip_in_base_m: [
                Some(0.6 * first.cos() + 0.4 * both.cos()),
                Some(0.6 * first.sin() + 0.4 * both.sin()),
                None,
            ],
            orientation: None,
        }
    };
    let rows: Vec<MeasuredRow> = POSITIONS_DEG[..count].iter().enumerate().map(row).collect();
    let options = CalibrationOptions { suggestions: 0, ..CalibrationOptions::default() };
    calibrate(&arm, &rows, &options).unwrap()
}

#[test]
fn from_four_configurations_on_some_are_held_out() {
    for count in [2, 3] {
        let report = from_points(count);
        assert_eq!((report.verdict, report.configurations), (CalibrationVerdict::Unverifiable, count));
        assert_eq!(report.held_out, None);
        let first = &report.statements[0];
        assert!(first.contains(&format!("at {count} configurations, too few to hold some out")), "{first}");
    }
    for count in [4, 5] {
        let report = from_points(count);
        assert_eq!(report.verdict, CalibrationVerdict::Explained, "{:?}", report.statements);
        assert_eq!(report.held_out.unwrap().folds, count);
    }
}
