//! `congruent convert`: one model of a robot written as another.

use std::fmt::Write;

use congruent::{
    analysis::conversion::{
        Conversion, ConversionReport, ConversionSource, ConversionTarget, DEFAULT_ACCURACY, PoeReport,
        ScrewReport, convert,
    },
    description::{
        Diagnostic, RobotDescription,
        display::{angle, length},
        serde_name,
    },
};

use crate::{
    failure::Failure,
    input::{ChainArguments, RobotArgument, named},
    print::Printer,
    table::{POSE_COLUMNS, Table, pose_cells},
};

/// Writes a robot's model as another one, proved by comparing back.
///
/// Converts the declared table, or the chain of the URDF if no table is declared.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// The model that the robot is converted to.
    #[arg(long, value_parser = named::<ConversionTarget>())]
    to: ConversionTarget,
    /// Which model is converted.
    #[arg(long, value_parser = named::<ConversionSource>())]
    from: Option<ConversionSource>,
    #[command(flatten)]
    chain: ChainArguments,
    #[command(flatten)]
    accuracy: AccuracyArguments,
}

/// How exact a conversion must be.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(crate) struct AccuracyArguments {
    /// Largest error of the result, rad and m; a coarser one takes nearly parallel axes as parallel.
    #[arg(long, default_value_t = DEFAULT_ACCURACY, value_parser = accuracy)]
    pub(crate) accuracy: f64,
    /// Seed of the random configurations of the proof.
    #[arg(long, default_value_t = 0)]
    pub(crate) seed: u64,
}

fn accuracy(text: &str) -> Result<f64, String> {
    const FINEST: f64 = 1e-15;
    const COARSEST: f64 = 1e-2;
    let value: f64 = text.parse().map_err(|error| format!("{error}"))?;
    let is_sound = (FINEST..=COARSEST).contains(&value);
    if is_sound { Ok(value) } else { Err(format!("must be from {FINEST:e} to {COARSEST:e}")) }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let declared = arguments.robot.load(printer)?;
    let table_along = declared.dh.is_some().then(|| chain_of(&declared));
    let description = arguments.chain.choose(declared)?;
    if let (Some(table_along), None, Some(ConversionSource::Dh)) =
        (table_along, &description.dh, arguments.from)
    {
        let message = format!("the [dh] table leads {table_along}, not {}", chain_of(&description));
        return Err(Diagnostic::error("convert::no_dh", message)
            .with_help("leave --base and --tip out, or convert the chain of the URDF there with --from urdf")
            .into());
    }
    let (from, to) = (arguments.from, arguments.to);
    let AccuracyArguments { accuracy, seed } = arguments.accuracy;
    let report = convert(&description, &Conversion { from, to, accuracy, seed })?;
    printer.result(&report, text)?;
    Ok(0)
}

fn chain_of(description: &RobotDescription) -> String {
    let name = |link| &description.robot.link(link).name;
    format!("from \"{}\" to \"{}\"", name(description.base), name(description.tip))
}

/// What can be pasted or saved as it is: everything besides the model itself is a comment.
pub(crate) fn text(report: &ConversionReport) -> String {
    let remarks = remarks(report);
    if let Some(urdf) = &report.urdf {
        // Two hyphens end a comment in XML.
        let remarks = remarks.replace("--", "- -");
        return urdf.replacen('\n', &format!("\n<!--\n{remarks}-->\n"), 1);
    }
    let mut text = String::new();
    for line in remarks.lines() {
        let _ = writeln!(text, "# {line}");
    }
    if let Some(section) = &report.robot_toml {
        text += section;
    }
    if let Some(poe) = &report.poe {
        screws(&mut text, poe);
    }
    text
}

fn remarks(report: &ConversionReport) -> String {
    let mut text = String::new();
    let from = match report.from {
        ConversionSource::Dh => "its [dh] table",
        ConversionSource::Urdf => "its URDF",
    };
    let _ =
        writeln!(text, "{}: base = \"{}\", tip = \"{}\", from {from}", report.robot, report.base, report.tip);
    if let Some(table) = &report.table {
        let _ = writeln!(text, "each row is {}", table.equation);
    }
    let proof = &report.proof;
    let worst_m = proof.screw_m.max(proof.home_m).max(proof.position_m);
    let worst_rad = proof.screw_rad.max(proof.home_rad).max(proof.orientation_rad);
    let _ = writeln!(
        text,
        "proof: screws, home and {} configurations are the same within {} and {}; limit {} and {}",
        proof.configurations,
        length(worst_m),
        angle(worst_rad),
        length(proof.limit),
        angle(proof.limit)
    );
    for note in &report.notes {
        let _ = writeln!(text, "note: {note}");
    }
    for pair in &report.axes {
        let [a, b] = &pair.joints;
        let relation = serde_name(&pair.relation).replace('_', "-");
        let (turn, apart) = (angle(pair.angle_rad), length(pair.distance_m));
        let _ = writeln!(text, "axes of {a} and {b}: {relation}, {turn}, {apart} apart");
    }
    for free in &report.free_choices {
        let _ = writeln!(text, "free choice at {}: {}", free.joint, free.text);
    }
    text
}

fn screws(text: &mut String, poe: &PoeReport) {
    let mut list = |title: &str, screws: &[ScrewReport]| {
        let _ = writeln!(text, "{title}: angular, linear");
        let width = screws.iter().map(|screw| screw.joint.len()).max().unwrap_or(0);
        for ScrewReport { joint, angular: [a, b, c], linear: [x, y, z] } in screws {
            let _ =
                writeln!(text, "  {joint:width$}  {a:13.9} {b:13.9} {c:13.9}   {x:13.9} {y:13.9} {z:13.9}");
        }
    };
    list("space screws", &poe.space_screws);
    list("body screws", &poe.body_screws);
    let [x, y, z] = poe.base_from_tip_at_zero.translation_m;
    let [qw, qx, qy, qz] = poe.base_from_tip_at_zero.quaternion_wxyz;
    let _ = writeln!(text, "tip at zero: translation in m, quaternion w x y z");
    let _ = writeln!(text, "  {x:13.9} {y:13.9} {z:13.9}   {qw:12.9} {qx:12.9} {qy:12.9} {qz:12.9}");
    let mut table = Table::headed(POSE_COLUMNS);
    table.row([String::new()].into_iter().chain(pose_cells(&poe.base_from_tip_at_zero)));
    table.write(text);
}
