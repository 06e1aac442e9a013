//! The robot with the recommended corrections of a calibration.

use std::collections::BTreeMap;

use congruent_description::{DhRow, DhTable, Robot, RobotDescription};
use congruent_input::Diagnostic;
use congruent_kinematics::{KinematicsError, Pose, PoseError, ScrewChain, SerialDh, sample_configurations};
use nalgebra::Isometry3;

use super::{
    table,
    tree::{corrected_tree, is_unchanged, with_frame},
};
use crate::{
    camera::CAMERA_GROUPS,
    camera_frames::FrameOnLink,
    chain::NominalChain,
    codes,
    estimation::{CorrectedChain, Displacements},
    free,
    options::CalibrationOptions,
    report::{CalibrationReport, Recommendation},
};

/// Link names of the frame in which the rows were measured, and of a camera.
const MEASURING_FRAME: &str = "measuring_frame";
const CAMERA: &str = "camera";
/// Random configurations of a comparison, in addition to zero, single joints and limits.
const RANDOM_CONFIGURATIONS: usize = 100;

/// A robot with corrections, in the three places that a robot file has for them.
#[derive(Debug, Clone)]
pub struct CorrectedRobot {
    /// The nominal description with the corrected tree, chain, table and tool. It has no table if no table says the
    /// corrections exactly.
    pub description: RobotDescription,
    /// The corrected chain, from the frame in which the rows were measured to the measured frame.
    pub chain: ScrewChain,
    /// The same from base to tip, without the tool.
    pub chain_to_tip: ScrewChain,
    /// The corrections that no table has; none if the description has the corrected table.
    pub beyond_the_table: Vec<String>,
    /// Pose of the nominal base in the frame in which the rows were measured, which is a link of its own then; `None` if the
    /// base was not displaced.
    pub measured_from_base: Option<Pose>,
    /// Whether the tool centre point is another than that of the nominal robot file.
    pub has_other_tool: bool,
    /// The link of the camera that measured the rows, if one did.
    pub camera_link: Option<String>,
}

/// The robot of a description with the recommended corrections of its calibration, with the same `options`; `None` if the report
/// recommends none.
///
/// All estimated corrections are in it, since they were estimated together, and those that are held away from nominal.
///
/// # Errors
/// A joint of the URDF cannot move as the table says, or as [`calibrate`](crate::calibrate).
pub fn corrected_robot(
    description: &RobotDescription,
    options: &CalibrationOptions,
    report: &CalibrationReport,
) -> Result<Option<CorrectedRobot>, Diagnostic> {
    let Some(mut values) = recommended(report) else { return Ok(None) };
    let Some(frames) = &report.camera else {
        return robot_with(description, [&options.free, &options.hold], &values).map(Some);
    };
    // Base and tool are the poses of camera and target here, which are none of the arm.
    values.retain(|name, _| !CAMERA_GROUPS.iter().any(|group| name.split('.').next() == Some(group)));
    let corrected = robot_with(description, [&options.free, &options.hold], &values)?;
    Ok(Some(with_camera(corrected, &frames.camera)))
}

/// The robot with these corrections by name, which are among those that are free and not held; the others are 0.
pub(crate) fn robot_with(
    description: &RobotDescription,
    [free, hold]: [&[String]; 2],
    values: &BTreeMap<&str, f64>,
) -> Result<CorrectedRobot, Diagnostic> {
    let nominal = NominalChain::new(description)?;
    let parameters = free::parameters(&nominal, free, hold)?;
    let chain = CorrectedChain::new(nominal.chain.clone(), parameters);
    let values: Vec<f64> = chain
        .parameters()
        .iter()
        .map(|each| values.get(each.name.as_str()).copied().unwrap_or(0.0))
        .collect();
    let corrections: Vec<table::Valued<'_>> = chain.parameters().iter().zip(values.iter().copied()).collect();
    let moved = Displacements::new(&chain, &values);
    let tree = corrected_tree(description, &nominal, &moved)?;
    let base_name = &description.robot.link(description.base).name;
    let measured_from_base = Some(moved.base).filter(|pose| *pose != Pose::identity());
    let (robot, base) = match &measured_from_base {
        Some(pose) => with_frame(&tree.robot, base_name, MEASURING_FRAME, &pose.inverse()),
        None => (tree.robot, base_name.clone()),
    };
    let screws = moved.screws(&nominal.chain);
    let base_from_tip = moved.base * tree.base_from_tip_at_zero;
    let tip_from_tcp = base_from_tip.inverse() * screws.base_from_tip_at_zero;
    let nominal_tool = description.tip_from_tcp.unwrap_or_default();
    let has_other_tool = !is_unchanged(&tip_from_tcp, &nominal_tool);
    let beyond_the_table = nominal.table.as_ref().map(|_| table::beyond_the_table(&corrections));
    let mut corrected = RobotDescription {
        dh: None,
        tip_from_tcp: if has_other_tool {
            Some(tip_from_tcp.to_isometry())
        } else {
            description.tip_from_tcp
        },
        ..in_robot(description, robot, &base)
    };
    if let (Some((nominal, _)), Some([])) = (&nominal.table, beyond_the_table.as_deref()) {
        let rows = table::corrected(nominal, &corrections);
        corrected.dh = Some(in_tree(rows, description, &corrected, &moved.base, &base_from_tip));
    }
    Ok(CorrectedRobot {
        description: corrected,
        chain_to_tip: ScrewChain { base_from_tip_at_zero: base_from_tip, ..screws.clone() },
        chain: screws,
        beyond_the_table: beyond_the_table.unwrap_or_default(),
        measured_from_base,
        has_other_tool,
        camera_link: None,
    })
}

/// The robot with a link for the camera where it was estimated.
fn with_camera(corrected: CorrectedRobot, camera: &FrameOnLink) -> CorrectedRobot {
    let description = &corrected.description;
    let pose = Pose::from(&camera.link_from_frame);
    let (robot, name) = with_frame(&description.robot, &camera.link, CAMERA, &pose);
    let base = &description.robot.link(description.base).name;
    CorrectedRobot { description: in_robot(description, robot, base), camera_link: Some(name), ..corrected }
}

/// The corrections of the recommended estimate, and those that are held, by name.
fn recommended(report: &CalibrationReport) -> Option<BTreeMap<&str, f64>> {
    let estimates = report.parameters.iter().map(|each| {
        let value = match report.recommended {
            Recommendation::Robust => each.robust_correction,
            _ => each.correction,
        };
        (each.name.as_str(), value)
    });
    let held = report.fixed.iter().map(|each| (each.name.as_str(), each.held_at));
    (report.recommended != Recommendation::Nominal).then(|| estimates.chain(held).collect())
}

/// The description with another tree, in which a link more may have moved the indices.
fn in_robot(description: &RobotDescription, robot: Robot, base: &str) -> RobotDescription {
    let link = |name: &str| robot.find_link(name).expect("the corrected tree has all links");
    let renumbered = |of| link(&description.robot.link(of).name);
    let pairs = description.disabled_collisions.iter().map(|&(one, other)| {
        let (one, other) = (renumbered(one), renumbered(other));
        if one <= other { (one, other) } else { (other, one) }
    });
    RobotDescription {
        base: link(base),
        tip: renumbered(description.tip),
        disabled_collisions: pairs.collect(),
        robot,
        ..description.clone()
    }
}

/// The corrected rows as the table of the corrected tree: its base is where the rows were measured, its end is the tip.
fn in_tree(
    rows: DhTable,
    nominal: &RobotDescription,
    corrected: &RobotDescription,
    measured_from_base: &Pose,
    base_from_tip: &Pose,
) -> DhTable {
    let joint = |row: &DhRow| {
        let name = &nominal.robot.joint(row.joint).name;
        corrected.robot.find_joint(name).expect("the corrected tree has all joints")
    };
    let base_from_dh0 = *measured_from_base * Pose::from(rows.base_from_dh0);
    let base_from_dh0 = if *measured_from_base == Pose::identity() {
        rows.base_from_dh0
    } else {
        base_from_dh0.to_isometry()
    };
    let renumbered = rows.rows.iter().map(|row| DhRow { joint: joint(row), ..*row }).collect();
    let table = DhTable { base_from_dh0, rows: renumbered, ..rows };
    // A tip that no fixed joint carries cannot leave the axis of the last joint: the table then ends where it is, and the tool has
    // the difference.
    let without_end = DhTable { dhn_from_tip: Isometry3::identity(), ..table.clone() };
    let base_from_dhn = SerialDh::from_table(&without_end).screw_chain().base_from_tip_at_zero;
    let dhn_from_tip = base_from_dhn.inverse() * *base_from_tip;
    if is_unchanged(&dhn_from_tip, &table.dhn_from_tip) {
        return table;
    }
    DhTable { dhn_from_tip: dhn_from_tip.to_isometry(), ..table }
}

impl CorrectedRobot {
    /// The largest difference of a description from the corrected chain, over zero, single joints, limits and random
    /// configurations: of its table if it has one, otherwise of its tree.
    ///
    /// # Errors
    /// The description has no chain.
    pub fn largest_difference(
        &self,
        description: &RobotDescription,
        seed: u64,
    ) -> Result<PoseError, Diagnostic> {
        let refused = |error: KinematicsError| Diagnostic::error(codes::calibrate::ROBOT, error.to_string());
        let read = NominalChain::new(description)?;
        let mut largest = PoseError::default();
        for q in sample_configurations(&description.robot, seed, RANDOM_CONFIGURATIONS) {
            let q = read.chain_positions(&q);
            let [found, expected] = [&read.chain, &self.chain].map(|chain| chain.base_from_tip(&q));
            let (found, expected) = (found.map_err(refused)?, expected.map_err(refused)?);
            largest = largest.larger(PoseError::between(&found, &expected));
        }
        Ok(largest)
    }
}
