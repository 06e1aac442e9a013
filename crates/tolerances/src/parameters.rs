//! Which parameters may be off, and by how much: from declared tolerances.

use congruent_calibration::estimation::{
    CorrectionEntry, CorrectionParameter, ParameterUnit, base_pose, dh_entries, tool_pose, zero_offsets,
};
use congruent_description::{
    DeclaredTolerances, ErrorDistribution, FrameTolerances, ParameterTolerances, RobotDescription, RobotQ,
};
use congruent_input::Diagnostic;
use congruent_kinematics::{DhChain, KinematicsError, Pose, ScrewChain, Twist, UrdfTree};

use crate::{codes, error_chain::ErrorChain, spread::ErrorSpread};

/// A parameter of the model that may be off.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ToleratedParameter {
    /// `<joint>.<entry>`, `base.<axis>` or `tcp.<axis>`.
    pub(crate) name: String,
    /// Of the error.
    pub(crate) unit: ParameterUnit,
}

/// A chain, its parameters and the distribution of their errors.
#[derive(Debug, Clone, PartialEq)]
pub struct ToleratedChain {
    pub(crate) chain: ErrorChain,
    pub(crate) parameters: Vec<ToleratedParameter>,
    pub(crate) spread: ErrorSpread,
    /// What the tolerances leave out.
    pub warnings: Vec<Diagnostic>,
}

/// The chain from base to tool: of the table if there is one, otherwise of the URDF.
#[derive(Debug)]
pub(crate) struct NominalModel<'a> {
    pub(crate) description: &'a RobotDescription,
    /// Of the table.
    pub(crate) dh: Option<DhChain>,
    /// Up to the tool centre point.
    pub(crate) chain: ScrewChain,
    pub(crate) coordinates: Vec<usize>,
}

impl<'a> NominalModel<'a> {
    /// # Errors
    /// No joint moves between base and tip.
    pub(crate) fn new(description: &'a RobotDescription) -> Result<Self, Diagnostic> {
        let robot = &description.robot;
        let dh = description.dh.as_ref().map(|table| DhChain::new(table, robot));
        let coordinates = match &dh {
            Some(dh) => dh.coordinates().to_vec(),
            None => description.moving_coordinates(),
        };
        if coordinates.is_empty() {
            return Err(refused(&KinematicsError::NoJoint));
        }
        let mut chain = match &dh {
            Some(dh) => ScrewChain::from_dh(dh, robot.dof()),
            None => ScrewChain::from_urdf(robot, description.base, description.tip, &coordinates),
        }
        .map_err(|error| refused(&error))?;
        let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
        chain.base_from_tip_at_zero = chain.base_from_tip_at_zero * tip_from_tcp;
        Ok(Self { description, dh, chain, coordinates })
    }

    /// Names of the chain's joints, base to tip.
    pub(crate) fn joint_names(&self) -> Vec<&'a str> {
        let robot = &self.description.robot;
        let name = |&coordinate: &usize| robot.joint(robot.movable_joints()[coordinate]).name.as_str();
        self.coordinates.iter().map(name).collect()
    }

    /// The entries of the table; none without one.
    pub(crate) fn entries(&self, names: &[&str]) -> Result<Vec<CorrectionParameter>, Diagnostic> {
        let (Some(table), Some(dh)) = (&self.description.dh, &self.dh) else { return Ok(Vec::new()) };
        let dof = self.description.robot.dof();
        dh_entries(table, dh, names, dof).map_err(|error| refused(&error))
    }

    /// Pose of the joint's frame in the base at zero, for each joint of the chain.
    pub(crate) fn base_from_joints(&self) -> Result<Vec<Pose>, Diagnostic> {
        let robot = &self.description.robot;
        let (tree, zero) = (UrdfTree::new(robot), RobotQ::zeros(robot.dof()));
        let pose = |link| tree.root_from_link(&zero, link).map_err(|error| refused(&error));
        let base_from_root = pose(self.description.base)?.inverse();
        let frame = |&coordinate: &usize| {
            let joint = robot.joint(robot.movable_joints()[coordinate]);
            Ok(base_from_root * pose(joint.parent)? * Pose::from(joint.parent_from_joint))
        };
        self.coordinates.iter().map(frame).collect()
    }

    /// The chain with these errors, of which those without a tolerance are dropped.
    fn with_errors(
        self,
        mut errors: Vec<(CorrectionParameter, f64)>,
        distribution: ErrorDistribution,
    ) -> ToleratedChain {
        errors.retain(|(_, tolerance)| *tolerance > 0.0);
        let (corrections, tolerances) = errors.into_iter().unzip();
        self.with_spread(corrections, ErrorSpread::independent(tolerances, distribution))
    }

    /// The chain with these corrections as errors, in the order in which those of one slot act.
    pub(crate) fn with_spread(
        self,
        corrections: Vec<CorrectionParameter>,
        spread: ErrorSpread,
    ) -> ToleratedChain {
        let parameter =
            |of: &CorrectionParameter| ToleratedParameter { name: of.name.clone(), unit: of.unit() };
        let parameters = corrections.iter().map(parameter).collect();
        let chain = ErrorChain::new(self.chain, self.coordinates, corrections);
        ToleratedChain { chain, parameters, spread, warnings: Vec::new() }
    }
}

pub(crate) fn refused(error: &KinematicsError) -> Diagnostic {
    Diagnostic::error(codes::tolerances::ROBOT, error.to_string())
}

/// The chain with the errors that declared tolerances allow.
///
/// # Errors
/// No joint moves, a row is of no joint of the chain or of one that has a row, or a tolerance is of no parameter of this robot.
pub fn declared(
    description: &RobotDescription,
    tolerances: &DeclaredTolerances,
) -> Result<ToleratedChain, Diagnostic> {
    let model = NominalModel::new(description)?;
    let names = model.joint_names();
    if let Some(row) = tolerances.rows.iter().find(|row| !names.contains(&row.joint.as_str())) {
        let message = format!("[[tolerances.row]]: \"{}\" is no joint of the chain", row.joint);
        let known = congruent_input::known_names(&row.joint, "joints", names.iter().copied());
        return Err(Diagnostic::error(codes::tolerances::JOINT, message).with_help(known));
    }
    let repeated = tolerances
        .rows
        .iter()
        .enumerate()
        .find(|(at, row)| tolerances.rows[..*at].iter().any(|before| before.joint == row.joint));
    if let Some((_, row)) = repeated {
        let message = format!("[[tolerances.row]]: joint \"{}\" has two rows", row.joint);
        return Err(Diagnostic::error(codes::tolerances::JOINT, message)
            .with_help("write its tolerances into one row"));
    }
    without_effect(description, tolerances)?;
    let mut errors = frame_errors(base_pose(), &tolerances.base);
    // The zero of a joint comes before the rest of its row: its axis is the joint's, so that it commutes with it alone.
    errors.extend(zero_offsets(&model.chain, &names).into_iter().zip(&names).map(|(zero, name)| {
        let of = tolerances.of_joint(name);
        let tolerance = match zero.unit() {
            ParameterUnit::Angle => of.zero_rad,
            ParameterUnit::Length => of.zero_m,
        };
        (zero, tolerance.unwrap_or(0.0))
    }));
    errors.extend(row_errors(&model, tolerances, &names)?);
    errors.extend(origin_errors(&model, tolerances, &names)?);
    let tool = tool_pose(&model.chain).into_iter().map(|of| {
        let name = of.name.replacen("tool.", "tcp.", 1);
        CorrectionParameter { name, ..of }
    });
    errors.extend(frame_errors(tool.collect(), &tolerances.tcp));
    let chain = model.with_errors(errors, tolerances.distribution);
    if chain.parameters.is_empty() { Err(nothing_varies(description)) } else { Ok(chain) }
}

/// The refusal of a robot for which no tolerance is given: with what to write.
pub fn no_tolerances(description: &RobotDescription) -> Diagnostic {
    let message = format!("robot \"{}\" has no tolerances, and none are given", description.name);
    let (option, keys) = if description.dh.is_some() {
        (
            "--a 0.05mm --d 0.05mm --alpha 0.02deg --theta 0.02deg",
            "a_mm = 0.05, d_mm = 0.05, alpha_deg = 0.02, theta_deg = 0.02",
        )
    } else {
        ("--xyz 0.05mm --rpy 0.02deg", "xyz_mm = 0.05, rpy_deg = 0.02")
    };
    Diagnostic::error(codes::tolerances::NONE, message).with_help(format!(
        "give them as {option}, or write a section [tolerances] in robot.toml with {keys}, one in each line; --calibration FILE takes \
         them from a calibration, --digits from the digits of the file"
    ))
}

/// Refuses a tolerance of a row of a table for a robot without one, and of the origin of a joint for a robot with one.
fn without_effect(description: &RobotDescription, tolerances: &DeclaredTolerances) -> Result<(), Diagnostic> {
    let given = std::iter::once(&tolerances.general).chain(tolerances.rows.iter().map(|row| &row.tolerances));
    let has_table = description.dh.is_some();
    let keys = |of: &ParameterTolerances| -> Vec<&'static str> {
        let of_rows = [("a", of.a_m), ("d", of.d_m), ("alpha", of.alpha_rad), ("theta", of.theta_rad)];
        let of_origins = [("xyz", of.xyz_m), ("rpy", of.rpy_rad)];
        let wrong: &[(&str, Option<f64>)] = if has_table { &of_origins } else { &of_rows };
        wrong.iter().filter(|(_, value)| value.is_some()).map(|(key, _)| *key).collect()
    };
    let Some(key) = given.flat_map(keys).next() else { return Ok(()) };
    let (what, help) = if has_table {
        ("a table, whose rows have a, d, alpha and theta", "for example --a 0.05mm --alpha 0.02deg")
    } else {
        ("no table, so its joints have an origin", "for example --xyz 0.05mm --rpy 0.02deg")
    };
    let message = format!("a tolerance of {key} has no effect: robot \"{}\" has {what}", description.name);
    Err(Diagnostic::error(codes::tolerances::NONE, message).with_help(help))
}

/// The refusal of tolerances that are of no parameter of the robot.
fn nothing_varies(description: &RobotDescription) -> Diagnostic {
    let message = "no tolerance is of a parameter of this robot, so nothing varies";
    let help = if description.dh.is_some() {
        "the robot has a table: give a, d, alpha or theta of its rows, such as --a 0.05mm --alpha 0.02deg"
    } else {
        "the robot has no table: give the origins of its joints, such as --xyz 0.05mm --rpy 0.02deg"
    };
    Diagnostic::error(codes::tolerances::NONE, message).with_help(help)
}

/// The six errors of a frame with their tolerances.
fn frame_errors(six: Vec<CorrectionParameter>, of: &FrameTolerances) -> Vec<(CorrectionParameter, f64)> {
    let tolerance = |correction: &CorrectionParameter| match correction.unit() {
        ParameterUnit::Length => of.position_m.unwrap_or(0.0),
        ParameterUnit::Angle => of.orientation_rad.unwrap_or(0.0),
    };
    let with_tolerance = |correction| {
        let tolerance = tolerance(&correction);
        (correction, tolerance)
    };
    six.into_iter().map(with_tolerance).collect()
}

/// a, d, alpha and theta of each row.
fn row_errors(
    model: &NominalModel<'_>,
    tolerances: &DeclaredTolerances,
    names: &[&str],
) -> Result<Vec<(CorrectionParameter, f64)>, Diagnostic> {
    let entries = model.entries(names)?.into_iter();
    let with_tolerance = entries.filter_map(|entry| {
        let of = tolerances.of_joint(names[entry.joint?]);
        // The entry that the coordinate is added to is `theta` or `d`, as its unit says.
        let tolerance = match (entry.entry, entry.unit()) {
            (CorrectionEntry::A, _) => of.a_m,
            (CorrectionEntry::Alpha, _) => of.alpha_rad,
            (CorrectionEntry::JointEntry | CorrectionEntry::ConstantEntry, ParameterUnit::Angle) => {
                of.theta_rad
            }
            (CorrectionEntry::JointEntry | CorrectionEntry::ConstantEntry, ParameterUnit::Length) => of.d_m,
            _ => None,
        };
        Some((entry, tolerance?))
    });
    Ok(with_tolerance.collect())
}

/// Origins of joints, of a robot without a table: three shifts along and three turns about the axes of the joint's frame.
///
/// Turns about three axes of the frame, and not the typed roll, pitch and yaw: at a pitch of 90 degrees these have two
/// directions only, and a part that is made has errors in all three.
fn origin_errors(
    model: &NominalModel<'_>,
    tolerances: &DeclaredTolerances,
    names: &[&str],
) -> Result<Vec<(CorrectionParameter, f64)>, Diagnostic> {
    const AXES: [&str; 6] = ["roll", "pitch", "yaw", "x", "y", "z"];
    if model.dh.is_some() {
        return Ok(Vec::new());
    }
    let mut errors = Vec::new();
    for (slot, (base_from_joint, name)) in model.base_from_joints()?.iter().zip(names).enumerate() {
        let of = tolerances.of_joint(name);
        let units = Twist::units().into_iter().zip(AXES);
        // Shifts first, then turns: the origin is where it is, and the frame is turned about it.
        let ordered = units.clone().skip(3).chain(units.take(3));
        for (unit, axis) in ordered {
            let tolerance = if unit.angular.norm() > 0.0 { of.rpy_rad } else { of.xyz_m };
            let correction = CorrectionParameter {
                name: format!("{name}.{axis}"),
                entry: CorrectionEntry::AxisShift,
                joint: Some(slot),
                slot,
                generator_in_base: unit.transformed_by(base_from_joint),
            };
            errors.push((correction, tolerance.unwrap_or(0.0)));
        }
    }
    Ok(errors)
}
