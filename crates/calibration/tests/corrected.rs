//! The corrected robot: its tree and its table give the poses of the chain with corrections between its joints, which is computed
//! by inserted exponentials and not by origins of joints.

#![expect(clippy::unwrap_used, reason = "a helper that fails fails its test")]

use std::path::Path;

use congruent_calibration::{
    CalibrationOptions, CorrectedRobot, calibrate, corrected_robot,
    estimation::{CorrectedChain, base_pose, dh_entries, joint_axes, tool_pose, zero_offsets},
    measurements::{MeasuredRow, WrittenOrientation},
    report::{CalibrationReport, Recommendation},
};
use congruent_description::{RobotDescription, RobotQ, load_robot};
use congruent_kinematics::{
    DhChain, Pose, PoseError, ScrewChain, UrdfTree, random_configurations, sample_configurations,
};

/// Rounding of a dozen products within 4 m. Unit: m and rad. Worst seen 4e-15.
const ROUNDING: f64 = 1e-13;

fn robot(name: &str) -> RobotDescription {
    load_robot(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots").join(name)).unwrap()
}

/// The corrected chain of these corrections, from the functions that make their twists.
struct Truth {
    chain: CorrectedChain,
    values: Vec<f64>,
    coordinates: Vec<usize>,
}

impl Truth {
    /// All corrections of a robot, whose values `value` gives by name.
    fn new(description: &RobotDescription, value: impl Fn(&str) -> f64) -> Self {
        let robot = &description.robot;
        let (mut chain, coordinates, entries) = if let Some(table) = &description.dh {
            let dh = DhChain::new(table, robot);
            let names: Vec<&str> =
                table.rows.iter().map(|row| robot.joint(row.joint).name.as_str()).collect();
            let entries = dh_entries(table, &dh, &names, robot.dof()).unwrap();
            (ScrewChain::from_dh(&dh, robot.dof()).unwrap(), dh.coordinates().to_vec(), entries)
        } else {
            let coordinates = description.moving_coordinates();
            let chain = ScrewChain::from_urdf(robot, description.base, description.tip, &coordinates);
            (chain.unwrap(), coordinates, Vec::new())
        };
        let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
        chain.base_from_tip_at_zero = chain.base_from_tip_at_zero * tip_from_tcp;
        let joints = description.moving_chain();
        let names: Vec<&str> = joints.iter().map(|&joint| robot.joint(joint).name.as_str()).collect();
        let of_arm = [zero_offsets(&chain, &names), entries, joint_axes(&chain, &names)].concat();
        let parameters = [base_pose(), of_arm, tool_pose(&chain)].concat();
        let chain = CorrectedChain::new(chain, parameters);
        let values = chain.parameters().iter().map(|each| value(&each.name)).collect();
        Self { chain, values, coordinates }
    }

    fn pose(&self, q: &RobotQ) -> Pose {
        self.chain.base_from_tip(&q.chain_positions(&self.coordinates), &self.values)
    }

    /// Perfect measurements of the pose.
    fn rows(&self, description: &RobotDescription) -> Vec<MeasuredRow> {
        let configurations = random_configurations(&description.robot, 7, 60);
        let row = |(at, q): (usize, &RobotQ)| {
            let pose = self.pose(q);
            let orientation = WrittenOrientation::QuaternionWxyz(pose.quaternion_wxyz());
            MeasuredRow {
                line: at + 2,
                q: q.clone(),
                tip_in_base_m: pose.translation.map(Some).into(),
                orientation: Some(orientation),
            }
        };
        configurations.iter().enumerate().map(row).collect()
    }
}

/// The value of a correction that `words` name, by their end: lengths of some mm, angles of some mrad, all different.
fn some(words: &'static [&'static str]) -> impl Fn(&str) -> f64 {
    move |name| {
        let size = name.bytes().fold(7_u32, |sum, byte| (31 * sum + u32::from(byte)) % 1009);
        let is_named = words.iter().any(|word| name.starts_with(word) || name.ends_with(word));
        if is_named { (f64::from(size) / 1009.0 - 0.5) * 8e-3 } else { 0.0 }
    }
}

fn calibrated(
    description: &RobotDescription,
    truth: &Truth,
    free: &str,
) -> (CalibrationReport, CorrectedRobot) {
    let free = free.split(',').map(str::to_owned).collect();
    let options = CalibrationOptions { free, suggestions: 0, ..CalibrationOptions::default() };
    let report = calibrate(description, &truth.rows(description), &options).unwrap();
    assert!(report.least_squares.residuals.worst_m < 1e-9, "{:?}", report.least_squares);
    let corrected = corrected_robot(description, &options, &report).unwrap().expect("it is recommended");
    (report, corrected)
}

/// The pose of the measured frame by the tree of a description, joint after joint.
fn by_tree(description: &RobotDescription, q: &RobotQ) -> Pose {
    let tree = UrdfTree::new(&description.robot);
    let root_from = |link| tree.root_from_link(q, link).unwrap();
    let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
    root_from(description.base).inverse() * root_from(description.tip) * tip_from_tcp
}

/// Tree, table and the chain of the answer are the estimated chain.
#[track_caller]
fn is_exact(nominal: &RobotDescription, report: &CalibrationReport, corrected: &CorrectedRobot) {
    let value = |name: &str| {
        let estimate = report.parameters.iter().find(|each| each.name == name);
        let held = report.fixed.iter().find(|each| each.name == name);
        estimate.map(|each| each.correction).or(held.map(|each| each.held_at)).unwrap_or(0.0)
    };
    assert_eq!(report.recommended, Recommendation::LeastSquares);
    let estimated = Truth::new(nominal, value);
    let description = &corrected.description;
    let mut worst = PoseError::default();
    for q in sample_configurations(&description.robot, 1, 50) {
        let expected = estimated.pose(&q);
        worst = worst.larger(PoseError::between(&by_tree(description, &q), &expected));
        let in_chain = q.chain_positions(&estimated.coordinates);
        worst =
            worst.larger(PoseError::between(&corrected.chain.base_from_tip(&in_chain).unwrap(), &expected));
        if let Some(table) = &description.dh {
            let tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
            let dh = DhChain::new(table, &description.robot).base_from_tcp(&q, &tcp).unwrap();
            worst = worst.larger(PoseError::between(&dh, &expected));
        }
    }
    assert!(worst.position_m < ROUNDING && worst.orientation_rad < ROUNDING, "{worst:?}");
    let found = corrected.largest_difference(description, 3).unwrap();
    assert!(found.position_m < ROUNDING && found.orientation_rad < ROUNDING, "{found:?}");
}

#[test]
fn entries_of_a_table_stay_entries_of_a_table() {
    // Both conventions, sliding joints, a tip that no fixed joint carries, and a side branch.
    for name in ["ur5e", "panda", "rrr_arm", "spatial_3r", "cylindrical_rpp", "spherical_wrist"] {
        let nominal = robot(name);
        let truth = Truth::new(&nominal, some(&[".theta", ".d", ".a", ".alpha"]));
        let (report, corrected) = calibrated(&nominal, &truth, "dh");
        is_exact(&nominal, &report, &corrected);
        let has_beta = report.parameters.iter().any(|each| each.name.split('.').nth(1) == Some("beta"));
        assert_eq!(corrected.description.dh.is_some(), !has_beta, "{name}");
    }
}

#[test]
fn held_turns_between_parallel_axes_keep_the_table() {
    let nominal = robot("ur5e");
    let truth = Truth::new(&nominal, some(&[".theta", ".a", ".alpha"]));
    let free = CalibrationOptions {
        free: vec!["dh".to_owned()],
        hold: vec!["shoulder_lift_joint.beta".to_owned(), "elbow_joint.beta".to_owned()],
        suggestions: 0,
        ..CalibrationOptions::default()
    };
    let report = calibrate(&nominal, &truth.rows(&nominal), &free).unwrap();
    let corrected = corrected_robot(&nominal, &free, &report).unwrap().unwrap();
    is_exact(&nominal, &report, &corrected);
    let table = corrected.description.dh.as_ref().unwrap();
    let expected = some(&[".theta", ".a", ".alpha"])("elbow_joint.a") - 0.3922;
    assert!((table.rows[2].a_m - expected).abs() < 1e-9, "{}", table.rows[2].a_m);
    // What was not corrected keeps the digits of the file.
    assert_eq!(table.base_from_dh0, nominal.dh.as_ref().unwrap().base_from_dh0);
    assert_eq!((corrected.has_other_tool, corrected.measured_from_base), (false, None));
}

#[test]
fn base_and_tool_have_places_of_their_own() {
    let nominal = robot("panda");
    let truth = Truth::new(&nominal, some(&["base.", "tool.", ".theta"]));
    let (report, corrected) = calibrated(&nominal, &truth, "base,tool,dh");
    is_exact(&nominal, &report, &corrected);
    let description = &corrected.description;
    assert!(corrected.has_other_tool && description.dh.is_some());
    // The root and what hangs on it stay; the rows were measured in a link of its own.
    assert_eq!(description.robot.link(description.base).name, "measuring_frame");
    assert_eq!(description.robot.root(), nominal.robot.root());
    assert_eq!(description.robot.link(description.tip).name, "panda_link8");
    assert_eq!(description.robot.links().len(), nominal.robot.links().len() + 1);
}

#[test]
fn after_an_alignment_the_frames_are_estimated_and_the_arm_stays_nominal() {
    let nominal = robot("ur5e");
    let frames = |name: &str| match name {
        "base.x" => 3.0,
        "base.yaw" => 1.0,
        "tool.z" => 0.2,
        "tool.yaw" => 0.5,
        _ => 0.0,
    };
    let truth = Truth::new(&nominal, frames);
    let (report, corrected) = calibrated(&nominal, &truth, "all");
    let fixed: Vec<&str> = report.fixed.iter().map(|each| each.name.as_str()).collect();
    // The first and the last zero have the effect of a yaw of base and tool.
    for name in ["shoulder_pan_joint.theta", "wrist_3_joint.theta"] {
        assert!(fixed.contains(&name), "{fixed:?}");
    }
    assert!(fixed.iter().all(|name| !name.starts_with("base.") && !name.starts_with("tool.")), "{fixed:?}");
    assert!(report.fixed.iter().all(|each| each.held_at == 0.0), "{:?}", report.fixed);
    let base = report.frames.as_ref().unwrap().measured_from_base.unwrap();
    let yaw_rad = base.rpy_rad()[2];
    assert!((base.translation_m[0] - 3.0).abs() < 1e-9 && (yaw_rad - 1.0).abs() < 1e-9, "{base:?}");
    is_exact(&nominal, &report, &corrected);
}

#[test]
fn a_urdf_without_a_table_is_corrected_by_its_axes() {
    for name in ["ur5e", "panda", "cylindrical_rpp"] {
        let mut nominal = robot(name);
        nominal.dh = None;
        let truth = Truth::new(&nominal, some(&[".zero", ".tilt_x", ".shift_y"]));
        let (report, corrected) = calibrated(&nominal, &truth, "zero-offsets,axes,tool");
        is_exact(&nominal, &report, &corrected);
        assert!(corrected.description.dh.is_none() && corrected.beyond_the_table.is_empty(), "{name}");
    }
}

#[test]
fn a_zero_turns_the_link_of_its_joint_and_what_hangs_on_it() {
    let nominal = robot("ur5e");
    let truth = Truth::new(&nominal, |name| if name == "wrist_3_joint.zero" { 0.01 } else { 0.0 });
    let (_, corrected) = calibrated(&nominal, &truth, "zero-offsets");
    let q = RobotQ::zeros(6);
    let home = |description: &RobotDescription, link: &str| {
        let link = description.robot.find_link(link).unwrap();
        UrdfTree::new(&description.robot).root_from_link(&q, link).unwrap()
    };
    for link in ["wrist_3_link", "ft_frame", "flange", "tool0"] {
        let turned = home(&corrected.description, link).angle_rad(&home(&nominal, link));
        assert!((turned - 0.01).abs() < 1e-9, "{link}: {turned}");
    }
    let still = home(&corrected.description, "wrist_2_link").angle_rad(&home(&nominal, "wrist_2_link"));
    assert!(still < 1e-9, "{still}");
}

#[test]
fn a_joint_that_turns_the_other_way_in_the_table_has_no_origin() {
    let mut nominal = robot("planar_2r");
    nominal.dh.as_mut().unwrap().rows[1].sign = -1.0;
    let truth = Truth::new(&nominal, some(&[".zero"]));
    let options = CalibrationOptions { suggestions: 0, ..CalibrationOptions::default() };
    let report = calibrate(&nominal, &truth.rows(&nominal), &options).unwrap();
    let error = corrected_robot(&nominal, &options, &report).unwrap_err();
    assert!(error.message.contains("\"joint_2\" moves otherwise"), "{error:?}");
    // Nothing is recommended, so there is nothing to write.
    let report = CalibrationReport { recommended: Recommendation::Nominal, ..report };
    assert!(corrected_robot(&nominal, &options, &report).unwrap().is_none());
}
