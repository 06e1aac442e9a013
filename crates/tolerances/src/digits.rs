//! Errors by the digits that a robot is written with: half of the last place of each value.

use congruent_calibration::estimation::{CorrectionEntry, CorrectionParameter, ParameterUnit};
use congruent_description::{
    DhTable, ErrorDistribution, JointIndex, RobotDescription, RobotFilePlaces, RobotQ, SmallMotion,
    motions_of_pose,
};
use congruent_input::Diagnostic;
use congruent_kinematics::{Pose, Twist, UrdfTree};
use nalgebra::Isometry3;

use crate::{
    codes,
    error_chain::{ErrorChain, ErrorMotion, PlacedMotion},
    parameters::{NominalModel, ToleratedChain, ToleratedParameter, refused},
    spread::ErrorSpread,
};

/// Parameters and motions while they are collected.
#[derive(Debug, Default)]
struct DigitErrors {
    parameters: Vec<ToleratedParameter>,
    tolerances: Vec<f64>,
    motions: Vec<PlacedMotion>,
}

impl DigitErrors {
    /// Adds a parameter whose error within `half` makes this motion in the base at zero, which is `half` of a unit long.
    fn add(&mut self, name: String, motion: Twist, slot: usize) -> usize {
        let turn = motion.angular.norm();
        let (unit, half) = match turn {
            0.0 => (ParameterUnit::Length, motion.linear.norm()),
            _ => (ParameterUnit::Angle, turn),
        };
        let parameter = self.parameters.len();
        // Two numbers of a file may move the same joint in nearly the same direction.
        let alike = self.parameters.iter().filter(|of| of.name.starts_with(&name)).count();
        let name = if alike == 0 { name } else { format!("{name}_{}", alike + 1) };
        self.parameters.push(ToleratedParameter { name, unit });
        self.tolerances.push(half);
        self.place(parameter, motion * (1.0 / half), slot);
        parameter
    }

    fn place(&mut self, parameter: usize, unit: Twist, slot: usize) {
        self.motions.push(PlacedMotion { slot, motion: ErrorMotion::new(parameter, &unit) });
    }

    /// Adds the motions of the numbers of a pose; the pose is in `base_from_frame`.
    fn add_pose(&mut self, of: &str, motions: &[SmallMotion], base_from_frame: &Pose, slot: usize) {
        let is_turn = |motion: &&SmallMotion| motion.angular_rad.norm() > 0.0;
        let shifts = motions.iter().filter(|motion| !is_turn(motion));
        // R = Rz(yaw) Ry(pitch) Rx(roll): the last angle acts first.
        for motion in shifts.chain(motions.iter().filter(is_turn).rev()) {
            let name = format!("{of}.{}", direction(motion));
            self.add(name, in_base(motion, base_from_frame), slot);
        }
    }

    fn finish(self, model: NominalModel<'_>) -> Result<ToleratedChain, Diagnostic> {
        if self.parameters.is_empty() {
            let message = "every value of the files is exact by its digits, so nothing varies";
            let help = "give tolerances as options, such as --a 0.05mm or --xyz 0.05mm";
            return Err(Diagnostic::error(codes::tolerances::NONE, message).with_help(help));
        }
        let chain = ErrorChain::of_motions(model.chain, model.coordinates, self.motions);
        let spread = ErrorSpread::independent(self.tolerances, ErrorDistribution::Uniform);
        Ok(ToleratedChain { chain, parameters: self.parameters, spread, warnings: Vec::new() })
    }
}

/// The axis that a motion is nearest to.
fn direction(motion: &SmallMotion) -> &'static str {
    let (names, vector) = match motion.angular_rad.norm() {
        0.0 => (["x", "y", "z"], motion.linear_m),
        _ => (["roll", "pitch", "yaw"], motion.angular_rad),
    };
    names[vector.iamax()]
}

fn in_base(motion: &SmallMotion, base_from_frame: &Pose) -> Twist {
    Twist { angular: motion.angular_rad, linear: motion.linear_m }.transformed_by(base_from_frame)
}

/// The chain with the errors that the digits of its files leave open: of the table if there is one, otherwise of the joints.
///
/// # Errors
/// No joint moves, or every value is exact by its digits.
pub fn written_digits(description: &RobotDescription) -> Result<ToleratedChain, Diagnostic> {
    let model = NominalModel::new(description)?;
    match (&description.dh, &description.places.robot_file) {
        (Some(table), Some(places)) => of_table(model, table, places),
        _ => of_joints(model),
    }
}

fn of_table(
    model: NominalModel<'_>,
    table: &DhTable,
    places: &RobotFilePlaces,
) -> Result<ToleratedChain, Diagnostic> {
    let (names, digits) = (model.joint_names(), places.digits());
    let mut errors = DigitErrors::default();
    errors.add_pose("base", &small(digits.base, &table.base_from_dh0), &Pose::identity(), 0);
    for CorrectionParameter { name, entry, joint, slot, generator_in_base } in model.entries(&names)? {
        let Some([a, alpha, d, theta]) = joint.and_then(|row| digits.rows.get(row)) else { continue };
        let is_turn = generator_in_base.angular.norm() > 0.5;
        let half = match entry {
            CorrectionEntry::A => a,
            CorrectionEntry::Alpha => alpha,
            CorrectionEntry::JointEntry | CorrectionEntry::ConstantEntry if is_turn => theta,
            CorrectionEntry::JointEntry | CorrectionEntry::ConstantEntry => d,
            _ => continue,
        };
        if *half > 0.0 {
            errors.add(name, generator_in_base * *half, slot);
        }
    }
    if let Some(dh) = &model.dh {
        let mut base_from_dh = vec![Pose::identity(); table.rows.len() + 1];
        let zero = RobotQ::zeros(model.description.robot.dof());
        dh.dh_frames_into(&zero, &mut base_from_dh).map_err(|error| refused(&error))?;
        let motions = small(digits.tool, &table.dhn_from_tip);
        errors.add_pose("tool", &motions, &base_from_dh[table.rows.len()], table.rows.len());
    }
    errors.finish(model)
}

fn small(halves: [f64; 6], pose: &Isometry3<f64>) -> Vec<SmallMotion> {
    motions_of_pose(halves, pose)
}

/// All joints from base to tip, fixed ones among them: also those before the first joint that moves, if the base is above them.
fn joints_between(description: &RobotDescription) -> Vec<JointIndex> {
    let (robot, base) = (&description.robot, description.base);
    let (mut link, mut joints) = (description.tip, Vec::new());
    while let (true, Some(joint)) = (link != base, robot.parent_joint(link)) {
        joints.push(joint);
        link = robot.joint(joint).parent;
    }
    if link != base {
        // The base is beside the chain, on the same body: its own pose on that body is taken as exact.
        return robot.chain(base, description.tip).unwrap_or_default();
    }
    joints.reverse();
    joints
}

/// Of all joints of the chain, those that are fixed among them.
fn of_joints(model: NominalModel<'_>) -> Result<ToleratedChain, Diagnostic> {
    let robot = &model.description.robot;
    let (tree, zero) = (UrdfTree::new(robot), RobotQ::zeros(robot.dof()));
    let pose = |link| tree.root_from_link(&zero, link).map_err(|error| refused(&error));
    let base_from_root = pose(model.description.base)?.inverse();
    let mut errors = DigitErrors::default();
    let mut slot = 0;
    for index in joints_between(model.description) {
        let joint = robot.joint(index);
        let base_from_parent = base_from_root * pose(joint.parent)?;
        errors.add_pose(&joint.name, &joint.rounding.origin, &base_from_parent, slot);
        if !joint.kind.is_movable() {
            continue;
        }
        for motion in &joint.rounding.axis {
            let twist = in_base(motion, &base_from_parent);
            let parameter = errors.add(format!("{}.axis_{}", joint.name, direction(motion)), twist, slot);
            // The axis is tilted, and the link that it carries is not: the motion is undone behind the joint.
            errors.place(parameter, twist * (-1.0 / errors.tolerances[parameter]), slot + 1);
        }
        slot += 1;
    }
    errors.finish(model)
}
