//! `congruent sensitivity`: what 1 degree or 1 mm in each parameter does at the tool.

use congruent_description::{ArmQ, DhRow, DhRowKind, DhTable, JointValues, RobotDescription, RobotQ};
use congruent_kinematics::{
    Arm, ArmJoint, DhChain, Displacement, KinematicsError, Pose, Sampling, displacement,
};
use serde::Serialize;

use crate::{
    joint_names,
    plot::{Bar, BarChart, PlotError, bars},
};

/// The error of an angle: 1 degree.
const ANGLE_RAD: f64 = std::f64::consts::PI / 180.0;
/// The error of a length: 1 mm.
const LENGTH_M: f64 = 1e-3;

/// The answer of `congruent sensitivity`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SensitivityReport {
    /// Name of the robot.
    pub robot: String,
    /// Random configurations behind each mean.
    pub samples: usize,
    /// Their seed.
    pub seed: u64,
    /// One entry for each length factor.
    pub arms: Vec<ArmSensitivity>,
}

/// The robot, or one like it with all lengths and strokes multiplied.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ArmSensitivity {
    /// The factor.
    pub length_factor: f64,
    /// The effect of each parameter.
    pub parameters: Vec<ParameterEffect>,
}

/// What an error of one parameter does at the tool centre point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParameterEffect {
    /// The joint, or the joint of the table's row.
    pub joint: String,
    /// `zero` of the joint, or `a`, `alpha`, `d`, `theta` of its row.
    pub parameter: &'static str,
    /// What it is off by: `1 deg` or `1 mm`.
    pub error: &'static str,
    /// Largest displacement over the joint range that was found.
    pub worst_mm: f64,
    /// Mean displacement over the joint range.
    pub mean_mm: f64,
    /// Largest turn of the tool.
    pub worst_deg: f64,
    /// The configuration of the largest displacement, rad or m.
    pub worst_at: JointValues,
}

/// One parameter that may be off.
#[derive(Debug, Clone, Copy)]
struct Parameter {
    name: &'static str,
    is_angle: bool,
}

/// The effect of every joint zero, and of the table's other entries where a table is declared.
///
/// An error of an angle displaces the tool in proportion to the arm's lengths and an error of a
/// length does not depend on them, so arms of other lengths need no sampling of their own.
///
/// # Errors
/// [`KinematicsError::NoJoint`] where the robot has no arm.
pub fn sensitivity(
    description: &RobotDescription,
    length_factors: &[f64],
    sampling: Sampling,
) -> Result<SensitivityReport, KinematicsError> {
    let arm = Arm::of(description)?;
    let names = joint_names(description, &arm);
    let mut effects = zero_effects(&arm, &names, sampling);
    if let Some(table) = &description.dh {
        effects.extend(table_effects(description, table, &arm, sampling));
    }
    let scaled = |&length_factor: &f64| ArmSensitivity {
        length_factor,
        parameters: effects
            .iter()
            .map(|(joint, parameter, found)| effect(joint, *parameter, found, (&arm, &names, length_factor)))
            .collect(),
    };
    Ok(SensitivityReport {
        robot: description.robot.name().to_owned(),
        samples: sampling.samples,
        seed: sampling.seed,
        arms: length_factors.iter().map(scaled).collect(),
    })
}

type Effect = (String, Parameter, Displacement);

fn zero_effects(arm: &Arm, names: &[String], sampling: Sampling) -> Vec<Effect> {
    let effect = |(at, (joint, name)): (usize, (&ArmJoint, &String))| {
        let parameter = Parameter { name: "zero", is_angle: joint.turns };
        let (mut meant, mut built) = (arm.clone(), arm.clone());
        let mut shifted = ArmQ::zeros(names.len());
        let pair = |q: &ArmQ| {
            shifted.copy_from_slice(q);
            shifted[at] += parameter.error();
            let pose = |arm: &mut Arm, q: &ArmQ| arm.base_from_tcp(q).expect("q is a configuration");
            (pose(&mut meant, q), pose(&mut built, &shifted))
        };
        (name.clone(), parameter, displacement(arm.joints(), pair, sampling))
    };
    arm.joints().iter().zip(names).enumerate().map(effect).collect()
}

/// Every entry but the one that is the joint's zero.
fn table_effects(
    description: &RobotDescription,
    table: &DhTable,
    arm: &Arm,
    sampling: Sampling,
) -> Vec<Effect> {
    let robot = &description.robot;
    let meant = DhChain::new(table, robot);
    let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
    let mut q_robot = RobotQ::zeros(robot.dof());
    let mut effects = Vec::new();
    for at in 0..table.rows.len() {
        for (parameter, entry) in entries(table.rows[at].kind) {
            let mut off = table.clone();
            *entry(&mut off.rows[at]) += parameter.error();
            let built = DhChain::new(&off, robot);
            let pair = |q: &ArmQ| {
                arm.write_to_robot(q, &mut q_robot);
                robot.apply_mimic(&mut q_robot);
                let pose = |chain: &DhChain| {
                    chain.base_from_tcp(&q_robot, &tip_from_tcp).expect("it is a configuration")
                };
                (pose(&meant), pose(&built))
            };
            let joint = robot.joint(table.rows[at].joint).name.clone();
            effects.push((joint, parameter, displacement(arm.joints(), pair, sampling)));
        }
    }
    effects
}

type Entry = fn(&mut DhRow) -> &mut f64;

fn entries(kind: DhRowKind) -> [(Parameter, Entry); 3] {
    let constant: (Parameter, Entry) = match kind {
        DhRowKind::Revolute => (Parameter { name: "d", is_angle: false }, |row| &mut row.d_m),
        DhRowKind::Prismatic => (Parameter { name: "theta", is_angle: true }, |row| &mut row.theta_rad),
    };
    [
        (Parameter { name: "a", is_angle: false }, |row| &mut row.a_m),
        (Parameter { name: "alpha", is_angle: true }, |row| &mut row.alpha_rad),
        constant,
    ]
}

impl Parameter {
    fn error(self) -> f64 {
        if self.is_angle { ANGLE_RAD } else { LENGTH_M }
    }
}

fn effect(
    joint: &str,
    parameter: Parameter,
    found: &Displacement,
    (arm, names, length_factor): (&Arm, &[String], f64),
) -> ParameterEffect {
    let factor = if parameter.is_angle { length_factor } else { 1.0 };
    let at = arm.joints().iter().zip(&found.worst_at);
    let worst_at: Vec<f64> = at.map(|(joint, q)| if joint.turns { *q } else { q * length_factor }).collect();
    ParameterEffect {
        joint: joint.to_owned(),
        parameter: parameter.name,
        error: if parameter.is_angle { "1 deg" } else { "1 mm" },
        worst_mm: found.worst_m * factor * 1e3,
        mean_mm: found.mean_m * factor * 1e3,
        worst_deg: found.worst_rad.to_degrees(),
        worst_at: JointValues::new(names, &worst_at),
    }
}

/// The report as a figure: a bar for each parameter and arm.
///
/// # Errors
/// [`PlotError`] where the drawing library refuses.
pub fn plot(report: &SensitivityReport) -> Result<String, PlotError> {
    let first = report.arms.first().map(|arm| arm.parameters.as_slice()).unwrap_or_default();
    let group = |(at, parameter): (usize, &ParameterEffect)| {
        let name = format!("{} {}, {}", parameter.joint, parameter.parameter, parameter.error);
        let bar = |arm: &ArmSensitivity| Bar {
            worst: arm.parameters[at].worst_mm,
            mean: arm.parameters[at].mean_mm,
        };
        (name, report.arms.iter().map(bar).collect())
    };
    bars(&BarChart {
        title: format!("{}: displacement of the tool by an error of one parameter", report.robot),
        axis: "mm at the tool: worst over the joint range (bar) and mean (white line)".to_owned(),
        series: report.arms.iter().map(|arm| format!("lengths x {}", arm.length_factor)).collect(),
        groups: first.iter().enumerate().map(group).collect(),
    })
}
