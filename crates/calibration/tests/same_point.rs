//! The tool of an arm at one point in many configurations: corrections from synthetic points that inverse kinematics of a corrected
//! arm has found, and balls in holes that real arms have touched, with figures of another program.

#![expect(
    clippy::print_stderr,
    clippy::unwrap_used,
    reason = "a skipped test says so; a helper that fails fails its test"
)]

use std::path::{Path, PathBuf};

use congruent_calibration::same_point::{
    SamePointFile, SamePointOptions, SamePointReport, SamePointVerdict, calibrate_same_point,
};
use congruent_description::{RobotDescription, RobotQ, RobotQList, load_robot};
use congruent_kinematics::{Pose, UrdfTree};
use nalgebra::{Matrix3xX, Vector3};

fn options(free: &str) -> SamePointOptions {
    let free = free.split(',').map(str::to_owned).collect();
    SamePointOptions { free, hold: Vec::new(), threshold: 1e-3, seed: 0 }
}

/// The folder of logs of the corpus; `None`, said, without it.
fn logs() -> Option<PathBuf> {
    let Some(corpus) = std::env::var_os("CONGRUENT_CORPUS") else {
        eprintln!("skipped: CONGRUENT_CORPUS is not set");
        return None;
    };
    // A relative path is from the root of the workspace, where the gate runs.
    Some(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(corpus).join("logs/ball_in_hole_platonics"))
}

/// All files of an arm, each with the configurations of one hole: rows of joint positions in rad, without a header.
fn holes(folder: &Path, description: &RobotDescription) -> Vec<SamePointFile> {
    let mut places: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    places.sort();
    let files = places.iter().flat_map(|place| ["hole_0.csv", "hole_1.csv"].map(|name| place.join(name)));
    let read = |path: PathBuf| {
        let mut rows = RobotQList::new(description.robot.dof());
        for line in std::fs::read_to_string(&path).unwrap().lines() {
            let mut q = RobotQ::zeros(description.robot.dof());
            q.iter_mut().zip(line.split(',')).for_each(|(q, cell)| *q = cell.trim().parse().unwrap());
            rows.push(&q);
        }
        SamePointFile { path, rows }
    };
    files.map(read).collect()
}

fn calibrated(arm: &str, urdf: &str, free: &str) -> Option<SamePointReport> {
    let folder = logs()?;
    let description = load_robot(&folder.join("urdf").join(urdf)).unwrap();
    let tip = description.robot.find_link("ball_link").map(|_| "ball_link");
    let description = description.with_chain(None, tip).unwrap();
    let files = holes(&folder.join(arm), &description);
    Some(calibrate_same_point(&description, &files, &options(free)).unwrap())
}

/// Mean spread in mm, with the digits of the other program: with the tool point fitted alone, and of a URDF that was calibrated for
/// the arm. Unit: mm.
const DIGITS_MM: f64 = 0.0051;

#[test]
fn the_spread_of_balls_in_holes_is_that_of_another_program() {
    for (arm, urdf, mean_mm) in [
        ("panda_3", "panda.urdf", 2.60),
        ("panda_6", "panda.urdf", 8.31),
        ("kuka_14", "iiwa14.urdf", 0.70),
        ("panda_3", "calibrated_urdf_panda_3_panda_calibrated.urdf", 0.22),
        ("panda_6", "calibrated_urdf_panda_6_panda_calibrated.urdf", 0.23),
    ] {
        let Some(report) = calibrated(arm, urdf, "tool") else { return };
        let found_mm = report.corrected.mean_m * 1e3;
        assert!((found_mm - mean_mm).abs() < DIGITS_MM, "{arm}, {urdf}: {found_mm} mm");
    }
}

#[test]
fn arms_that_touched_balls_are_calibrated_to_a_quarter_of_a_millimetre() {
    for (arm, urdf) in [("panda_3", "panda.urdf"), ("panda_6", "panda.urdf"), ("kuka_14", "iiwa14.urdf")] {
        let Some(report) = calibrated(arm, urdf, "zero-offsets,axes,tool") else { return };
        assert_eq!(report.verdict, SamePointVerdict::Explained);
        let held_out = report.held_out.unwrap();
        assert!(held_out.mean_m < 0.25e-3, "{arm}: {held_out:?}");
        // A smaller arm has a smaller spread, and would be no better one: a length is held.
        let scale = report.scale_given_by.as_deref().unwrap();
        assert!(report.fixed.iter().any(|each| each.name == scale && each.held_at == 0.0), "{scale}");
    }
}

/// The holes are 50 mm apart, which is no input of the estimate: all lengths of the arm and its size are in it.
#[test]
fn two_holes_of_a_plate_are_as_far_apart_as_they_were_drilled() {
    /// Worst seen 0.08 mm, of points with 30 rows of 0.2 mm each.
    const DRILLED_MM: f64 = 0.12;
    let Some(report) = calibrated("panda_3", "panda.urdf", "zero-offsets,axes,tool") else { return };
    for plate in report.points.chunks(2) {
        let [one, other] = [0, 1].map(|hole: usize| Vector3::from(plate[hole].point_in_base_m));
        let apart_mm = (one - other).norm() * 1e3;
        assert!((apart_mm - 50.0).abs() < DRILLED_MM, "{}: {apart_mm} mm", plate[0].file);
    }
}

/// Zeros of the synthetic arm, rad.
const ZEROS: [(&str, f64); 3] =
    [("elbow_joint.zero", 0.004), ("wrist_1_joint.zero", -0.003), ("wrist_2_joint.zero", 0.005)];

/// Configurations of a UR5e with these zeros off in which its tool is at `point`, by Newton from a lattice of starts.
fn touching(description: &RobotDescription, point: [f64; 3], count: u32) -> RobotQList {
    let tree = UrdfTree::new(&description.robot);
    let tcp = Pose::from(description.tip_from_tcp.unwrap());
    let tip = |q: &RobotQ| {
        let mut true_q = q.clone();
        for (name, value) in ZEROS {
            let joint = description.robot.find_joint(name.split('.').next().unwrap()).unwrap();
            true_q[description.robot.coordinate(joint).unwrap()] += value;
        }
        (tree.root_from_link(&true_q, description.tip).unwrap() * tcp).translation
    };
    let touched = |start: u32| -> Option<RobotQ> {
        let at = |prime: f64| 3.0 * ((f64::from(start) * prime.sqrt()).fract() - 0.5);
        let mut q =
            RobotQ::from([at(2.0), -1.2 + at(3.0) / 3.0, 1.6 + at(5.0) / 3.0, at(7.0), at(11.0), at(13.0)]);
        for _ in 0..60 {
            let here = tip(&q);
            let off = Vector3::from(point) - here;
            if off.norm() < 1e-13 {
                return Some(q);
            }
            let mut jacobian = Matrix3xX::zeros(6);
            for joint in 0..6 {
                let mut moved = q.clone();
                moved[joint] += 1e-7;
                jacobian.set_column(joint, &((tip(&moved) - here) / 1e-7));
            }
            let step = jacobian.transpose() * (&jacobian * jacobian.transpose()).try_inverse()? * off;
            q.iter_mut().zip(step.iter()).for_each(|(q, step)| *q += step.clamp(-0.3, 0.3));
        }
        None
    };
    let mut rows = RobotQList::new(6);
    (1..).filter_map(touched).take(count as usize).for_each(|q| rows.push(&q));
    rows
}

#[test]
fn zeros_come_back_from_two_points() {
    /// Rounding of the points, 1e-13 m, times the condition of the problem. Unit: rad.
    const ROUNDING: f64 = 1e-10;
    let arm = load_robot(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/ur5e")).unwrap();
    let file = |point: [f64; 3]| SamePointFile { path: "hole.csv".into(), rows: touching(&arm, point, 30) };
    let files = [file([0.5, 0.2, 0.3]), file([-0.3, 0.4, 0.25])];
    let report = calibrate_same_point(&arm, &files, &options("zero-offsets")).unwrap();
    assert_eq!(report.verdict, SamePointVerdict::Explained, "{report:?}");
    for (name, truth) in ZEROS {
        let found = report.parameters.iter().find(|each| each.name == name).unwrap();
        assert!((found.correction - truth).abs() < ROUNDING, "{found:?}");
    }
    // A turn of everything about the first axis, and of the tool about its own, moves no point against another.
    let fixed: Vec<&str> = report.fixed.iter().map(|each| each.name.as_str()).collect();
    assert_eq!(fixed, ["shoulder_pan_joint.zero", "wrist_3_joint.zero"]);
    assert!(report.corrected.worst_m < 1e-11 && report.held_out.unwrap().worst_m < 1e-10, "{report:?}");
    let point = report.points[0].point_in_base_m;
    assert!((point[0] - 0.5).abs() < 1e-10 && (point[2] - 0.3).abs() < 1e-10, "{point:?}");
    // With all lengths free the arm could have any size: the longest is held, and the zeros are the same.
    let report = calibrate_same_point(&arm, &files, &options("dh,tool")).unwrap();
    assert_eq!(report.scale_given_by.as_deref(), Some("shoulder_lift_joint.a"));
    let found = report.parameters.iter().find(|each| each.name == "elbow_joint.theta").unwrap();
    assert!((found.correction - 0.004).abs() < 1e-7, "{found:?}");
}

#[test]
fn three_rows_at_a_point_are_too_few() {
    let arm = load_robot(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/ur5e")).unwrap();
    let file = SamePointFile { path: "hole.csv".into(), rows: touching(&arm, [0.5, 0.2, 0.3], 3) };
    let error = calibrate_same_point(&arm, &[file], &options("zero-offsets")).unwrap_err();
    assert!(error.message.starts_with("hole.csv: 3 configurations"), "{error:?}");
}
