//! Base and tool are aligned before anything is decided about the arm: far frames, turned tools, points alone, gross errors, and a
//! UR10 that a laser tracker measured from some metres away.

#![expect(
    clippy::print_stderr,
    clippy::unwrap_used,
    reason = "a skipped test says so; a helper that fails fails its test"
)]

use std::path::{Path, PathBuf};

use congruent_calibration::{
    CalibrationOptions, calibrate,
    estimation::{CorrectedChain, Measurement, Problem, align, base_pose, tool_pose},
    measurements::{MeasuredRow, read_measurements},
    needed_coordinates,
    report::{CalibrationReport, CalibrationVerdict},
};
use congruent_description::{ChainQ, RobotDescription, RobotQ, load_robot};
use congruent_kinematics::{ScrewChain, Twist};

/// Smallest ratio of singular values in these tests.
const THRESHOLD: f64 = 1e-3;
/// Rounding of poses some metres away, after least squares. Unit: m and rad.
const ROUNDING: f64 = 1e-9;
/// Base and tool of the tests: metres away, turned far.
const FAR_BASE: [f64; 6] = [-2.8, 3.1, -1.2, 2.7, -0.4, 0.9];
const TURNED_TOOL: [f64; 6] = [0.02, -0.05, 0.4, -1.6, 0.3, 2.2];

/// Six turns as of an arm with a shoulder, an elbow and a wrist.
fn chain() -> ScrewChain {
    let axis = |direction: [f64; 3], point: [f64; 3]| Twist::turn(direction.into(), &point.into());
    ScrewChain {
        twists_in_base: vec![
            axis([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
            axis([0.0, 1.0, 0.0], [0.0, 0.0, 0.3]),
            axis([0.0, 1.0, 0.0], [0.0, 0.0, 0.8]),
            axis([1.0, 0.0, 0.0], [0.0, 0.0, 0.9]),
            axis([0.0, 1.0, 0.0], [0.5, 0.0, 0.9]),
            axis([1.0, 0.0, 0.0], [0.6, 0.0, 0.9]),
        ],
        base_from_tip_at_zero: Twist { angular: [0.0, 1.5, 0.0].into(), linear: [0.7, 0.0, 0.9].into() }
            .exp(1.0),
    }
}

fn with_both() -> CorrectedChain {
    let chain = chain();
    let parameters = [base_pose(), tool_pose(&chain)].concat();
    CorrectedChain::new(chain, parameters)
}

/// Deterministic configurations without a random generator: a lattice of irrational steps.
fn spread(rows: u32) -> Vec<ChainQ> {
    let at = |row: u32, prime: u32| 2.4 * ((f64::from(row) * f64::from(prime).sqrt()).fract() - 0.5);
    (1..=rows).map(|row| [2, 3, 5, 7, 11, 13].map(|prime| at(row, prime)).into()).collect()
}

fn measured(chain: &CorrectedChain, truth: &[f64], rows: u32) -> Vec<Measurement> {
    let measurement = |q: ChainQ| {
        let pose = chain.base_from_tip(&q, truth);
        Measurement {
            q,
            tip_in_base_m: pose.translation.map(Some).into(),
            base_from_tip: Some(pose.rotation),
            camera_from_target: None,
        }
    };
    spread(rows).into_iter().map(measurement).collect()
}

fn without_orientations(measurements: &mut [Measurement]) {
    for each in measurements {
        each.base_from_tip = None;
    }
}

/// The median distance of the aligned chain from the measurements.
fn median_m(chain: &CorrectedChain, measurements: &[Measurement]) -> f64 {
    let residuals = Problem { chain, measurements }.residuals(chain.start());
    let mut distances: Vec<f64> = residuals.iter().map(|each| each.position_m.norm()).collect();
    distances.sort_by(f64::total_cmp);
    distances[distances.len() / 2]
}

#[track_caller]
fn found(chain: &CorrectedChain, measurements: &[Measurement]) {
    let aligned = align(chain, measurements, THRESHOLD);
    let off_m = median_m(&aligned, measurements);
    assert!(off_m < ROUNDING, "{off_m} m, start {:?}", aligned.start());
}

#[test]
fn a_far_base_and_a_turned_tool_are_found() {
    let both = with_both();
    let truth = [FAR_BASE, TURNED_TOOL].concat();
    found(&both, &measured(&both, &truth, 20));
    for (chain, truth) in [
        (CorrectedChain::new(chain(), base_pose()), FAR_BASE),
        (CorrectedChain::new(chain(), tool_pose(&chain())), TURNED_TOOL),
    ] {
        found(&chain, &measured(&chain, &truth, 20));
    }
}

#[test]
fn a_tool_turned_by_a_third_and_a_base_on_its_side_are_found() {
    // A turn by 120 degrees has a trace of 0, and a pitch of a quarter turn no yaw of its own.
    let quarter = std::f64::consts::FRAC_PI_2;
    let chain = with_both();
    let truth = [[3.0, 1.0, 0.5, 0.3, quarter, 0.0], [0.0, 0.0, 0.1, quarter, 0.0, quarter]].concat();
    found(&chain, &measured(&chain, &truth, 20));
}

#[test]
fn points_alone_suffice() {
    let chain = with_both();
    let mut measurements = measured(&chain, &[FAR_BASE, TURNED_TOOL].concat(), 20);
    without_orientations(&mut measurements);
    found(&chain, &measurements);
}

#[test]
fn gross_errors_in_a_few_rows_do_not_move_the_frames() {
    let chain = with_both();
    let mut measurements = measured(&chain, &[FAR_BASE, TURNED_TOOL].concat(), 30);
    measurements[3].tip_in_base_m = [Some(2800.0), Some(-31.0), Some(0.0)];
    measurements[11].tip_in_base_m = [Some(0.0); 3];
    let turned = measurements[7].base_from_tip.map(|rotation| rotation.transpose());
    measurements[20].base_from_tip = turned;
    found(&chain, &measurements);
    without_orientations(&mut measurements);
    found(&chain, &measurements);
}

#[test]
fn frames_that_are_right_already_stay_at_nominal() {
    let chain = with_both();
    let truth = [[1e-3; 6], [-1e-3; 6]].concat();
    let aligned = align(&chain, &measured(&chain, &truth, 20), THRESHOLD);
    assert_eq!(aligned.start(), [0.0; 12]);
}

#[test]
fn rows_that_determine_little_are_no_worse_than_nominal() {
    let chain = with_both();
    let truth = [FAR_BASE, TURNED_TOOL].concat();
    for rows in [1, 2, 3] {
        let measurements = measured(&chain, &truth, rows);
        let aligned = align(&chain, &measurements, THRESHOLD);
        assert!(median_m(&aligned, &measurements) <= median_m(&chain, &measurements), "{rows} rows");
    }
    let mut alike = measured(&chain, &truth, 1);
    alike.extend([alike[0].clone(), alike[0].clone()]);
    assert!(median_m(&align(&chain, &alike, THRESHOLD), &alike) < ROUNDING);
    // Not a single measured quantity.
    let nothing = Measurement { tip_in_base_m: [None; 3], base_from_tip: None, ..alike[0].clone() };
    assert_eq!(align(&chain, &[nothing], THRESHOLD).start(), [0.0; 12]);
    assert_eq!(align(&chain, &[], THRESHOLD).start(), [0.0; 12]);
}

/// The folder of logs of the corpus; `None`, said, without it.
fn logs() -> Option<PathBuf> {
    let Some(corpus) = std::env::var_os("CONGRUENT_CORPUS") else {
        eprintln!("skipped: CONGRUENT_CORPUS is not set");
        return None;
    };
    // A relative path is from the root of the workspace, where the gate runs.
    Some(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(corpus).join("logs"))
}

/// The UR10 of Fraunhofer IPA with a series of poses of a laser tracker; `None`, said, without the corpus.
fn tracker(series: &str, free: &str) -> Option<CalibrationReport> {
    let folder = logs()?.join("ur10_laser_ipa");
    let description = load_robot(&folder.join("robot")).unwrap();
    let needed = needed_coordinates(&description).unwrap();
    let file = folder.join(format!("series_{series}_calibrate.csv"));
    let rows = read_measurements(&file, &description.robot, &needed).unwrap();
    let free = free.split(',').map(str::to_owned).collect();
    let options = CalibrationOptions { free, suggestions: 0, ..CalibrationOptions::default() };
    Some(calibrate(&description, &rows, &options).unwrap())
}

/// Figures of a least-squares fit of twelve numbers with another program, in mm, with the digits given there.
#[test]
fn base_and_tool_of_a_tracked_ur10() {
    for (series, rms_mm, margin_mm) in [("b", 1.085, 0.005), ("d", 0.774, 0.005)] {
        let Some(report) = tracker(series, "base,tool") else { return };
        let found_mm = report.least_squares.residuals.rms_m * 1e3;
        assert!((found_mm - rms_mm).abs() < margin_mm, "series {series}: {found_mm} mm");
        let tool_m = report.aligned.unwrap().corrections["tool.z"];
        assert!(tool_m.abs() < 0.5, "series {series}: the tool is {tool_m} m long");
    }
}

#[test]
fn all_corrections_of_a_tracked_ur10() {
    let Some(report) = tracker("b", "all") else { return };
    let held_out_mm = report.held_out.unwrap().rms_m * 1e3;
    assert!((held_out_mm - 0.43).abs() < 0.01, "{held_out_mm} mm");
    assert_eq!(report.verdict, CalibrationVerdict::UnexplainedRows);
    let Some(report) = tracker("d", "all") else { return };
    // A fit of 24 corrections with another program: 0.36 mm on a held-out half in the mean, as 0.40 mm of series b are 0.43 mm rms.
    let held_out_mm = report.held_out.unwrap().rms_m * 1e3;
    assert!((held_out_mm - 0.40).abs() < 0.01, "{held_out_mm} mm");
}

/// A camera that saw a target on an arm, the frames of both unknown: the rows are of a `UR10e`, although their folder says UR10.
#[test]
fn a_camera_distinguishes_a_ur10e_from_a_ur10() {
    let Some(logs) = logs() else { return };
    let mut description = load_robot(&logs.join("ur10_laser_ipa/robot")).unwrap();
    let text = std::fs::read_to_string(logs.join("ur10e_camera_pose/calibration.csv")).unwrap();
    let row = |(at, line): (usize, &str)| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let mut q = RobotQ::zeros(description.robot.dof());
        q.iter_mut().zip(&cells[6..12]).for_each(|(q, cell)| *q = *cell);
        MeasuredRow { line: at + 1, q, tip_in_base_m: [0, 1, 2].map(|at| Some(cells[at])), orientation: None }
    };
    let rows: Vec<MeasuredRow> = text.lines().enumerate().skip(1).map(row).collect();
    let free = vec!["base".to_owned(), "tool".to_owned()];
    let options = CalibrationOptions { free, suggestions: 0, ..CalibrationOptions::default() };
    let mean_mm = |description: &RobotDescription| {
        let residuals = calibrate(description, &rows, &options).unwrap().row_residuals;
        residuals.iter().map(|row| row.least_squares_m).sum::<f64>() / 23.0 * 1e3
    };
    let of_ur10_mm = mean_mm(&description);
    let figures =
        [(0.0, 0.1807), (-0.6127, 0.0), (-0.57155, 0.0), (0.0, 0.17415), (0.0, 0.11985), (0.0, 0.11655)];
    for (row, (a_m, d_m)) in description.dh.as_mut().unwrap().rows.iter_mut().zip(figures) {
        (row.a_m, row.d_m) = (a_m, d_m);
    }
    let of_ur10e_mm = mean_mm(&description);
    // Figures of another program, in the mean of the 23 rows.
    assert!(
        (of_ur10_mm - 10.6).abs() < 0.05 && (of_ur10e_mm - 3.2).abs() < 0.05,
        "{of_ur10_mm}, {of_ur10e_mm} mm"
    );
}
