//! A checked plan, and the overrides of each of its cases.

use std::{
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_input::{
    Diagnostic, Diagnostics, FileAccess, Findings, Override, SourceFile, direct_path, folder_of,
    toml_text::parse_toml,
};
use congruent_results::report::PassingShare;
use congruent_scenario::CaseSampling;
use toml::Spanned;

use super::{
    key::{is_inside, key_of},
    nominal::NominalValues,
    requirement::passing_share,
    varied::{VariedKey, varied},
    written::WrittenPlan,
};
use crate::{
    codes,
    sampling::{MOST_DIMENSIONS, PointSource},
};

/// Version of plan files.
const SCHEMA_VERSION: u32 = 1;
/// Largest plan file that is read.
const MOST_BYTES: u64 = 1 << 20;
/// Most Sobol points: an index has 32 bits.
const MOST_SOBOL: u64 = 1 << 32;
/// The key of the scenario's seed: a plan that varies it has no other seeds.
pub(super) const SEED: &str = "seed";

/// A plan: one scenario, and the values of its cases.
#[derive(Debug, Clone)]
pub struct SweepPlan {
    /// Name of the sweep.
    pub name: String,
    /// The plan file, as it was named.
    pub path: PathBuf,
    /// The scenario, from the current folder.
    pub scenario: PathBuf,
    /// How the values of the cases are chosen.
    pub sampling: CaseSampling,
    /// Number of cases.
    pub cases: u64,
    /// Seed of the sweep.
    pub seed: u64,
    /// What varies.
    pub varied: Vec<VariedKey>,
    /// Values that all cases have.
    pub set: Vec<Override>,
    /// What the rows are judged by.
    pub require: Option<PassingShare>,
    /// Whether a value that varies replaces one of `set`, as of the call that runs a scenario; in a plan both are a mistake.
    pub(super) varies_what_is_set: bool,
    pub(super) points: PointSource,
    pub(super) source: Arc<SourceFile>,
}

/// One case of a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepCase {
    /// Its number, from 0.
    pub case: u64,
    /// The seed of its run.
    pub seed: u64,
    /// The value of each varied key, as TOML.
    pub values: Vec<String>,
    /// All of that as overrides of the scenario.
    pub overrides: Vec<Override>,
}

impl SweepPlan {
    /// Reads a plan file.
    ///
    /// # Errors
    /// Every finding, if one is an error.
    pub fn read(path: &Path, access: &FileAccess) -> Result<Self, Findings> {
        let source = access.read_named_text(path, MOST_BYTES)?;
        let mut found = Diagnostics::default();
        let written: Option<WrittenPlan> = parse_toml(&source.text, &mut found);
        let access = access.inside_project_of(path)?;
        let plan = written.and_then(|written| checked(&written, &source, &access, &mut found));
        match plan {
            Some(plan) if !found.has_error() => Ok(plan),
            _ => Err(found.in_file(&source).into()),
        }
    }

    /// A case of the plan: its seed and values follow from the plan and its number alone.
    ///
    /// # Panics
    /// If the plan has no such case.
    pub fn case(&self, case: u64) -> SweepCase {
        assert!(case < self.cases, "case {case} of {}", self.cases);
        let (seed, point) = self.points.case(case);
        let values: Vec<String> =
            self.varied.iter().zip(point).map(|(varied, share)| varied.distribution.value(share)).collect();
        let mut overrides = self.set.clone();
        for (varied, value) in self.varied.iter().zip(&values) {
            overrides.extend(self.overrides_of(varied, value));
        }
        // A seed that the plan sets or varies is that of the run.
        let given = overrides.iter().find(|change| change.path().eq([SEED])).map(Override::whole_number);
        if given.is_none() {
            overrides.push(Override::seed(seed));
        }
        SweepCase { case, seed: given.flatten().unwrap_or(seed), values, overrides }
    }
}

impl SweepPlan {
    /// The varied keys, in the order of the values of a case; several that get one value are joined by commas.
    pub fn keys(&self) -> Vec<String> {
        self.varied.iter().map(|varied| varied.keys.join(", ")).collect()
    }

    /// The overrides that give a value to a varied key.
    fn overrides_of<'a>(
        &'a self,
        varied: &'a VariedKey,
        value: &'a str,
    ) -> impl Iterator<Item = Override> + 'a {
        varied.keys.iter().map(move |key| {
            let set = set(key, value);
            if self.varies_what_is_set { set.replacing() } else { set }
        })
    }

    /// All cases' values, with one for a varied key.
    pub(crate) fn with_value(&self, varied: &VariedKey, value: &str) -> Vec<Override> {
        self.set.iter().cloned().chain(self.overrides_of(varied, value)).collect()
    }

    /// Findings about a case, at the keys of the plan that they are about.
    pub(crate) fn at_keys(&self, findings: Findings) -> Findings {
        let placed = |finding: Diagnostic| {
            let set = finding.message.strip_prefix("--set ").and_then(|message| message.split('=').next());
            let is_set = |varied: &&VariedKey| set.is_some_and(|set| varied.has_key(set));
            match self.varied.iter().find(is_set) {
                Some(varied) => self.at_key(varied, finding),
                None => finding,
            }
        };
        findings.into_iter().map(placed).collect()
    }

    /// A finding about the value of a varied key, at its place in the plan.
    pub(crate) fn at_key(&self, varied: &VariedKey, finding: Diagnostic) -> Diagnostic {
        varied.finding(finding).at(varied.place.clone()).in_file(&self.source)
    }
}

/// An override whose key and value were checked as the plan was read.
fn set(key: &str, value: &str) -> Override {
    format!("{key}={value}").parse().expect("key and value were checked with the plan")
}

fn checked(
    written: &WrittenPlan,
    source: &Arc<SourceFile>,
    access: &FileAccess,
    found: &mut Diagnostics,
) -> Option<SweepPlan> {
    let name = written.name.get_ref().trim().to_owned();
    if *written.schema_version.get_ref() != SCHEMA_VERSION {
        let message = format!("schema_version = {} is not supported", written.schema_version.get_ref());
        let fault = Diagnostic::error(codes::sweep::VERSION, message).at(written.schema_version.span());
        found.push(fault.with_help(format!("this program reads version {SCHEMA_VERSION}")));
    }
    if name.is_empty() {
        found.push(Diagnostic::error(codes::sweep::NAME, "the name is empty").at(written.name.span()));
    }
    if written.vary.is_empty() {
        let fault =
            Diagnostic::error(codes::sweep::NOTHING_VARIES, "nothing varies: the plan has no [[vary]]");
        found.push(
            fault.at(0..0).with_help("[[vary]]\nkey = \"controller.stiffness\"\nuniform = [400.0, 4000.0]"),
        );
    }
    let set = found.keep(fixed(written))?;
    let scenario = direct_path(&folder_of(&source.path).join(written.scenario.get_ref()));
    // Before it is read for the values around which others vary.
    found.keep(access.check(&scenario).map_err(|fault| fault.at(written.scenario.span())))?;
    let nominal = NominalValues { scenario: &scenario, overrides: &set, access };
    let keys = written.vary.iter().filter_map(|vary| {
        let varied = varied(vary.get_ref(), &vary.span(), written.sampling, nominal);
        found.keep(varied.map_err(|fault| at(fault, vary.span())))
    });
    let varied: Vec<VariedKey> = keys.flatten().collect();
    let mut of_set = Vec::new();
    flatten("", &written.set, &mut of_set);
    found.extend(repeated(of_set.into_iter().map(|(key, _)| key), &varied));
    let given = written.cases.as_ref().map(|cases| *cases.get_ref());
    let place = written.cases.as_ref().map_or(0..0, Spanned::span);
    let cases = checked_cases(written.sampling, given, &varied).map_err(|fault| fault.at(place));
    let cases = found.keep(cases)?;
    let require = written.require.as_ref().and_then(|require| {
        let checked = passing_share(*require.get_ref(), written.sampling);
        found.keep(checked.map_err(|fault| fault.at(require.span())))
    });
    let steps = varied.iter().map(|varied| varied.steps).collect();
    let (sampling, seed) = (written.sampling, written.seed);
    if found.has_error() {
        return None;
    }
    Some(SweepPlan {
        name,
        path: source.path.clone(),
        scenario,
        sampling,
        cases,
        seed,
        varied,
        set,
        require,
        varies_what_is_set: false,
        points: PointSource::new(sampling, seed, cases, steps),
        source: Arc::clone(source),
    })
}

/// The values that all cases have.
fn fixed(written: &WrittenPlan) -> Result<Vec<Override>, Diagnostic> {
    let mut found = Vec::new();
    flatten("", &written.set, &mut found);
    found.iter().map(|(key, value)| key_of(key, value)).collect()
}

/// Keys joined by dots, whether they are written in tables or as one.
fn flatten(before: &str, table: &toml::Table, found: &mut Vec<(String, String)>) {
    for (key, value) in table {
        let key = format!("{before}{key}");
        match value {
            toml::Value::Table(table) => flatten(&format!("{key}."), table, found),
            value => found.push((key, value.to_string())),
        }
    }
}

/// Refuses a key that is there twice, or inside of another: which of the values is meant is not known.
pub(super) fn repeated(set: impl Iterator<Item = String>, varied: &[VariedKey]) -> Vec<Diagnostic> {
    let mut known: Vec<String> = set.collect();
    let mut found: Vec<Diagnostic> = Vec::new();
    for varied in varied {
        let repeats =
            |key: &String, other: &String| key == other || is_inside(key, other) || is_inside(other, key);
        let pair =
            varied.keys.iter().find_map(|key| Some((key, known.iter().find(|other| repeats(key, other))?)));
        let is_new = found.last().is_none_or(|last| last.span.as_ref() != Some(&varied.place));
        if let (Some((key, other)), true) = (pair, is_new) {
            let message = if key == other {
                format!("key \"{key}\" is there twice")
            } else {
                format!("key \"{key}\" is there beside \"{other}\", which has the same values")
            };
            found.push(Diagnostic::error(codes::sweep::KEY, message).at(varied.place.clone()));
        }
        known.extend(varied.keys.iter().cloned());
    }
    found
}

/// A fault at a place, unless it has one in another file.
pub(super) fn at(fault: Diagnostic, place: Range<usize>) -> Diagnostic {
    if fault.source.is_some() { fault } else { fault.at(place) }
}

/// The number of cases of these keys, if `given` is one that they can have.
pub(super) fn checked_cases(
    sampling: CaseSampling,
    given: Option<u64>,
    varied: &[VariedKey],
) -> Result<u64, Diagnostic> {
    let fault = |message: String| Diagnostic::error(codes::sweep::CASES, message);
    if sampling == CaseSampling::Grid {
        let product = varied.iter().try_fold(1_u64, |product, varied| product.checked_mul(varied.steps));
        let product = product.ok_or_else(|| fault("the grid has more than 2^64 cases".to_owned()))?;
        return match given {
            Some(given) if given != product => {
                let message = format!("cases = {given}, and the grid has {product} combinations");
                Err(fault(message).with_help(format!("cases = {product}, or change steps and values")))
            }
            _ => Ok(product),
        };
    }
    let Some(given) = given else {
        let message = "the plan does not say how many cases it has".to_owned();
        return Err(fault(message).with_help("cases = 1000"));
    };
    if given == 0 {
        return Err(fault("cases = 0 is no sweep".to_owned()).with_help("cases = 1000"));
    }
    if sampling == CaseSampling::Sobol && (given > MOST_SOBOL || varied.len() > MOST_DIMENSIONS) {
        let message = format!("{given} Sobol points of {} keys", varied.len());
        return Err(fault(message).with_help(format!(
            "at most {MOST_SOBOL} cases and {MOST_DIMENSIONS} keys; sampling = \"latin_hypercube\" has no such limit"
        )));
    }
    Ok(given)
}
