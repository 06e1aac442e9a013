//! The answer of `congruent convert`.

use congruent_description::{DhConvention, DhRow, DhRowKind, DhTable, ReportedChain, Robot};
use congruent_input::{Diagnostic, Finding};
use congruent_kinematics::{
    AxisRelation, Choice, DhDerivation, Pose, Proof, ReportedPose, ScrewChain, Twist,
};
use congruent_writers::ReadBackReport;
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    converted_model::ConvertedModel,
    options::{Conversion, ConversionSource, ConversionTarget},
};

/// A converted model with its proof.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ConversionReport {
    /// Name of the robot.
    pub robot: String,
    /// Which model was converted.
    pub from: ConversionSource,
    /// The model that it was converted to.
    pub to: ConversionTarget,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// The link that the model starts from.
    pub base: String,
    /// The link that it ends at.
    pub tip: String,
    /// The joints, base to tip.
    pub joints: Vec<String>,
    /// The table, if the target is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<TableReport>,
    /// The section `[dh]` of a robot file, or `[poe]` if the target are screws.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub robot_toml: Option<String>,
    /// Screws and home pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poe: Option<PoeReport>,
    /// Text of the URDF, if the target is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub urdf: Option<String>,
    /// Text of the MJCF, if the target is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mjcf: Option<String>,
    /// What reading the text again has found, if the whole robot was written; `proof` then is of all its links.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub read_back: Option<ReadBackReport>,
    /// Relations of consecutive axes, if a table was derived from them.
    pub axes: Vec<AxisReport>,
    /// Pairs of axes that were made parallel, intersecting or collinear, which they are in the source within rounding.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rounded_axes: Vec<RoundedReport>,
    /// The free choices of the derivation, with the choice that was made.
    pub free_choices: Vec<ChoiceReport>,
    /// Further notes for the reader.
    pub notes: Vec<String>,
    /// Errors of the result relative to its source. If axes were made parallel or intersecting, they contain the effect of this,
    /// and the limit holds relative to the source with such axes.
    pub proof: ProofReport,
    /// Warnings about the input and the result.
    pub warnings: Vec<Finding>,
    /// The warnings about the result, as diagnostics.
    #[serde(skip)]
    pub findings: Vec<Diagnostic>,
}

/// A table as programs read it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TableReport {
    /// The convention of the rows.
    pub convention: DhConvention,
    /// The equation of a row.
    pub equation: &'static str,
    /// Pose of the table's frame 0 in link `base`.
    pub base_from_dh0: ReportedPose,
    /// The rows, base to tip.
    pub rows: Vec<RowReport>,
    /// Pose of link `tip` in the table's last frame.
    pub dhn_from_tip: ReportedPose,
}

/// One row of a table, with SI values.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RowReport {
    /// The joint that drives it.
    pub joint: String,
    /// Which entry the joint drives.
    pub kind: DhRowKind,
    /// Link length `a`, m.
    pub a_m: f64,
    /// Link twist `alpha`, rad.
    pub alpha_rad: f64,
    /// Link offset `d`, m.
    pub d_m: f64,
    /// Joint angle `theta`, rad.
    pub theta_rad: f64,
    /// Sign of the joint's position in the row, 1 or -1.
    pub sign: f64,
}

/// Screws and home pose.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PoeReport {
    /// Twists at zero in link `base`, of `exp([S_1] q_1) ... exp([S_n] q_n) M`.
    pub space_screws: Vec<ScrewReport>,
    /// Twists at zero in link `tip`, of `M exp([B_1] q_1) ... exp([B_n] q_n)`.
    pub body_screws: Vec<ScrewReport>,
    /// Home pose `M`: tip in the base, joints at zero.
    pub base_from_tip_at_zero: ReportedPose,
}

/// The screw of one joint, joints at zero.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ScrewReport {
    /// Name of the joint.
    pub joint: String,
    /// Rotation per unit of the joint.
    pub angular: [f64; 3],
    /// Translation of the point at the origin per unit of the joint.
    pub linear: [f64; 3],
}

/// Relation of two consecutive axes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AxisReport {
    /// The two joints, the one nearer to the base first.
    pub joints: [String; 2],
    /// Parallel, intersecting, collinear or skew.
    pub relation: AxisRelation,
    /// Angle between the axes.
    pub angle_rad: f64,
    /// Length of the common normal.
    pub distance_m: f64,
    /// How far along the first axis the normal lies from the one before.
    pub normal_at_m: f64,
}

impl AxisReport {
    /// The angle between the axes as lines.
    pub(super) fn off_parallel_rad(&self) -> f64 {
        self.angle_rad.min(std::f64::consts::PI - self.angle_rad)
    }
}

/// Two consecutive axes that were made parallel, intersecting or collinear.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RoundedReport {
    /// The two joints, the one nearer to the base first.
    pub joints: [String; 2],
    /// The relation that their axes were given.
    pub relation: AxisRelation,
    /// Angle by which the source differs from this relation.
    pub angle_rad: f64,
    /// Distance by which the source differs from this relation.
    pub distance_m: f64,
}

/// A choice that the axes do not determine.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ChoiceReport {
    /// The joint whose row it affects.
    pub joint: String,
    /// The kind of choice.
    pub choice: Choice,
    /// The choice in words, with the value that was chosen.
    pub text: String,
}

/// Errors of a conversion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ProofReport {
    /// The limit, rad and m.
    pub limit: f64,
    /// The largest of the errors below.
    pub worst: f64,
    /// Error of the directions of the screws, rad per unit of the joint.
    pub screw_rad: f64,
    /// Error of the moments of the screws, m per unit of the joint.
    pub screw_m: f64,
    /// Error of the home orientation.
    pub home_rad: f64,
    /// Error of the home position.
    pub home_m: f64,
    /// Largest error of the orientation at the configurations.
    pub orientation_rad: f64,
    /// Largest error of the position at the configurations.
    pub position_m: f64,
    /// Number of configurations: zero, single axes, random ones, limits.
    pub configurations: usize,
    /// Seed of the random ones.
    pub seed: u64,
}

impl ConversionReport {
    /// The report before anything is converted.
    pub(super) fn new(model: &ConvertedModel<'_>, conversion: &Conversion) -> Self {
        let description = model.description;
        let robot = &description.robot;
        Self {
            robot: description.name.clone(),
            from: model.source,
            to: conversion.to,
            chain: description.reported_chain(),
            base: robot.link(description.base).name.clone(),
            tip: robot.link(description.tip).name.clone(),
            joints: (0..model.joints.len()).map(|joint| model.joint_name(joint).to_owned()).collect(),
            table: None,
            robot_toml: None,
            poe: None,
            urdf: None,
            mjcf: None,
            read_back: None,
            axes: Vec::new(),
            rounded_axes: Vec::new(),
            free_choices: Vec::new(),
            notes: notes(model),
            proof: ProofReport::new(&Proof::default(), conversion),
            warnings: description.warnings.iter().map(Finding::from).collect(),
            findings: Vec::new(),
        }
    }

    /// Adds a warning about the result.
    pub(super) fn warn(&mut self, warning: Diagnostic) {
        self.warnings.push((&warning).into());
        self.findings.push(warning);
    }

    pub(super) fn keep_choices(&mut self, derivation: &DhDerivation, model: &ConvertedModel<'_>) {
        let name = |joint: usize| model.joint_name(joint).to_owned();
        let axes = derivation.pairs.iter().map(|pair| AxisReport {
            joints: [name(pair.joint), name(pair.joint + 1)],
            relation: pair.relation,
            angle_rad: pair.angle_rad,
            distance_m: pair.distance_m,
            normal_at_m: pair.normal_at_m,
        });
        self.axes = axes.collect();
        let choices = derivation.choices.iter().map(|free| ChoiceReport {
            joint: name(free.joint),
            choice: free.choice,
            text: free.choice.to_string(),
        });
        self.free_choices = choices.collect();
        self.notes
            .push("z axes point in the positive direction of the joints, so every sign is 1".to_owned());
    }
}

fn notes(model: &ConvertedModel<'_>) -> Vec<String> {
    let robot = &model.description.robot;
    let mimic = model.joints.iter().filter_map(|&joint| {
        let mimic = robot.joint(joint).mimic?;
        Some(format!(
            "joint \"{}\" is an independent variable here; as a mimic joint it follows \"{}\": {} times its position, \
             plus {}",
            robot.joint(joint).name,
            robot.joint(mimic.master).name,
            mimic.multiplier,
            mimic.offset
        ))
    });
    let tool = model
        .description
        .tip_from_tcp
        .map(|_| "the tool of [tcp] is not part of the chain: it remains as declared".to_owned());
    mimic.chain(tool).collect()
}

impl TableReport {
    pub(super) fn new(table: &DhTable, robot: &Robot) -> Self {
        let row = |row: &DhRow| RowReport {
            joint: robot.joint(row.joint).name.clone(),
            kind: row.kind,
            a_m: row.a_m,
            alpha_rad: row.alpha_rad,
            d_m: row.d_m,
            theta_rad: row.theta_rad,
            sign: row.sign,
        };
        Self {
            convention: table.convention,
            equation: table.convention.equation(),
            base_from_dh0: (&Pose::from(table.base_from_dh0)).into(),
            rows: table.rows.iter().map(row).collect(),
            dhn_from_tip: (&Pose::from(table.dhn_from_tip)).into(),
        }
    }
}

impl PoeReport {
    pub(super) fn new(chain: &ScrewChain, model: &ConvertedModel<'_>) -> Self {
        let screws = |twists: &[Twist]| {
            let named = twists.iter().enumerate();
            named
                .map(|(joint, twist)| ScrewReport {
                    joint: model.joint_name(joint).to_owned(),
                    angular: twist.angular.into(),
                    linear: twist.linear.into(),
                })
                .collect()
        };
        Self {
            space_screws: screws(&chain.twists_in_base),
            body_screws: screws(&chain.twists_in_tip()),
            base_from_tip_at_zero: (&chain.base_from_tip_at_zero).into(),
        }
    }
}

impl ProofReport {
    pub(super) fn new(proof: &Proof, conversion: &Conversion) -> Self {
        Self {
            limit: conversion.accuracy,
            worst: proof.worst(),
            screw_rad: proof.screw_rad,
            screw_m: proof.screw_m,
            home_rad: proof.home_rad,
            home_m: proof.home_m,
            orientation_rad: proof.orientation_rad,
            position_m: proof.position_m,
            configurations: proof.configurations,
            seed: conversion.seed,
        }
    }
}
