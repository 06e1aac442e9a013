//! `congruent convert`: one model of a robot written as another.

use std::fmt::Write;

use clap::ValueEnum;
use congruent::{
    analysis::conversion::{
        Conversion, ConversionReport, DEFAULT_ACCURACY, Origin, PoeReport, ScrewReport, Target, convert,
    },
    description::{Diagnostic, RobotDescription},
};

use crate::{
    failure::Failure,
    input::{ChainArguments, RobotArgument},
    print::Printer,
};

/// Writes a robot's model as another one, proved by comparing back.
///
/// Converts the declared table, or the chain of the URDF where no table is declared.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// What the model becomes.
    #[arg(long, value_enum)]
    to: TargetArgument,
    /// Which model is converted.
    #[arg(long, value_enum)]
    from: Option<OriginArgument>,
    #[command(flatten)]
    chain: ChainArguments,
    #[command(flatten)]
    accuracy: AccuracyArguments,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum TargetArgument {
    /// A table with rows Rz(theta) Tz(d) Tx(a) Rx(alpha).
    Standard,
    /// A table with rows Rx(alpha) Tx(a) Rz(theta) Tz(d) (Craig).
    Modified,
    /// Space and body screws with the home pose.
    Poe,
    /// A URDF of joints and named links.
    Urdf,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum OriginArgument {
    /// The table of robot.toml.
    Dh,
    /// The chain of the URDF.
    Urdf,
}

/// How exact a conversion must be.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(crate) struct AccuracyArguments {
    /// What the result may be off, rad and m; coarser figures take nearly parallel axes as parallel.
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
    if let (Some(table_along), None, Some(OriginArgument::Dh)) =
        (table_along, &description.dh, arguments.from)
    {
        let message = format!("the [dh] table leads {table_along}, not {}", chain_of(&description));
        return Err(Diagnostic::error("convert::no_dh", message)
            .with_help("leave --base and --tip out, or convert the chain of the URDF there with --from urdf")
            .into());
    }
    let to = match arguments.to {
        TargetArgument::Standard => Target::Standard,
        TargetArgument::Modified => Target::Modified,
        TargetArgument::Poe => Target::Poe,
        TargetArgument::Urdf => Target::Urdf,
    };
    let from = arguments.from.map(|from| match from {
        OriginArgument::Dh => Origin::Dh,
        OriginArgument::Urdf => Origin::Urdf,
    });
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
    let said = remarks(report);
    if let Some(urdf) = &report.urdf {
        // Two hyphens end a comment in XML.
        let said = said.replace("--", "- -");
        return urdf.replacen('\n', &format!("\n<!--\n{said}-->\n"), 1);
    }
    let mut text = String::new();
    for line in said.lines() {
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
        Origin::Dh => "its [dh] table",
        Origin::Urdf => "its URDF",
    };
    let _ =
        writeln!(text, "{}: base = \"{}\", tip = \"{}\", from {from}", report.robot, report.base, report.tip);
    if let Some(table) = &report.table {
        let _ = writeln!(text, "a row is {}", table.equation);
    }
    let proof = &report.proof;
    let _ = writeln!(
        text,
        "proof: screws within {:.1e} rad and {:.1e} m, home {:.1e} rad and {:.1e} m, {} configurations {:.1e} rad and \
         {:.1e} m; {:e} is allowed",
        proof.screw_rad,
        proof.screw_m,
        proof.home_rad,
        proof.home_m,
        proof.configurations,
        proof.orientation_rad,
        proof.position_m,
        proof.limit
    );
    for note in &report.notes {
        let _ = writeln!(text, "note: {note}");
    }
    for pair in &report.axes {
        let [a, b] = &pair.joints;
        let (degrees, relation) = (pair.angle_rad.to_degrees(), pair.relation.replace('_', "-"));
        let _ = writeln!(
            text,
            "axes of {a} and {b}: {relation}, {degrees:.6} deg, {:.6} m apart",
            pair.distance_m
        );
    }
    for free in &report.free_choices {
        let _ = writeln!(text, "free at {}: {}", free.joint, free.text);
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
}
