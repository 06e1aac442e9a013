//! What the rows of a folder are of: the plan, the files and the program.

use std::collections::BTreeMap;

use congruent_input::{Findings, InputFile, Override};
use congruent_results::report::Versions;
use congruent_scenario::CaseSampling;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::digest::hex;
use crate::{
    plan::{Distribution, SweepPlan},
    run::CaseRunner,
};

/// What the rows of a folder are of. Folders with equal `identity` have parts of one sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SweepHeader {
    /// Name and version of this format.
    pub format: String,
    /// Name of the sweep.
    pub name: String,
    /// The plan file, as it was named by the first call.
    pub plan: String,
    /// Name of the scenario.
    pub scenario: String,
    /// Name of the robot.
    pub robot: String,
    /// How the values of the cases are chosen.
    pub sampling: CaseSampling,
    /// Number of cases of the plan.
    pub cases: u64,
    /// Seed of the sweep.
    pub seed: u64,
    /// The varied keys, in the order of the values of a row; several that get one value are joined by commas.
    pub keys: Vec<String>,
    /// SHA-256 of each file that the cases were made from, by its name without folders.
    pub files: BTreeMap<String, String>,
    /// Versions of this program and of the physics engine.
    pub versions: Versions,
    /// SHA-256 over plan, files and versions: equal for what gives equal rows.
    pub identity: String,
}

impl SweepHeader {
    /// The header of a plan's sweep.
    ///
    /// # Errors
    /// The findings of the first case, if none of the first can be run: a key is wrong, or the scenario is.
    pub fn new(runner: &CaseRunner<'_>) -> Result<Self, Findings> {
        let plan = runner.plan();
        let setup = runner.first_setup()?;
        let files: BTreeMap<String, String> = setup
            .inputs
            .iter()
            .chain(&setup.description.inputs)
            .chain(&runner.access().files())
            .chain(&named_files(runner))
            .map(|input| (file_name(input), input.sha256.clone()))
            .collect();
        let mut header = Self {
            format: "congruent-sweep/1".to_owned(),
            name: plan.name.clone(),
            plan: plan.path.display().to_string(),
            scenario: setup.scenario.name.clone(),
            robot: setup.description.name.clone(),
            sampling: plan.sampling,
            cases: plan.cases,
            seed: plan.seed,
            keys: plan.keys(),
            files,
            versions: Versions::current(),
            identity: String::new(),
        };
        header.identity = identity(&header, plan);
        Ok(header)
    }
}

/// Most files that the values of a plan may name.
const MOST_NAMED: usize = 64;

/// The files that only some values name, such as tables of torques.
fn named_files(runner: &CaseRunner<'_>) -> Vec<InputFile> {
    let plan = runner.plan();
    let words = plan.varied.iter().filter_map(|varied| match &varied.distribution {
        Distribution::Values(values) => {
            Some((varied, values.iter().filter(|value| value.starts_with(['"', '\'']))))
        }
        _ => None,
    });
    let named = words.flat_map(|(varied, values)| values.map(move |value| (&varied.keys, value)));
    let inputs = named.take(MOST_NAMED).filter_map(|(keys, value)| {
        let case = plan.case(0).overrides;
        let others =
            case.into_iter().filter(|change| !keys.iter().any(|key| change.path().eq(key.split('.'))));
        let set = keys.iter().filter_map(|key| format!("{key}={value}").parse().ok());
        let overrides: Vec<Override> = others.chain(set).collect();
        let setup = runner.setup_with(&overrides).ok()?;
        Some(setup.inputs.into_iter().chain(setup.description.inputs).collect::<Vec<_>>())
    });
    inputs.flatten().collect()
}

fn file_name(input: &InputFile) -> String {
    let name = std::path::Path::new(&input.file).file_name();
    name.map_or_else(|| input.file.clone(), |name| name.to_string_lossy().into_owned())
}

/// SHA-256 over everything that decides the rows.
fn identity(header: &SweepHeader, plan: &SweepPlan) -> String {
    let set: Vec<String> = plan.set.iter().map(ToString::to_string).collect();
    let decided = serde_json::json!({
        "scenario": header.scenario,
        "sampling": header.sampling,
        "cases": header.cases,
        "seed": header.seed,
        "varied": plan.varied,
        "set": set,
        "files": header.files,
        "versions": header.versions,
    });
    hex(&Sha256::digest(decided.to_string()))
}
