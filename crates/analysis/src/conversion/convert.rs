//! One model of a chain written as another, and the proof of it.

use std::path::Path;

use congruent_description::{ChainQ, DhConvention, JointIndex, RobotDescription, RobotQ, parse_urdf};
use congruent_input::{
    Diagnostic, Diagnostics, Findings,
    display::{angle, length},
};
use congruent_kinematics::{
    DeriveError, Pose, Proof, ScrewChain, SerialDh, Twist, UrdfTree, derive_dh, sample_configurations,
    without_rounding,
};
use congruent_writers::{dh_section, lost_armature, own_dh_section, poe_section, urdf_text};

use super::{
    converted_model::ConvertedModel,
    options::{Conversion, ConversionTarget, RoundedAxes},
    remarks,
    report::{ConversionReport, PoeReport, ProofReport, RoundedReport, TableReport},
    tree,
};
use crate::codes;

/// Random configurations of a proof, in addition to zero, single axes and limits.
const RANDOM_CONFIGURATIONS: usize = 100;

/// Writes the model of a robot's chain from base to tip as another and proves it. [`convert_robot`](super::convert_robot) writes
/// whole robots.
///
/// # Errors
/// The robot has no such model, a joint fits no row, the target is an MJCF, or the proof fails.
pub fn convert(
    description: &RobotDescription,
    conversion: &Conversion,
) -> Result<ConversionReport, Diagnostic> {
    let model = ConvertedModel::new(description, conversion.from)?;
    let mut report = ConversionReport::new(&model, conversion);
    let proof = match conversion.to {
        ConversionTarget::Standard => return to_table(&model, DhConvention::Standard, conversion, report),
        ConversionTarget::Modified => return to_table(&model, DhConvention::Modified, conversion, report),
        ConversionTarget::Poe => to_screws(&model, conversion, &mut report),
        ConversionTarget::Urdf => to_urdf(&model, conversion, &mut report)?,
        ConversionTarget::Mjcf => {
            let message = "an MJCF has the whole robot and no chain alone";
            return Err(
                Diagnostic::error(codes::convert::WHOLE, message).with_help("leave --base and --tip out")
            );
        }
    };
    report.proof = ProofReport::new(&proof, conversion);
    within_limit(&proof, &report)?;
    Ok(report)
}

fn within_limit(proof: &Proof, report: &ConversionReport) -> Result<(), Diagnostic> {
    // A comparison with NaN is false, so a residual that is not a number fails the proof as well.
    let is_within = matches!(proof.worst().partial_cmp(&report.proof.limit), Some(order) if order.is_le());
    if is_within { Ok(()) } else { Err(unproved(report, proof)) }
}

fn configurations(model: &ConvertedModel<'_>, conversion: &Conversion) -> Vec<ChainQ> {
    let sampled = sample_configurations(&model.description.robot, conversion.seed, RANDOM_CONFIGURATIONS);
    sampled.iter().map(|q| q.chain_positions(&model.coordinates)).collect()
}

fn prove(
    model: &ConvertedModel<'_>,
    conversion: &Conversion,
    found: &mut dyn FnMut(&ChainQ) -> Pose,
) -> Proof {
    Proof::compare(model.joints.len(), &configurations(model, conversion), found, &mut model.forward())
}

fn to_table(
    model: &ConvertedModel<'_>,
    convention: DhConvention,
    conversion: &Conversion,
    mut report: ConversionReport,
) -> Result<ConversionReport, Diagnostic> {
    let mut corrected = None;
    // A declared table is only written otherwise: a derivation might choose other frames.
    let dh = if let Some(declared) = model.declared() {
        SerialDh::from_table(declared).to_convention(convention)
    } else {
        let chain = without_rounded_axes(model, conversion, &mut report)?;
        let derivation =
            derive_dh(&chain, convention, conversion.accuracy).map_err(|error| no_table(&error, model))?;
        report.keep_choices(&derivation, model);
        corrected = Some(chain).filter(|_| !report.rounded_axes.is_empty());
        derivation.dh
    };
    let robot = &model.description.robot;
    let table = dh.to_table(&model.joints);
    let section = if model.description.own_model().is_some() { own_dh_section } else { dh_section };
    report.robot_toml = Some(section(&table, robot));
    report.table = Some(TableReport::new(&table, robot));
    // The proof is of the table as it is written, with constants in quaternions.
    let written = SerialDh::from_table(&table);
    let mut found = |q: &ChainQ| written.base_from_tip(q).expect("one position for each row");
    let proof = prove(model, conversion, &mut found);
    report.proof = ProofReport::new(&proof, conversion);
    // Against the source the table differs by what was rounded, which the warning below reports. The limit holds
    // against the corrected chain.
    match &corrected {
        None => within_limit(&proof, &report)?,
        Some(chain) => {
            let mut expected = |q: &ChainQ| chain.base_from_tip(q).expect("one position for each screw");
            let of_corrected = configurations(model, conversion);
            within_limit(
                &Proof::compare(model.joints.len(), &of_corrected, &mut found, &mut expected),
                &report,
            )?;
        }
    }
    let warnings =
        [remarks::rounded(&report.rounded_axes, &proof), remarks::far(&report, reach_m(model, conversion))];
    warnings.into_iter().flatten().for_each(|warning| report.warn(warning));
    Ok(report)
}

/// The model's screws; axes that are parallel or intersecting within rounding are made exactly so, unless they are kept.
fn without_rounded_axes(
    model: &ConvertedModel<'_>,
    conversion: &Conversion,
    report: &mut ConversionReport,
) -> Result<ScrewChain, Diagnostic> {
    let screws = model.screws();
    if conversion.rounded_axes == RoundedAxes::Kept {
        return Ok(screws);
    }
    let (chain, pairs) = without_rounding(&screws, &model.origins(), conversion.accuracy)
        .map_err(|error| no_table(&error, model))?;
    let name = |joint: usize| model.joint_name(joint).to_owned();
    let reported = pairs.into_iter().map(|pair| RoundedReport {
        joints: [name(pair.joint), name(pair.joint + 1)],
        relation: pair.relation,
        angle_rad: pair.angle_rad,
        distance_m: pair.distance_m,
    });
    report.rounded_axes = reported.collect();
    Ok(chain)
}

/// The largest distance of the tip from the base at the configurations of the proof.
fn reach_m(model: &ConvertedModel<'_>, conversion: &Conversion) -> f64 {
    let mut forward = model.forward();
    let distances = configurations(model, conversion).into_iter().map(|q| forward(&q).translation.norm());
    distances.fold(0.0, f64::max)
}

fn to_screws(model: &ConvertedModel<'_>, conversion: &Conversion, report: &mut ConversionReport) -> Proof {
    let chain = model.screws();
    report.poe = Some(PoeReport::new(&chain, model));
    report.robot_toml = poe_text(&chain, model);
    // By body screws, so that both kinds of screw are proved.
    let by_body = ScrewChain::from_twists_in_tip(&chain.twists_in_tip(), chain.base_from_tip_at_zero);
    let mut found = |q: &ChainQ| by_body.base_from_tip(q).expect("one position for each screw");
    prove(model, conversion, &mut found)
}

/// The section `[poe]` of a robot file; `None` if nothing moves, or if a joint moves less than its variable says, which no unit
/// screw can say.
fn poe_text(chain: &ScrewChain, model: &ConvertedModel<'_>) -> Option<String> {
    /// How far a direction may be from length 1. Kind: rounding of the identification; worst seen 1e-14.
    const UNIT: f64 = 1e-12;
    let robot = &model.description.robot;
    let is_unit = |(twist, &joint): (&Twist, &JointIndex)| {
        let is_angular = robot.joint(joint).kind.is_angular();
        let direction = if is_angular { twist.angular } else { twist.linear };
        (direction.norm() - 1.0).abs() <= UNIT && (is_angular || twist.angular.norm() <= UNIT)
    };
    if model.joints.is_empty() || !chain.twists_in_base.iter().zip(&model.joints).all(is_unit) {
        return None;
    }
    let twists: Vec<_> = chain.twists_in_base.iter().map(|twist| [twist.angular, twist.linear]).collect();
    Some(poe_section(&model.joints, &twists, &chain.base_from_tip_at_zero.to_isometry(), robot))
}

fn to_urdf(
    model: &ConvertedModel<'_>,
    conversion: &Conversion,
    report: &mut ConversionReport,
) -> Result<Proof, Diagnostic> {
    let text = urdf_text(&tree::tree(model)?, Path::new(""));
    let written = model.joints.iter().map(|&joint| model.description.robot.joint(joint));
    // Several of one kind are one warning.
    let mut lost = Diagnostics::default();
    lost.extend(written.filter_map(lost_armature));
    lost.into_vec().into_iter().for_each(|warning| report.warn(warning));
    report.notes.push(
        "links have names only, without masses and shapes; at zero every joint frame is parallel to the base"
            .to_owned(),
    );
    // The proof is of the text, parsed again.
    let robot = parse_urdf(&text).map_err(Findings::into_first)?;
    let tree = UrdfTree::new(&robot);
    let link =
        |link| robot.find_link(&model.description.robot.link(link).name).expect("written by that name");
    let (base, tip) = (link(model.description.base), link(model.description.tip));
    let coordinate = |&joint: &JointIndex| {
        let name = &model.description.robot.joint(joint).name;
        robot.find_joint(name).and_then(|joint| robot.coordinate(joint)).expect("written by that name")
    };
    let coordinates: Vec<usize> = model.joints.iter().map(coordinate).collect();
    let mut q = RobotQ::zeros(robot.dof());
    let mut found = |values: &ChainQ| {
        q.set_chain(&coordinates, values);
        let root_from = |link| tree.root_from_link(&q, link).expect("the robot's own configuration");
        root_from(base).inverse() * root_from(tip)
    };
    report.urdf = Some(text);
    Ok(prove(model, conversion, &mut found))
}

fn no_table(error: &DeriveError, model: &ConvertedModel<'_>) -> Diagnostic {
    let robot = &model.description.robot;
    let joint = error.joint().map_or(String::new(), |joint| {
        format!(" (joint {joint} is \"{}\")", robot.joint(model.joints[joint]).name)
    });
    let (base, tip) = (&robot.link(model.description.base).name, &robot.link(model.description.tip).name);
    let message = format!("from \"{base}\" to \"{tip}\": {error}{joint}");
    Diagnostic::error(codes::convert::NO_TABLE, message).with_help("choose a chain with --base and --tip")
}

fn unproved(report: &ConversionReport, proof: &Proof) -> Diagnostic {
    // The position of a common normal is relative to the one before: if one is far away, the next is, too. The axes nearest to
    // parallel are the cause.
    let furthest_m = report.axes.iter().map(|pair| pair.normal_at_m.abs()).fold(0.0, f64::max);
    let far = report.axes.iter().filter(|pair| pair.normal_at_m.abs() >= furthest_m / 2.0);
    let cause = far.min_by(|a, b| a.off_parallel_rad().total_cmp(&b.off_parallel_rad()));
    let why = cause.map_or(String::new(), |pair| {
        format!(
            ": the axes of \"{}\" and \"{}\" are {} from parallel, so their common normal lies {} away",
            pair.joints[0],
            pair.joints[1],
            angle(pair.off_parallel_rad()),
            length(pair.normal_at_m.abs())
        )
    });
    let message = format!(
        "the result has an error of {:.1e} rad or m (limit {:e}){why}",
        proof.worst(),
        report.proof.limit
    );
    Diagnostic::error(codes::convert::UNPROVED, message)
        .with_help("a coarser --accuracy, such as 1e-9, treats these axes as parallel, and reports the error")
}
