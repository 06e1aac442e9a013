//! Whether a recording has the samples that its run has recorded: one in a fixed number of steps, and the last.

use congruent_input::display::quantity;
use congruent_results::{comparison::Scalars, report::RunReport};
use congruent_twin::RunSetup;

use super::{is_early, states::steps};
use crate::{
    rrd::{paths, times::stride},
    series::joints::QUANTITIES,
};

/// Times are recorded in whole nanoseconds.
const ROUNDING_S: f64 = 1e-9;

/// The first missing or misplaced sample of each series of joints and links.
pub(super) fn problems(scalars: &Scalars, report: &RunReport, setup: &RunSetup) -> Vec<String> {
    // The samples of a log are in any distance from each other.
    if setup.recorded.is_some() {
        return Vec::new();
    }
    let robot = &setup.description.robot;
    let of_joint = |joint: &str| {
        let quantities = QUANTITIES.iter().chain(&["position"]);
        quantities.map(|quantity| paths::joint_value(quantity, joint)).collect::<Vec<_>>()
    };
    let of_link = |link: &str| [paths::position_error(link), paths::orientation_error(link)];
    let joints = robot.movable_joint_names().flat_map(of_joint);
    let links = robot.links().iter().flat_map(|link| of_link(&link.name));
    // The run may have ended by an error between observing a step and recording it.
    let early = u64::from(is_early(report));
    let expected = Expected {
        step_s: setup.clock.step_s,
        stride: stride(setup.clock.step_s),
        last: report.simulation.steps.saturating_sub(early),
        is_whole: early == 0,
    };
    let problem = |path: String| {
        let problem = expected.problem(scalars.get(&path)?)?;
        Some(format!("{path}: {problem}"))
    };
    joints.chain(links).filter_map(|path| problem(path.to_string())).collect()
}

/// The steps at which a run records samples.
struct Expected {
    step_s: f64,
    stride: u64,
    last: u64,
    /// Whether the last one is recorded in any case.
    is_whole: bool,
}

impl Expected {
    fn problem(&self, values: &[(f64, f64)]) -> Option<String> {
        let at = |time_s: f64| quantity(time_s, "s");
        #[expect(clippy::cast_precision_loss, reason = "2^53 steps of a nanosecond are 104 days")]
        let time_s = |step: u64| step as f64 * self.step_s;
        let mut due = (0..=self.last).step_by(usize::try_from(self.stride).ok()?).peekable();
        let mut last = None;
        for &(found_s, _) in values {
            let step = steps(found_s, self.step_s);
            if (time_s(step) - found_s).abs() > ROUNDING_S {
                return Some(format!("the value at {} is between two steps of the run", at(found_s)));
            }
            if last == Some(step) {
                return Some(format!("there are two values at {}", at(found_s)));
            }
            // A due step that the values have passed: the file lacks it. Values between due steps are allowed,
            // since violations are recorded at once.
            if let Some(missing) = due.next_if(|&due| due < step) {
                return Some(format!("there is no value at {}", at(time_s(missing))));
            }
            due.next_if_eq(&step);
            last = Some(step);
        }
        // After the last value nothing may be due, and the last step is recorded even if the stride does not meet
        // it.
        let end = due.next().or((self.is_whole && last < Some(self.last)).then_some(self.last));
        end.map(|missing| format!("there is no value at {}", at(time_s(missing))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_that_is_missing_moved_or_repeated_is_found() {
        let expected = Expected { step_s: 0.004, stride: 2, last: 5, is_whole: true };
        let problem =
            |times: &[f64]| expected.problem(&times.iter().map(|&time_s| (time_s, 1.0)).collect::<Vec<_>>());
        assert_eq!(problem(&[0.0, 0.008, 0.016, 0.02]), None);
        // Violations are recorded between due steps as well.
        assert_eq!(problem(&[0.0, 0.004, 0.008, 0.016, 0.02]), None);
        let says = |times: &[f64], words: &str| {
            let found = problem(times).unwrap_or_default();
            assert!(found.contains(words), "{times:?}: {found}");
        };
        says(&[0.0, 0.016, 0.02], "no value at 0.008 s");
        says(&[0.008, 0.016, 0.02], "no value at 0 s");
        says(&[0.0, 0.008, 0.016], "no value at 0.02 s");
        says(&[0.0, 0.008], "no value at 0.016 s");
        says(&[0.0, 0.009, 0.016, 0.02], "at 0.009 s is between two steps");
        says(&[0.0, 0.008, 0.008, 0.016, 0.02], "two values at 0.008 s");
        says(&[], "no value at 0 s");
    }
}
