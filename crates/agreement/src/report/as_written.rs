//! A correction as it is written: the corrected text read again, with the digits that it has then.

use std::sync::Arc;

use congruent_description::{RobotDescription, parse_robot};
use congruent_input::SourceFile;
use congruent_kinematics::PoseError;

use super::{content::CorrectedFile, names::ModelNames};
use crate::diagnosis::{Criterion, ModelPair};

/// Whether a check of the corrected file will find table and URDF the same, at the configurations of this one; `None` if the
/// text cannot be read by itself.
pub(super) fn is_same_as_written(
    corrected: &CorrectedFile,
    models: &ModelPair,
    criterion: &Criterion,
    names: &ModelNames<'_>,
) -> Option<bool> {
    let places = names.places?;
    let path = places.source().path.clone();
    let source = SourceFile { path, text: corrected.text.clone(), is_foreign: places.source().is_foreign };
    let read = parse_robot(Some(&Arc::new(source)), names.urdf?.source()).ok()?;
    // The chain stays the one that is compared, whoever has named its ends.
    let description = RobotDescription { dh: read.dh, ..names.description.clone() };
    let names = ModelNames {
        description: &description,
        moving: names.moving.clone(),
        chain: names.chain.clone(),
        places: read.places.robot_file.as_deref(),
        urdf: names.urdf,
    };
    let written = ModelPair { candidate: names.candidate()?, reference: models.reference.clone() };
    if written.is_within_tolerance(criterion) {
        return Some(true);
    }
    let digits = names.digits(&written, criterion);
    let PoseError { position_m, orientation_rad } = written.residual(criterion);
    let is_allowed = description.declared_tolerance.allows(position_m, orientation_rad);
    Some(is_allowed && digits.explain(&written, &criterion.configurations))
}
