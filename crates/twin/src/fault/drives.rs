//! Faults of drives and of what they move: changes of the physics.

use congruent_description::CarriedBody;
use congruent_simulation::{SimulationError, World};

use super::planned::FaultAction;

/// Damping that stops a joint, N m s/rad or N s/m: a torque of 100 N m moves it by 1e-7 rad/s.
const STUCK_DAMPING: f64 = 1e9;

/// What a fault has replaced in the physics: damping and dry friction of its joint.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Replaced {
    damping: f64,
    dry: f64,
}

/// Changes the physics at the beginning of a fault.
///
/// # Errors
/// [`SimulationError`] for a resistance that is not finite, which checked faults do not have.
pub(super) fn begin(action: &FaultAction, world: &mut World) -> Result<Replaced, SimulationError> {
    let mut replaced = Replaced::default();
    let joint = match *action {
        FaultAction::StuckJoint { joint } | FaultAction::AddedFriction { joint, .. } => joint,
        FaultAction::ScaledTorque { joint, share } => {
            world.set_delivered_share(joint, share)?;
            return Ok(replaced);
        }
        _ => return Ok(replaced),
    };
    // Read at the beginning of the fault, not from the description: another fault or the scenario may have changed
    // them.
    replaced = Replaced { damping: world.damping(joint), dry: world.dry_friction(joint) };
    match *action {
        FaultAction::AddedFriction { dry, viscous, .. } => {
            world.set_damping(joint, replaced.damping + viscous)?;
            world.set_dry_friction(joint, replaced.dry + dry)?;
        }
        // Damping instead of a lock: the engine integrates it implicitly, and no constraint has to be added to a
        // running multibody.
        _ => world.set_damping(joint, STUCK_DAMPING)?,
    }
    Ok(replaced)
}

/// Puts the physics back at the end of a fault.
///
/// # Errors
/// As [`begin`].
pub(super) fn end(
    action: &FaultAction,
    replaced: Replaced,
    world: &mut World,
) -> Result<(), SimulationError> {
    match *action {
        FaultAction::StuckJoint { joint } | FaultAction::AddedFriction { joint, .. } => {
            world.set_damping(joint, replaced.damping)?;
            world.set_dry_friction(joint, replaced.dry)
        }
        FaultAction::ScaledTorque { joint, .. } => world.set_delivered_share(joint, 1.0),
        _ => Ok(()),
    }
}

/// What the tool carries by a fault.
pub(super) fn load(action: &FaultAction) -> Option<CarriedBody> {
    match action {
        FaultAction::WrongPayload { load } => Some(*load),
        _ => None,
    }
}
