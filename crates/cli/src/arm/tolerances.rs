//! `congruent tolerances`: from tolerances of each parameter to the error at the tool.

use std::path::PathBuf;

use congruent::{
    description::{
        DeclaredTolerances, ErrorDistribution, FrameTolerances, ParameterTolerances, RobotDescription,
    },
    input::read_text,
    text::{tolerances_line, tolerances_text},
    tolerances::{
        StudyOptions, ToleranceSource, ToleranceVerdict, ToleratedChain, calibrated, declared, no_tolerances,
        plot, tolerance_study, written_digits,
    },
};

use crate::{
    configurations::ConfigurationArguments,
    failure::Failure,
    input::{SetArmArguments, files_of, seed},
    output::plot::PlotArgument,
    quantity::{angle_with_unit, length_with_unit},
    terminal::{
        print::{Printer, text_options},
        progress::waiting,
    },
    tolerance::ToleranceArgument,
};

/// From the tolerance of each parameter to the error at the tool: distribution, certified worst case, and which to tighten.
///
/// The tolerances are those of [tolerances] in robot.toml, or of the options, of a calibration, or of the digits
/// that the file is written with. The errors of all parameters are drawn together; over the joint range and at its
/// worst configuration, or at given configurations.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: SetArmArguments,
    #[command(flatten)]
    given: GivenTolerances,
    /// The covariance of a calibration instead: what `calibrate --format json` has printed.
    #[arg(long, value_name = "FILE", conflicts_with = "GivenTolerances")]
    calibration: Option<PathBuf>,
    /// Half of the last place of each value that is written instead.
    #[arg(long, conflicts_with_all = ["GivenTolerances", "calibration"])]
    digits: bool,
    #[command(flatten)]
    configurations: ConfigurationArguments,
    /// Number of random configurations, if none are given.
    #[arg(long, default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..=20_000))]
    random: u32,
    /// Number of draws of all errors, over all configurations and at the worst ones.
    #[arg(long, default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(1_000..=20_000_000))]
    samples: u32,
    /// Seed of the draws and of the random configurations.
    #[arg(long, default_value_t = 0, value_parser = seed)]
    seed: u64,
    /// The error that is allowed: exit code 1 if the 99.7 % quantile exceeds it, over the joint range or where it is worst.
    #[arg(long, value_name = "LENGTH,ANGLE")]
    tolerance: Option<ToleranceArgument>,
    // The error over the plane of height and distance from the base's axis.
    #[command(flatten)]
    plot: PlotArgument,
}

/// Largest report of a calibration: some hundred bytes for each measured row.
const CALIBRATION_BYTES: u64 = 64 << 20;

/// Tolerances on the command line: half widths.
#[derive(Debug, clap::Args)]
#[group(multiple = true)]
struct GivenTolerances {
    /// Tolerance of each link length a of the table: 0.05mm.
    #[arg(long, value_name = "LENGTH", value_parser = length_with_unit, allow_hyphen_values = true)]
    a: Option<f64>,
    /// Tolerance of each link offset d.
    #[arg(long, value_name = "LENGTH", value_parser = length_with_unit, allow_hyphen_values = true)]
    d: Option<f64>,
    /// Tolerance of each link twist alpha: 0.02deg.
    #[arg(long, value_name = "ANGLE", value_parser = angle_with_unit, allow_hyphen_values = true)]
    alpha: Option<f64>,
    /// Tolerance of each theta.
    #[arg(long, value_name = "ANGLE", value_parser = angle_with_unit, allow_hyphen_values = true)]
    theta: Option<f64>,
    /// Tolerance of the zero of each joint, encoder and backlash: 0.01deg; 0.02mm of joints that slide.
    #[arg(long, value_name = "LENGTH,ANGLE", allow_hyphen_values = true)]
    zero: Option<ToleranceArgument>,
    /// Tolerance of each coordinate of a joint's origin, of a robot without a table.
    #[arg(long, value_name = "LENGTH", value_parser = length_with_unit, allow_hyphen_values = true)]
    xyz: Option<f64>,
    /// Tolerance of each of three turns about the axes of a joint's frame, of a robot without a table.
    #[arg(long, value_name = "ANGLE", value_parser = angle_with_unit, allow_hyphen_values = true)]
    rpy: Option<f64>,
    /// Tolerance of the base: of each coordinate, and of each turn about its axes.
    #[arg(long, value_name = "LENGTH,ANGLE", allow_hyphen_values = true)]
    base_pose: Option<ToleranceArgument>,
    /// Tolerance of the tool centre point in the last link, likewise.
    #[arg(long, value_name = "LENGTH,ANGLE", allow_hyphen_values = true)]
    tcp: Option<ToleranceArgument>,
    /// The errors are normal, and a tolerance is this number of standard deviations; without it they are uniform, or as
    /// [tolerances] says.
    #[arg(long, value_name = "SIGMAS", value_parser = sigmas)]
    normal: Option<f64>,
}

fn sigmas(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value: &f64| (0.1..=10.0).contains(value));
    value.ok_or_else(|| "a number of standard deviations from 0.1 to 10: --normal 3".to_owned())
}

impl GivenTolerances {
    fn distribution(&self) -> Option<ErrorDistribution> {
        self.normal.map(|sigmas| ErrorDistribution::Normal { sigmas })
    }

    /// None if no tolerance is given.
    fn declared(&self) -> Option<DeclaredTolerances> {
        let parts = |of: Option<ToleranceArgument>| of.map_or((None, None), ToleranceArgument::parts);
        let frame = |of| {
            let (position_m, orientation_rad) = parts(of);
            FrameTolerances { position_m, orientation_rad }
        };
        let (zero_m, zero_rad) = parts(self.zero);
        let Self { a: a_m, d: d_m, alpha: alpha_rad, theta: theta_rad, xyz: xyz_m, rpy: rpy_rad, .. } = *self;
        let general =
            ParameterTolerances { a_m, d_m, alpha_rad, theta_rad, zero_rad, zero_m, xyz_m, rpy_rad };
        let distribution = self.distribution().unwrap_or_default();
        let (base, tcp) = (frame(self.base_pose), frame(self.tcp));
        let found = DeclaredTolerances { general, rows: Vec::new(), base, tcp, distribution };
        let is_empty = DeclaredTolerances { distribution, ..DeclaredTolerances::default() } == found;
        (!is_empty).then_some(found)
    }
}

impl Arguments {
    /// The chain with its errors, and where the tolerances are from.
    fn tolerated(
        &self,
        description: &RobotDescription,
    ) -> Result<(ToleranceSource, ToleratedChain), Failure> {
        let given = self.given.declared();
        if let Some(path) = &self.calibration {
            let source = read_text(path, CALIBRATION_BYTES)?;
            return Ok((ToleranceSource::Calibration, calibrated(description, &source)?));
        }
        if self.digits {
            return Ok((ToleranceSource::Digits, written_digits(description)?));
        }
        match (&given, &description.tolerances) {
            (Some(given), _) => Ok((ToleranceSource::Options, declared(description, given)?)),
            (None, Some(file)) => {
                // The one option that says nothing by itself: it replaces the kind of the section.
                let distribution = self.given.distribution().unwrap_or(file.distribution);
                let file = DeclaredTolerances { distribution, ..file.clone() };
                Ok((ToleranceSource::RobotFile, declared(description, &file)?))
            }
            (None, None) => Err(no_tolerances(description).into()),
        }
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut description = arguments.arm.load(printer)?;
    let given = arguments.configurations.is_given();
    let given = if given { Some(arguments.configurations.read(&mut description, printer)?) } else { None };
    let mut inputs = files_of(&description);
    inputs.extend(arguments.calibration.clone());
    arguments.plot.is_none_of(&inputs)?;
    let (source, tolerated) = arguments.tolerated(&description)?;
    printer.warnings(None, &tolerated.warnings);
    let options = StudyOptions {
        source,
        given,
        random: arguments.random as usize,
        samples: arguments.samples as usize,
        seed: arguments.seed,
        required: arguments.tolerance.unwrap_or_default().requested(),
    };
    let report =
        waiting(printer, "computing errors", || tolerance_study(&description, &tolerated, &options))?;
    printer.result(&report, |report| {
        if printer.is_quiet() {
            tolerances_line(report)
        } else {
            tolerances_text(report, &description.robot, &text_options())
        }
    })?;
    arguments.plot.write(|| plot(&report, &description, &tolerated), &inputs)?;
    let exceeded = |of: &congruent::tolerances::Requirement| of.verdict == ToleranceVerdict::Exceeded;
    Ok(u8::from(report.requirement.as_ref().is_some_and(exceeded)))
}
