//! `congruent calibrate --same-point`: the corrections with which the tool points of each file coincide.

use std::path::PathBuf;

use congruent_description::{ChainQ, RobotDescription, RobotQList};
use congruent_input::{Diagnostic, Finding, display::length};
use congruent_kinematics::random_configurations;
use nalgebra::Vector3;

use super::{
    points::{PointFit, Points, mean},
    report::{SamePointCorrection, SamePointReport, SamePointSpread, SamePointVerdict, TouchedPoint},
    undetermined::Undetermined,
};
use crate::{
    chain::NominalChain,
    codes,
    estimation::{
        CorrectedChain, FixedParameter, Identification, MOST_FOLDS, MeasuredInformation, ParameterUnit,
        identify_by_information,
    },
    free,
    report::{CalibratedModel, reported_fixed},
};

/// Number of random configurations at which it is found what no point determines.
const CANDIDATES: usize = 60;
/// A correction below this many standard deviations is not significant. No unit; kind: choice, 95 % of normal noise.
const SIGNIFICANT_SIGMAS: f64 = 2.0;
/// Fewest rows of a file: without one of a fold, the others must still have a mean to be compared with.
const FEWEST_ROWS: usize = 4;

/// A length of the arm that would change by more than this share of the reach is no assembly error. Kind: judgement.
const LARGEST_LENGTH: f64 = 0.1;
/// Tool points that are farther from each other, on average, than this share of the reach have not touched one point. Kind: judgement.
const LARGEST_SPREAD: f64 = 0.01;

/// Options of a calibration by points.
#[derive(Debug, Clone, PartialEq)]
pub struct SamePointOptions {
    /// Groups and names of the corrections that are free.
    pub free: Vec<String>,
    /// Groups and names of corrections that are held at nominal even if `free` names them.
    pub hold: Vec<String>,
    /// Smallest singular value of the estimated corrections over the largest of all. No unit.
    pub threshold: f64,
    /// Seed of the configurations at which it is found what no point determines.
    pub seed: u64,
}

/// The configurations of a robot in which its tool is at one point.
#[derive(Debug, Clone, PartialEq)]
pub struct SamePointFile {
    /// The file, as it was named.
    pub path: PathBuf,
    /// Its rows.
    pub rows: RobotQList,
}

/// Estimates the free corrections of a robot from files in each of which its tool has touched one unknown point.
///
/// # Errors
/// The robot has no chain, a named correction is unknown or none is free, or a file has fewer than four rows.
pub fn calibrate_same_point(
    description: &RobotDescription,
    files: &[SamePointFile],
    options: &SamePointOptions,
) -> Result<SamePointReport, Diagnostic> {
    let nominal = NominalChain::new(description)?;
    let parameters = free::parameters(&nominal, &options.free, &options.hold)?;
    let rows = rows_of_files(&nominal, files)?;
    let chain = CorrectedChain::new(nominal.chain.clone(), parameters);
    let candidates = random_configurations(&description.robot, options.seed, CANDIDATES);
    let candidates: Vec<ChainQ> = candidates.iter().map(|q| nominal.chain_positions(q)).collect();
    let points = Points { chain: &chain, files: &rows };
    let undetermined = Undetermined::new(&chain, &candidates);
    let estimate = |points: &Points<'_>| {
        let identification = identified(points, &undetermined, options.threshold);
        let fit = points.fit(&identification.kept);
        (identification, fit)
    };
    let (identification, fit) = estimate(&points);
    let held_out = held_out(&points, |points| estimate(points).1.corrections);
    let model = if nominal.table.is_some() { CalibratedModel::Dh } else { CalibratedModel::Urdf };
    let tip = &description.robot.link(description.tip).name;
    let start = chain.start();
    let spread = |p: &[f64]| SamePointSpread::of_distances(points.distances(p).as_slice().concat().iter());
    let fixed = |each: &FixedParameter| reported_fixed(&chain, each);
    let implausible = implausible(&points, &identification, &fit);
    let mut report = SamePointReport {
        robot: description.name.clone(),
        chain: description.reported_chain(),
        model,
        tool_frame: if description.tip_from_tcp.is_some() { "tcp".to_owned() } else { tip.clone() },
        rows: points.rows(),
        verdict: verdict(&identification, held_out.as_ref(), implausible.as_ref()),
        statements: Vec::new(),
        parameters: corrections(&chain, &identification, &fit),
        fixed: identification.fixed.iter().map(fixed).collect(),
        scale_given_by: undetermined.scale_giving.map(|at| chain.parameters()[at].name.clone()),
        nominal: spread(start),
        corrected: spread(&fit.corrections),
        held_out: held_out.as_ref().map(|(corrected, _)| *corrected),
        noise_m: fit.noise_m,
        converged: fit.converged,
        points: touched(&points, files, &fit.corrections),
        written: None,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    };
    report.statements =
        statements(&report, held_out.as_ref().map(|(_, nominal)| nominal), implausible.as_ref());
    Ok(report)
}

fn rows_of_files(
    nominal: &NominalChain<'_>,
    files: &[SamePointFile],
) -> Result<Vec<Vec<ChainQ>>, Diagnostic> {
    let rows = |file: &SamePointFile| {
        let rows: Vec<ChainQ> = file.rows.iter().map(|q| nominal.chain_positions(&q)).collect();
        if rows.len() >= FEWEST_ROWS {
            return Ok(rows);
        }
        let message = format!(
            "{}: {} configurations at one point are too few to estimate from and to hold some out",
            file.path.display(),
            rows.len()
        );
        Err(Diagnostic::error(codes::calibrate::SAME_POINT, message)
            .with_help(format!("touch the point in {FEWEST_ROWS} configurations or more, better in thirty")))
    };
    files.iter().map(rows).collect()
}

/// What the points identify; the length that gives the scale comes last, so that it is the one that is held.
fn identified(points: &Points<'_>, undetermined: &Undetermined, threshold: f64) -> Identification {
    let parameters = points.chain.parameters();
    let mut order: Vec<usize> = (0..parameters.len()).collect();
    order.sort_by_key(|&at| (Some(at) == undetermined.scale_giving, parameters[at].entry));
    let measured = MeasuredInformation {
        information: undetermined.without(&points.information()),
        components: 3 * points.rows(),
        reach_m: points.reach_m(),
    };
    identify_by_information(points.chain, order, measured, threshold)
}

/// Spread of held-out rows about the point of the others of their file, with the corrections of these and with the nominal model. Row i
/// of a file is in fold i modulo the number of folds.
fn held_out(
    points: &Points<'_>,
    mut estimate: impl FnMut(&Points<'_>) -> Vec<f64>,
) -> Option<(SamePointSpread, SamePointSpread)> {
    let folds = points.files.iter().map(Vec::len).min()?.min(MOST_FOLDS);
    let (mut corrected, mut nominal) = (Vec::new(), Vec::new());
    for fold in 0..folds {
        let part = |is_held: bool| -> Vec<Vec<ChainQ>> {
            let rows = |rows: &Vec<ChainQ>| {
                let each = rows.iter().enumerate();
                each.filter(|(at, _)| (at % folds == fold) == is_held).map(|(_, q)| q.clone()).collect()
            };
            points.files.iter().map(rows).collect()
        };
        let (used, held) = (part(false), part(true));
        let [used, held] = [&used, &held].map(|files| Points { chain: points.chain, files });
        let p = estimate(&used);
        for (p, distances) in [(p.as_slice(), &mut corrected), (points.chain.start(), &mut nominal)] {
            let at: Vec<Vector3<f64>> = used.tips(p).iter().map(|tips| mean(tips)).collect();
            let tips = held.tips(p);
            let each =
                tips.iter().zip(&at).flat_map(|(tips, at)| tips.iter().map(move |tip| (tip - at).norm()));
            distances.extend(each);
        }
    }
    Some((SamePointSpread::of_distances(corrected.iter()), SamePointSpread::of_distances(nominal.iter())))
}

/// Why an estimate is not one of an arm; `None` if it may be. An arm that is shrunk to a point touches every point.
fn implausible(points: &Points<'_>, identification: &Identification, fit: &PointFit) -> Option<String> {
    let chain = points.chain;
    let start = points.tips(chain.start());
    let reach_m = start.iter().flatten().map(Vector3::norm).fold(0.0, f64::max);
    if !fit.converged {
        return Some(format!("least squares did not converge in {} steps", fit.steps));
    }
    let unknown = |&&at: &&usize| !fit.standard_deviations[at].is_finite();
    if let Some(&at) = identification.kept.iter().find(unknown) {
        return Some(format!("the points do not determine {}", chain.parameters()[at].name));
    }
    let is_length = |at: usize| {
        let parameter = &chain.parameters()[at];
        parameter.unit() == ParameterUnit::Length && !parameter.name.starts_with("tool.")
    };
    let too_long = |&&at: &&usize| is_length(at) && fit.corrections[at].abs() > LARGEST_LENGTH * reach_m;
    if let Some(&at) = identification.kept.iter().find(too_long) {
        let (name, value) = (&chain.parameters()[at].name, length(fit.corrections[at].abs()));
        return Some(format!("{name} would change by {value}, more than a tenth of the reach"));
    }
    let corrected =
        SamePointSpread::of_distances(points.distances(&fit.corrections).as_slice().concat().iter());
    let largest_m = LARGEST_SPREAD * reach_m;
    (corrected.mean_m > largest_m).then(|| {
        let [spread, largest] = [corrected.mean_m, largest_m].map(length);
        format!("the tool points are still {spread} from each other, more than {largest}, a hundredth of the reach")
    })
}

fn verdict(
    identification: &Identification,
    held_out: Option<&(SamePointSpread, SamePointSpread)>,
    implausible: Option<&String>,
) -> SamePointVerdict {
    match held_out {
        _ if identification.kept.is_empty() => SamePointVerdict::NothingIdentified,
        None => SamePointVerdict::Unverifiable,
        Some((corrected, nominal)) if corrected.mean_m >= nominal.mean_m => SamePointVerdict::NoImprovement,
        Some(_) if implausible.is_some() => SamePointVerdict::Unexplained,
        Some(_) => SamePointVerdict::Explained,
    }
}

fn corrections(
    chain: &CorrectedChain,
    identification: &Identification,
    fit: &PointFit,
) -> Vec<SamePointCorrection> {
    let correction = |&at: &usize| {
        let parameter = &chain.parameters()[at];
        let (correction, standard_deviation) = (fit.corrections[at], fit.standard_deviations[at]);
        SamePointCorrection {
            name: parameter.name.clone(),
            unit: parameter.unit(),
            correction,
            standard_deviation,
            significant: correction.abs() > SIGNIFICANT_SIGMAS * standard_deviation,
        }
    };
    identification.kept.iter().map(correction).collect()
}

fn touched(points: &Points<'_>, files: &[SamePointFile], p: &[f64]) -> Vec<TouchedPoint> {
    let (nominal, corrected) = (points.distances(points.chain.start()), points.distances(p));
    let at: Vec<Vector3<f64>> = points.tips(p).iter().map(|tips| mean(tips)).collect();
    let point = |(file, of_file): (usize, &SamePointFile)| {
        let worst = corrected[file].iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
        TouchedPoint {
            file: of_file.path.display().to_string(),
            rows: corrected[file].len(),
            nominal: SamePointSpread::of_distances(nominal[file].iter()),
            corrected: SamePointSpread::of_distances(corrected[file].iter()),
            worst_row: worst.map_or(0, |(row, _)| row + 1),
            point_in_base_m: at[file].into(),
        }
    };
    files.iter().enumerate().map(point).collect()
}

fn statements(
    report: &SamePointReport,
    nominal: Option<&SamePointSpread>,
    implausible: Option<&String>,
) -> Vec<String> {
    let words =
        |of: &SamePointSpread| format!("{} in the mean, {} at most", length(of.mean_m), length(of.worst_m));
    let spreads = match (&report.held_out, nominal) {
        (Some(corrected), Some(nominal)) => {
            format!("spread of held-out rows {}; {} with the nominal model", words(corrected), words(nominal))
        }
        _ => {
            format!("spread {}; {} with the nominal model", words(&report.corrected), words(&report.nominal))
        }
    };
    let first = match report.verdict {
        SamePointVerdict::Explained => "the corrections bring the tool points of each file together",
        SamePointVerdict::Unexplained => "the corrections do NOT explain the points: keep the nominal model",
        SamePointVerdict::NoImprovement => "the corrections are no better than the nominal model: keep it",
        SamePointVerdict::Unverifiable => "the rows are too few to verify the corrections",
        SamePointVerdict::NothingIdentified => {
            "none of the free corrections can be identified from one point in each file"
        }
    };
    let mut statements = vec![format!("{first}: {spreads}")];
    if let Some(length) = &report.scale_given_by {
        statements.push(format!(
            "a point says nothing about the size of the arm: {length} is held, and the other lengths are in its scale"
        ));
    }
    statements.extend(implausible.cloned());
    statements
}
