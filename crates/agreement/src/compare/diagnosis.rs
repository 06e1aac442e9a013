//! The diagnosis without the comparison: for a difference that is known already, as of a run.

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::{LinkPoses, sample_configurations};

use super::{check::RANDOM_CONFIGURATIONS, error::CheckError, identified::IdentifiedChain};
use crate::report::{ReportedDiagnosis, diagnose_models};

/// Why model, URDF and physics differ: the diagnosis of each pair of models, at the configurations of a check with this
/// seed.
///
/// # Errors
/// [`CheckError`] if the physics rejects a configuration.
pub fn diagnose(
    description: &RobotDescription,
    physics: &mut dyn LinkPoses,
    seed: u64,
) -> Result<Vec<ReportedDiagnosis>, CheckError> {
    let configurations: Vec<RobotQ> = sample_configurations(&description.robot, seed, RANDOM_CONFIGURATIONS);
    let identified = IdentifiedChain::new(description, physics, &configurations)?;
    Ok(diagnose_models(description, Some(&identified.chain), &configurations))
}
