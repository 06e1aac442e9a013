//! One model of a chain written as another: standard and modified tables, screws, URDF. Every
//! conversion is held against what it came from before it is shown.

mod report;
mod subject;
mod tree;

pub use report::{
    AxisReport, ChoiceReport, ConversionReport, PoeReport, ProofReport, RowReport, ScrewReport, TableReport,
};

use congruent_description::{
    ChainQ, DhConvention, Diagnostic, JointIndex, RobotDescription, RobotQ, dh_section, parse_urdf, urdf_text,
};
use congruent_kinematics::{
    DeriveError, Pose, Proof, ScrewChain, SerialDh, UrdfTree, derive_dh, sample_configurations,
};
use serde::Serialize;

use self::subject::Subject;

/// Random configurations of a proof, besides zero, single axes and limits.
const RANDOM_CONFIGURATIONS: usize = 100;

/// What every conversion is held to unless a coarser one is asked for: rad and m.
pub const DEFAULT_ACCURACY: f64 = 1e-12;

/// What a model is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Target {
    /// A standard table.
    Standard,
    /// A modified table.
    Modified,
    /// Space and body screws with the home pose.
    Poe,
    /// URDF text.
    Urdf,
}

/// Which model of the robot is converted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// The declared table.
    Dh,
    /// The chain of the URDF.
    Urdf,
}

/// How a model is converted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conversion {
    /// Which model is converted; the declared table, where there is one, if nothing is said.
    pub from: Option<Origin>,
    /// What it becomes.
    pub to: Target,
    /// What the result may be off, rad and m.
    pub accuracy: f64,
    /// Seed of the random configurations.
    pub seed: u64,
}

/// Writes the model of a robot's chain from base to tip as another and proves it.
///
/// # Errors
/// Where there is no such model, where a joint fits no row, or where the proof fails.
pub fn convert(
    description: &RobotDescription,
    conversion: &Conversion,
) -> Result<ConversionReport, Diagnostic> {
    let subject = Subject::new(description, conversion.from)?;
    let mut report = ConversionReport::new(&subject, conversion);
    let proof = match conversion.to {
        Target::Standard => to_table(&subject, DhConvention::Standard, conversion, &mut report)?,
        Target::Modified => to_table(&subject, DhConvention::Modified, conversion, &mut report)?,
        Target::Poe => to_screws(&subject, conversion, &mut report),
        Target::Urdf => to_urdf(&subject, conversion, &mut report)?,
    };
    report.proof = ProofReport::new(&proof, conversion);
    // A residual that is no number proves nothing either.
    if !matches!(proof.worst().partial_cmp(&conversion.accuracy), Some(order) if order.is_le()) {
        return Err(unproved(&report));
    }
    Ok(report)
}

fn prove(subject: &Subject<'_>, conversion: &Conversion, found: &mut dyn FnMut(&ChainQ) -> Pose) -> Proof {
    let configurations: Vec<ChainQ> =
        sample_configurations(&subject.description.robot, conversion.seed, RANDOM_CONFIGURATIONS)
            .iter()
            .map(|q| q.of_chain(&subject.coordinates))
            .collect();
    let mut expected = subject.forward();
    Proof::of(subject.joints.len(), &configurations, found, &mut expected)
}

fn to_table(
    subject: &Subject<'_>,
    convention: DhConvention,
    conversion: &Conversion,
    report: &mut ConversionReport,
) -> Result<Proof, Diagnostic> {
    let dh = if let Some(declared) = subject.declared() {
        SerialDh::from_table(declared).to_convention(convention)
    } else {
        let derivation = derive_dh(&subject.screws(), convention, conversion.accuracy)
            .map_err(|error| no_table(&error, subject))?;
        report.keep_choices(&derivation, subject);
        derivation.dh
    };
    let robot = &subject.description.robot;
    let table = dh.to_table(&subject.joints);
    report.robot_toml = Some(dh_section(&table, robot));
    report.table = Some(TableReport::new(&table, robot));
    // What is proved is the table as it is written, constants in quaternions.
    let written = SerialDh::from_table(&table);
    let mut found = |q: &ChainQ| written.base_from_tip(q).expect("one position for each row");
    Ok(prove(subject, conversion, &mut found))
}

fn to_screws(subject: &Subject<'_>, conversion: &Conversion, report: &mut ConversionReport) -> Proof {
    let chain = subject.screws();
    report.poe = Some(PoeReport::new(&chain, subject));
    // By body screws, so that both kinds of screw are proved.
    let by_body = ScrewChain::from_twists_in_tip(&chain.twists_in_tip(), chain.base_from_tip_at_zero);
    let mut found = |q: &ChainQ| by_body.base_from_tip(q).expect("one position for each screw");
    prove(subject, conversion, &mut found)
}

fn to_urdf(
    subject: &Subject<'_>,
    conversion: &Conversion,
    report: &mut ConversionReport,
) -> Result<Proof, Diagnostic> {
    let text = urdf_text(&tree::tree(subject)?);
    report.notes.push(
        "links have names only: masses and shapes are not invented; at zero every joint frame is parallel to the \
         base"
            .to_owned(),
    );
    // What is proved is the text, read again.
    let robot = parse_urdf(&text)
        .map_err(|findings| findings.into_iter().next().expect("a refusal has a finding"))?;
    let tree = UrdfTree::new(&robot);
    let link =
        |link| robot.find_link(&subject.description.robot.link(link).name).expect("written by that name");
    let (base, tip) = (link(subject.description.base), link(subject.description.tip));
    let coordinate = |&joint: &JointIndex| {
        let name = &subject.description.robot.joint(joint).name;
        robot.find_joint(name).and_then(|joint| robot.coordinate(joint)).expect("written by that name")
    };
    let coordinates: Vec<usize> = subject.joints.iter().map(coordinate).collect();
    let mut q = RobotQ::zeros(robot.dof());
    let mut found = |values: &ChainQ| {
        q.set_chain(&coordinates, values);
        let root_from = |link| tree.root_from_link(&q, link).expect("the robot's own configuration");
        root_from(base).inverse() * root_from(tip)
    };
    report.urdf = Some(text);
    Ok(prove(subject, conversion, &mut found))
}

fn no_table(error: &DeriveError, subject: &Subject<'_>) -> Diagnostic {
    let robot = &subject.description.robot;
    let joint = error.joint().map_or(String::new(), |joint| {
        format!(" (joint {joint} is \"{}\")", robot.joint(subject.joints[joint]).name)
    });
    let (base, tip) = (&robot.link(subject.description.base).name, &robot.link(subject.description.tip).name);
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
    let message =
        format!("the result is off by {:.3e}, {:e} is allowed{why}", report.proof.worst, report.proof.limit);
    Diagnostic::error("convert::unproved", message).with_help(
        "a coarser --accuracy, say 1e-9, takes such axes as parallel; the residual that this costs is reported",
    )
}
