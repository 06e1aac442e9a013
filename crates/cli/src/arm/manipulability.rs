//! `congruent manipulability`: how well the tool moves in each direction.

use std::{fmt::Write, iter::once};

use congruent::{
    analysis::manipulability::{
        ConfigurationDexterity, DexterityStream, ManipulabilityReport, ReportedDexterity, ReportedEllipsoid,
        manipulability, plot,
    },
    description::Robot,
    input::display::{in_column, length, number, quantity},
};

use super::length::positive_length;
use crate::{
    failure::Failure,
    input::{ArmArguments, ConfigurationArguments, files_of},
    output::plot::PlotArgument,
    terminal::{columns, layout::Table, print::Printer},
};

/// Velocity ellipsoids of the tool, Yoshikawa's measure, condition and distance to singularity.
///
/// Linear and angular parts are separate since their units differ. If some joints turn and others slide, a
/// length counts as one radian of joint motion, so that no measure depends on the unit of length. A plot shows
/// the first configuration.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    #[command(flatten)]
    configurations: ConfigurationArguments,
    /// The length that counts as one radian, of the tool and of sliding joints; by default the typical distance
    /// of the tool from the turning axes.
    #[arg(long, value_name = "LENGTH", value_parser = positive_length)]
    length: Option<f64>,
    #[command(flatten)]
    plot: PlotArgument,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.arm.load(printer)?;
    let configurations = arguments.configurations.read(&mut description, printer)?;
    let inputs = files_of(&description);
    arguments.plot.is_none_of(&inputs)?;
    let report = manipulability(&description, configurations.iter(), arguments.length)?;
    let printed = printer.parts(&report, |report| parts(report, &description.robot));
    report.results.end()?;
    printed?;
    if let Some(q) = configurations.get(0) {
        let first = manipulability(&description, configurations.iter().take(1), arguments.length)?;
        if let Some(result) = first.results.iter().next() {
            arguments.plot.write(|| plot(&description, &q, &result), &inputs)?;
        }
    }
    Ok(0)
}

type Report<'a> = ManipulabilityReport<DexterityStream<'a>>;

/// The heading, and each configuration.
fn parts<'a>(report: &'a Report<'_>, robot: &Robot) -> impl Iterator<Item = String> + 'a {
    let mut text = format!("{}\n", report.chain);
    let radian = length(report.metres_per_rad);
    let turns =
        |joint: &String| robot.find_joint(joint).is_some_and(|joint| robot.joint(joint).kind.is_angular());
    let per = if report.joints.iter().any(turns) { "rad" } else { "m" };
    if !report.sliding.is_empty() {
        let _ = writeln!(text, "{radian} of {} count as one radian", report.sliding.join(", "));
    }
    let configuration = move |(at, result): (usize, ConfigurationDexterity)| {
        let [x, y, z] = result.tcp_in_base_m.map(|value| in_column(value, "m"));
        let mut text = format!("configuration {at}: tool at {x}, {y}, {z} mm in the base\n");
        ellipsoid(&mut text, ("linear", "m"), &result.linear, per);
        ellipsoid(&mut text, ("angular", "rad"), &result.angular, per);
        let _ = writeln!(text, "  both, {radian} as one radian: {}", measures(&result.whole, number));
        text
    };
    once(text).chain((1..).zip(report.results.iter()).map(configuration))
}

fn ellipsoid(text: &mut String, (name, unit): (&str, &str), ellipsoid: &ReportedEllipsoid, per: &str) {
    let size = |value: f64| {
        let value = if unit == per { format!("{} {unit}", number(value)) } else { quantity(value, unit) };
        format!("{value} per {per}")
    };
    let _ = writeln!(text, "  {name}: {}", measures(&ellipsoid.dexterity, size));
    let mut table = Table::default();
    for (semi_axis, axis) in ellipsoid.semi_axes.iter().zip(&ellipsoid.axes) {
        let along = axis.map(|value| in_column(value, ""));
        table.row([String::new(), size(*semi_axis), "along".to_owned()].into_iter().chain(along));
    }
    table.write(text, columns());
}

fn measures(found: &ReportedDexterity, size: impl Fn(f64) -> String) -> String {
    let from_singular = found.condition.map_or("singular".to_owned(), |condition| {
        format!("condition {}, {} from singular", number(condition), size(found.distance_to_singularity))
    });
    let directions = match found.directions {
        0 => return "none".to_owned(),
        1 => "1 direction".to_owned(),
        several => format!("{several} directions"),
    };
    format!("{from_singular}, Yoshikawa {}, over {directions}", number(found.yoshikawa))
}
