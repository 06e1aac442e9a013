//! `congruent convert`: one model of a robot written as another.

use std::{
    path::{Path, PathBuf},
    str::FromStr,
};

use congruent::{
    analysis::conversion::{Conversion, ConversionSource, ConversionTarget, RoundedAxes},
    input::Diagnostic,
};

use crate::{
    codes,
    failure::Failure,
    input::{ArmArguments, named, seed},
    model::written_model::answer,
    output::file::NewFile,
    terminal::print::Printer,
};

/// Converts a robot between DH tables, screws, URDF and MJCF, proved by comparing back.
///
/// Converts the declared table, or the chain of the URDF if no table is declared: `--to dh` of a URDF derives a table from its axes,
/// with the free choices as comments. Axes that are parallel or intersect except for rounding in the URDF are taken as exactly so,
/// and reported. `--to mjcf`, and `--to urdf` of a URDF or MJCF, write the whole robot with masses, limits and shapes; --base and --tip
/// write the chain between them alone. What the format cannot hold is a warning.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    arm: ArmArguments,
    /// The model, the file, or both in two options: `dh` (the same as `standard`) for rows Rz(theta) Tz(d) Tx(a) Rx(alpha),
    /// `modified` for rows Rx(alpha) Tx(a) Rz(theta) Tz(d) (Craig), `poe` for screws, `urdf`, `mjcf`; a name with a point is a file, of
    /// which .urdf and .xml (MJCF) say the model. A table in a file is a whole robot file (.toml). Without a file, the model is printed.
    #[arg(long, value_name = "MODEL|FILE")]
    to: Vec<ConversionOutput>,
    /// The file, as --to may name it.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Which model is converted.
    #[arg(long, value_parser = named::<ConversionSource>())]
    from: Option<ConversionSource>,
    #[command(flatten)]
    accuracy: AccuracyArguments,
    /// Replace the file of --to if it exists.
    #[arg(long)]
    force: bool,
}

/// One value of --to.
#[derive(Debug, Clone, PartialEq)]
enum ConversionOutput {
    Model(ConversionTarget),
    File(PathBuf),
}

impl FromStr for ConversionOutput {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Ok(Self::Model(match text {
            "dh" | "standard" => ConversionTarget::Standard,
            "modified" => ConversionTarget::Modified,
            "poe" => ConversionTarget::Poe,
            "urdf" => ConversionTarget::Urdf,
            "mjcf" => ConversionTarget::Mjcf,
            file if file.contains(['.', '/']) => return Ok(Self::File(file.into())),
            "sdf" => {
                return Err(
                    "SDF is not written: write URDF, and convert it with `gz sdf -p FILE.urdf`".to_owned()
                );
            }
            _ => {
                return Err(
                    "expected dh, standard, modified, poe, urdf, mjcf, or the name of a file".to_owned()
                );
            }
        }))
    }
}

impl Arguments {
    /// The model and the file that --to names.
    fn target(&self) -> Result<(ConversionTarget, Option<&Path>), Diagnostic> {
        let refused =
            |message: String, help: &str| Err(Diagnostic::error(codes::convert::TO, message).with_help(help));
        let (mut model, mut file) = (None, self.out.as_deref());
        for written in &self.to {
            let is_second = match written {
                ConversionOutput::Model(named) => model.replace(*named).is_some(),
                ConversionOutput::File(path) => file.replace(path.as_path()).is_some(),
            };
            if is_second {
                return refused(
                    "--to gives two models or two files".to_owned(),
                    "give one model and one file at most",
                );
            }
        }
        let ends =
            |path: &Path, known: &str| path.extension().is_some_and(|of| of.eq_ignore_ascii_case(known));
        match (model, file) {
            (Some(model), file) => Ok((model, file)),
            (None, Some(path)) if ends(path, "urdf") => Ok((ConversionTarget::Urdf, file)),
            (None, Some(path)) if ends(path, "xml") => Ok((ConversionTarget::Mjcf, file)),
            (None, None) => refused(
                "no model to write is named".to_owned(),
                "give --to dh, modified, poe, urdf or mjcf, or --out FILE.urdf or FILE.xml",
            ),
            (None, Some(path)) if !ends(path, "toml") && path.extension().is_some() => {
                let ending = path.extension().unwrap_or_default().display();
                let message = format!("{}: .{ending} is no robot file", path.display());
                refused(message, "give a name that ends in .urdf or .xml (MJCF), or in .toml with --to dh")
            }
            (None, Some(path)) => {
                let path = path.display();
                let message = format!(
                    "{path} does not say which model is written: a table in which convention, or screws"
                );
                refused(message, &format!("for example --to dh --to {path}"))
            }
        }
    }
}

/// The default of the library as people write it: the help would print twelve zeros.
const ACCURACY: &str = "1e-12";

/// How exact a conversion must be.
#[derive(Debug, Clone, Copy, clap::Args)]
struct AccuracyArguments {
    /// Largest error of the result, rad and m; a coarser one takes nearly parallel axes as parallel.
    #[arg(long, default_value = ACCURACY, value_parser = accuracy)]
    accuracy: f64,
    /// Seed of the random configurations of the proof.
    #[arg(long, default_value_t = 0, value_parser = seed)]
    seed: u64,
    /// Keep axes as written that are parallel or intersect except for rounding (a quarter turn of 1.5708).
    #[arg(long)]
    exact: bool,
}

impl AccuracyArguments {
    fn conversion(self, from: Option<ConversionSource>, to: ConversionTarget) -> Conversion {
        let rounded_axes = if self.exact { RoundedAxes::Kept } else { RoundedAxes::Corrected };
        Conversion { from, to, accuracy: self.accuracy, seed: self.seed, rounded_axes }
    }
}

fn accuracy(text: &str) -> Result<f64, String> {
    const FINEST: f64 = 1e-15;
    const COARSEST: f64 = 1e-2;
    let value: f64 = text.parse().map_err(|error| format!("{error}"))?;
    let is_sound = (FINEST..=COARSEST).contains(&value);
    if is_sound { Ok(value) } else { Err(format!("must be from {FINEST:e} to {COARSEST:e}")) }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let (to, file) = arguments.target()?;
    if arguments.force && file.is_none() {
        let message = "--force replaces a file, and --to names none";
        return Err(Diagnostic::error(codes::convert::TO, message)
            .with_help("for example --to dh --to arm.toml --force")
            .into());
    }
    // The table that is derived from a URDF has nothing to do with a declared one.
    let description = match arguments.from {
        Some(ConversionSource::Urdf) => arguments.arm.load_urdf(printer)?,
        _ => arguments.arm.load(printer)?,
    };
    let dropped = description
        .warnings
        .iter()
        .find(|warning| warning.code == congruent::description::codes::chain::TABLE_DROPPED);
    if let (Some(dropped), Some(ConversionSource::Dh)) = (dropped, arguments.from) {
        return Err(Diagnostic::error(
            congruent::analysis::codes::convert::NO_DH,
            format!("--from dh: {}", dropped.message),
        )
        .with_help("omit --base and --tip, or convert the chosen chain with --from urdf")
        .into());
    }
    let conversion = arguments.accuracy.conversion(arguments.from, to);
    let file = file.map(|path| NewFile { option: "--to", path, force: arguments.force });
    answer(&description, &conversion, file, printer)
}

#[cfg(test)]
mod tests {
    use congruent::analysis::conversion::DEFAULT_ACCURACY;

    use super::*;

    #[test]
    fn the_default_of_the_help_is_that_of_the_library() {
        assert_eq!(ACCURACY.parse(), Ok(DEFAULT_ACCURACY));
    }
}
