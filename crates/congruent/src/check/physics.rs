//! The dynamics of a URDF against the physics that was built from it, which is probed as a black box: what accelerations
//! follow from torques.

use congruent_description::{Diagnostic, RobotDescription, display::number};
use congruent_dynamics::{DrivenState, JointDynamics};
use congruent_dynamics_agreement::{
    AccelerationSource, DynamicsReport, NamedSide, Probing, compare_with_source,
};
use congruent_twin::source::SimulatedDynamics;

use super::sides::{urdf_places, urdf_side};

/// The code of the finding that the physics could not be probed.
const CODE: &str = "check::simulated_dynamics";

/// Compares masses, inertias, joint terms and gravity of a URDF with those of the physics.
pub(super) fn compared(description: &RobotDescription, seed: u64) -> Result<DynamicsReport, Diagnostic> {
    if let Some(massless) = description.warnings.iter().find(|found| found.code == "urdf::massless") {
        let message = format!("without a mass no acceleration follows from a force: {}", massless.message);
        return Err(Diagnostic::error(CODE, message));
    }
    let refused = |error: &dyn std::error::Error| Diagnostic::error(CODE, error.to_string());
    let urdf = urdf_side(description);
    let name = description.urdf_path.display().to_string();
    let candidate = NamedSide { name: &name, side: &urdf, places: urdf_places(description) };
    // Accelerations of a step of zero are asked for, whatever the step.
    let probing = Probing { seed, step_s: 0.0 };
    let probed = |part_of_step: f64| {
        let simulated = SimulatedDynamics::with_part_of_step(&description.robot, part_of_step)
            .map_err(|error| refused(&error))?;
        compare_with_source(&candidate, ("physics", &mut Extrapolated(simulated)), probing)
            .map_err(|error| refused(&error))
    };
    let report = probed(1.0)?;
    if report.agrees() {
        return Ok(report);
    }
    // Masses differ by the same whatever the step; what the step does is half, or what rounding does twice.
    let [whole, half] = [report.difference_relative, probed(0.5)?.difference_relative];
    if (whole - half).abs() > CHANGED * whole.max(half) {
        let message = format!(
            "damping or dry friction stops a light link so fast that the physics tells its torques to {} % alone",
            number(100.0 * whole.max(half))
        );
        return Err(Diagnostic::error(CODE, message));
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
