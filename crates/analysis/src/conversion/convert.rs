//! One model of a chain written as another, and the proof of it.

use congruent_description::{
    ChainQ, DhConvention, Diagnostic, JointIndex, RobotDescription, RobotQ, dh_section, parse_urdf, urdf_text,
};
use congruent_kinematics::{
    DeriveError, Pose, Proof, ScrewChain, SerialDh, UrdfTree, derive_dh, sample_configurations,
};

use super::{
    converted_model::ConvertedModel,
    options::{Conversion, ConversionTarget},
    report::{ConversionReport, PoeReport, ProofReport, TableReport},
    tree,
};

/// Random configurations of a proof, besides zero, single axes and limits.
const RANDOM_CONFIGURATIONS: usize = 100;

/// Writes the model of a robot's chain from base to tip as another and proves it.
///
/// # Errors
/// The robot has no such model, a joint fits no row, or the proof fails.
pub fn convert(
    description: &RobotDescription,
    conversion: &Conversion,
) -> Result<ConversionReport, Diagnostic> {
    let model = ConvertedModel::new(description, conversion.from)?;
    let mut report = ConversionReport::new(&model, conversion);
    let proof = match conversion.to {
        ConversionTarget::Standard => to_table(&model, DhConvention::Standard, conversion, &mut report)?,
        ConversionTarget::Modified => to_table(&model, DhConvention::Modified, conversion, &mut report)?,
        ConversionTarget::Poe => to_screws(&model, conversion, &mut report),
        ConversionTarget::Urdf => to_urdf(&model, conversion, &mut report)?,
    };
    report.proof = ProofReport::new(&proof, conversion);
    // A residual that is no number proves nothing either.
    if !matches!(proof.worst().partial_cmp(&conversion.accuracy), Some(order) if order.is_le()) {
        return Err(unproved(&report));
    }
    Ok(report)
}

fn prove(
    model: &ConvertedModel<'_>,
    conversion: &Conversion,
    found: &mut dyn FnMut(&ChainQ) -> Pose,
) -> Proof {
    let configurations: Vec<ChainQ> =
        sample_configurations(&model.description.robot, conversion.seed, RANDOM_CONFIGURATIONS)
            .iter()
            .map(|q| q.of_chain(&model.coordinates))
            .collect();
    let mut expected = model.forward();
    Proof::of(model.joints.len(), &configurations, found, &mut expected)
}

fn to_table(
    model: &ConvertedModel<'_>,
    convention: DhConvention,
    conversion: &Conversion,
    report: &mut ConversionReport,
) -> Result<Proof, Diagnostic> {
    let dh = if let Some(declared) = model.declared() {
        SerialDh::from_table(declared).to_convention(convention)
    } else {
        let derivation = derive_dh(&model.screws(), convention, conversion.accuracy)
            .map_err(|error| no_table(&error, model))?;
        report.keep_choices(&derivation, model);
        derivation.dh
    };
    let robot = &model.description.robot;
    let table = dh.to_table(&model.joints);
    report.robot_toml = Some(dh_section(&table, robot));
    report.table = Some(TableReport::new(&table, robot));
    // The proof is of the table as it is written, with constants in quaternions.
    let written = SerialDh::from_table(&table);
    let mut found = |q: &ChainQ| written.base_from_tip(q).expect("one position for each row");
    Ok(prove(model, conversion, &mut found))
}

fn to_screws(model: &ConvertedModel<'_>, conversion: &Conversion, report: &mut ConversionReport) -> Proof {
    let chain = model.screws();
    report.poe = Some(PoeReport::new(&chain, model));
    // By body screws, so that both kinds of screw are proved.
    let by_body = ScrewChain::from_twists_in_tip(&chain.twists_in_tip(), chain.base_from_tip_at_zero);
    let mut found = |q: &ChainQ| by_body.base_from_tip(q).expect("one position for each screw");
    prove(model, conversion, &mut found)
}

fn to_urdf(
    model: &ConvertedModel<'_>,
    conversion: &Conversion,
    report: &mut ConversionReport,
) -> Result<Proof, Diagnostic> {
    let text = urdf_text(&tree::tree(model)?);
    report.notes.push(
        "links have names only, without masses and shapes; at zero every joint frame is parallel to the base"
            .to_owned(),
    );
    // The proof is of the text, parsed again.
    let robot = parse_urdf(&text)
        .map_err(|findings| findings.into_iter().next().expect("a refusal has a finding"))?;
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
    Diagnostic::error("convert::no_table", message).with_help("choose a chain with --base and --tip")
}

fn unproved(report: &ConversionReport) -> Diagnostic {
    let furthest = report.axes.iter().max_by(|a, b| a.normal_at_m.abs().total_cmp(&b.normal_at_m.abs()));
    let why = furthest.map_or(String::new(), |pair| {
        format!(
            ": the axes of \"{}\" and \"{}\" are {:.3e} rad from parallel, so their common normal lies {:.3e} m away",
            pair.joints[0],
            pair.joints[1],
            pair.angle_rad.min(std::f64::consts::PI - pair.angle_rad),
            pair.normal_at_m.abs()
        )
    });
    let message = format!(
        "the result has an error of {:.3e} (limit {:e}){why}",
        report.proof.worst, report.proof.limit
    );
    Diagnostic::error("convert::unproved", message).with_help(
        "a coarser --accuracy, say 1e-9, takes such axes as parallel; the error of this is reported",
    )
}
