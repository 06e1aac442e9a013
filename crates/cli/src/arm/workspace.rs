//! `congruent workspace`: the reachable positions of the tool.

use std::fmt::Write;

use congruent::{
    analysis::workspace::{WorkspaceReport, plot, workspace},
    description::Diagnostic,
    kinematics::Sampling,
};

use crate::{failure::Failure, input::ArmArguments, plot_file::PlotArgument, print::Printer};

/// The positions of the tool within the joint limits: reach, bounding box, volume or area.
///
/// From random configurations; the extremes are refined by local search, the volume is an estimate.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// Number of random configurations.
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
    let sampling = Sampling { samples: arguments.samples as usize, seed: arguments.seed };
    let (report, found) = workspace(&description, sampling)
        .map_err(|error| Diagnostic::error("workspace::robot", error.to_string()))?;
    arguments.plot.write(|| plot(&report, &found))?;
    printer.result(&report, text)?;
    Ok(0)
}

fn text(report: &WorkspaceReport) -> String {
    let mut text = format!("{}\n", report.chain);
    let _ = writeln!(text, "{}: the tool in link base, {} configurations", report.robot, report.samples);
    for (name, reach) in ["nearest", "farthest"].iter().zip(&report.reach) {
        let _ = writeln!(text, "  {name:8} {:9.6} m at {}", reach.distance_m, reach.at.listed(4));
    }
    for (axis, (lower, upper)) in ["x", "y", "z"].iter().zip(report.lower_m.iter().zip(&report.upper_m)) {
        let _ = writeln!(text, "  {axis}  {lower:9.6} to {upper:9.6} m");
    }
    if let Some(volume_m3) = report.volume_m3 {
        let _ = writeln!(text, "  volume about {volume_m3:.4} m3, by cells of {:.4} m", report.cell_m);
    }
    if let Some(area_m2) = report.area_m2 {
        let _ = writeln!(text, "  area about {area_m2:.4} m2, by cells of {:.4} m", report.cell_m);
    }
    text
}
