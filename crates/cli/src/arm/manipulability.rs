//! `congruent manipulability`: how well the tool moves in each direction.

use std::fmt::Write;

use congruent::{
    analysis::manipulability::{
        ManipulabilityReport, ReportedDexterity, ReportedEllipsoid, manipulability, plot,
    },
    description::Diagnostic,
};

use crate::{
    failure::Failure,
    input::{ArmArguments, ConfigurationArguments},
    plot_file::PlotArgument,
    print::Printer,
};

/// Velocity ellipsoids of the tool, Yoshikawa's measure, condition and distance to singularity.
///
/// Linear and angular parts are separate since their units differ. A plot shows the first
/// configuration.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    #[command(flatten)]
    configurations: ConfigurationArguments,
    #[command(flatten)]
    plot: PlotArgument,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.arm.load(printer)?;
    let configurations = arguments.configurations.read(&mut description, printer)?;
    let report = manipulability(&description, &configurations)
        .map_err(|error| Diagnostic::error("manipulability::robot", error.to_string()))?;
    if let (Some(q), Some(result)) = (configurations.first(), report.results.first()) {
        arguments.plot.write(|| plot(&description, q, result))?;
    }
    printer.result(&report, text)?;
    Ok(0)
}

fn text(report: &ManipulabilityReport) -> String {
    let mut text = format!("{}\n", report.chain);
    for (index, result) in report.results.iter().enumerate() {
        let [x, y, z] = result.tcp_in_base_m;
        let _ = writeln!(text, "configuration {}: tool at {x:.6}, {y:.6}, {z:.6} m in the base", index + 1);
        ellipsoid(&mut text, "linear", &result.linear, "m");
        ellipsoid(&mut text, "angular", &result.angular, "rad");
        let _ =
            writeln!(text, "  whole, 1 rad = {:.4} m: {}", report.metres_per_rad, measures(&result.whole));
    }
    text
}

fn ellipsoid(text: &mut String, name: &str, ellipsoid: &ReportedEllipsoid, unit: &str) {
    let _ = writeln!(text, "  {name}: {}", measures(&ellipsoid.dexterity));
    for (length, [x, y, z]) in ellipsoid.semi_axes.iter().zip(&ellipsoid.axes) {
        let _ = writeln!(
            text,
            "    {length:9.6} {unit} per unit joint velocity along ({x:9.6}, {y:9.6}, {z:9.6})"
        );
    }
}

fn measures(found: &ReportedDexterity) -> String {
    let condition = found.condition.map_or("infinite".to_owned(), |condition| format!("{condition:.3}"));
    format!(
        "Yoshikawa {:.6}, condition {condition}, distance to singularity {:.6}, over {} directions",
        found.yoshikawa, found.distance_to_singularity, found.directions
    )
}
