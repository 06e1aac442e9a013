//! `congruent dynamics --base-parameters`: what is identifiable from joint torques.

use congruent::{
    analysis::base_parameters::base_parameters as derived,
    description::{Followers, RobotDescription},
    input::Diagnostic,
    text::base_parameters_text,
};

use crate::{codes, failure::Failure, terminal::print::Printer};

/// Seed of the motions at which torques are computed; the result does not depend on it.
const SEED: u64 = 0;

/// Prints the base parameters of the arm.
pub(super) fn base_parameters(
    description: &RobotDescription,
    followers: Followers,
    printer: &Printer,
) -> Result<u8, Failure> {
    if description.robot.dof() == 0 {
        let message = format!(
            "{}: all joints are fixed, so there are no base parameters",
            description.urdf_path.display()
        );
        return Err(Diagnostic::error(codes::derive::NO_JOINT, message).into());
    }
    let report = derived(description, followers, SEED)
        .map_err(|error| Diagnostic::error(codes::derive::BASE_PARAMETERS, error.to_string()))?;
    printer.result(&report, base_parameters_text)?;
    Ok(0)
}
