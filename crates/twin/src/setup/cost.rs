//! A warning before a run that takes longer than its author may expect.

use congruent_input::{Diagnostic, display::number};
use congruent_monitors::RunClock;

use crate::codes;

/// Time of a physics step for each joint's square and cube, s: the engine factors the mass matrix in every step. Kind:
/// fitted to chains within a third; 100 joints 14 ms, 200 joints 70 ms, 300 joints 240 ms, 500 joints 580 ms.
const STEP_S: [f64; 2] = [5e-7, 5e-9];
/// Computing time above which a warning is given. Unit: s; kind: choice.
const LONG_S: f64 = 60.0;

/// A warning if the physics takes long.
pub(super) fn long_run(joints: usize, clock: &RunClock) -> Option<Diagnostic> {
    let steps = clock.steps?;
    let n = f64::from(u32::try_from(joints).unwrap_or(u32::MAX));
    let step_s = STEP_S[0] * n * n + STEP_S[1] * n * n * n;
    let run_s = step_s * clock.duration_s() / clock.step_s;
    (run_s > LONG_S).then(|| {
        let message = format!(
            "the run takes about {2} minutes: {1} steps of about {0} ms with {joints} joints (the time of a step grows with the \
             cube of their number)",
            number(step_s * 1e3),
            steps,
            number((run_s / 60.0).ceil())
        );
        Diagnostic::warning(codes::scenario::LONG_RUN, message)
            .with_help("give a longer step_s or a shorter duration_s, or use a robot with fewer moving joints")
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    fn clock(steps: u64) -> RunClock {
        RunClock { step_s: 0.001, steps: Some(steps), gravity_in_world: Vector3::zeros() }
    }

    #[test]
    fn a_long_run_is_said_before_it_starts() {
        assert_eq!(long_run(7, &clock(1_000_000)), None);
        assert_eq!(long_run(500, &clock(50)), None);
        let message = long_run(500, &clock(10_000)).unwrap().message;
        let expected = "the run takes about 125 minutes: 10000 steps of about 750 ms with 500 joints (the time of a step grows with the cube of their number)";
        assert_eq!(message, expected);
    }
}
