//! `congruent sensitivity`: displacement of the tool by an error of 1 degree or 1 mm in each parameter.

use std::fmt;

use congruent_description::{
    ArmQ, DhRow, DhRowKind, DhTable, JointValues, ReportedChain, RobotDescription, RobotQ,
};
use congruent_input::{
    Finding,
    display::{counted, length, number},
};
use congruent_kinematics::{
    Arm, ArmJoint, DhChain, Displacement, KinematicsError, Pose, Sampling, displacement,
};
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    arm_joints::joint_names,
    plot::{Bar, BarChart, PlotError, bars},
};

/// The error of an angle: 1 degree.
const ANGLE_RAD: f64 = std::f64::consts::PI / 180.0;
/// The error of a length: 1 mm.
const LENGTH_M: f64 = 1e-3;

/// The answer of `congruent sensitivity`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SensitivityReport {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// Random configurations behind each mean.
    pub samples: usize,
    /// Seed of the random configurations.
    pub seed: u64,
    /// One entry for each length factor.
    pub arms: Vec<ArmSensitivity>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

impl SensitivityReport {
    /// The largest displacement alone, in a line for each factor of the lengths.
    pub fn largest_in_words(&self) -> String {
        let line = |arm: &ArmSensitivity| {
            let worst = arm.parameters.iter().max_by(|a, b| a.worst_mm.total_cmp(&b.worst_mm))?;
            let ParameterEffect { joint, parameter, error, .. } = worst;
            let (factor, displacement) = (number(arm.length_factor), length(worst.worst_mm / 1e3));
            let robot = &self.robot;
            Some(format!(
                "{robot}, lengths x {factor}: at most {displacement} for an error of {error} in {parameter} of {joint}\n"
            ))
        };
        self.arms.iter().filter_map(line).collect()
    }
}

/// The robot, or one like it with all lengths and strokes multiplied.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ArmSensitivity {
    /// Factor of all lengths and strokes; 1 for the robot itself.
    pub length_factor: f64,
    /// The effect of each parameter.
    pub parameters: Vec<ParameterEffect>,
}

/// Effect of an error of one parameter at the tool centre point.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ParameterEffect {
    /// The joint, or the joint of the table's row.
    pub joint: String,
    /// The parameter: the joint's zero, or an entry of its row.
    pub parameter: PerturbedParameter,
    /// The error of the parameter.
    pub error: ParameterError,
    /// Largest displacement over the joint range that was found.
    pub worst_mm: f64,
    /// Mean displacement over the joint range.
    pub mean_mm: f64,
    /// Largest rotation of the tool.
    pub worst_deg: f64,
    /// The configuration of the largest displacement, rad or m.
    pub worst_at: JointValues,
}

/// A parameter of the model that may have an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PerturbedParameter {
    /// The zero of a joint.
    Zero,
    /// Link length `a`.
    A,
    /// Link twist `alpha`.
    Alpha,
    /// Link offset `d`.
    D,
    /// Joint angle `theta`.
    Theta,
}

/// The error of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub enum ParameterError {
    /// 1 degree, of an angle.
    #[serde(rename = "1 deg")]
    OneDegree,
    /// 1 millimetre, of a length.
    #[serde(rename = "1 mm")]
    OneMillimetre,
}

/// One parameter with its error.
#[derive(Debug, Clone, Copy)]
struct Perturbation {
    parameter: PerturbedParameter,
    error: ParameterError,
}

/// The effect of every joint zero, and of the table's other entries if a table is declared.
///
/// An error of an angle displaces the tool in proportion to the arm's lengths and an error of a
/// length does not depend on them, so arms of other lengths need no sampling of their own.
///
/// # Errors
/// [`KinematicsError::NoJoint`] if the robot has no arm, [`KinematicsError::SearchedJoints`] if the arm has too many joints.
pub fn sensitivity(
    description: &RobotDescription,
    length_factors: &[f64],
    sampling: Sampling,
) -> Result<SensitivityReport, KinematicsError> {
    let arm = Arm::from_description(description)?;
    arm.check_search()?;
    let names = joint_names(description, &arm);
    let mut effects = zero_effects(&arm, &names, sampling);
    if let Some(table) = &description.dh {
        effects.extend(table_effects(description, table, &arm, sampling));
    }
    let scaled = |&length_factor: &f64| ArmSensitivity {
        length_factor,
        parameters: effects.iter().map(|found| effect(found, &arm, &names, length_factor)).collect(),
    };
    Ok(SensitivityReport {
        robot: description.name.clone(),
        chain: description.reported_chain(),
        samples: sampling.samples,
        seed: sampling.seed,
        arms: length_factors.iter().map(scaled).collect(),
        warnings: description.warnings.iter().map(Finding::from).collect(),
    })
}

/// The displacement by one perturbation.
struct FoundDisplacement {
    joint: String,
    perturbation: Perturbation,
    displacement: Displacement,
}

fn zero_effects(arm: &Arm, names: &[String], sampling: Sampling) -> Vec<FoundDisplacement> {
    let effect = |(at, (joint, name)): (usize, (&ArmJoint, &String))| {
        let error = if joint.turns { ParameterError::OneDegree } else { ParameterError::OneMillimetre };
        let (mut nominal, mut perturbed) = (arm.clone(), arm.clone());
        let mut shifted = ArmQ::zeros(names.len());
        let pair = |q: &ArmQ| {
            shifted.copy_from_slice(q);
            // A wrong zero: the joint is elsewhere than its coordinate says.
            shifted[at] += error.in_si();
            let pose = |arm: &mut Arm, q: &ArmQ| arm.base_from_tcp(q).expect("q is a configuration");
            (pose(&mut nominal, q), pose(&mut perturbed, &shifted))
        };
        FoundDisplacement {
            joint: name.clone(),
            perturbation: Perturbation { parameter: PerturbedParameter::Zero, error },
            displacement: displacement(arm.joints(), pair, sampling),
        }
    };
    arm.joints().iter().zip(names).enumerate().map(effect).collect()
}

/// Every entry but the one that the joint's coordinate is added to.
fn table_effects(
    description: &RobotDescription,
    table: &DhTable,
    arm: &Arm,
    sampling: Sampling,
) -> Vec<FoundDisplacement> {
    let robot = &description.robot;
    let nominal = DhChain::new(table, robot);
    let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
    let mut q_robot = RobotQ::zeros(robot.dof());
    let mut effects = Vec::new();
    for at in 0..table.rows.len() {
        for (perturbation, entry) in entries(table.rows[at].kind) {
            let mut perturbed = table.clone();
            // One entry of a copy: effects of several errors would not add up at large displacements.
            *entry(&mut perturbed.rows[at]) += perturbation.error.in_si();
            let perturbed = DhChain::new(&perturbed, robot);
            let pair = |q: &ArmQ| {
                arm.write_to_robot(q, &mut q_robot);
                robot.apply_mimic(&mut q_robot);
                let pose = |chain: &DhChain| {
                    chain.base_from_tcp(&q_robot, &tip_from_tcp).expect("it is a configuration")
                };
                (pose(&nominal), pose(&perturbed))
            };
            let joint = robot.joint(table.rows[at].joint).name.clone();
            let displacement = displacement(arm.joints(), pair, sampling);
            effects.push(FoundDisplacement { joint, perturbation, displacement });
        }
    }
    effects
}

/// Access to one entry of a row.
type EntryOfRow = fn(&mut DhRow) -> &mut f64;

fn entries(kind: DhRowKind) -> [(Perturbation, EntryOfRow); 3] {
    let angle = |parameter| Perturbation { parameter, error: ParameterError::OneDegree };
    let length = |parameter| Perturbation { parameter, error: ParameterError::OneMillimetre };
    let constant: (Perturbation, EntryOfRow) = match kind {
        DhRowKind::Revolute => (length(PerturbedParameter::D), |row| &mut row.d_m),
        DhRowKind::Prismatic => (angle(PerturbedParameter::Theta), |row| &mut row.theta_rad),
    };
    [
        (length(PerturbedParameter::A), |row| &mut row.a_m),
        (angle(PerturbedParameter::Alpha), |row| &mut row.alpha_rad),
        constant,
    ]
}

impl ParameterError {
    /// In rad or m.
    fn in_si(self) -> f64 {
        match self {
            Self::OneDegree => ANGLE_RAD,
            Self::OneMillimetre => LENGTH_M,
        }
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(formatter)
    }
}

impl fmt::Display for PerturbedParameter {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(formatter)
    }
}

fn effect(
    FoundDisplacement { joint, perturbation, displacement }: &FoundDisplacement,
    arm: &Arm,
    names: &[String],
    length_factor: f64,
) -> ParameterEffect {
    // The displacement by an error of an angle is proportional to the lengths of the arm.
    let factor = match perturbation.error {
        ParameterError::OneDegree => length_factor,
        ParameterError::OneMillimetre => 1.0,
    };
    let at = arm.joints().iter().zip(&displacement.worst_at);
    let worst_at: Vec<f64> = at.map(|(joint, q)| if joint.turns { *q } else { q * length_factor }).collect();
    ParameterEffect {
        joint: joint.clone(),
        parameter: perturbation.parameter,
        error: perturbation.error,
        worst_mm: displacement.worst_m * factor * 1e3,
        mean_mm: displacement.mean_m * factor * 1e3,
        // Rotations do not depend on the size of the arm, so no factor.
        worst_deg: displacement.worst_rad.to_degrees(),
        worst_at: JointValues::new(names, &worst_at),
    }
}

/// An error of a length displaces the tool by its own size. Kind: rounding of the displacement. Unit: mm.
const SAME_MM: f64 = 1e-6;

/// Whether the effect follows from what the parameter is: an error of 1 mm of a length is 1 mm at the tool, everywhere.
fn is_by_definition(effect: &ParameterEffect) -> bool {
    let is_one = |value: f64| (value - 1.0).abs() <= SAME_MM;
    effect.error == ParameterError::OneMillimetre && is_one(effect.worst_mm) && is_one(effect.mean_mm)
}

/// The report as a figure: one bar for each parameter and arm, the largest effect first.
///
/// # Errors
/// [`PlotError`] if the drawing library refuses.
pub fn plot(report: &SensitivityReport) -> Result<String, PlotError> {
    bars(&chart(&report.robot, &report.arms))
}

fn chart(robot: &str, arms: &[ArmSensitivity]) -> BarChart {
    let first = arms.first().map(|arm| arm.parameters.as_slice()).unwrap_or_default();
    let (left_out, mut drawn): (Vec<_>, Vec<_>) =
        first.iter().enumerate().partition(|(_, effect)| is_by_definition(effect));
    // Stable: equal effects keep the order of the joints.
    drawn.sort_by(|(_, a), (_, b)| b.worst_mm.total_cmp(&a.worst_mm));
    let group = |(at, parameter): (usize, &ParameterEffect)| {
        let name = format!("{} {}, {}", parameter.joint, parameter.parameter, parameter.error);
        let bar = |arm: &ArmSensitivity| Bar {
            worst: arm.parameters[at].worst_mm,
            mean: arm.parameters[at].mean_mm,
        };
        (name, arms.iter().map(bar).collect())
    };
    let note = match left_out.len() {
        0 => String::new(),
        count => format!(
            "Not drawn: {} (a, d, zeros of prismatic joints), of which 1 mm is 1 mm at the tool, everywhere.",
            counted(count, "length")
        ),
    };
    BarChart {
        title: format!("{robot}: displacement of the tool by an error of one parameter"),
        axis: "mm at the tool: worst over the joint range (bar) and mean (white line)".to_owned(),
        series: arms.iter().map(|arm| format!("lengths x {}", arm.length_factor)).collect(),
        groups: drawn.into_iter().map(group).collect(),
        note,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plot_has_the_largest_effect_first_and_nothing_that_is_1_by_definition() {
        let effect = |joint: &str, error: ParameterError, worst_mm: f64| ParameterEffect {
            joint: joint.to_owned(),
            parameter: PerturbedParameter::Zero,
            error,
            worst_mm,
            mean_mm: if error == ParameterError::OneMillimetre { worst_mm } else { worst_mm / 2.0 },
            worst_deg: 1.0,
            worst_at: JointValues::new(&[], &[]),
        };
        let (turn, length) = (ParameterError::OneDegree, ParameterError::OneMillimetre);
        let parameters =
            vec![effect("small", turn, 3.0), effect("length", length, 1.0), effect("large", turn, 17.0)];
        let chart = chart("arm", &[ArmSensitivity { length_factor: 1.0, parameters }]);
        let names: Vec<&str> = chart.groups.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["large zero, 1 deg", "small zero, 1 deg"]);
        assert!(chart.note.starts_with("Not drawn: 1 length"), "{}", chart.note);
    }
}
