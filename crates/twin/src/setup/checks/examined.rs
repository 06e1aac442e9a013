//! Whether the checks of a scenario, and its expectation, are consistent with its robot.

use congruent_description::RobotDescription;
use congruent_input::{Capability, Diagnostic, Diagnostics};
use congruent_monitors::RunningCheck;
use congruent_proximity::ObstacleMobility;
use congruent_scenario::{Check, CheckKind, Expectation, FilePlace, Scenario};

use super::tolerances::tolerances;
use crate::{
    codes,
    setup::{surroundings::paired_with_checks, uncertainty::check_uncertainty},
};

/// Adds the errors of the checks and of the expectation to `found`; returns warnings.
pub(in crate::setup) fn examine_checks(
    scenario: &Scenario,
    place: FilePlace<'_>,
    description: &RobotDescription,
    mobility: &[ObstacleMobility],
    found: &mut Diagnostics,
) -> Vec<Diagnostic> {
    found.keep(paired_with_checks(&scenario.zone, &scenario.check, place));
    for (index, check) in scenario.check.iter().enumerate() {
        let place = place.key("check").item(index);
        found.keep(RunningCheck::examine(check, place, description, &scenario.obstacle, mobility));
    }
    let scale = description.tolerance_scale();
    let mut warnings = Vec::new();
    for (index, check) in scenario.check.iter().enumerate() {
        let place = place.key("check").item(index);
        let (wrong, wide) = tolerances(check, place, &description.robot, scale);
        found.extend(wrong);
        warnings.extend(wide);
    }
    warnings.extend(check_uncertainty(scenario, place, found));
    warnings.extend(unwatched(scenario, place));
    found.extend(unexpected(scenario, place.key("expect")));
    if needs_shapes(scenario) {
        found.extend(description.check_capability(Capability::Clearance).err().into_iter().flatten());
    }
    warnings
}

/// Warnings for obstacles that no check covers and no link carries: an arm that collides with them passes.
fn unwatched<'a>(scenario: &'a Scenario, place: FilePlace<'a>) -> impl Iterator<Item = Diagnostic> + 'a {
    let looks = |check: &Check| matches!(check.kind(), CheckKind::Clearance | CheckKind::Contact);
    let is_watched = scenario.check.iter().any(looks);
    let obstacles = scenario.obstacle.iter().enumerate().filter(move |(_, obstacle)| {
        // A carried object is approached on purpose.
        !is_watched && scenario.grasp.iter().all(|grasp| grasp.body != obstacle.name)
    });
    obstacles.map(move |(index, obstacle)| {
        let name = &obstacle.name;
        let warning = Diagnostic::warning(
            codes::scenario::UNWATCHED,
            format!("no check covers obstacle \"{name}\": a run in which the arm collides with it passes"),
        )
        .one_of("obstacles are not covered by any check", name)
        .with_help("add a [[check]] with kind = \"clearance\" or \"contact\"");
        place.key("obstacle").item(index).mark(warning)
    })
}

/// Whether collision shapes are needed: for a check of distances, or for contact of the physics with an obstacle.
pub(in crate::setup) fn needs_shapes(scenario: &Scenario) -> bool {
    let measures =
        |check: &Check| matches!(check.kind(), CheckKind::Clearance | CheckKind::Contact | CheckKind::Zone);
    !scenario.obstacle.is_empty() || scenario.check.iter().any(measures)
}

/// Errors for checks that are expected to fail, but that the scenario does not have.
fn unexpected<'a>(scenario: &'a Scenario, place: FilePlace<'a>) -> impl Iterator<Item = Diagnostic> + 'a {
    let named: &[CheckKind] = match &scenario.expect {
        Expectation::Pass => &[],
        Expectation::Fail { checks } => checks,
    };
    named.iter().enumerate().filter_map(move |(index, &kind)| {
        if scenario.check.iter().any(|check| check.kind() == kind) {
            return None;
        }
        let word = kind.word();
        let message = format!("check \"{word}\" is expected to fail, but the scenario has no such check");
        let error = Diagnostic::error(congruent_scenario::codes::scenario::EXPECT, message)
            .with_help(format!("add a [[check]] with kind = \"{word}\""));
        Some(place.key("checks").item(index).mark(error))
    })
}
