//! A camera on the tip and beside the robot: poses and points of its target, written by another program, and the wrong mount.

#![expect(clippy::unwrap_used, reason = "a helper that fails fails its test")]

use std::path::Path;

use congruent_calibration::{
    CalibrationOptions, CameraMount, MeasuredCheckOptions, MeasuredVerdict, calibrate, check_measured,
    corrected_robot,
    measurements::{MeasuredRow, WrittenOrientation, read_measurements},
    needed_coordinates,
    report::{CalibrationReport, CalibrationVerdict},
};
use congruent_description::{RequestedTolerance, RobotDescription, RobotQ, load_robot};
use congruent_kinematics::{Pose, UrdfTree};
use nalgebra::{Rotation3, Vector3};

/// What the program that wrote the rows put into them: `tool0_from_camera`, `base_link_from_target`, and zeros of joints.
const CAMERA: ([f64; 3], [f64; 3]) = ([0.065, -0.02, 0.045], [0.02, -0.35, 1.58]);
const TARGET: ([f64; 3], [f64; 3]) = ([0.55, 0.12, 0.02], [0.01, -0.02, 0.7]);
const ZEROS_RAD: [(&str, f64); 4] = [
    ("shoulder_lift_joint.zero", 0.004),
    ("elbow_joint.zero", -0.006),
    ("wrist_1_joint.zero", 0.003),
    ("wrist_2_joint.zero", 0.005),
];

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn ur5e() -> RobotDescription {
    load_robot(&root().join("robots/ur5e")).unwrap()
}

fn seen(robot: &RobotDescription) -> Vec<MeasuredRow> {
    let file = root().join("docs/examples/calibration/ur5e_camera.csv");
    read_measurements(&file, &robot.robot, &needed_coordinates(robot).unwrap()).unwrap()
}

fn options(camera: CameraMount, free: &[&str]) -> CalibrationOptions {
    let free = free.iter().map(|&group| group.to_owned()).collect();
    CalibrationOptions { free, camera: Some(camera), ..CalibrationOptions::default() }
}

fn pose((xyz, [roll, pitch, yaw]): ([f64; 3], [f64; 3])) -> Pose {
    Pose::from_parts(Rotation3::from_euler_angles(roll, pitch, yaw).into_inner(), xyz.into())
}

/// Camera and target within some standard deviations of 24 pictures with 0.3 mm and 0.0015 rad.
fn is_found(report: &CalibrationReport) {
    let frames = report.camera.as_ref().unwrap();
    assert_eq!([&*frames.camera.link, &*frames.target.link], ["tool0", "base_link"]);
    let camera = Pose::from(&frames.camera.link_from_frame);
    assert!(camera.distance_m(&pose(CAMERA)) < 0.6e-3, "{camera:?}");
    assert!(camera.angle_rad(&pose(CAMERA)) < 2e-3, "{camera:?}");
    let target = Pose::from(&frames.target.link_from_frame);
    assert!(target.distance_m(&pose(TARGET)) < 0.6e-3, "{target:?}");
    if frames.has_orientation {
        assert!(target.angle_rad(&pose(TARGET)) < 2e-3, "{target:?}");
    }
    for (name, truth_rad) in ZEROS_RAD {
        let found = report.parameters.iter().find(|each| each.name == name).unwrap();
        let off = (found.correction - truth_rad).abs();
        assert!(
            off < 4.0 * found.standard_deviation && off < 6e-4,
            "{name}: {} for {truth_rad}",
            found.correction
        );
    }
}

#[test]
fn a_camera_in_the_hand_is_found_with_the_zeros_of_the_arm() {
    let robot = ur5e();
    let options = options(CameraMount::EyeInHand, &["base", "tool", "zero-offsets"]);
    let report = calibrate(&robot, &seen(&robot), &options).unwrap();
    assert_eq!(report.verdict, CalibrationVerdict::Explained);
    is_found(&report);
    // Where the camera would see the target elsewhere is not known.
    assert!(report.next.is_empty());
}

#[test]
fn points_of_the_target_suffice() {
    let robot = ur5e();
    let rows: Vec<MeasuredRow> =
        seen(&robot).into_iter().map(|row| MeasuredRow { orientation: None, ..row }).collect();
    let options = options(CameraMount::EyeInHand, &["base", "tool", "zero-offsets"]);
    let report = calibrate(&robot, &rows, &options).unwrap();
    is_found(&report);
    // Nothing shows how the target is turned, with the nominal arm, whose rows are 4 mm off, as with the corrected one.
    let nominal = calibrate(&robot, &rows, &self::options(CameraMount::EyeInHand, &["base", "tool"]));
    for report in [report, nominal.unwrap()] {
        let held: Vec<&str> = report.fixed.iter().map(|each| each.name.as_str()).collect();
        for turn in ["base.roll", "base.pitch", "base.yaw"] {
            assert!(held.contains(&turn), "{held:?}");
        }
    }
}

/// `M = X^-1 A^-1 Z` of a camera in the hand is, turned around, that of one on the table whose target is where the camera was.
#[test]
fn a_camera_beside_the_robot_sees_the_inverse_poses() {
    let robot = ur5e();
    let inverse = |row: MeasuredRow| {
        let turn = Rotation3::from_matrix_unchecked(row.orientation.unwrap().base_from_tip()).inverse();
        let point = Vector3::from(row.tip_in_base_m.map(Option::unwrap));
        let tip_in_base_m = <[f64; 3]>::from(-(turn * point)).map(Some);
        let orientation = Some(WrittenOrientation::RotationVectorRad(turn.scaled_axis().into()));
        MeasuredRow { tip_in_base_m, orientation, ..row }
    };
    let rows: Vec<MeasuredRow> = seen(&robot).into_iter().map(inverse).collect();
    let report = calibrate(&robot, &rows, &options(CameraMount::EyeToHand, &["base", "tool"])).unwrap();
    let frames = report.camera.unwrap();
    assert_eq!([&*frames.camera.link, &*frames.target.link], ["base_link", "tool0"]);
    let target = Pose::from(&frames.target.link_from_frame);
    assert!(target.distance_m(&pose(CAMERA)) < 5e-3, "{target:?}");
}

#[test]
fn the_other_mount_is_named() {
    let robot = ur5e();
    let report =
        calibrate(&robot, &seen(&robot), &options(CameraMount::EyeToHand, &["base", "tool"])).unwrap();
    assert_eq!(report.verdict, CalibrationVerdict::Unexplained);
    let condition = report.likely_reason.unwrap().condition;
    assert!(condition.contains("--camera eye-in-hand"), "{condition}");
    // Without a camera, the file is nothing that the nominal frames explain.
    let report = calibrate(&robot, &seen(&robot), &CalibrationOptions::default()).unwrap();
    let condition = report.likely_reason.unwrap().condition;
    assert!(condition.contains("--camera eye-in-hand"), "{condition}");
}

#[test]
fn the_corrected_robot_carries_the_camera_and_agrees() {
    let robot = ur5e();
    let rows = seen(&robot);
    let options = options(CameraMount::EyeInHand, &["base", "tool", "zero-offsets"]);
    let report = calibrate(&robot, &rows, &options).unwrap();
    let corrected = corrected_robot(&robot, &options, &report).unwrap().unwrap();
    let camera = corrected.description.robot.find_link(corrected.camera_link.as_deref().unwrap()).unwrap();
    let joints = corrected.description.robot.joints();
    let joint = joints.iter().find(|joint| joint.child == camera).unwrap();
    let found = Pose::from(joint.parent_from_joint);
    assert!(found.distance_m(&Pose::from(&report.camera.unwrap().camera.link_from_frame)) < 1e-12);
    assert_eq!(corrected.description.tip_from_tcp, robot.tip_from_tcp, "the tool of the arm stays");
    let check = |robot: &RobotDescription| {
        let options = MeasuredCheckOptions {
            tolerance: RequestedTolerance { position_m: Some(1.5e-3), orientation_rad: Some(0.01) },
            free: vec!["base".to_owned(), "tool".to_owned()],
            camera: Some(CameraMount::EyeInHand),
            threshold: 1e-3,
        };
        check_measured(robot, Path::new("rows"), &rows, &options).unwrap()
    };
    assert_eq!(check(&corrected.description).verdict, MeasuredVerdict::Agree);
    assert_eq!(check(&robot).verdict, MeasuredVerdict::Disagree);
}

#[test]
fn a_camera_in_the_hand_needs_whole_points() {
    let robot = ur5e();
    let mut rows = seen(&robot);
    rows[3].tip_in_base_m[1] = None;
    let refused = calibrate(&robot, &rows, &options(CameraMount::EyeInHand, &["base", "tool"])).unwrap_err();
    assert!(refused.message.contains("line 5"), "{}", refused.message);
}

#[test]
fn pictures_that_turn_about_one_axis_do_not_determine_the_camera() {
    let robot = ur5e();
    let tree = UrdfTree::new(&robot.robot);
    let mut links = vec![Pose::identity(); robot.robot.links().len()];
    let (camera, target) = (pose(CAMERA), pose(TARGET));
    let rows: Vec<MeasuredRow> = (0_u8..12)
        .map(|at| {
            let mut q = RobotQ::from([0.3, -1.1, 1.4, -1.9, -1.5, 0.0]);
            q[5] = 0.25 * f64::from(at);
            tree.root_from_links_into(&q, &mut links).unwrap();
            let [base, tip] = [robot.base, robot.tip].map(|link| links[link.get()]);
            let base_from_tip = base.inverse() * tip;
            let seen = (base_from_tip * camera).inverse() * target;
            let turn = Rotation3::from_matrix_unchecked(seen.rotation).scaled_axis();
            MeasuredRow {
                line: usize::from(at) + 2,
                q,
                tip_in_base_m: <[f64; 3]>::from(seen.translation).map(Some),
                orientation: Some(WrittenOrientation::RotationVectorRad(turn.into())),
            }
        })
        .collect();
    let options = options(CameraMount::EyeInHand, &["base", "tool"]);
    let report = calibrate(&robot, &rows, &options).unwrap();
    assert_eq!(report.verdict, CalibrationVerdict::CameraUndetermined);
    assert!(corrected_robot(&robot, &options, &report).unwrap().is_none());
    let camera = report.camera.unwrap();
    // The last joint turns about z of the flange: along it and about it nothing is known.
    assert_eq!(camera.undetermined.iter().filter(|motion| motion.is_turn).count(), 1);
    for motion in &camera.undetermined {
        assert!((motion.direction[2].abs() - 1.0).abs() < 1e-3, "{motion:?}");
    }
}

#[test]
fn a_board_of_another_size_is_named() {
    let robot = ur5e();
    let larger = |row: MeasuredRow| {
        let tip_in_base_m = row.tip_in_base_m.map(|value| value.map(|value| value / 1.04));
        MeasuredRow { tip_in_base_m, ..row }
    };
    let rows: Vec<MeasuredRow> = seen(&robot).into_iter().map(larger).collect();
    let options = options(CameraMount::EyeInHand, &["base", "tool", "zero-offsets"]);
    let report = calibrate(&robot, &rows, &options).unwrap();
    let condition = report.likely_reason.unwrap().condition;
    let size: f64 = condition.split(' ').find_map(|word| word.parse().ok()).unwrap();
    assert!(condition.contains("the target is") && (size - 1.04).abs() < 2e-3, "{condition}");
}
