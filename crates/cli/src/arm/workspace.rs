//! `congruent workspace`: the reachable positions of the tool.

use std::fmt::Write;

use congruent::{
    analysis::workspace::{WorkspaceReport, plot, workspace},
    description::Robot,
    input::{
        Diagnostic,
        display::{in_column, position, quantity},
    },
    kinematics::Sampling,
};

use crate::{
    failure::Failure,
    input::{ArmArguments, files_of},
    output::plot::PlotArgument,
    terminal::{
        columns,
        layout::{Table, wrapped},
        print::Printer,
        progress::waiting,
    },
};

/// The positions of the tool within the joint limits: reach, bounding box, volume or area.
///
/// From random configurations; the extremes are refined by local search. The size is the share of random
/// points of the bounding box that inverse kinematics reaches, with an interval of three standard errors.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// Number of random configurations; 20,000 or one in 20 points are tested for the size.
    #[arg(long, default_value_t = 400_000, value_parser = clap::value_parser!(u32).range(1..=50_000_000))]
    samples: u32,
    /// Seed of the random configurations.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    plot: PlotArgument,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let description = arguments.arm.load(printer)?;
    let inputs = files_of(&description);
    arguments.plot.is_none_of(&inputs)?;
    let sampling = Sampling { samples: arguments.samples as usize, seed: arguments.seed };
    let (report, found) = waiting(printer, "computing the workspace", || workspace(&description, sampling))
        .map_err(|error| Diagnostic::error("workspace::robot", error.to_string()))?;
    printer.result(&report, |report| text(report, &description.robot))?;
    arguments.plot.write(|| plot(&report, &found), &inputs)?;
    Ok(0)
}

/// An interval wider than this share of the estimate is worth a remark.
const WIDE: f64 = 0.1;

fn text(report: &WorkspaceReport, robot: &Robot) -> String {
    let mut text = format!("{}\n", report.chain);
    let _ = writeln!(
        text,
        "{}: the tool in link {}, {} configurations",
        report.robot, report.chain.base, report.samples
    );
    for (name, reach) in ["nearest", "farthest"].iter().zip(&report.reach) {
        let distance = position(reach.distance_m, "m");
        let _ = writeln!(text, "  {name} {distance} from the base's origin, at");
        text += &wrapped(&reach.at.for_people(robot));
    }
    let mut table = Table::headed(["", "lower mm", "upper mm"]);
    for (at, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let ends = [report.lower_m[at], report.upper_m[at]].map(|end| in_column(end, "m"));
        table.row([axis.to_owned()].into_iter().chain(ends));
    }
    table.write(&mut text, columns());
    size(&mut text, report);
    text
}

fn size(text: &mut String, report: &WorkspaceReport) {
    let (name, size, unit) = match (report.volume_m3, report.area_m2) {
        (Some(volume_m3), _) => ("volume", volume_m3, "m3"),
        (_, Some(area_m2)) => ("area", area_m2, "m2"),
        _ => return,
    };
    let [lower, upper] = report.between.unwrap_or([size; 2]);
    if report.points == 0 {
        let what = if name == "volume" { "surface" } else { "curve" };
        let _ = writeln!(text, "  {name} 0: the tool stays on a {what}");
        return;
    }
    let _ = writeln!(
        text,
        "  {name} {}, between {} and {} (three standard errors, {} points tested)",
        quantity(size, unit),
        quantity(lower - third_digit(lower) / 2.0, unit),
        quantity(upper + third_digit(upper) / 2.0, unit),
        report.points
    );
    if upper - lower > WIDE * size {
        let _ = writeln!(text, "  the interval is wide: more --samples narrow it");
    }
}

/// One unit of the third digit, of which half makes rounding go outwards.
fn third_digit(value: f64) -> f64 {
    if value > 0.0 { libm::pow(10_f64, libm::log10(value).floor() - 2.0) } else { 0.0 }
}
