//! The dynamics of a URDF against the physics that was built from it. Its parameters are identified as those of a
//! black box, from the accelerations that follow from torques.

use congruent_description::RobotDescription;
use congruent_dynamics::{DrivenState, JointDynamics};
use congruent_dynamics_agreement::{
    AccelerationSource, DynamicsReport, IdentificationOptions, NamedModel, PHYSICS, compare_with_source,
};
use congruent_input::{Diagnostic, display::number};
use congruent_twin::source::SimulatedDynamics;

use super::model_frames::{urdf_model, urdf_places};
use crate::codes;

/// Compares masses, inertias, joint terms and gravity of a URDF with those of the physics.
pub(super) fn compared(description: &RobotDescription, seed: u64) -> Result<DynamicsReport, Diagnostic> {
    if let Some(massless) =
        description.warnings.iter().find(|found| found.code == congruent_description::codes::urdf::MASSLESS)
    {
        let message = format!("a moving body without mass has no defined acceleration: {}", massless.message);
        return Err(Diagnostic::error(codes::check::SIMULATED_DYNAMICS, message));
    }
    let refused = |error: &dyn std::error::Error| {
        Diagnostic::error(codes::check::SIMULATED_DYNAMICS, error.to_string())
    };
    let urdf = urdf_model(description);
    let name = description.urdf_path.display().to_string();
    let candidate = NamedModel { name: &name, model: &urdf, places: urdf_places(description) };
    // Accelerations are extrapolated to a step of zero, whatever the step of the physics is.
    let options = IdentificationOptions { seed, step_s: 0.0 };
    let compared_at = |part_of_step: f64| {
        let simulated = SimulatedDynamics::with_part_of_step(&description.robot, part_of_step)
            .map_err(|error| refused(&error))?;
        compare_with_source(&candidate, PHYSICS, &mut Extrapolated(simulated), options)
            .map_err(|error| refused(&error))
    };
    let report = compared_at(1.0)?;
    if report.agrees() {
        return Ok(report);
    }
    // Masses differ by the same whatever the step; what the step does is half, or what rounding does twice.
    let [whole, half] = [report.difference_relative, compared_at(0.5)?.difference_relative];
    if (whole - half).abs() > CHANGED * whole.max(half) {
        let message = format!(
            "damping or dry friction stops a light link so fast that the torques of the physics are known only to {} %",
            number(100.0 * whole.max(half))
        );
        return Err(Diagnostic::error(codes::check::SIMULATED_DYNAMICS, message));
    }
    Ok(report)
}

/// A difference that changes by more with the step is one of the steps.
const CHANGED: f64 = 0.1;

/// The physics, whose accelerations are extrapolated to a step of zero already.
struct Extrapolated(SimulatedDynamics);

impl AccelerationSource for Extrapolated {
    fn acceleration_into(
        &mut self,
        state: &DrivenState<'_>,
        _step_s: f64,
        qdd: &mut [f64],
    ) -> Result<(), String> {
        self.0.independent_forward_into(state, qdd).map_err(|error| error.to_string())
    }
}
