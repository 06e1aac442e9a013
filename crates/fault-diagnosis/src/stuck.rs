//! Hypothesis: a joint does not move although it should.

use congruent_scenario::{FaultKind, RunFault};

use super::{
    fit::{FaultFit, Window},
    noise::ROUNDING,
    observed::{ObservedRun, spread},
};

/// A joint that moves by less than this part of its setpoint is stuck. A brake of 1e9 N m s/rad yields by 1e-7 rad/s under 100
/// N m.
const STUCK_PART: f64 = 1e-3;

/// The joint does not move in a window of samples, and its setpoint does.
pub(super) fn fault(observed: &ObservedRun<'_>, joint: usize, window: Window) -> Option<FaultFit> {
    // The joint comes to rest within the first step of the fault.
    let after = (window.first + 2).min(window.end)..window.end;
    let commanded = spread(&observed.setpoint[joint][after.clone()]);
    let moved = spread(&observed.q[joint][after]);
    if commanded <= ROUNDING || moved > STUCK_PART * commanded {
        return None;
    }
    let (from_s, until_s) = observed.times(window);
    let joints = vec![observed.name(joint)];
    let fault =
        RunFault { kind: FaultKind::StuckJoint, joints, link: None, values: Vec::new(), from_s, until_s };
    Some(FaultFit { fault, remaining: moved / commanded, parameters: 0 })
}

/// When a joint is not at its setpoint, for a robot that is placed there.
pub(super) fn behind_setpoint(observed: &ObservedRun<'_>, joint: usize) -> Option<Window> {
    let (q, setpoint) = (&observed.q[joint], &observed.setpoint[joint]);
    Window::spanning(q.len(), |sample| (q[sample] - setpoint[sample]).abs() > ROUNDING)
}
